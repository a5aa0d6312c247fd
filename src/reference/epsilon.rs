//! How far behind the nearest splat others belong to one surface, for each splat by itself.

use super::near_surfaces::shares;
use crate::scene::{Epsilon, Opacity, Scene, Settings, SplatFormat};

/// The rule for the splats of an object.
pub(super) struct EpsilonRule {
    epsilon: Epsilon,
    /// Splats that face away are set back, so that a layer holds one side of the object.
    pub sets_back: bool,
    /// Radii of ε.
    sides: f64,
    /// Of each splat, where they differ.
    shares: Option<Vec<f64>>,
}

impl EpsilonRule {
    /// `polygons`: some of the scene's polygons are transparent.
    pub fn of(scene: &Scene, object: usize, settings: &Settings, opacity: Opacity, polygons: bool) -> Self {
        let epsilon = scene.epsilon(object, settings);
        let auto = epsilon == Epsilon::Auto;
        let of = &scene.objects[object];
        let transparent = opacity == Opacity::Transparent;
        // Packed splats have no room for a share.
        let exact = scene.storage.format == SplatFormat::Exact;
        let both_sides = auto && exact && (transparent || !of.closed) && opacity != Opacity::Invisible;
        let sets_back = auto && of.closed && transparent && !polygons;
        let sides = if sets_back { 2.0 } else { 1.0 };
        Self {
            epsilon,
            sets_back,
            sides,
            shares: both_sides.then(|| shares(&of.splats, sides)),
        }
    }

    /// Of splat `i`, whose surface is so thick: its larger radius, or more where a filter makes it thicker.
    pub fn epsilon(&self, i: usize, thickness: f64) -> f64 {
        match self.epsilon {
            Epsilon::Length(length) => length,
            Epsilon::Radii(factor) => factor * thickness,
            Epsilon::Auto => {
                self.sides * thickness * self.shares.as_ref().map_or(1.0, |shares| shares[i])
            }
        }
    }
}
