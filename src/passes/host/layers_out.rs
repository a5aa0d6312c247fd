//! Transparent layers by themselves, which a host lays over its own picture.

use ash::vk;

use crate::passes::{
    inputs::Inputs,
    pass::Pass,
    pipeline::{
        constants::FinalizeConstants,
        key::{GraphicsKey, Layout},
    },
    place::sums,
    resolve::fullscreen::draw_fullscreen,
};
use crate::{
    error::Result,
    graph::{Access, Graph, Handle, Image, Start, execute::Body},
    shaders::{self, config::*},
};

/// Declares the pass, which leaves `layers` in the host's image of this format: with straight alpha, as the opaque surface is left.
pub(crate) fn layers_alone<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    layers: &Handle<Image>,
    (target, format): (&mut Handle<Image>, vk::Format),
) -> Result<()> {
    let constants = FinalizeConstants { background: [0.0; 4], ..inputs.finalize_constants() };
    let pass = Pass::new(
        graph,
        inputs.source,
        "layers alone",
        "a host lays transparent layers over its own picture",
    )
    .attach(target, Access::ColorAttachment, Start::Discard)
    .read(sums(BIND_SUMS_COLORS), layers, Access::SampledFragment);
    let pipeline = pass.graphics(GraphicsKey {
        color_formats: [format].into(),
        ..GraphicsKey::fullscreen(&shaders::FINALIZE_FRAG, Layout::Finalize, [(SPEC_SHADED, 1)].into())
    })?;
    pass.finish(move |pass| draw_fullscreen(pass, pipeline, &constants));
    Ok(())
}
