//! Scenes that come, go and move from frame to frame.

use glam::{
    DMat4, DQuat, DVec3, DVec4,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    Settings,
    embed::{HostCamera, Placed, Placement},
    math::random::SplitMix,
    scene::{ClipPlanes, Edges, Epsilon, Light, LightKind, Scene, Shading},
};

use super::{Beside, REVERSED, SIZE_PX};
use crate::{
    common::{ran_alone, scenes},
    memory::live_bytes,
};

const CAMERA_AT: DVec3 = DVec3::new(0.4, 0.9, 6.0);

/// Behind all that is seen.
const BEHIND: [DVec3; 3] =
    [DVec3::new(-90.0, -60.0, -30.0), DVec3::new(90.0, -60.0, -30.0), DVec3::new(0.0, 90.0, -30.0)];

fn camera() -> HostCamera {
    HostCamera {
        view_from_world: look_at_mat4(CAMERA_AT, DVec3::ZERO, DVec3::Y),
        clip_from_view: directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5),
        flips_y: true,
    }
}

/// The same by parallel rays.
fn parallel() -> HostCamera {
    let reversed =
        DMat4::from_cols(DVec4::X, DVec4::Y, DVec4::new(0.0, 0.0, -1.0, 0.0), DVec4::new(0.0, 0.0, 1.0, 1.0));
    let clip_from_view = reversed * directx::orthographic(-2.4, 2.4, -1.8, 1.8, 0.5, 90.0);
    HostCamera { clip_from_view, ..camera() }
}

/// A placed scene is the scene whose splats, lengths of epsilon and lights were moved; planes are the world's.
#[test]
fn placed_scenes_are_seen_as_if_they_had_been_uploaded_there() {
    let at = Placement {
        rotation: DQuat::from_axis_angle(DVec3::new(1.0, 1.0, 0.3).normalize(), 0.8),
        scale: 1.4,
        translation: DVec3::new(0.5, -0.3, 0.2),
    };
    let matrix =
        glam::DAffine3::from_scale_rotation_translation(DVec3::splat(at.scale), at.rotation, at.translation);
    let own = scenes::sphere(1500, DVec3::new(0.3, 0.2, 0.0));
    let mut moved = own.clone();
    moved.splats = own.splats.clone().transformed(&matrix);
    let sun = DVec3::new(0.3, -1.0, -0.4);
    let lit = |direction| Light { kind: LightKind::Directional(direction), color: [0.9, 0.8, 0.5] };
    let scene = |object, direction, epsilon| Scene {
        objects: vec![object],
        epsilons: vec![Some(Epsilon::Length(epsilon))],
        lights: vec![lit(direction)],
        ..Scene::default()
    };
    // A third of a radius, so that it matters which splats are of the nearest surface.
    let epsilon = 0.02;
    let [own, moved] = [scene(own, sun, epsilon), scene(moved, at.rotation * sun, at.scale * epsilon)];
    let mut beside = Beside::new(REVERSED);
    let [own, moved] = [own, moved].map(|scene| beside.upload(&scene));
    // How much of a pixel an edge covers follows from overlaps, which are measured on a grid of the world's axes.
    let hard = Settings { size_px: SIZE_PX, edges: Edges::Hard, ..Settings::default() };
    let plane = ClipPlanes([[0.4, 0.9, 0.1, 0.1]].into());
    let cut = Settings { clip_planes: plane, ..hard.clone() };
    let mut seen = Vec::new();
    for (name, camera, settings) in [
        ("perspective", camera(), &hard),
        ("perspective, cut", camera(), &cut),
        ("parallel", parallel(), &hard),
        ("parallel, cut", parallel(), &cut),
    ] {
        let mut picture = |placed: &[Placed<'_>]| {
            beside.draw(placed, &camera, settings, &BEHIND, false);
            (beside.engine.pixels(), beside.engine.depths())
        };
        let (placed, depths) = picture(&[Placed::new(&own, at)]);
        let (uploaded, expected_depths) = picture(&[Placed::at_home(&moved)]);
        let difference = |one: &[[f32; 4]], other: &[[f32; 4]]| {
            one.iter().flatten().zip(other.iter().flatten()).filter(|(a, b)| (*a - *b).abs() > 1e-3).count()
        };
        let far = difference(&placed, &uploaded);
        let near = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-5 * b.abs();
        let same = depths.iter().zip(&expected_depths).filter(|pair| near(*pair)).count();
        println!(
            "{name}: {far} values differ by more than 1e-3, {} depths by more than 1e-5",
            depths.len() - same
        );
        assert!(far < 40 && same + 30 > depths.len(), "{name}: {far} {same}");
        // Once more, far off and out of sight: it does not shine twice.
        let away = Placement { translation: DVec3::new(0.0, 0.0, 1e3), ..at };
        let (twice, _) = picture(&[Placed::new(&own, at), Placed::new(&own, away)]);
        assert!(difference(&placed, &twice) < 40, "{name}");
        seen.push(placed);
    }
    // What is told of has an effect.
    for i in 1..seen.len() {
        assert!(seen[..i].iter().all(|other| *other != seen[i]), "{i}");
    }
    drop((own, moved));
    beside.end();
}

/// Objects are uploaded and dropped at random, and stand wherever they do. What is there after half of the frames suffices for the other half, which is the same once more: of the device's
/// memory in use and taken from it, and of the heap.
fn memory_after(test: &str, frames: usize) {
    // Where nothing else is allocated meanwhile.
    if ran_alone(test, &[]) {
        return;
    }
    let settings = Settings { size_px: SIZE_PX, shading: Shading::Lambert, ..Settings::default() };
    let mut beside = Beside::new(REVERSED);
    let mut random = SplitMix(5);
    let (mut balls, mut most) = (Vec::new(), [[0; 3]; 2]);
    let (mut added, mut removed) = (0, 0);
    for number in 0..frames {
        if number == frames / 2 {
            random = SplitMix(5);
            balls.clear();
        }
        let what = random.unit();
        if what < 0.3 && balls.len() < 5 {
            let ball = scenes::sphere(100 + (2000.0 * random.unit()) as usize, DVec3::ZERO);
            balls.push(beside.upload(&Scene { objects: vec![ball], ..Scene::default() }));
            added += 1;
        } else if what > 0.7 && !balls.is_empty() {
            balls.swap_remove((balls.len() as f64 * random.unit()) as usize);
            removed += 1;
        }
        let count = if balls.is_empty() { 0 } else { (5.0 * random.unit()) as usize };
        let placed: Vec<_> = (0..count)
            .map(|_| {
                let mut unit = || 2.0 * random.unit() - 1.0;
                let translation = 1.5 * DVec3::new(unit(), unit(), unit());
                let at = Placement { translation, scale: 0.6 + 0.4 * unit(), ..Placement::default() };
                Placed::new(&balls[(balls.len() as f64 * random.unit()) as usize], at)
            })
            .collect();
        beside.draw(&placed, &camera(), &settings, &BEHIND, false);
        let now = [beside.device.memory_in_use().0, beside.device.memory_held(), live_bytes() as u64];
        let most = &mut most[usize::from(number >= frames / 2)];
        for (most, now) in most.iter_mut().zip(now) {
            *most = (*most).max(now);
        }
    }
    println!(
        "{frames} frames, {added} objects added, {removed} removed: at most {:?} and {:?} bytes of the device, held, and of the heap",
        most[0], most[1]
    );
    assert!(added > frames / 10 && removed > frames / 10);
    // A view keeps what it has compiled for 64 kinds of frames, and few frames are not enough to have met as many.
    let room = if frames < 5000 { [0, 0, 1 << 16] } else { [0; 3] };
    let grown = [0, 1, 2].map(|i| most[1][i].saturating_sub(most[0][i]));
    assert!(grown.iter().zip(room).all(|(grown, room)| *grown <= room), "{grown:?} bytes more");
    drop(balls);
    beside.end();
}

#[test]
fn memory_does_not_grow_as_scenes_come_and_go() {
    memory_after("beside::changing::memory_does_not_grow_as_scenes_come_and_go", 400);
}

/// Minutes: `cargo test --release --test gpu ten_thousand -- --ignored --nocapture`.
#[test]
#[ignore = "minutes of frames"]
fn memory_does_not_grow_in_ten_thousand_frames() {
    memory_after("beside::changing::memory_does_not_grow_in_ten_thousand_frames", 10_000);
}
