//! Levels of detail from the top of a tree down to its blocks.

use glam::{DVec3, Vec3};

use super::{tests::look_at_one, *};
use crate::{
    arena::Arena,
    math::random::SplitMix,
    passes::plan::{draws::draws, range::DepthRange},
    prepare::{Placed, PreparedScene, prepare_without_device},
    scene::{Camera, Colors, Lod, LodSteps, Object, Scene, Settings, Shapes, Splats},
    vk::Limits,
};

/// An open ball with levels of detail, whose disks differ in size from place to place.
fn ball(count: usize) -> PreparedScene {
    let mut random = SplitMix(4);
    let mut side = || 2.0 * random.unit() - 1.0;
    let mut direction = || loop {
        let v = DVec3::new(side(), side(), side());
        if (0.1..1.0).contains(&v.length()) {
            return v.normalize();
        }
    };
    let positions: Vec<DVec3> = (0..count).map(|_| direction()).collect();
    let normals: Vec<Vec3> = positions.iter().map(|at| at.as_vec3()).collect();
    let radii = normals.iter().map(|normal| 0.01 * 2.0_f32.powf(2.0 * normal.x)).collect();
    let splats = Splats::new(positions, Shapes::Disks { normals, radii }, Colors::Uniform([1.0; 4]));
    let objects = vec![Object { name: "ball".to_owned(), splats, closed: false }];
    prepare_without_device(&Limits::plain(), &Scene { objects, levels: true, ..Scene::default() }).unwrap()
}

/// What has something to draw is in a run, what is known of a run holds for each of its blocks, little is listed for nothing, and the largest box is that of the blocks.
#[test]
fn levels_of_detail_are_those_of_the_blocks() {
    let prepared = ball(60_000);
    let (mut wanted, mut listed, mut looked_over, mut as_wholes) = (0_usize, 0_usize, 0_usize, 0_usize);
    let mut counts = [0_u64; 2];
    let settings = |lod, lod_steps| Settings { size_px: [640, 480], lod, lod_steps, ..Settings::default() };
    for eye in [[0.0, 0.0, 3.0], [1.0, 0.3, 1.2], [-9.0, 1.0, 0.2], [40.0, 0.0, 0.0]].map(DVec3::from) {
        for (lod, steps) in [(0.7, LodSteps::Hard), (3.0, LodSteps::Blend), (30.0, LodSteps::Hard)] {
            let settings = settings(Lod::Px(lod), steps);
            let camera = Camera { eye, target: DVec3::new(0.0, 0.1, 0.0), ..Camera::default() };
            let range = DepthRange::of(&[Placed::at_home(&prepared)], &camera);
            let (camera, limits, planned) = (range.begin(&camera), Limits::plain(), Arena::new());
            for draw in draws(&planned, Placed::at_home(&prepared), (&camera, range), &settings, &limits) {
                let (arena, chunk, look) = (Arena::new(), draw.chunk, draw.look());
                let view = draw.levels.as_ref().expect("levels");
                let blocks =
                    || chunk.blocks.iter().map(|block| block.levels.as_deref().expect("levels").bounds);
                let drawn = blocks().filter(|bounds| view.of(bounds) != OfBlock::None);
                let boxes_px = drawn.map(|bounds| view.largest_box_px(&bounds, look.bound.filter_px));
                if view.part.stands_for_others() {
                    let most_px = boxes_px.fold(0.0, f64::max);
                    assert_eq!(view.largest_drawn_px(&chunk.tree, look.bound.filter_px), most_px, "{eye}");
                }
                let runs = draw.potentially_visible_runs(&arena);
                assert!(runs.is_sorted_by_key(|run| run.first));
                counts[0] += runs.iter().map(|run| u64::from(run.count)).sum::<u64>();
                for (number, block) in (0..).zip(&chunk.blocks) {
                    let run = runs.iter().find(|run| (run.first..run.first + run.blocks).contains(&number));
                    listed += usize::from(run.is_some());
                    let Some(own) = look_at_one(number, block, &look) else {
                        looked_over += usize::from(run.is_none());
                        continue;
                    };
                    wanted += 1;
                    counts[1] += u64::from(own.count);
                    let run = run.unwrap_or_else(|| panic!("{eye}, {lod}: block {number} is left out"));
                    let is_all = blocks().nth(number as usize).is_some_and(|of| view.of(&of) == OfBlock::All);
                    let knows_more = run.all_of_level && !is_all || run.all_seen && !own.all_seen;
                    assert!(!knows_more && own.box_px <= run.box_px, "{eye}, {lod}: {own:?} of {run:?}");
                    as_wholes += usize::from(run.blocks > 1);
                }
            }
        }
    }
    println!(
        "{wanted} blocks wanted, {listed} listed, {looked_over} not, {as_wholes} in runs; {counts:?} splats"
    );
    assert!(as_wholes > 50 && looked_over > 500, "{as_wholes} {looked_over}");
    assert!(listed * 10 <= wanted * 11 && counts[0] * 20 <= counts[1] * 21, "{listed} {wanted} {counts:?}");
}
