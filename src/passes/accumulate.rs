//! Attribute accumulation: weighted sums of color and normal of the fragments that belong to the visible surface.

use ash::vk;

use super::{
    Inputs,
    kernel_texture::kernel_texture,
    lists::Lists,
    splat_pass::{SplatPass, draw_splats},
    splat_shaders::{Summed, Words, splat_shaders},
    sum_format,
};
use crate::{
    error::Result,
    graph::{
        Access, ClearValue, Graph, Handle, Image, ResourceId, Start,
        execute::{Body, PassContext},
    },
    scene::{KernelEval, Settings, Transition},
    shaders,
};

/// What accumulation leaves.
pub(super) struct Sums {
    /// Σ weight · linear albedo, Σ weight.
    pub color: Handle<Image>,
    /// Σ weight · normal (view space); Σ weight · z / z_visible where depth is summed, Σ weight · alpha of a layer.
    pub normal: Handle<Image>,
}

/// What the pass is made of.
pub(super) fn splat_pass(settings: &Settings, summed: Summed) -> Result<SplatPass> {
    let depth = match summed {
        // The paper's shift toward the viewer is for all fragments, so that the shader compares alone.
        Summed::Opaque { beside_polygons: true, .. } if settings.transition == Transition::Paper => {
            vk::CompareOp::ALWAYS
        }
        _ => vk::CompareOp::GREATER_OR_EQUAL,
    };
    Ok(SplatPass {
        shaders: splat_shaders(settings, &Words::accumulate(settings, summed))?,
        color_formats: vec![sum_format(settings.accumulate); 2],
        depth: Some((depth, false)),
        constants: Vec::new(),
    })
}

/// The kernel's texture, where it is evaluated so.
pub(super) fn kernel_of<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
) -> Result<Option<Handle<Image>>> {
    match inputs.settings.kernel_eval {
        KernelEval::Analytic => Ok(None),
        KernelEval::Texture => kernel_texture(graph, inputs, &shaders::KERNEL_TEXTURE_FRAG).map(Some),
    }
}

/// Declares the pass. `polygons`: the larger one of the splats' visible depth and that of polygons, where there are any;
/// `with_depth`: something reads the surface's depth, so it is summed too.
pub(super) fn accumulate<'a>(
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
    let pipelines = splat_pass(inputs.settings, summed)?.pipelines(inputs)?;
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
        bind_sampled(context, inputs, sampled)?;
        draw_splats(context, inputs, &pipelines, &ids, None)
    }));
    Ok(sums)
}

/// Binds what fragments of splats or polygons read: set 2 of their layout, which stays bound while the sets below it
/// change.
pub(super) fn bind_sampled(
    context: &PassContext<'_>,
    inputs: Inputs<'_>,
    images: [Option<ResourceId>; 3],
) -> Result<()> {
    bind_read(context, inputs, images, None)
}

/// As [`bind_sampled`], with lights.
pub(super) fn bind_read(
    context: &PassContext<'_>,
    inputs: Inputs<'_>,
    images: [Option<ResourceId>; 3],
    lights: Option<ResourceId>,
) -> Result<()> {
    let mut given = Vec::new();
    if let Some(lights) = lights {
        given.push((3, context.descriptor(lights)?));
    }
    for (number, id) in (0..).zip(images) {
        if let Some(id) = id {
            given.push((number, context.descriptor(id)?));
        }
    }
    if !given.is_empty() {
        let set = inputs.descriptors.set(&inputs.shaders.read_set, &given)?;
        let layout = inputs.shaders.splat_layout.raw();
        let bind_point = vk::PipelineBindPoint::GRAPHICS;
        // SAFETY: set 2 of the splat passes' layout.
        unsafe {
            let device = context.device();
            device.cmd_bind_descriptor_sets(context.commands(), bind_point, layout, 2, &[set], &[]);
        }
    }
    Ok(())
}
