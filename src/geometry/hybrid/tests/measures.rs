//! Σw and radii on every seam.

use super::{
    weights::{KERNELS, distances, sums},
    *,
};
use crate::geometry::{
    corners,
    hybrid::sizes::{LEAST, STAND_OFF},
};

const COUNTS: [u64; 3] = [300, 3000, 20_000];

#[test]
fn weights_saturate_along_every_transition_edge() {
    for seam in seams() {
        for samples in COUNTS {
            let hybrid = of_seam(&seam, &options(samples, true));
            let points = along_edges(&seam, 0.03 * hybrid.report.edge_radius);
            assert!(points.len() > 100);
            for (name, kernel) in KERNELS {
                let sums = sums(&hybrid.splats, kernel, &points);
                let least = sums.iter().copied().fold(f64::INFINITY, f64::min);
                println!("{}, {samples} samples, {name}: at least {least:.4}", seam.name);
                assert!(least >= 1.0 - 1e-9, "{}: {least}", seam.name);
            }
        }
    }
}

#[test]
fn places_on_edges_are_even_and_none_is_there_twice() {
    for seam in seams() {
        for samples in COUNTS {
            let hybrid = of_seam(&seam, &options(samples, true));
            let report = hybrid.report;
            let places = &hybrid.splats.positions[hybrid.splats.len() - report.edge_splats..];
            for (i, place) in places.iter().enumerate() {
                let others = places.iter().enumerate().filter(|(j, _)| i != *j);
                let nearest = others.map(|(_, other)| other.distance(*place)).fold(f64::INFINITY, f64::min);
                assert!(nearest > 1e-3 * report.edge_radius, "{}, {samples}: {nearest}", seam.name);
            }
            if !seam.name.starts_with("plane") {
                // There splats on edges are smaller, but never so many that neighbors are nearer than seven tenths of the spacing,
                // from where on each try had 5% more: 1.5 times the length in spacings of their own radii, and one at an end.
                let (_, radii) = disks(&hybrid.splats);
                let of_edges = &radii[hybrid.splats.len() - report.edge_splats..];
                let reached: f64 = of_edges.iter().map(|radius| EDGE_SPACING * f64::from(*radius)).sum();
                let most = 1.5 * report.transition_length + EDGE_SPACING * report.edge_radius;
                println!("{}, {samples}: {:.3} of the length", seam.name, reached / report.transition_length);
                assert!(reached >= 0.95 * report.transition_length && reached < most, "{}", seam.name);
                continue;
            }
            // What the spacing needs, rounded up for each chain and with one for each of its ends, which crossing ones
            // share. Only one mesh has more than one: 112 between 77 ends.
            let (chains, ends) = if seam.name.contains("by turns") { (112.0, 77.0) } else { (1.0, 2.0) };
            let needed = report.transition_length / (EDGE_SPACING * report.edge_radius);
            let more = places.len() as f64 - needed;
            assert!(more > ends - chains - 1.0 && more < ends, "{}, {samples}: {more} more", seam.name);
        }
    }
}

#[test]
fn no_splat_is_on_the_other_side_of_an_edge_or_too_near() {
    for seam in seams() {
        for sample_edges in [true, false] {
            let hybrid = of_seam(&seam, &options(3000, sample_edges));
            let report = hybrid.report;
            let edge = along_edges(&seam, 0.03 * report.edge_radius);
            let (inside, on_edge) =
                hybrid.splats.positions.split_at(hybrid.splats.len() - report.edge_splats);
            assert!(distances(on_edge, &edge).iter().all(|d| *d < 0.02 * report.edge_radius));
            // Where the surface bends splats near edges are smaller, and more; without splats on edges there is nothing to be small for.
            let bends = sample_edges && !seam.name.starts_with("plane");
            let sampled = report.removed + inside.len();
            assert!(if bends { sampled > 3000 } else { sampled == 3000 }, "{}: {sampled}", seam.name);
            let near =
                distances(inside, &edge).into_iter().fold(f64::INFINITY, f64::min) / report.edge_radius;
            assert_eq!(sample_edges, report.edge_splats > 0 && report.removed > 0);
            if bends {
                let (_, radii) = disks(&hybrid.splats);
                let radii = &radii[inside.len()..];
                // The nearest place's radius is an eighth off at most: it is within half a radius, and sizes vary by a quarter of that.
                let near = inside.iter().map(|sample| {
                    let away = on_edge.iter().map(|place| place.distance(*sample));
                    let (distance, radius) = away.zip(radii).min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
                    distance / f64::from(*radius)
                });
                let near = near.fold(f64::INFINITY, f64::min);
                println!("{}: {near:.3} radii of the nearest splat on the edge", seam.name);
                assert!(near > 0.875 * 0.28, "{}: {near}", seam.name);
            } else {
                assert_eq!(sample_edges, near > 0.28, "{near}");
            }
            // In some triangle of the splat part, and so is what is on the edge, to within rounding.
            let whole = &seam.mesh;
            let of_splats = (0..seam.polygon.len()).filter(|&i| !seam.polygon[i]);
            let triangles: Vec<_> = of_splats.filter_map(|i| corners(whole, whole.triangles[i])).collect();
            for position in hybrid.splats.positions.iter().step_by(7).chain(on_edge) {
                let outside = triangles.iter().map(|triangle| outside(*triangle, *position));
                assert!(outside.fold(f64::INFINITY, f64::min) < 1e-12, "{}: {position}", seam.name);
            }
        }
    }
}

/// How far a point is beyond a triangle's sides or off its plane.
fn outside(corners: [DVec3; 3], point: DVec3) -> f64 {
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a).normalize();
    let beyond = [(a, b), (b, c), (c, a)].map(|(from, to)| (point - from).cross(to - from).dot(normal));
    beyond.into_iter().fold((point - a).dot(normal).abs(), f64::max)
}

/// Of many values: the least, the mean and the largest; and the share below 1.
fn figures(values: &[f64]) -> ([f64; 3], f64) {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = values.iter().copied().fold(0.0, f64::max);
    let below = values.iter().filter(|value| **value < 1.0).count();
    ([least, values.iter().sum::<f64>() / values.len() as f64, most], below as f64 / values.len() as f64)
}

/// Points of the strip between two distances on the splat side of the edge x = 0, away from the square's own border.
fn strip(radius: f64, from: f64, to: f64) -> Vec<DVec3> {
    let at = |i: u32, j: u32| {
        let x = -radius * (from + (to - from) * f64::from(i) / 20.0);
        DVec3::new(x, 1.7 * (f64::from(j) / 800.0 - 0.5), 0.0)
    };
    (0..=20).flat_map(|i| (0..800).map(move |j| at(i, j))).collect()
}

#[test]
fn beside_the_edge_the_splat_part_is_covered_as_inside() {
    // How much lower the mean, and how much larger the share below 1, may be than inside.
    for (name, lowest_mean, most_below) in
        [("plane, triangles larger", 0.8, 0.002), ("plane, triangles as small", 0.8, 0.025)]
    {
        let seam = named(name);
        for (kernel_name, kernel) in KERNELS {
            let (mut beside, mut inside, mut beyond) = (Vec::new(), Vec::new(), Vec::new());
            for seed in 0..8 {
                let hybrid = of_seam(&seam, &HybridOptions { seed, ..options(3000, true) });
                let radius = hybrid.report.edge_radius;
                beside.extend(sums(&hybrid.splats, kernel, &strip(radius, 0.0, 1.5)));
                inside.extend(sums(&hybrid.splats, kernel, &strip(radius, 3.0, 8.0)));
                beyond.extend(sums(&hybrid.splats, kernel, &strip(radius, -0.25, -0.25)));
            }
            let fade = figures(&beyond).0[1];
            let variance = beyond.iter().map(|sum| (sum - fade).powi(2)).sum::<f64>() / beyond.len() as f64;
            let (beside, inside) = (figures(&beside), figures(&inside));
            println!("{name}, {kernel_name}: Σw {:.2?} beside, {:.2?} inside", beside.0, inside.0);
            println!("    below 1: {:.5} beside, {:.5} inside", beside.1, inside.1);
            println!("    a quarter of a radius beyond the edge: {fade:.2} ± {:.2}", variance.sqrt());
            assert!(beside.0[1] > lowest_mean * inside.0[1], "a dip");
            assert!(beside.0[1] < inside.0[1] && beside.0[2] < 1.1 * inside.0[2], "too many");
            assert!(beside.1 < inside.1 + most_below, "holes");
        }
    }
}

#[test]
fn radii_do_not_grow_toward_the_edge() {
    for name in ["plane, triangles larger", "plane, triangles as small", "plane, the edge a zigzag"] {
        let seam = named(name);
        for sample_edges in [true, false] {
            let hybrid = of_seam(&seam, &options(20_000, sample_edges));
            let radius = hybrid.report.edge_radius;
            let distances = distances(&hybrid.splats.positions, &along_edges(&seam, 0.1 * radius));
            let mean = |from: f64, to: f64| {
                let radii = disks(&hybrid.splats).1.iter().zip(&distances).zip(&hybrid.splats.positions);
                let of_inside = radii.filter(|((_, distance), position)| {
                    (from..to).contains(&(**distance / radius)) && position.abs().max_element() < 0.95
                });
                let (sum, count) = of_inside.fold((0.0, 0.0), |(sum, count), ((radius, _), _)| {
                    (sum + f64::from(*radius), count + 1.0)
                });
                sum / count / radius
            };
            let found = [mean(0.1, 0.6), mean(0.6, 1.2), mean(4.0, 9.0)];
            println!("{name}, on edges {sample_edges}: {found:.3?} of the edge's");
            assert!((found[2] - 1.0).abs() < 0.03, "those on the edge are as inside: {found:?}");
            for near in &found[..2] {
                assert!((0.88..1.05).contains(&(near / found[2])), "{found:?}");
            }
        }
    }
}

/// Of each splat whose rim lies over the polygons: how far it is from them at most, as a share of the mesh's size.
fn off_the_polygons(seam: &Seam, splats: &Splats) -> f64 {
    let size = seam.mesh.bounds().map(|bounds| bounds.min.distance(bounds.max)).unwrap();
    let triangles: Vec<_> = seam.mesh.triangles.iter().map(|t| corners(&seam.mesh, *t).unwrap()).collect();
    let (normals, radii) = disks(splats);
    let mut most: f64 = 0.0;
    for i in 0..splats.len() {
        let (center, radius, normal) = (splats.positions[i], f64::from(radii[i]), normals[i].as_dvec3());
        let (s, t) = normal.any_orthonormal_pair();
        let near: Vec<usize> =
            (0..triangles.len()).filter(|&j| distance(triangles[j], center) < 2.0 * radius).collect();
        if near.iter().all(|j| !seam.polygon[*j]) {
            continue;
        }
        for step in 0..24 {
            let (sin, cos) = (f64::from(step) * std::f64::consts::TAU / 24.0).sin_cos();
            let rim = center + radius * (cos * s + sin * t);
            let of = |polygon: bool| {
                let part = near.iter().filter(|j| seam.polygon[**j] == polygon);
                part.map(|j| distance(triangles[*j], rim)).fold(f64::INFINITY, f64::min)
            };
            if of(true) < of(false) {
                most = most.max(of(true) / size);
            }
        }
    }
    most
}

/// From a point to a triangle.
fn distance([a, b, c]: [DVec3; 3], point: DVec3) -> f64 {
    let normal = (b - a).cross(c - a).normalize();
    let sides = [(a, b), (b, c), (c, a)];
    if sides.iter().all(|(from, to)| (point - *from).cross(*to - *from).dot(normal) <= 0.0) {
        return (point - a).dot(normal).abs();
    }
    let to_side = |(from, to): (DVec3, DVec3)| {
        let t = ((point - from).dot(to - from) / (to - from).length_squared()).clamp(0.0, 1.0);
        point.distance(from.lerp(to, t))
    };
    sides.into_iter().map(to_side).fold(f64::INFINITY, f64::min)
}

/// The sine of the largest tilt of a face against the normals of its corners.
fn largest_tilt(seam: &Seam) -> f64 {
    let (whole, _) = shaded_mesh(seam.mesh.clone());
    let normals = whole.normals.as_ref().unwrap();
    let tilts = whole.triangles.iter().flat_map(|triangle| {
        let [a, b, c] = corners(&whole, *triangle).unwrap();
        let face = (b - a).cross(c - a).normalize();
        triangle.map(|vertex| normals[vertex as usize].as_dvec3().cross(face).length())
    });
    tilts.fold(0.0, f64::max)
}

#[test]
fn what_lies_over_polygons_does_not_stand_off_them() {
    let closed = |seam: &&Seam| seam.name.starts_with("sphere") && seam.mesh.triangles.len() < 8192;
    for seam in seams().iter().filter(closed) {
        let size = seam.mesh.bounds().map(|bounds| bounds.min.distance(bounds.max)).unwrap();
        for samples in [300, 3000] {
            let hybrid = of_seam(seam, &options(samples, true));
            // What is as small as splats may be stands off so far.
            let smallest = LEAST * hybrid.report.edge_radius * largest_tilt(seam) / size;
            // Samples up to two radii of its splats from an edge reach over it by no more than one: they are up to three times as large.
            let bound = 3.0 * smallest.max(STAND_OFF);
            let off = off_the_polygons(seam, &hybrid.splats);
            println!("{}, {samples} samples: {off:.6} off, bound {bound:.6}", seam.name);
            assert!(off <= bound, "{}, {samples}: {off}", seam.name);
        }
    }
}
