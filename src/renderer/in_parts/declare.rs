//! The graphs of the stages: passes, what they read of the host and what they leave to it.

use ash::vk;

use super::{Around, PartLayer, Stage};
use crate::{
    arena::Arena,
    error::Result,
    graph::{
        Buffer, BufferDesc, BufferState, Graph, Handle, ImageDesc,
        execute::{Body, Physical},
    },
    passes::{
        FramePlan, Inputs,
        in_parts::{
            self, OfAll, PART_DEPTH_FORMAT, PART_SUM_FORMAT,
            layers::{self, LayerOfAll, PART_WEIGHT_FORMAT},
        },
    },
    renderer::declare::{Imports, bytes_per_pixel, copy_out, copy_surface},
};

/// The graph of a stage.
pub(super) fn declare<'a>(
    arena: &'a Arena,
    inputs: Inputs<'a>,
    plan: &'a FramePlan<'a>,
    stage: Stage<'_>,
) -> Result<(Graph<'a, Body<'a>>, Imports<'a>)> {
    let (mut graph, mut imports) = (Graph::new(arena), arena.growing());
    match stage {
        Stage::See { depth } => {
            let seen = in_parts::see(&mut graph, inputs, plan)?;
            copy_out(&mut graph, &mut imports, inputs, ("depth", &seen, PART_DEPTH_FORMAT), depth);
        }
        Stage::Sum { depth, sums, with_depth } => {
            let depth =
                import(&mut graph, &mut imports, inputs, ("depth of all parts", PART_DEPTH_FORMAT, depth));
            let summed = in_parts::sum(&mut graph, inputs, plan, &depth, with_depth)?;
            for ((what, image), buffer) in ["colors", "normals"].into_iter().zip(&summed).zip(sums) {
                copy_out(&mut graph, &mut imports, inputs, (what, image, PART_SUM_FORMAT), buffer);
            }
        }
        Stage::SeeLayer { around, depth } => {
            let around = around.import(&mut graph, &mut imports, inputs);
            let seen = layers::see_layer(&mut graph, inputs, plan, borrowed(&around))?;
            copy_out(&mut graph, &mut imports, inputs, ("depth", &seen, PART_DEPTH_FORMAT), depth);
        }
        Stage::SumLayer { around, depth, sums } => {
            let around = around.import(&mut graph, &mut imports, inputs);
            let depth =
                import(&mut graph, &mut imports, inputs, ("depth of all parts", PART_DEPTH_FORMAT, depth));
            let summed = layers::sum_layer(&mut graph, inputs, plan, borrowed(&around), &depth)?;
            for ((what, image), buffer) in ["colors", "normals"].into_iter().zip(&summed).zip(sums) {
                copy_out(&mut graph, &mut imports, inputs, (what, image, PART_SUM_FORMAT), buffer);
            }
        }
        Stage::SumRest { around, sums } => {
            let around = around.import(&mut graph, &mut imports, inputs);
            let [color, weight] = layers::sum_rest(&mut graph, inputs, plan, borrowed(&around))?;
            let of = [("colors", &color, PART_SUM_FORMAT), ("weights", &weight, PART_WEIGHT_FORMAT)];
            for (what, buffer) in of.into_iter().zip(sums) {
                copy_out(&mut graph, &mut imports, inputs, what, buffer);
            }
        }
        Stage::Compose { layer, before, composed } => {
            let mut of =
                |what, format, buffer| import(&mut graph, &mut imports, inputs, (what, format, buffer));
            let before = before.map(|buffer| of("layers before of all parts", PART_SUM_FORMAT, buffer));
            let image = match layer {
                PartLayer::Surface([color, normal]) => {
                    let color = of("colors of all parts", PART_SUM_FORMAT, color);
                    let normal = of("normals of all parts", PART_SUM_FORMAT, normal);
                    let of_all = LayerOfAll::Surface([&color, &normal]);
                    layers::compose(&mut graph, inputs, plan, of_all, before.as_ref())?
                }
                PartLayer::Rest([color, weight], colors_before) => {
                    let color = of("colors of all parts", PART_SUM_FORMAT, color);
                    let weight = of("weights of all parts", PART_WEIGHT_FORMAT, weight);
                    let colors_before =
                        colors_before.map(|buffer| of("colors of the layer before", PART_SUM_FORMAT, buffer));
                    let of_all = LayerOfAll::Rest([&color, &weight], colors_before.as_ref());
                    layers::compose(&mut graph, inputs, plan, of_all, before.as_ref())?
                }
            };
            copy_out(&mut graph, &mut imports, inputs, ("layers", &image, PART_SUM_FORMAT), composed);
        }
        Stage::Shade { depth, sums: [color, normal], layers, target, readbacks } => {
            let mut of =
                |what, format, buffer| import(&mut graph, &mut imports, inputs, (what, format, buffer));
            let depth = of("depth of all parts", PART_DEPTH_FORMAT, depth);
            let color = of("colors of all parts", PART_SUM_FORMAT, color);
            let normal = of("normals of all parts", PART_SUM_FORMAT, normal);
            let layers = layers.map(|buffer| of("layers of all parts", PART_SUM_FORMAT, buffer));
            let of_all = OfAll { depth: &depth, sums: [&color, &normal], layers: layers.as_ref() };
            let desc = ImageDesc { format: target.format, extent: target.extent };
            let mut image = graph.import_image("target", desc, target.initial, target.last);
            imports.push((image.id(), Physical::Image(target.image, target.view)));
            let into = (&mut image, target.format);
            let exported =
                in_parts::shade(&mut graph, inputs, plan, of_all, into, readbacks.surface.is_some())?;
            if let Some(buffer) = readbacks.target {
                copy_out(&mut graph, &mut imports, inputs, ("target", &image, target.format), buffer);
            }
            copy_surface(&mut graph, &mut imports, inputs, exported.as_ref(), readbacks.surface);
        }
    }
    Ok((graph, imports))
}

impl Around {
    /// Its buffers in a graph: the opaque depth, and that of the layer before.
    fn import(
        self,
        graph: &mut Graph<'_, Body<'_>>,
        imports: &mut Imports<'_>,
        inputs: Inputs<'_>,
    ) -> [Option<Handle<Buffer>>; 2] {
        [("opaque depth of all parts", self.opaque), ("depth before of all parts", self.before)].map(
            |(what, buffer)| {
                buffer.map(|buffer| import(graph, imports, inputs, (what, PART_DEPTH_FORMAT, buffer)))
            },
        )
    }
}

fn borrowed([opaque, before]: &[Option<Handle<Buffer>>; 2]) -> layers::Around<'_> {
    layers::Around { opaque: opaque.as_ref(), before: before.as_ref() }
}

/// A buffer that the host has filled.
fn import(
    graph: &mut Graph<'_, Body<'_>>,
    imports: &mut Imports<'_>,
    inputs: Inputs<'_>,
    (what, format, buffer): (&str, vk::Format, vk::Buffer),
) -> Handle<Buffer> {
    let [width, height] = inputs.settings.size_px.map(u64::from);
    let desc = BufferDesc::of_bytes(width * height * bytes_per_pixel(format));
    let handle = graph.import_buffer(what, desc, BufferState::default(), None);
    imports.push((handle.id(), Physical::Buffer(buffer)));
    handle
}
