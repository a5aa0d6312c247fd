//! A mesh in part as triangles, in part as splats: which triangles stay, and how many splats take the others' place.

use glam::DVec3;

use crate::{
    load::{Polygons, Source},
    scene::Mesh,
};

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

/// How many splats the splat part has where nobody says it. A file's has as many as it has vertices, so that splats are
/// about as large as those at vertices would be; a built-in model's is as dense as the model made of splats alone.
pub(super) fn usual_samples(mesh: &Mesh, stays_polygon: &[bool], source: &Source) -> u64 {
    let samples = match source {
        Source::File(_) => splat_vertices(mesh, stays_polygon),
        Source::BuiltIn { splats, .. } => share(mesh, stays_polygon, *splats),
    };
    samples.max(1)
}

/// The vertices of triangles that become splats.
fn splat_vertices(mesh: &Mesh, stays_polygon: &[bool]) -> u64 {
    let mut used = vec![false; mesh.positions.len()];
    for (triangle, _) in mesh.triangles.iter().zip(stays_polygon).filter(|(_, stays)| !**stays) {
        for &vertex in triangle {
            if let Some(used) = used.get_mut(vertex as usize) {
                *used = true;
            }
        }
    }
    used.into_iter().filter(|used| *used).count() as u64
}

/// The splat part's share of the splats of the whole, by its area.
fn share(mesh: &Mesh, stays_polygon: &[bool], splats: u64) -> u64 {
    let area = |i: usize| mesh.corners(i).map_or(0.0, |[a, b, c]| (b - a).cross(c - a).length());
    let (mut part, mut all) = (0.0, 0.0);
    for (i, stays) in stays_polygon.iter().enumerate() {
        let area = area(i);
        all += area;
        part += if *stays { 0.0 } else { area };
    }
    if all > 0.0 { (splats as f64 * (part / all)).round() as u64 } else { splats }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load::BuiltIn;

    fn mesh() -> Mesh {
        Mesh {
            positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, 6.0 * DVec3::X, DVec3::NAN],
            triangles: vec![[0, 1, 2], [0, 3, 2], [0, 1, 4], [0, 1, 9]],
            ..Mesh::default()
        }
    }

    #[test]
    fn triangles_stay_beyond_a_plane_or_with_a_long_edge() {
        let mesh = mesh();
        // The middles have x = 1/3 and 2.
        let plane = |x, d| Polygons::Plane { normal: DVec3::new(x, 0.0, 0.0), d };
        assert_eq!(stay_polygons(&mesh, plane(1.0, 1.0)), [false, true, false, false]);
        assert_eq!(stay_polygons(&mesh, plane(-3.0, -1.5)), [true, false, false, false]);
        assert_eq!(stay_polygons(&mesh, Polygons::LongerThan(1.5)), [false, true, false, false]);
        assert_eq!(stay_polygons(&mesh, Polygons::LongerThan(1.4)), [true, true, false, false]);
        assert_eq!(stay_polygons(&mesh, Polygons::LongerThan(9.0)), [false; 4]);
    }

    #[test]
    fn a_file_has_a_splat_for_each_vertex_and_a_built_in_model_its_share_of_the_area() {
        let mut mesh = mesh();
        mesh.triangles.truncate(2);
        let file = Source::File("a.obj".into());
        let ball = Source::BuiltIn { model: BuiltIn::Sphere, splats: 700, triangles: 1 };
        let samples = |stay: [bool; 2]| [&file, &ball].map(|source| usual_samples(&mesh, &stay, source));
        // Areas of 1/2 and 3.
        assert_eq!(samples([false, true]), [3, 100]);
        assert_eq!(samples([true, false]), [3, 600]);
        assert_eq!(samples([false, false]), [4, 700]);
        assert_eq!(samples([true, true]), [1, 1]);
    }
}
