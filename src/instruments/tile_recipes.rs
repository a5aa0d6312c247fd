//! The pipelines of drawing by tiles, without a scene: for whoever counts them or compiles them ahead.

use crate::passes::{
    pipeline::{
        cache::{ComputeKey, GraphicsKey},
        variant::Constants,
    },
    plan::{invocations::Invocations, tiles::TilePlan},
    tiles::{
        bins, depth,
        layer_work::Work,
        layers::{self},
        record,
        shaded::{self},
        splat::{self, Step},
    },
};
use crate::scene::{Cull, Settings, TileInvocations};

/// What decides about them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TileTraits {
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

/// Those of a CPU, unless asked otherwise.
fn invocations(settings: &Settings) -> Invocations {
    match settings.tile_invocations {
        TileInvocations::Auto | TileInvocations::Column => Invocations::Columns,
        TileInvocations::ShortColumn => Invocations::ShortColumns,
        TileInvocations::Pixel => Invocations::Pixels,
    }
}

/// The passes that set splats up and list them, each with its pipeline.
pub(crate) fn list_recipes(
    settings: &Settings,
    variant: &Constants,
    may_be_large: bool,
    visible: bool,
) -> Vec<(&'static str, ComputeKey)> {
    let plan = TilePlan { invocations: invocations(settings), ..TilePlan::for_recipes(may_be_large) };
    let set_up = ("set up splats", record::key(variant, &plan, 0, visible));
    let lists = ["count tiles", "total tiles", "start tiles", "fill tiles"];
    [set_up].into_iter().chain(lists.into_iter().zip(bins::keys(&plan, visible))).collect()
}

/// The passes of the opaque part.
pub(crate) fn opaque_recipes(settings: &Settings, traits: TileTraits) -> Vec<(&'static str, ComputeKey)> {
    let TileTraits { may_be_large, polygons, export: with_depth, leaves_sums, lights } = traits;
    let hidden = settings.cull == Cull::Hidden;
    let plan = TilePlan { invocations: invocations(settings), hidden, ..TilePlan::for_recipes(may_be_large) };
    let step = |pass, step: Step| (pass, splat::key(settings, &plan, Step { with_depth, ..step }));
    let preloaded = may_be_large;
    match polygons {
        polygons if !leaves_sums => {
            let key = shaded::key(settings, &plan, settings.accumulate, shaded::Beside { polygons, lights });
            vec![("see, sum and shade tiles", key)]
        }
        false => vec![step("see and sum tiles", Step { preloaded, hidden, ..Step::FUSED })],
        true => vec![
            step("see tiles", Step { preloaded, ..Step::VISIBLE }),
            step("sum tiles", Step { polygons, ..Step::SUMMED }),
        ],
    }
}

/// The pass that hands the depth to the graphics pipeline.
pub(crate) fn depth_recipe() -> (&'static str, GraphicsKey) {
    ("depth of tiles", depth::key())
}

/// The pass of all transparent layers, before opaque things.
pub(crate) fn layers_recipe(settings: &Settings, lights: u32) -> (&'static str, ComputeKey) {
    let plan = TilePlan { invocations: invocations(settings), ..TilePlan::for_recipes(false) };
    let plan = plan.with_layers(settings.layers.most(), 0);
    let work = Work::of_whole_tiles(settings, &plan);
    ("layers of tiles", layers::key(settings, &plan, layers::Beside { opaque: true, lights }, work))
}
