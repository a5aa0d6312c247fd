//! Limits of the device, large lists, chunks, order, and sizes of the image: N6, N18, N22, N29.

use glam::DVec3;
use surfel::{
    renderer::{Frame, Headless, Wanted},
    scene::{Accumulate, Filter, Order, Settings},
};

use super::{GRAY, hard, of_size};
use crate::common::{
    assert_agrees, assert_same_bits,
    builder::{Builder, Random, camera, settings},
    compare::{self, compare},
    passes, render, render_as,
    scenes::{self, Hard},
    shared, with_limits, with_points_up_to,
};

fn lists_large(frame: &Frame) -> bool {
    passes(frame).contains(&"list large splats")
}

/// One splat `length_px` long in an image that is 2600 pixels along one side.
fn long(length_px: f64, along_x: bool) -> Hard {
    let size_px = if along_x { [2600, 40] } else { [40, 2600] };
    let mut camera = camera([0.0, 0.0, 3.0], [0.0; 3]);
    camera.fov_y_rad = 2.0 * (f64::from(size_px[1]) / 5200.0).atan(); // focal length 2600 px
    let pixel = 3.0 / 2600.0;
    let mut builder = Builder::default();
    let (major, minor) = (0.5 * length_px * pixel, 8.3 * pixel);
    let (s, t) = match along_x {
        true => (DVec3::X * major, DVec3::Y * minor),
        false => (DVec3::Y * major, DVec3::X * minor),
    };
    builder.ellipse(DVec3::new(0.37 * pixel, 0.21 * pixel, 0.0), s, t, GRAY);
    let settings = Settings { size_px, filter: Filter::None, ..settings() };
    Hard { name: "one long splat", scene: builder.scene(false), camera, settings }
}

#[test]
fn n06_splats_of_every_size_around_the_limits_agree_as_points_and_as_quads() {
    let mut headless = shared();
    for length_px in [63.0, 64.0, 65.0, 253.0, 254.0, 255.0, 256.0, 2047.0, 2048.0] {
        for along_x in [true, false] {
            let hard = long(length_px, along_x);
            let (own, oracle) = assert_agrees(&mut headless, &hard, 500);
            for cap_px in [0.0, 1.0, 64.0] {
                let other = with_points_up_to(&mut headless, cap_px, |headless| render(headless, &hard));
                let beyond = compare(&other, &oracle).beyond(&compare::F32.of_at_least(500));
                assert!(beyond.is_empty(), "{length_px} px, cap {cap_px}: {beyond:?}");
                assert_same_bits(&own, &other, &format!("{length_px} px, cap {cap_px}"));
            }
        }
    }
}

#[test]
fn n06_whole_scenes_agree_whatever_the_largest_point() {
    let mut headless = shared();
    let scenes =
        [scenes::sphere_of_disks(), scenes::random_ellipses(Filter::Adjust), scenes::cut_by_the_near_plane()];
    for hard in scenes {
        let (_, oracle) = assert_agrees(&mut headless, &hard, 1000);
        for cap_px in [0.0, 1.0, 8.0, 16.0, 64.0] {
            let frame = with_points_up_to(&mut headless, cap_px, |headless| render(headless, &hard));
            assert!(lists_large(&frame) || cap_px > 8.0, "{}: no list at {cap_px}", hard.name);
            let beyond = compare(&frame, &oracle).beyond(&compare::F32);
            assert!(beyond.is_empty(), "{}: cap {cap_px}: {beyond:?}", hard.name);
        }
    }
}

#[test]
fn n06_a_list_of_more_than_65536_large_splats_is_whole_and_in_order() {
    let mut headless = shared();
    let mut random = Random(6);
    let mut builder = Builder::default();
    // More than 256 blocks of 256, and not a multiple of either. Eight in a row at one place, so that each two neighbors in
    // the list meet in some pixel.
    let mut place = DVec3::ZERO;
    for i in 0..70_123 {
        if i % 8 == 0 {
            place =
                DVec3::new(random.between(-1.2, 1.2), random.between(-1.2, 1.2), random.between(-0.2, 0.2));
        }
        builder.disk(place.as_vec3().as_dvec3(), DVec3::Z, 0.02, random.color());
    }
    // Sums of 16 bits over hundreds of fragments depend on their order.
    let rounded = Settings {
        accumulate: Accumulate::F16,
        epsilon: surfel::scene::Epsilon::Length(100.0),
        ..of_size(64)
    };
    let exact = Settings { accumulate: Accumulate::F32, ..rounded.clone() };
    let mut many = hard("70123 splats", builder, rounded);
    many.scene.storage.order = Order::Input;
    let points = render(&mut headless, &many);
    assert!(!lists_large(&points));
    let quads = |headless: &mut Headless, hard: &Hard| {
        with_points_up_to(headless, 0.0, |headless| render(headless, hard))
    };
    let listed = quads(&mut headless, &many);
    let splats = &mut many.scene.objects[0].splats;
    splats.positions.reverse();
    let surfel::scene::Colors::Each(colors) = &mut splats.colors else { panic!("built with colors") };
    colors.reverse();
    let reversed = render(&mut headless, &many);
    // Points and quads are set up by different shaders, whose last bits may differ and now and then turn a rounding to 16
    // bits. Another order turns most of them.
    let changed = |other: &Frame| {
        let both = points.albedo.iter().zip(&other.albedo);
        both.filter(|(a, b)| a != b).count() as f64 / points.albedo.len() as f64
    };
    println!("pixels that differ: {:.4} listed, {:.4} reversed", changed(&listed), changed(&reversed));
    assert!(changed(&listed) < 0.02 && changed(&reversed) > 0.3);

    many.settings = exact;
    let (_, oracle) = assert_agrees(&mut headless, &many, 1000);
    let errors = compare(&quads(&mut headless, &many), &oracle);
    println!("{}", errors.row("70123 splats, listed"));
    assert!(errors.beyond(&compare::F32).is_empty(), "{:?}", errors.beyond(&compare::F32));
}

#[test]
fn a_scene_in_many_chunks_gives_the_same_picture() {
    let mut headless = shared();
    for hard in [scenes::sphere_of_disks(), scenes::random_ellipses(Filter::Adjust), scenes::ground()] {
        for splats in [1000, 77] {
            let chunks = with_limits(
                &mut headless,
                |limits| limits.max_storage_buffer_range = 48 * splats + 47,
                |headless| {
                    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
                    assert!(prepared.chunks().iter().all(|chunk| u64::from(chunk.count) <= splats));
                    let counted: u64 = prepared.splat_count();
                    assert_eq!(counted, hard.scene.splat_count() as u64);
                    // Not bit by bit as in one chunk: each has an origin of its own, nearer to its splats.
                    assert_agrees(headless, &hard, 1000);
                    prepared.chunks().len()
                },
            );
            let expected = hard.scene.splat_count().div_ceil(splats as usize);
            assert_eq!(chunks, expected, "{}", hard.name);
        }
    }
}

/// Uploads are made in batches of 65 536: what is left out in one moves the next.
#[test]
fn a_chunk_of_several_batches_with_splats_left_out_agrees() {
    let mut headless = shared();
    let mut hard = scenes::sphere_of_disks();
    let mut object = scenes::sphere(150_000, DVec3::ZERO);
    for i in (0..object.splats.len()).step_by(7) {
        object.splats.positions[i].x = f64::NAN;
    }
    // And a batch of which nothing is left.
    object.splats.positions[65_536..131_072].fill(DVec3::NAN);
    hard.scene.objects = vec![object];
    // Along the curve what is left out comes last.
    for order in [Order::Input, Order::Morton] {
        hard.scene.storage.order = order;
        let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
        assert_eq!(prepared.chunks().len(), 1);
        assert_eq!(prepared.splat_count(), (150_000 - 65_536) * 6 / 7);
        assert_agrees(&mut headless, &hard, 1000);
    }
}

#[test]
fn n18_a_frame_repeated_twenty_times_gives_the_same_bits() {
    let mut headless = shared();
    for (accumulate, cap_px) in [(Accumulate::F16, 255.0), (Accumulate::F32, 255.0), (Accumulate::F16, 10.0)]
    {
        let mut hard = scenes::random_ellipses(Filter::Adjust);
        hard.settings.accumulate = accumulate;
        let repeat = |headless: &mut Headless| {
            let first = render(headless, &hard);
            for run in 1..20 {
                assert_same_bits(&first, &render(headless, &hard), &format!("run {run}, {accumulate:?}"));
            }
        };
        with_points_up_to(&mut headless, cap_px, repeat);
    }
}

#[test]
fn n22_a_large_quad_covers_a_large_target() {
    let mut headless = shared();
    let mut builder = Builder::default();
    builder.disk(DVec3::ZERO, DVec3::new(0.1, 0.2, 1.0).normalize(), 50.0, GRAY);
    let settings = Settings {
        size_px: [4096, 2048],
        accumulate: Accumulate::F16,
        shading: surfel::scene::Shading::Albedo,
        ..settings()
    };
    let hard = hard("large target", builder, settings);
    let frame = render_as(&mut headless, &hard, Wanted { picture: true, ..Wanted::default() });
    assert_eq!(frame.srgb.len(), 4096 * 2048);
    // Linear 0.5 is 187.5 in sRGB; 16 bits are good to half a step there.
    let wrong = frame.srgb.iter().filter(|color| color[..3].iter().any(|c| !(187..=188).contains(c)));
    assert_eq!(wrong.count(), 0);
}

#[test]
fn n29_images_of_every_odd_shape_agree() {
    let mut headless = shared();
    for size_px in [[1, 1], [2, 1], [3, 5], [1, 300], [300, 1], [257, 63], [63, 257], [127, 129]] {
        let mut hard = scenes::sphere_of_disks();
        hard.settings.size_px = size_px;
        // So near that the image is full, and the borders too.
        hard.camera.eye = DVec3::new(0.3, 0.2, 1.6);
        assert_agrees(&mut headless, &hard, 1);
    }
}
