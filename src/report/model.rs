//! What a model's file holds, before anything was done with it.

use serde::Serialize;

/// A model as it is in its file, in its own coordinates.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ModelReport {
    /// The format in words, such as `PLY, binary, little endian`.
    pub format: String,
    /// What it holds, in the plural: `splats`, `triangles` or `points`.
    pub holds: &'static str,
    /// How many splats, points or vertices.
    pub points: usize,
    /// How many triangles, where it holds triangles.
    pub triangles: Option<usize>,
    /// The smallest and the largest coordinates of those that are finite; `None` where there is none.
    pub bounds: Option<[[f64; 3]; 2]>,
    /// How long its unit is in metres, where the file or its format tells it.
    pub metres_per_unit: Option<f64>,
    /// The direction that is up, where the file or its format tells one.
    pub up: Option<[f64; 3]>,
    /// Whether it has normals or tangent vectors.
    pub normals: bool,
    /// Whether it has colors of its own.
    pub colors: bool,
    /// Whether it has sizes: radii or tangent vectors.
    pub sizes: bool,
}
