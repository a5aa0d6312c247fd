//! Beside an engine's own triangles, in every convention of depth: each hides the other where it is nearer, and no other pixel.

#[path = "../../examples/engine/mod.rs"]
mod engine;

mod ahead;
mod allocators;
mod changing;
mod conventions;
mod depth_alone;
mod faults;
mod late;
mod layers;
mod memory;
mod mirrors;
mod needs;
mod objects;
mod onto;
mod recording;
mod refusals;
mod ring;
mod rooms;
mod several;
mod state;
mod timeline;
mod tints;
mod transparent;
mod turning;
mod twice;
mod updates;
mod written;

use ash::vk;
use engine::{COLOR_FORMAT, Engine, OBJECT_FORMATS, Style};
use glam::{DVec3, DVec4};
use surfel::{
    Scene, Settings,
    embed::{
        DepthImage, Device, HostCamera, ImageState, Import, Placed, Renderer, Rendering, View, ViewFrame,
    },
    prepare::PreparedScene,
};

const SIZE_PX: [u32; 2] = [160, 120];

/// The color of the engine's triangle.
const RED: [f32; 4] = [1.0, 0.0, 0.0, 1.0];

const REVERSED: Style = Style::reversed(SIZE_PX);

/// Depth from 0 at the near plane to 1.
const FORWARD: Style = Style { compare: vk::CompareOp::LESS, clear_depth: 1.0, ..REVERSED };

/// An engine and its guest.
struct Beside {
    view: View,
    renderer: Renderer,
    device: Device,
    engine: Engine,
    /// Its cameras' pictures are a mirror's.
    mirrored: bool,
}

impl Beside {
    fn new(style: Style) -> Self {
        crate::common::arm();
        let engine = Engine::new(style);
        // SAFETY: all is the engine's own, which goes last.
        let device = unsafe { Device::import(&engine.lent()) }.unwrap();
        Self::on(engine, device)
    }

    /// On a device that counts what is made on it.
    fn on_faulty(style: Style) -> Self {
        crate::common::arm();
        let engine = Engine::new(style);
        let faulty = crate::common::faults::device(&engine.instance, &engine.device);
        // SAFETY: as above.
        let device = unsafe { Device::import(&Import { device: &faulty, ..engine.lent() }) }.unwrap();
        Self::on(engine, device)
    }

    fn on(engine: Engine, device: Device) -> Self {
        let renderer = Renderer::new(&device, None).unwrap();
        let view = Self::view_of(&renderer, &engine.style);
        Self { view, renderer, device, engine, mirrored: false }
    }

    /// A view within the engine's rendering.
    fn view_of(renderer: &Renderer, style: &Style) -> View {
        let Style { depth_format, compare, samples, tells_objects, .. } = *style;
        let mut color_formats = vec![COLOR_FORMAT];
        color_formats.extend(OBJECT_FORMATS.into_iter().filter(|_| tells_objects));
        let rendering = Rendering {
            color_formats,
            ids: tells_objects,
            motion: tells_objects,
            depth_format,
            compare,
            samples,
            ..Rendering::default()
        };
        View::new(renderer, &rendering).unwrap()
    }

    fn upload(&self, scene: &Scene) -> PreparedScene {
        self.engine.begin();
        // SAFETY: recording; submitted at once.
        let prepared = unsafe { self.renderer.upload(self.engine.commands, scene) }.unwrap();
        self.engine.begin_rendering(true);
        self.engine.end_rendering();
        self.submit();
        prepared
    }

    /// A frame of an engine that draws its triangle first and gives its depth, where that is asked for.
    fn draw(
        &mut self,
        scenes: &[Placed<'_>],
        camera: &HostCamera,
        settings: &Settings,
        corners: &[DVec3; 3],
        gives_depth: bool,
    ) {
        self.draw_after(scenes, [camera, camera], settings, corners, gives_depth);
    }

    /// The same, of a camera that was another one in the frame before, the second.
    fn draw_after(
        &mut self,
        scenes: &[Placed<'_>],
        [camera, before]: [&HostCamera; 2],
        settings: &Settings,
        corners: &[DVec3; 3],
        gives_depth: bool,
    ) {
        let hides = gives_depth.then(|| self.hides());
        let frame = ViewFrame {
            hides,
            camera_before: Some(before),
            mirrored: self.mirrored,
            ..ViewFrame::new(scenes, camera, settings)
        };
        let in_clip =
            |at: &DVec3| (camera.clip_from_view * camera.view_from_world * at.extend(1.0)).as_vec4();
        let corners = [0, 1, 2].map(|i| in_clip(&corners[i]).to_array());
        let Self { engine, view, renderer, .. } = self;
        engine.begin();
        engine.begin_rendering(true);
        engine.triangle(corners, RED, camera.flips_y);
        engine.end_rendering();
        // SAFETY: recording; all is alive until the wait.
        unsafe { view.prepare(renderer, engine.commands, &frame) }.unwrap();
        engine.begin_rendering(false);
        // SAFETY: inside of the rendering that the view was made for.
        unsafe { view.draw(renderer, engine.commands) }.unwrap();
        engine.end_rendering();
        self.submit();
    }

    /// What the engine has drawn, with a rendering just before and just after.
    fn hides(&self) -> DepthImage {
        let depth = self.engine.depth;
        let written = ImageState {
            stages: vk::PipelineStageFlags2::LATE_FRAGMENT_TESTS,
            access: vk::AccessFlags2::DEPTH_STENCIL_ATTACHMENT_WRITE,
            layout: vk::ImageLayout::ATTACHMENT_OPTIMAL,
        };
        let [width, height] = self.engine.style.size_px;
        DepthImage {
            image: depth.image,
            view: depth.view,
            format: self.engine.style.depth_format,
            extent: vk::Extent2D { width, height },
            layer: 0,
            before: written,
            after: written,
        }
    }

    fn submit(&self) {
        self.engine.submit();
        let epoch = self.device.end_epoch();
        self.engine.wait();
        // SAFETY: waited for.
        unsafe { self.device.epoch_done(epoch) };
    }

    /// All of ours goes, with nothing left and nothing said.
    fn end(self) {
        drop(self.leave());
    }

    /// The same, and the engine goes on.
    fn leave(self) -> Engine {
        let Self { view, renderer, device, engine, .. } = self;
        drop((view, renderer));
        // SAFETY: nothing is under way.
        unsafe { device.epoch_done(device.end_epoch()) };
        assert_eq!(device.memory_in_use(), (0, 0));
        drop(device);
        assert_eq!(engine.said(), [] as [String; 0]);
        engine
    }
}

/// The view-space depth of a plane through three points along the ray of a pixel, which has a direction of depth 1, or under parallel rays
/// its own place; both in view space.
fn plane_depth(corners: [DVec3; 3], origin: DVec3, direction: DVec3) -> f64 {
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    let plane: DVec4 = normal.extend(-normal.dot(corners[0]));
    -(plane.truncate().dot(origin) + plane.w) / plane.truncate().dot(direction)
}
