//! A depth image begins as another one.

use ash::vk;

use crate::graph::{Access, Graph, Handle, Image, Start, execute::Body};
use crate::passes::inputs::Inputs;
use crate::passes::pipeline::formats::DEPTH_FORMAT;

/// Declares the pass; returns the new image.
pub(crate) fn copy_depth<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    name: &str,
    source: &Handle<Image>,
) -> Handle<Image> {
    let mut target = graph.create_image(name, inputs.image(DEPTH_FORMAT));
    let (from, to) = (source.id(), target.id());
    let extent = inputs.extent();
    graph
        .pass(&format!("begin {name}"))
        .read(source, Access::TransferRead)
        .write(&mut target, Access::TransferWrite, Start::Discard)
        .finish(Box::new(move |context| {
            let layers =
                vk::ImageSubresourceLayers::default().aspect_mask(vk::ImageAspectFlags::DEPTH).layer_count(1);
            let region = vk::ImageCopy::default()
                .src_subresource(layers)
                .dst_subresource(layers)
                .extent(extent.into());
            // SAFETY: outside of rendering; both images have this format and extent, and are in the layouts named.
            unsafe {
                context.device().cmd_copy_image(
                    context.commands(),
                    context.image(from)?.0,
                    context.layout(from),
                    context.image(to)?.0,
                    context.layout(to),
                    &[region],
                );
            }
            Ok(())
        }));
    target
}
