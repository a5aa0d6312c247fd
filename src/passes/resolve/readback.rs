//! Copies an image, or a buffer, to a buffer that the host reads after the frame.

use ash::vk;

use crate::graph::{Access, Buffer, Graph, Handle, Image, Start, aspect_of, execute::Body};

/// Declares the pass: rows of `extent.width` pixels without padding, top row first. The buffer must have room.
pub fn readback(
    graph: &mut Graph<Body<'_>>,
    name: &str,
    image: &Handle<Image>,
    format: vk::Format,
    extent: vk::Extent2D,
    buffer: &mut Handle<Buffer>,
) {
    let (image_id, buffer_id) = (image.id(), buffer.id());
    graph
        .pass(name)
        .read(image, Access::TransferRead)
        .write(buffer, Access::TransferWrite, Start::Discard)
        .finish(Box::new(move |context| {
            let (image, _) = context.image(image_id)?;
            let layers = vk::ImageSubresourceLayers::default().aspect_mask(aspect_of(format)).layer_count(1);
            let region = vk::BufferImageCopy::default().image_subresource(layers).image_extent(extent.into());
            let (layout, buffer) = (context.layout(image_id), context.buffer(buffer_id)?);
            // SAFETY: the graph brought the image into this layout; the caller gave the buffer room.
            unsafe {
                let device = context.device();
                device.cmd_copy_image_to_buffer(context.commands(), image, layout, buffer, &[region]);
            }
            Ok(())
        }));
}

/// Declares the pass that copies the first `size_bytes` of a buffer.
pub fn readback_buffer(
    graph: &mut Graph<Body<'_>>,
    name: &str,
    from: &Handle<Buffer>,
    to: &mut Handle<Buffer>,
    size_bytes: u64,
) {
    let (from_id, to_id) = (from.id(), to.id());
    graph
        .pass(name)
        .read(from, Access::TransferRead)
        .write(to, Access::TransferWrite, Start::Discard)
        .finish(Box::new(move |context| {
            let region = vk::BufferCopy::default().size(size_bytes);
            let (from, to) = (context.buffer(from_id)?, context.buffer(to_id)?);
            // SAFETY: outside of rendering; two buffers of at least that size, as the caller has it.
            unsafe { context.device().cmd_copy_buffer(context.commands(), from, to, &[region]) };
            Ok(())
        }));
}
