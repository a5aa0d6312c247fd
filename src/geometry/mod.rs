//! CPU preparation: what turns other models into splats.

mod borders;
mod bounded;
mod cells;
mod clip;
mod cloud;
mod creases;
mod eigen;
mod facing;
mod fitness;
mod flat_splats;
pub mod hierarchy;
mod hybrid;
mod main_part;
mod mesh_splats;
mod neighbors;
mod normals;
mod overlaps;
mod radii;
mod repeated;
mod resample;
mod seams;
mod sectors;
mod shaded_mesh;
pub mod sharp;
mod spacing;
mod surface;
mod topology;
mod turns;
mod up;

pub(crate) use borders::at_border;
pub use cloud::{CloudReport, Sides, splats_from_points};
#[cfg(feature = "files")]
pub(crate) use eigen::eigen;
pub use facing::{is_flat_in_front, share_facing};
pub use fitness::{Fitness, Suited};
pub use hybrid::{
    EDGE_SPACING, Hybrid, HybridOptions, HybridReport, Multiresolution, hybrid, multiresolution,
};
pub use main_part::{MainPart, main_part};
pub use mesh_splats::{DEFAULT_OVERLAP, fitting_splats, splats_from_mesh};
pub use overlaps::Overlaps;
pub use repeated::{REPEATED, drop_repeated};
pub use resample::{MOST_SAMPLES, RADIUS_PER_DISTANCE, check_memory_for, resample};
pub use seams::{Seam, seams};
pub use shaded_mesh::{creased_mesh, shaded_mesh};
pub use spacing::{mean_edge, mean_spacing};
pub use surface::MeshReport;
pub use up::{FoundUp, up_of_shape};

use glam::DVec3;

use crate::scene::Mesh;

/// The corner positions of a triangle; `None` where it is degenerate: a corner repeated, out of range or not finite, or
/// no area beyond rounding.
fn corners(mesh: &Mesh, triangle: [u32; 3]) -> Option<[DVec3; 3]> {
    let [a, b, c] = triangle;
    if a == b || b == c || c == a {
        return None;
    }
    let position = |i: u32| mesh.positions.get(i as usize).copied().filter(|p| p.is_finite());
    let corners = [position(a)?, position(b)?, position(c)?];
    let (ab, ac) = (corners[1] - corners[0], corners[2] - corners[0]);
    let longest_squared = ab.length_squared().max(ac.length_squared());
    (ab.cross(ac).length() > MIN_RELATIVE_AREA * longest_squared).then_some(corners)
}

/// Twice a triangle's area over its longest edge squared, below which the area is taken as rounding: some thousand times
/// the relative step of f64.
const MIN_RELATIVE_AREA: f64 = 1e-12;
