//! Bounds of what decides about levels of detail: of splats of a block, or of several blocks.

use glam::DVec3;

use crate::scene::ErrorBall;

/// The bounds of what decides about splats, in the space of levels. Distances are from `center`.
#[derive(Clone, Copy, Debug)]
pub struct LevelBounds {
    /// About in the middle of their centers.
    pub center: DVec3,
    /// Of the splats' own balls; all 0 where they are the object's.
    pub own: BallBounds,
    /// Of their parents'.
    pub parent: BallBounds,
    /// No splat's larger half axis is more times the spread of a ball of its own; 0 where they are the object's.
    pub longest: f64,
}

/// Bounds of balls around a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallBounds {
    /// The largest distance of a ball's farthest point.
    pub reach: f64,
    /// The largest distance of a ball's center, less its radius; may be below 0.
    pub far: f64,
    /// The least and the largest spread.
    pub spreads: [f64; 2],
}

/// Sums of lengths are larger by so much: more than their roundings.
const LENGTHENED: f64 = 1.0 + 1e-12;

impl LevelBounds {
    /// Around what several bound.
    pub(super) fn around(all: &[Self]) -> Self {
        let [lo, hi] = all.iter().fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[lo, hi], bounds| {
            [lo.min(bounds.center), hi.max(bounds.center)]
        });
        let center = if all.is_empty() { DVec3::ZERO } else { 0.5 * (lo + hi) };
        let of = |balls: fn(&Self) -> &BallBounds| {
            let moved = all.iter().map(|bounds| {
                let (away, balls) = (bounds.center.distance(center) * LENGTHENED, balls(bounds));
                BallBounds { reach: away + balls.reach, far: away + balls.far, ..*balls }
            });
            moved.reduce(|a, b| a.and(&b)).unwrap_or_default()
        };
        let longest = all.iter().map(|bounds| bounds.longest).fold(0.0, f64::max);
        Self { center, own: of(|bounds| &bounds.own), parent: of(|bounds| &bounds.parent), longest }
    }
}

/// Of none: as if of one that is nothing.
impl Default for BallBounds {
    fn default() -> Self {
        Self { reach: 0.0, far: 0.0, spreads: [0.0; 2] }
    }
}

impl BallBounds {
    /// Those of some balls, around a place.
    pub(super) fn of<'a>(center: DVec3, balls: impl Iterator<Item = &'a ErrorBall>) -> Self {
        let each = balls.map(|ball| {
            let distance = center.distance(ball.center.as_dvec3());
            let (radius, spread) = (f64::from(ball.radius), f64::from(ball.spread));
            Self { reach: distance + radius, far: distance - radius, spreads: [spread; 2] }
        });
        each.reduce(|a, b| a.and(&b)).unwrap_or_default()
    }

    /// Around both, which are around one place.
    fn and(&self, other: &Self) -> Self {
        Self {
            reach: self.reach.max(other.reach),
            far: self.far.max(other.far),
            spreads: [self.spreads[0].min(other.spreads[0]), self.spreads[1].max(other.spreads[1])],
        }
    }
}
