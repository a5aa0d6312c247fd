use glam::{DVec3, Vec3};

use super::*;
use crate::{
    geometry::{corners, seams::sphere},
    load::real::real_mesh,
    scene::Shapes,
};

fn disks(splats: &Splats) -> (&[Vec3], &[f32]) {
    match &splats.shapes {
        Shapes::Disks { normals, radii } => (normals, radii),
        Shapes::Ellipses { .. } => panic!("disks"),
    }
}

/// Disk area over surface area: how many disks a point is in on average.
fn mean_overlap(mesh: &Mesh, splats: &Splats) -> f64 {
    let area = |p: [DVec3; 3]| 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).length();
    let surface: f64 = mesh.triangles.iter().filter_map(|&t| corners(mesh, t)).map(area).sum();
    let disks: f64 = disks(splats).1.iter().map(|&r| std::f64::consts::PI * f64::from(r).powi(2)).sum();
    disks / surface
}

/// Samples `per_triangle` points of every `stride`th triangle; seen along its normal each must be in the disk of one of
/// the corners. Returns how many points were in none, and how many were tried.
fn holes(mesh: &Mesh, splats: &Splats, per_triangle: usize, stride: usize) -> (usize, usize) {
    assert_eq!(mesh.positions.len(), splats.len(), "vertices and splats go together");
    let (normals, radii) = disks(splats);
    let (mut holes, mut tried) = (0, 0);
    for (i, &triangle) in mesh.triangles.iter().enumerate().step_by(stride) {
        let Some(p) = corners(mesh, triangle) else { continue };
        let face = (p[1] - p[0]).cross(p[2] - p[0]).normalize();
        for j in 0..per_triangle {
            let random = |g: f64| (0.5 + g * (i * per_triangle + j) as f64).fract();
            let (u, v) = (random(0.754_877_666_246_693), random(0.569_840_290_998_053));
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            let q = p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]);
            let covered = triangle.iter().zip(p).any(|(&vertex, corner)| {
                let normal = normals[vertex as usize].as_dvec3();
                let away = q - corner;
                let in_plane = away - face * (away.dot(normal) / face.dot(normal));
                // The radius is rounded to f32.
                in_plane.length() <= f64::from(radii[vertex as usize]) * (1.0 + 1e-6)
            });
            tried += 1;
            holes += usize::from(!covered);
        }
    }
    (holes, tried)
}

#[test]
fn a_sphere_has_outward_normals_and_no_hole_at_the_smallest_radius() {
    let mesh = sphere(5);
    let (splats, report) = splats_from_mesh(&mesh, 1.0, &());
    assert_eq!(report, MeshReport { closed: true, ..MeshReport::default() });
    for (normal, position) in disks(&splats).0.iter().zip(&splats.positions) {
        // The faces around the octahedron's edges are uneven.
        assert!(normal.as_dvec3().distance(*position) < 6e-3, "{normal} at {position}");
    }
    let (holes_found, tried) = holes(&mesh, &splats, 20, 1);
    assert_eq!((holes_found, tried), (0, 20 * mesh.triangles.len()));
    let overlap = mean_overlap(&mesh, &splats);
    println!("sphere: mean overlap {overlap:.2} at the smallest radius");
    assert!(overlap < 2.5, "not larger than needed: {overlap}");
    // The radius is not larger than needed either: a little less, and there are holes.
    let (smaller, _) = splats_from_mesh(&mesh, 0.98, &());
    assert!(holes(&mesh, &smaller, 20, 1).0 > 0);
}

#[cfg(feature = "files")]
#[test]
fn igea_is_closed() {
    let Some(mesh) = real_mesh("igea.ply") else { return };
    let (_, report) = splats_from_mesh(&mesh, 1.0, &());
    assert_eq!((mesh.positions.len(), mesh.triangles.len()), (134_345, 268_686));
    assert_eq!(report, MeshReport { closed: true, ..MeshReport::default() });
}

#[cfg(feature = "files")]
#[test]
fn fandisk_is_closed_in_spite_of_its_sharp_edges() {
    let Some(mesh) = real_mesh("fandisk.obj") else { return };
    let (splats, report) = splats_from_mesh(&mesh, DEFAULT_OVERLAP, &());
    assert_eq!((mesh.positions.len(), mesh.triangles.len()), (6_475, 12_946));
    assert_eq!(report, MeshReport { closed: true, ..MeshReport::default() });
    assert!(splats.len() > mesh.positions.len(), "several at its edges");
}

/// How smooth the blended normals are, by overlap: what the default was chosen from.
#[test]
fn more_overlap_gives_smoother_normals() {
    let mesh = sphere(4);
    let errors: Vec<f64> = [1.0, 1.25, 1.5, 1.75, 2.0]
        .into_iter()
        .map(|overlap| {
            let (splats, _) = splats_from_mesh(&mesh, overlap, &());
            let (normals, radii) = disks(&splats);
            let (mut sum, mut count) = (0.0, 0);
            for &triangle in mesh.triangles.iter().step_by(7) {
                let p = triangle.map(|i| mesh.positions[i as usize]);
                let q = (0.55 * p[0] + 0.3 * p[1] + 0.15 * p[2]).normalize();
                let mut blended = DVec3::ZERO;
                for i in 0..splats.len() {
                    let normal = normals[i].as_dvec3();
                    let away = q - splats.positions[i];
                    let r = (away - q * (away.dot(normal) / q.dot(normal))).length() / f64::from(radii[i]);
                    if r <= 1.0 && normal.dot(q) > 0.0 {
                        blended += (-2.0 * r * r).exp() * normal;
                    }
                }
                sum += blended.angle_between(q).to_degrees();
                count += 1;
            }
            let error = sum / f64::from(count);
            println!(
                "overlap factor {overlap}: {:.2} disks a point, normals off by {error:.3}°",
                mean_overlap(&mesh, &splats)
            );
            error
        })
        .collect();
    let default_error = errors[2];
    assert!(default_error < 0.5 * errors[0], "{errors:?}");
}

#[test]
fn degenerate_faces_and_lonely_vertices_are_left_out_and_counted() {
    let mut mesh = sphere(3);
    let count = mesh.positions.len() as u32;
    mesh.positions.extend([DVec3::new(f64::NAN, 0.0, 0.0), DVec3::splat(9.0), 0.5 * (DVec3::X + DVec3::Y)]);
    mesh.triangles.extend([[0, 0, 1], [0, 1, count], [0, 1, 9_999_999], [0, 1, count + 2]]);
    let (splats, report) = splats_from_mesh(&mesh, 1.0, &());
    assert_eq!((report.degenerate_faces, report.vertices_without_faces), (4, 3));
    assert!(!report.closed);
    assert_eq!(splats.len(), count as usize);
    let (alone, _) = splats_from_mesh(&sphere(3), 1.0, &());
    assert_eq!(disks(&alone), disks(&splats));
    let (none, report) = splats_from_mesh(&Mesh::default(), 1.0, &());
    assert_eq!((none.len(), report), (0, MeshReport::default()));
}

#[test]
fn open_inconsistent_and_turned_meshes_are_told_apart() {
    let closed = sphere(3);
    let mut open = closed.clone();
    open.triangles.pop();
    let report = splats_from_mesh(&open, 1.0, &()).1;
    assert_eq!((report.closed, report.boundary_edges, report.irregular_edges), (false, 3, 0));

    let mut inconsistent = closed.clone();
    inconsistent.triangles[5].swap(0, 1);
    let report = splats_from_mesh(&inconsistent, 1.0, &()).1;
    assert_eq!((report.closed, report.boundary_edges, report.irregular_edges), (false, 0, 3));

    let mut turned = closed.clone();
    turned.triangles.iter_mut().for_each(|t| t.swap(0, 1));
    let (splats, report) = splats_from_mesh(&turned, 1.0, &());
    assert_eq!((report.closed, report.turned), (true, true));
    let (normals, positions) = (disks(&splats).0, &splats.positions);
    assert!(normals.iter().zip(positions).all(|(n, p)| n.as_dvec3().dot(*p) > 0.9), "outward all the same");
    assert_eq!(report.to_string(), "closed, inside out: turned around");
}

#[test]
fn the_files_normals_and_colors_are_taken_where_they_are_usable() {
    let mut mesh = sphere(3);
    let mut normals = vec![Vec3::new(1.0, 2.0, 2.0); mesh.positions.len()];
    normals[3] = Vec3::ZERO;
    normals[4] = Vec3::NAN;
    mesh.normals = Some(normals);
    let colors: Vec<[f32; 4]> = (0..mesh.positions.len()).map(|i| [i as f32, 0.0, 0.0, 1.0]).collect();
    mesh.colors = Colors::Each(colors.clone());
    // A vertex without a face shifts splats against vertices.
    mesh.positions.insert(0, DVec3::ZERO);
    mesh.triangles.iter_mut().flatten().for_each(|i| *i += 1);
    mesh.normals.as_mut().unwrap().insert(0, Vec3::X);
    let Colors::Each(list) = &mut mesh.colors else { panic!() };
    list.insert(0, [0.0; 4]);
    let (splats, report) = splats_from_mesh(&mesh, 1.0, &());
    assert_eq!(report.normals_from_file, splats.len() - 2);
    assert!(!report.closed, "these normals point inward at some vertices");
    assert_eq!(report.boundary_edges + report.irregular_edges, 0);
    let normals = disks(&splats).0;
    assert!(normals[0].distance(Vec3::new(1.0, 2.0, 2.0) / 3.0) < 1e-6);
    assert!(normals[3].distance(Vec3::NEG_X) < 1e-6 && normals[4].distance(Vec3::NEG_Y) < 1e-6);
    assert!((0..splats.len()).all(|i| splats.color(i) == colors[i]));
}

#[test]
fn normals_do_not_depend_on_how_a_flat_side_is_cut() {
    // A cube's corner: three flat sides, one cut along a diagonal through the corner, the others not.
    let positions = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0]];
    let positions = positions.map(|p: [i32; 3]| DVec3::from_array(p.map(f64::from))).to_vec();
    let triangles = vec![[0, 4, 1], [0, 2, 4], [0, 3, 2], [0, 1, 3]];
    let surface = Surface::of(&Mesh { positions, triangles, ..Mesh::default() }, || {});
    assert!(surface.normals[0].distance(-DVec3::ONE.normalize()) < 1e-12);
}
