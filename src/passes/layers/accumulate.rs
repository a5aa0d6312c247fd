//! Attribute accumulation of a transparent layer: as that of opaque splats, with the sum of alphas, for what is behind the
//! layer before; and the same for polygons, each of weight 1, into images of their own.

use ash::vk;

use crate::passes::pipeline::formats::sum_format;
use crate::passes::{
    layers::layer::Layer,
    pipeline::splat_shaders::Summed,
    polygons::mesh_pass::{MeshPass, draw_meshes},
    splats::{
        accumulate::{Sums, bind_read, summed_constants},
        draw::{SplatPass, draw_splats},
    },
};
use crate::{
    error::Result,
    graph::{Access, ClearValue, Graph, Handle, Image, Start, execute::Body},
    scene::Settings,
    shaders::{self, config::*},
    vk::Blend,
};

/// What belongs to a layer is not behind its depth.
const IN_LAYER: Option<(vk::CompareOp, bool)> = Some((vk::CompareOp::GREATER_OR_EQUAL, false));

/// What the pass over splats is made of. `peeled`: only what is behind a layer.
pub(crate) fn splat_pass(settings: &Settings, peeled: bool) -> SplatPass {
    SplatPass {
        color_formats: vec![sum_format(settings.accumulate); 2],
        depth: IN_LAYER,
        constants: summed_constants(settings, Summed::Layer, peeled),
        ..SplatPass::new(settings, |drawn| drawn.accumulate(Summed::Layer))
    }
}

/// What the pass over polygons is made of. `peeled`: only what is behind a layer.
pub(crate) fn mesh_pass(settings: &Settings, peeled: bool) -> MeshPass {
    MeshPass {
        fragment: &shaders::POLYGONS_TRANSPARENT_FRAG,
        color_formats: vec![sum_format(settings.accumulate); 2],
        blend: Blend::Add,
        depth: IN_LAYER,
        constants: vec![(SPEC_SUMMED, SUMMED_LAYER), (SPEC_PEELED, peeled.into())],
    }
}

/// Declares the pass over the splats of a layer of this depth.
pub(crate) fn layer_accumulate<'a>(
    graph: &mut Graph<Body<'a>>,
    layer: &Layer<'a, '_>,
    depth: &Handle<Image>,
) -> Result<Sums> {
    let inputs = layer.inputs;
    let pipelines = splat_pass(inputs.settings, layer.before.is_some()).pipelines(inputs)?;
    let sampled = [layer.before.map(Handle::id), layer.kernel.map(Handle::id), None];
    let (lists, gate) = (layer.list_ids(), layer.gate());
    declare(graph, layer, depth, ["color sums", "normal sums", "accumulate"], layer.kernel, move |context| {
        bind_read(context, inputs, sampled, None)?;
        draw_splats(context, inputs, &pipelines, &lists, gate)
    })
}

/// Declares the pass over the polygons of a layer of this depth.
pub(crate) fn layer_polygons<'a>(
    graph: &mut Graph<Body<'a>>,
    layer: &Layer<'a, '_>,
    depth: &Handle<Image>,
) -> Result<Sums> {
    let inputs = layer.inputs;
    let pipelines = mesh_pass(inputs.settings, layer.before.is_some()).pipelines(inputs)?;
    let sampled = [layer.before.map(Handle::id), None, None];
    let gate = layer.gate();
    declare(graph, layer, depth, ["polygon colors", "polygon normals", "polygons"], None, move |context| {
        bind_read(context, inputs, sampled, None)?;
        draw_meshes(context, inputs, &pipelines, gate)
    })
}

/// Declares one of the passes; the names are those of both images and of the pass.
fn declare<'a>(
    graph: &mut Graph<Body<'a>>,
    layer: &Layer<'a, '_>,
    depth: &Handle<Image>,
    [color, normal, pass]: [&str; 3],
    kernel: Option<&Handle<Image>>,
    body: impl FnOnce(&crate::graph::execute::PassContext<'_>) -> Result<()> + 'a,
) -> Result<Sums> {
    let desc = layer.inputs.image(sum_format(layer.inputs.settings.accumulate));
    let mut sums = Sums {
        color: graph.create_image(&layer.name(color), desc),
        normal: graph.create_image(&layer.name(normal), desc),
    };
    let zero = Start::Clear(ClearValue::Color([0.0; 4]));
    let mut pass = graph
        .pass(&layer.name(pass))
        .write(&mut sums.color, Access::ColorAttachment, zero)
        .write(&mut sums.normal, Access::ColorAttachment, zero)
        .read(depth, Access::DepthTest);
    if let Some(kernel) = kernel {
        pass = pass.read(kernel, Access::SampledFragment);
    }
    layer.read(pass).finish(Box::new(body));
    Ok(sums)
}
