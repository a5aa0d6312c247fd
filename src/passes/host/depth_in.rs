//! What a host has drawn hides transparent layers: its depth and that of the opaque surface, in one.

use ash::vk;

use crate::passes::{
    inputs::Inputs,
    pass::Pass,
    pipeline::{
        constants::HostDepth,
        key::{GraphicsKey, Layout},
    },
    place::{Place, sums},
    polygons::copy_depth::depth_from,
};
use crate::{
    error::Result,
    graph::{Access, Graph, Handle, Image, execute::Body},
    shaders::{self, config::*},
};

/// Declares the pass; returns the depth that hides.
pub(crate) fn depth_with_host<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    opaque: Option<&Handle<Image>>,
    (host, of_host): (&Handle<Image>, HostDepth),
) -> Result<Handle<Image>> {
    let why = "a host's own things hide transparent layers";
    let (mut depth, start) = depth_from(graph, inputs, "depth with the host's", why, opaque);
    let pass = Pass::new(graph, inputs.source, "depth of the host", why)
        .attach(&mut depth, Access::DepthAttachment, start)
        .read(sums(BIND_SUMS_DEPTH), host, Access::SampledFragment);
    let pipeline = pass.graphics(GraphicsKey {
        depth: Some((vk::CompareOp::GREATER, true)),
        ..GraphicsKey::fullscreen(&shaders::HOST_DEPTH_FRAG, Layout::Host, [].into())
    })?;
    pass.finish(move |pass| {
        pass.bind(pipeline);
        pass.bind_sets(pipeline.layout, 0, &[pass.set(Place::Sums)?])?;
        pass.push(pipeline.layout, &of_host)?;
        pass.draw([3, 1]);
        Ok(())
    });
    Ok(depth)
}
