//! How many splats of which levels are drawn: those that the hierarchy selects, and no more than a budget.

use glam::DVec3;
use surfel::{
    geometry::hierarchy::{Hierarchy, Levels, Projection},
    load::builtin,
    math::random::SplitMix,
    scene::{Backfaces, Budget, Camera, ClipBox, ClipPlanes, Lod, LodSteps, Settings},
};

use super::{ball, listed};
use crate::common::{shared, with};

/// Each decides alone, in 32 bits, from bounds of 32 bits. Sizes within 1e-5 of τ may be taken for either: one more or less each.
#[test]
fn what_is_drawn_is_what_the_hierarchy_selects() {
    let mut headless = shared();
    let mut random = SplitMix(5);
    let mut hard = with(&ball(20_000, 1.0), |settings| settings.backfaces = Backfaces::Flip);
    let hierarchy = Hierarchy::build(&hard.scene.objects[0].splats, &()).unwrap();
    let mut drawn = Vec::new();
    for (round, tau_px) in [0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0].into_iter().cycle().take(28).enumerate() {
        let direction = DVec3::new(random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5).normalize();
        let orthographic_height = (round % 3 == 2).then_some(4.0);
        let eye = direction * (4.0 + 6.0 * random.unit());
        hard.camera = Camera { eye, orthographic_height, ..hard.camera };
        hard.settings.lod = Lod::Px(tau_px);
        let projection = Projection::of_camera(&hard.camera, hard.settings.size_px[1], &hierarchy);
        let count = |tau_px: f64| {
            let selection = hierarchy.select(&projection, tau_px);
            (selection.nodes.len() + selection.leaves.len()) as u64
        };
        let near = [1.0 - 1e-5, 1.0 + 1e-5].map(|part| count(part * tau_px));
        let found = listed(&mut headless, &hard);
        println!("round {round}: {tau_px} px, {found} drawn, {near:?} selected");
        assert!(near[1] <= found && found <= near[0], "round {round}: {found} of {near:?}");
        drawn.push(found);
    }
    assert!(drawn.iter().any(|drawn| *drawn < 200) && drawn.iter().any(|drawn| *drawn > 10_000), "{drawn:?}");
}

/// What has a weight, and nothing else: nodes from half an octave above τ on, and those below them until the node is no larger than τ.
#[test]
fn what_is_blended_is_what_has_a_weight() {
    let mut headless = shared();
    let mut random = SplitMix(6);
    let mut hard = with(&ball(20_000, 1.0), |settings| {
        (settings.backfaces, settings.lod_steps) = (Backfaces::Flip, LodSteps::Blend);
    });
    let hierarchy = Hierarchy::build(&hard.scene.objects[0].splats, &()).unwrap();
    let mut blended = 0;
    for (round, tau_px) in [0.5, 1.0, 2.0, 8.0].into_iter().cycle().take(16).enumerate() {
        let direction = DVec3::new(random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5).normalize();
        let orthographic_height = (round % 3 == 2).then_some(4.0);
        hard.camera =
            Camera { eye: (4.0 + 6.0 * random.unit()) * direction, orthographic_height, ..hard.camera };
        hard.settings.lod = Lod::Px(tau_px);
        let projection = Projection::of_camera(&hard.camera, hard.settings.size_px[1], &hierarchy);
        // With both bounds moved by as much.
        let count = |room: f64| {
            let sizes = (tau_px * room, LodSteps::BLENDED / room.powi(2));
            let has_weight = |levels: Levels| projection.weight(&levels, sizes.0, sizes.1) > 0.0;
            let nodes = (0..hierarchy.tree.len()).filter(|&i| has_weight(hierarchy.node_levels(i))).count();
            (nodes + (0..hierarchy.order.len()).filter(|&i| has_weight(hierarchy.leaf_levels(i))).count())
                as u64
        };
        let near = [1.0 - 1e-5, 1.0 + 1e-5].map(count);
        let found = listed(&mut headless, &hard);
        let hard_steps = with(&hard, |settings| settings.lod_steps = LodSteps::Hard);
        let without = listed(&mut headless, &hard_steps);
        println!("round {round}: {tau_px} px, {found} drawn, {near:?} have a weight; {without} without");
        assert!(near[1] <= found && found <= near[0], "round {round}: {found} of {near:?}");
        assert!(without <= found, "round {round}: {found}, {without} without");
        blended += found - without;
    }
    assert!(blended > 1000, "{blended}");
}

/// As many as there may be, and nearly all of these, from wherever it is seen, and of what planes leave of a surface that is seen from inside then; the more
/// there may be, the smaller sizes are.
#[test]
fn a_budget_is_kept_and_filled() {
    let headless = shared();
    let mut random = SplitMix(9);
    let mut hard = ball(1, 0.0);
    hard.scene.objects = vec![builtin::relief(400_000)];
    (hard.scene.levels, hard.scene.budget) = (true, true);
    hard.settings.size_px = [512, 512];
    // In one band, whose list is of all that is drawn.
    hard.settings.tile_memory = surfel::scene::TileMemory::Most(1 << 33);
    let whole = hard.scene.ball().unwrap();
    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    let mut least: f64 = 1.0;
    for round in 0..36 {
        let mut any =
            || DVec3::new(random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5).normalize();
        let direction = any();
        if round >= 30 {
            let normal = any();
            let plane =
                normal.extend(0.3 * whole.radius * f64::from(round as u32 % 3) - normal.dot(whole.center));
            let half = 0.5 * whole.radius;
            let corners = [whole.center - half, whole.center + 2.0 * half].map(|corner| corner.to_array());
            (hard.settings.clip_planes, hard.settings.clip_box) = match round % 4 {
                3 => (ClipPlanes::default(), ClipBox(Some(corners))),
                _ => (ClipPlanes([plane.to_array()].into()), ClipBox::default()),
            };
        }
        let distance = [3.0, 1.6, 6.0][round % 3] * whole.radius;
        let orthographic_height = (round % 5 == 4).then_some(1.5 * whole.radius);
        hard.camera = Camera {
            eye: whole.center + distance * direction,
            target: whole.center,
            orthographic_height,
            ..Camera::default()
        };
        hard.settings.lod_steps = if round % 2 == 0 { LodSteps::Hard } else { LodSteps::Blend };
        for most in [4_000, 20_000, 60_000] {
            let in_use =
                |settings: &Settings| match headless.count_listed(&prepared, &hard.camera, settings).unwrap()
                {
                    0 => 400_000,
                    listed => listed,
                };
            let all = in_use(&hard.settings);
            let drawn = in_use(&Settings { budget: Budget::Splats(most), ..hard.settings.clone() });
            let share = drawn as f64 / f64::from(most);
            println!("round {round}: {drawn} of {most}, {all} in all");
            assert!(share <= 1.0, "round {round}: {drawn} of {most}");
            assert!(share >= 0.98 || all <= u64::from(most), "round {round}: {drawn} of {most}");
            least = if all > u64::from(most) { least.min(share) } else { least };
        }
    }
    println!("{least} of a budget at least");
}
