//! The depth that tiles have found, in the depth buffer of the graphics pipeline.

use std::slice;

use ash::vk;

use crate::passes::pipeline::formats::DEPTH_FORMAT;
use crate::passes::{
    inputs::Inputs,
    pipeline::{cache::GraphicsKey, fullscreen::read_set},
    resolve::finalize,
    tiles::{
        Tiles,
        quads::{SeenTiles, draw_quads_of_tiles, quads_of_tiles, read_seen},
    },
};
use crate::{
    error::Result,
    graph::{Access, ClearValue, Graph, Handle, Image, Start, execute::Body},
    shaders,
};

/// What the pipeline is.
pub(crate) fn key() -> GraphicsKey {
    GraphicsKey {
        depth: Some((vk::CompareOp::ALWAYS, true)),
        ..quads_of_tiles(&shaders::TILE_DEPTH_FRAG, Vec::new())
    }
}

/// Declares the pass. `kind`, in front of the tiles, tells those of several bands apart; `before`: the depth buffer that `visible` begins from; else it is 0 where there are no splats.
pub(crate) fn depth_buffer<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    tiles: &Tiles<'a>,
    visible: &Handle<Image>,
    before: Option<Handle<Image>>,
) -> Result<Handle<Image>> {
    let pipeline = inputs.shaders.graphics(key())?;
    let constants = finalize::constants(inputs);
    let (id, seen) = (visible.id(), SeenTiles::of(slice::from_ref(tiles)));
    let (mut depth, start) = match before {
        Some(before) => (before, Start::Load),
        None => {
            let depth = graph.create_image("depth", inputs.image(DEPTH_FORMAT));
            (depth, Start::Clear(ClearValue::Depth(0.0)))
        }
    };
    let pass = graph.pass(&format!("depth of {kind}tiles")).read(visible, Access::SampledFragment).write(
        &mut depth,
        Access::DepthAttachment,
        start,
    );
    read_seen(slice::from_ref(tiles), pass).finish(Box::new(move |context| {
        let set = read_set(context, inputs, (&[(0, id)], None))?;
        draw_quads_of_tiles(context, inputs, &pipeline, &seen, set, constants)
    }));
    Ok(depth)
}
