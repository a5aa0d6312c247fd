//! Whatever call of the device fails while a view or a scene is made or a frame recorded: it is named, nothing stays behind, and the next one works.

use std::collections::HashSet;

use ash::vk;
use glam::{
    DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    Error, Scene, Settings,
    embed::{
        Device, DynamicSplats, HostCamera, Import, Placed, PreparedScene, Renderer, Rendering, View,
        ViewFrame,
    },
    scene::Rasterizer,
};

use super::{COLOR_FORMAT, Engine, REVERSED, SIZE_PX};
use crate::common::{faults, scenes};

fn splats() -> DynamicSplats {
    DynamicSplats {
        capacity: 1000,
        count: 1000,
        origin: DVec3::ZERO,
        bounds: [DVec3::NEG_ONE, DVec3::ONE],
        largest_radius: 0.1,
        overlap: 2.0,
        closed: false,
        transparent: false,
    }
}

/// All that a frame needs beside a renderer that has its pipelines: of splats that a host writes, and of those that are uploaded and change; never submitted.
pub(super) fn frame(engine: &Engine, renderer: &Renderer) -> Result<(View, [PreparedScene; 2]), Error> {
    let rendering = Rendering { color_formats: vec![COLOR_FORMAT], ..Rendering::default() };
    let mut view = View::new(renderer, &rendering)?;
    let scene = renderer.dynamic(&splats())?;
    let camera = HostCamera {
        view_from_world: look_at_mat4(DVec3::new(0.4, 0.9, 4.0), DVec3::ZERO, DVec3::Y),
        clip_from_view: directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5),
        flips_y: true,
    };
    let settings = Settings { size_px: SIZE_PX, rasterizer: Rasterizer::Compute, ..Settings::default() };
    let ball = Scene { objects: vec![scenes::sphere(300, DVec3::ZERO)], updatable: true, ..Scene::default() };
    engine.begin();
    // SAFETY: recording; never submitted.
    let mut uploaded = unsafe { renderer.upload(engine.commands, &ball) }?;
    // SAFETY: as above.
    unsafe { renderer.update(engine.commands, &mut uploaded, 0, 0, &ball.objects[0].splats) }?;
    let placed = [Placed::at_home(&scene), Placed::at_home(&uploaded)];
    let frame = ViewFrame::new(&placed, &camera, &settings);
    // SAFETY: as above.
    unsafe { view.prepare(renderer, engine.commands, &frame) }?;
    Ok((view, [scene, uploaded]))
}

/// Beside a renderer that has its pipelines; and with a renderer of its own, so that layouts, shaders and pipelines fail, too. A lost device stays lost for a host, but
/// not for a table of functions that says so once.
#[test]
fn whichever_call_fails_is_named_and_the_next_frame_works() {
    for answer in [vk::Result::ERROR_OUT_OF_DEVICE_MEMORY, vk::Result::ERROR_DEVICE_LOST] {
        each_call_fails(answer, false);
    }
    each_call_fails(vk::Result::ERROR_OUT_OF_HOST_MEMORY, true);
}

fn each_call_fails(answer: vk::Result, with_renderer: bool) {
    crate::common::arm();
    let engine = Engine::new(REVERSED);
    let faulty = faults::device(&engine.instance, &engine.device);
    let host = Import { device: &faulty, ..engine.lent() };
    // SAFETY: all is the engine's own, which goes last.
    let device = unsafe { Device::import(&host) }.unwrap();
    let kept = Renderer::new(&device, None).unwrap();
    let finish = || {
        // SAFETY: nothing was ever submitted.
        unsafe { device.epoch_done(device.end_epoch()) };
        device.memory_in_use()
    };
    let frame = || match with_renderer {
        false => super::faults::frame(&engine, &kept).map(drop),
        true => super::faults::frame(&engine, &Renderer::new(&device, None)?).map(drop),
    };
    frame().unwrap();
    let before = finish();
    faults::take_called();
    frame().unwrap();
    let calls = faults::take_called();
    finish();
    let mut failed = Vec::new();
    let own = |function: &&str| {
        let of_renderer = ["layout", "module", "pipelines", "cache", "sampler"];
        of_renderer.iter().any(|part| function.contains(part))
    };
    let mut tried = HashSet::new();
    for (succeed, function) in (0..).zip(&calls) {
        // Of a renderer that is made anew each function is tried once: the driver compiles its shaders each time. All that is beside is tried beside a renderer that
        // has its pipelines.
        if with_renderer && !(own(function) && tried.insert(*function)) {
            continue;
        }
        faults::fail_so(succeed, answer);
        let result = frame();
        let Some(function) = faults::stop() else {
            result.unwrap();
            break;
        };
        let error = result.expect_err(function);
        faults::is_told(function, answer, &error);
        assert_eq!(finish(), before, "{succeed}: {function}");
        assert_eq!(engine.said(), [] as [String; 0], "{succeed}: {function}");
        failed.push(function);
        if !with_renderer {
            frame().unwrap();
            assert_eq!(finish(), before);
        }
    }
    frame().unwrap();
    assert_eq!(finish(), before);
    println!("{answer:?}: {} of {} calls failed, one after the other: {failed:?}", failed.len(), calls.len());
    let expected: &[&str] = match with_renderer {
        false => &["create_image", "create_buffer", "create_descriptor_pool"],
        true => &["create_pipeline_layout", "create_shader_module", "create_compute_pipelines"],
    };
    let most = if with_renderer { 3 } else { 20 };
    assert!(failed.len() >= most && expected.iter().all(|function| failed.contains(function)), "{failed:?}");
    drop(kept);
    finish();
    assert_eq!(device.memory_in_use(), (0, 0));
    drop(device);
    assert_eq!(engine.said(), [] as [String; 0]);
}

/// What is needed and was not enabled is named; the device is the engine's as before.
#[test]
fn an_import_of_less_than_is_needed_is_refused_by_name() {
    let engine = Engine::new(REVERSED);
    let mut enabled = engine.enabled;
    (enabled.synchronization2, enabled.maintenance4) = (false, false);
    let host = Import { enabled, ..engine.lent() };
    // SAFETY: all is the engine's own, which goes last.
    let refused = unsafe { Device::import(&host) }.err().unwrap().to_string();
    assert!(refused.contains("synchronization2 is not enabled; maintenance4 is not enabled"), "{refused}");
    engine.begin();
    engine.begin_rendering(true);
    engine.end_rendering();
    engine.submit();
    engine.wait();
    assert_eq!(engine.said(), [] as [String; 0]);
}

/// A scene that is on one device is drawn on no other, and by no safe call either.
#[test]
fn a_scene_of_another_device_is_refused() {
    let engine = Engine::new(REVERSED);
    // SAFETY: all is the engine's own, which goes last.
    let device = unsafe { Device::import(&engine.lent()) }.unwrap();
    let renderer = Renderer::new(&device, None).unwrap();
    let other = renderer.dynamic(&splats()).unwrap();
    let mut headless = crate::common::shared();
    let camera = crate::common::builder::camera([0.0, 0.0, 4.0], [0.0; 3]);
    let settings = Settings { size_px: SIZE_PX, ..Settings::default() };
    let wanted = surfel::Wanted { picture: true, ..surfel::Wanted::default() };
    let refused = headless.render(&other, &camera, &settings, wanted).err().unwrap().to_string();
    assert!(refused.contains("another device"), "{refused}");
    // Nor is a renderer of one device a headless host's of another.
    let own = std::mem::replace(&mut headless.renderer, renderer);
    let refused = headless.prepare(&Scene::default(), &|_, _| {}).err().unwrap().to_string();
    assert!(refused.contains("another device"), "{refused}");
    drop((other, std::mem::replace(&mut headless.renderer, own)));
    // SAFETY: nothing was submitted.
    unsafe { device.epoch_done(device.end_epoch()) };
    drop(device);
    assert_eq!(engine.said(), [] as [String; 0]);
}

/// What would be no pipeline of this device, or hide by the wrong side, is refused by name; a second attachment is left as it is.
#[test]
fn renderings_that_a_device_does_not_have_are_refused() {
    let mut beside = super::Beside::new(REVERSED);
    let plain = Rendering { color_formats: vec![COLOR_FORMAT], ..Rendering::default() };
    let refused = |rendering: Rendering| View::new(&beside.renderer, &rendering).err().unwrap().to_string();
    let of = |color_formats| Rendering { color_formats, ..plain.clone() };
    let neither = Rendering { depth_format: vk::Format::UNDEFINED, ..of(Vec::new()) };
    assert!(refused(neither).starts_with("color_formats: there is neither color nor depth"));
    assert!(
        refused(of(vec![vk::Format::D32_SFLOAT])).starts_with("color_formats: D32_SFLOAT: expected one of")
    );
    assert!(refused(of(vec![COLOR_FORMAT, vk::Format::D32_SFLOAT])).contains("expected formats of color"));
    assert!(refused(of(vec![COLOR_FORMAT; 65])).contains("expected at most"));
    assert!(refused(Rendering { depth_format: COLOR_FORMAT, ..plain.clone() }).starts_with("depth_format"));
    let stencil_format = vk::Format::D32_SFLOAT_S8_UINT;
    assert!(refused(Rendering { stencil_format, ..plain.clone() }).starts_with("stencil_format"));
    let samples = vk::SampleCountFlags::from_raw(3);
    assert!(refused(Rendering { samples, ..plain.clone() }).starts_with("samples"));
    assert!(refused(Rendering { compare: vk::CompareOp::EQUAL, ..plain.clone() }).starts_with("compare"));
    View::new(&beside.renderer, &Rendering { depth_format: stencil_format, stencil_format, ..plain.clone() })
        .unwrap();
    View::new(&beside.renderer, &of(vec![COLOR_FORMAT, vk::Format::R8G8B8A8_UNORM])).unwrap();

    // The matrices are of a reversed depth.
    let compare = vk::CompareOp::LESS;
    beside.view = View::new(&beside.renderer, &Rendering { compare, ..plain }).unwrap();
    let camera = HostCamera {
        view_from_world: look_at_mat4(DVec3::new(0.4, 0.9, 4.0), DVec3::ZERO, DVec3::Y),
        clip_from_view: directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5),
        flips_y: true,
    };
    let settings = Settings { size_px: SIZE_PX, ..Settings::default() };
    let frame = ViewFrame::new(&[], &camera, &settings);
    // SAFETY: refused before anything is recorded.
    let refused = unsafe { beside.view.prepare(&beside.renderer, beside.engine.commands, &frame) };
    assert!(refused.unwrap_err().to_string().contains("what is nearer has the greater depth"));
    beside.end();
}
