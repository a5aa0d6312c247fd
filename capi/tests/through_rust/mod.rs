//! The example's picture, drawn on the same engine through `surfel::embed`.

pub mod headless;

use std::path::Path;

use libloading::{Library, Symbol};
use surfel::{
    Scene, Settings,
    ash::{self, vk},
    embed::{
        Device, HostCamera, Import, Placed, Placement, Renderer, Rendering, View, ViewFrame, requirements,
    },
    glam::{DMat4, DVec3, Vec3},
    scene::{Colors, Object, Shapes, Splats},
};

const COUNT: usize = 20_000;
const NEAR: f32 = 0.1;

/// The head of `Engine` in `engine.h`.
#[repr(C)]
struct Engine {
    instance: vk::Instance,
    physical: vk::PhysicalDevice,
    device: vk::Device,
    commands: vk::CommandBuffer,
    images: [[u64; 3]; 2],
    core: vk::PhysicalDeviceFeatures,
    vulkan12: vk::PhysicalDeviceVulkan12Features<'static>,
    vulkan13: vk::PhysicalDeviceVulkan13Features<'static>,
    family: u32,
    messages: u32,
    others: [u64; 6],
    pixels: *const [f32; 4],
}

/// The picture of the example, of three floats a pixel.
pub fn picture(engine: &Path) -> Vec<[f32; 3]> {
    // SAFETY: the library is compiled of `engine.c`, with these functions; `Engine` is as in its header; what is made of surfel is dropped
    // before the engine goes.
    unsafe {
        let library = Library::new(engine).unwrap();
        let function = |name: &str| -> Symbol<'_, unsafe extern "C" fn(*mut Engine)> {
            library.get(name.as_bytes()).unwrap()
        };
        let new: Symbol<'_, unsafe extern "C" fn() -> *mut Engine> = library.get(b"engine_new").unwrap();
        let open: Symbol<'_, unsafe extern "C" fn(*mut Engine, u32)> = library.get(b"engine_open").unwrap();
        let begin_rendering: Symbol<'_, unsafe extern "C" fn(*mut Engine, i32)> =
            library.get(b"engine_begin_rendering").unwrap();
        let board: Symbol<'_, unsafe extern "C" fn(*mut Engine, vk::Rect2D, f32)> =
            library.get(b"engine_board").unwrap();

        let entry = ash::Entry::load().unwrap();
        let engine = new();
        let instance = ash::Instance::load(entry.static_fn(), (*engine).instance);
        let needs = requirements(&instance, (*engine).physical);
        (*engine).core = needs.features.core();
        let own = (*engine).vulkan12;
        (*engine).vulkan12 =
            vk::PhysicalDeviceVulkan12Features { p_next: own.p_next, ..needs.features.vulkan12() };
        (*engine).vulkan13 = needs.features.vulkan13();
        let queue_family = needs.queue_family.unwrap();
        open(engine, queue_family);
        let raw = ash::Device::load(instance.fp_v1_0(), (*engine).device);
        let host = Import {
            instance: &instance,
            debug_utils: true,
            physical: (*engine).physical,
            device: &raw,
            queue_family,
            enabled: needs.features,
            memory: None,
        };
        let device = Device::import(&host).unwrap();
        let renderer = Renderer::new(&device, None).unwrap();
        let rendering =
            Rendering { color_formats: vec![vk::Format::R32G32B32A32_SFLOAT], ..Rendering::default() };
        let mut view = View::new(&renderer, &rendering).unwrap();

        function("engine_begin")(engine);
        let scene = scene(&library);
        let ball = scene.ball().unwrap();
        let prepared = renderer.upload((*engine).commands, &scene).unwrap();
        let scenes = [(-0.6, 1.0), (1.1, 0.6)].map(|(x, size)| {
            let scale = size / ball.radius;
            let [cx, cy, cz] = ball.center.to_array();
            let at = DVec3::new(x - scale * cx, -scale * cy, -scale * cz);
            let matrix = DMat4::from_diagonal(DVec3::splat(scale).extend(1.0));
            let matrix = DMat4 { w_axis: at.extend(1.0), ..matrix };
            Placed::new(&prepared, Placement::of_matrix(&matrix).unwrap())
        });
        let focal = 0.4_f64.tan().recip();
        let mut clip_from_view = DMat4::ZERO;
        clip_from_view.x_axis.x = focal * 480.0 / 640.0;
        clip_from_view.y_axis.y = -focal;
        clip_from_view.z_axis.w = -1.0;
        clip_from_view.w_axis.z = f64::from(NEAR);
        let view_from_world = DMat4::from_translation(DVec3::new(0.0, 0.0, -4.5));
        let frame = ViewFrame {
            scenes: &scenes,
            camera: &HostCamera { view_from_world, clip_from_view, flips_y: false },
            settings: &Settings { size_px: [640, 480], ..Settings::default() },
            mirrored: false,
            camera_before: None,
            corner_px: [0; 2],
            hides: None,
            missing: Default::default(),
            profile: None,
        };
        view.prepare(&renderer, (*engine).commands, &frame).unwrap();
        begin_rendering(engine, 1);
        let where_it_is = vk::Rect2D {
            offset: vk::Offset2D { x: 80, y: 200 },
            extent: vk::Extent2D { width: 480, height: 120 },
        };
        board(engine, where_it_is, NEAR / 3.8);
        view.draw(&renderer, (*engine).commands).unwrap();
        function("engine_end_rendering")(engine);
        function("engine_submit")(engine);
        let pixels = std::slice::from_raw_parts((*engine).pixels, 640 * 480);
        let picture = pixels.iter().map(|[red, green, blue, _]| [*red, *green, *blue]).collect();
        device.epoch_done(device.end_epoch());
        drop((view, prepared, renderer, device));
        assert_eq!((*engine).messages, 0);
        function("engine_free")(engine);
        picture
    }
}

/// # Safety
/// The library is the engine.
unsafe fn scene(library: &Library) -> Scene {
    let (mut centers, mut normals) = (vec![DVec3::ZERO; COUNT], vec![Vec3::ZERO; COUNT]);
    let mut radii = vec![0.0; COUNT];
    // SAFETY: the function has this form, and arrays of that many.
    unsafe {
        let ball: Symbol<'_, unsafe extern "C" fn(u64, *mut DVec3, *mut Vec3, *mut f32)> =
            library.get(b"engine_ball").unwrap();
        ball(COUNT as u64, centers.as_mut_ptr(), normals.as_mut_ptr(), radii.as_mut_ptr());
    }
    let splats = Splats::new(centers, Shapes::Disks { normals, radii }, Colors::unknown());
    Scene { objects: vec![Object { name: "splats".to_owned(), splats, closed: true }], ..Scene::default() }
}
