//! A transparent layer from sums to light, put under the layers before it.

use crate::passes::pipeline::formats::sum_format;
use crate::passes::{
    layers::layer::Layer,
    pipeline::{
        key::{GraphicsKey, Layout},
        variant::resolve_constants,
    },
    place::sums,
    predicate::{self, is_predicated},
    resolve::fullscreen::bind_fullscreen,
    splats::accumulate::Sums,
};
use crate::{
    error::Result,
    graph::{Access, ClearValue, Graph, Handle, Image, Role, Start, execute::Body},
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
fn key(settings: &Settings, rest: bool, [splats, polygons]: [bool; 2], lights: u32) -> GraphicsKey {
    let fragment = if rest { &shaders::LAYER_REST_FRAG } else { &shaders::LAYER_FRAG };
    // The last one is lit already.
    let lights = if rest { 0 } else { lights };
    let constants = resolve_constants(settings, splats, polygons, lights);
    GraphicsKey {
        color_formats: [sum_format(settings.accumulate)].into(),
        blend: Blend::Under,
        ..GraphicsKey::fullscreen(fragment, Layout::Finalize, constants)
    }
}

/// The images that it reads, and where.
fn images_of(sums: &LayerSums) -> [Option<(u32, &Handle<Image>)>; 4] {
    let LayerSums { rest, splats, polygons } = sums;
    match rest {
        Some(rest) => [
            Some((BIND_SUMS_COLORS, &rest.color)),
            Some((BIND_SUMS_NORMALS, &rest.normal)),
            splats.as_ref().map(|sums| (BIND_SUMS_SPLATS_BEFORE, &sums.color)),
            polygons.as_ref().map(|sums| (BIND_SUMS_POLYGONS_BEFORE, &sums.color)),
        ],
        None => [
            splats.as_ref().map(|sums| (BIND_SUMS_COLORS, &sums.color)),
            splats.as_ref().map(|sums| (BIND_SUMS_NORMALS, &sums.normal)),
            polygons.as_ref().map(|sums| (BIND_SUMS_POLYGON_COLORS, &sums.color)),
            polygons.as_ref().map(|sums| (BIND_SUMS_POLYGON_NORMALS, &sums.normal)),
        ],
    }
}

/// Declares the pass. `composed`: the layers before; `None` for the first.
pub(crate) fn layer_compose<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    layer: &Layer<'a, '_>,
    layer_sums: &LayerSums,
    composed: Option<Handle<Image>>,
) -> Result<Handle<Image>> {
    let inputs = layer.inputs;
    let settings = inputs.settings;
    let of = [layer_sums.splats.is_some(), layer_sums.polygons.is_some()];
    let (mut target, start) = match composed {
        Some(composed) => (composed, Start::Load),
        None => {
            let image = graph.create_image("layers", inputs.image(sum_format(settings.accumulate)));
            (image, Start::Clear(ClearValue::Color([0.0; 4])))
        }
    };
    let why = "transparent things: shades the layer, under those before";
    let lights = layer.lights.filter(|_| layer_sums.rest.is_none());
    let mut pass = layer
        .pass(graph, "compose", why)
        .role(Role::Blends)
        .attach(&mut target, Access::ColorAttachment, start)
        .read_if(sums(BIND_SUMS_LIGHTS), lights, Access::UniformReadFragment);
    for (binding, image) in images_of(layer_sums).into_iter().flatten() {
        pass = pass.read(sums(binding), image, Access::SampledFragment);
    }
    let pipeline = pass.graphics(key(settings, layer_sums.rest.is_some(), of, inputs.lights))?;
    let (push, query) = (inputs.finalize_constants(), layer.query());
    pass.finish(move |pass| {
        bind_fullscreen(pass, pipeline, &push)?;
        // SAFETY: inside of rendering; the query was reset at the frame's begin, and begins once.
        query.inspect(|(queries, index)| unsafe { queries.begin(pass.commands(), *index) });
        let drawn = match is_predicated(pass) {
            true => predicate::draw_fullscreen(pass),
            false => {
                pass.draw([3, 1]);
                Ok(())
            }
        };
        // SAFETY: it began above, in the same pass.
        query.inspect(|(queries, index)| unsafe { queries.end(pass.commands(), *index) });
        drawn
    });
    Ok(target)
}
