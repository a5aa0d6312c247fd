//! What recording touches of a host's command buffers is what `docs/embedding.md` lists, and it neither submits nor waits.

use std::{
    cell::RefCell,
    collections::{BTreeSet, HashMap},
    ffi::{CStr, c_void},
};

use ash::vk;
use glam::{
    DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    Settings,
    embed::{Device, HostCamera, Import, Placed, Profile, ViewFrame},
    scene::{Colors, Layers, Mesh, MeshObject, Rasterizer, Scene},
};

use super::{
    Beside, REVERSED, SIZE_PX,
    engine::{Engine, Style},
};
use crate::common::scenes;

type Function = unsafe extern "system" fn();

thread_local! {
    /// What was set since that was asked for last.
    static SET: RefCell<BTreeSet<String>> = RefCell::default();
    static OWN: RefCell<HashMap<&'static str, Function>> = RefCell::default();
}

macro_rules! noted {
    ($($name:literal $what:literal $function:ident($($argument:ident: $kind:ty),*) $point:expr;)*) => {
        $(unsafe extern "system" fn $function($($argument: $kind),*) {
            let point: Option<vk::PipelineBindPoint> = $point;
            let of = point.map_or_else(String::new, |point| format!(", {point:?}"));
            SET.with_borrow_mut(|set| set.insert($what.to_owned() + &of));
            if let Some(own) = OWN.with_borrow(|own| own.get($name).copied()) {
                // SAFETY: Vulkan's function of this name has this type; the caller's own contract.
                unsafe {
                    std::mem::transmute::<Function, unsafe extern "system" fn($($kind),*)>(own)($($argument),*)
                }
            }
        })*

        fn of_name(name: &str) -> Option<(&'static str, *const c_void)> {
            match name {
                $($name => Some(($name, $function as *const c_void)),)*
                _ => None,
            }
        }
    };
}

noted! {
    "vkCmdBindPipeline" "pipeline" pipeline(c: vk::CommandBuffer, at: vk::PipelineBindPoint, p: vk::Pipeline) Some(at);
    "vkCmdBindDescriptorSets" "sets" sets(c: vk::CommandBuffer, at: vk::PipelineBindPoint, l: vk::PipelineLayout, f: u32, n: u32, s: *const vk::DescriptorSet, m: u32, o: *const u32) Some(at);
    "vkCmdPushConstants" "push constants" push(c: vk::CommandBuffer, l: vk::PipelineLayout, s: vk::ShaderStageFlags, o: u32, n: u32, b: *const c_void) None;
    "vkCmdBindIndexBuffer" "index buffer" indices(c: vk::CommandBuffer, b: vk::Buffer, o: u64, t: vk::IndexType) None;
    "vkCmdSetViewport" "viewport" viewport(c: vk::CommandBuffer, f: u32, n: u32, v: *const vk::Viewport) None;
    "vkCmdSetScissor" "scissor" scissor(c: vk::CommandBuffer, f: u32, n: u32, s: *const vk::Rect2D) None;
}

/// Commands that leave no state behind.
const LEAVES_NOTHING: &[&str] = &[
    "vkCmdBeginQuery",
    "vkCmdBeginRendering",
    "vkCmdClearColorImage",
    "vkCmdCopyBuffer",
    "vkCmdCopyBufferToImage",
    "vkCmdCopyImage",
    "vkCmdCopyQueryPoolResults",
    "vkCmdDispatch",
    "vkCmdDispatchIndirect",
    "vkCmdDraw",
    "vkCmdDrawIndexed",
    "vkCmdDrawIndexedIndirect",
    "vkCmdDrawIndexedIndirectCount",
    "vkCmdDrawIndirect",
    "vkCmdDrawIndirectCount",
    "vkCmdEndQuery",
    "vkCmdEndRendering",
    "vkCmdFillBuffer",
    "vkCmdPipelineBarrier2",
    "vkCmdResetQueryPool",
    "vkCmdUpdateBuffer",
    "vkCmdWriteTimestamp2",
];

/// What submits or waits, or gives what can.
const NOT_OURS: &[&str] = &[
    "vkQueue",
    "vkWait",
    "vkDeviceWaitIdle",
    "vkGetDeviceQueue",
    "vkBeginCommand",
    "vkEndCommand",
    "vkReset",
];

/// What may be reset: sets of a frame that is done.
const RESETS: &str = "vkResetDescriptorPool";

/// The device without a function that is in no list: who calls one ends the process, by its name.
fn device(instance: &ash::Instance, own: &ash::Device) -> ash::Device {
    let find = instance.fp_v1_0().get_device_proc_addr;
    let found = |name: &CStr| {
        let text = name.to_str().unwrap_or_default();
        // SAFETY: a function of this device.
        let function = unsafe { find(own.handle(), name.as_ptr()) };
        if let (Some(function), Some((name, instead))) = (function, of_name(text)) {
            OWN.with_borrow_mut(|own| own.insert(name, function));
            return instead;
        }
        let is_command = text.starts_with("vkCmd");
        let barred = NOT_OURS.iter().any(|name| text.starts_with(name)) && text != RESETS;
        match barred || is_command && !LEAVES_NOTHING.contains(&text) {
            true => std::ptr::null(),
            false => function.map_or(std::ptr::null(), |function| function as *const c_void),
        }
    };
    // SAFETY: functions of this device, or such that call them.
    unsafe { ash::Device::load_with(found, own.handle()) }
}

fn set() -> BTreeSet<String> {
    SET.take()
}

fn named(all: &[&str]) -> BTreeSet<String> {
    all.iter().map(|name| (*name).to_owned()).collect()
}

/// All that the guide says of `draw`.
const BY_DRAW: [&str; 5] = ["pipeline, GRAPHICS", "push constants", "scissor", "sets, GRAPHICS", "viewport"];

/// And of `prepare`, beside that.
const BY_PREPARE: [&str; 3] = ["index buffer", "pipeline, COMPUTE", "sets, COMPUTE"];

#[test]
fn recording_clobbers_what_the_guide_says_and_never_submits_or_waits() {
    crate::common::arm();
    let engine = Engine::new(Style { tells_objects: true, ..REVERSED });
    let noted = device(&engine.instance, &engine.device);
    // SAFETY: all is the engine's own, which goes last.
    let device = unsafe { Device::import(&Import { device: &noted, ..engine.lent() }) }.unwrap();
    let mut beside = Beside::on(engine, device);
    let mut glass = scenes::sphere(400, DVec3::X);
    glass.splats.colors = Colors::Uniform([0.0, 0.5, 0.8, 0.4]);
    let mesh = Mesh {
        positions: vec![DVec3::NEG_ONE, DVec3::X, DVec3::Y],
        triangles: vec![[0, 1, 2]],
        normals: None,
        colors: Colors::Uniform([0.5, 0.5, 0.5, 1.0]),
    };
    let meshes = vec![MeshObject { name: "triangle".to_owned(), mesh, closed: false }];
    let changes =
        Scene { objects: vec![scenes::sphere(400, DVec3::ZERO)], updatable: true, ..Scene::default() };
    set();
    let of_splats = beside.upload(&Scene { objects: vec![glass], meshes, ..Scene::default() });
    let mut changing = beside.upload(&changes);
    let camera = HostCamera {
        view_from_world: look_at_mat4(DVec3::new(0.4, 0.9, 4.0), DVec3::ZERO, DVec3::Y),
        clip_from_view: directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5),
        flips_y: true,
    };
    let (mut by_prepare, mut by_draw) = (BTreeSet::new(), BTreeSet::new());
    let profiles = [None, Some(Profile::Frame), Some(Profile::Times), Some(Profile::Counts)];
    for (rasterizer, layers) in [
        (Rasterizer::Compute, Layers::Fixed(2)),
        (Rasterizer::Perspective, Layers::Auto(3)),
        (Rasterizer::Quad, Layers::Fixed(2)),
    ] {
        for profile in profiles {
            let settings = Settings { size_px: SIZE_PX, rasterizer, layers, ..Settings::default() };
            beside.engine.begin();
            // SAFETY: recording; submitted below; here and below all is alive until the wait.
            unsafe {
                let splats = &changes.objects[0].splats;
                beside.renderer.update(beside.engine.commands, &mut changing, 0, 0, splats).unwrap();
            }
            assert_eq!(set(), named(&[]), "uploads and updates clobber nothing");
            let scenes = [Placed::at_home(&of_splats), Placed { id: 3, ..Placed::at_home(&changing) }];
            let hides = Some(beside.hides());
            let frame = ViewFrame { hides, profile, ..ViewFrame::new(&scenes, &camera, &settings) };
            let Beside { engine, view, renderer, .. } = &mut beside;
            engine.begin_rendering(true);
            engine.end_rendering();
            // SAFETY: as above.
            unsafe { view.prepare(renderer, engine.commands, &frame) }.unwrap();
            by_prepare.append(&mut set());
            engine.begin_rendering(false);
            // SAFETY: inside of the rendering that the view was made for.
            unsafe { view.draw(renderer, engine.commands) }.unwrap();
            by_draw.append(&mut set());
            engine.end_rendering();
            beside.submit();
        }
    }
    assert_eq!(by_draw, named(&BY_DRAW));
    assert_eq!(by_prepare, named(&[&BY_DRAW[..], &BY_PREPARE].concat()));
    drop((of_splats, changing));
    beside.end();
}
