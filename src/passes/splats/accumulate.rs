//! Attribute accumulation: weighted sums of color and normal of the fragments that belong to the visible surface.

use ash::vk;

use crate::passes::pipeline::formats::sum_format;
use crate::passes::{
    cull::lists::Lists,
    inputs::Inputs,
    pass::Pass,
    pipeline::{
        splat_shaders::Summed,
        variant::{Constants, outline_constant},
    },
    place::read,
    splats::{
        draw::{SplatPass, bind_read, draw_splats},
        kernel_texture::kernel_texture,
    },
};
use crate::{
    error::Result,
    graph::{Access, ClearValue, Graph, Handle, Image, Role, Start, execute::Body},
    scene::{KernelEval, Settings, Transition},
    shaders::config::*,
};

/// Why a frame has it.
const WHY: &str = "opaque splats: sums of weights, colors and normals of the nearest surface";

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
    let constants = Constants::from([
        (SPEC_SUMMED, number),
        (SPEC_WITH_DEPTH, with_depth.into()),
        (SPEC_TEXTURED, u32::from(settings.kernel_eval == KernelEval::Texture)),
        (SPEC_PEELED, peeled.into()),
    ]);
    constants.with(outline_constant(settings))
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
        color_formats: [sum_format(settings.accumulate); 2].into(),
        depth: Some((depth, false)),
        constants: summed_constants(settings, summed, false),
        ..SplatPass::new(settings, |drawn| drawn.accumulate(summed))
    }
}

/// The kernel's texture, where it is evaluated so.
pub(crate) fn kernel_of<'a>(
    graph: &mut Graph<'a, Body<'a>>,
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
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    lists: &Lists<'a>,
    depth: &Handle<Image>,
    polygons: Option<&Handle<Image>>,
    kernel: Option<&Handle<Image>>,
    with_depth: bool,
) -> Result<Sums> {
    let format = sum_format(inputs.settings.accumulate);
    let mut sums = Sums {
        color: graph.create_image("color sums", inputs.image(format)),
        normal: graph.create_image("normal sums", inputs.image(format)),
    };
    let zero = Start::Clear(ClearValue::Color([0.0; 4]));
    let pass = Pass::new(graph, inputs.source, "accumulate", WHY)
        .role(Role::Blends)
        .attach(&mut sums.color, Access::ColorAttachment, zero)
        .attach(&mut sums.normal, Access::ColorAttachment, zero)
        .read_if(read(BIND_READ_KERNEL), kernel, Access::SampledFragment);
    let pass = lists.read(read_depths(pass, depth, polygons, with_depth));
    let summed = Summed::Opaque { with_depth, beside_polygons: polygons.is_some() };
    let pipelines = splat_pass(inputs.settings, summed).pipelines(&pass, inputs)?;
    pass.finish(move |pass| {
        bind_read(pass)?;
        draw_splats(pass, inputs, pipelines)
    });
    Ok(sums)
}

/// Adds the depths that accumulation compares with: tested, and read where it is summed or there are polygons.
pub(crate) fn read_depths<'g, 'a>(
    pass: Pass<'g, 'a>,
    depth: &Handle<Image>,
    polygons: Option<&Handle<Image>>,
    with_depth: bool,
) -> Pass<'g, 'a> {
    let pass = pass.read_if(read(BIND_READ_POLYGON_DEPTH), polygons, Access::SampledFragment);
    match with_depth {
        true => pass.read(read(BIND_READ_DEPTH), depth, Access::DepthTestAndSampled),
        false => pass.uses(depth, Access::DepthTest),
    }
}
