//! By tiles: lists, what a tile's depth hides, corners of boxes, and the room of lists.

use glam::DVec3;
use surfel::{
    hard_scenes::Hard,
    scene::{Cull, Epsilon, Filter, Rasterizer, Settings, TileInvocations, TileMemory},
};

use super::{Differences, by, clouds::Shapes, covered, draw, hard_to_bound};
use crate::common::{
    builder::{Builder, Random, camera, settings},
    shared,
};

const FILTERS: [Filter; 4] = [Filter::Adjust, Filter::None, Filter::AdjustPaper, Filter::Ewa];

fn hard(random: &mut Random, round: usize) -> (Hard, String) {
    let filter = FILTERS[round % FILTERS.len()];
    let shapes = if filter == Filter::AdjustPaper { Shapes::Disks } else { Shapes::Ellipses };
    let (mut hard, what) = hard_to_bound(random, round / FILTERS.len(), shapes);
    let settings = super::settings_of(0, random);
    hard.settings = Settings {
        filter,
        rasterizer: Rasterizer::Compute,
        tile_invocations: TileInvocations::Column,
        ..settings
    };
    (hard, format!("{round}: {what}, {}", filter.name()))
}

/// A splat behind the eye, in a chunk of its own: where there is one, the host knows no bound of what all splats are in the image.
fn with_one_behind(hard: &Hard) -> Hard {
    let mut hard = hard.clone();
    let camera = &hard.camera;
    let behind = camera.eye - 0.1 * (camera.target - camera.eye);
    let mut builder = Builder::default();
    let tiny = 1e-3 * camera.eye.distance(camera.target) * DVec3::X;
    match hard.settings.filter {
        Filter::AdjustPaper => builder.disk(behind, DVec3::Z, tiny.x, [1.0; 4]),
        _ => builder.ellipse(behind, tiny, tiny.x * DVec3::Y, [1.0; 4]),
    }
    hard.scene.objects.push(builder.object(false));
    hard
}

/// With one splat a pixel, nothing depends on the order of sums.
#[test]
fn tiles_of_lists_and_of_any_room_show_the_same() {
    let mut headless = shared();
    let mut random = Random(73);
    let (mut seen, mut found) = (0, Differences::default());
    for round in 0..120 {
        let (mut hard, what) = hard(&mut random, round);
        hard.settings.epsilon = Epsilon::Length(0.0);
        let banded = Settings { tile_memory: TileMemory::Most(1), ..by(Cull::List, &hard.settings) };
        let [all, listed, banded] = draw(
            &mut headless,
            &hard,
            [by(Cull::Setup, &hard.settings), by(Cull::List, &hard.settings), banded],
        );
        found.compare(&all, &listed, &what, "list");
        found.compare(&all, &banded, &what, "bands");
        let unbounded = with_one_behind(&hard);
        let [unbounded] = draw(&mut headless, &unbounded, [by(Cull::Setup, &unbounded.settings)]);
        found.compare(&unbounded, &all, &what, "without a bound of sizes");
        seen += usize::from(covered(&all) > 0);
    }
    println!("{seen} scenes with something to see");
    found.assert_none();
    assert!(seen > 60, "{seen}");
}

/// A splat whose nearest point is as near as the near plane, but for rounding: if the host's bound is beyond it, it must be by more than a
/// device's rounding, for such a splat has no record.
#[test]
fn a_splat_that_touches_the_near_plane_is_not_lost() {
    let mut headless = shared();
    let (mut random, mut found, mut seen) = (Random(77), Differences::default(), 0);
    for round in 0..120 {
        let forward = random.direction();
        let side = forward.any_orthonormal_vector();
        let (eye, radius) = (-random.between(3.0, 5.0) * forward, random.between(0.3, 0.6) as f32);
        let mut builder = Builder::default();
        // As deep as it is wide, and beside the line of sight, so that its face is seen.
        let at = (random.between(0.3, 0.6) * side).as_vec3().as_dvec3();
        builder.disk(at, -side, radius.into(), random.color());
        // Where most are, local space begins: behind it, in whichever axes, so that the box of all is as near as it is.
        for _ in 0..4 {
            builder.disk(at + random.between(2.0, 3.0) * forward, forward, 1e-3, random.color());
        }
        let mut hard = Hard::seen_from(eye.to_array(), "at the near plane", builder.scene(false));
        let nearest = (at - eye).dot(forward) - f64::from(radius);
        hard.camera.near = Some(nearest * (1.0 - random.between(0.0, 3e-8)));
        let filter = [Filter::None, Filter::AdjustPaper][round % 2];
        hard.settings =
            Settings { filter, rasterizer: Rasterizer::Compute, cull: Cull::Setup, ..hard.settings };
        hard.settings.size_px = [64, 48];
        let [bounded] = draw(&mut headless, &hard, [hard.settings.clone()]);
        hard.settings.filter = Filter::AdjustPaper;
        let mut unbounded = with_one_behind(&hard);
        unbounded.settings.filter = filter;
        let [unbounded] = draw(&mut headless, &unbounded, [unbounded.settings.clone()]);
        seen += usize::from(covered(&unbounded) > 0);
        found.compare(&unbounded, &bounded, &format!("{round}"), "without a bound");
    }
    found.assert_none();
    assert!(seen > 60, "{seen}");
}

/// Both in one order, with all that belongs to a surface.
#[test]
fn tiles_show_the_same_without_what_is_hidden_and_with_tiles_of_either_height() {
    let mut headless = shared();
    let mut random = Random(74);
    let (mut seen, mut found) = (0, Differences::default());
    for round in 0..120 {
        let (hard, what) = hard(&mut random, round);
        let short =
            Settings { tile_invocations: TileInvocations::ShortColumn, ..by(Cull::List, &hard.settings) };
        let [listed, unhidden, short] = draw(
            &mut headless,
            &hard,
            [by(Cull::List, &hard.settings), by(Cull::Hidden, &hard.settings), short],
        );
        found.compare(&listed, &unhidden, &what, "hidden");
        found.compare(&listed, &short, &what, "short columns");
        seen += usize::from(covered(&listed) > 0);
    }
    println!("{seen} scenes with something to see");
    found.assert_none();
    assert!(seen > 60, "{seen}");
}

/// Disks whose rims pass through the center of the one pixel that they cover of a tile in a corner of their box, as near as f32 can tell:
/// whether they cover it is rounding, and the corner may be left out only where that cannot be. Of tiles twice as high the pixel is not
/// the last, so that they show what those of half the height lose.
#[test]
fn a_rim_that_may_cover_the_last_pixel_of_a_corner_is_drawn() {
    const SIDE_PX: u32 = 512;
    let mut headless = shared();
    let camera = camera([0.0, 0.0, 4.0], [0.0; 3]);
    let focal_px = camera.focal_px(SIDE_PX);
    let mut found = Differences::default();
    for (round, filter) in [(0, Filter::None), (1, Filter::None), (2, Filter::Adjust)] {
        let mut random = Random(75 + round);
        let mut builder = Builder::default();
        for i in 1..SIDE_PX / 8 - 3 {
            for j in 1..SIDE_PX / 8 - 3 {
                // The center of the last pixel of a row of tiles, and of the upper half of a tile.
                let pixel = [8 * i + 7, 8 * j + 3].map(|px| f64::from(px) + 0.5 - 0.5 * f64::from(SIDE_PX));
                let way = [(); 2].map(|()| random.between(3.0, 5.0));
                let center = [pixel[0] + way[0], pixel[1] + way[1]];
                let unit = 4.0 / focal_px;
                let at = DVec3::new(center[0] * unit, -center[1] * unit, 0.0).as_vec3().as_dvec3();
                let rim = DVec3::new(pixel[0] * unit, -pixel[1] * unit, 0.0);
                let h = if filter == Filter::None { 0.0 } else { 2.0_f64.sqrt() * unit };
                let radius = (at.distance_squared(rim) - h * h).sqrt();
                builder.disk(at, DVec3::Z, radius * (1.0 + random.between(-2e-7, 2e-7)), random.color());
            }
        }
        let settings = Settings {
            size_px: [SIDE_PX; 2],
            filter,
            rasterizer: Rasterizer::Compute,
            tile_invocations: TileInvocations::Column,
            ..settings()
        };
        let hard = Hard { name: "rims", scene: builder.scene(false), camera, settings: settings.clone() };
        let short = Settings { tile_invocations: TileInvocations::ShortColumn, ..settings.clone() };
        let [high, short] = draw(&mut headless, &hard, [settings, short]);
        found.compare(&high, &short, filter.name(), "short columns");
    }
    found.assert_none();
}
