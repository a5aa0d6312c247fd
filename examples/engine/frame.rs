//! A frame of the engine: recorded, submitted and waited for.

use ash::vk;

use super::{Engine, Style, make::aspect_of};

impl Engine {
    /// Begins to record.
    pub fn begin(&self) {
        let once = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        // SAFETY: the submission before was waited for.
        unsafe {
            self.device.reset_command_pool(self.pool, vk::CommandPoolResetFlags::empty()).unwrap();
            self.device.begin_command_buffer(self.commands, &once).unwrap();
        }
    }

    /// Begins to draw: over what there is, or over nothing.
    pub fn begin_rendering(&self, clears: bool) {
        let Style { size_px: [width, height], samples, .. } = self.style;
        let load = if clears { vk::AttachmentLoadOp::CLEAR } else { vk::AttachmentLoadOp::LOAD };
        let from = if clears { vk::ImageLayout::UNDEFINED } else { vk::ImageLayout::ATTACHMENT_OPTIMAL };
        self.barrier(from, vk::ImageLayout::ATTACHMENT_OPTIMAL);
        let clear_depth = vk::ClearDepthStencilValue { depth: self.style.clear_depth, stencil: 0 };
        let attached = |view, clear_value| {
            vk::RenderingAttachmentInfo::default()
                .image_view(view)
                .image_layout(vk::ImageLayout::ATTACHMENT_OPTIMAL)
                .load_op(load)
                .store_op(vk::AttachmentStoreOp::STORE)
                .clear_value(clear_value)
        };
        let mut color = attached(self.color.view, vk::ClearValue::default());
        if samples != vk::SampleCountFlags::TYPE_1 {
            color = color
                .resolve_mode(vk::ResolveModeFlags::AVERAGE)
                .resolve_image_view(self.resolved.view)
                .resolve_image_layout(vk::ImageLayout::ATTACHMENT_OPTIMAL);
        }
        let told = self.told.iter().flatten().map(|told| attached(told.view, vk::ClearValue::default()));
        let colors: Vec<_> = [color].into_iter().chain(told).collect();
        let depth = attached(self.depth.view, vk::ClearValue { depth_stencil: clear_depth });
        let area = vk::Rect2D { extent: vk::Extent2D { width, height }, ..vk::Rect2D::default() };
        let info = vk::RenderingInfo::default()
            .render_area(area)
            .layer_count(1)
            .color_attachments(&colors)
            .depth_attachment(&depth);
        // SAFETY: recording, with both images in this layout.
        unsafe { self.device.cmd_begin_rendering(self.commands, &info) };
    }

    /// Draws a triangle, by its corners in clip space, in one color. With `flips_y` by a viewport of negative height.
    pub fn triangle(&self, corners: [[f32; 4]; 3], color: [f32; 4], flips_y: bool) {
        let [width, height] = self.style.size_px.map(|side| side as f32);
        let viewport = match flips_y {
            false => vk::Viewport { x: 0.0, y: 0.0, width, height, min_depth: 0.0, max_depth: 1.0 },
            true => {
                vk::Viewport { x: 0.0, y: height, width, height: -height, min_depth: 0.0, max_depth: 1.0 }
            }
        };
        let [width, height] = self.style.size_px;
        let scissor = vk::Rect2D { extent: vk::Extent2D { width, height }, ..vk::Rect2D::default() };
        let numbers: Vec<u8> =
            corners.iter().flatten().chain(&color).flat_map(|number| number.to_ne_bytes()).collect();
        let stages = vk::ShaderStageFlags::VERTEX | vk::ShaderStageFlags::FRAGMENT;
        // SAFETY: inside of rendering; the layout is the pipeline's.
        unsafe {
            self.device.cmd_bind_pipeline(self.commands, vk::PipelineBindPoint::GRAPHICS, self.pipeline);
            self.device.cmd_set_viewport(self.commands, 0, &[viewport]);
            self.device.cmd_set_scissor(self.commands, 0, &[scissor]);
            self.device.cmd_push_constants(self.commands, self.layout, stages, 0, &numbers);
            self.device.cmd_draw(self.commands, 3, 1, 0, 0);
        }
    }

    pub fn end_rendering(&self) {
        // SAFETY: inside of rendering.
        unsafe { self.device.cmd_end_rendering(self.commands) };
    }

    /// Copies picture and depth to where the host can read them, and submits. [`Engine::wait`] must follow.
    pub fn submit(&self) {
        self.barrier(vk::ImageLayout::ATTACHMENT_OPTIMAL, vk::ImageLayout::TRANSFER_SRC_OPTIMAL);
        let [width, height] = self.style.size_px;
        let copy = |aspect, buffer_offset| {
            let layers = vk::ImageSubresourceLayers::default().aspect_mask(aspect).layer_count(1);
            let image_extent = vk::Extent3D { width, height, depth: 1 };
            [vk::BufferImageCopy {
                buffer_offset,
                image_subresource: layers,
                image_extent,
                ..vk::BufferImageCopy::default()
            }]
        };
        let pixels = u64::from(width) * u64::from(height);
        let info = vk::SubmitInfo2::default();
        let commands = [vk::CommandBufferSubmitInfo::default().command_buffer(self.commands)];
        let source = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
        // SAFETY: outside of rendering, both images in this layout, the buffer large enough.
        unsafe {
            let (device, to) = (&self.device, self.readback.0);
            let color = copy(vk::ImageAspectFlags::COLOR, 0);
            device.cmd_copy_image_to_buffer(self.commands, self.resolved.image, source, to, &color);
            if self.style.samples == vk::SampleCountFlags::TYPE_1 {
                let depth = copy(vk::ImageAspectFlags::DEPTH, 16 * pixels);
                device.cmd_copy_image_to_buffer(self.commands, self.depth.image, source, to, &depth);
                for (told, at) in self.told.iter().flatten().zip([20, 24]) {
                    let told_copy = copy(vk::ImageAspectFlags::COLOR, at * pixels);
                    device.cmd_copy_image_to_buffer(self.commands, told.image, source, to, &told_copy);
                }
            }
            let barriers = [vk::MemoryBarrier2::default()
                .src_stage_mask(vk::PipelineStageFlags2::COPY)
                .src_access_mask(vk::AccessFlags2::TRANSFER_WRITE)
                .dst_stage_mask(vk::PipelineStageFlags2::HOST)
                .dst_access_mask(vk::AccessFlags2::HOST_READ)];
            device.cmd_pipeline_barrier2(
                self.commands,
                &vk::DependencyInfo::default().memory_barriers(&barriers),
            );
            device.end_command_buffer(self.commands).unwrap();
            device.queue_submit2(self.queue, &[info.command_buffer_infos(&commands)], self.fence).unwrap();
        }
    }

    pub fn wait(&self) {
        // SAFETY: the fence was submitted.
        unsafe {
            self.device.wait_for_fences(&[self.fence], true, u64::MAX).unwrap();
            self.device.reset_fences(&[self.fence]).unwrap();
        }
    }

    /// Depth and numbers of objects, which a pass reads, are brought into another layout; all that was done is waited for.
    pub(super) fn barrier_of_read(&self, old: vk::ImageLayout, new: vk::ImageLayout) {
        let numbers = self.told.map(|[numbers, _]| (numbers.image, vk::ImageAspectFlags::COLOR));
        let depth = (self.depth.image, aspect_of(self.style.depth_format));
        self.barriers([depth].into_iter().chain(numbers), [old, new]);
    }

    fn barrier(&self, old: vk::ImageLayout, new: vk::ImageLayout) {
        let color = vk::ImageAspectFlags::COLOR;
        let several = self.style.samples != vk::SampleCountFlags::TYPE_1;
        let told = self.told.into_iter().flatten().chain(several.then_some(self.resolved));
        let depth = (self.depth.image, aspect_of(self.style.depth_format));
        let colors = [self.color].into_iter().chain(told).map(|image| (image.image, color));
        self.barriers(colors.chain([depth]), [old, new]);
    }

    fn barriers(
        &self,
        images: impl Iterator<Item = (vk::Image, vk::ImageAspectFlags)>,
        [old, new]: [vk::ImageLayout; 2],
    ) {
        let all = (
            vk::PipelineStageFlags2::ALL_COMMANDS,
            vk::AccessFlags2::MEMORY_READ | vk::AccessFlags2::MEMORY_WRITE,
        );
        let barrier = |(image, aspect)| {
            let range =
                vk::ImageSubresourceRange::default().aspect_mask(aspect).level_count(1).layer_count(1);
            vk::ImageMemoryBarrier2::default()
                .src_stage_mask(all.0)
                .src_access_mask(all.1)
                .dst_stage_mask(all.0)
                .dst_access_mask(all.1)
                .old_layout(old)
                .new_layout(new)
                .image(image)
                .subresource_range(range)
        };
        let barriers: Vec<_> = images.map(barrier).collect();
        // SAFETY: recording, outside of rendering.
        unsafe {
            let info = vk::DependencyInfo::default().image_memory_barriers(&barriers);
            self.device.cmd_pipeline_barrier2(self.commands, &info);
        }
    }
}
