//! Transparency in any order: depth peeling of splatted surfaces (Guennebaud, Barthe, Paulin 2006, section 6).
//!
//! Each layer is one surface a pixel, the nearest behind the layer before: visibility, accumulation, and normalization with
//! shading, which composes from front to back. The paper keeps the layers and composes from back to front, which is the
//! same; but so the memory does not grow with their number: two depths, one pair of sums and the composed light are
//! enough for any, and the graph lets them share what it can.

use crate::passes::layers::layer::Layer;
use crate::passes::{
    cull::lists::Lists,
    inputs::Inputs,
    layers::{
        accumulate::{layer_accumulate, layer_polygons},
        compose::{LayerSums, layer_compose},
        rest::layer_rest,
        visibility::layer_visibility,
    },
    predicate::LayerPredicates,
};
use crate::{
    error::Result,
    graph::{Buffer, Graph, Handle, Image, execute::Body},
    scene::LastLayer,
};

/// Declares the passes of all layers; returns what they add up to: linear light times alpha, and alpha. `opaque`: the depth
/// of opaque things.
pub(crate) fn layers<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    opaque: Option<&Handle<Image>>,
    kernel: Option<&Handle<Image>>,
    lights: Option<&Handle<Buffer>>,
) -> Result<Option<Handle<Image>>> {
    let lists = Lists::make(graph, inputs, "transparent ")?;
    let mut predicates = inputs.occlusion.map(|queries| LayerPredicates::new(graph, inputs, queries));
    let count = inputs.settings.layers.most();
    let (mut before, mut sums_before, mut composed) = (None, None, None);
    for number in 0..count {
        let counted = number + 1 < count;
        let layer = Layer {
            arena: graph.arena(),
            inputs,
            number,
            before: before.as_ref(),
            opaque,
            kernel,
            lights,
            lists: &lists,
            predicates: predicates.as_ref(),
            counted,
        };
        let (depth, sums) = if inputs.settings.last_layer != LastLayer::Drop && !counted {
            let stacks = inputs.settings.last_layer == LastLayer::Stack;
            let before = sums_before.take().filter(|_| stacks).unwrap_or_default();
            (None, LayerSums { rest: Some(layer_rest(graph, &layer)?), ..before })
        } else {
            let depth = layer_visibility(graph, &layer)?;
            let splats = match inputs.draws.is_empty() {
                true => None,
                false => Some(layer_accumulate(graph, &layer, &depth)?),
            };
            let polygons = match inputs.meshes.is_empty() {
                true => None,
                false => Some(layer_polygons(graph, &layer, &depth)?),
            };
            (Some(depth), LayerSums { rest: None, splats, polygons })
        };
        composed = Some(layer_compose(graph, &layer, &sums, composed)?);
        (before, sums_before) = (depth, Some(sums));
        if let Some(predicates) = predicates.as_mut().filter(|_| counted) {
            predicates.count(graph, inputs, number);
        }
    }
    Ok(composed)
}
