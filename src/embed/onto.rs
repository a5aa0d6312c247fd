//! A view recorded by one call, onto images of a host that has no rendering of its own around it.

use std::fmt;

use ash::vk;

use super::{View, ViewFrame};
use crate::{
    error::{Error, Result},
    graph::{ImageState, aspect_of},
    inline_vec::InlineVec,
    renderer::Renderer,
};

/// An image of a host's that a view is drawn onto, or one layer of it: with the samples that its rendering has, one mip level.
///
/// ```no_run
/// use surfel::{ash::vk, embed::{HostImage, ImageState}};
///
/// /// What was in it goes; afterwards it is copied.
/// fn target(image: vk::Image, view: vk::ImageView, extent: vk::Extent2D) -> HostImage {
///     let (stages, access) = (vk::PipelineStageFlags2::COPY, vk::AccessFlags2::TRANSFER_READ);
///     let nothing = ImageState { stages, access: vk::AccessFlags2::NONE, layout: vk::ImageLayout::UNDEFINED };
///     let copied = ImageState { stages, access, layout: vk::ImageLayout::TRANSFER_SRC_OPTIMAL };
///     let whole = HostImage::color(image, view, vk::Format::R16G16B16A16_SFLOAT, extent);
///     HostImage { before: nothing, after: copied, ..whole }
/// }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct HostImage {
    /// The image.
    pub image: vk::Image,
    /// A view of all of it, or of the layer.
    pub view: vk::ImageView,
    /// Its format, which is the rendering's: another one is refused. `UNDEFINED` is not looked at.
    pub format: vk::Format,
    /// Its width and height in pixels: what does not hold the view's area is refused. 0 x 0 is not looked at.
    pub extent: vk::Extent2D,
    /// What it was created for: without `COLOR_ATTACHMENT` or `DEPTH_STENCIL_ATTACHMENT` it is refused. Nothing is not looked at.
    pub usage: vk::ImageUsageFlags,
    /// The layer that the view shows: of an image that has one for each eye, say. All else of the image is left as it is.
    pub layer: u32,
    /// What was done with it just before: that is waited for. Where the layout is `UNDEFINED` nothing is in it: it is cleared, color to 0, depth to what is farthest.
    pub before: ImageState,
    /// The family of queues that has it before, where it is not shared: it is acquired from there, in the layout of `before`. That family's queue has released it to ours, to the layout of
    /// [`ImageState::COLOR_ATTACHMENT`] or [`ImageState::DEPTH_ATTACHMENT`], and a semaphore orders both. `QUEUE_FAMILY_IGNORED`: ours has it already, as where the layout of `before` is `UNDEFINED`.
    pub family_before: u32,
    /// What will be done with it just after; it is left in that layout.
    pub after: ImageState,
    /// The family that it is released to, from that layout of ours to that of `after`, which acquires it then. `QUEUE_FAMILY_IGNORED`: it stays with ours.
    pub family_after: u32,
}

impl HostImage {
    /// An image of one layer, of colors, that was, and will be, drawn to by a pass of the host's, and stays with the queue's family.
    pub fn color(image: vk::Image, view: vk::ImageView, format: vk::Format, extent: vk::Extent2D) -> Self {
        Self {
            image,
            view,
            format,
            extent,
            usage: vk::ImageUsageFlags::COLOR_ATTACHMENT,
            layer: 0,
            before: ImageState::COLOR_ATTACHMENT,
            family_before: vk::QUEUE_FAMILY_IGNORED,
            after: ImageState::COLOR_ATTACHMENT,
            family_after: vk::QUEUE_FAMILY_IGNORED,
        }
    }

    /// The same of depth.
    pub fn depth(image: vk::Image, view: vk::ImageView, format: vk::Format, extent: vk::Extent2D) -> Self {
        Self {
            usage: vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT,
            before: ImageState::DEPTH_ATTACHMENT,
            after: ImageState::DEPTH_ATTACHMENT,
            ..Self::color(image, view, format, extent)
        }
    }

    /// Refuses an image that is not what a rendering draws to, over this area.
    fn check(
        &self,
        name: fmt::Arguments<'_>,
        (format, usage): (vk::Format, vk::ImageUsageFlags),
        (corner_px, size_px): ([i32; 2], [u32; 2]),
    ) -> Result<()> {
        let refused = |field: &str, problem: String| Err(Error::option(format!("{name}.{field}"), problem));
        if self.format != vk::Format::UNDEFINED && self.format != format {
            return refused(
                "format",
                format!("{:?}: expected {format:?}, as the view's rendering has", self.format),
            );
        }
        if !self.usage.is_empty() && !self.usage.contains(usage) {
            return refused("usage", format!("{:?}: expected {usage:?} among it", self.usage));
        }
        let vk::Extent2D { width, height } = self.extent;
        let holds = |(at, (side, whole)): (&i32, (&u32, u32))| {
            u64::from(at.unsigned_abs()) + u64::from(*side) <= u64::from(whole)
        };
        let sides = size_px.iter().zip([width, height]);
        if (width, height) != (0, 0) && !corner_px.iter().zip(sides).all(holds) {
            let ([x, y], [w, h]) = (corner_px, size_px);
            return refused("extent", format!("{width}x{height}: expected {w}x{h} pixels from {x},{y} on"));
        }
        Ok(())
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
        [from, to]: [ImageState; 2],
        [family_from, family_to]: [u32; 2],
    ) -> vk::ImageMemoryBarrier2<'static> {
        let range = vk::ImageSubresourceRange::default()
            .aspect_mask(aspect)
            .level_count(1)
            .base_array_layer(self.layer)
            .layer_count(1);
        vk::ImageMemoryBarrier2::default()
            .src_stage_mask(from.stages)
            .src_access_mask(from.access)
            .dst_stage_mask(to.stages)
            .dst_access_mask(to.access)
            .old_layout(from.layout)
            .new_layout(to.layout)
            .src_queue_family_index(family_from)
            .dst_queue_family_index(family_to)
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
    /// As [`Self::prepare`]; [`crate::ErrorKind::Option`] for other images than the view's rendering has, by the field, before anything is recorded.
    ///
    /// # Safety
    /// As [`Self::prepare`]. The images are what [`HostImage`] and the rendering say, and in the state and of the family that they say; they hold the view's area, and stay alive until the
    /// commands have run. Families are the device's, or `QUEUE_FAMILY_EXTERNAL`.
    pub unsafe fn record(
        &mut self,
        renderer: &Renderer,
        commands: vk::CommandBuffer,
        frame: &ViewFrame<'_>,
        colors: &[Option<HostImage>],
        depth: Option<HostImage>,
    ) -> Result<()> {
        self.check_images(frame, colors, depth)?;
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
        let ours = self.device.queue_family();
        // Between one family and itself nothing is transferred; what has nothing in it need not be.
        let transfer = |of_host: u32, layout: vk::ImageLayout| {
            let transfers = ![vk::QUEUE_FAMILY_IGNORED, ours].contains(&of_host);
            transfers && layout != vk::ImageLayout::UNDEFINED
        };
        let barriers = |of: &dyn Fn(HostImage, vk::ImageAspectFlags, ImageState) -> _| -> Barriers {
            let color = (vk::ImageAspectFlags::COLOR, ImageState::COLOR_ATTACHMENT);
            let colors = colors.iter().flatten().map(|image| (*image, color));
            let all = colors.chain(depth.map(|image| (image, (aspect, ImageState::DEPTH_ATTACHMENT))));
            all.map(|(image, (aspect, state))| of(image, aspect, state)).collect()
        };
        const STAYS: [u32; 2] = [vk::QUEUE_FAMILY_IGNORED; 2];
        let before = barriers(&|image, aspect, state| {
            let families = match transfer(image.family_before, image.before.layout) {
                true => [image.family_before, ours],
                false => STAYS,
            };
            image.barrier(aspect, [image.before, state], families)
        });
        let after = barriers(&|image, aspect, state| {
            let families = match transfer(image.family_after, state.layout) {
                true => [ours, image.family_after],
                false => STAYS,
            };
            image.barrier(aspect, [state, image.after], families)
        });
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

    fn check_images(
        &self,
        frame: &ViewFrame<'_>,
        colors: &[Option<HostImage>],
        depth: Option<HostImage>,
    ) -> Result<()> {
        let formats = &self.rendering.color_formats;
        let fits = |(image, format): (&Option<HostImage>, &vk::Format)| {
            image.is_some() == (*format != vk::Format::UNDEFINED)
        };
        if colors.len() != formats.len() || !colors.iter().zip(formats).all(fits) {
            return Err(Error::option("colors", format!("expected an image for each format of {formats:?}")));
        }
        match (depth.is_some(), self.rendering.has_depth()) {
            (true, false) => {
                return Err(Error::option("depth", "the view's rendering has none: expected none"));
            }
            (false, true) => {
                return Err(Error::option("depth", "the view's rendering has one: expected its image"));
            }
            _ => {}
        }
        let area = (frame.corner_px, frame.settings.size_px);
        for ((number, image), format) in colors.iter().enumerate().zip(formats) {
            if let Some(image) = image {
                let expected = (*format, vk::ImageUsageFlags::COLOR_ATTACHMENT);
                image.check(format_args!("colors[{number}]"), expected, area)?;
            }
        }
        let expected = (self.rendering.depth_format, vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT);
        depth.map_or(Ok(()), |image| image.check(format_args!("depth"), expected, area))
    }
}
