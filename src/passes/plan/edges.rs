//! Which surfaces cover pixels in part where they end.

use crate::passes::plan::{
    SplatMethod, SurfacePlan,
    bands::Band,
    draws::{Draw, reaches},
    splat_variants::change_variants,
};
use crate::{
    arena::Arena,
    scene::Edges,
    shaders::config::{SPEC_COVERAGE_EDGES, SPEC_OWN_EPSILON, SPEC_REACHES, SPEC_SHARP, SPEC_TWO_SIDED},
    vk::Limits,
};

impl<'a> SurfacePlan<'a> {
    /// Tiles that shade what they sum cover pixels in part where surfaces end; what leaves sums does not. Those of layers do it under so many lights. Polygons beside opaque ones
    /// do, too, where the device has an image with room for their samples; not in one of several samples of a picture, which are as many themselves.
    pub(super) fn finish_bands(&mut self, arena: &'a Arena, lights: Option<u32>, limits: &Limits) {
        let transparent = lights.is_some();
        let shades = !self.bands().is_empty() && (transparent || self.tiles_can_shade(&self.settings));
        let coverage = shades && self.settings.covers_in_part();
        if !coverage {
            if !self.bands().is_empty() && self.settings.covers_in_part() {
                self.reason = NOT_IN_PART;
            }
            self.settings.edges = Edges::Hard;
        }
        if !coverage && !transparent {
            return;
        }
        let two_sided = coverage && self.splats.iter().any(|draw| !draw.culls);
        let reaches =
            coverage && !transparent && self.splats.iter().any(|draw| reaches(draw.chunk, &self.settings));
        let blended = self.splats.iter().filter_map(|draw| draw.levels).any(|levels| levels.blends());
        let samples_polygons = !self.meshes.is_empty()
            && self.settings.samples.0 == 1
            && self.settings.size_px.iter().all(|side| 2 * side <= limits.max_image_side);
        let most_layers = self.settings.layers.most();
        let SplatMethod::Tiles(bands) = &mut self.method else { return };
        let of_band = |band: &Band<'a>| {
            let splats = match coverage {
                true => with_edges(arena, band.splats, (two_sided, reaches), transparent),
                false => band.splats,
            };
            let plan = match lights {
                None => band.plan.clone().with_edges((two_sided, reaches), blended, samples_polygons),
                Some(lights) => band.plan.clone().with_layers(most_layers, lights, two_sided),
            };
            Band { splats, plan, ..*band }
        };
        *bands = arena.list(bands.iter().map(of_band));
    }
}

/// Why surfaces do not cover pixels in part that tiles draw.
const NOT_IN_PART: &str = "edges are hard, since some splats are too large, or too many, to cover pixels in part: --samples 8 smooths them";

/// Splats whose surfaces cover pixels in part where they end.
fn with_edges<'a>(
    arena: &'a Arena,
    splats: &[Draw<'a>],
    (two_sided, reaches): (bool, bool),
    transparent: bool,
) -> &'a [Draw<'a>] {
    let mut splats = arena.copied(splats);
    let kind = |draw: &Draw<'_>| (draw.chunk.is_sharp, reaches && draw.chunk.has_borders);
    change_variants(arena, &mut splats, kind, |variant, (is_sharp, reaches)| {
        variant.push((SPEC_COVERAGE_EDGES, 1));
        variant.extend(reaches.then_some((SPEC_REACHES, 1)));
        if *is_sharp {
            variant.push((SPEC_SHARP, 1));
        }
        if two_sided {
            variant.push((SPEC_TWO_SIDED, 1));
            // Surfaces are of one side: how near the other one is does not matter. Of sharp ones it is not that alone.
            if !is_sharp && !transparent {
                variant.retain(|(number, _)| *number != SPEC_OWN_EPSILON);
            }
        }
    });
    splats.into_bump_slice()
}
