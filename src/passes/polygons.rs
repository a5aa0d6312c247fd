//! Opaque polygons, drawn upon the depth that visibility splatting leaves (Guennebaud et al. 2006, section 5.1, step 2):
//! their attributes, for finalization.

use ash::vk;

use super::{
    DEPTH_FORMAT, Inputs,
    accumulate::Sums,
    copy_depth::copy_depth,
    mesh_draws::{MeshPass, draw_meshes},
    sum_format,
};
use crate::{
    error::Result,
    graph::{Access, ClearValue, Graph, Handle, Image, Start, execute::Body},
    scene::Settings,
    shaders,
    vk::Blend,
};

/// What the pass is made of.
pub(super) fn mesh_pass(settings: &Settings) -> MeshPass {
    MeshPass {
        fragment: &shaders::POLYGONS_OPAQUE_FRAG,
        color_formats: vec![sum_format(settings.accumulate); 2],
        blend: Blend::Replace,
        depth: Some((vk::CompareOp::GREATER, true)),
        constants: Vec::new(),
    }
}

/// Declares the pass, and before it, where there are splats, the copy of their depth: accumulation needs both. Returns
/// albedo and 1, normal and 1, where a polygon is seen; and the depth of splats and polygons together.
pub(super) fn polygons<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    splats: Option<&Handle<Image>>,
) -> Result<(Sums, Handle<Image>)> {
    const NAME: &str = "depth with polygons";
    let pipelines = mesh_pass(inputs.settings).pipelines(inputs)?;
    let format = sum_format(inputs.settings.accumulate);
    let mut seen = Sums {
        color: graph.create_image("polygon colors", inputs.image(format)),
        normal: graph.create_image("polygon normals", inputs.image(format)),
    };
    let (mut depth, start) = match splats {
        Some(splats) => (copy_depth(graph, inputs, NAME, splats), Start::Load),
        None => (graph.create_image(NAME, inputs.image(DEPTH_FORMAT)), Start::Clear(ClearValue::Depth(0.0))),
    };
    let zero = Start::Clear(ClearValue::Color([0.0; 4]));
    graph
        .pass("polygons")
        .write(&mut seen.color, Access::ColorAttachment, zero)
        .write(&mut seen.normal, Access::ColorAttachment, zero)
        .write(&mut depth, Access::DepthAttachment, start)
        .finish(Box::new(move |context| draw_meshes(context, inputs, &pipelines, None)));
    Ok((seen, depth))
}
