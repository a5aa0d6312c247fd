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
    /// Colors of the points; [`Colors::unknown`] where the file has none.
    pub colors: Colors,
    /// The place from which all of them were seen, where the file tells one.
    pub viewpoint: Option<DVec3>,
}
