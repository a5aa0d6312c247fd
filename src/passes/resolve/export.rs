//! The surface as data: weight, albedo, normal and depth of every pixel.

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
    graph::{Access, ClearValue, Graph, Handle, Image, Start, execute::Body},
    shaders::{self, config::*},
};

/// The images that the export leaves.
pub struct Exported {
    /// R32: Σ weight.
    pub weight: Handle<Image>,
    /// RGBA32: linear albedo; alpha is 1 where covered.
    pub albedo: Handle<Image>,
    /// RGBA32: unit normal in view space; alpha is 1 where covered.
    pub normal: Handle<Image>,
    /// R32: view-space z of the normalized surface in world units, +∞ where empty.
    pub depth: Handle<Image>,
}

impl Exported {
    /// The formats of the four images, in the order of the fields.
    pub const FORMATS: [vk::Format; 4] = [
        vk::Format::R32_SFLOAT,
        vk::Format::R32G32B32A32_SFLOAT,
        vk::Format::R32G32B32A32_SFLOAT,
        vk::Format::R32_SFLOAT,
    ];
}

/// What its pipeline is.
fn key() -> GraphicsKey {
    GraphicsKey {
        color_formats: Exported::FORMATS.into(),
        ..GraphicsKey::fullscreen(&shaders::EXPORT_FRAG, Layout::Finalize, [].into())
    }
}

fn images(graph: &mut Graph<'_, Body<'_>>, inputs: Inputs<'_>) -> Exported {
    let mut image = |name: &str, format| graph.create_image(name, inputs.image(format));
    let [weight, albedo, normal, depth] = Exported::FORMATS;
    Exported {
        weight: image("exported weight", weight),
        albedo: image("exported albedo", albedo),
        normal: image("exported normal", normal),
        depth: image("exported depth", depth),
    }
}

/// Declares the pass, of a scene without opaque splats that their surface is empty. `surface`: their sums and depth.
pub(crate) fn export<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    surface: Option<(&Sums, &Handle<Image>)>,
) -> Result<Exported> {
    let mut exported = images(graph, inputs);
    let clear =
        |value| if surface.is_some() { Start::Discard } else { Start::Clear(ClearValue::Color([value; 4])) };
    let Exported { weight, albedo, normal, depth } = &mut exported;
    let mut pass = Pass::new(graph, inputs.source, "export", "the surface itself was asked for")
        .attach(weight, Access::ColorAttachment, clear(0.0))
        .attach(albedo, Access::ColorAttachment, clear(0.0))
        .attach(normal, Access::ColorAttachment, clear(0.0))
        .attach(depth, Access::ColorAttachment, clear(f32::INFINITY));
    let Some((of_splats, visible)) = surface else {
        pass.finish(|_| Ok(()));
        return Ok(exported);
    };
    pass = pass
        .read(sums(BIND_SUMS_COLORS), &of_splats.color, Access::SampledFragment)
        .read(sums(BIND_SUMS_NORMALS), &of_splats.normal, Access::SampledFragment)
        .read(sums(BIND_SUMS_DEPTH), visible, Access::SampledFragment);
    let (pipeline, constants) = (pass.graphics(key())?, inputs.finalize_constants());
    pass.finish(move |pass| draw_fullscreen(pass, pipeline, &constants));
    Ok(exported)
}
