//! Images of a host's: what was done with them, and will be.

use std::ffi::c_void;

use surfel::{
    ash::vk,
    embed::{DepthImage, HostImage, ImageState},
};

use crate::{
    handle::null,
    result::Result,
    structs::{Struct, SurfelStructureType, read},
};

/// The depth of what a host has drawn so far.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelDepthImage {
    /// `SURFEL_STRUCTURE_TYPE_DEPTH_IMAGE`.
    pub s_type: u32,
    /// `sizeof(SurfelDepthImage)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// One sample a pixel, one mip level; usage `VK_IMAGE_USAGE_SAMPLED_BIT`.
    pub image: vk::Image,
    /// A view of its depth alone, of one layer.
    pub view: vk::ImageView,
    /// What was done with it just before; its writes are waited for.
    pub before_stages: vk::PipelineStageFlags2,
    /// As `beforeStages`.
    pub before_access: vk::AccessFlags2,
    /// What will be done with it just after.
    pub after_stages: vk::PipelineStageFlags2,
    /// As `afterStages`.
    pub after_access: vk::AccessFlags2,
    /// The layout in which it is.
    pub before_layout: vk::ImageLayout,
    /// The layout in which it is left.
    pub after_layout: vk::ImageLayout,
    /// Its format.
    pub format: vk::Format,
    /// Its width in pixels.
    pub width: u32,
    /// Its height in pixels.
    pub height: u32,
    /// The layer that `view` shows: of an image that has one for each eye, say. All else of the image is left as it is.
    pub layer: u32,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelDepthImage {
    const TYPE: SurfelStructureType = SurfelStructureType::DepthImage;
}

/// An image of the host's that a view is drawn onto, or one layer of it: with the samples that its rendering has, one mip level.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelHostImage {
    /// `SURFEL_STRUCTURE_TYPE_HOST_IMAGE`.
    pub s_type: u32,
    /// `sizeof(SurfelHostImage)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// The image.
    pub image: vk::Image,
    /// A view of all of it, or of the layer.
    pub view: vk::ImageView,
    /// What was done with it just before; that is waited for.
    pub before_stages: vk::PipelineStageFlags2,
    /// As `beforeStages`.
    pub before_access: vk::AccessFlags2,
    /// What will be done with it just after.
    pub after_stages: vk::PipelineStageFlags2,
    /// As `afterStages`.
    pub after_access: vk::AccessFlags2,
    /// The layout in which it is; `VK_IMAGE_LAYOUT_UNDEFINED`: nothing is in it, and it is cleared, color to 0, depth to what is farthest.
    pub before_layout: vk::ImageLayout,
    /// The layout in which it is left.
    pub after_layout: vk::ImageLayout,
    /// Its format, which is the rendering's: another one is refused. 0 is not looked at.
    pub format: vk::Format,
    /// What it was created for: without `VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT` or `VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT` it is refused.
    /// 0 is not looked at.
    pub usage: vk::ImageUsageFlags,
    /// Its width in pixels: what does not hold the view's area is refused. Where width and height are 0 they are not looked at.
    pub width: u32,
    /// Its height in pixels.
    pub height: u32,
    /// `familyBefore` and `familyAfter` count. 0: the image is shared, or the family of the queue has it, and keeps it.
    pub changes_family: vk::Bool32,
    /// The family of queues that has it before: it is acquired from there, in `beforeLayout`. That family's queue has released it to
    /// `VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL` or `…_DEPTH_STENCIL_ATTACHMENT_OPTIMAL`, and a semaphore orders both. `VK_QUEUE_FAMILY_IGNORED`: ours has it already.
    pub family_before: u32,
    /// The family that it is released to, from that layout to `afterLayout`, which acquires it then.
    /// `VK_QUEUE_FAMILY_IGNORED`: it stays with ours.
    pub family_after: u32,
    /// The layer that `view` shows: of an image that has one for each eye, say. All else of the image is left as it is.
    pub layer: u32,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelHostImage {
    const TYPE: SurfelStructureType = SurfelStructureType::HostImage;
}

/// The image that C means; `None` of NULL.
///
/// # Safety
/// `given` is NULL or leads to as much as it says.
pub unsafe fn host_image(given: *const SurfelHostImage, name: &str) -> Result<Option<HostImage>> {
    if given.is_null() {
        return Ok(None);
    }
    // SAFETY: this function's contract.
    let given = unsafe { read(given, name) }?;
    if given.image == vk::Image::null() || given.view == vk::ImageView::null() {
        return Err(null(&format!("{name}: image or view")));
    }
    let state = |stages, access, layout| ImageState { stages, access, layout };
    let family = |family| if given.changes_family != vk::FALSE { family } else { vk::QUEUE_FAMILY_IGNORED };
    Ok(Some(HostImage {
        image: given.image,
        view: given.view,
        format: given.format,
        extent: vk::Extent2D { width: given.width, height: given.height },
        usage: given.usage,
        layer: given.layer,
        family_before: family(given.family_before),
        family_after: family(given.family_after),
        before: state(given.before_stages, given.before_access, given.before_layout),
        after: state(given.after_stages, given.after_access, given.after_layout),
    }))
}

/// The depth that C means.
pub fn depth_image(given: &SurfelDepthImage) -> Result<DepthImage> {
    if given.image == vk::Image::null() || given.view == vk::ImageView::null() {
        return Err(null("hides: image or view"));
    }
    let state = |stages, access, layout| ImageState { stages, access, layout };
    Ok(DepthImage {
        image: given.image,
        view: given.view,
        format: given.format,
        extent: vk::Extent2D { width: given.width, height: given.height },
        layer: given.layer,
        before: state(given.before_stages, given.before_access, given.before_layout),
        after: state(given.after_stages, given.after_access, given.after_layout),
    })
}
