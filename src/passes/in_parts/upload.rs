//! An image begins as what the host has of it.

use ash::vk;

use crate::graph::{Access, Buffer, Graph, Handle, Image, Start, aspect_of, execute::Body};
use crate::passes::{inputs::Inputs, pass::Pass, place::transfer};

/// Declares the pass that copies a buffer to an image of the frame's size: rows without padding, top row first.
pub(super) fn upload<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    name: &str,
    from: &Handle<Buffer>,
    format: vk::Format,
) -> Handle<Image> {
    let extent = inputs.extent();
    let mut image = graph.create_image(name, inputs.image(format));
    Pass::new(graph, inputs.source, format_args!("upload {name}"), super::WHY)
        .read(transfer(0), from, Access::TransferRead)
        .write(transfer(1), &mut image, Access::TransferWrite, Start::Discard)
        .finish(move |pass| {
            let layers = vk::ImageSubresourceLayers::default().aspect_mask(aspect_of(format)).layer_count(1);
            let region = vk::BufferImageCopy::default().image_subresource(layers).image_extent(extent.into());
            let (buffer, (image, layout)) = (pass.buffer(transfer(0))?, pass.image(transfer(1))?);
            let (device, commands) = (pass.device(), pass.commands());
            // SAFETY: outside of rendering; the image is in this layout, and the buffer has a texel for each of its pixels.
            unsafe { device.cmd_copy_buffer_to_image(commands, buffer, image, layout, &[region]) };
            Ok(())
        });
    image
}
