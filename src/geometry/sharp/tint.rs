//! The color of a part of a surface, and how far off it one color is.

use glam::{DVec4, Vec4};

/// A color that differs by so little, root mean square, is the same.
const SEEN: f64 = 1e-3;

/// Where the color steps, the squared difference of two means is so many times the sum of both variances at the least: where it goes on evenly, it is up
/// to 4 times that from a triangle to one as large beside it, and 8 times to a small one that an ellipse reaches.
const STEP: f64 = 16.0;

/// And the least difference of these means.
const LEAST_STEP: f64 = 0.05;

/// Moments of the color over an area: how large it is, the integral of the color, and that of its square.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Tint {
    pub area: f64,
    sum: DVec4,
    square: f64,
}

impl Tint {
    /// Of a triangle over which the color goes evenly from corner to corner; nothing where one is no color.
    pub fn of_triangle(corners: [Vec4; 3], area: f64) -> Self {
        let corners = corners.map(|color| color.as_dvec4().clamp(DVec4::ZERO, DVec4::ONE));
        let sum: DVec4 = corners.iter().sum();
        if !(sum.is_finite() && area.is_finite()) {
            return Self::default();
        }
        let squares: f64 = corners.iter().map(|color| color.length_squared()).sum();
        Self { area, sum: area / 3.0 * sum, square: area / 12.0 * (squares + sum.length_squared()) }
    }

    pub fn add(&mut self, other: &Self) {
        self.area += other.area;
        self.sum += other.sum;
        self.square += other.square;
    }

    /// The color that is off by the least; `None` of nothing.
    pub fn mean(&self) -> Option<DVec4> {
        (self.area > 0.0).then(|| self.sum / self.area)
    }

    /// The same color everywhere.
    pub fn even(&self) -> Self {
        Self { square: self.mean().map_or(0.0, |mean| self.sum.dot(mean)), ..*self }
    }

    /// The integral of the squared difference to the mean: the square of a length, that of a difference times the root of the area.
    pub fn off(&self) -> f64 {
        self.mean().map_or(0.0, |mean| (self.square - self.sum.dot(mean)).max(0.0))
    }

    /// Whether one color is off by no more than a length, or by what is not seen.
    pub fn is_within(&self, length: f64) -> bool {
        self.off() <= (length * length).max(SEEN * SEEN * self.area)
    }

    /// Whether the color steps from one part to another near it.
    pub fn steps_to(&self, other: &Self) -> bool {
        let (Some(own), Some(beside)) = (self.mean(), other.mean()) else { return false };
        let variances = self.off() / self.area + other.off() / other.area;
        own.distance_squared(beside) > (STEP * variances).max(LEAST_STEP * LEAST_STEP)
    }
}
