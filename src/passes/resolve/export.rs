//! The surface as data: weight, albedo, normal and depth of every pixel.

use ash::vk;

use crate::passes::{
    inputs::Inputs,
    pipeline::{
        cache::{GraphicsKey, Layout},
        fullscreen::draw_fullscreen,
    },
    resolve::finalize,
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
pub(crate) fn key() -> GraphicsKey {
    GraphicsKey {
        color_formats: Exported::FORMATS.to_vec(),
        ..GraphicsKey::fullscreen(&shaders::EXPORT_FRAG, Layout::Finalize, Vec::new())
    }
}

fn images(graph: &mut Graph<Body<'_>>, inputs: Inputs<'_>) -> Exported {
    let mut image = |name: &str, format| graph.create_image(name, inputs.image(format));
    let [weight, albedo, normal, depth] = Exported::FORMATS;
    Exported {
        weight: image("exported weight", weight),
        albedo: image("exported albedo", albedo),
        normal: image("exported normal", normal),
        depth: image("exported depth", depth),
    }
}

/// Declares the pass of a scene without opaque splats: their surface is empty.
pub(crate) fn export_nothing<'a>(graph: &mut Graph<Body<'a>>, inputs: Inputs<'a>) -> Exported {
    let mut exported = images(graph, inputs);
    let zero = Start::Clear(ClearValue::Color([0.0; 4]));
    let far = Start::Clear(ClearValue::Color([f32::INFINITY; 4]));
    graph
        .pass("export")
        .write(&mut exported.weight, Access::ColorAttachment, zero)
        .write(&mut exported.albedo, Access::ColorAttachment, zero)
        .write(&mut exported.normal, Access::ColorAttachment, zero)
        .write(&mut exported.depth, Access::ColorAttachment, far)
        .finish(Box::new(|_| Ok(())));
    exported
}

/// Declares the pass.
pub(crate) fn export<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    sums: &Sums,
    depth: &Handle<Image>,
) -> Result<Exported> {
    let pipeline = inputs.shaders.graphics(key())?;
    let constants = finalize::constants(inputs);
    let read = [
        (BIND_SUMS_COLORS, sums.color.id()),
        (BIND_SUMS_NORMALS, sums.normal.id()),
        (BIND_SUMS_DEPTH, depth.id()),
    ];
    let mut exported = images(graph, inputs);
    graph
        .pass("export")
        .read(&sums.color, Access::SampledFragment)
        .read(&sums.normal, Access::SampledFragment)
        .read(depth, Access::SampledFragment)
        .write(&mut exported.weight, Access::ColorAttachment, Start::Discard)
        .write(&mut exported.albedo, Access::ColorAttachment, Start::Discard)
        .write(&mut exported.normal, Access::ColorAttachment, Start::Discard)
        .write(&mut exported.depth, Access::ColorAttachment, Start::Discard)
        .finish(Box::new(move |context| {
            draw_fullscreen(context, inputs, &pipeline, (&read, None), &constants)
        }));
    Ok(exported)
}
