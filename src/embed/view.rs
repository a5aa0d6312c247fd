//! A view: passes outside of the host's rendering, draws within it.

use ash::vk;

use super::{
    fields::as_fields,
    frame::ViewFrame,
    images::{AFTER, Images},
    motion::Motion,
    over::{Part, Rendering},
    planned::{Planned, declare},
    to::To,
    under_way::{OfHost, UnderWay},
};
use crate::{
    arena::Arena,
    error::Result,
    frame::{FrameSlot, SlotParts},
    inline_vec::InlineVec,
    passes::{self, HostDepth, Inputs, Place, Source, Tints},
    prepare::NO_TINT,
    renderer::Renderer,
    scene::Edges,
    shaders::config::{BIND_SUMS_COLORS, BIND_SUMS_DEPTH},
    vk::{Descriptor, Device, PoolSizes},
};

/// One view of a host. It keeps what passes leave for draws, of the frame that was prepared last: that is drawn before the next one is prepared. With several frames in flight a host has one for
/// each, so that none waits for draws of the one before.
///
/// ```no_run
/// use surfel::{ash::vk, embed::{Renderer, View, ViewFrame}};
///
/// /// `begin` and `end` are around a rendering of the host's, such as the view was made for.
/// unsafe fn record(view: &mut View, renderer: &Renderer, commands: vk::CommandBuffer, frame: &ViewFrame<'_>, [begin, end]: [&dyn Fn(); 2]) -> surfel::Result<()> {
///     // SAFETY: this function's contract, that of `prepare` and `draw`.
///     unsafe { view.prepare(renderer, commands, frame) }?;
///     begin();
///     // SAFETY: as above, within the rendering that has begun.
///     let drawn = unsafe { view.draw(renderer, commands) };
///     end();
///     drawn
/// }
/// ```
pub struct View {
    pub(super) device: Device,
    pub(super) rendering: Rendering,
    /// Of the renderer that it was made with, whose pipelines it draws with.
    pub(super) renderer: u64,
    pub(super) slot: FrameSlot,
    pub(super) images: Images,
    pub(super) of_host: OfHost,
    pub(super) under_way: UnderWay,
    /// What the frame that was prepared last has to draw.
    pub(super) prepared: Option<Prepared>,
}

/// What draws are recorded with.
pub(super) struct Prepared {
    pub area: vk::Rect2D,
    pub depth: HostDepth,
    pub draws: Draws,
    /// What is known of objects, where it is wanted.
    pub objects: Option<vk::DescriptorSet>,
}

/// At most one of each part.
pub(super) type Draws = InlineVec<(vk::Pipeline, vk::DescriptorSet), 3>;

/// Draws take two sets, each of the surface or of layers, and one of objects.
const SETS_OF_DRAWS: PoolSizes = PoolSizes {
    sets: 3,
    buffers: 1,
    uniform_buffers: 2,
    texel_buffers: 0,
    images: 11,
    filtered_images: 0,
    storage_images: 0,
};

impl View {
    /// A view to be drawn within such a rendering. Its pipelines are made here.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for a rendering that the device does not have, or that compares depths in no order; whatever the driver answers.
    pub fn new(renderer: &Renderer, rendering: &Rendering) -> Result<Self> {
        let view = Self::without_pipelines(renderer, rendering)?;
        for part in rendering.parts() {
            renderer.shaders.graphics(rendering.key(*part))?;
        }
        Ok(view)
    }

    /// The same before its pipelines are made.
    pub(super) fn without_pipelines(renderer: &Renderer, rendering: &Rendering) -> Result<Self> {
        rendering.check(renderer.device())?;
        let device = renderer.device().clone();
        let slot = FrameSlot::new(&device);
        Ok(Self {
            device,
            rendering: rendering.clone(),
            renderer: renderer.number,
            slot,
            images: Images::default(),
            of_host: OfHost::default(),
            under_way: UnderWay::default(),
            prepared: None,
        })
    }

    /// Records the passes of a frame: all but its draws.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for another renderer than the view's, a camera that is none, several samples of a pixel (a host takes them itself, by jittered cameras), something
    /// transparent beside a host's depth that is not given, 256 frames of the view that may be under way; as [`Renderer::check`], and whatever driver or allocator answer.
    ///
    /// # Safety
    /// `commands` must be recording, outside of rendering, without an active query, and be submitted to the device's queue. Renderer, scenes, view and the depth image must stay alive until it has run. It runs after the frames that were
    /// prepared before in this view, if those run: they are recorded before it in the same commands, or submitted before. Each of them has finished, or will never run, or is submitted before the [`Device::end_epoch`] that follows its
    /// `prepare`. The depth image is what it says, and in the state it says.
    pub unsafe fn prepare(
        &mut self,
        renderer: &Renderer,
        commands: vk::CommandBuffer,
        frame: &ViewFrame<'_>,
    ) -> Result<()> {
        let arena = self.slot.take_arena();
        // SAFETY: this function's contract.
        let recorded = unsafe { self.record_passes(&arena, renderer, To::Commands(commands), frame) };
        self.slot.give_back(arena);
        recorded.map_err(as_fields)
    }

    /// The same, in a frame's memory; of one that is not recorded, all up to there: its pipelines are there then.
    ///
    /// # Safety
    /// As [`Self::prepare`].
    pub(super) unsafe fn record_passes(
        &mut self,
        arena: &Arena,
        renderer: &Renderer,
        to: To,
        frame: &ViewFrame<'_>,
    ) -> Result<()> {
        self.prepared = None;
        renderer.staging.give_back_idle();
        let ahead = to.ahead();
        let planned = self.planned(arena, renderer, &to, frame)?;
        let Planned { settings, camera, camera_before, depth, plan, .. } = &planned;
        let size_px = if ahead.is_none() { settings.size_px } else { [1; 2] };
        let (format, of) = (planned.format, (planned.layered, planned.finds_objects));
        let images = self.images.fit(&self.device, (format, size_px), of)?;

        let counts_draws = self.device.facts().draw_indirect_count;
        let mut needs = passes::needs(plan, settings, counts_draws);
        needs.room = needs.room.plus(&SETS_OF_DRAWS);
        if ahead.is_none() {
            self.under_way.keep_apart(&self.device, &mut self.slot, &mut self.of_host)?;
        }
        // SAFETY: this function's contract, here and below: what the host writes is of a frame of an epoch that is done, and so submitted and finished, or never to be.
        unsafe { self.slot.begin(needs, frame.profile) }?;
        // SAFETY: as above.
        let planes = unsafe { self.slot.planes(&plan.planes) }?;
        let mut tints = [None; 2];
        if frame.scenes.iter().any(|placed| placed.tint != NO_TINT) {
            let parts = [&plan.opaque, &plan.transparent];
            for ((tints, table), part) in tints.iter_mut().zip(&mut self.of_host.tints).zip(parts) {
                let all = arena.list(part.placed().map(|placed| frame.scenes[placed as usize].tint));
                if !all.is_empty() {
                    // SAFETY: as above.
                    let (buffer, bytes) = unsafe { table.write(&self.device, "tints", all) }?;
                    *tints = Some(Tints { buffer, bytes });
                }
            }
        }
        let SlotParts { descriptors, occlusion, execution } = self.slot.parts()?;
        let inputs = Inputs::new(camera, settings, Place::Device(&renderer.shaders, descriptors));
        let source = Source { missing: frame.missing, ..inputs.source.cut_by(planes) };
        let inputs = Inputs { occlusion, range: plan.range, source, tints, ..inputs };

        let (graph, imports) = declare(arena, inputs, &planned, frame.hides, Some(&images))?;
        let To::Commands(commands) = to else { return Ok(()) };
        self.under_way.record(&self.device);
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
                set(&[sampled(BIND_SUMS_COLORS, images.surface), sampled(BIND_SUMS_DEPTH, images.depth)])?;
            draw(Part::Covering, set)?;
            if plan.opaque.settings.edges == Edges::Coverage && self.rendering.has_color() {
                draw(Part::CoveringLess, set)?;
            }
        }
        if let Some(layers) = images.layers {
            draw(Part::Layers, set(&[sampled(BIND_SUMS_COLORS, layers)])?)?;
        }
        let objects = match (&plan.objects, images.objects) {
            (Some(drawn), Some(image)) => {
                let motion = Motion::new([camera, camera_before], plan.range, settings.size_px);
                let of = arena.list(frame.scenes.iter().map(|placed| motion.of(placed)));
                let all = arena.list(drawn.placed().map(|placed| of[placed as usize]));
                // SAFETY: this function's contract.
                let (buffer, bytes) =
                    unsafe { self.of_host.objects.write(&self.device, "objects of a host", all) }?;
                let given = [sampled(0, image), (1, Descriptor::Buffer(buffer, bytes))];
                // SAFETY: as above; view and images live as long as its commands run.
                Some(unsafe { descriptors.set(&renderer.shaders.objects_set, &given) }?)
            }
            _ => None,
        };
        let ([x, y], [width, height]) = (frame.corner_px, settings.size_px);
        let (offset, extent) = (vk::Offset2D { x, y }, vk::Extent2D { width, height });
        self.prepared = Some(Prepared { area: vk::Rect2D { offset, extent }, depth: *depth, draws, objects });
        Ok(())
    }
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
        shared::<crate::prepare::PreparedScene>();
        sent::<super::View>();
    }
}
