//! A view recorded by one call, onto images of a host that has no rendering of its own around it.

use ash::vk;

use super::{View, ViewFrame};
use crate::{
    error::{Error, Result},
    graph::{ImageState, aspect_of},
    inline_vec::InlineVec,
    renderer::Renderer,
};

/// An image of a host's that a view is drawn onto: with the format and samples that its rendering has, one layer, one mip level; usage `COLOR_ATTACHMENT` or
/// `DEPTH_STENCIL_ATTACHMENT`; of the family of the queue, or shared with it.
#[derive(Clone, Copy, Debug)]
pub struct HostImage {
    /// The image.
    pub image: vk::Image,
    /// A view of all of it.
    pub view: vk::ImageView,
    /// What was done with it just before: that is waited for. Where the layout is `UNDEFINED` nothing is in it: it is cleared, color to 0, depth to what is farthest.
    pub before: ImageState,
    /// What will be done with it just after; it is left in that layout.
    pub after: ImageState,
}

impl HostImage {
    /// An image of colors that was, and will be, drawn to by a pass of the host's.
    pub fn color(image: vk::Image, view: vk::ImageView) -> Self {
        Self { image, view, before: ImageState::COLOR_ATTACHMENT, after: ImageState::COLOR_ATTACHMENT }
    }

    /// The same of depth.
    pub fn depth(image: vk::Image, view: vk::ImageView) -> Self {
        Self { image, view, before: ImageState::DEPTH_ATTACHMENT, after: ImageState::DEPTH_ATTACHMENT }
    }

    fn attached(
        &self,
        layout: vk::ImageLayout,
        nothing: vk::ClearValue,
    ) -> vk::RenderingAttachmentInfo<'static> {
        let load = match self.before.layout {
            vk::ImageLayout::UNDEFINED => vk::AttachmentLoadOp::CLEAR,
            _ => vk::AttachmentLoadOp::LOAD,
        };
        vk::RenderingAttachmentInfo::default()
            .image_view(self.view)
            .image_layout(layout)
            .load_op(load)
            .store_op(vk::AttachmentStoreOp::STORE)
            .clear_value(nothing)
    }

    fn barrier(
        &self,
        aspect: vk::ImageAspectFlags,
        from: ImageState,
        to: ImageState,
    ) -> vk::ImageMemoryBarrier2<'static> {
        let range = vk::ImageSubresourceRange::default().aspect_mask(aspect).level_count(1).layer_count(1);
        vk::ImageMemoryBarrier2::default()
            .src_stage_mask(from.stages)
            .src_access_mask(from.access)
            .dst_stage_mask(to.stages)
            .dst_access_mask(to.access)
            .old_layout(from.layout)
            .new_layout(to.layout)
            .image(self.image)
            .subresource_range(range)
    }
}

/// As many attachments as a rendering has at most ([`super::Rendering::color_formats`]), and its depth.
type Barriers = InlineVec<vk::ImageMemoryBarrier2<'static>, 9>;

impl View {
    /// Records all of a frame: [`Self::prepare`], then a rendering onto these images with [`Self::draw`] in it, and barriers around it. `colors` are as many as the rendering that
    /// the view was made for has formats, `None` where one is `UNDEFINED`.
    ///
    /// # Errors
    /// As [`Self::prepare`]; [`crate::ErrorKind::Option`] for other images than the view's rendering has, before anything is recorded.
    ///
    /// # Safety
    /// As [`Self::prepare`]. The images are what [`HostImage`] and the rendering say, and in the state that they say; they hold the view's area, and stay alive until the commands have
    /// run.
    pub unsafe fn record(
        &mut self,
        renderer: &Renderer,
        commands: vk::CommandBuffer,
        frame: &ViewFrame<'_>,
        colors: &[Option<HostImage>],
        depth: Option<HostImage>,
    ) -> Result<()> {
        self.check_images(colors, depth)?;
        // SAFETY: this function's contract.
        unsafe { self.prepare(renderer, commands, frame) }?;
        let Some(area) = self.prepared.as_ref().map(|prepared| prepared.area) else { return Ok(()) };
        let farthest = if self.rendering.nearer_is_greater() == Some(true) { 0.0 } else { 1.0 };
        let farthest = vk::ClearDepthStencilValue { depth: farthest, stencil: 0 };
        let of_color = (ImageState::COLOR_ATTACHMENT, vk::ClearValue::default());
        let of_depth = (ImageState::DEPTH_ATTACHMENT, vk::ClearValue { depth_stencil: farthest });
        let attach = |image: &Option<HostImage>, (state, nothing): (ImageState, vk::ClearValue)| {
            image.map_or_else(Default::default, |image| image.attached(state.layout, nothing))
        };
        let of_colors: InlineVec<_, 8> = colors.iter().map(|color| attach(color, of_color)).collect();
        let of_depth_image = attach(&depth, of_depth);
        let mut info =
            vk::RenderingInfo::default().render_area(area).layer_count(1).color_attachments(&of_colors);
        if depth.is_some() {
            info = info.depth_attachment(&of_depth_image);
        }
        let has_stencil = self.rendering.stencil_format != vk::Format::UNDEFINED;
        if has_stencil {
            info = info.stencil_attachment(&of_depth_image);
        }
        let aspect = aspect_of(self.rendering.depth_format);
        let barriers = |of: fn(HostImage, vk::ImageAspectFlags, ImageState) -> _| -> Barriers {
            let color = (vk::ImageAspectFlags::COLOR, ImageState::COLOR_ATTACHMENT);
            let colors = colors.iter().flatten().map(|image| (*image, color));
            let all = colors.chain(depth.map(|image| (image, (aspect, ImageState::DEPTH_ATTACHMENT))));
            all.map(|(image, (aspect, state))| of(image, aspect, state)).collect()
        };
        let before = barriers(|image, aspect, state| image.barrier(aspect, image.before, state));
        let after = barriers(|image, aspect, state| image.barrier(aspect, state, image.after));
        let raw = self.device.raw();
        // SAFETY: this function's contract: outside of rendering, images in these states.
        unsafe {
            raw.cmd_pipeline_barrier2(
                commands,
                &vk::DependencyInfo::default().image_memory_barriers(&before),
            );
            raw.cmd_begin_rendering(commands, &info);
            let drawn = self.draw(renderer, commands);
            raw.cmd_end_rendering(commands);
            raw.cmd_pipeline_barrier2(commands, &vk::DependencyInfo::default().image_memory_barriers(&after));
            drawn
        }
    }

    fn check_images(&self, colors: &[Option<HostImage>], depth: Option<HostImage>) -> Result<()> {
        let formats = &self.rendering.color_formats;
        let fits = |(image, format): (&Option<HostImage>, &vk::Format)| {
            image.is_some() == (*format != vk::Format::UNDEFINED)
        };
        if colors.len() != formats.len() || !colors.iter().zip(formats).all(fits) {
            return Err(Error::option("colors", format!("expected an image for each format of {formats:?}")));
        }
        match (depth.is_some(), self.rendering.has_depth()) {
            (true, false) => Err(Error::option("depth", "the view's rendering has none: expected none")),
            (false, true) => Err(Error::option("depth", "the view's rendering has one: expected its image")),
            _ => Ok(()),
        }
    }
}
