//! Transparency in any order: depth peeling of splatted surfaces (Guennebaud, Barthe, Paulin 2006, section 6).
//!
//! Each layer is one surface a pixel, the nearest behind the layer before: visibility, accumulation, and normalization with
//! shading, which composes from front to back. The paper keeps the layers and composes from back to front, which is the
//! same; but so the memory does not grow with their number: two depths, one pair of sums and the composed light are
//! enough for any, and the graph lets them share what it can.

use super::{
    Inputs,
    gate::{Gate, Gates},
    layer_accumulate::{layer_accumulate, layer_polygons},
    layer_compose::{LayerSums, layer_compose},
    layer_rest::layer_rest,
    layer_visibility::layer_visibility,
    lists::{ListIds, Lists},
};
use crate::{
    error::Result,
    graph::{Buffer, Graph, Handle, Image, PassBuilder, execute::Body},
    scene::{LastLayer, Layers, Settings},
    vk::Occlusion,
};

/// What the passes of one layer share.
pub(super) struct Layer<'a, 'f> {
    /// The transparent part.
    pub inputs: Inputs<'a>,
    /// From 0 on.
    number: u32,
    /// The depth of the layer before; none for the first.
    pub before: Option<&'f Handle<Image>>,
    /// The depth of opaque things, where there are any.
    pub opaque: Option<&'f Handle<Image>>,
    /// The kernel, where it is a texture.
    pub kernel: Option<&'f Handle<Image>>,
    /// Those of the scene's own.
    pub lights: Option<&'f Handle<Buffer>>,
    lists: &'f Lists,
    gates: Option<&'f Gates<'a>>,
    /// Another layer follows, and wants to know whether this one is empty.
    counted: bool,
}

impl<'a> Layer<'a, '_> {
    /// The name of one of its passes or images.
    pub fn name(&self, what: &str) -> String {
        format!("{what} of layer {}", self.number + 1)
    }

    /// Declares that a pass draws its splats and polygons.
    pub fn read<'g, B>(&self, pass: PassBuilder<'g, B>) -> PassBuilder<'g, B> {
        let pass = match self.before {
            Some(before) => pass.read(before, crate::graph::Access::SampledFragment),
            None => pass,
        };
        self.read_gate(self.lists.read(pass))
    }

    /// Declares that a pass draws something where the layer before is not empty.
    pub fn read_gate<'g, B>(&self, pass: PassBuilder<'g, B>) -> PassBuilder<'g, B> {
        match self.gates {
            Some(gates) => gates.read(pass),
            None => pass,
        }
    }

    /// What its draws depend on.
    pub fn gate(&self) -> Option<Gate> {
        self.gates.and_then(Gates::gate)
    }

    /// What its draws read beside splats.
    pub fn list_ids(&self) -> ListIds {
        self.lists.ids()
    }

    /// The query that counts its pixels.
    pub fn query(&self) -> Option<(&'a Occlusion, u32)> {
        self.gates.filter(|_| self.counted).map(|gates| (gates.queries(), self.number))
    }
}

/// How many queries the layers of these settings need, on a device that can make use of them.
pub(super) fn queries_needed(settings: &Settings) -> u32 {
    match settings.layers {
        Layers::Fixed(_) => 0,
        Layers::Auto(most) => most - 1,
    }
}

/// Declares the passes of all layers; returns what they add up to: linear light times alpha, and alpha. `opaque`: the depth
/// of opaque things.
pub(super) fn layers<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    opaque: Option<&Handle<Image>>,
    kernel: Option<&Handle<Image>>,
    lights: Option<&Handle<Buffer>>,
) -> Result<Option<Handle<Image>>> {
    let lists = Lists::make(graph, inputs, "transparent ")?;
    let mut gates = inputs.occlusion.map(|queries| Gates::new(graph, inputs, queries));
    let count = inputs.settings.layers.most();
    let (mut before, mut sums_before, mut composed) = (None, None, None);
    for number in 0..count {
        let counted = number + 1 < count;
        let layer = Layer {
            inputs,
            number,
            before: before.as_ref(),
            opaque,
            kernel,
            lights,
            lists: &lists,
            gates: gates.as_ref(),
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
        if let Some(gates) = gates.as_mut().filter(|_| counted) {
            gates.count(graph, number);
        }
    }
    Ok(composed)
}
