//! Compile stage 6: what happens to attachments when rendering begins and when it ends.

use ash::vk;

use super::{
    cull::Live,
    declare::{Declared, Pass, Start},
    resource::{ClearValue, ResourceDesc, ResourceId},
};

/// The dynamic rendering of a graphics pass.
#[derive(Clone, Debug, PartialEq)]
pub struct Rendering {
    /// The render area: all of every attachment, in pixels.
    pub extent: vk::Extent2D,
    /// The color attachments; the index is the location.
    pub colors: Vec<Attachment>,
    /// The depth attachment.
    pub depth: Option<Attachment>,
}

/// An attachment and its operations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attachment {
    /// The image.
    pub resource: ResourceId,
    /// Its layout during rendering.
    pub layout: vk::ImageLayout,
    /// What is in it when rendering begins.
    pub load: vk::AttachmentLoadOp,
    /// What becomes of it when rendering ends.
    pub store: vk::AttachmentStoreOp,
    /// What it is cleared to, where `load` is `CLEAR`.
    pub clear: Option<ClearValue>,
}

/// The attachments of a pass; `None` where it has none.
pub(super) fn rendering(graph: &Declared<'_>, live: &Live, pass: &Pass<'_>) -> Option<Rendering> {
    let mut rendering: Option<Rendering> = None;
    for usage in pass.uses.iter().filter(|usage| usage.access.is_attachment()) {
        let (ResourceDesc::Image(desc), Some((layout, _))) =
            (graph.resource(usage.resource).desc, usage.access.info().image)
        else {
            continue;
        };
        let load = match usage.start {
            Some(Start::Clear(_)) => vk::AttachmentLoadOp::CLEAR,
            Some(Start::Discard) => vk::AttachmentLoadOp::DONT_CARE,
            Some(Start::Load) | None => vk::AttachmentLoadOp::LOAD,
        };
        let store = if usage.start.is_none() {
            // Not written, so that even a `STORE` would be a write too much.
            vk::AttachmentStoreOp::NONE
        } else if live.is_read(usage) {
            vk::AttachmentStoreOp::STORE
        } else {
            vk::AttachmentStoreOp::DONT_CARE
        };
        let clear = match usage.start {
            Some(Start::Clear(value)) => Some(value),
            _ => None,
        };
        let attachment = Attachment { resource: usage.resource, layout, load, store, clear };
        let rendering = rendering.get_or_insert_with(|| Rendering {
            extent: desc.extent,
            colors: Vec::new(),
            depth: None,
        });
        if usage.access.is_depth_attachment() {
            rendering.depth = Some(attachment);
        } else {
            rendering.colors.push(attachment);
        }
    }
    rendering
}
