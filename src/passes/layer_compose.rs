//! A transparent layer from sums to light, put under the layers before it.

use super::{
    accumulate::Sums,
    finalize::{constants, shown_constants},
    fullscreen::bind_fullscreen,
    layers::Layer,
    pipelines::{GraphicsKey, Layout},
    sum_format,
};
use crate::{
    error::Result,
    graph::{Access, ClearValue, Graph, Handle, Image, Start, execute::Body},
    scene::Settings,
    shaders,
    vk::Blend,
};

/// What a layer is made of.
pub(super) enum LayerSums {
    /// One surface: the sums of its splats and of its polygons, one at least.
    Surface(Option<Sums>, Option<Sums>),
    /// All that is left; and the sums of the layer before, where their weights count surfaces.
    Rest(Sums, Option<(Option<Sums>, Option<Sums>)>),
}

/// What kind of sums there are, for the pipeline alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LayerKind {
    Splats,
    Polygons,
    Hybrid,
    Rest,
    /// With the alpha of several surfaces; behind a layer of splats, of polygons, of both.
    StackBehindSplats,
    StackBehindPolygons,
    StackBehindHybrid,
}

/// What its pipeline is. `lights`: the scene's own.
pub(super) fn key(settings: &Settings, kind: LayerKind, lights: u32) -> GraphicsKey {
    let fragment = match (kind, lights > 0) {
        (LayerKind::Splats, false) => &shaders::LAYER_SPLATS_FRAG,
        (LayerKind::Polygons, false) => &shaders::LAYER_POLYGONS_FRAG,
        (LayerKind::Hybrid, false) => &shaders::LAYER_HYBRID_FRAG,
        (LayerKind::Splats, true) => &shaders::LAYER_SPLATS_LIT_FRAG,
        (LayerKind::Polygons, true) => &shaders::LAYER_POLYGONS_LIT_FRAG,
        (LayerKind::Hybrid, true) => &shaders::LAYER_HYBRID_LIT_FRAG,
        // Lit already.
        (LayerKind::Rest, _) => &shaders::LAYER_BLENDED_FRAG,
        (LayerKind::StackBehindSplats, _) => &shaders::LAYER_BLENDED_STACKED_BEFORE_SPLATS_FRAG,
        (LayerKind::StackBehindPolygons, _) => &shaders::LAYER_BLENDED_STACKED_BEFORE_POLYGONS_FRAG,
        (LayerKind::StackBehindHybrid, _) => &shaders::LAYER_BLENDED_STACKED_BEFORE_HYBRID_FRAG,
    };
    let hybrid = kind == LayerKind::Hybrid;
    let is_surface = matches!(kind, LayerKind::Splats | LayerKind::Polygons | LayerKind::Hybrid);
    let lights = if is_surface { lights } else { 0 };
    GraphicsKey {
        color_formats: vec![sum_format(settings.accumulate)],
        blend: Blend::Under,
        ..GraphicsKey::fullscreen(fragment, Layout::Finalize, shown_constants(settings, hybrid, lights))
    }
}

/// The pipeline's kind, and the images that it reads, by their bindings.
fn images_of(sums: &LayerSums) -> (LayerKind, Vec<(u32, &Handle<Image>)>) {
    fn both(sums: &Sums, first: u32) -> [(u32, &Handle<Image>); 2] {
        [(first, &sums.color), (first + 1, &sums.normal)]
    }
    match sums {
        LayerSums::Surface(splats, polygons) => {
            let kind = match (splats.is_some(), polygons.is_some()) {
                (true, true) => LayerKind::Hybrid,
                (false, true) => LayerKind::Polygons,
                _ => LayerKind::Splats,
            };
            let splats = splats.iter().flat_map(|sums| both(sums, 0));
            (kind, splats.chain(polygons.iter().flat_map(|sums| both(sums, 2))).collect())
        }
        LayerSums::Rest(sums, before) => {
            let (splats, polygons) = before.as_ref().map_or((None, None), |(a, b)| (a.as_ref(), b.as_ref()));
            let kind = match (splats.is_some(), polygons.is_some()) {
                (true, true) => LayerKind::StackBehindHybrid,
                (true, false) => LayerKind::StackBehindSplats,
                (false, true) => LayerKind::StackBehindPolygons,
                (false, false) => LayerKind::Rest,
            };
            let weights = splats.map(|sums| (2, &sums.color)).into_iter();
            let weights = weights.chain(polygons.map(|sums| (3, &sums.color)));
            (kind, both(sums, 0).into_iter().chain(weights).collect())
        }
    }
}

/// Declares the pass. `composed`: the layers before; `None` for the first.
pub(super) fn layer_compose<'a>(
    graph: &mut Graph<Body<'a>>,
    layer: &Layer<'a, '_>,
    sums: &LayerSums,
    composed: Option<Handle<Image>>,
) -> Result<Handle<Image>> {
    let inputs = layer.inputs;
    let settings = inputs.settings;
    let (kind, images) = images_of(sums);
    let pipeline = inputs.shaders.graphics(key(settings, kind, inputs.lights))?;
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
    let lights = layer.lights.filter(|_| matches!(sums, LayerSums::Surface(..)));
    if let Some(lights) = lights {
        pass = pass.read(lights, Access::UniformReadFragment);
    }
    let lights = lights.map(Handle::id);
    let ids: Vec<_> = images.iter().map(|(binding, image)| (*binding, image.id())).collect();
    let (gate, query) = (layer.gate(), layer.query());
    let pass = layer.read_gate(pass);
    pass.finish(Box::new(move |context| {
        let layout = &inputs.shaders.finalize_layout;
        bind_fullscreen(context, inputs, &pipeline, layout, (&ids, lights), bytemuck::bytes_of(&push))?;
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
