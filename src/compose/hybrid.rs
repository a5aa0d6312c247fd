//! A mesh in part as triangles, in part as splats.

use glam::DVec3;

use crate::{
    error::{Error, Result},
    geometry::MeshReport,
    load::{Polygons, Samples},
    progress::Progress,
    scene::{Mesh, Splats},
};

/// The two parts, and what was found in the whole mesh.
pub(super) struct Split {
    pub splats: Splats,
    pub polygons: Mesh,
    pub report: MeshReport,
}

/// Makes both parts of a mesh that is where it is drawn. `stays_polygon` says for each triangle which part it goes to.
///
/// # Errors
/// [`crate::ErrorKind::Option`]: not there yet.
pub(super) fn split(
    mesh: &Mesh,
    stays_polygon: &[bool],
    samples: Samples,
    progress: &dyn Progress,
) -> Result<Split> {
    // geometry::hybrid(mesh, &|i| stays_polygon[i], &HybridOptions { .. }, progress) goes here.
    let _ = (mesh, stays_polygon, samples, progress);
    Err(Error::option("representation", "hybrid: not supported yet; expected splats or mesh"))
}

/// Which triangles of a mesh stay polygons; those that can't be drawn don't. The mesh is in its own coordinates.
pub(super) fn stay_polygons(mesh: &Mesh, polygons: Polygons) -> Vec<bool> {
    let stays = |i: usize| mesh.corners(i).is_some_and(|corners| stays_polygon(corners, polygons));
    (0..mesh.triangles.len()).map(stays).collect()
}

fn stays_polygon([a, b, c]: [DVec3; 3], polygons: Polygons) -> bool {
    match polygons {
        Polygons::Plane { normal, d } => normal.dot((a + b + c) / 3.0) >= d,
        Polygons::LongerThan(length) => a.distance(b).max(b.distance(c)).max(c.distance(a)) > length,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_stay_beyond_a_plane_or_with_a_long_edge() {
        let mesh = Mesh {
            positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, 6.0 * DVec3::X, DVec3::NAN],
            triangles: vec![[0, 1, 2], [0, 3, 2], [0, 1, 4], [0, 1, 9]],
            ..Mesh::default()
        };
        // The middles have x = 1/3 and 2.
        let plane = |x, d| Polygons::Plane { normal: DVec3::new(x, 0.0, 0.0), d };
        assert_eq!(stay_polygons(&mesh, plane(1.0, 1.0)), [false, true, false, false]);
        assert_eq!(stay_polygons(&mesh, plane(-3.0, -1.5)), [true, false, false, false]);
        assert_eq!(stay_polygons(&mesh, Polygons::LongerThan(1.5)), [false, true, false, false]);
        assert_eq!(stay_polygons(&mesh, Polygons::LongerThan(1.4)), [true, true, false, false]);
        assert_eq!(stay_polygons(&mesh, Polygons::LongerThan(9.0)), [false; 4]);
    }
}
