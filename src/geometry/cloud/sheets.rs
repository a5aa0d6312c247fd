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
const ON_SHEET: [f64; 2] = [0.4, 0.7];

/// How many may be between one and two limits away for each on the sheet. Of one surface with noise (normally distributed) it is a
/// third at the limit within which 0.7 of its points are, and more at lower ones.
const BETWEEN: f64 = 0.1;

/// Every so manieth neighbor makes planes of [`wide`], and the nearest so many those of [`near`].
const EVERY: usize = 4;
const NEAREST: usize = 6;

/// The fewest points of a sheet, the point itself among them.
const FEWEST: usize = 5;

/// The sheet of a point whose neighbors lie at `offsets` from it, nearest first; [`MOST_NEIGHBORS`] at most.
pub(super) fn wide(offsets: &[DVec3]) -> Option<Plane> {
    let scale = offsets.get(5)?.length();
    let limits = LIMITS.map(|limit| limit * scale);
    let some: Vec<DVec3> = offsets.iter().skip(EVERY - 1).step_by(EVERY).copied().collect();
    limits.into_iter().zip(planes(&some, offsets, limits)).find_map(|(limit, normal)| {
        let mut sheet = Sheet { normal: normal?, middle: 0.0, limit };
        let mut plane = sheet.fit(offsets);
        for _ in 0..2 {
            sheet = sheet.moved(plane.normal, offsets);
            plane = sheet.fit(offsets);
        }
        let sheet = sheet.moved(plane.normal, offsets);
        let share = |distance: f64| {
            let within = offsets.iter().filter(|o| sheet.distance(**o) <= distance).count();
            within as f64 / offsets.len() as f64
        };
        let (on, near) = (share(limit), share(2.0 * limit));
        let stands_out = (ON_SHEET[0]..=ON_SHEET[1]).contains(&on) && near - on <= BETWEEN * on;
        let has_point = sheet.distance(DVec3::ZERO) <= limit;
        (stands_out && has_point && plane.thickness <= FLAT).then_some(plane)
    })
}

/// The sheet of a point that has the most of a few neighbors.
pub(super) fn near(offsets: &[DVec3]) -> Option<Plane> {
    let some = &offsets[..offsets.len().min(NEAREST)];
    let limit = LIMITS[0] * some.last()?.length();
    let [normal] = planes(some, offsets, [limit]);
    let sheet = Sheet { normal: normal?, middle: 0.0, limit };
    let count = offsets.iter().filter(|o| sheet.distance(**o) <= limit).count() + 1;
    let plane = (count >= FEWEST).then(|| sheet.fit(offsets))?;
    (plane.thickness <= FLAT).then_some(plane)
}

/// For each limit the normal of the best plane through 0 and two of `some`. Sums are of 32 bits, in limits, four neighbors at once: planes of which
/// these tell the same are as good.
fn planes<const N: usize>(some: &[DVec3], offsets: &[DVec3], limits: [f64; N]) -> [Option<DVec3>; N] {
    let fours = Fours::new(offsets, limits[N - 1]);
    let squares = limits.map(|limit| Vec4::splat((limit / limits[N - 1]).powi(2) as f32));
    let mut best = [(f32::INFINITY, None); N];
    for (i, a) in some.iter().enumerate() {
        for b in &some[..i] {
            let Some(normal) = a.cross(*b).try_normalize() else { continue };
            let sums = fours.sums(normal.as_vec3(), squares);
            for (best, sum) in best.iter_mut().zip(sums) {
                if sum < best.0 {
                    *best = (sum, Some(normal));
                }
            }
        }
    }
    best.map(|(_, normal)| normal)
}

/// The x, y and z of neighbors by fours; 0 where there are fewer.
struct Fours {
    all: [[Vec4; 3]; MOST_NEIGHBORS / 4],
    count: usize,
}

impl Fours {
    fn new(offsets: &[DVec3], unit: f64) -> Self {
        let mut all = [[Vec4::ZERO; 3]; MOST_NEIGHBORS / 4];
        for (four, offsets) in all.iter_mut().zip(offsets.chunks(4)) {
            for (i, offset) in offsets.iter().enumerate() {
                (0..3).for_each(|axis| four[axis][i] = (offset[axis] / unit) as f32);
            }
        }
        Self { all, count: offsets.len().div_ceil(4).min(MOST_NEIGHBORS / 4) }
    }

    /// The sums of squared distances from a plane through 0, each cut off.
    fn sums<const N: usize>(&self, normal: Vec3, limits: [Vec4; N]) -> [f32; N] {
        let mut sums = [Vec4::ZERO; N];
        for [x, y, z] in &self.all[..self.count] {
            let distance = normal.x * x + normal.y * y + normal.z * z;
            let squared = distance * distance;
            sums.iter_mut().zip(limits).for_each(|(sum, limit)| *sum += squared.min(limit));
        }
        sums.map(Vec4::element_sum)
    }
}

/// All within `limit` of a plane.
#[derive(Clone, Copy)]
struct Sheet {
    normal: DVec3,
    /// The plane's distance from the point, along the normal.
    middle: f64,
    limit: f64,
}

impl Sheet {
    fn distance(&self, offset: DVec3) -> f64 {
        (self.normal.dot(offset) - self.middle).abs()
    }

    fn fit(&self, offsets: &[DVec3]) -> Plane {
        Plane::fit(offsets, |offset| self.distance(offset) <= self.limit)
    }

    /// With another normal, through the mean of the points on it.
    fn moved(&self, normal: DVec3, offsets: &[DVec3]) -> Self {
        let on = offsets.iter().filter(|o| self.distance(**o) <= self.limit);
        let (sum, count) = on.fold((0.0, 1.0), |(sum, count), o| (sum + normal.dot(*o), count + 1.0));
        Self { normal, middle: sum / count, limit: self.limit }
    }
}
