//! The last layer (Guennebaud et al. 2006, section 6): all that is behind the layers before, in one sum, without visibility.
//! Weights are multiplied by alpha, so that what hides more counts more, and each splat is lit by itself: normals of
//! surfaces behind each other have no meaningful mean.

use ash::vk;

use crate::passes::{
    layers::layer::Layer,
    pipeline::{formats::sum_format, splat_shaders::Summed, variant::shading_constants},
    place::read,
    polygons::mesh_pass::{MeshPass, draw_meshes},
    splats::{
        accumulate::{Sums, summed_constants},
        draw::{SplatPass, bind_read, draw_splats},
    },
};
use crate::{
    error::Result,
    graph::{Access, ClearValue, Graph, Role, Start, execute::Body},
    scene::{Accumulate, Settings},
    shaders::{self, config::*},
    vk::Blend,
};

/// The format of the sum of weights.
fn weight_format(settings: &Settings) -> vk::Format {
    match settings.accumulate {
        Accumulate::F16 => vk::Format::R16_SFLOAT,
        Accumulate::F32 | Accumulate::Auto => vk::Format::R32_SFLOAT,
    }
}

/// In front of opaque things, where there are any.
fn depth_test(opaque: bool) -> Option<(vk::CompareOp, bool)> {
    opaque.then_some((vk::CompareOp::GREATER_OR_EQUAL, false))
}

/// What the pass is made of for splats. `peeled`: behind a layer; `opaque`: in front of opaque things; `lights`:
/// the scene's own.
fn splat_pass(settings: &Settings, peeled: bool, opaque: bool, lights: u32) -> SplatPass {
    let mut constants = summed_constants(settings, Summed::Rest, peeled);
    constants.extend(shading_constants(settings.shading, lights));
    SplatPass {
        color_formats: [sum_format(settings.accumulate), weight_format(settings)].into(),
        depth: depth_test(opaque),
        constants,
        ..SplatPass::new(settings, |drawn| drawn.accumulate(Summed::Rest))
    }
}

/// What it is made of for polygons.
fn mesh_pass(settings: &Settings, peeled: bool, opaque: bool, lights: u32) -> MeshPass {
    let mut constants = shading_constants(settings.shading, lights);
    constants.extend([(SPEC_SUMMED, SUMMED_REST), (SPEC_PEELED, peeled.into())]);
    MeshPass {
        fragment: &shaders::POLYGONS_TRANSPARENT_FRAG,
        color_formats: [sum_format(settings.accumulate), weight_format(settings)].into(),
        blend: Blend::Add,
        depth: depth_test(opaque),
        constants,
    }
}

/// Declares the pass; returns Σ weight · alpha · color with Σ weight · alpha, and Σ weight.
pub(crate) fn layer_rest<'a>(graph: &mut Graph<'a, Body<'a>>, layer: &Layer<'a, '_>) -> Result<Sums> {
    let inputs = layer.inputs;
    let settings = inputs.settings;
    let mut sums = Sums {
        color: graph.create_image(layer.name("color sums"), inputs.image(sum_format(settings.accumulate))),
        normal: graph.create_image(layer.name("weight sums"), inputs.image(weight_format(settings))),
    };
    let zero = Start::Clear(ClearValue::Color([0.0; 4]));
    let why = "transparent things: lit colors and weights of all that is left";
    let mut pass = layer
        .pass(graph, "accumulate", why)
        .role(Role::Blends)
        .attach(&mut sums.color, Access::ColorAttachment, zero)
        .attach(&mut sums.normal, Access::ColorAttachment, zero)
        .read_if(read(BIND_READ_KERNEL), layer.kernel, Access::SampledFragment);
    if let Some(opaque) = layer.opaque {
        pass = pass.uses(opaque, Access::DepthTest);
    }
    if let Some(lights) = layer.lights {
        // Splats are lit in the vertex stage, polygons in the fragment stage.
        pass = pass.uses(lights, Access::UniformReadVertex).read(
            read(BIND_READ_LIGHTS),
            lights,
            Access::UniformReadFragment,
        );
    }
    let pass = layer.read(pass);
    let (peeled, opaque) = (layer.before.is_some(), layer.opaque.is_some());
    let splats = splat_pass(settings, peeled, opaque, inputs.lights).pipelines(&pass, inputs)?;
    let meshes = mesh_pass(settings, peeled, opaque, inputs.lights).pipelines(&pass, inputs)?;
    pass.finish(move |pass| {
        bind_read(pass)?;
        draw_splats(pass, inputs, splats)?;
        draw_meshes(pass, inputs, meshes)
    });
    Ok(sums)
}
