//! The pipelines of drawing by tiles, without a scene: for whoever counts them or compiles them ahead.

use super::{
    super::{
        pipelines::{ComputeKey, GraphicsKey, Layout},
        variant::Constants,
    },
    Invocations, TilePlan,
    bins::{count_shader, fill_shader, part_length},
    depth,
    layer_work::Work,
    layers, record,
    splat::{Step, shader},
};
use crate::{
    error::Result,
    scene::{Cull, Settings, TileInvocations},
    shaders::{self, Shader},
};

/// What decides about them.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct TileTraits {
    /// Some splats are left to the graphics pipeline.
    pub may_be_large: bool,
    /// There are polygons.
    pub polygons: bool,
    /// The surface is wanted as data.
    pub export: bool,
    /// Someone else reads what tiles leave, for which they leave sums.
    pub leaves_sums: bool,
    /// The scene's own lights.
    pub lights: u32,
}

fn compute((shader, constants): (&'static Shader, Constants)) -> ComputeKey {
    ComputeKey { shader, layout: Layout::Tile, constants }
}

/// Those of a CPU, unless asked otherwise.
fn invocations(settings: &Settings) -> Invocations {
    match settings.tile_invocations {
        TileInvocations::Auto | TileInvocations::Column => Invocations::Columns,
        TileInvocations::ShortColumn => Invocations::ShortColumns,
        TileInvocations::Pixel => Invocations::Pixels,
    }
}

/// The passes that set splats up and list them, each with its pipeline.
pub(in super::super) fn list_recipes(
    settings: &Settings,
    variant: &Constants,
    may_be_large: bool,
    kept: bool,
) -> Vec<(&'static str, ComputeKey)> {
    let plan = TilePlan { invocations: invocations(settings), ..TilePlan::for_recipes(may_be_large) };
    vec![
        ("set up splats", record::key(variant, &plan, 0, kept)),
        ("count tiles", compute(count_shader(&plan, kept))),
        ("total tiles", compute((&shaders::TILE_TOTAL_COMP, Vec::new()))),
        ("start tiles", compute((&shaders::TILE_START_COMP, part_length(&plan)))),
        ("fill tiles", compute(fill_shader(&plan, kept))),
    ]
}

/// The passes of the opaque part.
pub(in super::super) fn opaque_recipes(
    settings: &Settings,
    traits: TileTraits,
) -> Result<Vec<(&'static str, ComputeKey)>> {
    let TileTraits { may_be_large: upon, polygons, export: with_depth, leaves_sums, lights } = traits;
    let hidden = settings.cull == Cull::Hidden;
    let plan = TilePlan { invocations: invocations(settings), ..TilePlan::for_recipes(upon) };
    let steps = match polygons {
        beside if !leaves_sums => {
            let (precision, hidden) = (settings.accumulate, hidden && !beside);
            vec![("see, sum and shade tiles", Step::Shaded { precision, beside, lights, hidden })]
        }
        false => vec![("see and sum tiles", Step::Fused { upon, with_depth, hidden })],
        true => vec![
            ("see tiles", Step::Visible { upon }),
            ("sum tiles", Step::Summed { beside: true, with_depth }),
        ],
    };
    steps.into_iter().map(|(pass, step)| Ok((pass, compute(shader(settings, &plan, step)?)))).collect()
}

/// The pass that hands the depth to the graphics pipeline.
pub(in super::super) fn depth_recipe() -> (&'static str, GraphicsKey) {
    ("depth of tiles", depth::key())
}

/// The pass of all transparent layers, before opaque things.
pub(in super::super) fn layers_recipe(
    settings: &Settings,
    lights: u32,
) -> Result<(&'static str, ComputeKey)> {
    let plan = TilePlan { invocations: invocations(settings), ..TilePlan::for_recipes(false) };
    let plan = plan.with_layers(settings.layers.most(), 0);
    let beside = layers::Beside { opaque: true, lights };
    let work = Work::of_whole_tiles(settings, &plan);
    Ok(("layers of tiles", compute(layers::shader(settings, &plan, beside, work)?)))
}
