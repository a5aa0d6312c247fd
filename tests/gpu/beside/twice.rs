//! One view, prepared again before the frame before has run: what is seen is what two views show.

use glam::{
    DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    ErrorKind, Settings,
    embed::{HostCamera, MissingPipelines, Placed, PreparedScene, View, ViewFrame},
    scene::{ClipPlanes, Rasterizer, Scene},
};

use super::{Beside, REVERSED, SIZE_PX, engine::Style};
use crate::common::scenes;

/// Half of the picture.
const HALF_PX: [u32; 2] = [SIZE_PX[0] / 2, SIZE_PX[1]];

/// Frames of one view that may be under way.
const MOST: usize = 256;

type Told = (Vec<[f32; 4]>, Vec<f64>, (Vec<u32>, Vec<[f32; 2]>));

fn told(beside: &Beside) -> Told {
    (beside.engine.pixels(), beside.engine.depths(), beside.engine.told())
}

fn camera(eye: DVec3) -> HostCamera {
    HostCamera {
        view_from_world: look_at_mat4(eye, DVec3::ZERO, DVec3::Y),
        clip_from_view: directx::perspective_infinite_reverse(0.7, 80.0 / 120.0, 0.5),
        flips_y: true,
    }
}

/// Records both halves: planes, numbers, tints, cameras differ, all that the host writes.
fn halves(ball: &PreparedScene, rasterizer: Rasterizer, mut record: impl FnMut(usize, &ViewFrame<'_>)) {
    let before = camera(DVec3::new(0.3, 0.9, 4.4));
    for half in 0..2 {
        let camera = camera([DVec3::new(0.4, 0.9, 4.0), DVec3::new(-1.0, 1.2, 3.6)][half]);
        let plane = [[0.0, 1.0, 0.0, 0.3], [1.0, 0.0, 0.3, 0.2]][half];
        let settings = Settings {
            size_px: HALF_PX,
            rasterizer,
            clip_planes: ClipPlanes([plane].into_iter().collect()),
            ..Settings::default()
        };
        let tint = [[1.0, 0.4, 0.2, 1.0], [0.3, 1.0, 0.5, 1.0]][half];
        let placed = [Placed { id: [5, 6][half], tint, ..Placed::at_home(ball) }];
        let corner_px = [[0, 0], [HALF_PX[0] as i32, 0]][half];
        let plain = ViewFrame::new(&placed, &camera, &settings);
        record(half, &ViewFrame { corner_px, camera_before: Some(&before), ..plain });
    }
}

fn draw(Beside { engine, renderer, .. }: &Beside, view: &mut View, frame: &ViewFrame<'_>, clears: bool) {
    engine.begin_rendering(clears);
    engine.end_rendering();
    // SAFETY: recording; all is alive until the wait, and what was prepared before is drawn, and runs before.
    unsafe { view.prepare(renderer, engine.commands, frame) }.unwrap();
    engine.begin_rendering(false);
    // SAFETY: inside of the rendering that the view was made for.
    unsafe { view.draw(renderer, engine.commands) }.unwrap();
    engine.end_rendering();
}

#[test]
fn a_view_that_is_prepared_twice_in_one_recording_shows_both() {
    let style = Style { tells_objects: true, ..REVERSED };
    let scene = Scene { objects: vec![scenes::sphere(3000, DVec3::ZERO)], ..Scene::default() };
    for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective] {
        let mut beside = Beside::new(style);
        let ball = beside.upload(&scene);
        let [mut apart, mut twice] = [(), ()].map(|()| Vec::new());
        for frame in 0..3 {
            // By two views.
            let mut other = Beside::view_of(&beside.renderer, &style);
            beside.engine.begin();
            let mut own = Beside::view_of(&beside.renderer, &style);
            halves(&ball, rasterizer, |half, frame| {
                draw(&beside, [&mut own, &mut other][half], frame, half == 0);
            });
            beside.submit();
            drop((own, other));
            apart.push(told(&beside));
            // By one.
            let mut view = Beside::view_of(&beside.renderer, &style);
            std::mem::swap(&mut view, &mut beside.view);
            beside.engine.begin();
            halves(&ball, rasterizer, |half, frame| draw(&beside, &mut view, frame, half == 0));
            beside.submit();
            std::mem::swap(&mut view, &mut beside.view);
            drop(view);
            twice.push(told(&beside));
            let [one, other] = [&apart, &twice].map(|all: &Vec<Told>| &all[frame]);
            let off = one.0.iter().zip(&other.0).filter(|(a, b)| a != b).count();
            assert!(one == other, "{rasterizer:?}, frame {frame}: {off} pixels");
        }
        let ids = |id| twice[0].2.0.iter().filter(|found| **found == id).count();
        assert!(ids(5) > 500 && ids(6) > 500, "{} and {}", ids(5), ids(6));
        drop(ball);
        beside.end();
    }
}

/// Who never tells that an epoch is done.
#[test]
fn a_view_of_which_nothing_is_known_to_be_done_is_refused_by_name_and_goes_on_then() {
    let mut beside = Beside::new(REVERSED);
    let ball = beside.upload(&Scene { objects: vec![scenes::sphere(500, DVec3::ZERO)], ..Scene::default() });
    let settings = Settings { size_px: SIZE_PX, ..Settings::default() };
    let (placed, camera) = ([Placed::at_home(&ball)], camera(DVec3::new(0.4, 0.9, 4.0)));
    let camera = HostCamera {
        clip_from_view: directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5),
        ..camera
    };
    let frame = ViewFrame::new(&placed, &camera, &settings);
    let elsewhere = Settings { rasterizer: Rasterizer::Quad, ..settings.clone() };
    let not_ready = ViewFrame {
        missing: MissingPipelines::Refuse,
        settings: &elsewhere,
        ..ViewFrame::new(&placed, &camera, &settings)
    };
    for round in 0..2 {
        for number in 0..=MOST {
            let Beside { view, renderer, engine, .. } = &mut beside;
            // SAFETY: refused before anything is recorded, so that no frame of it is under way.
            let refused = unsafe { view.prepare(renderer, engine.commands, &not_ready) };
            assert!(number == MOST || matches!(refused.unwrap_err().kind(), ErrorKind::NotReady { .. }));
            beside.engine.begin();
            let Beside { view, renderer, engine, .. } = &mut beside;
            // SAFETY: recording; none of them is submitted.
            let prepared = unsafe { view.prepare(renderer, engine.commands, &frame) };
            match prepared {
                Ok(()) => assert!(number < MOST, "round {round}"),
                Err(error) => {
                    assert_eq!(number, MOST, "round {round}: {error}");
                    assert!(error.to_string().contains("epoch_done"), "{error}");
                }
            }
        }
        // SAFETY: nothing was submitted.
        unsafe { beside.device.epoch_done(beside.device.end_epoch()) };
    }
    beside.draw(&placed, &camera, &settings, &[DVec3::ZERO; 3], false);
    drop(ball);
    beside.end();
}
