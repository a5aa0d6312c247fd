//! Whose the surface is that is seen in a pixel, and how it has moved, against the oracle.

mod truth;

use glam::{
    DMat4, DQuat, DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    Settings,
    embed::{HostCamera, NO_ID, PassFigures, Placed, Placement, PreparedScene, ViewFrame},
    graph::execute::Profile,
    reference::{self, Picker},
    scene::{DepthOfHost, Edges, Mesh, MeshObject, Rasterizer, Scene, Shading},
};
use truth::{TIE, in_world, motion, owner};

use super::{Beside, FORWARD, REVERSED, SIZE_PX, engine::Style};
use crate::{
    common::{moves_corners, scenes},
    memory::ALLOCATIONS,
};

/// Cuts the ball.
const CORNERS: [DVec3; 3] =
    [DVec3::new(-30.0, -20.0, 12.0), DVec3::new(30.0, -20.0, 3.0), DVec3::new(0.0, 30.0, -14.0)];

/// Behind all that is seen.
const BEHIND: [DVec3; 3] =
    [DVec3::new(-90.0, -60.0, -30.0), DVec3::new(90.0, -60.0, -30.0), DVec3::new(0.0, 90.0, -30.0)];

/// The numbers that the engine gives.
const IDS: [u32; 3] = [7, 4_000_000_000, 3];

fn look(at: DVec3, clip_from_view: DMat4) -> HostCamera {
    HostCamera { view_from_world: look_at_mat4(at, DVec3::ZERO, DVec3::Y), clip_from_view, flips_y: true }
}

/// Two conventions, each of a camera and the one before, which was elsewhere and had another jitter.
fn conventions() -> Vec<(&'static str, Style, [HostCamera; 2])> {
    let (now, before) = (DVec3::new(0.4, 0.9, 4.0), DVec3::new(0.1, 1.2, 4.3));
    let jittered = |x: f64, y: f64, projection| {
        DMat4::from_translation(DVec3::new(x / 160.0, y / 120.0, 0.0)) * projection
    };
    let infinite = directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5);
    let parallel = directx::orthographic(-1.9, 1.9, -1.425, 1.425, 0.5, 20.0);
    let tells = |style| Style { tells_objects: true, ..style };
    vec![
        (
            "reversed and infinite",
            tells(REVERSED),
            [look(now, jittered(0.3, -0.2, infinite)), look(before, jittered(-0.1, 0.4, infinite))],
        ),
        ("parallel, forward", tells(FORWARD), [look(now, parallel), look(before, parallel)]),
    ]
}

/// Where the objects stand, and stood: two balls that cut each other, and one behind.
fn places() -> [[Placement; 2]; 3] {
    let turned = |angle: f64, scale, x, z| Placement {
        rotation: DQuat::from_axis_angle(DVec3::new(0.2, 1.0, 0.1).normalize(), angle),
        scale,
        translation: DVec3::new(x, 0.1 * angle, z),
    };
    [
        [turned(0.5, 0.8, -0.4, 0.0), turned(0.35, 0.75, -0.5, 0.1)],
        [turned(-0.2, 0.7, 0.5, 0.3), turned(-0.2, 0.7, 0.5, 0.3)],
        [turned(1.0, 0.6, 0.9, -1.4), turned(1.3, 0.6, 0.7, -1.2)],
    ]
}

fn placed<'a>(scene: &'a PreparedScene, places: &[[Placement; 2]]) -> Vec<Placed<'a>> {
    let of = |([at, before], id): (&[Placement; 2], u32)| Placed {
        before: Some(*before),
        id,
        ..Placed::new(scene, *at)
    };
    places.iter().zip(IDS).map(of).collect()
}

fn settings(rasterizer: Rasterizer, edges: Edges) -> Settings {
    Settings { size_px: SIZE_PX, edges, rasterizer, shading: Shading::Albedo, ..Settings::default() }
}

#[test]
fn pixels_tell_whose_they_are_and_how_far_they_moved_as_the_oracle_does() {
    let own = scenes::sphere(2500, DVec3::new(0.1, 0.0, -0.05));
    let places = places();
    let whole = in_world(&own, &places);
    let scene = Scene { objects: vec![own], ..Scene::default() };
    for (name, style, cameras) in conventions() {
        let mut beside = Beside::new(style);
        let prepared = beside.upload(&scene);
        let scenes = placed(&prepared, &places);
        for rasterizer in
            [Rasterizer::Compute, Rasterizer::Perspective, Rasterizer::Quad, Rasterizer::Triangle]
        {
            let settings = settings(rasterizer, Edges::Hard);
            // Where the device moves corners to a grid of 1/256 pixel, depth is that of a place beside, and 16 times as deep a pixel as wide near rims.
            let moves_corners = rasterizer == Rasterizer::Triangle && moves_corners(beside.renderer.device());
            let of_corners_px = if moves_corners { 16.0 / 256.0 } else { 0.0 };
            let [now, before] = &cameras;
            beside.draw_after(&scenes, [now, before], &settings, &CORNERS, false);
            let ((ids, moved), written) = (beside.engine.told(), beside.engine.depths());
            let pixels = beside.engine.pixels();

            let (camera, depth_of) = now.camera(SIZE_PX).unwrap();
            let plain = Settings { background: None, ..settings.clone() };
            let picture = reference::render(&whole, &camera, &plain, &|_, _| {}).unwrap();
            let picker = Picker::new(&whole, &camera, &plain).unwrap();
            let (mut of_object, mut exempt, mut worst, mut farthest) = ([0; 3], 0, 0.0_f64, 0.0_f64);
            for i in 0..ids.len() {
                if pixels[i] == super::RED || pixels[i] == [0.0; 4] {
                    assert!(ids[i] == 0 && moved[i] == [0.0; 2], "{name}, pixel {i}: nothing is there");
                    continue;
                }
                let exact = &picture.pixels[i];
                let object = IDS.iter().position(|id| *id == ids[i]);
                let object = object
                    .unwrap_or_else(|| panic!("{name}, {rasterizer:?}, pixel {i}: {} is nobody's", ids[i]));
                let at = [i % SIZE_PX[0] as usize, i / SIZE_PX[0] as usize].map(|at| at as u32);
                let owner = owner(&picker.at(at), exact.depth);
                if owner.is_none() || exact.rim || exact.epsilon_margin < TIE {
                    exempt += 1;
                    continue;
                }
                assert_eq!(Some(object), owner, "{name}, {rasterizer:?}, pixel {i}");
                of_object[object] += 1;
                let depth = |z: f64| match depth_of {
                    DepthOfHost::Perspective { a, b } => a + b / z,
                    DepthOfHost::Orthographic { a, b } => a + b * z,
                };
                let of = |z: f64| motion([now, before], i, depth(z), &places[object]);
                let (expected, shaken) = (of(exact.depth), of(exact.depth * (1.0 + 2.0_f64.powi(-19))));
                for axis in 0..2 {
                    let off = (f64::from(moved[i][axis]) - expected[axis]).abs();
                    // What the depth's roundings move; places of 160 pixels, rounded some ten times.
                    let tolerance =
                        (shaken[axis] - expected[axis]).abs() + 160.0 * 2.0_f64.powi(-20) + of_corners_px;
                    worst = worst.max(off / tolerance);
                    assert!(
                        off <= tolerance,
                        "{name}, {rasterizer:?}, pixel {i}: {:?} for {expected:?}",
                        moved[i]
                    );
                    farthest = farthest.max(expected[axis].abs());
                }
                assert!(written[i] != f64::from(beside.engine.style.clear_depth));
            }
            println!(
                "{name}, {rasterizer:?}: {of_object:?} pixels of objects, {exempt} exempt, motion up to {farthest:.1} pixels within {worst:.2} of the tolerance"
            );
            assert!(
                of_object.iter().all(|count| *count > 150) && 30 * exempt < of_object.iter().sum::<usize>()
            );
            assert!(farthest > 5.0);
        }
        drop(prepared);
        beside.end();
    }
}

/// Where edges cover pixels in part, ids are where depth is, and theirs: what is drawn with one object alone at that place tells.
#[test]
fn at_edges_ids_are_where_depth_is_and_transparent_things_leave_them() {
    let own = scenes::sphere(2500, DVec3::ZERO);
    let (_, style, [camera, _]) = conventions().swap_remove(0);
    let mut clear = own.clone();
    clear.splats.colors = surfel::scene::Colors::Uniform([0.2, 0.4, 0.9, 0.3]);
    let mesh = Mesh {
        positions: vec![DVec3::new(-1.5, -1.0, -0.6), DVec3::new(1.5, -1.0, 0.2), DVec3::new(0.0, 1.6, -0.2)],
        triangles: vec![[0, 1, 2]],
        normals: Some(vec![glam::Vec3::Z; 3]),
        colors: surfel::scene::Colors::Uniform([0.9, 0.6, 0.1, 1.0]),
    };
    let scene = |objects, meshes| Scene { objects, meshes, ..Scene::default() };
    let mesh = MeshObject { name: "triangle".to_owned(), mesh, closed: false };
    let mut beside = Beside::new(style);
    let ball = beside.upload(&scene(vec![own], Vec::new()));
    let triangle = beside.upload(&scene(Vec::new(), vec![mesh]));
    let veil = beside.upload(&scene(vec![clear], Vec::new()));
    let in_front = Placement {
        translation: camera.camera(SIZE_PX).unwrap().0.eye * 0.3,
        scale: 0.5,
        ..Placement::default()
    };
    let opaque = [
        Placed { id: 1, ..Placed::new(&ball, Placement { scale: 0.8, ..Placement::default() }) },
        Placed { id: 2, ..Placed::at_home(&triangle) },
    ];
    let all = [opaque[0], Placed { id: 3, ..Placed::new(&veil, in_front) }, opaque[1]];
    for rasterizer in [Rasterizer::Auto, Rasterizer::Perspective] {
        let settings = settings(rasterizer, Edges::Coverage);
        let mut told = |scenes: &[Placed<'_>]| {
            beside.draw(scenes, &camera, &settings, &BEHIND, true);
            (beside.engine.told().0, beside.engine.depths(), beside.engine.pixels())
        };
        let (_, nothing, _) = told(&[]);
        let (ids, depths, seen) = told(&opaque);
        let alone = [told(&opaque[..1]).1, told(&opaque[1..]).1];
        let mut count = [0; 4];
        let mut strange = 0;
        for i in 0..ids.len() {
            assert_eq!(ids[i] != 0, depths[i] != nothing[i], "{rasterizer:?}, pixel {i}");
            assert_ne!(ids[i], NO_ID, "{rasterizer:?}, pixel {i}");
            count[ids[i] as usize] += 1;
            // The depth is that of its object drawn alone, but where they blend, or cover a pixel together.
            strange +=
                u32::from(ids[i] > 0 && (depths[i] - alone[ids[i] as usize - 1][i]).abs() > 2e-3 * depths[i]);
        }
        println!("{rasterizer:?}: {count:?} pixels, {strange} of which two have a part");
        assert!(count[1] > 1000 && count[2] > 1000 && strange < 150, "{count:?} {strange}");
        let (with_veil, depths_behind, veiled) = told(&all);
        let others = ids.iter().zip(&with_veil).filter(|(one, other)| one != other).count();
        let lighter = seen.iter().zip(&veiled).filter(|(one, other)| one != other).count();
        assert!(depths == depths_behind);
        assert!(
            others == 0 && lighter > 1000,
            "{rasterizer:?}: transparent layers are nobody's: {others} {lighter}"
        );
    }
    drop((ball, triangle, veil));
    beside.end();
}

/// Numbers and motion take one pass more where they are asked for, and where they are not none, whatever objects have.
#[test]
fn what_is_not_asked_for_takes_no_pass() {
    let own = Scene { objects: vec![scenes::sphere(2500, DVec3::ZERO)], ..Scene::default() };
    let (_, tells, [camera, before]) = conventions().swap_remove(0);
    let mut besides = [REVERSED, tells].map(Beside::new);
    for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective] {
        let settings = settings(rasterizer, Edges::Hard);
        let [plain, told] = [0, 1].map(|style| {
            let beside = &mut besides[style];
            let ball = beside.upload(&own);
            let scenes = placed(&ball, &places());
            let frame = ViewFrame {
                camera_before: Some(&before),
                profile: Some(Profile::Times),
                ..ViewFrame::new(&scenes, &camera, &settings)
            };
            beside.engine.begin();
            let Beside { view, renderer, engine, .. } = &mut *beside;
            // SAFETY: recording; all is alive until the wait.
            unsafe { view.prepare(renderer, engine.commands, &frame) }.unwrap();
            engine.begin_rendering(true);
            engine.end_rendering();
            beside.submit();
            // SAFETY: the frame has finished.
            let profile = unsafe { beside.view.profile() }.unwrap().unwrap();
            let (mut figures, before) = (0, ALLOCATIONS.get());
            let tell = |pass: PassFigures<'_>| {
                let other = &profile.passes[figures];
                assert_eq!((pass.name, pass.secs, pass.counts), (&*other.name, other.secs, other.counts));
                figures += 1;
            };
            // SAFETY: as above.
            let span_secs = unsafe { beside.view.each_pass(tell) }.unwrap();
            assert_eq!((figures, ALLOCATIONS.get() - before), (profile.passes.len(), 0));
            let sum: f64 = profile.passes.iter().map(|pass| pass.secs.unwrap()).sum();
            assert!(span_secs == profile.span_secs && (sum - span_secs.unwrap()).abs() < 1e-3 * sum, "{sum}");
            let passes = profile.passes;
            passes.into_iter().map(|pass| pass.name).collect::<Vec<_>>()
        });
        let more: Vec<_> = told.iter().filter(|name| !plain.contains(name)).collect();
        println!("{rasterizer:?}: {} passes, and {more:?}", plain.len());
        assert!(more == ["objects"] && told.len() == plain.len() + 1, "{plain:?} {told:?}");
    }
    besides.into_iter().for_each(Beside::end);
}
