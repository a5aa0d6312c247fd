mod hard;
mod measures;
pub(super) mod weights;

use glam::Vec3;

use super::*;
use crate::geometry::seams::{Seam, seams};
use weights::distances;

fn options(samples: u64, sample_edges: bool) -> HybridOptions {
    HybridOptions { samples, seed: 3, sample_edges }
}

fn of_seam(seam: &Seam, options: &HybridOptions) -> Hybrid {
    hybrid(&seam.mesh, &|triangle| seam.polygon[triangle], options, &()).unwrap()
}

fn named(start: &str) -> Seam {
    seams().into_iter().find(|seam| seam.name.starts_with(start)).unwrap()
}

fn disks(splats: &Splats) -> (&[Vec3], &[f32]) {
    match &splats.shapes {
        Shapes::Disks { normals, radii } => (normals, radii),
        Shapes::Ellipses { .. } => panic!("disks"),
    }
}

/// Points on all transition edges, found by brute force, closer together than `spacing`.
fn along_edges(seam: &Seam, spacing: f64) -> Vec<DVec3> {
    let edges = |i: usize| {
        let [a, b, c] = seam.mesh.triangles[i];
        [(a, b), (b, c), (c, a)].map(|(a, b)| (a.min(b), a.max(b)))
    };
    let of = |polygon: bool| (0..seam.polygon.len()).filter(move |&i| seam.polygon[i] == polygon);
    let of_splats: std::collections::HashSet<_> = of(false).flat_map(edges).collect();
    let shared = of(true).flat_map(edges).filter(|edge| of_splats.contains(edge));
    let mut points = Vec::new();
    for (a, b) in shared {
        let [a, b] = [a, b].map(|vertex| seam.mesh.positions[vertex as usize]);
        let steps = (a.distance(b) / spacing).ceil();
        points.extend((0..=steps as u32).map(|i| a.lerp(b, f64::from(i) / steps)));
    }
    points
}

fn bits(hybrid: &Hybrid) -> u64 {
    let (normals, radii) = disks(&hybrid.splats);
    let positions = hybrid.splats.positions.iter().flat_map(|p| p.to_array()).map(f64::to_bits);
    let shapes = normals.iter().flat_map(|n| n.to_array()).chain(radii.iter().copied()).map(f32::to_bits);
    let triangles = hybrid.polygons.triangles.iter().flatten().copied();
    let all = positions.chain(shapes.map(u64::from)).chain(triangles.map(u64::from));
    all.fold(0, |sum: u64, bits| sum.wrapping_mul(31).wrapping_add(bits))
}

#[test]
fn the_same_input_gives_the_same_bytes_everywhere() {
    let found = ["plane, the edge", "sphere, halves, triangles larger"].map(|name| {
        let seam = named(name);
        let [once, again] = [(); 2].map(|()| bits(&of_seam(&seam, &options(1000, true))));
        assert_eq!(once, again);
        once
    });
    assert_eq!(found, [0x9b3a_8c93_bd2b_b5af, 0x4070_0e6d_944c_7555], "{found:#x?}");
}

#[test]
fn the_polygons_are_those_asked_for_with_the_normals_and_colors_of_the_whole_mesh() {
    let mut seam = named("sphere, the edge");
    let color = |p: DVec3| (0.5 * (p + DVec3::ONE)).as_vec3().extend(0.5).to_array();
    seam.mesh.colors = Colors::Each(seam.mesh.positions.iter().map(|&p| color(p)).collect());
    let hybrid = of_seam(&seam, &options(2000, true));
    let (polygons, report) = (&hybrid.polygons, &hybrid.report);
    assert!(hybrid.closed);
    let (whole, _) = shaded_mesh(seam.mesh.clone());
    let (normals, of_whole) = (polygons.normals.as_ref().unwrap(), whole.normals.unwrap());
    let Colors::Each(colors) = &polygons.colors else { panic!("colors") };
    let at_vertex = |found: u32, vertex: u32| {
        let (found, vertex) = (found as usize, vertex as usize);
        let position = seam.mesh.positions[vertex];
        let same = polygons.positions[found] == position;
        assert!(!same || (normals[found], colors[found]) == (of_whole[vertex], color(position)));
        same
    };
    let is = |found: &[u32; 3], triangle: &[u32; 3]| (0..3).all(|i| at_vertex(found[i], triangle[i]));
    let edge = along_edges(&seam, 0.03 * report.edge_radius);
    let mut found = polygons.triangles.iter().peekable();
    for (triangle, polygon) in seam.mesh.triangles.iter().zip(&seam.polygon) {
        let is_found = found.next_if(|found| is(found, triangle)).is_some();
        assert!(is_found || !polygon, "{triangle:?}");
        // What lies below smaller splats stays, too: they grow to those inside over three and a half radii.
        if is_found && !polygon {
            let corners = triangle.map(|vertex| seam.mesh.positions[vertex as usize]);
            let near = distances(&corners, &edge).into_iter().fold(f64::INFINITY, f64::min);
            assert!(near < 4.0 * report.edge_radius, "{near}");
        }
    }
    assert_eq!((found.next(), report.polygons), (None, polygons.triangles.len()));
    let used: std::collections::BTreeSet<_> = polygons.triangles.iter().flatten().copied().collect();
    assert_eq!(used.len(), polygons.positions.len(), "only vertices that are used");
    // The splats on the edge have the normals and colors between those of its ends.
    let (normals, radii) = disks(&hybrid.splats);
    let first = hybrid.splats.len() - report.edge_splats;
    for i in first..hybrid.splats.len() {
        let position = hybrid.splats.positions[i];
        assert!(normals[i].as_dvec3().dot(position.normalize()) > 0.999);
        assert!((normals[i].length() - 1.0).abs() < 1e-6);
        let radius = f64::from(radii[i]) / report.edge_radius;
        assert!((0.999 * sizes::LEAST..=1.0).contains(&radius), "{radius}");
        let expected = color(position);
        let found = hybrid.splats.color(i);
        assert!(found.iter().zip(expected).all(|(f, e)| (f - e).abs() < 1e-6), "{found:?} {expected:?}");
    }
}

#[test]
fn all_or_nothing_leaves_the_other_part_empty() {
    let mesh = named("sphere, the edge").mesh;
    let all = hybrid(&mesh, &|_| false, &options(1000, true), &()).unwrap();
    let (as_resampled, _) = crate::geometry::resample(&mesh, 1000, 3, &()).unwrap();
    assert_eq!(all.splats.positions, as_resampled.positions);
    assert_eq!(disks(&all.splats).1, disks(&as_resampled).1);
    let normals = disks(&all.splats).0.iter().zip(disks(&as_resampled).0);
    assert!(normals.map(|(a, b)| (*a - *b).length()).all(|difference| difference < 1e-6));
    assert!(all.polygons.triangles.is_empty() && all.polygons.positions.is_empty() && all.closed);
    assert_eq!((all.report.transition_edges, all.report.edge_splats, all.report.removed), (0, 0, 0));

    let none = hybrid(&mesh, &|_| true, &options(1000, true), &()).unwrap();
    assert!(none.splats.is_empty() && none.closed);
    assert_eq!((none.report.polygons, none.report.transition_edges), (mesh.triangles.len(), 0));
    assert_eq!(none.polygons.triangles, mesh.triangles);
}
