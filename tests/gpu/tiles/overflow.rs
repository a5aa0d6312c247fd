//! Tiles with more splats than one dispatch takes: none is lost, in one pass, in parts and in layers.

use super::{by, by_points, by_tiles, different, hard, shaded::is_shaded_as_by_sums};
use crate::common::{ALL, PICTURE, assert_same_bits, passes, scenes, shared, with};
use glam::DVec3;
use surfel::{
    hard_scenes::sphere,
    scene::{
        Accumulate, Colors, Edges, Epsilon, FilterWeight, LastLayer, Layers, Light, LightKind, Order,
        TileInvocations,
    },
};

/// llvmpipe ends a shader's loops after 65 535 iterations of eight splats without a word: here a tile has more.
#[test]
fn a_tile_with_more_splats_than_a_shader_has_iterations_loses_none() {
    let mut headless = shared();
    let camera = scenes::builder::camera([0.0, 0.0, 900.0], [0.0; 3]);
    let hard = hard(vec![sphere(560_000, DVec3::ZERO)], camera, [16, 16]);
    let points = by_points(&mut headless, &hard, ALL);
    let seen = points.weight.iter().filter(|weight| **weight > 0.0).count();
    assert!((4..=64).contains(&seen), "{seen}");
    let tiles = by_tiles(&mut headless, &hard, ALL);
    assert!(passes(&tiles).contains(&"sum overflow tiles"));
    let short = by_tiles(&mut headless, &by(&hard, TileInvocations::ShortColumn), ALL);
    assert_same_bits(&tiles, &short, "tiles half as high");
    // Half a million weights are added in another order: 2^-24 of the sum each, at random.
    for (a, b) in tiles.weight.iter().zip(&points.weight) {
        assert!((a - b).abs() <= 1e-3 * b, "{a} {b}");
    }
    assert_eq!(different(&tiles, &points), 0);
}

/// Tiles with more splats than one dispatch takes are shaded after the others: here a ball in the middle of one, beside a tile
/// with few, and another ball where four tiles meet.
#[test]
fn overflow_tiles_are_shaded_as_by_their_sums() {
    let mut headless = shared();
    let camera = scenes::builder::camera([0.0, 0.0, 900.0], [0.0; 3]);
    // A pixel of 24 along a side is 31 units wide there.
    let colored = |count, x, y, color| {
        let mut ball = sphere(count, DVec3::new(31.0 * x, 31.0 * y, 0.0));
        ball.splats.colors = Colors::Uniform(color);
        ball
    };
    for (invocations, color) in
        [(TileInvocations::Column, None), (TileInvocations::ShortColumn, Some([0.5, 0.3, 0.4]))]
    {
        let balls = vec![
            colored(260_000, -8.0, 8.0, [0.8, 0.1, 0.1, 1.0]),
            colored(1000, 8.0, -8.0, [0.1, 0.8, 0.1, 1.0]),
            colored(260_000, 4.0, 4.0, [0.1, 0.1, 0.8, 1.0]),
        ];
        let mut hard = by(&hard(balls, camera, [24, 24]), invocations);
        hard.scene.lights = color.map(|color| Light { kind: LightKind::Eye, color }).into_iter().collect();
        assert!(is_shaded_as_by_sums(&mut headless, &hard), "{invocations:?}");
        let frame = by_tiles(&mut headless, &hard, PICTURE);
        assert!(passes(&frame).contains(&"shade overflow tiles"), "{invocations:?}");
        assert_eq!(different(&frame, &by_points(&mut headless, &hard, PICTURE)), 0, "{invocations:?}");
        assert!(frame.linear.iter().filter(|color| **color != frame.linear[0]).count() >= 3);
    }
}

/// In layers the first tiles do all of them at once, others go on from dispatch to dispatch, and what has too many splats for that
/// goes step by step and part by part. Lights are a loop within a loop.
#[test]
fn layers_of_overflow_tiles_lose_none() {
    let mut headless = shared();
    // Means don't tell how many splats there are: those at the end of a tile's list have another color.
    let clear = |count| {
        let mut object = sphere(count, DVec3::ZERO);
        let color = |i: usize| if i / 32 % 32 < 20 { [0.9, 0.1, 0.1, 0.4] } else { [0.1, 0.9, 0.2, 0.4] };
        object.splats.colors = Colors::Each((0..count).map(color).collect());
        object
    };
    let near = scenes::builder::camera([0.0, 0.0, 4.0], [0.0; 3]);
    let far = scenes::builder::camera([0.0, 0.0, 600.0], [0.0; 3]);
    for (name, count, camera, size_px, layers, lights, last_layer) in [
        ("one dispatch", 3000, near, [96, 96], 5, 0, LastLayer::Stack),
        ("several dispatches", 3000, near, [64, 64], 40, 2, LastLayer::Drop),
        ("parts", 560_000, far, [16, 16], 3, 0, LastLayer::Drop),
        ("parts under lights", 100_000, far, [16, 16], 2, 16, LastLayer::Stack),
    ] {
        let mut hard = hard(vec![clear(count)], camera, size_px);
        hard.scene.storage.order = Order::Input;
        let direction = |i| LightKind::Directional(DVec3::new(f64::from(i), 1.0, -2.0));
        let light = |i| Light { kind: direction(i), color: [0.1, 0.1, 0.1] };
        hard.scene.lights = (0..lights).map(light).collect();
        (hard.settings.layers, hard.settings.last_layer) = (Layers::Fixed(layers), last_layer);
        let [tiles, points] = [by_tiles, by_points].map(|draw| draw(&mut headless, &hard, PICTURE));
        assert!(passes(&tiles).contains(&"layers of tiles"), "{:?}", passes(&tiles));
        let may_be_off = if count == 3000 { tiles.linear.len() / 200 } else { 0 };
        assert!(different(&tiles, &points) <= may_be_off, "{name}: {}", different(&tiles, &points));
    }
}

/// Where edges are covered in part, what a tile with many splats shows of a ball is what one with few does, of one surface and in layers.
#[test]
fn edges_of_overflow_tiles_cover_what_those_of_others_do() {
    let mut headless = shared();
    let camera = scenes::builder::camera([0.0, 0.0, 900.0], [0.0; 3]);
    // Over several tiles, none of which overflows, and within one.
    for (alpha, fov_y_rad) in [(1.0, 0.02), (1.0, 0.08), (0.4, 0.02), (0.4, 0.08)] {
        let [few, many] = [4_000, 560_000].map(|count| {
            let mut ball = sphere(count, DVec3::new(3.0, 5.0, 0.0));
            ball.splats.colors = Colors::Uniform([0.8, 0.1, 0.1, alpha]);
            let mut hard = hard(vec![ball], camera, [64, 64]);
            (hard.settings.edges, hard.settings.background) = (Edges::Coverage, None);
            hard.camera.fov_y_rad = fov_y_rad;
            by_tiles(&mut headless, &hard, PICTURE)
        });
        let overflows = |frame| passes(frame).iter().any(|pass| pass.contains("overflow"));
        assert!(overflows(&many) && !overflows(&few), "{:?}", passes(&many));
        let off = few.linear.iter().zip(&many.linear).map(|(a, b)| (a[3] - b[3]).abs());
        let in_part =
            many.linear.iter().filter(|color| color[3] > 0.05 * alpha && color[3] < 0.95 * alpha).count();
        let worst = off.fold(0.0, f32::max);
        println!("alpha {alpha}, {fov_y_rad}: {in_part} pixels are covered in part, {worst} off at most");
        assert!(in_part >= 8 && worst < 0.1 * alpha, "{in_part} {worst}");
    }
}

/// Half floats end at 65504: more than that many splats of weight 1 in a pixel, in one dispatch, in parts, and beside large splats.
#[test]
fn sums_beyond_half_floats_keep_their_ratios() {
    let mut headless = shared();
    for (count, large) in [(560_000, false), (150_000, false), (150_000, true)] {
        let mut objects = vec![sphere(count, DVec3::ZERO)];
        if large {
            // Cut by the near plane, far beside what is seen.
            objects.push(sphere(500, DVec3::new(0.0, 0.0, 900.0)));
        }
        let mut hard = hard(objects, scenes::builder::camera([0.0, 0.0, 900.0], [0.0; 3]), [16, 16]);
        (hard.settings.filter_weight, hard.settings.epsilon) = (FilterWeight::Unit, Epsilon::Radii(1e6));
        let [exact, half] = [Accumulate::F32, Accumulate::F16]
            .map(|sums| by_tiles(&mut headless, &with(&hard, |s| s.accumulate = sums), PICTURE));
        for (a, b) in exact.linear.iter().flatten().zip(half.linear.iter().flatten()) {
            assert!(b.is_finite() && (a - b).abs() <= 0.01, "{count}, {large}: {a} {b}");
        }
    }
}
