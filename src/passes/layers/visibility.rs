//! Visibility of a transparent layer: the depth of the nearest surface behind the layer before, moved away from the eye by
//! ε, or the opaque things' depth where that is nearer. Why no surface is lost or taken twice: `glsl/inc/peel.glsl`.

use ash::vk;

use crate::passes::{
    layers::layer::Layer,
    polygons::{
        copy_depth::depth_from,
        mesh_pass::{MeshPass, draw_meshes},
    },
    splats::{
        draw::{bind_read, draw_splats},
        visibility,
    },
};
use crate::{
    error::Result,
    graph::{Access, Graph, Handle, Image, execute::Body},
    shaders::{self, config::*},
    vk::Blend,
};

/// What it is made of for polygons. `peeled`: only what is behind a layer.
fn mesh_pass(peeled: bool) -> MeshPass {
    MeshPass {
        fragment: &shaders::POLYGONS_DEPTH_FRAG,
        color_formats: [].into(),
        blend: Blend::Replace,
        depth: Some((vk::CompareOp::GREATER, true)),
        constants: [(SPEC_PEELED, peeled.into())].into(),
    }
}

/// Declares the pass, and before it, where there are opaque things, the copy of their depth; returns the layer's depth.
pub(crate) fn layer_visibility<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    layer: &Layer<'a, '_>,
) -> Result<Handle<Image>> {
    let inputs = layer.inputs;
    let why = "opaque things hide transparent ones behind them";
    let (mut depth, start) = depth_from(graph, inputs, layer.name("depth"), why, layer.opaque);
    let why =
        "transparent things: the depth of the nearest surface behind the layer before, shifted by epsilon";
    let pass = layer.pass(graph, "visibility", why).attach(&mut depth, Access::DepthAttachment, start);
    let pass = layer.read(pass);
    let peeled = layer.before.is_some();
    let splats = visibility::splat_pass(inputs.settings, Some(peeled)).pipelines(&pass, inputs)?;
    let meshes = mesh_pass(peeled).pipelines(&pass, inputs)?;
    pass.finish(move |pass| {
        bind_read(pass)?;
        draw_splats(pass, inputs, splats)?;
        draw_meshes(pass, inputs, meshes)
    });
    Ok(depth)
}
