//! How much each pass of a frame does of what the device has limits for.

use std::collections::BTreeMap;

use surfel::{
    graph::{
        Access, Executed, Plan, PlannedPass, Role, Use,
        execute::{FrameProfile, PassCounts, PassProfile},
    },
    instruments::{LimitProbes, ListOccupancy, Probe, TileOccupancy},
    prepare::{Chunk, PreparedScene},
    report::{
        ThroughputProbe,
        bench::{FloorRound, LimitWork, LimitsReport, PassWork},
    },
};

/// A frame, as far as it tells what its passes do.
pub struct FrameWork<'a> {
    pub plan: &'a Plan,
    pub scene: &'a PreparedScene,
    /// Splats that are drawn, where they are drawn as points.
    pub drawn_points: Option<u64>,
    pub in_use: &'a ListOccupancy,
}

impl<'a> FrameWork<'a> {
    /// How far the frame is from the device's limits, of rounds in which both were measured. `counted` are its counts.
    pub fn bounds(
        &self,
        counted: &FrameProfile,
        probes: &LimitProbes,
        rounds: &[FloorRound],
    ) -> LimitsReport {
        let work = |probe: &Probe| LimitWork {
            limit: probe.limit(),
            units: probe.units(),
            bytes_per_unit: match probe.limit() {
                ThroughputProbe::BlendedFragments => Some(probes.bytes_per_blended_fragment()),
                ThroughputProbe::Bytes => Some(1),
                _ => None,
            },
        };
        let works: Vec<LimitWork> = probes.probes.iter().map(work).collect();
        let passes = self.plan.passes.iter().zip(&counted.passes);
        let passes: Vec<PassWork> = passes.map(|(pass, counted)| self.pass(pass, counted)).collect();
        LimitsReport::of(&works, &passes, rounds, probes.notes.clone())
    }

    /// How much a pass does. Of one of compute that are its invocations, the bytes that it is known to move, and, of tiles, the
    /// splats at their pixels.
    fn pass(&self, pass: &PlannedPass, counted: &PassProfile) -> PassWork {
        let mut units = BTreeMap::new();
        let (tiles, access_of_tiles) = self.tiles_of(pass).unzip();
        let executed = Executed {
            fragments: counted.counts.map(|counts| counts.fragments),
            pixels: tiles.map_or(0, |tiles| tiles.pixels),
            in_use: &self.in_use.bytes,
        };
        let mut bytes = self.plan.least_bytes(pass, executed);
        units.extend(counted.invocations.map(|invocations| (ThroughputProbe::Invocations, invocations)));
        if let Some(PassCounts { vertices, fragments }) = counted.counts {
            units.insert(ThroughputProbe::Points, vertices);
            units.insert(fragments_of(pass), fragments);
            if vertices >= self.scene.splat_count() || uses(pass, Access::IndexRead) {
                units.extend(self.drawn_points.map(|points| (ThroughputProbe::DrawnPoints, points)));
                bytes = bytes.map(|bytes| bytes + self.shape_bytes(vertices));
            }
        }
        match (tiles, access_of_tiles) {
            (Some(tiles), Some(OfTiles::SetUp)) => {
                bytes = bytes.map(|bytes| bytes + self.shape_bytes(tiles.records));
            }
            (Some(tiles), Some(OfTiles::DrawsAll)) => {
                units.insert(ThroughputProbe::Kernels, tiles.splat_pixels);
            }
            // Of lists, an unknown part: by what else is known of it, its bound would be next to nothing.
            (_, Some(OfTiles::Draws)) => (units, bytes) = (BTreeMap::new(), None),
            _ => {}
        }
        units.extend(bytes.map(|bytes| (ThroughputProbe::Bytes, bytes)));
        PassWork { name: pass.name.clone(), units }
    }

    /// The list of tiles that a pass makes or reads, and what it does with it.
    fn tiles_of(&self, pass: &PlannedPass) -> Option<(&'a TileOccupancy, OfTiles)> {
        let of = |tiles: &'a TileOccupancy| {
            let writes = |what: &str| {
                let name = format!("{what} of {}tiles", tiles.kind);
                let own = |usage: &&Use| self.plan.resource(usage.resource).name == name;
                pass.uses.iter().find(own).map(|usage| usage.start.is_some())
            };
            let does = match [writes("rects"), writes("starts"), writes("entries")] {
                [None, None, None] => return None,
                [Some(true), ..] => OfTiles::SetUp,
                [Some(false), ..] | [_, Some(true), _] => OfTiles::Lists,
                // Tiles with too many splats are left to other passes, as are large splats.
                [None, Some(false), Some(false)] if tiles.overflow == 0 && pass.role == Role::DrawsAll => {
                    OfTiles::DrawsAll
                }
                _ => OfTiles::Draws,
            };
            Some((tiles, does))
        };
        self.in_use.tiles.iter().find_map(of)
    }

    /// Bytes of so many of the splats at least, without their colors, which only those need that are seen, and not in every pass.
    /// Splats are bound by the passes' bodies, not by the graph.
    fn shape_bytes(&self, splats: u64) -> u64 {
        let of_one = |chunk: &Chunk| {
            let colors = if chunk.uniform_color { 1 } else { u64::from(chunk.count) };
            chunk.bytes().saturating_sub(COLOR_BYTES * colors) / u64::from(chunk.count.max(1))
        };
        splats.min(self.scene.splat_count()) * self.scene.chunks().iter().map(of_one).min().unwrap_or(0)
    }
}

/// The use that a pass makes of a list of tiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum OfTiles {
    /// Makes the records that are listed.
    SetUp,
    /// Counts, places or fills.
    Lists,
    /// Sees and sums all of it.
    DrawsAll,
    /// Draws some of it, or shortens it in between.
    Draws,
}

fn uses(pass: &PlannedPass, access: Access) -> bool {
    pass.uses.iter().any(|usage| usage.access == access)
}

/// Bytes of a color in the buffers of a chunk.
const COLOR_BYTES: u64 = 8;

/// The kind of a pass's fragments.
fn fragments_of(pass: &PlannedPass) -> ThroughputProbe {
    let has_colors = pass.rendering.as_ref().is_some_and(|rendering| !rendering.colors.is_empty());
    match () {
        () if !has_colors => ThroughputProbe::DepthFragments,
        () if pass.role == Role::Blends => ThroughputProbe::BlendedFragments,
        () => ThroughputProbe::Fragments,
    }
}
