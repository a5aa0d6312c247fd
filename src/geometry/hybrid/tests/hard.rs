//! Meshes that are not as they should be.

use super::*;
use crate::error::ErrorKind;

/// Each triangle with vertices of its own.
fn split(mesh: &Mesh) -> Mesh {
    let corners = mesh.triangles.iter().flatten();
    let positions = corners.map(|&vertex| mesh.positions[vertex as usize]).collect();
    let triangles = (0..mesh.triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Mesh { positions, triangles, ..Mesh::default() }
}

#[test]
fn repeated_vertices_are_one_place() {
    for seam in seams() {
        let whole = of_seam(&seam, &options(500, true));
        let mut mesh = split(&seam.mesh);
        // Also where one of them is at −0.
        mesh.positions.iter_mut().step_by(2).for_each(|p| *p = -(-*p));
        mesh.positions.iter_mut().step_by(2).filter(|p| p.x == 0.0).for_each(|p| p.x = -0.0);
        let apart = hybrid(&mesh, &|triangle| seam.polygon[triangle], &options(500, true), &()).unwrap();
        assert_eq!(whole.report.transition_edges, apart.report.transition_edges, "{}", seam.name);
        // Vertices of their own have the faces' normals, whose mean on an edge bounds splats a little otherwise.
        let [whole_splats, apart_splats] = [&whole, &apart].map(|hybrid| hybrid.report.edge_splats);
        let tolerance = if seam.name.starts_with("plane") { 0 } else { whole_splats / 20 };
        assert!(whole_splats.abs_diff(apart_splats) <= tolerance, "{}", seam.name);
        assert!((whole.report.transition_length - apart.report.transition_length).abs() < 1e-9);
    }
}

/// A square in the plane z = 0 of four triangles about its middle, and another one across it at x = 0.
#[test]
fn sheets_that_touch_inside_both_stay_apart() {
    let corner = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let ends = [corner(0.0, -1.0, 0.0), corner(0.0, 1.0, 0.0)];
    let mut mesh = Mesh::default();
    mesh.positions.extend([ends[0], ends[1], corner(-1.0, 0.0, 0.0), corner(1.0, 0.0, 0.0)]);
    mesh.positions.extend([ends[0], ends[1], corner(0.0, 0.0, -1.0), corner(0.0, 0.0, 1.0)]);
    mesh.triangles = vec![[0, 1, 2], [1, 0, 3], [4, 5, 6], [5, 4, 7]];
    let apart = hybrid(&mesh, &|triangle| triangle < 2, &options(500, true), &()).unwrap();
    assert_eq!(apart.report.transition_edges, 0);
    // The same with one half each: now both edges are a boundary, and one place.
    mesh.triangles = vec![[0, 1, 2], [5, 4, 7]];
    let joined = hybrid(&mesh, &|triangle| triangle < 1, &options(500, true), &()).unwrap();
    assert_eq!(joined.report.transition_edges, 1);
    // Three triangles at one edge, named by the same vertices.
    mesh.triangles = vec![[0, 1, 2], [1, 0, 3], [0, 1, 6]];
    for polygon in 0..3 {
        let three = hybrid(&mesh, &|triangle| triangle == polygon, &options(500, true), &()).unwrap();
        assert_eq!(three.report.transition_edges, 1);
    }
}

#[test]
fn what_cannot_be_drawn_is_left_out_and_numbers_stay_those_of_the_mesh() {
    let seam = named("plane, the edge");
    let clean = of_seam(&seam, &options(500, true));
    let mut mesh = seam.mesh.clone();
    let next = mesh.positions.len() as u32;
    mesh.positions.extend([DVec3::NAN, DVec3::new(f64::INFINITY, 0.0, 0.0)]);
    // A bad triangle before each good one.
    let bad = [[0, 1, next], [0, 0, 1], [2, 1, next + 1], [0, 1, 2], [0, 1, u32::MAX]];
    let both = mesh.triangles.iter().zip(bad.iter().cycle());
    mesh.triangles = both.flat_map(|(good, bad)| [*bad, *good]).collect();
    let polygon = |triangle: usize| {
        assert!(triangle % 2 == 1, "asked for one that can't be drawn");
        seam.polygon[triangle / 2]
    };
    let found = hybrid(&mesh, &polygon, &options(500, true), &()).unwrap();
    assert_eq!(bits(&found), bits(&clean));
    assert_eq!(found.report.mesh.degenerate_faces, mesh.triangles.len() / 2);
}

#[test]
fn where_nothing_is_left_the_error_says_why() {
    let mut nan = named("plane, triangles larger").mesh;
    nan.positions.iter_mut().for_each(|p| p.y = f64::NAN);
    for (mesh, why) in [(Mesh::default(), "in 0 triangles"), (nan, "vertex 0 is [-1.0, NaN, 0.0]")] {
        for all in [false, true] {
            let error = hybrid(&mesh, &|_| all, &options(500, true), &()).unwrap_err();
            let told = matches!(error.kind(), ErrorKind::Input { problem, .. } if problem.contains(why));
            assert!(told, "{error}");
        }
    }
    let mesh = named("plane, triangles larger").mesh;
    for samples in [0, MOST_SAMPLES + 1, u64::MAX] {
        let error = hybrid(&mesh, &|_| true, &options(samples, true), &()).unwrap_err().to_string();
        assert!(error.contains("samples, expected 1 to 4294967295"), "{error}");
    }
}

#[test]
fn an_edge_far_too_long_for_its_splats_is_refused_and_extreme_sizes_do_not_panic() {
    // A sliver: its area is nothing against its edge, so that the splats of it are tiny.
    let sliver = Mesh {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::new(0.5, 1.1e-12, 0.0), DVec3::new(0.5, -1.0, 0.0)],
        triangles: vec![[0, 1, 2], [1, 0, 3]],
        ..Mesh::default()
    };
    let options = options(5_000_000, true);
    let error = hybrid(&sliver, &|triangle| triangle == 1, &options, &()).unwrap_err().to_string();
    assert!(error.contains("places on transition edges of length 1"), "{error}");
    for scale in [1e-150, 1e-40, 1e-20, 1e20, 1e40, 1e100, 1e160] {
        let mut seam = named("plane, triangles larger");
        seam.mesh.positions.iter_mut().for_each(|p| *p *= scale);
        let few = HybridOptions { samples: 50, ..options };
        let _ = hybrid(&seam.mesh, &|triangle| seam.polygon[triangle], &few, &());
    }
    // Fewer samples than the edge gets places, and one alone.
    for samples in [1, 2, 7] {
        let hybrid = of_seam(&named("sphere, the edge"), &HybridOptions { samples, ..options });
        assert!((0..hybrid.splats.len()).all(|i| hybrid.splats.defect(i).is_none()));
    }
}

#[test]
fn where_normals_cancel_the_splats_on_the_edge_have_those_of_a_face() {
    // Both sides have vertices of their own on the edge, with opposite normals in the plane.
    let seam = named("plane, triangles larger");
    let mut mesh = split(&seam.mesh);
    let of_triangle = |polygon: &bool| [if *polygon { Vec3::X } else { Vec3::NEG_X }; 3];
    mesh.normals = Some(seam.polygon.iter().flat_map(of_triangle).collect());
    let hybrid = hybrid(&mesh, &|triangle| seam.polygon[triangle], &options(5000, true), &()).unwrap();
    assert!((0..hybrid.splats.len()).all(|i| hybrid.splats.defect(i).is_none()));
    let (inside, on_edge) = disks(&hybrid.splats).0.split_at(hybrid.splats.len() - hybrid.report.edge_splats);
    assert!(inside.iter().all(|normal| *normal == Vec3::NEG_X));
    assert!(on_edge.len() > 50 && on_edge.iter().all(|normal| *normal == Vec3::Z));
}

#[test]
fn a_loop_shorter_than_the_spacing_still_has_two_ends_for_each_part_of_it() {
    let mesh = named("sphere, the edge").mesh;
    let hybrid = hybrid(&mesh, &|triangle| triangle == 100, &options(20, true), &()).unwrap();
    let report = hybrid.report;
    assert!(report.transition_edges == 3 && report.transition_length < EDGE_SPACING * report.edge_radius);
    // Faces bend away from it, so that splats are smaller than inside and are more.
    assert_eq!(report.edge_splats, 3);
}
