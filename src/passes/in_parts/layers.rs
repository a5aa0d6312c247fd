//! A transparent layer of a frame in parts, by the graphics pipeline. Peeling (Guennebaud, Barthe, Paulin 2006, section 6; `glsl/inc/peel.glsl`) asks of other
//! parts what opaque things ask: the depth of a layer is the largest of all parts', what is in it is decided by that and by the depth of the layer before, and its
//! sums are added. The last layer has no depth, and its sums are added, too.

use super::{PART_SUM_FORMAT, upload::upload};
use crate::passes::{
    cull::lists::Lists,
    inputs::Inputs,
    layers::{
        accumulate::layer_accumulate,
        compose::{LayerSums, layer_compose},
        layer::Layer,
        rest::layer_rest,
        visibility::layer_visibility,
    },
    pipeline::formats::DEPTH_FORMAT,
    plan::FramePlan,
    resolve,
    splats::{self, accumulate::Sums},
};
use crate::{
    error::Result,
    graph::{Buffer, Graph, Handle, Image, execute::Body},
};
use ash::vk;

/// The format of the sum of weights of the last layer.
pub(crate) const PART_WEIGHT_FORMAT: vk::Format = vk::Format::R32_SFLOAT;

/// What lies around a layer, of all parts: depths as [`super::see`] and [`see_layer`] leave them.
#[derive(Clone, Copy)]
pub(crate) struct Around<'h> {
    /// The depth of opaque things, where there are any.
    pub opaque: Option<&'h Handle<Buffer>>,
    /// That of the layer before; none for the first.
    pub before: Option<&'h Handle<Buffer>>,
}

/// What all parts left to the host of a layer.
pub(crate) enum LayerOfAll<'h> {
    /// Its sums: colors and weights, normals and alphas.
    Surface([&'h Handle<Buffer>; 2]),
    /// Of the last one: lit colors with weights times alpha, and weights; the colors of the layer before, where its weights count surfaces.
    Rest([&'h Handle<Buffer>; 2], Option<&'h Handle<Buffer>>),
}

/// Declares the stage that sees a layer; gives its depth in this part, at least that of opaque things.
pub(crate) fn see_layer<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    plan: &'a FramePlan<'a>,
    around: Around<'_>,
) -> Result<Handle<Image>> {
    in_layer(graph, inputs, plan, around, layer_visibility)
}

/// Declares the stage that sums what is in a layer of this depth, that of all parts.
pub(crate) fn sum_layer<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    plan: &'a FramePlan<'a>,
    around: Around<'_>,
    of_all: &Handle<Buffer>,
) -> Result<[Handle<Image>; 2]> {
    in_layer(graph, inputs, plan, around, |graph, layer| {
        let depth = upload(graph, layer.inputs, "depth", of_all, DEPTH_FORMAT);
        let Sums { color, normal } = layer_accumulate(graph, layer, &depth)?;
        Ok([color, normal])
    })
}

/// Declares the stage that sums all that is behind the layer before.
pub(crate) fn sum_rest<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    plan: &'a FramePlan<'a>,
    around: Around<'_>,
) -> Result<[Handle<Image>; 2]> {
    in_layer(graph, inputs, plan, around, |graph, layer| {
        let Sums { color, normal } = layer_rest(graph, layer)?;
        Ok([color, normal])
    })
}

/// Declares the stage that shades a layer and puts it under those before it, as the host has them; none before the first.
pub(crate) fn compose<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    plan: &'a FramePlan<'a>,
    of_all: LayerOfAll<'_>,
    composed: Option<&Handle<Buffer>>,
) -> Result<Handle<Image>> {
    let around = Around { opaque: None, before: None };
    in_layer(graph, inputs, plan, around, |graph, layer| {
        let mut uploaded = |name, from, format| upload(graph, layer.inputs, name, from, format);
        let sums = match of_all {
            LayerOfAll::Surface([color, normal]) => LayerSums {
                splats: Some(Sums {
                    color: uploaded("color sums", color, PART_SUM_FORMAT),
                    normal: uploaded("normal sums", normal, PART_SUM_FORMAT),
                }),
                ..LayerSums::default()
            },
            LayerOfAll::Rest([color, weight], before) => LayerSums {
                rest: Some(Sums {
                    color: uploaded("color sums", color, PART_SUM_FORMAT),
                    normal: uploaded("weight sums", weight, PART_WEIGHT_FORMAT),
                }),
                splats: before.map(|color| {
                    let [color, normal] = ["color sums before", "normal sums before"]
                        .map(|name| uploaded(name, color, PART_SUM_FORMAT));
                    Sums { color, normal }
                }),
                polygons: None,
            },
        };
        let composed = composed.map(|from| uploaded("layers", from, PART_SUM_FORMAT));
        layer_compose(graph, layer, &sums, composed)
    })
}

/// Declares what passes of a layer share, and them.
fn in_layer<'a, T>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    plan: &'a FramePlan<'a>,
    around: Around<'_>,
    passes: impl FnOnce(&mut Graph<'a, Body<'a>>, &Layer<'a, '_>) -> Result<T>,
) -> Result<T> {
    let lights = resolve::lights::lights(graph, inputs.source, plan.lights);
    let inputs = Inputs { lights: plan.lights.len() as u32, ..inputs }.of(&plan.transparent);
    let kernel = splats::accumulate::kernel_of(graph, inputs)?;
    let lists = Lists::make(graph, inputs, "transparent ")?;
    let [opaque, before] =
        [("depth of opaque things", around.opaque), ("depth of the layer before", around.before)]
            .map(|(name, from)| from.map(|from| upload(graph, inputs, name, from, DEPTH_FORMAT)));
    let layer = Layer {
        arena: graph.arena(),
        inputs,
        number: 0,
        before: before.as_ref(),
        opaque: opaque.as_ref(),
        kernel: kernel.as_ref(),
        lights: lights.as_ref(),
        lists: &lists,
        predicates: None,
        counted: false,
    };
    passes(graph, &layer)
}
