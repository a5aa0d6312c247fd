//! A depth image begins as another one.

use ash::vk;

use crate::graph::{Access, ClearValue, Graph, Handle, Image, Start, execute::Body};
use crate::passes::{inputs::Inputs, pass::Pass, pipeline::formats::DEPTH_FORMAT, place::transfer};

/// A depth, and how the pass begins that draws into it: with a copy of `source`, which a pass before it makes, or infinitely far.
pub(crate) fn depth_from<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    name: &str,
    why: &'static str,
    source: Option<&Handle<Image>>,
) -> (Handle<Image>, Start) {
    let mut depth = graph.create_image(name, inputs.image(DEPTH_FORMAT));
    let Some(source) = source else { return (depth, Start::Clear(ClearValue::Depth(0.0))) };
    let extent = inputs.extent();
    Pass::new(graph, inputs.source, format_args!("begin {name}"), why)
        .read(transfer(0), source, Access::TransferRead)
        .write(transfer(1), &mut depth, Access::TransferWrite, Start::Discard)
        .finish(move |pass| {
            let layers =
                vk::ImageSubresourceLayers::default().aspect_mask(vk::ImageAspectFlags::DEPTH).layer_count(1);
            let region = vk::ImageCopy::default()
                .src_subresource(layers)
                .dst_subresource(layers)
                .extent(extent.into());
            let ((from, from_layout), (to, to_layout)) = (pass.image(transfer(0))?, pass.image(transfer(1))?);
            let (device, commands) = (pass.device(), pass.commands());
            // SAFETY: outside of rendering; both images have this format and extent, and are in the layouts named.
            unsafe { device.cmd_copy_image(commands, from, from_layout, to, to_layout, &[region]) };
            Ok(())
        });
    (depth, Start::Load)
}
