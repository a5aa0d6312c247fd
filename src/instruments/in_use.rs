//! Looks into the lists of a frame: how much they hold only the device knows.

use std::collections::BTreeMap;

use ash::vk;

use super::list_occupancy::{self, ListOccupancy};
use crate::renderer::{Headless, Imports, Readbacks, Renderer, declare, headless::submit_and_wait};
use crate::{
    arena::Arena,
    error::Result,
    frame::{Execution, FrameSlot, HeadlessTarget, SlotParts},
    graph::{
        BufferDesc as GraphBufferDesc, BufferState, Graph,
        execute::{Body, Physical},
    },
    passes::{self, FramePlan, Inputs, Place, Source},
    prepare::{Placed, PreparedScene},
    scene::{Camera, Settings},
    vk::{Buffer, BufferDesc, Device, MemoryUse},
};

#[cfg(feature = "inside")]
impl Headless {
    /// What the lists of a frame hold: draws it once, in memory of its own, and reads back the buffers that tell it.
    ///
    /// # Errors
    /// As [`crate::renderer::Renderer::record`].
    pub fn list_occupancy(
        &self,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
    ) -> Result<ListOccupancy> {
        let (device, renderer) = (self.device(), &self.renderer);
        let arena = Arena::new();
        let frame = renderer.frame_plan(&arena, &[Placed::at_home(scene)], camera, settings)?;
        let target = HeadlessTarget::new(device, vk::Format::R8G8B8A8_SRGB, settings.size_px)?;
        let mut slot = FrameSlot::new(device);
        let (inputs, execution) = inputs_of(renderer, &mut slot, &frame, (camera, settings))?;
        let (mut graph, mut imports) =
            declare(&arena, inputs, &frame, &target.target(), Readbacks::default())?;
        let counters = list_occupancy::counter_buffers(&arena, inputs, &frame).into_iter();
        let buffers = read_back((&mut graph, &mut imports), inputs.source, counters, device)?;
        let mut names = Vec::new();
        submit_and_wait(self, |commands| {
            // SAFETY: recording; all that is used is alive until the wait.
            let plan = unsafe {
                renderer.shaders.begin_frame(commands)?;
                execution.record(commands, &graph, &imports)
            }?;
            names.extend(plan.resources.iter().map(|resource| resource.name.clone()));
            Ok(())
        })?;
        let words = |buffer: &Buffer| {
            // SAFETY: waited for.
            unsafe { buffer.bytes() }.chunks_exact(4).map(bytemuck::pod_read_unaligned).collect::<Vec<u32>>()
        };
        let told: BTreeMap<_, _> =
            buffers.iter().map(|(name, buffer)| (name.clone(), words(buffer))).collect();
        let mut in_use = ListOccupancy::of(inputs, &frame, &told);
        // Lists of large splats, or of those that something hides.
        for name in names.into_iter().filter(|name| name.contains("list of ")) {
            in_use.bytes.entry(name).or_insert(0);
        }
        Ok(in_use)
    }
}

/// A frame in a slot that nothing was recorded in yet, and what records it.
pub(super) fn inputs_of<'a>(
    renderer: &'a Renderer,
    slot: &'a mut FrameSlot,
    frame: &'a FramePlan<'a>,
    (camera, settings): (&'a Camera, &'a Settings),
) -> Result<(Inputs<'a>, Execution<'a>)> {
    let counts_draws = renderer.device().facts().draw_indirect_count;
    // SAFETY: nothing was recorded in it.
    unsafe { slot.begin(passes::needs(frame, settings, counts_draws), None) }?;
    // SAFETY: as above.
    let planes = unsafe { slot.planes(&frame.planes) }?;
    let SlotParts { descriptors, occlusion, execution } = slot.parts()?;
    let place = Place::Device(&renderer.shaders, descriptors);
    let inputs = Inputs { occlusion, range: frame.range, ..Inputs::new(camera, settings, place) };
    let source = inputs.source.cut_by(planes);
    Ok((Inputs { source, ..inputs }, execution))
}

/// Declares a copy of each of these buffers that a frame has, by name, for the host.
pub(super) fn read_back<'a>(
    (graph, imports): (&mut Graph<'a, Body<'a>>, &mut Imports<'a>),
    source: Source<'a>,
    names: impl Iterator<Item = String>,
    device: &Device,
) -> Result<Vec<(String, Buffer)>> {
    let host = BufferState { stages: vk::PipelineStageFlags2::HOST, access: vk::AccessFlags2::HOST_READ };
    let mut buffers = Vec::new();
    for name in names {
        let Some((content, GraphBufferDesc { size_bytes: size, .. })) = graph.content_of(&name) else {
            continue;
        };
        let copy = format!("read-back of {name}");
        let desc = BufferDesc { name: &copy, size, usage: vk::BufferUsageFlags::TRANSFER_DST };
        let buffer = Buffer::new(device, desc, MemoryUse::Readback)?;
        let desc = GraphBufferDesc::of_bytes(size);
        let mut to = graph.import_buffer(&copy, desc, BufferState::default(), Some(host));
        imports.push((to.id(), Physical::Buffer(buffer.raw())));
        passes::readback_buffer(graph, source, format_args!("read back {name}"), &content, &mut to, size);
        buffers.push((name, buffer));
    }
    Ok(buffers)
}
