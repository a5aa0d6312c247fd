//! A view: passes outside of the host's rendering, draws within it.

use ash::vk;

use super::{
    frame::{DepthImage, ViewFrame},
    images::{AFTER, BEFORE, Images},
    over::{Part, Rendering},
};
use crate::{
    arena::Arena,
    error::{Error, Result},
    frame::{FrameSlot, SlotParts},
    graph::{
        Graph, ImageDesc,
        execute::{FrameProfile, Physical},
    },
    inline_vec::InlineVec,
    passes::{
        self, HostDepth, Inputs, Place, Source, host::BesideHost, pipeline::key::Layout,
        plan::range::DepthRange,
    },
    renderer::{Imports, Renderer},
    scene::{Camera, DepthOfHost, Edges, Settings},
    shaders::config::{BIND_SUMS_COLORS, BIND_SUMS_DEPTH},
    vk::{Descriptor, Device, PoolSizes},
};

/// One view of a host, of one frame at a time: with several frames in flight a host has one for each. It keeps what passes leave for draws.
pub struct View {
    device: Device,
    rendering: Rendering,
    slot: FrameSlot,
    images: Option<Images>,
    /// What the frame that was prepared last has to draw.
    prepared: Option<Prepared>,
}

/// What draws are recorded with.
struct Prepared {
    area: vk::Rect2D,
    depth: HostDepth,
    draws: Draws,
}

/// At most one of each part.
type Draws = InlineVec<(vk::Pipeline, vk::DescriptorSet), 3>;

/// Draws take two sets, each of the surface or of layers.
const SETS_OF_DRAWS: PoolSizes = PoolSizes {
    sets: 2,
    buffers: 0,
    uniform_buffers: 2,
    texel_buffers: 0,
    images: 10,
    filtered_images: 0,
    storage_images: 0,
};

impl View {
    /// A view to be drawn within such a rendering. Its pipelines are made here.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for a rendering that the device does not have, or that compares depths in no order; whatever the driver answers.
    pub fn new(renderer: &Renderer, rendering: &Rendering) -> Result<Self> {
        rendering.check(renderer.device())?;
        for part in [Part::Covering, Part::CoveringLess, Part::Layers] {
            renderer.shaders.graphics(rendering.key(part))?;
        }
        let device = renderer.device().clone();
        let slot = FrameSlot::new(&device);
        Ok(Self { device, rendering: rendering.clone(), slot, images: None, prepared: None })
    }

    /// Records the passes of a frame: all but its draws.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for a camera that is none, several samples of a pixel (a host takes them itself, by jittered cameras), something
    /// transparent beside a host's depth that is not given; as [`Renderer::record`].
    ///
    /// # Safety
    /// `commands` must be recording, outside of rendering, without an active query, and be submitted to the device's queue; `renderer` is the one
    /// the view was made with. Renderer, scenes, view and the depth image must stay alive until it has run; the frame prepared before in this view
    /// must have finished. The depth image is what it says, and in the state it says.
    pub unsafe fn prepare(
        &mut self,
        renderer: &Renderer,
        commands: vk::CommandBuffer,
        frame: &ViewFrame<'_>,
    ) -> Result<()> {
        let arena = self.slot.take_arena();
        // SAFETY: this function's contract.
        let recorded = unsafe { self.record(&arena, renderer, Some(commands), frame) };
        self.slot.give_back(arena);
        recorded
    }

    /// The same, in a frame's memory; without commands, all up to where it would be recorded: pipelines are there then.
    ///
    /// # Safety
    /// As [`Self::prepare`].
    pub(super) unsafe fn record(
        &mut self,
        arena: &Arena,
        renderer: &Renderer,
        commands: Option<vk::CommandBuffer>,
        frame: &ViewFrame<'_>,
    ) -> Result<()> {
        self.prepared = None;
        let settings = &Settings { background: None, ..frame.settings.clone() };
        if settings.samples.0 > 1 {
            return Err(Error::option(
                "--samples",
                "expected 1: a host takes more itself, by jittered cameras",
            ));
        }
        let (camera, depth) = frame.camera.camera(settings.size_px)?;
        self.check_order(depth)?;
        let plan = renderer.frame_plan(arena, frame.scenes, &camera, settings)?;
        let layered = !plan.transparent.is_empty();
        self.check(frame, layered)?;
        let depth = HostDepth { corner_px: frame.corner_px, ..host_depth(depth, &camera, plan.range) };
        let format = self.rendering.surface_format();
        let size_px = if commands.is_some() { settings.size_px } else { [1; 2] };
        let images = Images::fit(self.images.take(), &self.device, (format, size_px), layered)?;
        let images = self.images.insert(images);

        let counts_draws = self.device.facts().draw_indirect_count;
        let mut needs = passes::needs(&plan, settings, counts_draws);
        needs.room = needs.room.plus(&SETS_OF_DRAWS);
        // SAFETY: this function's contract, here and below.
        unsafe { self.slot.begin(needs, frame.profile) }?;
        // SAFETY: as above.
        let planes = unsafe { self.slot.planes(&plan.planes) }?;
        let SlotParts { descriptors, occlusion, execution } = self.slot.parts()?;
        let inputs = Inputs::new(&camera, settings, Place::Device(&renderer.shaders, descriptors));
        let source = Source { missing: frame.missing, ..inputs.source.cut_by(planes) };
        let inputs = Inputs { occlusion, range: plan.range, source, ..inputs };

        let (mut graph, mut imports): (_, Imports<'_>) = (Graph::new(arena), arena.growing());
        let [width, height] = settings.size_px;
        let extent = vk::Extent2D { width, height };
        let mut import = |name: &str, image: &crate::vk::Image| {
            let desc = ImageDesc { format: image.format(), extent };
            let handle = graph.import_image(name, desc, BEFORE, Some(AFTER));
            imports.push((handle.id(), Physical::Image(image.raw(), image.view())));
            handle
        };
        let mut surface = import("surface for a host", &images.surface);
        let mut surface_depth = import("its depth", &images.depth);
        let mut layers =
            images.layers.as_ref().filter(|_| layered).map(|image| import("layers for a host", image));
        let hides = frame.hides.filter(|_| layered).map(|hides| {
            let DepthImage { image, view, format, extent, before, after } = hides;
            let handle =
                graph.import_image("depth of the host", ImageDesc { format, extent }, before, Some(after));
            imports.push((handle.id(), Physical::Image(image, view)));
            handle
        });
        let beside = BesideHost {
            hides: hides.as_ref().map(|hides| (hides, depth)),
            depth: &mut surface_depth,
            layers: layers.as_mut(),
        };
        passes::frame(&mut graph, inputs, &plan, &mut surface, format, (false, Some(beside)))?;
        let Some(commands) = commands else { return Ok(()) };
        // SAFETY: as above.
        unsafe {
            renderer.shaders.begin_frame(commands)?;
            execution.record(commands, &graph, &imports)?;
        }

        let sampled =
            |binding, image: &crate::vk::Image| (binding, Descriptor::Sampled(image.view(), AFTER.layout));
        let set = |given: &[(u32, Descriptor)]| {
            // SAFETY: images of the view, which live as long as what it has prepared.
            unsafe { descriptors.set(&renderer.shaders.sums_set, given) }
        };
        let mut draws = Draws::new();
        let mut draw = |part, set| -> Result<()> {
            draws.push((renderer.shaders.graphics(self.rendering.key(part))?, set));
            Ok(())
        };
        if !plan.opaque.is_empty() {
            let set =
                set(&[sampled(BIND_SUMS_COLORS, &images.surface), sampled(BIND_SUMS_DEPTH, &images.depth)])?;
            draw(Part::Covering, set)?;
            if plan.opaque.settings.edges == Edges::Coverage {
                draw(Part::CoveringLess, set)?;
            }
        }
        if let (true, Some(layers)) = (layered, &images.layers) {
            draw(Part::Layers, set(&[sampled(BIND_SUMS_COLORS, layers)])?)?;
        }
        let [x, y] = frame.corner_px;
        let area = vk::Rect2D { offset: vk::Offset2D { x, y }, extent };
        self.prepared = Some(Prepared { area, depth, draws });
        Ok(())
    }

    /// Refuses a camera whose depth grows where the rendering's test has it fall: all would be hidden, or nothing; of parallel rays a picture that is
    /// turned over, too.
    fn check_order(&self, depth: DepthOfHost) -> Result<()> {
        let nearer_is_greater = match depth {
            DepthOfHost::Perspective { b, .. } => b > 0.0,
            DepthOfHost::Orthographic { b, .. } => b < 0.0,
        };
        match self.rendering.nearer_is_greater() {
            Some(greater) if self.rendering.has_depth() && greater != nearer_is_greater => {
                let (compare, is) =
                    (self.rendering.compare, if nearer_is_greater { "greater" } else { "less" });
                let problem = format!(
                    "{compare:?}, but by the camera's matrices what is nearer has the {is} depth: is depth reversed, or the viewport flipped?"
                );
                Err(Error::option("compare", problem))
            }
            _ => Ok(()),
        }
    }

    fn check(&self, frame: &ViewFrame<'_>, layered: bool) -> Result<()> {
        if frame.corner_px.iter().any(|at| *at < 0) {
            let [x, y] = frame.corner_px;
            return Err(Error::option(
                "corner_px",
                format!("{x},{y}: expected a corner within the host's image"),
            ));
        }
        if !layered {
            return Ok(());
        }
        let Some(hides) = &frame.hides else {
            return match self.rendering.has_depth() {
                false => Ok(()),
                true => Err(Error::option(
                    "hides",
                    "something is transparent: expected the depth of what the host has drawn, which hides it pixel by pixel",
                )),
            };
        };
        let holds = |at: i32, side: u32, whole: u32| {
            u64::from(at.unsigned_abs()) + u64::from(side) <= u64::from(whole)
        };
        let ([x, y], [width, height]) = (frame.corner_px, frame.settings.size_px);
        match holds(x, width, hides.extent.width) && holds(y, height, hides.extent.height) {
            true => Ok(()),
            false => {
                let vk::Extent2D { width: w, height: h } = hides.extent;
                let problem = format!("{w}x{h} pixels: expected {width}x{height} from {x},{y} on");
                Err(Error::option("hides", problem))
            }
        }
    }

    /// Records the draws of the frame that was prepared: up to three triangles. Clobbers viewport and scissor, and of the graphics bind point the
    /// pipeline, all descriptor sets and push constants.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] if no frame is prepared.
    ///
    /// # Safety
    /// `commands` are those of [`View::prepare`], or others that are submitted after them to the same queue; they are inside of a rendering as the
    /// view was made for, which covers the view's area. The view stays alive, and is not prepared again, until they have run.
    pub unsafe fn draw(&self, renderer: &Renderer, commands: vk::CommandBuffer) -> Result<()> {
        let Some(Prepared { area, depth, draws }) = &self.prepared else {
            return Err(Error::option("draw", "no frame is prepared: expected prepare before"));
        };
        let layout = renderer.shaders.layout(Layout::Host)?;
        let viewport = vk::Viewport {
            x: area.offset.x as f32,
            y: area.offset.y as f32,
            width: area.extent.width as f32,
            height: area.extent.height as f32,
            min_depth: 0.0,
            max_depth: 1.0,
        };
        let (raw, graphics) = (self.device.raw(), vk::PipelineBindPoint::GRAPHICS);
        // SAFETY: this function's contract; pipelines and sets have this layout, and live as long as renderer and view.
        unsafe {
            raw.cmd_set_viewport(commands, 0, &[viewport]);
            raw.cmd_set_scissor(commands, 0, std::slice::from_ref(area));
            raw.cmd_push_constants(
                commands,
                layout.raw(),
                layout.push_stages(),
                0,
                bytemuck::bytes_of(depth),
            );
            for (pipeline, set) in draws {
                raw.cmd_bind_pipeline(commands, graphics, *pipeline);
                raw.cmd_bind_descriptor_sets(commands, graphics, layout.raw(), 0, &[*set], &[]);
                raw.cmd_draw(commands, 3, 1, 0, 0);
            }
        }
        Ok(())
    }

    /// How long each pass of the frame took that was prepared last; `None` if it was not to be timed.
    ///
    /// # Errors
    /// Whatever the driver answers.
    ///
    /// # Safety
    /// That frame has finished.
    pub unsafe fn profile(&self) -> Result<Option<FrameProfile>> {
        // SAFETY: this function's contract.
        self.slot.profiler().map(|profiler| unsafe { profiler.read() }).transpose()
    }

    /// Bytes of device memory that the view holds: images for its draws, and what its passes share.
    pub fn bytes(&self) -> u64 {
        let images = self.images.as_ref().map_or(0, |images| {
            let all = [Some(&images.surface), Some(&images.depth), images.layers.as_ref()];
            all.into_iter().flatten().map(crate::vk::Image::bytes).sum()
        });
        images + self.slot.transient_bytes()
    }
}

/// How the host's depth follows from w, of which z is near / w, or from where depth begins on linear in it.
fn host_depth(depth: DepthOfHost, camera: &Camera, range: DepthRange) -> HostDepth {
    let [scale, offset] = match depth {
        DepthOfHost::Perspective { a, b } => [b / camera.near(), a],
        DepthOfHost::Orthographic { a, b } => [-b * range.end, a + b * (range.from_eye + range.end)],
    };
    HostDepth { scale: scale as f32, offset: offset as f32, ..HostDepth::default() }
}

#[cfg(test)]
mod tests {
    /// As `docs/embedding.md` says. Fails to compile where that is not so.
    #[test]
    fn devices_and_renderers_are_shared_between_threads_and_views_go_to_one() {
        fn shared<T: Send + Sync>() {}
        fn sent<T: Send>() {}
        shared::<crate::vk::Device>();
        shared::<crate::renderer::Renderer>();
        sent::<super::View>();
    }
}
