//! Copies an image to a buffer that the host reads after the frame.

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
