//! Attribute accumulation of a transparent layer: as that of opaque splats, with the sum of alphas, for what is behind the
//! layer before; and the same for polygons, each of weight 1, into images of their own.

use ash::vk;

use crate::passes::{
    layers::layer::Layer,
    pass::Pass,
    pipeline::{formats::sum_format, splat_shaders::Summed},
    place::read,
    polygons::mesh_pass::{MeshPass, draw_meshes},
    splats::{
        accumulate::{Sums, summed_constants},
        draw::{SplatPass, bind_read, draw_splats},
    },
};
use crate::{
    error::Result,
    graph::{Access, ClearValue, Graph, Handle, Image, Role, Start, execute::Body},
    scene::Settings,
    shaders::{self, config::*},
    vk::Blend,
};

/// What belongs to a layer is not behind its depth.
const IN_LAYER: Option<(vk::CompareOp, bool)> = Some((vk::CompareOp::GREATER_OR_EQUAL, false));

/// What the pass over splats is made of. `peeled`: only what is behind a layer.
fn splat_pass(settings: &Settings, peeled: bool) -> SplatPass {
    SplatPass {
        color_formats: [sum_format(settings.accumulate); 2].into(),
        depth: IN_LAYER,
        constants: summed_constants(settings, Summed::Layer, peeled),
        ..SplatPass::new(settings, |drawn| drawn.accumulate(Summed::Layer))
    }
}

/// What the pass over polygons is made of. `peeled`: only what is behind a layer.
fn mesh_pass(settings: &Settings, peeled: bool) -> MeshPass {
    MeshPass {
        fragment: &shaders::POLYGONS_TRANSPARENT_FRAG,
        color_formats: [sum_format(settings.accumulate); 2].into(),
        blend: Blend::Add,
        depth: IN_LAYER,
        constants: [(SPEC_SUMMED, SUMMED_LAYER), (SPEC_PEELED, peeled.into())].into(),
    }
}

/// Declares the pass over the splats of a layer of this depth.
pub(crate) fn layer_accumulate<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    layer: &Layer<'a, '_>,
    depth: &Handle<Image>,
) -> Result<Sums> {
    let inputs = layer.inputs;
    let mut sums = create(graph, layer, ["color sums", "normal sums"]);
    let why = "transparent things: sums of weights, colors, normals and alphas of the layer";
    let pass = begin(layer.pass(graph, "accumulate", why), layer, depth, &mut sums);
    let pass = pass.read_if(read(BIND_READ_KERNEL), layer.kernel, Access::SampledFragment);
    let pipelines = splat_pass(inputs.settings, layer.before.is_some()).pipelines(&pass, inputs)?;
    pass.finish(move |pass| {
        bind_read(pass)?;
        draw_splats(pass, inputs, pipelines)
    });
    Ok(sums)
}

/// Declares the pass over the polygons of a layer of this depth.
pub(crate) fn layer_polygons<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    layer: &Layer<'a, '_>,
    depth: &Handle<Image>,
) -> Result<Sums> {
    let inputs = layer.inputs;
    let mut sums = create(graph, layer, ["polygon colors", "polygon normals"]);
    let why = "transparent polygons: their sums in the layer";
    let pass = begin(layer.pass(graph, "polygons", why), layer, depth, &mut sums);
    let pipelines = mesh_pass(inputs.settings, layer.before.is_some()).pipelines(&pass, inputs)?;
    pass.finish(move |pass| {
        bind_read(pass)?;
        draw_meshes(pass, inputs, pipelines)
    });
    Ok(sums)
}

fn create(graph: &mut Graph<'_, Body<'_>>, layer: &Layer<'_, '_>, names: [&str; 2]) -> Sums {
    let desc = layer.inputs.image(sum_format(layer.inputs.settings.accumulate));
    let [color, normal] = names.map(|name| graph.create_image(layer.name(name), desc));
    Sums { color, normal }
}

/// Adds what both passes write and compare with.
fn begin<'g, 'a>(
    pass: Pass<'g, 'a>,
    layer: &Layer<'a, '_>,
    depth: &Handle<Image>,
    sums: &mut Sums,
) -> Pass<'g, 'a> {
    let zero = Start::Clear(ClearValue::Color([0.0; 4]));
    let pass = pass
        .role(Role::Blends)
        .attach(&mut sums.color, Access::ColorAttachment, zero)
        .attach(&mut sums.normal, Access::ColorAttachment, zero)
        .uses(depth, Access::DepthTest);
    layer.read(pass)
}
