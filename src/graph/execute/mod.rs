//! Records a plan into a command buffer that is given: the only part of the graph that knows a device. It never
//! submits and never waits.

mod profiler;
mod transients;

use ash::vk;

pub use self::{
    profiler::{FrameProfile, PassCounts, PassProfile, Profile, Profiler},
    transients::{Transients, memory_need},
};
use super::{
    Access, Attachment, Barrier, Batch, Compiled, PassKind, Plan, PlannedPass, ResourceDesc, ResourceId,
    Scope, aspect_of,
};
use crate::{
    error::{ErrorKind, Result},
    vk::Device,
};

/// What a pass records: it is called between the pass's barriers and the next pass, inside of dynamic rendering for
/// a graphics pass, with viewport and scissor set to the whole of the attachments.
pub type Body<'a> = Box<dyn FnOnce(&PassContext<'_>) -> Result<()> + 'a>;

/// What a body records with.
pub struct PassContext<'a> {
    device: &'a Device,
    commands: vk::CommandBuffer,
    physical: &'a [Option<Physical>],
    pass: &'a PlannedPass,
}

/// The Vulkan object behind a resource.
#[derive(Clone, Copy, Debug)]
pub enum Physical {
    /// An image and the view of all of it.
    Image(vk::Image, vk::ImageView),
    /// A buffer.
    Buffer(vk::Buffer),
    /// A buffer, and the view of all of its texels.
    TexelBuffer(vk::Buffer, vk::BufferView),
}

impl PassContext<'_> {
    /// The device.
    pub fn device(&self) -> &ash::Device {
        self.device.raw()
    }

    /// The command buffer, recording.
    pub fn commands(&self) -> vk::CommandBuffer {
        self.commands
    }

    /// The image behind a resource that the pass declared.
    ///
    /// # Errors
    /// [`ErrorKind::Graph`] for one that it did not declare.
    pub fn image(&self, id: ResourceId) -> Result<(vk::Image, vk::ImageView)> {
        match self.declared(id)? {
            Physical::Image(image, view) => Ok((image, view)),
            Physical::Buffer(_) | Physical::TexelBuffer(..) => {
                Err(self.refuse(id, "is a buffer, not an image"))
            }
        }
    }

    /// The buffer behind a resource that the pass declared.
    ///
    /// # Errors
    /// [`ErrorKind::Graph`] for one that it did not declare.
    pub fn buffer(&self, id: ResourceId) -> Result<vk::Buffer> {
        match self.declared(id)? {
            Physical::TexelBuffer(..) if self.reads_texels(id) => {
                Err(self.refuse(id, "was declared to be read by texels"))
            }
            Physical::Buffer(buffer) | Physical::TexelBuffer(buffer, _) => Ok(buffer),
            Physical::Image(..) => Err(self.refuse(id, "is an image, not a buffer")),
        }
    }

    /// The texels of a buffer that the pass declared to read by them.
    ///
    /// # Errors
    /// [`ErrorKind::Graph`] for one that it did not declare, or that has none.
    pub fn texels(&self, id: ResourceId) -> Result<vk::BufferView> {
        match self.declared(id)? {
            Physical::TexelBuffer(_, texels) if self.reads_texels(id) => Ok(texels),
            Physical::TexelBuffer(..) => Err(self.refuse(id, "was not declared to be read by texels")),
            _ => Err(self.refuse(id, "has no texels")),
        }
    }

    fn reads_texels(&self, id: ResourceId) -> bool {
        self.pass.uses.iter().any(|usage| usage.resource == id && usage.access == Access::TexelReadCompute)
    }

    /// The layout in which the pass finds an image that it declared.
    pub fn layout(&self, id: ResourceId) -> vk::ImageLayout {
        let uses = self.pass.uses.iter().filter(|usage| usage.resource == id);
        uses.filter_map(|usage| usage.access.info().image).next().map_or(vk::ImageLayout::UNDEFINED, |i| i.0)
    }

    fn declared(&self, id: ResourceId) -> Result<Physical> {
        // A body that reaches for what it did not declare would race: no barrier knows of it.
        if !self.pass.uses.iter().any(|usage| usage.resource == id) {
            return Err(self.refuse(id, "is used by the pass but not declared"));
        }
        self.physical[id.index()]
            .ok_or_else(|| self.refuse(id, "has no Vulkan object: an import was not given"))
    }

    fn refuse(&self, id: ResourceId, reason: &str) -> crate::error::Error {
        let resource = format!("#{}", id.index());
        ErrorKind::Graph { pass: self.pass.name.clone(), resource, reason: reason.to_owned() }.into()
    }
}

/// Records every pass of a compiled graph: its barriers, its debug label, its queries, its rendering, its body.
///
/// # Errors
/// [`ErrorKind::Graph`] if an import is missing or of the wrong kind, before anything is recorded; whatever a body
/// answers: then the command buffer is well-formed, but must not be submitted, for later passes are missing.
///
/// # Safety
/// `commands` must be recording, outside of rendering, and be submitted to the queue of the device's family, after
/// earlier executions with the same `transients`. `imports` must be alive until it has run, of the declared
/// description, and in their declared initial states. `profiler`'s earlier frame must have finished.
pub unsafe fn execute(
    device: &Device,
    commands: vk::CommandBuffer,
    compiled: Compiled<Body<'_>>,
    transients: &Transients,
    imports: &[(ResourceId, Physical)],
    mut profiler: Option<&mut Profiler>,
) -> Result<()> {
    let Compiled { plan, bodies } = compiled;
    let mut physical = transients.physical(plan.resources.len());
    for (id, object) in imports {
        if let Some(place) = physical.get_mut(id.index()) {
            *place = Some(*object);
        }
    }
    // Before the first command: what fails later would leave labels and queries open.
    check_objects(&plan, &physical)?;
    let recorder = Recorder { device, commands, plan: &plan, physical: &physical };
    if let Some(profiler) = &mut profiler {
        // SAFETY: this function's contract.
        unsafe { profiler.begin_frame(commands, plan.passes.iter()) };
    }
    let profiler = profiler.as_deref();
    for ((index, pass), body) in (0..).zip(&plan.passes).zip(bodies) {
        let draws = pass.rendering.is_some();
        // Copies have nothing to count.
        let counts = draws || pass.kind == PassKind::Compute;
        device.begin_label(commands, &pass.name);
        // SAFETY: this function's contract, here and below.
        unsafe {
            recorder.barriers(&pass.barriers)?;
            recorder.begin_rendering(pass)?;
            profiler.filter(|_| counts).inspect(|profiler| profiler.begin_counts(commands, index));
        }
        let done = body(&PassContext { device, commands, physical: &physical, pass });
        // Also after a body that failed, so that the command buffer stays well-formed.
        // SAFETY: as above.
        unsafe {
            profiler.filter(|_| counts).inspect(|profiler| profiler.end_counts(commands, index));
            if draws {
                device.raw().cmd_end_rendering(commands);
            }
            profiler.inspect(|profiler| profiler.end_pass(commands, index));
        }
        device.end_label(commands);
        done?;
    }
    let last = Batch { memory: None, resources: plan.final_barriers.clone() };
    // SAFETY: this function's contract.
    unsafe { recorder.barriers(&last) }
}

/// Refuses a plan of which a resource in use has no object, or one of another kind.
fn check_objects(plan: &Plan, physical: &[Option<Physical>]) -> Result<()> {
    for (resource, object) in plan.resources.iter().zip(physical) {
        let reason = match (object, resource.desc) {
            (Some(Physical::Image(..)), ResourceDesc::Image(_))
            | (Some(Physical::Buffer(_) | Physical::TexelBuffer(..)), ResourceDesc::Buffer(_)) => continue,
            (None, _) if resource.lifetime.is_none() => continue,
            (None, _) => "has no Vulkan object: an import was not given",
            (Some(Physical::Image(..)), ResourceDesc::Buffer(_)) => "is a buffer, and an image was given",
            (Some(_), ResourceDesc::Image(_)) => "is an image, and a buffer was given",
        };
        let (pass, resource) = (String::new(), resource.name.clone());
        return Err(ErrorKind::Graph { pass, resource, reason: reason.to_owned() }.into());
    }
    Ok(())
}

struct Recorder<'a> {
    device: &'a Device,
    commands: vk::CommandBuffer,
    plan: &'a Plan,
    physical: &'a [Option<Physical>],
}

impl Recorder<'_> {
    /// One `vkCmdPipelineBarrier2` for all of a batch.
    ///
    /// # Safety
    /// As [`execute`].
    unsafe fn barriers(&self, batch: &Batch) -> Result<()> {
        if batch.is_empty() {
            return Ok(());
        }
        let memory: Vec<_> = batch
            .memory
            .iter()
            .map(|(src, dst)| {
                vk::MemoryBarrier2::default()
                    .src_stage_mask(src.stages)
                    .src_access_mask(src.access)
                    .dst_stage_mask(dst.stages)
                    .dst_access_mask(dst.access)
            })
            .collect();
        let (mut images, mut buffers) = (Vec::new(), Vec::new());
        for barrier in &batch.resources {
            match self.object(barrier.resource)? {
                Physical::Image(image, _) => images.push(self.image_barrier(barrier, image)),
                Physical::Buffer(buffer) | Physical::TexelBuffer(buffer, _) => {
                    buffers.push(buffer_barrier(barrier.src, barrier.dst, buffer));
                }
            }
        }
        let info = vk::DependencyInfo::default()
            .memory_barriers(&memory)
            .image_memory_barriers(&images)
            .buffer_memory_barriers(&buffers);
        // SAFETY: this function's contract.
        unsafe { self.device.raw().cmd_pipeline_barrier2(self.commands, &info) };
        Ok(())
    }

    /// Begins dynamic rendering for a graphics pass and sets viewport and scissor.
    ///
    /// # Safety
    /// As [`execute`].
    unsafe fn begin_rendering(&self, pass: &PlannedPass) -> Result<()> {
        let Some(rendering) = &pass.rendering else { return Ok(()) };
        let colors = rendering.colors.iter().map(|attachment| self.attachment(attachment));
        let colors = colors.collect::<Result<Vec<_>>>()?;
        let depth = rendering.depth.as_ref().map(|attachment| self.attachment(attachment)).transpose()?;
        let area = vk::Rect2D::default().extent(rendering.extent);
        let mut info =
            vk::RenderingInfo::default().render_area(area).layer_count(1).color_attachments(&colors);
        if let Some(depth) = &depth {
            info = info.depth_attachment(depth);
        }
        let viewport = vk::Viewport::default()
            .width(rendering.extent.width as f32)
            .height(rendering.extent.height as f32)
            .max_depth(1.0);
        let device = self.device.raw();
        // SAFETY: this function's contract.
        unsafe {
            device.cmd_begin_rendering(self.commands, &info);
            device.cmd_set_viewport(self.commands, 0, &[viewport]);
            device.cmd_set_scissor(self.commands, 0, &[area]);
        }
        Ok(())
    }

    fn attachment(&self, attachment: &Attachment) -> Result<vk::RenderingAttachmentInfo<'static>> {
        let Physical::Image(_, view) = self.object(attachment.resource)? else {
            return Err(self.refuse(attachment.resource, "is a buffer and can't be an attachment"));
        };
        Ok(vk::RenderingAttachmentInfo::default()
            .image_view(view)
            .image_layout(attachment.layout)
            .load_op(attachment.load)
            .store_op(attachment.store)
            .clear_value(attachment.clear.map(Into::into).unwrap_or_default()))
    }

    fn image_barrier(&self, barrier: &Barrier, image: vk::Image) -> vk::ImageMemoryBarrier2<'static> {
        let aspect = match self.plan.resource(barrier.resource).desc {
            ResourceDesc::Image(desc) => aspect_of(desc.format),
            ResourceDesc::Buffer(_) => vk::ImageAspectFlags::empty(),
        };
        let range = vk::ImageSubresourceRange::default().aspect_mask(aspect).level_count(1).layer_count(1);
        let (old, new) = barrier.transition.map_or_else(Default::default, |t| (t.old, t.new));
        vk::ImageMemoryBarrier2::default()
            .src_stage_mask(barrier.src.stages)
            .src_access_mask(barrier.src.access)
            .dst_stage_mask(barrier.dst.stages)
            .dst_access_mask(barrier.dst.access)
            .old_layout(old)
            .new_layout(new)
            .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
            .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
            .image(image)
            .subresource_range(range)
    }

    fn object(&self, id: ResourceId) -> Result<Physical> {
        self.physical[id.index()]
            .ok_or_else(|| self.refuse(id, "has no Vulkan object: an import was not given"))
    }

    fn refuse(&self, id: ResourceId, reason: &str) -> crate::error::Error {
        let resource = self.plan.resource(id).name.clone();
        ErrorKind::Graph { pass: String::new(), resource, reason: reason.to_owned() }.into()
    }
}

fn buffer_barrier(src: Scope, dst: Scope, buffer: vk::Buffer) -> vk::BufferMemoryBarrier2<'static> {
    vk::BufferMemoryBarrier2::default()
        .src_stage_mask(src.stages)
        .src_access_mask(src.access)
        .dst_stage_mask(dst.stages)
        .dst_access_mask(dst.access)
        .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
        .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
        .buffer(buffer)
        .size(vk::WHOLE_SIZE)
}
