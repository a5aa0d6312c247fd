//! The surface as data: weight, albedo, normal and depth of every pixel.

use ash::vk;

use super::{
    Inputs,
    accumulate::Sums,
    constants::ExportConstants,
    fullscreen::draw_fullscreen,
    pipelines::{GraphicsKey, Layout},
};
use crate::{
    error::Result,
    graph::{Access, Graph, Handle, Image, Start, execute::Body},
    shaders,
    vk::Descriptor,
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
pub(super) fn key() -> GraphicsKey {
    GraphicsKey {
        color_formats: Exported::FORMATS.to_vec(),
        ..GraphicsKey::fullscreen(&shaders::EXPORT_FRAG, Layout::Export, Vec::new())
    }
}

/// Declares the pass.
pub(super) fn export<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    sums: &Sums,
    depth: &Handle<Image>,
) -> Result<Exported> {
    let layout = &inputs.shaders.export_layout;
    let pipeline = inputs.shaders.graphics(key())?;
    let constants = ExportConstants { near: inputs.camera.near() as f32 };
    let ids = [sums.color.id(), sums.normal.id(), depth.id()];
    let [weight, albedo, normal, depth_format] = Exported::FORMATS;
    let mut exported = Exported {
        weight: graph.create_image("exported weight", inputs.image(weight)),
        albedo: graph.create_image("exported albedo", inputs.image(albedo)),
        normal: graph.create_image("exported normal", inputs.image(normal)),
        depth: graph.create_image("exported depth", inputs.image(depth_format)),
    };
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
            let mut given = Vec::new();
            for (number, id) in (0..).zip(ids) {
                given.push((number, Descriptor::Sampled(context.image(id)?.1, context.layout(id))));
            }
            let set = inputs.descriptors.set(&inputs.shaders.surface_set, &given)?;
            draw_fullscreen(context, &pipeline, layout, set, bytemuck::bytes_of(&constants));
            Ok(())
        }));
    Ok(exported)
}
