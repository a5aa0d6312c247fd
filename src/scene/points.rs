//! Points without faces and without all that makes them splats, as they come from scanners and files.

use glam::{DVec3, Vec3};

use super::Colors;

/// Points on surfaces, in world space. What is there has one entry a point.
#[derive(Clone, Debug, Default)]
pub struct Points {
    /// Where they are.
    pub positions: Vec<DVec3>,
    /// The file's normals, of any length; `None` where it has none.
    pub normals: Option<Vec<Vec3>>,
    /// The file's radii; `None` where it has none.
    pub radii: Option<Vec<f32>>,
    /// The radii are sizes at which programs draw points: of some they are lengths, of others pixels. They are radii where they close the
    /// surface without being far too large.
    pub radii_in_doubt: bool,
    /// Colors of the points; [`Colors::unknown`] where the file has none.
    pub colors: Colors,
    /// The places from which they were seen, in their order, where the file tells all of them: the last one's `end` is the number
    /// of points. Empty where it does not.
    pub viewpoints: Vec<Viewpoint>,
}

/// A place from which points were seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewpoint {
    /// One more than the number of its last point; its first is the `end` of the viewpoint before.
    pub end: usize,
    /// Where the scanner stood, in world space.
    pub place: DVec3,
}

impl Viewpoint {
    /// One place for so many points; none where it is not known.
    pub fn of_all(count: usize, place: Option<DVec3>) -> Vec<Self> {
        place.map(|place| Self { end: count, place }).into_iter().collect()
    }
}
