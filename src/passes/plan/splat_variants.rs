//! The specialization constants of a frame's splats: chunks in a row that are drawn alike share them, for there may be hundreds.

use std::cell::Cell;

use crate::passes::{
    pipeline::variant::{Constants, culls, splat_constants, sums_under},
    plan::{draws::Draw, levels::LevelView},
};
use crate::{
    arena::Arena,
    prepare::Chunk,
    scene::{Epsilon, Settings},
    shaders::config::*,
    vk::Limits,
};

/// What constants of a chunk follow from, beside settings and device.
#[derive(Clone, Copy, PartialEq)]
struct Kind {
    whole_px: [u32; 2],
    /// What shaders know its levels of detail as, and whether they blend.
    levels: Option<(u32, bool)>,
    own_epsilon: bool,
    ellipses: bool,
    closed: bool,
    transparent: bool,
    packed: bool,
    fine: bool,
    clipped: bool,
    sparse: bool,
}

/// The constants of the splats of a frame.
pub(crate) struct SplatVariants<'a, 's> {
    arena: &'a Arena,
    settings: &'s Settings,
    pub limits: &'s Limits,
    /// What splats sum to, over what they sum to under the default kernel.
    pub sums: f64,
    /// Those of the chunk before.
    last: Cell<Option<(Kind, (&'a Constants, bool))>>,
}

impl<'a, 's> SplatVariants<'a, 's> {
    /// None yet.
    pub fn new(arena: &'a Arena, settings: &'s Settings, limits: &'s Limits) -> Self {
        Self { arena, settings, limits, sums: sums_under(settings.kernel), last: Cell::default() }
    }

    /// Those of a chunk, in an image that is a part of a whole picture of that size, with this ε and these levels of detail; and whether splats are left out by them that face away.
    pub fn of(
        &self,
        chunk: &Chunk,
        whole_px: [u32; 2],
        epsilon: Epsilon,
        levels: Option<&LevelView>,
    ) -> (&'a Constants, bool) {
        let kind = Kind {
            whole_px,
            levels: levels.map(|levels| (levels.constant(), levels.blends())),
            own_epsilon: epsilon == Epsilon::Auto && chunk.own_epsilon,
            ellipses: chunk.ellipses,
            closed: chunk.closed,
            transparent: chunk.transparent,
            packed: chunk.packed,
            fine: chunk.fine,
            clipped: chunk.clipped,
            sparse: chunk.sparse,
        };
        if let Some((_, found)) = self.last.get().filter(|(last, _)| *last == kind) {
            return found;
        }
        let constants = self.arena.keep(self.make(&kind));
        let made = (constants, culls(constants));
        self.last.set(Some((kind, made)));
        made
    }

    fn make(&self, kind: &Kind) -> Constants {
        let cull_closed = kind.closed && !kind.transparent;
        let mut constants = splat_constants(self.settings, kind.whole_px, kind.ellipses, cull_closed);
        constants.extend(point_constants(self.limits));
        if kind.transparent {
            constants.extend([(SPEC_OUTWARD, u32::from(kind.closed)), (SPEC_IN_LAYERS, 1)]);
        }
        let told = [
            (kind.own_epsilon, SPEC_OWN_EPSILON),
            (kind.packed, SPEC_PACKED),
            (kind.fine, SPEC_FINE),
            (kind.clipped, SPEC_CLIPS),
            (kind.sparse, SPEC_SPARSE),
        ];
        constants.extend(told.into_iter().filter(|(is, _)| *is).map(|(_, number)| (number, 1)));
        if let Some((levels, blends)) = kind.levels {
            constants.push((SPEC_LEVELS, levels));
            constants.extend(blends.then_some((SPEC_BLENDED, 1)));
        }
        constants
    }
}

/// Draws with constants that `change` makes of theirs. It is asked once for draws in a row that share some, and of which `of` says the same.
pub(crate) fn change_variants<'a, K: PartialEq>(
    arena: &'a Arena,
    draws: &mut [Draw<'a>],
    of: impl Fn(&Draw<'a>) -> K,
    change: impl Fn(&mut Constants, &K),
) {
    let mut last: Option<(&'a Constants, K, &'a Constants)> = None;
    for draw in draws {
        let kind = of(draw);
        draw.variant = match &last {
            Some((before, of_last, after)) if std::ptr::eq(*before, draw.variant) && *of_last == kind => {
                after
            }
            _ => {
                let mut changed = *draw.variant;
                change(&mut changed, &kind);
                let changed = arena.keep(changed);
                last = Some((draw.variant, kind, changed));
                changed
            }
        };
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
