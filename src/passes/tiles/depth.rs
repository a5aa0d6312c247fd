//! The depth that tiles have found, in the depth buffer of the graphics pipeline.

use std::slice;

use ash::vk;

use crate::passes::pipeline::key::GraphicsKey;
use crate::passes::{
    inputs::Inputs,
    pass::Pass,
    pipeline::formats::DEPTH_FORMAT,
    place::sums,
    tiles::{
        lists::Tiles,
        runs::{draw_runs, read_runs, runs_key},
    },
};
use crate::{
    error::Result,
    graph::{Access, ClearValue, Graph, Handle, Image, Start, execute::Body},
    shaders::{self, config::BIND_SUMS_COLORS},
};

/// The depth buffer of opaque splats, and how a pass begins that draws into it: `before`, or infinitely far.
pub(crate) fn depth_after<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    before: Option<Handle<Image>>,
) -> (Handle<Image>, Start) {
    match before {
        Some(before) => (before, Start::Load),
        None => {
            let depth = graph.create_image("depth", inputs.image(DEPTH_FORMAT));
            (depth, Start::Clear(ClearValue::Depth(0.0)))
        }
    }
}

/// Declares the pass. `kind`, in front of the tiles, tells those of several bands apart; `before`: the depth buffer that `visible`
/// begins from; else it is 0 where there are no splats.
pub(crate) fn depth_buffer<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    tiles: &Tiles<'a>,
    visible: &Handle<Image>,
    before: Option<Handle<Image>>,
) -> Result<Handle<Image>> {
    let (mut depth, start) = depth_after(graph, inputs, before);
    let why = "more than splats in tiles: others are compared with their depth";
    let pass = Pass::new(graph, inputs.source, format_args!("depth of {kind}tiles"), why)
        .read(sums(BIND_SUMS_COLORS), visible, Access::SampledFragment)
        .attach(&mut depth, Access::DepthAttachment, start);
    let (pass, runs) = read_runs(pass, slice::from_ref(tiles));
    let pipeline = pass.graphics(GraphicsKey {
        // What is there before may be nearer: polygons.
        depth: Some((vk::CompareOp::GREATER_OR_EQUAL, true)),
        ..runs_key(&shaders::TILE_DEPTH_FRAG, [].into())
    })?;
    let constants = inputs.finalize_constants();
    pass.finish(move |pass| draw_runs(pass, pipeline, runs, constants));
    Ok(depth)
}
