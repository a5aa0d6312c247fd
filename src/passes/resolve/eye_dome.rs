//! Eye-dome lighting in place of finalization, where it is asked for: from sums, with depth, to the picture.

use ash::vk;

use crate::passes::{
    inputs::Inputs,
    pass::Pass,
    pipeline::key::{GraphicsKey, Layout},
    place::sums,
    resolve::fullscreen::draw_fullscreen,
    splats::accumulate::Sums,
};
use crate::{
    error::Result,
    graph::{Access, Graph, Handle, Image, Start, execute::Body},
    shaders::{self, config::*},
};

/// Declares the pass. `of_splats`, `visible`: the sums of opaque splats, with depth, and what hides others behind it, all of them
/// with content everywhere.
pub(crate) fn eye_dome<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    (of_splats, visible): (&Sums, &Handle<Image>),
    target: &mut Handle<Image>,
    target_format: vk::Format,
) -> Result<()> {
    let pass =
        Pass::new(graph, inputs.source, "eye dome", "eye-dome lighting was asked for, of the depths around")
            .attach(target, Access::ColorAttachment, Start::Discard)
            .read(sums(BIND_SUMS_COLORS), &of_splats.color, Access::SampledFragment)
            .read(sums(BIND_SUMS_NORMALS), &of_splats.normal, Access::SampledFragment)
            .read(sums(BIND_SUMS_DEPTH), visible, Access::SampledFragment);
    let key = GraphicsKey {
        color_formats: [target_format].into(),
        ..GraphicsKey::fullscreen(&shaders::EYE_DOME_FRAG, Layout::Finalize, [].into())
    };
    let (pipeline, constants) = (pass.graphics(key)?, inputs.finalize_constants());
    pass.finish(move |pass| draw_fullscreen(pass, pipeline, &constants));
    Ok(())
}
