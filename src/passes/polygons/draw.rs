//! Opaque polygons, drawn upon the depth that visibility splatting leaves (Guennebaud et al. 2006, section 5.1, step 2):
//! their attributes, for finalization. Or drawn before all splats and shaded at once, for tiles that lay splats over them: the nearest
//! one at a pixel is all that can be seen of them.

use ash::vk;

use crate::passes::pipeline::formats::{DEPTH_FORMAT, sum_format};
use crate::passes::{
    inputs::Inputs,
    pipeline::variant::shading_constants,
    polygons::copy_depth::copy_depth,
    polygons::mesh_pass::{MeshPass, draw_meshes},
    splats::accumulate::{Sums, bind_read},
};
use crate::{
    error::Result,
    graph::{Access, Buffer, ClearValue, Graph, Handle, Image, Start, execute::Body},
    scene::{Accumulate, Settings},
    shaders::{self, config::*},
    vk::Blend,
};

/// What the pass is made of.
pub(crate) fn mesh_pass(settings: &Settings) -> MeshPass {
    MeshPass {
        fragment: &shaders::POLYGONS_OPAQUE_FRAG,
        color_formats: vec![sum_format(settings.accumulate); 2],
        blend: Blend::Replace,
        depth: Some((vk::CompareOp::GREATER, true)),
        constants: Vec::new(),
    }
}

/// What the pass is made of that shades them; `precision`: of what it leaves.
pub(crate) fn shaded_mesh_pass(settings: &Settings, precision: Accumulate, lights: u32) -> MeshPass {
    let mut constants = shading_constants(settings.shading, lights);
    constants.push((SPEC_HALF_FLOATS, u32::from(precision == Accumulate::F16)));
    MeshPass {
        fragment: &shaders::POLYGONS_SHADED_FRAG,
        color_formats: vec![sum_format(precision)],
        constants,
        ..mesh_pass(settings)
    }
}

/// Declares the pass that draws them first, and shaded; returns their depth.
pub(crate) fn shaded<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    (shown, precision): (&mut Handle<Image>, Accumulate),
    lights: Option<&Handle<Buffer>>,
) -> Result<Handle<Image>> {
    let pipelines = shaded_mesh_pass(inputs.settings, precision, inputs.lights).pipelines(inputs)?;
    let mut depth = graph.create_image("depth of polygons", inputs.image(DEPTH_FORMAT));
    let mut pass = graph
        .pass("polygons")
        .write(shown, Access::ColorAttachment, Start::Clear(ClearValue::Color([0.0; 4])))
        .write(&mut depth, Access::DepthAttachment, Start::Clear(ClearValue::Depth(0.0)));
    if let Some(lights) = lights {
        pass = pass.read(lights, Access::UniformReadFragment);
    }
    let lights = lights.map(Handle::id);
    pass.finish(Box::new(move |context| {
        bind_read(context, inputs, [None; 3], lights)?;
        draw_meshes(context, inputs, &pipelines, None)
    }));
    Ok(depth)
}

/// Declares the pass, and before it, where there are splats, the copy of their depth: accumulation needs both. Returns
/// albedo and 1, normal and 1, where a polygon is seen; and the depth of splats and polygons together.
pub(crate) fn polygons<'a>(
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
