//! Pipelines ahead: in the background or on the spot; a frame that needs others is refused where that is wanted.

use glam::{
    DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    ErrorKind, Scene, Settings,
    embed::{HostCamera, MissingPipelines, Placed, Rendering, ViewFrame},
    scene::{Colors, Rasterizer},
};

use super::{Beside, COLOR_FORMAT, REVERSED, SIZE_PX};
use crate::common::{faults, scenes};

#[test]
fn a_frame_whose_pipelines_were_made_ahead_makes_none_and_one_without_is_refused() {
    ahead(Beside::on_faulty(REVERSED), false);
}

#[test]
fn pipelines_are_made_on_a_thread_of_their_own() {
    ahead(Beside::new(REVERSED), true);
}

/// `in_background`: on another thread, where calls are not counted.
fn ahead(mut beside: Beside, in_background: bool) {
    for (rasterizer, alpha) in
        [(Rasterizer::Compute, 1.0), (Rasterizer::Perspective, 1.0), (Rasterizer::Compute, 0.5)]
    {
        let mut ball = scenes::sphere(3000, DVec3::ZERO);
        ball.splats.colors = Colors::Uniform([0.5, 0.6, 0.7, alpha]);
        let ball = beside.upload(&Scene { objects: vec![ball], ..Scene::default() });
        let placed = [Placed::at_home(&ball)];
        let camera = HostCamera {
            view_from_world: look_at_mat4(DVec3::new(0.4, 0.9, 4.0), DVec3::ZERO, DVec3::Y),
            clip_from_view: directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5),
            flips_y: true,
        };
        let settings = Settings { size_px: SIZE_PX, rasterizer, ..Settings::default() };
        let frame = ViewFrame {
            hides: Some(beside.hides()),
            missing: MissingPipelines::Refuse,
            ..ViewFrame::new(&placed, &camera, &settings)
        };
        let made = |beside: &Beside| beside.renderer.pipelines_made();
        let before = made(&beside);
        let Beside { view, renderer, engine, .. } = &mut beside;
        engine.begin();
        engine.begin_rendering(true);
        engine.end_rendering();
        // SAFETY: recording; refused.
        let refused = unsafe { view.prepare(renderer, engine.commands, &frame) }.unwrap_err();
        assert!(matches!(refused.kind(), ErrorKind::NotReady { .. }), "{refused}");
        // SAFETY: nothing is prepared.
        assert!(unsafe { view.draw(renderer, engine.commands) }.is_err());
        assert_eq!(renderer.pipelines_made(), before);
        let rendering = Rendering { color_formats: vec![COLOR_FORMAT], ..Rendering::default() };
        let compile = || renderer.compile_ahead(&rendering, &frame).unwrap();
        let missing = match in_background {
            false => compile(),
            true => std::thread::scope(|scope| scope.spawn(compile).join().unwrap()),
        };
        assert!(missing > 0 && renderer.pipelines_made() == before + missing, "{missing}");
        faults::take_made();
        // SAFETY: recording; all is alive until the wait.
        unsafe { view.prepare(renderer, engine.commands, &frame) }.unwrap();
        let made_then = faults::take_made();
        assert!(!made_then.iter().any(|call| call.ends_with("_pipelines")), "{made_then:?}");
        assert!(in_background || made_then.contains(&"create_image"), "{made_then:?}");
        assert_eq!(renderer.pipelines_made(), before + missing);
        engine.begin_rendering(false);
        // SAFETY: inside of the rendering that the view was made for.
        unsafe { view.draw(renderer, engine.commands) }.unwrap();
        engine.end_rendering();
        beside.submit();
        assert_eq!(beside.renderer.compile_ahead(&rendering, &frame).unwrap(), 0);
        drop(ball);
    }
    beside.end();
}
