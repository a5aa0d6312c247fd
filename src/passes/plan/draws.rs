//! What is drawn: the chunks of a prepared scene as this frame's camera and settings see them.

use glam::DVec4;

use crate::passes::{
    pipeline::{
        constants::FrameConstants,
        splat_shaders::Primitive,
        variant::{Constants, culls, splat_constants, sums_under},
    },
    plan::{
        blocks::{
            BlockCullView,
            walk::{Closer, closer_runs, potentially_visible_runs},
        },
        frame_constants::{focal_in_view_px, frame_constants, near_in_view},
        in_view::{center_and_half, in_view, nearest_z, wholly_in_view},
        levels::LevelView,
        range::DepthRange,
        seen::PotentiallyVisibleRun,
    },
};
use crate::{
    arena::{Arena, ArenaVec},
    error::Result,
    inline_vec::InlineVec,
    math::size::{SizeBound, box_px, half_image, largest_box_px},
    prepare::{Chunk, Placed, ViewFromLocal, inverse_overlap_in_upper_half},
    scene::{Camera, Epsilon, Filter, MOST_PLANES, Settings},
    shaders::config::*,
    vk::Limits,
};

/// A chunk in this frame.
#[derive(Clone, Copy)]
pub struct Draw<'a> {
    /// The splats.
    pub chunk: &'a Chunk,
    /// The number of their scene among those that the frame shows.
    pub placed: u32,
    /// What its shaders are told.
    pub constants: FrameConstants,
    /// What no splat's box exceeds, in pixels; infinite where one may come near the eye plane.
    pub largest_box_px: f64,
    /// From where, for [`Self::potentially_visible_runs`].
    pub(super) view: ViewFromLocal,
    bound: SizeBound,
    /// Whether no splat's center lies outside of the view, as far as a box around all of them tells.
    pub wholly_in_view: bool,
    /// The planes that cut what is seen, in view space: unit normals toward what is left, and by how much the eye is inside.
    pub(super) planes: InlineVec<DVec4, MOST_PLANES>,
    /// How the camera sees its levels of detail, where some of its splats are of none that is drawn.
    pub(crate) levels: Option<LevelView>,
    /// Whether a splat of it may exceed the device's largest point, come near the eye plane or be too thin for a
    /// triangle: such ones are then listed and drawn as quads. Never with a rasterizer that draws quads only.
    pub may_be_large: bool,
    /// A filter's weights are summed in 16 bits.
    pub(crate) half_sums: bool,
    /// The specialization constants of its pipelines.
    pub(crate) variant: Constants,
}

impl Draw<'_> {
    /// The same of the scene of that number.
    pub(super) fn of_scene(mut self, number: u32) -> Self {
        self.placed = number;
        self
    }

    /// How many splats have boxes up to how many pixels, as far as that is told apart; infinite as [`Self::largest_box_px`].
    pub(crate) fn boxes(&self) -> impl Iterator<Item = (u32, f64)> + Clone {
        self.chunk.radii.iter().map(|step| {
            let radius = step.radius * self.view.view_from_local_scale;
            (step.count, box_px(&self.bound, radius).min(self.largest_box_px))
        })
    }

    /// The blocks in which there may be something to see.
    pub(crate) fn potentially_visible_runs<'m>(&self, arena: &'m Arena) -> &'m [PotentiallyVisibleRun] {
        potentially_visible_runs(arena, self.chunk, &self.look())
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
        let Self { view, bound, levels, planes, .. } = self;
        let [center, half] = center_and_half(self.chunk);
        let farthest = (center.abs() + half).length() * view.view_from_local_scale;
        BlockCullView {
            view,
            bound,
            culls: culls(&self.variant),
            levels: levels.as_ref(),
            planes,
            by_origin: view.origin_from_eye.length() + farthest,
            half_image: half_image(bound),
        }
    }
}

impl Draw<'_> {
    /// The largest depth of a splat's center, in view space.
    pub(super) fn farthest_z(&self) -> f64 {
        let row = self.view.rotation.row(2);
        let [center, half] = center_and_half(self.chunk);
        (row.dot(center) + row.abs().dot(half)) * self.view.view_from_local_scale + self.view.translation.z
    }
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
        let is_same =
            |last: &Draw<'_>| last.variant == draw.variant && last.may_be_large == draw.may_be_large;
        match (number.checked_sub(1).map(|last| &draws[last]).filter(|last| is_same(last)), all.last()) {
            (Some(_), Some(last)) => all.push(*last),
            _ => all.push(make(draw)?),
        }
    }
    Ok(all.into_bump_slice())
}

/// All chunks of splats of a scene as seen from a camera.
pub fn draws<'a, 's>(
    Placed { scene, at, .. }: Placed<'a>,
    (camera, range): (&Camera, DepthRange),
    settings: &'s Settings,
    limits: &'s Limits,
) -> impl Iterator<Item = Draw<'a>> + use<'a, 's> {
    // All of it is in the scene's own space, in which a camera stands elsewhere.
    let (camera, range) = (at.camera(camera), range.within(&at));
    let filter_radius_px = settings.samples.filter_radius_px();
    let sums = sums_under(settings.kernel);
    let primitive = Primitive::of(settings.rasterizer);
    let clip: InlineVec<_, MOST_PLANES> = settings.clip().into_iter().map(|plane| at.plane(plane)).collect();
    let draw = move |chunk: &'a Chunk| {
        let camera = &camera;
        let view = chunk.rebase.view_from_local(camera);
        let is_orthographic = camera.is_orthographic();
        let wanted = chunk.epsilon.unwrap_or(settings.epsilon);
        let epsilon = match wanted {
            Epsilon::Auto => (Epsilon::auto_radii(chunk.transparent), 0.0),
            Epsilon::Radii(radii) => (radii, 0.0),
            // An object's own is in the scene's unit, that of the settings in the world's.
            Epsilon::Length(length) if chunk.epsilon.is_some() => (0.0, length),
            Epsilon::Length(length) => (0.0, length / at.scale),
        };
        let bound = SizeBound {
            nearest_z: nearest_z(chunk, &view),
            largest_radius: chunk.largest_radius * view.view_from_local_scale,
            near: if is_orthographic { 0.0 } else { near_in_view(camera, &view) },
            focal_px: focal_in_view_px(camera, &view, settings.size_px[1]),
            is_orthographic,
            size_px: settings.size_px.map(f64::from),
            middle_px: camera.middle_px(settings.size_px),
            filter_px: match settings.filter {
                Filter::None => 0.0,
                // Its two axes may have one direction: together they reach √2 times as far as one.
                Filter::AdjustPaper => std::f64::consts::SQRT_2 * filter_radius_px,
                Filter::Adjust | Filter::Max | Filter::Ewa => filter_radius_px,
            },
        };
        let point_cap_px = limits.point_size_range[1];
        let levels =
            chunk.levels.and_then(|levels| LevelView::new(levels, chunk.transparent, camera, settings));
        let of_level =
            levels.map_or(f64::INFINITY, |view| view.largest_drawn_px(&chunk.tree, bound.filter_px));
        let largest_box_px = largest_box_px(&bound).min(of_level);
        let mut constants = FrameConstants {
            splat_count: chunk.count,
            chunk_color: u32::from(chunk.uniform_color),
            blocks_overlap: inverse_overlap_in_upper_half(chunk.inverse_overlap / sums),
            ..frame_constants(&view, (camera, range), settings, epsilon)
        };
        if chunk.fine {
            [constants.view_from_local_x, constants.view_from_local_y, constants.view_from_local_z] =
                view.fine_rows();
        }
        Draw {
            chunk,
            placed: 0,
            constants,
            largest_box_px,
            view,
            bound,
            // What planes cut off is looked for, too.
            wholly_in_view: clip.is_empty() && wholly_in_view(chunk, &view, &bound),
            planes: clip.iter().map(|plane| in_view(*plane, camera, &view)).collect(),
            levels,
            may_be_large: match primitive {
                Primitive::Point => largest_box_px > f64::from(point_cap_px),
                // Filters leave no splat thin.
                Primitive::Triangle => settings.filter == Filter::None || largest_box_px.is_infinite(),
                Primitive::Quad => false,
            },
            half_sums: false,
            variant: {
                let cull_closed = chunk.closed && !chunk.transparent;
                let whole_px = camera.window.whole_px.unwrap_or(settings.size_px);
                let mut constants = splat_constants(settings, whole_px, chunk.ellipses, cull_closed);
                constants.extend(point_constants(limits));
                if chunk.transparent {
                    constants.extend([(SPEC_OUTWARD, u32::from(chunk.closed)), (SPEC_IN_LAYERS, 1)]);
                }
                if wanted == Epsilon::Auto && chunk.own_epsilon {
                    constants.push((SPEC_OWN_EPSILON, 1));
                }
                if chunk.packed {
                    constants.push((SPEC_PACKED, 1));
                }
                if chunk.fine {
                    constants.push((SPEC_FINE, 1));
                }
                if chunk.clipped {
                    constants.push((SPEC_CLIPS, 1));
                }
                if chunk.sparse {
                    constants.push((SPEC_SPARSE, 1));
                }
                if let Some(levels) = levels {
                    constants.push((SPEC_LEVELS, levels.constant()));
                    constants.extend(levels.blends().then_some((SPEC_BLENDED, 1)));
                }
                constants
            },
        }
    };
    // Where the scene itself is drawn, nothing stands for its splats.
    scene.chunks.iter().map(draw).filter(|draw| draw.levels.is_some() || !draw.chunk.stands_for_others())
}

/// The splats of a scene themselves, where levels of detail can't be chosen.
pub(crate) fn without_levels(splats: &mut ArenaVec<'_, Draw<'_>>) {
    splats.retain(|draw| !draw.chunk.stands_for_others());
    for draw in splats {
        draw.levels = None;
        draw.variant.retain(|(number, _)| *number != SPEC_LEVELS);
    }
}

/// The same splats, of whose levels of detail one takes the place of the other at once.
pub(crate) fn with_hard_steps(splats: &mut [Draw<'_>]) {
    for draw in splats {
        draw.levels = draw.levels.map(LevelView::with_hard_steps);
        draw.variant.retain(|(number, _)| *number != SPEC_BLENDED);
    }
}

/// What shaders are told of the device's points.
fn point_constants(limits: &Limits) -> Constants {
    let step_px = point_step_px(limits.point_size_granularity);
    [(SPEC_POINT_CAP, limits.point_size_range[1].to_bits()), (SPEC_POINT_STEP, step_px.to_bits())].into()
}

/// The step by which shaders round point sizes up. Devices may report 0, for any size; a square of pixels has a
/// whole side, which is a multiple of a 16th.
fn point_step_px(granularity: f32) -> f32 {
    granularity.max(1.0 / 16.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As `glsl/inc/point.glsl` rounds.
    #[test]
    fn points_are_as_large_as_their_squares_whatever_step_the_device_reports() {
        for granularity in [0.0, 1e-30, 0.0625, 0.125, 1.0] {
            let step = point_step_px(granularity);
            for side in 1..=8192 {
                let side = side as f32;
                assert_eq!((side / step).ceil() * step, side, "{granularity}");
            }
        }
    }
}
