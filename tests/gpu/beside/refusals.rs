//! What safe functions and a mistaken host are refused by name, before Vulkan sees it.

use std::time::Duration;

use ash::vk;
use glam::{
    DMat4, DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    Scene, Settings,
    embed::{HostCamera, Placed, Rendering, View, ViewFrame},
    renderer::Seen,
    scene::Camera,
    vk::Occlusion,
};

use super::{Beside, COLOR_FORMAT, REVERSED, SIZE_PX};
use crate::common::scenes;

/// No formats of colors: by their use, by what is listed, and numbers that no version of Vulkan has.
fn no_colors() -> Vec<vk::Format> {
    use vk::Format as F;
    let known = [F::R8_UINT, F::D32_SFLOAT, F::BC1_RGB_UNORM_BLOCK, F::R64G64B64A64_SFLOAT, F::R16_SFLOAT];
    known.into_iter().chain([-1, 999, 1_000_000_000, i32::MAX, i32::MIN].map(F::from_raw)).collect()
}

fn camera() -> HostCamera {
    HostCamera {
        view_from_world: look_at_mat4(DVec3::new(0.4, 0.9, 4.0), DVec3::ZERO, DVec3::Y),
        clip_from_view: directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5),
        flips_y: true,
    }
}

#[test]
fn formats_that_are_not_listed_are_refused_by_name() {
    let beside = Beside::new(REVERSED);
    let ball = beside.upload(&Scene { objects: vec![scenes::sphere(300, DVec3::ZERO)], ..Scene::default() });
    let said = |rendering: Rendering| View::new(&beside.renderer, &rendering).err().map(|e| e.to_string());
    let first = |format| Rendering { color_formats: vec![format], ..Rendering::default() };
    let second = |format| Rendering { color_formats: vec![COLOR_FORMAT, format], ..Rendering::default() };
    for format in no_colors() {
        let refused = said(first(format)).unwrap_or_else(|| panic!("{format:?}"));
        assert!(refused.starts_with("color_formats: "), "{format:?}: {refused}");
        let settings = Settings { size_px: SIZE_PX, ..Settings::default() };
        let made = beside.renderer.make_pipelines(
            Seen { scene: &ball, camera: &Camera::default(), settings: &settings },
            format,
            Duration::ZERO,
        );
        let refused = made.map(drop).unwrap_err().to_string();
        assert!(refused.starts_with("format: "), "{format:?}: {refused}");
    }
    assert_eq!(said(first(COLOR_FORMAT)), None);
    // What is left as it is may be of any format that can be an attachment.
    assert_eq!(said(second(vk::Format::R16_SFLOAT)), None);
    for raw in [-1, 999, 1_000_000_000, i32::MAX, i32::MIN] {
        let format = vk::Format::from_raw(raw);
        assert!(said(second(format)).unwrap().starts_with("color_formats: "));
        let rendering = first(COLOR_FORMAT);
        let depth = said(Rendering { depth_format: format, ..rendering.clone() }).unwrap();
        assert!(depth.starts_with("depth_format: "), "{depth}");
        let stencil = said(Rendering { stencil_format: format, ..rendering }).unwrap();
        assert!(stencil.starts_with("stencil_format: "), "{stencil}");
    }
    drop(ball);
    beside.end();
}

#[test]
fn a_view_is_drawn_by_its_own_renderer_alone() {
    let (mut one, other) = (Beside::new(REVERSED), Beside::new(REVERSED));
    let (camera, settings) = (camera(), Settings { size_px: SIZE_PX, ..Settings::default() });
    let expected = "renderer: is not the one that the view was made with";
    let Beside { view, renderer, engine, .. } = &mut one;
    engine.begin();
    let frame = ViewFrame::new(&[], &camera, &settings);
    // SAFETY: recording; the frame of nothing is waited for.
    unsafe { view.prepare(renderer, engine.commands, &frame) }.unwrap();
    // SAFETY: refused.
    let drawn = unsafe { view.draw(&other.renderer, engine.commands) };
    assert_eq!(drawn.unwrap_err().to_string(), expected);
    // SAFETY: as above.
    let prepared = unsafe { view.prepare(&other.renderer, engine.commands, &frame) };
    assert_eq!(prepared.unwrap_err().to_string(), expected);
    engine.begin_rendering(true);
    engine.end_rendering();
    one.submit();
    other.end();
    one.end();
}

#[test]
fn pools_of_more_queries_than_any_frame_has_are_refused() {
    let beside = Beside::new(REVERSED);
    let refused = Occlusion::new(&beside.device, "many", u32::MAX).map(drop).unwrap_err();
    assert!(refused.to_string().starts_with("many: a pool of 4294967295 queries"), "{refused}");
    beside.end();
}

/// A host that knows no command line reads of the fields that it has filled.
#[test]
fn what_is_refused_of_a_frame_has_the_name_of_its_field() {
    let mut beside = Beside::new(REVERSED);
    let ball = beside.upload(&Scene { objects: vec![scenes::sphere(300, DVec3::ZERO)], ..Scene::default() });
    let (placed, good) = ([Placed::at_home(&ball)], camera());
    let Beside { view, renderer, engine, .. } = &mut beside;
    engine.begin();
    let mut said = |camera: &HostCamera, settings: &Settings, corner_px| {
        let frame = ViewFrame { corner_px, ..ViewFrame::new(&placed, camera, settings) };
        // SAFETY: recording; refused.
        unsafe { view.prepare(renderer, engine.commands, &frame) }.unwrap_err().to_string()
    };
    let sized = |size_px| Settings { size_px, ..Settings::default() };
    let plain = sized(SIZE_PX);
    for size_px in [[0, 120], [0, 0], [65_537, 120]] {
        let refused = said(&good, &sized(size_px), [0; 2]);
        assert!(refused.starts_with("size_px: ") && refused.contains("expected 1 to"), "{refused}");
    }
    let wide =
        HostCamera { clip_from_view: directx::perspective_infinite_reverse(0.7, 65_536.0, 0.5), ..good };
    let refused = said(&wide, &sized([65_536, 1]), [0; 2]);
    assert!(refused.starts_with("size_px: 65536x1: the device"), "{refused}");
    let mut settings = plain.clone();
    settings.samples.0 = 2;
    assert!(said(&good, &settings, [0; 2]).starts_with("samples: "));
    let settings = Settings { epsilon: surfel::scene::Epsilon::Radii(-1.0), ..plain.clone() };
    assert!(said(&good, &settings, [0; 2]).starts_with("epsilon: "));
    let mut off = good;
    off.clip_from_view = DMat4 { z_axis: off.clip_from_view.z_axis.with_x(1e300), ..off.clip_from_view };
    let refused = said(&off, &plain, [0; 2]);
    assert!(!refused.contains("--") && refused.len() < 200, "{refused}");
    for corner_px in [[i32::MAX, 0], [0, i32::MAX], [-1, 0]] {
        let refused = said(&good, &plain, corner_px);
        assert!(refused.starts_with("corner_px: "), "{refused}");
    }
    engine.begin_rendering(true);
    engine.end_rendering();
    beside.submit();
    drop(ball);
    beside.end();
}
