//! Whose the visible surface is, pixel by pixel: of all that covers a pixel, the thing whose depth is nearest to the depth that is drawn.
//!
//! The depth of a surface is the mean of its splats' own. Behind the mean, or at it, is a splat of the surface, and in front of it, or at it, another: what is
//! farther than all of them, or nearer, is farther from the mean than those are. So it is always a splat of the surface itself that is found, whatever ε is,
//! and at an edge that is covered in part one of the surface that has the pixel's depth.

use ash::vk;

use crate::passes::{
    cull::lists::Lists,
    inputs::Inputs,
    pass::Pass,
    pipeline::formats::DEPTH_FORMAT,
    place::read,
    polygons::mesh_pass::{MeshPass, draw_meshes},
    splats::draw::{SplatPass, bind_read, draw_splats},
};
use crate::{
    error::Result,
    graph::{Access, ClearValue, Graph, Handle, Image, Start, execute::Body},
    shaders::{self, config::*},
    vk::Blend,
};

/// Nearer to the depth that is drawn has the greater depth.
const TEST: Option<(vk::CompareOp, bool)> = Some((vk::CompareOp::GREATER, true));

/// Declares the passes. `surface`: the depth that is drawn, as [`super::depth_out`] leaves it.
pub(crate) fn objects<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    surface: &Handle<Image>,
    objects: &mut Handle<Image>,
) -> Result<()> {
    let lists = Lists::make(graph, inputs, "objects' ")?;
    let mut distance = graph.create_image("distance from the surface", inputs.image(DEPTH_FORMAT));
    let why = "a host wants to know whose the surface is";
    let pass = Pass::new(graph, inputs.source, "objects", why)
        .attach(objects, Access::ColorAttachment, Start::Clear(ClearValue::Color([0.0; 4])))
        .attach(&mut distance, Access::DepthAttachment, Start::Clear(ClearValue::Depth(0.0)))
        .read(read(BIND_READ_DEPTH), surface, Access::SampledFragment);
    let pass = lists.read(pass);
    let color_formats = || [super::OBJECTS_FORMAT].into();
    let splats = SplatPass {
        color_formats: color_formats(),
        blend: Blend::Replace,
        depth: TEST,
        ..SplatPass::new(inputs.settings, |drawn| drawn.objects())
    };
    let meshes = MeshPass {
        fragment: &shaders::OBJECTS_POLYGONS_FRAG,
        color_formats: color_formats(),
        blend: Blend::Replace,
        depth: TEST,
        constants: [].into(),
    };
    let splats = splats.pipelines(&pass, inputs)?;
    let meshes = meshes.pipelines(&pass, inputs)?;
    pass.finish(move |pass| {
        bind_read(pass)?;
        draw_splats(pass, inputs, splats)?;
        draw_meshes(pass, inputs, meshes)
    });
    Ok(())
}
