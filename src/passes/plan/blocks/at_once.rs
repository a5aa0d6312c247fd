//! One look at all blocks of a chunk, where that is enough.

use glam::DVec3;

use super::walk::run_of_all;
use crate::{
    arena::Arena,
    passes::plan::{FramePlan, draws::draws, range::DepthRange},
    prepare::{Placed, PreparedScene, prepare_without_device},
    scene::{
        Backfaces, Camera, ClipPlanes, Colors, Object, Placement, Scene, Settings, Shapes, Splats, TileMemory,
    },
    vk::Limits,
};

fn points(count: u32) -> impl Iterator<Item = DVec3> {
    (0..count).map(move |i| {
        let z: f64 = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(count);
        let (sin, cos) = (2.399_963 * f64::from(i)).sin_cos();
        let around = (1.0 - z * z).sqrt();
        DVec3::new(around * cos, around * sin, z)
    })
}

fn ball(count: u32, updatable: bool) -> PreparedScene {
    let normals: Vec<_> = points(count).collect();
    let radii = vec![2.0 / (f64::from(count).sqrt()) as f32; count as usize];
    let shapes = Shapes::Disks { normals: normals.iter().map(|normal| normal.as_vec3()).collect(), radii };
    let colors = Colors::Each(vec![[0.5, 0.2, 0.1, 1.0]; count as usize]);
    let splats = Splats::new(normals, shapes, colors);
    let objects = vec![Object { name: "ball".to_owned(), splats, closed: true }];
    prepare_without_device(&Limits::plain(), &Scene { objects, updatable, ..Scene::default() }).unwrap()
}

fn settings() -> Settings {
    Settings { size_px: [640, 480], ..Settings::default() }
}

/// Of each chunk: how many runs there are, how many splats, and whether all was known by one look.
fn seen(scene: &PreparedScene, camera: &Camera, settings: &Settings) -> Vec<(usize, u32, bool)> {
    let (limits, arena) = (Limits::plain(), Arena::new());
    let placed = Placed::at_home(scene);
    let range = DepthRange::of(&[placed], camera);
    let camera = range.begin(camera);
    let of = |draw: crate::passes::plan::draws::Draw<'_>| {
        let runs = draw.runs_at_once(&arena);
        let one = run_of_all(&arena, draw.chunk, &draw.look());
        assert!(one.is_some() || runs == draw.potentially_visible_runs(&arena));
        assert_eq!(draw.has_rows(runs), one.is_none_or(|runs| runs.is_empty()));
        (runs.len(), runs.iter().map(|run| run.count).sum(), one.is_some())
    };
    draws(&arena, placed, (&camera, range), settings, &limits).map(of).collect()
}

#[test]
fn one_look_is_enough_of_what_is_far_and_within_the_view() {
    const COUNT: u32 = 20_000;
    let (own, of_updates) = (ball(COUNT, false), ball(COUNT, true));
    for round in 0..60 {
        let (sin, cos) = (0.7 * f64::from(round)).sin_cos();
        let distance = 4.3 + 0.4 * f64::from(round);
        let eye = distance * DVec3::new(cos, 0.2, sin).normalize();
        let orthographic_height = (round % 7 == 3).then_some(2.5);
        let camera = Camera { eye, orthographic_height, ..Camera::default() };
        let faces = |point: &DVec3| match orthographic_height {
            Some(_) => point.dot(eye) > 0.0,
            None => point.dot(eye - *point) > 0.0,
        };
        let facing = points(COUNT).filter(faces).count() as u32;
        let [(runs, count, true)] = seen(&own, &camera, &settings())[..] else { panic!("{round}") };
        assert!(runs == 1 && facing <= count && count < facing + COUNT / 14, "{round}: {facing} {count}");
        // What may change, what is drawn from behind, too, and what planes cut, is looked at block by block.
        assert!(!seen(&of_updates, &camera, &settings())[0].2);
        let flip = Settings { backfaces: Backfaces::Flip, ..settings() };
        assert!(!seen(&own, &camera, &flip)[0].2);
        // Behind the eye there is nothing; half of it is looked at block by block, as is what is near.
        let behind = Camera { target: 2.0 * eye, ..camera };
        assert_eq!(seen(&own, &behind, &settings())[0].0, 0);
        let half_angle = (0.5 * camera.fov_y_rad).tan() * 320.0 / 240.0;
        let aside = eye.cross(DVec3::Y).normalize();
        let half = match orthographic_height {
            Some(height) => Camera {
                eye: eye + 0.5 * height * 320.0 / 240.0 * aside,
                target: 0.5 * height * 320.0 / 240.0 * aside,
                ..camera
            },
            None => Camera { target: distance * half_angle * aside, ..camera },
        };
        let [(runs, _, false)] = seen(&own, &half, &settings())[..] else { panic!("{round}: {half:?}") };
        assert!(runs > 1, "{round}");
    }
    let near = Camera { eye: DVec3::new(0.0, 0.0, 3.9), fov_y_rad: 1.2, ..Camera::default() };
    assert!(!seen(&own, &near, &settings())[0].2);
    let cut = Settings { clip_planes: ClipPlanes([[0.0, 1.0, 0.0, 0.1]].into()), ..settings() };
    let far = Camera { eye: DVec3::new(0.0, 0.0, 7.0), ..Camera::default() };
    assert!(seen(&own, &far, &settings())[0].2 && !seen(&own, &far, &cut)[0].2);
}

/// Many are in one band that has room for what may face the eye and little more, with a run each; where memory is too short for that, in bands, within it, of blocks.
#[test]
fn far_objects_are_in_one_band_where_there_is_room_for_what_faces_the_eye() {
    const COUNT: u32 = 20_000;
    let own = ball(COUNT, false);
    let placed: Vec<_> = (0..8_u32)
        .map(|i| {
            let translation = 2.2 * DVec3::new(f64::from(i % 4) - 1.5, f64::from(i / 4) - 0.5, 0.0);
            Placed::new(&own, Placement { translation, ..Placement::default() })
        })
        .collect();
    let camera = Camera { eye: DVec3::new(0.3, 0.2, 14.0), ..Camera::default() };
    let bands = |most: u64| {
        let arena = Arena::new();
        let settings = Settings { tile_memory: TileMemory::Most(most), ..settings() };
        let plan = FramePlan::new(&arena, &placed, &camera, &settings, &Limits::plain());
        let of = |band: &crate::passes::plan::bands::Band<'_>| {
            (band.plan.record_count, band.plan.bytes(), band.visible.unwrap().words()[2])
        };
        plan.opaque.bands().iter().map(of).collect::<Vec<_>>()
    };
    let [(records, bytes, runs)] = bands(u64::MAX)[..] else { panic!("one band") };
    assert!(records < 8 * COUNT * 55 / 100 && runs == 8, "{records} {runs}");
    // A third more than may be taken is taken.
    for most in [bytes, bytes * 4 / 5] {
        assert_eq!(bands(most), [(records, bytes, runs)], "{most}");
    }
    let short = bands(bytes / 2);
    assert!(
        short.len() > 1 && short.iter().all(|band| band.1 < bytes * 3 / 4 && band.2 > 8),
        "{bytes}: {short:?}"
    );
}
