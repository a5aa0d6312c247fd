//! Nothing that is left out would have been seen: random scenes that try each bound of a block, a list, a tile or a box, drawn with the
//! bound and without it, and compared byte for byte.
//!
//! Points: `--cull setup` has no bound but a splat's own box, `list` those of blocks and of single splats, `hidden` that of depth, too.
//! By tiles `list` sums in another order, so that there each pixel has one splat only (ε = 0), which no order changes. Tiles have no
//! switch for two bounds: what is left out of a tile's corners is compared between tiles of two heights, whose corners are others;
//! and the sizes for which lists have room between a scene and the same with a splat behind the eye, which has no bound.

mod at_once;
mod clouds;
mod tiles;

use glam::DVec3;
use surfel::{
    hard_scenes::Hard,
    renderer::{Frame, Headless},
    scene::{Backfaces, Cull, Epsilon, Filter, Rasterizer, Settings},
};

use crate::common::{
    ALL,
    builder::{Builder, Random, camera, settings},
    compare, passes, shared, with,
};
use clouds::{Shapes, hard_to_bound};

/// The pictures of one scene under several settings.
fn draw<const N: usize>(headless: &mut Headless, hard: &Hard, settings: [Settings; N]) -> [Frame; N] {
    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    settings.map(|settings| headless.render(&prepared, &hard.camera, &settings, ALL).unwrap())
}

fn by(cull: Cull, settings: &Settings) -> Settings {
    Settings { cull, ..settings.clone() }
}

fn covered(frame: &Frame) -> usize {
    frame.weight.iter().filter(|weight| **weight > 0.0).count()
}

/// The pictures that are not the same, all of them.
#[derive(Default)]
struct Differences(Vec<String>);

impl Differences {
    fn compare(&mut self, a: &Frame, b: &Frame, what: &str, how: &str) {
        let different = compare::different_values(a, b);
        if different > 0 {
            let [a, b] = [covered(a), covered(b)];
            self.0.push(format!("{what}, {how}: {different} values, {a} and {b} px covered"));
        }
    }

    fn assert_none(&self) {
        assert!(self.0.is_empty(), "{} differ:\n{}", self.0.len(), self.0.join("\n"));
    }
}

/// Compares all ways to leave out; the pixels that are covered without any.
fn compare_points(headless: &mut Headless, hard: &Hard, what: &str, found: &mut Differences) -> usize {
    let [all, listed, unhidden] =
        draw(headless, hard, [Cull::Setup, Cull::List, Cull::Hidden].map(|cull| by(cull, &hard.settings)));
    assert!(!passes(&all).contains(&"mark visible splats"));
    found.compare(&all, &listed, what, "list");
    found.compare(&all, &unhidden, what, "hidden");
    covered(&all)
}

/// Scenes and settings for each round: filters and rasterizers in turn.
fn settings_of(round: usize, random: &mut Random) -> Settings {
    let filter = Filter::NAMES[round % Filter::NAMES.len()].1;
    // Each of the others compiles its own shaders: with one filter.
    let others = [
        Rasterizer::PerspectivePaper,
        Rasterizer::Raycast,
        Rasterizer::RaycastApproximate,
        Rasterizer::AffineCenter,
        Rasterizer::AffineContour,
    ];
    let (filter, rasterizer) = match round % 10 {
        9 => ([Filter::None, Filter::Adjust][round / 50 % 2], others[round / 10 % 5]),
        _ => (filter, Rasterizer::Perspective),
    };
    let backfaces = [Backfaces::Cull, Backfaces::Cull, Backfaces::Auto, Backfaces::Flip];
    let epsilon = [Epsilon::Radii(1.0), Epsilon::Radii(0.01), Epsilon::Length(0.0), Epsilon::Length(1e-4)];
    Settings {
        size_px: [64, 48],
        filter,
        rasterizer,
        backfaces: backfaces[random.bits() as usize % 4],
        epsilon: epsilon[random.bits() as usize % 4],
        ..settings()
    }
}

/// Blocks, by their balls and cones; single splats; what the visible depth hides.
#[test]
fn points_that_are_left_out_would_not_have_been_seen() {
    let mut headless = shared();
    let mut random = Random(71);
    let (mut seen, mut empty, mut found) = (0, 0, Differences::default());
    for round in 0..300 {
        let settings = settings_of(round, &mut random);
        let shapes = if settings.filter == Filter::AdjustPaper { Shapes::Disks } else { Shapes::Ellipses };
        let (mut hard, what) = hard_to_bound(&mut random, round / 5, shapes);
        hard.settings = settings;
        let what =
            format!("{round}: {what}, {} {}", hard.settings.rasterizer.name(), hard.settings.filter.name());
        match compare_points(&mut headless, &hard, &what, &mut found) {
            0 => empty += 1,
            _ => seen += 1,
        }
    }
    println!("{seen} scenes with something to see, {empty} without");
    found.assert_none();
    assert!(seen > 150, "{seen}");
}

/// Ellipses that face away, and one that does not, whose tangent vectors are nearly parallel.
fn nearly_parallel(sine: f64) -> Hard {
    let mut builder = Builder::default();
    for i in 0..200 {
        let at = DVec3::new(f64::from(i % 20) - 9.5, f64::from(i / 20) - 4.5, 0.0) * 0.05;
        builder.ellipse(at, 0.02 * DVec3::X, -0.02 * DVec3::Y, [0.5, 0.5, 0.5, 1.0]);
    }
    builder.ellipse(DVec3::ZERO, 0.8 * DVec3::X, DVec3::new(0.8, 0.8 * sine, 0.0), [1.0; 4]);
    let settings = Settings { size_px: [64, 48], backfaces: Backfaces::Cull, ..settings() };
    Hard {
        name: "nearly parallel",
        scene: builder.scene(false),
        camera: camera([0.0, 0.0, 3.0], [0.0; 3]),
        settings,
    }
}

/// A cone of normals holds those that are known to a few degrees only.
#[test]
fn nearly_parallel_tangents_do_not_narrow_a_cone_of_normals() {
    let mut headless = shared();
    let mut found = Differences::default();
    for sine in [0.1, 0.9e-3, 1e-4, 1e-5, 1e-6] {
        let hard = nearly_parallel(sine);
        let what = format!("sine {sine}");
        assert!(compare_points(&mut headless, &hard, &what, &mut found) > 40, "{what}");
        let by_tiles = with(&hard, |settings| {
            (settings.rasterizer, settings.epsilon) = (Rasterizer::Compute, Epsilon::Length(0.0));
        });
        let [all, listed] = draw(
            &mut headless,
            &by_tiles,
            [Cull::Setup, Cull::List].map(|cull| by(cull, &by_tiles.settings)),
        );
        found.compare(&all, &listed, &what, "by tiles");
    }
    found.assert_none();
}

/// With the eye in the middle of a block and the near plane where its splats end, the reserve for rounding is that of their distances
/// from there.
#[test]
fn the_eye_in_the_middle_of_a_block_leaves_out_nothing_that_is_beyond_near() {
    let mut headless = shared();
    let (mut random, mut found) = (Random(72), Differences::default());
    for round in 0..40 {
        let mut builder = Builder::default();
        let toward = random.direction().as_vec3().as_dvec3();
        // Most are at the eye, so that their local space begins there.
        for _ in 0..5 {
            builder.disk(DVec3::ZERO, toward, 1e-9, [1.0; 4]);
        }
        for side in [-1.0, 1.0] {
            builder.disk(side * toward, -side * toward, 1e-9, [1.0; 4]);
        }
        let mut hard = Hard {
            name: "",
            scene: builder.scene(false),
            camera: camera([0.0; 3], [1.0; 3]),
            settings: settings(),
        };
        hard.settings.size_px = [64, 48];
        (hard.camera.target, hard.camera.up) = (toward, random.direction());
        // Between the exact depth and what f32 may make of it.
        hard.camera.near = Some(toward.length() * (1.0 + random.between(0.0, 1e-7)));
        compare_points(&mut headless, &hard, &format!("{round}"), &mut found);
    }
    found.assert_none();
}
