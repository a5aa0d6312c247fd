//! What an invocation draws of a tile, a column, half a column or a pixel, changes no bit.

use super::{by, by_tiles, hard};
use crate::common::{ALL, PICTURE, assert_same_bits, headless, scenes, shared, with};
use glam::DVec3;
use surfel::{
    hard_scenes::{Hard, sphere, transparent},
    scene::{
        Accumulate, Colors, Cull, Filter, Layers, Scene, Settings, TileInvocations, TileMemory, Transition,
    },
};

/// Images of odd sizes, sums of 16 bits, data; splats that the graphics pipeline draws before, polygons beside, layers. An
/// invocation a pixel, which takes twenty times as long on a CPU, draws two of them.
#[test]
fn an_invocation_a_pixel_or_a_short_column_draws_the_same_bits_as_one_a_column() {
    let mut headless = shared();
    let near = || sphere(4000, DVec3::ZERO);
    let cloud = scenes::builder::camera([0.0, 0.0, 0.98], [0.3, 0.1, -1.0]);
    let cloud = Hard { name: "large splats", ..hard(vec![near()], cloud, [67, 35]) };
    let stacked = scenes::builder::camera([0.0, 0.0, 3.2], [0.0; 3]);
    let stacked = with(&hard(vec![near(), near()], stacked, [35, 67]), |s| s.accumulate = Accumulate::F16);
    let (own, short, pixel) = (TileInvocations::Column, TileInvocations::ShortColumn, TileInvocations::Pixel);
    let small = |hard: Hard| (with(&hard, |s| s.size_px = [64, 48]), vec![short]);
    // Every other scene is the self-test's.
    let hybrid = transparent::hybrid(Transition::Color);
    let scenes =
        [scenes::random_ellipses(Filter::Adjust), transparent::interpenetrating(), hybrid].map(small);
    for (hard, others) in
        scenes.into_iter().chain([(cloud, vec![short, pixel]), (stacked, vec![short, pixel])])
    {
        let columns = by_tiles(&mut headless, &by(&hard, own), ALL);
        for other in others {
            let drawn = by_tiles(&mut headless, &by(&hard, other), ALL);
            assert_same_bits(&columns, &drawn, &format!("{} {other:?}", hard.name));
        }
    }
}

#[test]
fn an_invocation_a_pixel_draws_the_same_bits_in_every_pass() {
    let mut headless = shared();
    let eye = |x, z| scenes::builder::camera([x, 0.0, z], [0.0; 3]);
    let balls = |x| vec![sphere(8000, DVec3::ZERO), sphere(8000, DVec3::new(x, 0.0, 0.0))];
    let overflow = hard(vec![sphere(560_000, DVec3::ZERO)], eye(0.0, 900.0), [16, 16]);
    let hidden = with(&hard(balls(-2.5), eye(6.0, 0.0), [64, 48]), |s| s.cull = Cull::Hidden);
    let bands = |s: &mut Settings| s.tile_memory = TileMemory::Most(0);
    let bands = with(&hard(vec![sphere(24_000, DVec3::ZERO)], eye(0.0, 3.2), [64, 96]), bands);
    let mut lit = hidden.clone();
    (lit.scene.meshes, lit.scene.lights) = {
        let Scene { meshes, lights, .. } = transparent::meshes_only().scene;
        (meshes, lights)
    };
    let mut layers = hidden.clone();
    layers.settings.layers = Layers::Fixed(5);
    for ball in &mut layers.scene.objects {
        ball.splats.colors = Colors::Uniform([0.9, 0.1, 0.1, 0.4]);
    }
    let all =
        [("overflow", overflow), ("hidden", hidden), ("bands", bands), ("lit", lit), ("layers", layers)];
    for (name, hard) in all {
        for wanted in [ALL, PICTURE] {
            let [columns, pixels] = [TileInvocations::Column, TileInvocations::Pixel]
                .map(|own| by_tiles(&mut headless, &by(&hard, own), wanted));
            assert_same_bits(&columns, &pixels, name);
        }
    }
    let pipelines = headless.renderer.shaders().pipeline_names();
    assert!(pipelines.iter().any(|name| name.ends_with("pixel_hidden.comp")), "{pipelines:?}");
}

/// A frame has the pipelines of one way.
#[test]
fn what_draws_columns_has_no_pipeline_of_pixels() {
    let mut headless = headless();
    let camera = scenes::builder::camera([0.0, 0.0, 3.2], [0.0; 3]);
    let hard = hard(vec![sphere(500, DVec3::ZERO)], camera, [64, 64]);
    for (invocations, has_pixels) in [(TileInvocations::Column, false), (TileInvocations::Pixel, true)] {
        by_tiles(&mut headless, &by(&hard, invocations), PICTURE);
        let names = headless.renderer.shaders().pipeline_names();
        assert_eq!(names.iter().any(|name| name.contains("_pixel")), has_pixels, "{names:?}");
    }
}
