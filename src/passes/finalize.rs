//! Normalization and shading: from sums to the picture.
//!
//! Pixels without any splat are not shaded: the target is cleared to the background, and a triangle at depth 0 (infinitely
//! far) is drawn where the visible depth is above 0 (something is there).

use ash::vk;

use super::{
    Inputs,
    accumulate::Sums,
    constants::FinalizeConstants,
    fullscreen::draw_fullscreen,
    pipelines::{GraphicsKey, Layout},
    variant::shading_constants,
};
use crate::{
    error::Result,
    graph::{Access, ClearValue, Graph, Handle, Image, Start, execute::Body},
    math::srgb::linear_from_srgb,
    scene::Settings,
    shaders,
    vk::Descriptor,
};

/// What its pipeline is.
pub(super) fn key(settings: &Settings, target_format: vk::Format) -> GraphicsKey {
    let constants = shading_constants(settings.shading);
    GraphicsKey {
        color_formats: vec![target_format],
        depth: Some((vk::CompareOp::LESS, false)),
        ..GraphicsKey::fullscreen(&shaders::FINALIZE_FRAG, Layout::Finalize, constants)
    }
}

/// Declares the pass. The target's format decides whether the linear light is encoded (an sRGB format) or kept.
pub(super) fn finalize<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    sums: &Sums,
    depth: &Handle<Image>,
    target: &mut Handle<Image>,
    target_format: vk::Format,
) -> Result<()> {
    let layout = &inputs.shaders.finalize_layout;
    let pipeline = inputs.shaders.graphics(key(inputs.settings, target_format))?;
    let [width, height] = inputs.settings.size_px;
    let background = inputs.settings.background.map_or([0.0; 4], |srgb| {
        let [r, g, b] = srgb.map(linear_from_srgb);
        [r, g, b, 1.0]
    });
    let constants = FinalizeConstants {
        background,
        half_size_px: [0.5 * width as f32, 0.5 * height as f32],
        focal_px: inputs.camera.focal_px(height) as f32,
        padding: 0,
    };
    let ids = [sums.color.id(), sums.normal.id()];
    graph
        .pass("finalize")
        .read(&sums.color, Access::SampledFragment)
        .read(&sums.normal, Access::SampledFragment)
        .read(depth, Access::DepthTest)
        .write(target, Access::ColorAttachment, Start::Clear(ClearValue::Color(background)))
        .finish(Box::new(move |context| {
            let mut given = Vec::new();
            for (number, id) in (0..).zip(ids) {
                given.push((number, Descriptor::Sampled(context.image(id)?.1, context.layout(id))));
            }
            let set = inputs.descriptors.set(&inputs.shaders.sums_set, &given)?;
            draw_fullscreen(context, &pipeline, layout, set, bytemuck::bytes_of(&constants));
            Ok(())
        }));
    Ok(())
}
