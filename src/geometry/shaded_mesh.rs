//! A mesh becomes one that can be shaded: normals at its vertices, on the side from which it is seen.

use super::{
    creases,
    normals::vertex_normals,
    surface::{MeshReport, Surface},
};
use crate::scene::Mesh;
use glam::Vec3;

/// The mesh with a normal at each vertex: the file's where it has usable ones, else the mean of the faces weighted by
/// angle; unit, or zero where the faces cancel or there is none. They are on the side from which the faces are
/// counterclockwise. Triangles that can't be drawn (a corner repeated, out of range or not finite, no area) are left out;
/// a closed mesh that is inside out has its faces turned around.
///
/// [`MeshReport::closed`] is what [`crate::scene::MeshObject::closed`] wants.
pub fn shaded_mesh(mut mesh: Mesh) -> (Mesh, MeshReport) {
    let Surface { mut normals, report, .. } = Surface::of(&mesh, || {});
    let drawn = mesh.triangles.iter().map(|triangle| super::corners(&mesh, *triangle).is_some());
    let drawn: Vec<bool> = drawn.collect();
    let mut drawn = drawn.iter();
    mesh.triangles.retain(|_| *drawn.next().unwrap_or(&true));
    if report.turned {
        mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    }
    let of_faces = vertex_normals(&mesh).normals;
    for (normal, of_faces) in normals.iter_mut().zip(&of_faces) {
        if normal.dot(*of_faces) < 0.0 {
            *normal = -*normal;
        }
    }
    mesh.normals = Some(normals.iter().map(|normal| normal.as_vec3()).collect());
    (mesh, report)
}

/// [`shaded_mesh`], cut apart at its creases (`creases.rs`): vertices where faces meet at an angle become several, at the end of
/// the list. What has the file's normal stays.
pub fn creased_mesh(mesh: Mesh) -> (Mesh, MeshReport) {
    let usable = |normal: &Vec3| normal.as_dvec3().try_normalize().is_some();
    let of_file = mesh.normals.as_ref().filter(|normals| normals.len() == mesh.positions.len());
    let fixed = of_file
        .map_or_else(|| vec![false; mesh.positions.len()], |normals| normals.iter().map(usable).collect());
    let (mut mesh, report) = shaded_mesh(mesh);
    creases::split(&mut mesh, &fixed);
    (mesh, report)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn normals_are_on_the_side_of_the_faces_and_what_has_no_area_is_gone() {
        let mesh = Mesh {
            positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(f64::NAN, 0.0, 0.0), 2.0 * DVec3::X],
            normals: Some(vec![-Vec3::Z; 5]),
            triangles: vec![[0, 1, 2], [0, 1, 1], [0, 1, 4], [0, 1, 3]],
            ..Mesh::default()
        };
        let (shaded, report) = shaded_mesh(mesh);
        assert_eq!(shaded.triangles, [[0, 1, 2]]);
        assert_eq!(report.degenerate_faces, 3);
        assert_eq!(shaded.normals.unwrap()[..3], [Vec3::Z; 3]);
    }
}
