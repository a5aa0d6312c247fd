//! Visibility splatting: the depth of the nearest surface, moved away from the eye by ε.

use ash::vk;

use crate::passes::pipeline::formats::DEPTH_FORMAT;
use crate::passes::{
    cull::lists::Lists,
    inputs::Inputs,
    pass::Pass,
    splats::draw::{SplatPass, bind_read, draw_splats},
};
use crate::{
    error::Result,
    graph::{Access, ClearValue, Graph, Handle, Image, Start, execute::Body},
    scene::Settings,
    shaders::config::*,
};

/// What the pass is made of: for the opaque part, or for a layer, perhaps behind one that was peeled off.
pub(crate) fn splat_pass(settings: &Settings, layer: Option<bool>) -> SplatPass {
    SplatPass {
        depth: Some((vk::CompareOp::GREATER, true)),
        constants: [(SPEC_PEELED, u32::from(layer == Some(true)))].into(),
        ..SplatPass::new(settings, |drawn| drawn.visibility(layer.is_some()))
    }
}

/// Declares the pass; returns its reversed depth: near / z, 0 where there is nothing.
pub(crate) fn visibility<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    lists: &Lists<'a>,
) -> Result<Handle<Image>> {
    let mut depth = graph.create_image("depth", inputs.image(DEPTH_FORMAT));
    let clear = Start::Clear(ClearValue::Depth(0.0));
    let why = "opaque splats: the depth of the nearest surface, shifted by epsilon";
    let pass = Pass::new(graph, inputs.source, "visibility", why);
    let pass = lists.read(pass.attach(&mut depth, Access::DepthAttachment, clear));
    let pipelines = splat_pass(inputs.settings, None).pipelines(&pass, inputs)?;
    pass.finish(move |pass| {
        bind_read(pass)?;
        draw_splats(pass, inputs, pipelines)
    });
    Ok(depth)
}
