//! What is drawn: the chunks of a prepared scene as this frame's camera and settings see them.

use std::ops::Deref;

use crate::passes::{
    pipeline::{constants::FrameConstants, splat_shaders::Primitive, variant::Constants},
    plan::{
        blocks::{
            BlockCullView,
            walk::{Closer, closer_runs, potentially_visible_runs, run_of_all},
        },
        chunk_view::ChunkView,
        frame_constants::frame_constants,
        in_view::{by_origin, in_view, nearest_z},
        levels::LevelView,
        range::DepthRange,
        scene_view::{CameraView, SceneView},
        seen::PotentiallyVisibleRun,
        splat_variants::{SplatVariants, change_variants},
    },
};
use crate::{
    arena::{Arena, ArenaVec},
    error::Result,
    math::size::SizeBound,
    prepare::{Chunk, Placed, inverse_overlap_in_upper_half},
    scene::{Camera, Epsilon, Filter, Settings},
    shaders::config::*,
    vk::Limits,
};

/// A chunk in this frame: as it is seen, and how it is drawn. Lists of draws are copied, band by band: what bands have in common lies in the view.
#[derive(Clone, Copy)]
pub struct Draw<'a> {
    seen: &'a ChunkView<'a>,
    /// What shaders are told of its place among others.
    pub(crate) place: DrawPlace,
    /// How the camera sees its levels of detail, where some of its splats are of none that is drawn.
    pub(crate) levels: Option<&'a LevelView>,
    /// Whether a splat of it may exceed the device's largest point, come near the eye plane or be too thin for a
    /// triangle: such ones are then listed and drawn as quads. Never with a rasterizer that draws quads only.
    pub may_be_large: bool,
    /// A filter's weights are summed in 16 bits.
    pub(crate) half_sums: bool,
    /// The specialization constants of its pipelines.
    pub(crate) variant: &'a Constants,
    /// Splats of it that face away are not drawn.
    pub(crate) culls: bool,
}

/// Where the splats of a chunk are among those that a pass goes over.
#[derive(Clone, Copy, Default)]
pub(crate) struct DrawPlace {
    /// The chunk's number in its part of the frame.
    pub number: u32,
    /// As [`FrameConstants::first_record`].
    pub first_record: u32,
    /// As [`FrameConstants::listed_blocks`].
    pub listed_blocks: u32,
}

impl<'a> Deref for Draw<'a> {
    type Target = ChunkView<'a>;

    fn deref(&self) -> &ChunkView<'a> {
        self.seen
    }
}

impl Draw<'_> {
    /// What its shaders are told.
    #[inline]
    pub fn told(&self) -> FrameConstants {
        let DrawPlace { number, first_record, listed_blocks } = self.place;
        let mut told = FrameConstants { first_record, ..self.seen.constants };
        told.number_chunk(number);
        told.list_blocks(listed_blocks);
        told
    }

    /// The blocks in which there may be something to see.
    pub(crate) fn potentially_visible_runs<'m>(&self, arena: &'m Arena) -> &'m [PotentiallyVisibleRun] {
        potentially_visible_runs(arena, self.chunk, &self.look())
    }

    /// The same, by one look where that is enough to tell how many splats they have at most, but not in which rows.
    pub(crate) fn runs_at_once<'m>(&self, arena: &'m Arena) -> &'m [PotentiallyVisibleRun] {
        let look = self.look();
        run_of_all(arena, self.chunk, &look)
            .unwrap_or_else(|| potentially_visible_runs(arena, self.chunk, &look))
    }

    /// Whether some of these runs are of a part of it, so that rows are known.
    pub(crate) fn has_rows(&self, runs: &[PotentiallyVisibleRun]) -> bool {
        self.chunk.facing.is_none() || !runs.iter().any(|run| run.blocks as usize == self.chunk.blocks.len())
    }

    /// Whether a device finds by bounds which way its blocks face.
    pub(crate) fn has_bounds(&self) -> bool {
        self.chunk.facing.is_some() && self.culls
    }

    /// The same, looked at more closely.
    pub(crate) fn closer_runs<'m>(
        &self,
        arena: &'m Arena,
        runs: &[PotentiallyVisibleRun],
        closer: Closer<'_>,
    ) -> &'m [PotentiallyVisibleRun] {
        closer_runs(arena, self.chunk, &self.look(), runs, closer)
    }

    /// How its blocks are looked at.
    pub(super) fn look(&self) -> BlockCullView<'_> {
        self.seen.look(self.culls, self.levels)
    }
}

/// Most draws share what they have the same.
fn is_same(one: &Constants, other: &Constants) -> bool {
    std::ptr::eq(one, other) || one == other
}

/// What `make` gives for each draw, asked once for draws in a row that have the same pipelines.
pub(crate) fn by_variant<'m, T: Copy>(
    arena: &'m Arena,
    draws: &[Draw<'_>],
    mut make: impl FnMut(&Draw<'_>) -> Result<T>,
) -> Result<&'m [T]> {
    let mut all = arena.growing::<T>();
    all.reserve(draws.len());
    for (number, draw) in draws.iter().enumerate() {
        let is_alike =
            |last: &Draw<'_>| is_same(last.variant, draw.variant) && last.may_be_large == draw.may_be_large;
        match (number.checked_sub(1).map(|last| &draws[last]).filter(|last| is_alike(last)), all.last()) {
            (Some(_), Some(last)) => all.push(*last),
            _ => all.push(make(draw)?),
        }
    }
    Ok(all.into_bump_slice())
}

/// All chunks of splats of a scene as seen from a camera.
pub fn draws<'a, 's>(
    arena: &'a Arena,
    placed: Placed<'a>,
    seen: (&Camera, DepthRange),
    settings: &'s Settings,
    limits: &'s Limits,
) -> impl Iterator<Item = Draw<'a>> + use<'a, 's> {
    let view = arena.keep(CameraView::new(seen, settings));
    let view = arena.keep(view.of_scene(arena, &placed.at));
    let variants = SplatVariants::new(arena, settings, limits);
    placed
        .scene
        .chunks
        .iter()
        .filter_map(move |chunk| draw(arena, (&placed, 0, chunk), view, settings, &variants))
}

/// As `glsl/inc/reach.glsl` has it.
const REACH: f64 = 0.8;

/// Whether splats of a chunk reach further than what a filter makes of them, if edges are covered in part.
pub(super) fn reaches(chunk: &Chunk, settings: &Settings) -> bool {
    chunk.has_borders && settings.covers_in_part() && settings.filter == Filter::Adjust
}

/// A chunk of a scene, which has that number among those of the frame, and is seen so; none where the scene itself is drawn and the chunk stands for its splats.
pub(super) fn draw<'a>(
    arena: &'a Arena,
    (Placed { at, .. }, number, chunk): (&Placed<'a>, u32, &'a Chunk),
    of_scene: &SceneView<'a>,
    settings: &Settings,
    variants: &SplatVariants<'a, '_>,
) -> Option<Draw<'a>> {
    let levels = chunk
        .levels
        .and_then(|levels| LevelView::new(levels, chunk.transparent, &of_scene.camera(at), settings));
    if levels.is_none() && chunk.stands_for_others() {
        return None;
    }
    let view = chunk.rebase.view_from(&of_scene.view);
    let is_orthographic = of_scene.is_orthographic();
    let wanted = chunk.epsilon.unwrap_or(settings.epsilon);
    let epsilon = match wanted {
        Epsilon::Auto => (Epsilon::auto_radii(chunk.transparent), 0.0),
        Epsilon::Radii(radii) => (radii, 0.0),
        // An object's own is in the scene's unit, that of the settings in the world's.
        Epsilon::Length(length) if chunk.epsilon.is_some() => (0.0, length),
        Epsilon::Length(length) => (0.0, length / at.scale),
    };
    let filter_radius_px = of_scene.frame.filter_radius_px;
    let by_origin = by_origin(chunk, &view);
    let bound = SizeBound {
        nearest_z: nearest_z(chunk, &view, by_origin),
        largest_radius: chunk.largest_radius * view.view_from_local_scale,
        near: if is_orthographic { 0.0 } else { of_scene.near(&view) },
        focal_px: of_scene.focal_px(&view),
        is_orthographic,
        size_px: of_scene.frame.size_px,
        middle_px: of_scene.frame.middle_px,
        sides: of_scene.sides(&view),
        filter_px: match settings.filter {
            Filter::None => 0.0,
            // Its two axes may have one direction: together they reach √2 times as far as one.
            Filter::AdjustPaper => std::f64::consts::SQRT_2 * filter_radius_px,
            Filter::Adjust | Filter::Max | Filter::Ewa => filter_radius_px,
        },
        reach_px: match reaches(chunk, settings) {
            true => REACH * filter_radius_px,
            false => 0.0,
        },
    };
    let of_level_px =
        levels.map_or(f64::INFINITY, |view| view.largest_drawn_px(&chunk.tree, bound.filter_px));
    let mut constants = FrameConstants {
        splat_count: chunk.count,
        chunk_color: u32::from(chunk.uniform_color),
        blocks_overlap: inverse_overlap_in_upper_half(chunk.inverse_overlap / variants.sums),
        ..frame_constants(&view, of_scene, settings, epsilon)
    };
    if chunk.fine {
        [constants.view_from_local_x, constants.view_from_local_y, constants.view_from_local_z] =
            view.fine_rows();
    }
    let clip = of_scene.clip;
    let half_image = of_scene.half_image(&bound);
    let seen = arena.keep_made(|| ChunkView {
        chunk,
        placed: number,
        of_level_px,
        view,
        bound,
        by_origin,
        planes: match clip.is_empty() {
            true => &[],
            false => arena.list(clip.iter().map(|plane| in_view(*plane, &of_scene.view, &view))),
        },
        half_image,
        constants,
    });
    let levels = levels.map(|levels| arena.keep(levels));
    let (variant, culls) =
        variants.of(chunk, of_scene.whole_px().unwrap_or(settings.size_px), wanted, levels);
    Some(Draw {
        seen,
        place: DrawPlace::default(),
        levels,
        may_be_large: match Primitive::of(settings.rasterizer) {
            Primitive::Point => seen.exceeds(variants.limits.point_size_range[1].into()),
            // Filters leave no splat thin.
            Primitive::Triangle => settings.filter == Filter::None || seen.largest_box_px().is_infinite(),
            Primitive::Quad => false,
        },
        half_sums: false,
        variant,
        culls,
    })
}

/// The splats of a scene themselves, where levels of detail can't be chosen.
pub(crate) fn without_levels<'a>(arena: &'a Arena, splats: &mut ArenaVec<'_, Draw<'a>>) {
    splats.retain(|draw| !draw.chunk.stands_for_others());
    splats.iter_mut().for_each(|draw| draw.levels = None);
    leave_out(arena, splats, SPEC_LEVELS);
}

/// The same splats, of whose levels of detail one takes the place of the other at once.
pub(crate) fn with_hard_steps<'a>(arena: &'a Arena, splats: &mut [Draw<'a>]) {
    splats
        .iter_mut()
        .for_each(|draw| draw.levels = draw.levels.map(|levels| arena.keep(levels.with_hard_steps())));
    leave_out(arena, splats, SPEC_BLENDED);
}

/// Leaves a constant out where it is.
fn leave_out<'a>(arena: &'a Arena, splats: &mut [Draw<'a>], constant: u32) {
    if splats.iter().any(|draw| draw.variant.iter().any(|(number, _)| *number == constant)) {
        change_variants(
            arena,
            splats,
            |_| (),
            |variant, ()| variant.retain(|(number, _)| *number != constant),
        );
    }
}
