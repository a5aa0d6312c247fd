//! The lights of a scene.

use glam::DVec3;

use crate::error::{Error, Result};

/// The most lights of a scene: the device is told of them in a small buffer that each frame fills.
pub const MOST_LIGHTS: usize = 16;

/// The brightest that a channel of a light may be: all of them together stay within f32.
const BRIGHTEST: f32 = 1e30;

/// A light. There is no attenuation and no shadow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Its place.
    pub kind: LightKind,
    /// Linear red, green and blue, each from 0 to 1e30; 1 is white at full strength.
    pub color: [f32; 3],
}

/// The place of a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// At the eye, wherever that is.
    Eye,
    /// Infinitely far; it shines in this direction of world space, of any length above 0.
    Directional(DVec3),
}

impl Light {
    /// White, at the eye: what a scene without lights has.
    pub const DEFAULT: Self = Self { kind: LightKind::Eye, color: [1.0; 3] };

    /// Refuses a light without a direction, or of a color that is no light.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`].
    pub fn validate(&self) -> Result<()> {
        if !self.color.iter().all(|c| (0.0..=BRIGHTEST).contains(c)) {
            let [red, green, blue] = self.color;
            let problem = format!("color {red},{green},{blue}: expected numbers from 0 to {BRIGHTEST:e}");
            return Err(Error::option("light", problem));
        }
        match self.kind {
            LightKind::Directional(direction) if direction.try_normalize().is_none() => {
                let problem = format!("direction {direction}: expected a finite vector of a length above 0");
                Err(Error::option("light", problem))
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lights_that_f32_could_not_sum_are_refused() {
        let of = |red: f32| Light { color: [red, 0.0, 1.0], ..Light::DEFAULT }.validate();
        assert!(of(0.0).is_ok() && of(1e30).is_ok());
        for red in [-1.0, 3e38, f32::INFINITY, f32::NAN] {
            assert!(of(red).unwrap_err().to_string().contains("expected numbers from 0 to 1e30"), "{red}");
        }
    }
}
