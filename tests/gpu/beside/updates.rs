//! Splats of an uploaded scene that change, against an upload of what they have become.

use glam::{
    DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    Settings,
    embed::{HostCamera, Placed, PreparedScene},
    scene::{Colors, Edges, Order, Rasterizer, Scene, Shapes, Splats, Storage},
};

use super::{Beside, REVERSED, SIZE_PX};
use crate::common::scenes;

pub(super) const BEHIND: [DVec3; 3] =
    [DVec3::new(-90.0, -60.0, -30.0), DVec3::new(90.0, -60.0, -30.0), DVec3::new(0.0, 90.0, -30.0)];

pub(super) const COUNT: usize = 4000;

pub(super) fn camera() -> HostCamera {
    HostCamera {
        view_from_world: look_at_mat4(DVec3::new(0.4, 0.9, 6.0), DVec3::ZERO, DVec3::Y),
        clip_from_view: directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5),
        flips_y: true,
    }
}

/// A ball of many colors.
fn ball() -> Splats {
    let mut splats = scenes::sphere(COUNT, DVec3::ZERO).splats;
    let of = |at: &DVec3| {
        let [r, g, b] = (0.5 * at.as_vec3() + 0.5).clamp(glam::Vec3::ZERO, glam::Vec3::ONE).to_array();
        [r, g, b, 1.0]
    };
    splats.colors = Colors::Each(splats.positions.iter().map(of).collect());
    splats
}

/// Some of these splats.
fn part(splats: &Splats, range: std::ops::Range<usize>) -> Splats {
    let keep: Vec<_> = (0..splats.len()).map(|i| range.contains(&i)).collect();
    let mut part = splats.clone();
    part.keep(&keep);
    part
}

fn scene(splats: Splats, order: Order) -> Scene {
    let mut object = scenes::sphere(3, DVec3::ZERO);
    object.splats = splats;
    let storage = Storage { order, ..Storage::default() };
    Scene { objects: vec![object], updatable: true, storage, ..Scene::default() }
}

/// Other colors and radii: all lies where it lay, so that an upload has the same order and space.
fn recolored(splats: &mut Splats, range: std::ops::Range<usize>) {
    let (Colors::Each(colors), Shapes::Disks { radii, .. }) = (&mut splats.colors, &mut splats.shapes) else {
        panic!("disks of colors of their own")
    };
    for i in range {
        colors[i] = [0.9, 0.1 + 0.0001 * i as f32, 0.2, 1.0];
        radii[i] *= 0.9;
    }
}

/// Far out of the ball, and of all bounds that were known.
fn moved(splats: &mut Splats, range: std::ops::Range<usize>) {
    for i in range {
        splats.positions[i] = 0.5 * splats.positions[i] + DVec3::new(1.4, 0.8, 0.3);
    }
}

fn settings(rasterizer: Rasterizer) -> Settings {
    Settings { size_px: SIZE_PX, edges: Edges::Hard, rasterizer, ..Settings::default() }
}

fn far(one: &[f32; 4], other: &[f32; 4]) -> bool {
    (0..4).any(|i| (one[i] - other[i]).abs() > 1.0 / 255.0)
}

/// Records updates, submits them by themselves, and draws.
fn update(beside: &Beside, scene: &mut PreparedScene, first: usize, splats: &Splats) {
    beside.engine.begin();
    // SAFETY: recording; submitted at once.
    unsafe { beside.renderer.update(beside.engine.commands, scene, 0, first as u32, splats) }.unwrap();
    beside.engine.begin_rendering(true);
    beside.engine.end_rendering();
    beside.submit();
}

#[test]
fn updated_splats_are_seen_as_an_upload_of_them_is() {
    let camera = camera();
    let mut beside = Beside::new(REVERSED);
    for order in [Order::Input, Order::Morton] {
        let mut splats = ball();
        let mut updated = beside.upload(&scene(splats.clone(), order));
        let range = 700..2100;
        let picture = |beside: &mut Beside, scene: &PreparedScene, rasterizer| {
            beside.draw(&[Placed::at_home(scene)], &camera, &settings(rasterizer), &BEHIND, false);
            (beside.engine.pixels(), beside.engine.depths())
        };
        let both = [Rasterizer::Compute, Rasterizer::Perspective];
        let before = both.map(|rasterizer| picture(&mut beside, &updated, rasterizer));
        recolored(&mut splats, range.clone());
        update(&beside, &mut updated, range.start, &part(&splats, range.clone()));
        let fresh = beside.upload(&scene(splats.clone(), order));
        for (rasterizer, before) in both.into_iter().zip(&before) {
            let [seen, expected] = [&updated, &fresh].map(|scene| picture(&mut beside, scene, rasterizer));
            assert!(seen == expected && seen != *before, "{order:?}, {rasterizer:?}");
        }
        // One by one, and elsewhere: of another upload the order along the curve is another, and so are roundings.
        moved(&mut splats, range.clone());
        for first in range.clone().step_by(100) {
            update(&beside, &mut updated, first, &part(&splats, first..first + 100));
        }
        let fresh = beside.upload(&scene(splats.clone(), order));
        for rasterizer in both {
            let [(seen, _), (expected, _)] =
                [&updated, &fresh].map(|scene| picture(&mut beside, scene, rasterizer));
            let others = seen.iter().zip(&expected).filter(|(one, other)| far(one, other)).count();
            let there = expected.iter().filter(|color| **color != super::RED).count();
            println!("{order:?}, {rasterizer:?}: {others} of {there} pixels differ by more than 1/255");
            assert!(others <= 12 && there > 1800, "{others} {there}");
        }
        // And back.
        let splats = ball();
        update(&beside, &mut updated, range.start, &part(&splats, range.clone()));
        for (rasterizer, before) in both.into_iter().zip(&before) {
            assert!(
                picture(&mut beside, &updated, rasterizer) == *before,
                "{order:?}, {rasterizer:?}: as it was"
            );
        }
        // From out of sight, by bounds that were there: nobody would look for them.
        let mut away = ball();
        range.clone().for_each(|i| away.positions[i].x += 40.0);
        let mut updated = beside.upload(&scene(away, order));
        update(&beside, &mut updated, range.start, &part(&splats, range));
        for (rasterizer, (before, _)) in both.into_iter().zip(&before) {
            let (seen, _) = picture(&mut beside, &updated, rasterizer);
            let others = seen.iter().zip(before).filter(|(one, other)| far(one, other)).count();
            println!("{order:?}, {rasterizer:?}: {others} pixels differ of what came into sight");
            assert!(others <= 12, "{others}");
        }
    }
    beside.end();
}

/// Each frame some, in the commands that draw them; and nothing is kept of what they went through.
#[test]
fn updates_in_the_commands_of_a_frame_are_seen_in_it_and_take_nothing() {
    let camera = camera();
    let settings = settings(Rasterizer::Compute);
    let mut beside = Beside::new(REVERSED);
    let mut updated = beside.upload(&scene(ball(), Order::Morton));
    let mut splats = ball();
    let mut memory = Vec::new();
    let (mut last, mut changes) = (Vec::new(), 0);
    for frame in 0..60 {
        let first = 100 * std::cmp::min(frame, 39);
        let range = first..first + 100;
        recolored(&mut splats, range.clone());
        let part = part(&splats, range);
        beside.engine.begin();
        let Beside { view, renderer, engine, .. } = &mut beside;
        // SAFETY: recording; all is alive until the wait.
        unsafe { renderer.update(engine.commands, &mut updated, 0, first as u32, &part) }.unwrap();
        let scenes = [Placed::at_home(&updated)];
        let shown = surfel::embed::ViewFrame::new(&scenes, &camera, &settings);
        // SAFETY: as above.
        unsafe { view.prepare(renderer, engine.commands, &shown) }.unwrap();
        engine.begin_rendering(true);
        // SAFETY: inside of the rendering that the view was made for.
        unsafe { view.draw(renderer, engine.commands) }.unwrap();
        engine.end_rendering();
        // Behind what reads them, too: the layer would tell if that were not waited for.
        // SAFETY: as above.
        unsafe { renderer.update(engine.commands, &mut updated, 0, first as u32, &part) }.unwrap();
        beside.submit();
        let seen = beside.engine.pixels();
        let others = last.iter().zip(&seen).filter(|(one, other)| one != other).count();
        changes += u32::from(others > 0);
        last = seen;
        memory.push(beside.device.memory_in_use());
    }
    // Those of the side that is seen. Lists grow with what they hold; what the last ones went through is not kept.
    assert!(changes > 15, "{changes}");
    assert!(memory[41..].iter().all(|held| *held == memory[41]), "{:?}", &memory[40..]);
    drop(updated);
    beside.end();
}
