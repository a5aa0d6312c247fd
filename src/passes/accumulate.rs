//! Attribute accumulation: weighted sums of color and normal of the fragments that belong to the visible surface.

use ash::vk;

use super::{
    Inputs,
    draws::{SplatPass, draw_splats},
    kernel_texture::kernel_texture,
    list_large::{LargeList, ids_of, read_lists},
    splat_shaders::{accumulate_words, splat_shaders},
    sum_format,
};
use crate::{
    error::Result,
    graph::{Access, ClearValue, Graph, Handle, Image, Start, execute::Body},
    scene::{KernelEval, Settings},
    shaders,
    vk::Descriptor,
};

/// What accumulation leaves.
pub(super) struct Sums {
    /// Σ weight · linear albedo, Σ weight.
    pub color: Handle<Image>,
    /// Σ weight · normal (view space); Σ weight · z / z_visible where depth is summed, else 0.
    pub normal: Handle<Image>,
}

/// What the pass is made of.
pub(super) fn splat_pass(settings: &Settings, with_depth: bool) -> Result<SplatPass> {
    Ok(SplatPass {
        shaders: splat_shaders("accumulate", settings, &accumulate_words(settings, with_depth))?,
        color_formats: vec![sum_format(settings); 2],
        depth: (vk::CompareOp::GREATER_OR_EQUAL, false),
    })
}

/// Declares the pass. `with_depth`: something reads the surface's depth, so it is summed too.
pub(super) fn accumulate<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    large: &[Option<LargeList>],
    depth: &Handle<Image>,
    with_depth: bool,
) -> Result<Sums> {
    let format = sum_format(inputs.settings);
    let kernel = match inputs.settings.kernel_eval {
        KernelEval::Analytic => None,
        KernelEval::Texture => Some(kernel_texture(graph, inputs, &shaders::KERNEL_TEXTURE_FRAG)?),
    };
    let kernel_id = kernel.as_ref().map(Handle::id);
    let pipelines = splat_pass(inputs.settings, with_depth)?.pipelines(inputs)?;
    let large_ids = ids_of(large);
    let depth_id = depth.id();

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
    if let Some(kernel) = &kernel {
        pass = pass.read(kernel, Access::SampledFragment);
    }
    read_lists(pass, large).finish(Box::new(move |context| {
        let mut given = Vec::new();
        for (number, id) in [(0, with_depth.then_some(depth_id)), (1, kernel_id)] {
            if let Some(id) = id {
                let (_, view) = context.image(id)?;
                given.push((number, Descriptor::Sampled(view, context.layout(id))));
            }
        }
        if !given.is_empty() {
            let set = inputs.descriptors.set(&inputs.shaders.read_set, &given)?;
            let layout = inputs.shaders.splat_layout.raw();
            let bind_point = vk::PipelineBindPoint::GRAPHICS;
            // SAFETY: set 2 of the splat passes' layout; stays bound while the sets below it change.
            unsafe {
                let device = context.device();
                device.cmd_bind_descriptor_sets(context.commands(), bind_point, layout, 2, &[set], &[]);
            }
        }
        draw_splats(context, inputs, &pipelines, &large_ids)
    }));
    Ok(sums)
}
