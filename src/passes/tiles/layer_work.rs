//! What each dispatch does of transparent layers: all of them, some, or, where a tile has more splats than one dispatch takes, a
//! step of one with a part of the splats.

use crate::passes::{pipeline::constants::TileConstants, plan::tiles::TilePlan};
use crate::{
    scene::{LastLayer, Settings},
    shaders::config::*,
};

/// Layers of one surface each; and whether there is one more, of all that is left.
fn layers_of(settings: &Settings) -> (u32, bool) {
    let most = settings.layers.most();
    match settings.last_layer {
        LastLayer::Drop => (most, false),
        LastLayer::Stack | LastLayer::Blend => (most - 1, true),
    }
}

/// What one dispatch does of all layers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Share {
    surfaces: u32,
    blends_rest: bool,
}

/// How the layers are dispatched.
fn shares(settings: &Settings, plan: &TilePlan) -> impl Iterator<Item = Share> + use<> {
    let ((surfaces, rest), at_once) = (layers_of(settings), plan.layers_at_once);
    let of_surfaces = (0..surfaces).step_by(at_once as usize).map(move |first| {
        let own = at_once.min(surfaces - first);
        // What is left is the last one's, where that has room.
        Share { surfaces: own, blends_rest: rest && own < at_once }
    });
    let alone = rest && surfaces % at_once == 0;
    of_surfaces.chain(alone.then_some(Share { surfaces: 0, blends_rest: true }))
}

/// How a dispatch works on a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Work {
    /// All layers at once.
    Whole,
    /// Some layers after the other.
    Several,
    /// A step of a layer, and a part of the splats, after the other.
    Parts,
}

impl Work {
    /// How all but overflow tiles are worked on.
    pub fn of_whole_tiles(settings: &Settings, plan: &TilePlan) -> Self {
        if shares(settings, plan).nth(1).is_some() { Self::Several } else { Self::Whole }
    }
}

/// The constants of each dispatch over whole tiles.
pub(crate) fn of_shares(
    settings: &Settings,
    plan: &TilePlan,
    constants: TileConstants,
) -> impl Iterator<Item = TileConstants> + use<> {
    let of_share = move |(part, Share { surfaces, blends_rest })| TileConstants {
        part,
        surfaces,
        blends_rest: u32::from(blends_rest),
        ..constants
    };
    (0..).zip(shares(settings, plan)).map(of_share)
}

/// The constants of each dispatch over overflow tiles.
pub(crate) fn of_parts(
    settings: &Settings,
    plan: &TilePlan,
    constants: TileConstants,
) -> impl Iterator<Item = TileConstants> + use<> {
    let parts = plan.parts();
    let of_step = move |(surfaces, step)| {
        (0..parts).map(move |part| TileConstants {
            part,
            surfaces,
            step,
            ends: u32::from(part + 1 == parts),
            ..constants
        })
    };
    steps(settings).flat_map(of_step)
}

/// The steps of all layers (`STEP_*`), each with the number of surfaces before it.
fn steps(settings: &Settings) -> impl Iterator<Item = (u32, u32)> + use<> {
    let (surfaces, rest) = layers_of(settings);
    let of_surfaces = (0..surfaces).flat_map(|n| [(n, STEP_SEE), (n, STEP_SUM)]);
    of_surfaces.chain(rest.then_some((surfaces, STEP_REST)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::passes::plan::{invocations::Invocations, tiles::rows::all_of};
    use crate::{scene::Layers, vk::Limits};

    #[test]
    fn the_shares_are_all_layers_and_no_dispatch_exceeds_the_iterations() {
        for records in [1, 4000, 54_000, 540_000] {
            for lights in [0, 1, 16] {
                let limits = Limits { max_texels: 1 << 27, ..Limits::plain() };
                for (most, last_layer) in [
                    (1, LastLayer::Stack),
                    (1, LastLayer::Drop),
                    (4, LastLayer::Stack),
                    (16, LastLayer::Blend),
                    (64, LastLayer::Blend),
                    (256, LastLayer::Drop),
                ] {
                    let plan = TilePlan::of_boxes(
                        1,
                        std::iter::once((records, 10.0)),
                        all_of([512, 512]),
                        &limits,
                        Invocations::Columns,
                    )
                    .unwrap();
                    let plan = plan.with_layers(most, lights, false);
                    let settings =
                        Settings { layers: Layers::Fixed(most), last_layer, ..Settings::default() };
                    let shares: Vec<_> = shares(&settings, &plan).collect();
                    let all: u32 =
                        shares.iter().map(|share| share.surfaces + u32::from(share.blends_rest)).sum();
                    assert_eq!(all, most);
                    let rests = shares.iter().filter(|share| share.blends_rest).count();
                    assert_eq!(rests, usize::from(last_layer != LastLayer::Drop));
                    assert!(shares.iter().rev().skip(1).all(|share| !share.blends_rest));
                    for share in &shares {
                        // Two walks and a loop over the lights for each pixel of a column; the rest is lit splat by splat.
                        let surface = 2 * plan.part_length.div_ceil(8) + 8 * lights + 1;
                        let rest = (1 + lights) * plan.part_length.div_ceil(8);
                        let iterations = share.surfaces * surface + u32::from(share.blends_rest) * rest;
                        assert!(iterations < 65_535, "{records} {most} {lights}: {share:?}");
                    }
                    assert!((1 + lights) * plan.walk_length.div_ceil(8) + 8 * lights + 3 < 65_535);
                }
            }
        }
    }
}
