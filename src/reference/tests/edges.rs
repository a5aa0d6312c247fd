//! Edges of the surface that is sampled, and how far the ground truth's partial coverage is from them.

use super::*;
use crate::reference::{Edge, GroundTruth, ground_truth};

fn truth(scene: &Scene, side_px: u32) -> GroundTruth {
    let settings = Settings { epsilon: Epsilon::Length(0.05), ..settings(side_px) };
    ground_truth(scene, &camera(), &settings, 8, &|_, _| ()).unwrap()
}

fn edges(truth: &GroundTruth) -> Vec<Edge> {
    truth.pixels.iter().map(|pixel| pixel.edge).collect()
}

#[test]
fn an_outline_passes_through_the_pixels_of_a_disks_rim_and_a_jump_where_something_is_behind() {
    // 32 pixels, 16 a unit; a disk of 10 pixels.
    let disk = facing_disk(DVec3::Z, 10.0 / 16.0, GRAY);
    let wall = |z: f64| facing_disk(DVec3::Z * z, 100.0, GRAY);
    for (behind, expected) in [(None, Edge::Outline), (Some(2.0), Edge::Jump), (Some(1.04), Edge::None)] {
        let list: Vec<Ellipse> = [disk].into_iter().chain(behind.map(wall)).collect();
        for (i, edge) in edges(&truth(&ellipses(&list), 32)).into_iter().enumerate() {
            let (x, y) = ((i % 32) as f64 + 0.5 - 16.0, (i / 32) as f64 + 0.5 - 16.0);
            let from_rim_px = (x.hypot(y) - 10.0).abs();
            // Within the pixel, or so far from it that no corner of it is; samples are an eighth apart.
            if from_rim_px < 0.3 {
                assert_eq!(edge, expected, "{behind:?}: {x}, {y}");
            } else if from_rim_px > 0.71 + 0.125 {
                assert_eq!(edge, Edge::None, "{behind:?}: {x}, {y}");
            }
        }
    }
}

#[test]
fn a_pixel_that_is_covered_in_part_is_within_two_of_an_edge() {
    let mut random = Random(77);
    let list: Vec<Ellipse> = (0..30).map(|_| random_ellipse(&mut random, 0.15, 3.0)).collect();
    // More rows than a band.
    let truth = truth(&ellipses(&list), 80);
    let regions = near_edges(&truth, 2.0);
    let mut partial = 0;
    for (pixel, near) in truth.pixels.iter().zip(regions) {
        if (1.0 / 255.0..=254.0 / 255.0).contains(&pixel.coverage) {
            partial += 1;
            assert!(near, "{pixel:?}");
        }
    }
    assert!(partial > 300, "{partial}");
}

/// Whether an edge's pixel is within so many pixels of each.
fn near_edges(truth: &GroundTruth, reach_px: f64) -> Vec<bool> {
    let width = truth.size_px[0] as usize;
    let place = |i: usize| [(i % width) as f64, (i / width) as f64];
    let marked: Vec<[f64; 2]> =
        (0..truth.pixels.len()).filter(|i| truth.pixels[*i].edge != Edge::None).map(place).collect();
    let near = |[x, y]: [f64; 2]| marked.iter().any(|edge| (edge[0] - x).hypot(edge[1] - y) <= reach_px);
    (0..truth.pixels.len()).map(|i| near(place(i))).collect()
}

#[test]
fn a_floor_of_small_splats_is_one_surface_up_to_the_horizon() {
    // Half a unit below the eye; at the farthest row a pixel is 30 units of it, 600 times what ε is.
    let mut list = Vec::new();
    for i in 0..40 {
        for j in 0..120 {
            let z = 0.4 * 1.06_f64.powi(j);
            let center = DVec3::new((f64::from(i) - 19.5) * 0.06 * z, 0.5, z);
            let (s, t) = (Vec3::X * (0.12 * z as f32), Vec3::Z * (0.12 * z as f32));
            list.push((center, s, t, GRAY));
        }
    }
    let truth = truth(&ellipses(&list), 40);
    let seen = edges(&truth);
    // Below the horizon, away from the floor's own sides.
    for (i, edge) in seen.iter().enumerate().filter(|(i, _)| (22..40).contains(&(i / 40))) {
        assert_eq!(*edge, Edge::None, "{}, {}", i % 40, i / 40);
        assert!(truth.pixels[i].coverage > 0.999);
    }
    assert!(seen.iter().all(|edge| *edge != Edge::Jump));
    assert!(seen.iter().filter(|edge| **edge == Edge::Outline).count() >= 40);
}
