//! Samples of the picture: each is added to those before it, in linear light and 32 bits; the last leaves their mean in the target.

use ash::vk;

use crate::passes::{
    inputs::Inputs,
    pass::Pass,
    pipeline::key::{GraphicsKey, Layout},
    place::sums,
    resolve::fullscreen::draw_fullscreen,
};
use crate::{
    error::Result,
    graph::{Access, ClearValue, Graph, Handle, Image, Start, execute::Body},
    shaders::{self, config::*},
    vk::Blend,
};

/// The format of a sample, and of their sum.
pub(crate) const SAMPLE_FORMAT: vk::Format = vk::Format::R32G32B32A32_SFLOAT;

/// Why a frame has them.
const WHY: &str =
    "--samples: the picture is the mean of several, seen through windows moved by parts of a pixel";

/// Declares the pass that adds a sample to the sum. `first`: nothing is in it yet.
pub(crate) fn add_sample<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    sample: &Handle<Image>,
    sum: &mut Handle<Image>,
    first: bool,
) -> Result<()> {
    let start = if first { Start::Clear(ClearValue::Color([0.0; 4])) } else { Start::Load };
    let pass = Pass::new(graph, inputs.source, "add sample", WHY)
        .attach(sum, Access::ColorAttachment, start)
        .read(sums(BIND_SUMS_COLORS), sample, Access::SampledFragment);
    let pipeline = pass.graphics(GraphicsKey {
        color_formats: [SAMPLE_FORMAT].into(),
        blend: Blend::AddWeighted,
        ..GraphicsKey::fullscreen(&shaders::SAMPLES_ADD_FRAG, Layout::Finalize, [].into())
    })?;
    let constants = inputs.finalize_constants();
    pass.finish(move |pass| draw_fullscreen(pass, pipeline, &constants));
    Ok(())
}

/// Declares the pass that brings the mean of all samples to the target, whose format decides whether the light is encoded.
pub(crate) fn resolve_samples<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    sum: &Handle<Image>,
    (target, format): (&mut Handle<Image>, vk::Format),
) -> Result<()> {
    let pass = Pass::new(graph, inputs.source, "resolve samples", WHY)
        .attach(target, Access::ColorAttachment, Start::Discard)
        .read(sums(BIND_SUMS_COLORS), sum, Access::SampledFragment);
    let constants = [(SPEC_SAMPLES, inputs.settings.samples.0)].into();
    let pipeline = pass.graphics(GraphicsKey {
        color_formats: [format].into(),
        ..GraphicsKey::fullscreen(&shaders::SAMPLES_RESOLVE_FRAG, Layout::Finalize, constants)
    })?;
    let constants = inputs.finalize_constants();
    pass.finish(move |pass| draw_fullscreen(pass, pipeline, &constants));
    Ok(())
}
