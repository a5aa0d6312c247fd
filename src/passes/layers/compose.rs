//! A transparent layer from sums to light, put under the layers before it.

use crate::passes::pipeline::formats::sum_format;
use crate::passes::{
    layers::layer::Layer,
    pipeline::{
        cache::{GraphicsKey, Layout},
        fullscreen::bind_fullscreen,
    },
    resolve::finalize::{constants, resolve_constants},
    splats::accumulate::Sums,
};
use crate::{
    error::Result,
    graph::{Access, ClearValue, Graph, Handle, Image, Start, execute::Body},
    scene::Settings,
    shaders::{self, config::*},
    vk::Blend,
};

/// What a layer is made of.
#[derive(Default)]
pub(crate) struct LayerSums {
    /// Of the last layer, where that is all that is left. Then the others are those of the layer before, if their weights count
    /// surfaces.
    pub rest: Option<Sums>,
    /// The surface's splats.
    pub splats: Option<Sums>,
    /// Its polygons.
    pub polygons: Option<Sums>,
}

/// What its pipeline is. `rest`: of the last layer, else of a surface; of what: splats, polygons or both (of the last one: the layer
/// before, where that counts surfaces). `lights`: the scene's own.
pub(crate) fn key(
    settings: &Settings,
    rest: bool,
    [splats, polygons]: [bool; 2],
    lights: u32,
) -> GraphicsKey {
    let fragment = if rest { &shaders::LAYER_REST_FRAG } else { &shaders::LAYER_FRAG };
    // The last one is lit already.
    let lights = if rest { 0 } else { lights };
    let constants = resolve_constants(settings, splats, polygons, lights);
    GraphicsKey {
        color_formats: vec![sum_format(settings.accumulate)],
        blend: Blend::Under,
        ..GraphicsKey::fullscreen(fragment, Layout::Finalize, constants)
    }
}

/// The images that it reads, by their bindings.
fn images_of(sums: &LayerSums) -> Vec<(u32, &Handle<Image>)> {
    let LayerSums { rest, splats, polygons } = sums;
    let mut images = Vec::new();
    if let Some(rest) = rest {
        images.extend([(BIND_SUMS_COLORS, &rest.color), (BIND_SUMS_NORMALS, &rest.normal)]);
        images.extend(splats.iter().map(|sums| (BIND_SUMS_SPLATS_BEFORE, &sums.color)));
        images.extend(polygons.iter().map(|sums| (BIND_SUMS_POLYGONS_BEFORE, &sums.color)));
        return images;
    }
    if let Some(sums) = splats {
        images.extend([(BIND_SUMS_COLORS, &sums.color), (BIND_SUMS_NORMALS, &sums.normal)]);
    }
    if let Some(sums) = polygons {
        images.extend([(BIND_SUMS_POLYGON_COLORS, &sums.color), (BIND_SUMS_POLYGON_NORMALS, &sums.normal)]);
    }
    images
}

/// Declares the pass. `composed`: the layers before; `None` for the first.
pub(crate) fn layer_compose<'a>(
    graph: &mut Graph<Body<'a>>,
    layer: &Layer<'a, '_>,
    sums: &LayerSums,
    composed: Option<Handle<Image>>,
) -> Result<Handle<Image>> {
    let inputs = layer.inputs;
    let settings = inputs.settings;
    let images = images_of(sums);
    let of = [sums.splats.is_some(), sums.polygons.is_some()];
    let pipeline = inputs.shaders.graphics(key(settings, sums.rest.is_some(), of, inputs.lights))?;
    let push = constants(inputs);
    let (mut target, start) = match composed {
        Some(composed) => (composed, Start::Load),
        None => {
            let image = graph.create_image("layers", inputs.image(sum_format(settings.accumulate)));
            (image, Start::Clear(ClearValue::Color([0.0; 4])))
        }
    };
    let mut pass = graph.pass(&layer.name("compose")).write(&mut target, Access::ColorAttachment, start);
    for (_, image) in &images {
        pass = pass.read(image, Access::SampledFragment);
    }
    let lights = layer.lights.filter(|_| sums.rest.is_none());
    if let Some(lights) = lights {
        pass = pass.read(lights, Access::UniformReadFragment);
    }
    let lights = lights.map(Handle::id);
    let ids: Vec<_> = images.iter().map(|(binding, image)| (*binding, image.id())).collect();
    let (gate, query) = (layer.gate(), layer.query());
    let pass = layer.read_gate(pass);
    pass.finish(Box::new(move |context| {
        bind_fullscreen(context, inputs, &pipeline, (&ids, lights), &push)?;
        let (device, commands) = (context.device(), context.commands());
        // SAFETY: inside of rendering, with all bound; the query was reset at the frame's begin, and begins once.
        unsafe {
            query.inspect(|(queries, index)| queries.begin(commands, *index));
            let drawn = match gate {
                None => {
                    device.cmd_draw(commands, 3, 1, 0, 0);
                    Ok(())
                }
                Some(gate) => gate.draw_fullscreen(context),
            };
            query.inspect(|(queries, index)| queries.end(commands, *index));
            drawn
        }
    }));
    Ok(target)
}
