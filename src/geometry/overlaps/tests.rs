//! Overlaps, where they are known, and of what is uneven.

use glam::{DVec3, Vec3};

use super::*;
use crate::{
    math::random::SplitMix,
    scene::{Colors, Shapes},
};

fn disks(positions: Vec<DVec3>, radii: Vec<f32>) -> Splats {
    let shapes = Shapes::Disks { normals: vec![Vec3::Z; positions.len()], radii };
    Splats::new(positions, shapes, Colors::Uniform([1.0; 4]))
}

/// A square grid of disks in the plane z = 0, as wide as high.
fn grid(side: i32) -> Vec<DVec3> {
    (0..side * side).map(|i| DVec3::new((i % side).into(), (i / side).into(), 0.0)).collect()
}

/// What weights over overlaps sum to at a place, and without overlaps.
fn sums(splats: &Splats, inverse: &[f32], place: DVec3) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for (i, inverse) in inverse.iter().enumerate() {
        let [to_u, to_v, _] = dual_frame(splats, i);
        let from_center = place - splats.positions[i];
        let r2 = to_u.dot(from_center).powi(2) + to_v.dot(from_center).powi(2);
        if r2 <= 1.0 && from_center.length() <= splats.major_radius(i) {
            let weight = (-2.0 * r2).exp();
            sums = [sums[0] + f64::from(*inverse) * weight, sums[1] + weight];
        }
    }
    sums
}

#[test]
fn a_splat_alone_covers_the_area_of_its_disk() {
    // The mean of the weight over a disk is (1 - e^-2) / 2.
    let mean = 0.5 * (1.0 - (-2.0_f64).exp());
    let far = |i: usize| DVec3::new(100.0 * i as f64, 0.0, 0.0);
    let inverse = Overlaps::of(&disks((0..2000).map(far).collect(), vec![1.0; 2000])).inverse;
    for of in &inverse {
        assert!((f64::from(*of) * mean - 1.0).abs() < 1e-3, "{of}");
    }
    assert!(Overlaps::of(&disks(Vec::new(), Vec::new())).inverse.is_empty());
    assert_eq!(Overlaps::of(&disks(Vec::new(), Vec::new())).mean, 1.0);
}

#[test]
fn sums_over_overlaps_are_one_in_the_mean_however_dense_a_surface_is() {
    for radius in [0.8_f32, 1.5, 2.75] {
        let splats = disks(grid(40), vec![radius; 1600]);
        let inverse = Overlaps::of(&splats).inverse;
        let places = (0..50).map(|i| DVec3::new(15.0 + 0.2 * f64::from(i), 17.0 + 0.13 * f64::from(i), 0.0));
        let mean = places.map(|place| sums(&splats, &inverse, place)[0]).sum::<f64>() / 50.0;
        // The rim of the grid, where less is, is in the mean, too.
        assert!((0.98..1.12).contains(&mean), "{radius}: {mean}");
    }
}

/// Disks that stand at 45° on their line have heights that are no noise.
#[test]
fn slats_are_not_rough() {
    let positions: Vec<_> = (0..400).map(|i| DVec3::new(0.2 * f64::from(i), 0.0, 0.0)).collect();
    let shapes =
        Shapes::Disks { normals: vec![Vec3::new(1.0, 0.0, 1.0).normalize(); 400], radii: vec![1.0; 400] };
    let splats = Splats::new(positions, shapes, Colors::Uniform([1.0; 4]));
    let inverse = Overlaps::of(&splats).inverse;
    let place =
        |n: usize| splats.positions[150 + n % 100] + from_center(n, dual_frame(&splats, 150 + n % 100));
    let mean = (0..1000).map(|n| sums(&splats, &inverse, place(n))[0]).sum::<f64>() / 1000.0;
    assert!((0.95..1.05).contains(&mean), "{mean}");
}

#[test]
fn independent_samples_sum_to_about_the_same_everywhere() {
    let mut random = SplitMix(7);
    let mut unit = || random.unit();
    let positions: Vec<_> = (0..4000).map(|_| DVec3::new(60.0 * unit(), 60.0 * unit(), 0.0)).collect();
    let splats = disks(positions, vec![1.7; 4000]);
    let inverse = Overlaps::of(&splats).inverse;
    let places: Vec<_> =
        (0..400).map(|_| DVec3::new(5.0 + 50.0 * unit(), 5.0 + 50.0 * unit(), 0.0)).collect();
    let spread = |which: usize| {
        let values: Vec<f64> = places.iter().map(|place| sums(&splats, &inverse, *place)[which]).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let squares = values.iter().map(|value| (value / mean - 1.0).powi(2)).sum::<f64>();
        (squares / values.len() as f64).sqrt()
    };
    assert!(spread(0) < 0.6 * spread(1), "{} {}", spread(0), spread(1));
}

#[test]
fn what_lies_on_one_place_is_no_more_than_one_surface_and_takes_no_longer() {
    let count = 20_000;
    let splats = disks(vec![DVec3::ZERO; count], vec![1.0; count]);
    let inverse = Overlaps::of(&splats).inverse;
    let sum = sums(&splats, &inverse, DVec3::new(0.3, 0.4, 0.0))[0];
    assert!((1.0..2.4).contains(&sum), "{sum}");
}

#[test]
fn sizes_of_many_octaves_side_by_side_have_what_each_has_alone() {
    let sides = [1.0, 1e-3, 1e3];
    let mut all = disks(Vec::new(), Vec::new());
    let Shapes::Disks { normals, radii } = &mut all.shapes else { unreachable!("disks") };
    for (i, unit) in sides.into_iter().enumerate() {
        all.positions.extend(grid(20).into_iter().map(|p| unit * p + 1e5 * i as f64 * DVec3::X));
        normals.extend(vec![Vec3::Z; 400]);
        radii.extend(vec![1.5 * unit as f32; 400]);
    }
    let inverse = Overlaps::of(&all).inverse;
    for i in 0..400 {
        let [a, b, c] = [0, 400, 800].map(|first| inverse[first + i]);
        // Positions of f64 at 1e5 have 11 digits.
        assert!((a / b - 1.0).abs() < 1e-4 && (a / c - 1.0).abs() < 1e-4, "{i}: {a} {b} {c}");
    }
}
