//! Attribute accumulation: weighted sums of color and normal of the fragments that belong to the visible surface.

use ash::vk;

use crate::passes::pipeline::formats::sum_format;
use crate::passes::{
    cull::lists::Lists,
    inputs::Inputs,
    pipeline::{splat_shaders::Summed, variant::Constants},
    splats::{
        draw::{SplatPass, draw_splats},
        kernel_texture::kernel_texture,
    },
};
use crate::{
    error::Result,
    graph::{
        Access, ClearValue, Graph, Handle, Image, ResourceId, Start,
        execute::{Body, PassContext},
    },
    scene::{KernelEval, Settings, Transition},
    shaders::config::*,
};

/// What accumulation leaves.
pub(crate) struct Sums {
    /// Σ weight · linear albedo, Σ weight.
    pub color: Handle<Image>,
    /// Σ weight · normal (view space); Σ weight · z / z_visible where depth is summed, Σ weight · alpha of a layer.
    pub normal: Handle<Image>,
}

/// The specialization constants of what is summed of splats; `peeled`: only what is behind a layer.
pub(crate) fn summed_constants(settings: &Settings, summed: Summed, peeled: bool) -> Constants {
    let (number, with_depth) = match summed {
        Summed::Opaque { beside_polygons: false, with_depth } => (SUMMED_OPAQUE, with_depth),
        Summed::Opaque { beside_polygons: true, with_depth } => (SUMMED_BESIDE, with_depth),
        Summed::Layer => (SUMMED_LAYER, false),
        Summed::Rest => (SUMMED_REST, false),
    };
    vec![
        (SPEC_SUMMED, number),
        (SPEC_WITH_DEPTH, with_depth.into()),
        (SPEC_TEXTURED, u32::from(settings.kernel_eval == KernelEval::Texture)),
        (SPEC_PEELED, peeled.into()),
    ]
}

/// What the pass is made of.
pub(crate) fn splat_pass(settings: &Settings, summed: Summed) -> SplatPass {
    let depth = match summed {
        // The paper's shift toward the viewer is for all fragments, so that the shader compares alone.
        Summed::Opaque { beside_polygons: true, .. } if settings.transition == Transition::Paper => {
            vk::CompareOp::ALWAYS
        }
        _ => vk::CompareOp::GREATER_OR_EQUAL,
    };
    SplatPass {
        color_formats: vec![sum_format(settings.accumulate); 2],
        depth: Some((depth, false)),
        constants: summed_constants(settings, summed, false),
        ..SplatPass::new(settings, |drawn| drawn.accumulate(summed))
    }
}

/// The kernel's texture, where it is evaluated so.
pub(crate) fn kernel_of<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
) -> Result<Option<Handle<Image>>> {
    match inputs.settings.kernel_eval {
        KernelEval::Analytic => Ok(None),
        KernelEval::Texture => kernel_texture(graph, inputs, false).map(Some),
    }
}

/// Declares the pass. `polygons`: the larger one of the splats' visible depth and that of polygons, where there are any;
/// `with_depth`: something reads the surface's depth, so it is summed too.
pub(crate) fn accumulate<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    lists: &Lists,
    depth: &Handle<Image>,
    polygons: Option<&Handle<Image>>,
    kernel: Option<&Handle<Image>>,
    with_depth: bool,
) -> Result<Sums> {
    let format = sum_format(inputs.settings.accumulate);
    let summed = Summed::Opaque { with_depth, beside_polygons: polygons.is_some() };
    let pipelines = splat_pass(inputs.settings, summed).pipelines(inputs)?;
    let sampled = [with_depth.then(|| depth.id()), kernel.map(Handle::id), polygons.map(Handle::id)];

    let mut sums = Sums {
        color: graph.create_image("color sums", inputs.image(format)),
        normal: graph.create_image("normal sums", inputs.image(format)),
    };
    let zero = Start::Clear(ClearValue::Color([0.0; 4]));
    let access = if with_depth { Access::DepthTestAndSampled } else { Access::DepthTest };
    let mut pass = graph
        .pass("accumulate")
        .write(&mut sums.color, Access::ColorAttachment, zero)
        .write(&mut sums.normal, Access::ColorAttachment, zero)
        .read(depth, access);
    for image in [kernel, polygons].into_iter().flatten() {
        pass = pass.read(image, Access::SampledFragment);
    }
    let ids = lists.ids();
    lists.read(pass).finish(Box::new(move |context| {
        bind_read(context, inputs, sampled, None)?;
        draw_splats(context, inputs, &pipelines, &ids, None)
    }));
    Ok(sums)
}

/// Binds what the fragments of splats or polygons read, and lights: set 2 of their layout, which stays bound while the sets below
/// it change. The images are those of `BIND_READ_DEPTH`, `BIND_READ_KERNEL`, `BIND_READ_POLYGON_DEPTH`.
pub(crate) fn bind_read(
    context: &PassContext<'_>,
    inputs: Inputs<'_>,
    images: [Option<ResourceId>; 3],
    lights: Option<ResourceId>,
) -> Result<()> {
    let mut given = Vec::new();
    if let Some(lights) = lights {
        given.push((BIND_READ_LIGHTS, context.descriptor(lights)?));
    }
    let bindings = [BIND_READ_DEPTH, BIND_READ_KERNEL, BIND_READ_POLYGON_DEPTH];
    for (number, id) in bindings.into_iter().zip(images) {
        if let Some(id) = id {
            given.push((number, context.descriptor(id)?));
        }
    }
    let set = inputs.descriptors.set(&inputs.shaders.read_set, &given)?;
    let layout = inputs.shaders.splat_layout.raw();
    let bind_point = vk::PipelineBindPoint::GRAPHICS;
    // SAFETY: set 2 of the splat passes' layout.
    unsafe {
        context.device().cmd_bind_descriptor_sets(context.commands(), bind_point, layout, 2, &[set], &[]);
    }
    Ok(())
}
