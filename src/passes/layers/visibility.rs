//! Visibility of a transparent layer: the depth of the nearest surface behind the layer before, moved away from the eye by
//! ε, or the opaque things' depth where that is nearer. Why no surface is lost or taken twice: `glsl/inc/peel.glsl`.

use ash::vk;

use crate::passes::pipeline::formats::DEPTH_FORMAT;
use crate::passes::{
    layers::layer::Layer,
    polygons::copy_depth::copy_depth,
    polygons::mesh_pass::{MeshPass, draw_meshes},
    splats::{accumulate::bind_read, draw::draw_splats, visibility},
};
use crate::{
    error::Result,
    graph::{Access, ClearValue, Graph, Handle, Image, Start, execute::Body},
    shaders::{self, config::*},
    vk::Blend,
};

/// What it is made of for polygons. `peeled`: only what is behind a layer.
pub(crate) fn mesh_pass(peeled: bool) -> MeshPass {
    MeshPass {
        fragment: &shaders::POLYGONS_DEPTH_FRAG,
        color_formats: Vec::new(),
        blend: Blend::Replace,
        depth: Some((vk::CompareOp::GREATER, true)),
        constants: vec![(SPEC_PEELED, peeled.into())],
    }
}

/// Declares the pass, and before it, where there are opaque things, the copy of their depth; returns the layer's depth.
pub(crate) fn layer_visibility<'a>(
    graph: &mut Graph<Body<'a>>,
    layer: &Layer<'a, '_>,
) -> Result<Handle<Image>> {
    let inputs = layer.inputs;
    let peeled = layer.before.is_some();
    let splats = visibility::splat_pass(inputs.settings, Some(peeled)).pipelines(inputs)?;
    let meshes = mesh_pass(peeled).pipelines(inputs)?;
    let name = layer.name("depth");
    let (mut depth, start) = match layer.opaque {
        Some(opaque) => (copy_depth(graph, inputs, &name, opaque), Start::Load),
        None => (graph.create_image(&name, inputs.image(DEPTH_FORMAT)), Start::Clear(ClearValue::Depth(0.0))),
    };
    let sampled = [layer.before.map(Handle::id), None, None];
    let (lists, gate) = (layer.list_ids(), layer.gate());
    let pass = graph.pass(&layer.name("visibility")).write(&mut depth, Access::DepthAttachment, start);
    layer.read(pass).finish(Box::new(move |context| {
        bind_read(context, inputs, sampled, None)?;
        draw_splats(context, inputs, &splats, &lists, gate)?;
        draw_meshes(context, inputs, &meshes, gate)
    }));
    Ok(depth)
}
