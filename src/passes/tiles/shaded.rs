//! Visibility, accumulation and shading of the listed splats in one dispatch, a tile at a time: tiles leave what they show. Those with
//! more splats than one dispatch takes do so after it.

use super::{
    super::Inputs,
    COLOR_SUMS, LIGHTS, POLYGON_DEPTH, SEEN_ARGUMENTS, TilePass, Tiles,
    shade::shade_overfull,
    splat::{Step, TileStart, shader},
};
use crate::{
    error::Result,
    graph::{Access, Buffer, Graph, Handle, Image, execute::Body},
    scene::Accumulate,
};

/// What tiles show, in place of sums.
pub(in super::super) struct Shown {
    pub image: Handle<Image>,
    /// The image's.
    pub precision: Accumulate,
}

/// Declares all of it, shading too. `polygons`: their depth, as if there were no splats; `kind`, `start`: as in
/// [`super::fused`].
pub(in super::super) fn shaded<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    tiles: &mut Tiles<'a>,
    shown: &mut Shown,
    (polygons, lights): (Option<&Handle<Image>>, Option<&Handle<Buffer>>),
    start: TileStart,
) -> Result<()> {
    // Beside polygons more than what visibility lets through may count (`--transition paper`).
    let (precision, hidden) = (shown.precision, tiles.plan.hidden && polygons.is_none());
    let step = Step::Shaded { precision, beside: polygons.is_some(), lights: inputs.lights, hidden };
    let shader = shader(inputs.settings, tiles.plan, step)?;
    let mut shaded = TilePass::new(inputs, tiles.plan, shader, Vec::new())?;
    tiles.bind_lists(&mut shaded, hidden);
    shaded.storage_images = vec![(COLOR_SUMS, shown.image.id())];
    shaded.buffers.extend(lights.map(|lights| (LIGHTS, lights.id())));
    let arguments = tiles.arguments.id();
    let (access, content) = start.access();
    let pass = graph.pass(&format!("see, sum and shade {kind}tiles"));
    let mut pass = if hidden { tiles.shorten_lists(pass) } else { tiles.read_lists(pass) };
    if let Some(lights) = lights {
        pass = pass.read(lights, Access::UniformReadCompute);
    }
    if let Some(polygons) = polygons {
        shaded.sampled_images = vec![(POLYGON_DEPTH, polygons.id())];
        pass = pass.read(polygons, Access::SampledCompute);
    }
    pass.write(&mut shown.image, access, content)
        .finish(Box::new(move |context| shaded.dispatch_indirect(context, arguments, SEEN_ARGUMENTS)));
    shade_overfull(graph, inputs, kind, tiles, shown, lights)
}
