//! Tiles with more splats than one dispatch takes, where tiles are shaded: seen and summed in parts, in images of such tiles alone,
//! then shaded from these. There can't be many, and most frames have none.

use super::{
    super::{Inputs, finalize::shown_constants, splat_shaders::find, variant::Constants},
    COLOR_SUMS, LIGHTS, NORMAL_SUMS, OVERFULL_ARGUMENTS, Shown, TileImages, TilePass, TilePlan, Tiles,
    VISIBLE_DEPTH,
    splat::{Step, TileStart, bits, in_parts},
};
use crate::{
    error::Result,
    graph::{Access, Buffer, Graph, Handle, execute::Body},
    scene::{Accumulate, Settings},
    shaders::Shader,
};

/// The binding of what tiles show: this pass has no depth.
const SHOWN: u32 = VISIBLE_DEPTH;

/// The shader, and its constants.
fn shader(
    settings: &Settings,
    plan: &TilePlan,
    precision: Accumulate,
    lights: u32,
) -> Result<(&'static Shader, Constants)> {
    let lit = if lights > 0 { "_lit" } else { "" };
    let short = if plan.invocations.tile_height() == 4 { "_short" } else { "" };
    let shader = find(&format!("tile_shade_{}{lit}{short}.comp", bits(precision)))?;
    Ok((shader, shown_constants(settings, false, lights)))
}

/// Declares the passes; none where no tile can be overfull. `kind`: as in [`super::fused`].
pub(super) fn shade_overfull<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    tiles: &Tiles<'a>,
    shown: &mut Shown,
    lights: Option<&Handle<Buffer>>,
) -> Result<()> {
    let plan = tiles.plan;
    if !plan.may_be_overfull() {
        return Ok(());
    }
    let mut images = TileImages::of_overfull(graph, kind, plan);
    in_parts(graph, inputs, kind, tiles, &mut images, None, (Step::Visible { upon: false }, None))?;
    let summed = Step::Summed { beside: false, with_depth: false };
    in_parts(graph, inputs, kind, tiles, &mut images, None, (summed, None))?;

    let shader = shader(inputs.settings, plan, shown.precision, inputs.lights)?;
    let mut shade = TilePass::new(inputs, plan, shader, Vec::new())?;
    tiles.bind_lists(&mut shade, false);
    let (color, normal) = (&images.sums.color, &images.sums.normal);
    shade.storage_images =
        vec![(COLOR_SUMS, color.id()), (NORMAL_SUMS, normal.id()), (SHOWN, shown.image.id())];
    shade.buffers.extend(lights.map(|lights| (LIGHTS, lights.id())));
    let arguments = tiles.arguments.id();
    let pass = tiles.read_lists(graph.pass(&format!("shade {kind}overfull tiles")));
    let mut pass = pass.read(color, Access::StorageReadCompute).read(normal, Access::StorageReadCompute);
    if let Some(lights) = lights {
        pass = pass.read(lights, Access::UniformReadCompute);
    }
    let (access, content) = TileStart::Bands.access(); // the other tiles
    pass.write(&mut shown.image, access, content)
        .finish(Box::new(move |context| shade.dispatch_indirect(context, arguments, OVERFULL_ARGUMENTS)));
    Ok(())
}
