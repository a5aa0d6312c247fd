//! Opaque polygons, drawn upon the depth that visibility splatting leaves (Guennebaud et al. 2006, section 5.1, step 2):
//! their attributes, for finalization. Or drawn before all splats and shaded at once, for tiles that lay splats over them: the nearest
//! one at a pixel is all that can be seen of them.

use ash::vk;

use crate::passes::pipeline::formats::{DEPTH_FORMAT, sum_format};
use crate::passes::{
    inputs::Inputs,
    pass::Pass,
    pipeline::variant::shading_constants,
    place::read,
    polygons::{
        cells::{self, CELLS},
        copy_depth::depth_from,
        mesh_pass::{MeshPass, draw_meshes},
    },
    splats::{accumulate::Sums, draw::bind_read},
};
use crate::{
    error::Result,
    graph::{Access, Buffer, ClearValue, Graph, Handle, Image, Start, execute::Body},
    scene::{Accumulate, Settings},
    shaders::{self, config::*},
    vk::Blend,
};

/// What the pass is made of.
pub(super) fn mesh_pass(settings: &Settings) -> MeshPass {
    MeshPass {
        fragment: &shaders::POLYGONS_OPAQUE_FRAG,
        color_formats: [sum_format(settings.accumulate); 2].into(),
        blend: Blend::Replace,
        depth: Some((vk::CompareOp::GREATER, true)),
        constants: [].into(),
    }
}

/// What the pass is made of that shades them; `precision`: of what it leaves.
pub(super) fn shaded_mesh_pass(settings: &Settings, precision: Accumulate, lights: u32) -> MeshPass {
    let mut constants = shading_constants(settings.shading, lights);
    constants.push((SPEC_HALF_FLOATS, u32::from(precision == Accumulate::F16)));
    MeshPass {
        fragment: &shaders::POLYGONS_SHADED_FRAG,
        color_formats: [sum_format(precision)].into(),
        constants,
        ..mesh_pass(settings)
    }
}

/// Declares the pass that draws them first, and shaded; returns their depth.
pub(crate) fn shaded<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    (shown, precision): (&mut Handle<Image>, Accumulate),
    lights: Option<&Handle<Buffer>>,
) -> Result<Handle<Image>> {
    let cells = cells::choose(graph, inputs)?;
    let mut depth = graph.create_image("depth of polygons", inputs.image(DEPTH_FORMAT));
    let pass = Pass::new(
        graph,
        inputs.source,
        "polygons",
        "opaque polygons, where they are nearest: what they show beside tiles",
    )
    .attach(shown, Access::ColorAttachment, Start::Clear(ClearValue::Color([0.0; 4])))
    .attach(&mut depth, Access::DepthAttachment, Start::Clear(ClearValue::Depth(0.0)))
    .read_if(read(BIND_READ_LIGHTS), lights, Access::UniformReadFragment)
    .read_if(CELLS, cells.as_ref(), Access::IndirectRead);
    let pipelines = shaded_mesh_pass(inputs.settings, precision, inputs.lights).pipelines(&pass, inputs)?;
    pass.finish(move |pass| {
        bind_read(pass)?;
        draw_meshes(pass, inputs, pipelines)
    });
    Ok(depth)
}

/// Declares the pass, and before it, where there are splats, the copy of their depth: accumulation needs both. Returns
/// albedo and 1, normal and 1, where a polygon is seen; and the depth of splats and polygons together.
pub(crate) fn polygons<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    splats: Option<&Handle<Image>>,
) -> Result<(Sums, Handle<Image>)> {
    let cells = cells::choose(graph, inputs)?;
    let format = sum_format(inputs.settings.accumulate);
    let mut seen = Sums {
        color: graph.create_image("polygon colors", inputs.image(format)),
        normal: graph.create_image("polygon normals", inputs.image(format)),
    };
    let why = "splats beside polygons: accumulation needs the depth of both";
    let (mut depth, start) = depth_from(graph, inputs, "depth with polygons", why, splats);
    let zero = Start::Clear(ClearValue::Color([0.0; 4]));
    let pass = Pass::new(
        graph,
        inputs.source,
        "polygons",
        "opaque polygons, where they are nearest: what shades them later",
    )
    .attach(&mut seen.color, Access::ColorAttachment, zero)
    .attach(&mut seen.normal, Access::ColorAttachment, zero)
    .attach(&mut depth, Access::DepthAttachment, start)
    .read_if(CELLS, cells.as_ref(), Access::IndirectRead);
    let pipelines = mesh_pass(inputs.settings).pipelines(&pass, inputs)?;
    pass.finish(move |pass| {
        bind_read(pass)?;
        draw_meshes(pass, inputs, pipelines)
    });
    Ok((seen, depth))
}
