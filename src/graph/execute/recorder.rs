//! Records what surrounds the bodies of passes: barriers, and the begin of rendering.

use ash::vk;

use super::{
    super::{Attachment, Barrier, Plan, PlannedPass, ResourceDesc, ResourceId, Scope, aspect_of},
    Physical,
    part::Runs,
};
use crate::{
    arena::Arena,
    error::{ErrorKind, Result},
    vk::Device,
};

/// Records into one command buffer for one plan.
pub(super) struct Recorder<'a> {
    pub(super) device: &'a Device,
    pub(super) commands: vk::CommandBuffer,
    pub(super) plan: &'a Plan,
    pub(super) physical: &'a [Option<Physical>],
    /// For what a command is told.
    pub(super) arena: &'a Arena,
    /// Is told of pipelines that run.
    pub(super) runs: Option<&'a dyn Runs>,
}

impl Recorder<'_> {
    /// One `vkCmdPipelineBarrier2` for all of a batch: memory, source and destination, and resources.
    ///
    /// # Safety
    /// As [`super::execute`].
    pub(super) unsafe fn barriers(
        &self,
        memory: Option<(Scope, Scope)>,
        resources: &[Barrier],
    ) -> Result<()> {
        if memory.is_none() && resources.is_empty() {
            return Ok(());
        }
        let memory = memory.map(|(src, dst)| {
            vk::MemoryBarrier2::default()
                .src_stage_mask(src.stages)
                .src_access_mask(src.access)
                .dst_stage_mask(dst.stages)
                .dst_access_mask(dst.access)
        });
        let (mut images, mut buffers) = (self.arena.growing(), self.arena.growing());
        for barrier in resources {
            match self.object(barrier.resource)? {
                Physical::Image(image, _) => images.push(self.image_barrier(barrier, image, 0)),
                Physical::Layer(image, _, layer) => images.push(self.image_barrier(barrier, image, layer)),
                Physical::Buffer(buffer) | Physical::TexelBuffer(buffer, _) => {
                    buffers.push(buffer_barrier(barrier.src, barrier.dst, buffer));
                }
            }
        }
        let info = vk::DependencyInfo::default()
            .memory_barriers(memory.as_slice())
            .image_memory_barriers(&images)
            .buffer_memory_barriers(&buffers);
        // SAFETY: this function's contract.
        unsafe { self.device.raw().cmd_pipeline_barrier2(self.commands, &info) };
        Ok(())
    }

    /// Begins dynamic rendering for a graphics pass and sets viewport and scissor.
    ///
    /// # Safety
    /// As [`super::execute`].
    pub(super) unsafe fn begin_rendering(&self, pass: &PlannedPass) -> Result<()> {
        let Some(rendering) = &pass.rendering else { return Ok(()) };
        let colors = rendering.colors.iter().map(|attachment| self.attachment(attachment));
        let colors = self.arena.try_list(colors)?;
        let depth = rendering.depth.as_ref().map(|attachment| self.attachment(attachment)).transpose()?;
        let area = vk::Rect2D::default().extent(rendering.extent);
        let mut info =
            vk::RenderingInfo::default().render_area(area).layer_count(1).color_attachments(colors);
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
        let (Physical::Image(_, view) | Physical::Layer(_, view, _)) = self.object(attachment.resource)?
        else {
            return Err(self.refuse(attachment.resource, "is a buffer and can't be an attachment"));
        };
        Ok(vk::RenderingAttachmentInfo::default()
            .image_view(view)
            .image_layout(attachment.layout)
            .load_op(attachment.load)
            .store_op(attachment.store)
            .clear_value(attachment.clear.map(Into::into).unwrap_or_default()))
    }

    fn image_barrier(
        &self,
        barrier: &Barrier,
        image: vk::Image,
        layer: u32,
    ) -> vk::ImageMemoryBarrier2<'static> {
        let aspect = match self.plan.resource(barrier.resource).desc {
            ResourceDesc::Image(desc) => aspect_of(desc.format),
            ResourceDesc::Buffer(_) => vk::ImageAspectFlags::empty(),
        };
        let range = vk::ImageSubresourceRange::default()
            .aspect_mask(aspect)
            .level_count(1)
            .base_array_layer(layer)
            .layer_count(1);
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

    pub(super) fn object(&self, id: ResourceId) -> Result<Physical> {
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
