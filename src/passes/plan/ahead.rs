//! Frames as they may become while a camera moves: which ways to draw the same things follow from where it is, so that all their pipelines can be made ahead.

use std::borrow::Cow;

use crate::passes::{
    pipeline::splat_shaders::Primitive,
    plan::{
        bands::Band,
        block_list::ListedBlocks,
        culling,
        draws::Draw,
        invocations::Invocations,
        method::{Reason, wants_tiles},
        tiles::{TilePlan, rows::rows_of_image},
    },
};
use crate::{
    arena::Arena,
    prepare::Placed,
    scene::{Budget, Filter, Lod, Settings},
    vk::Limits,
};

/// What of a frame's plan follows from where its camera is. Whatever else does is no matter of pipelines.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Ahead {
    /// Splats may be large, or come near the eye.
    pub large: bool,
    /// Most are small, and none is large for a tile.
    pub small: bool,
    /// Some may lie outside of the view or face away, so that those are listed that do not.
    pub listed: bool,
    /// A tile may have more splats than one dispatch takes.
    pub overflows: bool,
    /// Levels of detail have no room in tiles.
    pub without_tiles: bool,
    /// Splats are drawn for all of what has both in cells.
    pub without_cells: bool,
    /// A budget suffices for all splats, so that no levels of detail are chosen.
    pub without_levels: bool,
}

/// Sides of the image below which nothing more depends on them.
const LEAST_SIDE_PX: u32 = 64;

impl Ahead {
    /// All that may be, of what stands in these scenes.
    pub fn all(
        scenes: &[Placed<'_>],
        settings: &Settings,
        limits: &Limits,
    ) -> impl Iterator<Item = Self> + use<> {
        let of_tiles = |small| Invocations::of(settings.tile_invocations, limits, small);
        let may_be_small = of_tiles(true) != of_tiles(false);
        let any = |has: fn(&Placed<'_>) -> bool| scenes.iter().any(has);
        let has_levels = any(|placed| placed.scene.chunks.iter().any(|chunk| chunk.levels.is_some()));
        let has_cells = any(|placed| placed.scene.meshes.iter().any(|mesh| mesh.levels.is_some()));
        let has_budget = settings.budget != Budget::Unlimited;
        (0..1_u32 << 7).filter_map(move |bits| {
            let [large, small, listed, overflows, without_tiles, without_cells, without_levels] =
                [0, 1, 2, 3, 4, 5, 6].map(|bit| bits >> bit & 1 == 1);
            let of_tiles_alone = small || overflows;
            let may_be = (may_be_small || !small)
                && (has_levels && !of_tiles_alone || !without_tiles)
                && (has_cells || !without_cells)
                && (has_levels && has_budget || !without_levels);
            may_be.then_some(Self {
                large,
                small,
                listed,
                overflows,
                without_tiles,
                without_cells,
                without_levels,
            })
        })
    }

    /// The settings, with a size of levels of detail that a budget may lead to, where there is one.
    pub fn settings(self, settings: &Settings) -> Cow<'_, Settings> {
        if settings.budget == Budget::Unlimited {
            return Cow::Borrowed(settings);
        }
        let least_px = if self.without_levels { 0.0 } else { 1.0 };
        Cow::Owned(Settings { lod: Lod::Px(settings.tau_px().max(least_px)), ..settings.clone() })
    }

    /// Whether splats of a chunk may be large.
    pub fn may_be_large(self, settings: &Settings) -> bool {
        match Primitive::of(settings.rasterizer) {
            Primitive::Point => self.large,
            Primitive::Triangle => self.large || settings.filter == Filter::None,
            Primitive::Quad => false,
        }
    }

    /// Sizes of the picture up to this one that differ in pipelines, or stand for those that do.
    pub fn sizes_px(size_px: [u32; 2]) -> impl Iterator<Item = [u32; 2]> {
        let half = |size_px: &[u32; 2]| {
            let is_large = size_px.iter().any(|side| *side > LEAST_SIDE_PX);
            is_large.then(|| size_px.map(|side| side.div_ceil(2)))
        };
        std::iter::successors(Some(size_px), half)
    }

    /// Tiles of these splats, of which there may be a few or as many as there is room for.
    ///
    /// # Errors
    /// The reason against tiles.
    pub fn bands<'a>(
        self,
        arena: &'a Arena,
        splats: &[Draw<'a>],
        (polygons, transparent, few): (bool, bool, bool),
        settings: &Settings,
        limits: &Limits,
    ) -> Result<(&'a [Band<'a>], Reason), Reason> {
        let reason = wants_tiles(few, settings, limits)?;
        if self.without_tiles || transparent && (self.large || polygons) {
            return Err("ahead: not by tiles");
        }
        let rows = rows_of_image(settings);
        let boxes = || splats.iter().map(|_| (1, 1.0));
        let of = |invocations| {
            TilePlan::of_boxes(splats.len(), boxes(), (settings.size_px, rows.clone()), limits, invocations)
        };
        let invocations = Invocations::of(settings.tile_invocations, limits, self.small);
        let plan = of(invocations).or_else(|| of(invocations.of_full_height()));
        let culls_hidden = culling::tiles_cull_hidden(splats, polygons, settings);
        let plan = plan.and_then(|plan| plan.when_drawn(splats, culls_hidden, limits));
        let plan = plan.ok_or("ahead: too many for tiles")?;
        let plan = TilePlan { may_be_large: self.large, overflows_somewhere: self.overflows, ..plan };
        let mut own = arena.copied(splats);
        let visible = match self.lists_tiles(splats, settings, limits) {
            true => {
                let nothing = arena.list(splats.iter().map(|_| &[][..]));
                Some(ListedBlocks::of(arena, &mut own, nothing, rows))
            }
            false => {
                culling::number_splats(&mut own);
                None
            }
        };
        let band = Band { splats: own.into_bump_slice(), visible, plan };
        // Several bands have the pipelines of one.
        Ok((std::slice::from_ref(arena.keep(band)), reason))
    }

    /// Whether tiles are made of listed splats.
    fn lists_tiles(self, splats: &[Draw<'_>], settings: &Settings, limits: &Limits) -> bool {
        let has_levels = splats.iter().any(|draw| draw.levels.is_some());
        has_levels || self.listed && culling::lists_tiles(splats, settings, limits)
    }
}
