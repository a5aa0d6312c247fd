use glam::{DVec3, Vec3};

use super::super::{creased_mesh, seams::sphere};
use crate::scene::{Colors, Mesh};

/// A cube of 8 shared vertices.
fn cube() -> Mesh {
    let positions = (0..8).map(|i| DVec3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64));
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    Mesh { positions: positions.collect(), triangles: triangles.collect(), ..Mesh::default() }
}

/// A tube without ends.
fn tube(sides: u32) -> Mesh {
    let ring = |z: f64| {
        (0..sides).map(move |i| {
            let (y, x) = (f64::from(i) / f64::from(sides) * std::f64::consts::TAU).sin_cos();
            DVec3::new(x, y, z)
        })
    };
    let quads = (0..sides).map(|i| [i, (i + 1) % sides, sides + (i + 1) % sides, sides + i]);
    let triangles = quads.flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    Mesh {
        positions: ring(0.0).chain(ring(1.0)).collect(),
        triangles: triangles.collect(),
        ..Mesh::default()
    }
}

/// The farthest that a corner's normal is from its face's, as a cosine.
fn worst_cosine(mesh: &Mesh) -> f64 {
    let normals = mesh.normals.as_ref().unwrap();
    let of_triangle = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex as usize]);
        let face = (b - a).cross(c - a).normalize();
        triangle
            .map(|vertex| normals[vertex as usize].as_dvec3().dot(face))
            .into_iter()
            .reduce(f64::min)
            .unwrap()
    };
    mesh.triangles.iter().map(of_triangle).fold(1.0, f64::min)
}

#[test]
fn a_cube_has_the_normals_of_its_faces_and_keeps_its_colors() {
    let colors = (0..8).map(|i| [i as f32 / 8.0, 0.0, 0.0, 1.0]).collect();
    let before = Mesh { colors: Colors::Each(colors), ..cube() };
    let (mesh, report) = creased_mesh(before.clone());
    assert!(report.closed);
    assert_eq!((mesh.positions.len(), mesh.triangles.len()), (24, 12));
    assert!(worst_cosine(&mesh) > 1.0 - 1e-6);
    let Colors::Each(colors) = &mesh.colors else { panic!("a color each") };
    assert_eq!(colors.len(), 24);
    for (old, new) in before.triangles.iter().flatten().zip(mesh.triangles.iter().flatten()) {
        assert_eq!(before.positions[*old as usize], mesh.positions[*new as usize]);
        assert_eq!(colors[*new as usize][0], *old as f32 / 8.0);
    }
}

#[test]
fn what_bends_little_stays_one_surface() {
    for (mesh, creased) in [(sphere(2), false), (tube(10), false), (tube(8), true), (sphere(0), true)] {
        let vertices = mesh.positions.len();
        let (mesh, _) = creased_mesh(mesh);
        assert_eq!(mesh.positions.len() > vertices, creased, "{vertices} vertices");
    }
}

#[test]
fn normals_of_the_file_stay() {
    let normals =
        Some(cube().positions.iter().map(|p| (p.as_vec3() - Vec3::splat(0.5)).normalize()).collect());
    let (mesh, report) = creased_mesh(Mesh { normals: normals.clone(), ..cube() });
    assert_eq!((mesh.positions.len(), report.normals_from_file), (8, 8));
    assert_eq!(mesh.normals, normals);
}

/// The end of a crease that fades out: two of four faces around the middle meet at it, the others are one surface.
#[test]
fn the_end_of_a_crease_is_not_cut() {
    let ring = [DVec3::X, DVec3::new(1.0, 1.0, 0.5), DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y];
    let mut mesh = Mesh { positions: [DVec3::ZERO].into_iter().chain(ring).collect(), ..Mesh::default() };
    mesh.triangles = (0..5).map(|i| [0, i + 1, (i + 1) % 5 + 1]).collect();
    let (mesh, _) = creased_mesh(mesh);
    assert!(mesh.triangles.iter().all(|triangle| triangle[0] == 0));
}

/// Time is not the square of how many faces share a vertex, or an edge.
#[test]
fn a_hub_and_a_book_take_no_time() {
    let n = 200_000;
    let rim = |i: u32| {
        let (y, x) = (f64::from(i) / f64::from(n) * std::f64::consts::TAU).sin_cos();
        DVec3::new(x, y, 0.0)
    };
    let hub = (0..n).map(|i| [0, i + 2, (i + 1) % n + 2]);
    let book = (0..n).map(|i| [0, 1, i + 2]);
    let positions: Vec<DVec3> = [DVec3::ZERO, DVec3::Z].into_iter().chain((0..n).map(rim)).collect();
    for triangles in [hub.collect::<Vec<_>>(), book.collect()] {
        let mesh = Mesh { positions: positions.clone(), triangles, ..Mesh::default() };
        let start = std::time::Instant::now();
        let (mesh, _) = creased_mesh(mesh);
        assert!(start.elapsed().as_secs_f64() < 10.0);
        assert!(mesh.normals.unwrap().iter().all(|normal| normal.is_finite()));
    }
}
