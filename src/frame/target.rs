//! Images that a frame ends in.

use ash::vk;

use crate::{
    error::Result,
    graph::ImageState,
    vk::{Device, Image, ImageDesc},
};

/// A host's image, or our own, that a frame is to be drawn to. All of it is overwritten.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// The image; usage `COLOR_ATTACHMENT`, and `TRANSFER_SRC` where it is read back.
    pub image: vk::Image,
    /// A view of all of it.
    pub view: vk::ImageView,
    /// Its format: an sRGB format encodes the linear light, a float format keeps it.
    pub format: vk::Format,
    /// Width and height in pixels.
    pub extent: vk::Extent2D,
    /// What was done with it just before our commands.
    pub initial: ImageState,
    /// What will be done with it just after; `None` leaves it as our last pass does.
    pub last: Option<ImageState>,
}

/// A target without a window.
pub struct HeadlessTarget {
    image: Image,
}

impl HeadlessTarget {
    /// An image of this format and size.
    ///
    /// # Errors
    /// Whatever the driver or the allocator answers.
    pub fn new(device: &Device, format: vk::Format, size_px: [u32; 2]) -> Result<Self> {
        let [width, height] = size_px;
        let image = Image::new(
            device,
            ImageDesc {
                name: "target",
                format,
                extent: vk::Extent2D { width, height },
                usage: vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::TRANSFER_SRC,
            },
        )?;
        Ok(Self { image })
    }

    /// As a target of a frame that follows earlier frames to it without a wait.
    pub fn target(&self) -> Target {
        Target {
            image: self.image.raw(),
            view: self.image.view(),
            format: self.image.format(),
            extent: self.image.extent(),
            // The frame before may still write it, or copy from it.
            initial: ImageState {
                stages: vk::PipelineStageFlags2::COLOR_ATTACHMENT_OUTPUT
                    | vk::PipelineStageFlags2::ALL_TRANSFER,
                access: vk::AccessFlags2::COLOR_ATTACHMENT_WRITE | vk::AccessFlags2::TRANSFER_READ,
                layout: vk::ImageLayout::UNDEFINED,
            },
            last: None,
        }
    }
}
