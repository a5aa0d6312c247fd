//! Splats, meshes and points moved, turned, scaled, mirrored or sheared: an affine map of world space, in `f64`.
//!
//! What is outside stays outside, also under a mirror. A normal `n` bounds the half space `n·(x − p) > 0`, which an
//! invertible map `M` takes to the half space of `M⁻ᵀn`; `M` itself turns it elsewhere unless it is a similarity.

use glam::{DAffine3, DMat3, DVec3, Vec3};

use super::{ClipCurve, Mesh, Points, Shapes, Splats};

/// Relative deviation from a similarity below which a disk stays a disk: radii are kept in 32 bits, which tell no less.
const SIMILARITY: f64 = 1e-7;

/// The volume that a map's axes, made unit vectors, must span: below it their directions are rounding.
const SMALLEST_VOLUME: f64 = 1e-12;

/// Whether a map can be undone: finite, none of its axes zero, and the three not in a plane beyond rounding.
pub fn is_invertible(map: &DAffine3) -> bool {
    map.is_finite() && Linear::of(&map.matrix3).volume.abs() > SMALLEST_VOLUME
}

/// Whether disks stay disks under a map.
pub(crate) fn is_similarity(map: &DAffine3) -> bool {
    Linear::of(&map.matrix3).similarity().is_some()
}

impl Splats {
    /// These splats under a map of world space, which must be [invertible](is_invertible): under another one those that
    /// become lines have a [`super::Defect`].
    ///
    /// Under a similarity (moved, turned, mirrored, scaled alike in all directions) disks stay disks. Else they become
    /// ellipses, whose tangent vectors are the images of the disk's own: these are not its axes. Where the map mirrors,
    /// the two are swapped, so that their product still points outward. Clip curves stay where they are on the surface.
    #[must_use]
    pub fn transformed(self, world_from_object: &DAffine3) -> Self {
        let linear = Linear::of(&world_from_object.matrix3);
        let positions = self.positions.iter().map(|p| world_from_object.transform_point3(*p)).collect();
        let shapes = match (self.shapes, linear.similarity()) {
            (Shapes::Disks { normals, radii }, Some(scale)) => Shapes::Disks {
                normals: normals.iter().map(|normal| linear.normal(*normal)).collect(),
                radii: radii.iter().map(|radius| scaled(*radius, scale)).collect(),
            },
            (Shapes::Disks { normals, radii }, None) => {
                let tangents = normals.iter().zip(&radii).map(|(normal, radius)| tangents(*normal, *radius));
                linear.ellipses(tangents)
            }
            (Shapes::Ellipses { s, t }, _) => {
                linear.ellipses(s.iter().zip(&t).map(|(s, t)| [s.as_dvec3(), t.as_dvec3()]))
            }
        };
        // Places in (u, v) stay, but for that swap.
        let clips = if linear.mirrors() { self.clips.map(ClipCurve::swapped) } else { self.clips };
        Self { positions, shapes, colors: self.colors, clips }
    }
}

impl Mesh {
    /// These triangles under an [invertible](is_invertible) map of world space. Normals become unit, or stay zero. Where
    /// the map mirrors, triangles change their order of corners, so that they are still counterclockwise seen from outside.
    #[must_use]
    pub fn transformed(mut self, world_from_object: &DAffine3) -> Self {
        let linear = Linear::of(&world_from_object.matrix3);
        for position in &mut self.positions {
            *position = world_from_object.transform_point3(*position);
        }
        for normal in self.normals.iter_mut().flatten() {
            *normal = linear.normal(*normal);
        }
        if linear.mirrors() {
            self.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        self
    }
}

impl Points {
    /// These points under an [invertible](is_invertible) map of world space. Normals become unit, or stay zero. Radii scale with
    /// a similarity, and are no longer known under another map.
    #[must_use]
    pub fn transformed(mut self, world_from_object: &DAffine3) -> Self {
        let linear = Linear::of(&world_from_object.matrix3);
        for position in
            self.positions.iter_mut().chain(self.viewpoints.iter_mut().map(|view| &mut view.place))
        {
            *position = world_from_object.transform_point3(*position);
        }
        for normal in self.normals.iter_mut().flatten() {
            *normal = linear.normal(*normal);
        }
        let scale = linear.similarity();
        self.radii = self
            .radii
            .zip(scale)
            .map(|(radii, scale)| radii.into_iter().map(|radius| scaled(radius, scale)).collect());
        self
    }
}

/// The linear part of a map, taken apart so that no scale, however extreme, overflows a product.
struct Linear {
    matrix: DMat3,
    /// Lengths of the columns.
    lengths: DVec3,
    /// The columns as unit vectors.
    axes: DMat3,
    /// The signed volume that the unit vectors span: negative where the map mirrors, not above 1.
    volume: f64,
}

impl Linear {
    fn of(matrix: &DMat3) -> Self {
        let columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
        let lengths = DVec3::from_array(columns.map(length));
        let [x, y, z] = columns.map(|column| column / length(column));
        let axes = DMat3::from_cols(x, y, z);
        Self { matrix: *matrix, lengths, axes, volume: axes.determinant() }
    }

    fn mirrors(&self) -> bool {
        self.volume < 0.0
    }

    /// The one factor of all lengths, where there is one.
    fn similarity(&self) -> Option<f64> {
        let [x, y, z] = [self.axes.x_axis, self.axes.y_axis, self.axes.z_axis];
        let orthogonal = [x.dot(y), y.dot(z), z.dot(x)].iter().all(|cosine| cosine.abs() <= SIMILARITY);
        let (longest, shortest) = (self.lengths.max_element(), self.lengths.min_element());
        (orthogonal && longest - shortest <= SIMILARITY * longest).then_some(0.5 * longest + 0.5 * shortest)
    }

    /// The image of a normal of any length: unit, or zero where it has no direction.
    fn normal(&self, normal: Vec3) -> Vec3 {
        let Some(normal) = normal.as_dvec3().try_normalize() else { return Vec3::ZERO };
        // M⁻ᵀ of axes times lengths, but for a positive factor: the cofactors of the axes, over the lengths.
        let [x, y, z] = [self.axes.x_axis, self.axes.y_axis, self.axes.z_axis];
        let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
        let image = cofactors * (normal * (self.lengths.min_element() / self.lengths));
        (self.volume.signum() * image).normalize_or_zero().as_vec3()
    }

    /// The images of pairs of tangent vectors.
    fn ellipses(&self, tangents: impl Iterator<Item = [DVec3; 2]>) -> Shapes {
        let image = |tangent: DVec3| (self.matrix * tangent).as_vec3();
        let (first, second) = tangents.map(|[s, t]| (image(s), image(t))).unzip();
        match self.mirrors() {
            false => Shapes::Ellipses { s: first, t: second },
            true => Shapes::Ellipses { s: second, t: first },
        }
    }
}

/// Without overflow or underflow of the squares.
fn length(vector: DVec3) -> f64 {
    let largest = vector.abs().max_element();
    if largest > 0.0 && largest.is_finite() { largest * (vector / largest).length() } else { largest }
}

/// Orthogonal tangent vectors of a disk whose product points along the normal; zero for a disk that can't be drawn.
fn tangents(normal: Vec3, radius: f32) -> [DVec3; 2] {
    match normal.as_dvec3().try_normalize() {
        Some(normal) if radius > 0.0 => {
            let (s, t) = normal.any_orthonormal_pair();
            [s, t].map(|tangent| f64::from(radius) * tangent)
        }
        _ => [DVec3::ZERO; 2],
    }
}

fn scaled(radius: f32, scale: f64) -> f32 {
    (f64::from(radius) * scale) as f32
}

#[cfg(test)]
mod tests;
