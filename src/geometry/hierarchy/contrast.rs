//! How much what is below a node differs in what is seen of it: nodes below which it does are larger on the screen than they spread, so that they are parted sooner.
//!
//! A node displaces what is below it by its spread s, and what is seen of that is the more the more it differs: where all has one normal and one color, nothing. The squared error of a picture of so many
//! splats is least where s times what differs is the same everywhere. That, without a floor, would leave a plane of one color to one node, whose ellipse would show at its rim; and what a light
//! makes of normals is not known. So a node's size is s times `1 + q`, with q from 0 to 1.

use glam::DVec3;

/// Where unit normals are so far from their mean, by the root of the mean square, or colors as much, q is 1.
const MOST: f64 = 0.2;

/// What squares of differences between colors count beside those between normals.
const COLORS: f64 = 6.0;

/// How much what is below a node differs, by area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Contrast {
    /// The mean squared distance of unit normals from their mean.
    of_normals: f64,
    /// The variance of linear colors times alpha, over four times the sum of their mean's components: by first order the variance of their square roots, which is how they are seen.
    of_colors: f64,
}

impl Contrast {
    /// By the mean of unit normals, that of colors times alpha, and that of the squares of those.
    pub fn of(mean_normal: DVec3, mean_color: DVec3, mean_square: f64) -> Self {
        let of_normals = (1.0 - mean_normal.length_squared()).max(0.0);
        let variance = (mean_square - mean_color.length_squared()).max(0.0);
        let sum = mean_color.element_sum();
        let of_colors = if sum > 0.0 { variance / (4.0 * sum) } else { 0.0 };
        Self { of_normals, of_colors }
    }

    /// How many times its spread a node's size is, from 1 to 2.
    pub fn size_factor(&self) -> f64 {
        1.0 + ((self.of_normals + COLORS * self.of_colors).sqrt() / MOST).min(1.0)
    }
}
