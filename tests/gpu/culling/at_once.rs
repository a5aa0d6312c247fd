//! Closed objects of many blocks that are far and within the view: the host knows by one look how many of their splats may face the eye, and a device leaves out the blocks that don't.

use glam::DVec3;
use surfel::{
    hard_scenes::Hard,
    scene::{Cull, Epsilon, Filter, Rasterizer, TileMemory},
};

use super::{Differences, by, covered, draw};
use crate::common::{
    builder::{Builder, Random},
    passes, shared,
};

/// Splats that face outward, inward, anywhere, or in a few directions, about the middle of local space and beside it.
fn closed(random: &mut Random, round: usize) -> Hard {
    let mut builder = Builder::default();
    let few: Vec<DVec3> = (0..5).map(|_| random.direction()).collect();
    let (count, shift) = (1100 + (random.bits() % 4000) as usize, 0.6 * random.unit() * random.direction());
    for i in 0..count {
        let (at, other) = (random.direction(), random.direction());
        let normal = match round % 4 {
            0 => (at + 0.2 * other).normalize(),
            1 => (0.1 * other - at).normalize(),
            2 => other,
            _ => (few[i % 5] + 0.05 * other).normalize(),
        };
        let radius = 0.003 + 0.05 * random.unit().powi(6);
        builder.disk(at * random.between(0.4, 1.0) + shift, normal, radius, random.color());
    }
    let distance = 7.0 + 30.0 * random.unit().powi(3);
    let mut hard = Hard::seen_from((distance * random.direction()).to_array(), "far", builder.scene(true));
    hard.camera.fov_y_rad = 2.0 * (2.3 / distance).atan();
    hard.camera.orthographic_height = (round % 5 == 4).then_some(4.6);
    hard.settings.size_px = [96, 96];
    hard.settings.epsilon = Epsilon::Length(0.0);
    hard.settings.filter = [Filter::Adjust, Filter::None][round / 4 % 2];
    hard
}

/// With one splat a pixel, nothing depends on the order of sums.
#[test]
fn what_faces_the_eye_is_seen_however_it_is_found() {
    let mut headless = shared();
    let mut random = Random(79);
    let mut found = Differences::default();
    for round in 0..40 {
        let mut hard = closed(&mut random, round);
        for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective] {
            hard.settings.rasterizer = rasterizer;
            let listed = by(Cull::List, &hard.settings);
            let banded = surfel::scene::Settings { tile_memory: TileMemory::Most(1), ..listed.clone() };
            let [all, listed, banded] =
                draw(&mut headless, &hard, [by(Cull::Setup, &hard.settings), listed, banded]);
            assert!(passes(&listed).contains(&"mark visible splats") && covered(&all) > 0, "{round}");
            found.compare(&all, &listed, &format!("{round}"), rasterizer.name());
            found.compare(&all, &banded, &format!("{round}"), "bands");
        }
    }
    found.assert_none();
}
