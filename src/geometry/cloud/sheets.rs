//! The flat sheet that a point lies on, where its neighbors together are not flat: at edges, and between two sides of a thin plate.
//!
//! **Which plane.** Of all planes through the point and two of a few neighbors, that with the least sum of squared distances of all
//! neighbors, each cut off at a limit; those nearer to it than the limit are on the sheet, and are fitted.
//!
//! [`wide`] looks for sheets that have noise: the limit rises until most points are clearly on the sheet or clearly beside it.
//! [`near`] is for what it does not find, such as corners of three faces, and takes the limit to be small.

use glam::{DVec3, Vec3, Vec4};

use super::{
    fit::{FLAT, Plane},
    plane::MOST_NEIGHBORS,
};

/// How far from the plane points of a sheet may be, in distances of the 6th neighbor.
const LIMITS: [f64; 3] = [0.15, 0.3, 0.6];

/// The share of all neighbors that lie on a sheet beside which there is another. A plate's sides have half each.
const ON_SHEET: [f32; 2] = [0.4, 0.7];

/// How many may be between one and two limits away for each on the sheet. Of one surface with noise (normally distributed) it is a
/// third at the limit within which 0.7 of its points are, and more at lower ones.
const BETWEEN: f32 = 0.1;

/// Every so manieth neighbor makes planes of [`wide`], and the nearest so many those of [`near`].
const EVERY: usize = 4;
const NEAREST: usize = 6;

/// The fewest points of a sheet, the point itself among them.
const FEWEST: usize = 5;

/// The sheet of a point whose neighbors lie at `offsets` from it, nearest first; [`MOST_NEIGHBORS`] at most.
pub(super) fn wide(offsets: &[DVec3]) -> Option<Plane> {
    let scale = offsets.get(5)?.length();
    let limits = LIMITS.map(|limit| limit * scale);
    let fours = Fours::new(offsets, scale);
    let some: Vec<DVec3> = offsets.iter().skip(EVERY - 1).step_by(EVERY).copied().collect();
    limits.into_iter().zip(fours.planes(&some, limits)).find_map(|(limit, normal)| {
        let mut sheet = Sheet::new(normal?, limit / scale);
        for _ in 0..2 {
            sheet = fours.moved(&sheet, fours.fit(&sheet).normal);
        }
        let plane = fours.fit(&sheet);
        let sheet = fours.moved(&sheet, plane.normal);
        // Whole numbers, of which none is rounded.
        let [on, near] = [sheet.limit, 2.0 * sheet.limit].map(|limit| fours.within(&sheet, limit));
        let shares = ON_SHEET.map(|share| share * offsets.len() as f32);
        let stands_out = (shares[0]..=shares[1]).contains(&on) && near - on <= BETWEEN * on;
        let has_point = sheet.middle.abs() <= sheet.limit;
        (stands_out && has_point && plane.thickness <= FLAT).then_some(plane)
    })
}

/// The sheet of a point that has the most of a few neighbors.
pub(super) fn near(offsets: &[DVec3]) -> Option<Plane> {
    let some = &offsets[..offsets.len().min(NEAREST)];
    let scale = some.last()?.length();
    let fours = Fours::new(offsets, scale);
    let [normal] = fours.planes(some, [LIMITS[0] * scale]);
    let sheet = Sheet::new(normal?, LIMITS[0]);
    let count = fours.within(&sheet, sheet.limit) + 1.0;
    let plane = (count >= FEWEST as f32).then(|| fours.fit(&sheet))?;
    (plane.thickness <= FLAT).then_some(plane)
}

/// All within `limit` of a plane.
#[derive(Clone, Copy)]
struct Sheet {
    normal: Vec3,
    /// The plane's distance from the point, along the normal.
    middle: f32,
    limit: f32,
}

impl Sheet {
    /// Through the point.
    fn new(normal: DVec3, limit: f64) -> Self {
        Self { normal: normal.as_vec3(), middle: 0.0, limit: limit as f32 }
    }
}

/// The x, y and z of neighbors by fours, in 32 bits and a unit of their distance: what rounding leaves, 1e-6, is nothing beside the thickness of a sheet.
struct Fours {
    all: [[Vec4; 3]; MOST_NEIGHBORS / 4],
    count: usize,
    /// Zeros behind the last.
    zeros: f32,
    unit: f64,
}

impl Fours {
    fn new(offsets: &[DVec3], unit: f64) -> Self {
        let mut all = [[Vec4::ZERO; 3]; MOST_NEIGHBORS / 4];
        for (four, offsets) in all.iter_mut().zip(offsets.chunks(4)) {
            for (i, offset) in offsets.iter().enumerate() {
                (0..3).for_each(|axis| four[axis][i] = (offset[axis] / unit) as f32);
            }
        }
        let count = offsets.len().div_ceil(4).min(MOST_NEIGHBORS / 4);
        Self { all, count, zeros: (4 * count).saturating_sub(offsets.len()) as f32, unit }
    }

    /// For each limit the normal of the best plane through 0 and two of `some`.
    fn planes<const N: usize>(&self, some: &[DVec3], limits: [f64; N]) -> [Option<DVec3>; N] {
        let squares = limits.map(|limit| Vec4::splat((limit / self.unit).powi(2) as f32));
        let mut best = [(f32::INFINITY, None); N];
        for (i, a) in some.iter().enumerate() {
            for b in &some[..i] {
                let Some(normal) = a.cross(*b).try_normalize() else { continue };
                let sums = self.sums(normal.as_vec3(), squares);
                for (best, sum) in best.iter_mut().zip(sums) {
                    if sum < best.0 {
                        *best = (sum, Some(normal));
                    }
                }
            }
        }
        best.map(|(_, normal)| normal)
    }

    /// The sums of squared distances from a plane through 0, each cut off.
    fn sums<const N: usize>(&self, normal: Vec3, limits: [Vec4; N]) -> [f32; N] {
        let mut sums = [Vec4::ZERO; N];
        for distance in self.along(normal) {
            let squared = distance * distance;
            sums.iter_mut().zip(limits).for_each(|(sum, limit)| *sum += squared.min(limit));
        }
        sums.map(Vec4::element_sum)
    }

    fn along(&self, normal: Vec3) -> impl Iterator<Item = Vec4> {
        self.all[..self.count].iter().map(move |[x, y, z]| normal.x * x + normal.y * y + normal.z * z)
    }

    /// Which lie within a limit of a sheet's middle.
    fn part(&self, sheet: &Sheet, limit: f32) -> impl Iterator<Item = impl Fn(Vec4) -> Vec4> {
        let (middle, limit) = (Vec4::splat(sheet.middle), Vec4::splat(limit));
        let is_within = move |along: Vec4| (along - middle).abs().cmple(limit);
        self.along(sheet.normal).map(is_within).map(|mask| move |of: Vec4| Vec4::select(mask, of, Vec4::ZERO))
    }

    /// Of how many zeros are counted that are no neighbors.
    fn surplus(&self, sheet: &Sheet, limit: f32) -> f32 {
        if sheet.middle.abs() <= limit { self.zeros } else { 0.0 }
    }

    /// How many lie within a limit of a sheet's middle.
    fn within(&self, sheet: &Sheet, limit: f32) -> f32 {
        self.part(sheet, limit).map(|part| part(Vec4::ONE)).sum::<Vec4>().element_sum()
            - self.surplus(sheet, limit)
    }

    /// The plane through the point and those on a sheet.
    fn fit(&self, sheet: &Sheet) -> Plane {
        let [mut x, mut y, mut z, mut xx, mut xy, mut xz, mut yy, mut yz, mut zz, mut count] =
            [Vec4::ZERO; 10];
        for (part, four) in self.part(sheet, sheet.limit).zip(&self.all) {
            let [on_x, on_y, on_z] = four.map(&part);
            (x, y, z, count) = (x + on_x, y + on_y, z + on_z, count + part(Vec4::ONE));
            (xx, xy, xz) = (xx + on_x * on_x, xy + on_x * on_y, xz + on_x * on_z);
            (yy, yz, zz) = (yy + on_y * on_y, yz + on_y * on_z, zz + on_z * on_z);
        }
        let sum = |fours: Vec4| f64::from(fours.element_sum());
        let count = sum(count) - f64::from(self.surplus(sheet, sheet.limit));
        let plane = Plane::of_sums(
            1.0 + count,
            DVec3::new(sum(x), sum(y), sum(z)),
            [xx, xy, xz, yy, yz, zz].map(sum),
        );
        Plane { mean: self.unit * plane.mean, ..plane }
    }

    /// A sheet with another normal, through the mean of the points on it.
    fn moved(&self, sheet: &Sheet, normal: DVec3) -> Sheet {
        let normal = normal.as_vec3();
        let on = self.part(sheet, sheet.limit).zip(self.along(normal));
        let (sum, count) = on.fold((Vec4::ZERO, Vec4::ZERO), |(sum, count), (part, along)| {
            (sum + part(along), count + part(Vec4::ONE))
        });
        let count = 1.0 + count.element_sum() - self.surplus(sheet, sheet.limit);
        Sheet { normal, middle: sum.element_sum() / count, ..*sheet }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::SplitMix;

    /// Of any number of neighbors, which fours need not divide.
    #[test]
    fn by_fours_sheets_have_the_points_and_the_planes_that_they_have_one_by_one() {
        let mut random = SplitMix(7);
        for count in 3..=MOST_NEIGHBORS {
            let mut unit = || 2.0 * random.unit() - 1.0;
            let offsets: Vec<DVec3> = (0..count).map(|_| DVec3::new(unit(), unit(), 0.2 * unit())).collect();
            let fours = Fours::new(&offsets, 0.5);
            for middle in [0.0, 0.1, 0.5] {
                let normal = DVec3::new(0.3 * unit(), 0.3 * unit(), 1.0).normalize();
                let sheet = Sheet { middle, ..Sheet::new(normal, 0.3) };
                let is_on = |o: DVec3| (normal.dot(o) / 0.5 - f64::from(middle)).abs() <= 0.3;
                let on: Vec<DVec3> = offsets.iter().copied().filter(|o| is_on(*o)).collect();
                assert_eq!(fours.within(&sheet, 0.3), on.len() as f32, "{count} {middle}");
                let (found, truth) = (fours.fit(&sheet), Plane::fit(&offsets, is_on));
                assert!((found.mean - truth.mean).length() < 1e-6, "{count} {middle}: {found:?} {truth:?}");
                if on.len() > 4 {
                    assert!((found.thickness - truth.thickness).abs() < 1e-4, "{found:?} {truth:?}");
                    assert!(found.normal.cross(truth.normal).length() < 1e-4, "{found:?} {truth:?}");
                }
                let along = on.iter().map(|o| normal.dot(*o) / 0.5).sum::<f64>() / (on.len() + 1) as f64;
                assert!((f64::from(fours.moved(&sheet, normal).middle) - along).abs() < 1e-6);
            }
        }
    }
}
