//! `--splat-format packed`: disks in 16 bytes. The shaders unpack what the host packed, and what packing takes from a picture is
//! no more than its bounds tell.

use crate::common::{
    bent::bent,
    builder,
    compare::{self, Errors, F32},
    oracle_of, render,
    scenes::{self, Hard, transparent},
    shared, with,
};
use glam::DVec3;
use surfel::{
    prepare::{LARGEST_TURN_RAD, as_packed},
    scene::{Accumulate, Colors, Epsilon, Filter, Rasterizer, Scene, SplatFormat},
    selftest::{light::compare_light, tolerance},
};

fn packed(hard: &Hard) -> Hard {
    let mut packed = hard.clone();
    packed.scene.storage.format = SplatFormat::Packed;
    packed
}

/// The scene with what is left of its splats, for the oracle; `None` where some of them stay exact.
fn unpacked(scene: &Scene) -> Option<Scene> {
    let mut scene = scene.clone();
    for object in &mut scene.objects {
        object.splats = as_packed(&object.splats)?;
    }
    // Packed splats have no ε of their own.
    scene.storage.format = SplatFormat::Packed;
    Some(scene)
}

#[test]
fn what_the_shaders_unpack_is_what_was_packed() {
    let mut headless = shared();
    let mut checked = 0;
    for mut hard in scenes::all() {
        hard.settings.size_px = [128, 128];
        let Some(scene) = unpacked(&hard.scene) else { continue };
        let oracle = oracle_of(&Hard { scene, ..hard.clone() });
        for rasterizer in [Rasterizer::Perspective, Rasterizer::Compute] {
            let mut packed = packed(&hard);
            packed.settings.rasterizer = rasterizer;
            let errors = compare::compare(&render(&mut headless, &packed), &oracle);
            println!("{}", errors.row(hard.name));
            let beyond = errors.beyond(&tolerance::of(&hard));
            assert!(beyond.is_empty(), "{} {rasterizer:?}: {beyond:#?}", hard.name);
        }
        checked += 1;
    }
    assert!(checked >= 7, "{checked} scenes of disks");
}

#[test]
fn packed_alphas_agree_with_the_oracle() {
    let mut headless = shared();
    let mut hard = transparent::spheres();
    hard.settings.layers = surfel::scene::Layers::Fixed(24);
    for object in &mut hard.scene.objects {
        // One color for all is not packed. An odd one out, so that neighbors in a word differ.
        let mut colors: Vec<_> = (0..object.splats.len()).map(|i| object.splats.color(i)).collect();
        colors.iter_mut().step_by(3).for_each(|color| *color = [0.2, 0.9, 0.4, 0.3]);
        object.splats.colors = Colors::Each(colors);
    }
    let scene = unpacked(&hard.scene).unwrap();
    let frame = render(&mut headless, &packed(&hard));
    let oracle = oracle_of(&Hard { scene, ..hard });
    let errors = compare_light(&frame, &oracle);
    println!("{errors:?}");
    assert!(errors.worst <= tolerance::LIGHT, "{errors:?}");
}

#[test]
fn packing_takes_no_more_from_a_picture_than_its_bounds_tell() {
    let mut headless = shared();
    let mut hard = scenes::sphere_of_disks();
    hard.settings.accumulate = Accumulate::F32;
    let oracle = oracle_of(&hard);
    let [exact, packed] = [hard.clone(), packed(&hard)].map(|hard| {
        let errors = compare::compare(&render(&mut headless, &hard), &oracle);
        println!("{}", errors.row(hard.name));
        errors
    });
    // A turn moves the image of an axis by so much times the tangent of the angle at which it is seen, 10 at 84°, beyond which
    // the filter's √2 pixels are wider; radii grow by 1.6e-5. The Gaussian's d ln w / d ln r is 4 at the rim.
    let weight = 4.0 * (10.0 * LARGEST_TURN_RAD + 1.6e-5);
    // Roots are off by 1/510, so that colors are by twice that; the rest are weights, on colors that differ by 1 at most.
    let albedo = 1.0 / 255.0 + weight;
    let limits = Errors {
        weight: F32.weight + weight,
        albedo: F32.albedo + albedo,
        normal_deg: F32.normal_deg + LARGEST_TURN_RAD.to_degrees(),
        normal_sum_deg: F32.normal_sum_deg + LARGEST_TURN_RAD.to_degrees(),
        color: F32.color + albedo,
        ..F32
    };
    let beyond = packed.beyond(&limits);
    assert!(beyond.is_empty(), "{beyond:#?}");
    // Colors of 8 bits are seen: it was not the exact format that was drawn.
    assert!(exact.albedo < 1e-3 && packed.albedo > 1e-3, "{} and {}", exact.albedo, packed.albedo);
}

/// Whatever is found for each splat from what is beside it: ε, how much neighbors overlap, borders.
#[test]
fn pictures_of_ellipses_are_the_same_to_the_bit() {
    let mut headless = shared();
    for hard in [scenes::random_ellipses(Filter::Adjust), scenes::clipped(), bent(24, 4)] {
        let hard = with(&hard, |settings| settings.epsilon = Epsilon::Auto);
        let frames = [hard.clone(), packed(&hard)].map(|hard| render(&mut headless, &hard));
        assert!(frames[0].linear == frames[1].linear, "{}", hard.name);
    }
}

#[test]
fn packed_disks_have_half_the_bytes_and_the_rest_stays_exact() {
    let headless = shared();
    let prepare = |hard: &Hard| headless.prepare(&packed(hard).scene, &|_, _| {}).unwrap();
    let disks = prepare(&scenes::sphere_of_disks());
    assert!(disks.chunks().iter().all(|chunk| chunk.packed));
    // And of each block of 256 its bounds, for the ball is closed.
    assert_eq!(disks.bytes(), 20 * disks.splat_count() + 16 * disks.splat_count().div_ceil(256));
    assert!(prepare(&scenes::random_ellipses(Filter::Adjust)).chunks().iter().all(|chunk| !chunk.packed));

    // One point far off: all others would lose their digits. Farther off it has a chunk of its own.
    let mut stray = scenes::sphere_of_disks();
    stray.scene.objects[0].splats.positions[7] = DVec3::splat(100.0);
    assert!(!prepare(&stray).chunks()[0].packed);
    stray.scene.objects[0].splats.positions[7] = DVec3::splat(1e6);
    let prepared = prepare(&stray);
    let chunks = prepared.chunks();
    assert_eq!(
        chunks.iter().map(|chunk| (chunk.count > 1, chunk.packed)).collect::<Vec<_>>(),
        [(true, true), (false, true)]
    );
    // A color for all has all its bits.
    let mut disk = builder::Builder::default();
    disk.disk(DVec3::ZERO, DVec3::Z, 3.0, [0.5; 4]);
    let mut one = stray;
    one.scene = disk.scene(false);
    one.scene.objects[0].splats.colors = Colors::Uniform([0.123, 0.5, 0.7, 1.0]);
    let prepared = prepare(&one);
    assert!(prepared.chunks()[0].packed && prepared.bytes() == 16 + 8);
    drop((disks, prepared));
}
