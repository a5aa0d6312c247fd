//! Copies an image, or a buffer, to a buffer that the host reads after the frame.

use ash::vk;

use crate::graph::{Access, Buffer, Graph, Handle, Image, Start, aspect_of, execute::Body};
use crate::passes::{
    pass::{Pass, Source},
    place::transfer,
};

/// Why a frame has it.
const WHY: &str = "the host reads it";

/// Declares the pass: rows of `extent.width` pixels without padding, top row first. The buffer must have room.
pub fn readback<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    source: Source<'a>,
    name: impl std::fmt::Display,
    image: &Handle<Image>,
    (format, extent): (vk::Format, vk::Extent2D),
    buffer: &mut Handle<Buffer>,
) {
    Pass::new(graph, source, name, WHY)
        .read(transfer(0), image, Access::TransferRead)
        .write(transfer(1), buffer, Access::TransferWrite, Start::Discard)
        .finish(move |pass| {
            let layers = vk::ImageSubresourceLayers::default().aspect_mask(aspect_of(format)).layer_count(1);
            let region = vk::BufferImageCopy::default().image_subresource(layers).image_extent(extent.into());
            let ((image, layout), buffer) = (pass.image(transfer(0))?, pass.buffer(transfer(1))?);
            let (device, commands) = (pass.device(), pass.commands());
            // SAFETY: the graph brought the image into this layout; the caller gave the buffer room.
            unsafe { device.cmd_copy_image_to_buffer(commands, image, layout, buffer, &[region]) };
            Ok(())
        });
}

/// Declares the pass that copies the first `size_bytes` of a buffer.
pub fn readback_buffer<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    source: Source<'a>,
    name: impl std::fmt::Display,
    from: &Handle<Buffer>,
    to: &mut Handle<Buffer>,
    size_bytes: u64,
) {
    Pass::new(graph, source, name, WHY)
        .read(transfer(0), from, Access::TransferRead)
        .write(transfer(1), to, Access::TransferWrite, Start::Discard)
        .finish(move |pass| {
            let region = vk::BufferCopy::default().size(size_bytes);
            let (from, to) = (pass.buffer(transfer(0))?, pass.buffer(transfer(1))?);
            // SAFETY: outside of rendering; two buffers of at least that size, as the caller has it.
            unsafe { pass.device().cmd_copy_buffer(pass.commands(), from, to, &[region]) };
            Ok(())
        });
}
