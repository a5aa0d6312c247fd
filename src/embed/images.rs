//! What a view's passes leave for its draws.

use ash::vk;

use crate::{
    error::Result,
    graph::ImageState,
    passes::host::{OBJECTS_FORMAT, SURFACE_DEPTH_FORMAT},
    vk::{Device, Image, ImageDesc},
};

/// Kept from frame to frame: nothing is allocated as long as the size stays.
pub(super) struct Images {
    /// The opaque surface: linear light, straight alpha.
    pub surface: Image,
    /// Its own depth.
    pub depth: Image,
    /// Transparent layers alike, where there are any.
    pub layers: Option<Image>,
    /// Whose the opaque surface is, where the host asks for it.
    pub objects: Option<Image>,
}

/// The draws of the frame before read them; they write nothing that has to be seen.
pub(super) const BEFORE: ImageState = ImageState {
    stages: vk::PipelineStageFlags2::FRAGMENT_SHADER,
    access: vk::AccessFlags2::SHADER_SAMPLED_READ,
    layout: vk::ImageLayout::UNDEFINED,
};

/// Draws read them.
pub(super) const AFTER: ImageState = ImageState { layout: vk::ImageLayout::READ_ONLY_OPTIMAL, ..BEFORE };

impl Images {
    /// Bytes of device memory.
    pub fn bytes(&self) -> u64 {
        let all = [Some(&self.surface), Some(&self.depth), self.layers.as_ref(), self.objects.as_ref()];
        all.into_iter().flatten().map(Image::bytes).sum()
    }

    /// Those of a view, the ones there are where they will do.
    pub fn fit(
        kept: Option<Self>,
        device: &Device,
        (format, size_px): (vk::Format, [u32; 2]),
        (layers, objects): (bool, bool),
    ) -> Result<Self> {
        let [width, height] = size_px;
        let extent = vk::Extent2D { width, height };
        let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::SAMPLED;
        let image = |name, format| Image::new(device, ImageDesc { name, format, extent, usage });
        let fits = |kept: &Self| kept.surface.extent() == extent && kept.surface.format() == format;
        let mut images = match kept.filter(fits) {
            Some(kept) => kept,
            None => Self {
                surface: image("surface for a host", format)?,
                depth: image("its depth", SURFACE_DEPTH_FORMAT)?,
                layers: None,
                objects: None,
            },
        };
        if layers && images.layers.is_none() {
            images.layers = Some(image("layers for a host", format)?);
        }
        if objects && images.objects.is_none() {
            images.objects = Some(image("objects for a host", OBJECTS_FORMAT)?);
        }
        Ok(images)
    }
}
