//! Bounds of a scene: axis-aligned boxes and balls in world space.

use glam::DVec3;

/// An axis-aligned box in world space; may have no extent along an axis, is never empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The smallest coordinates.
    pub min: DVec3,
    /// The largest coordinates.
    pub max: DVec3,
}

/// A ball in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Its middle.
    pub center: DVec3,
    /// Its radius, at least 0.
    pub radius: f64,
}

impl Ball {
    /// The smallest ball around both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        let apart = other.center - self.center;
        let distance = apart.length();
        match () {
            () if distance + other.radius <= self.radius => self,
            () if distance + self.radius <= other.radius => other,
            () => {
                let radius = 0.5 * (distance + self.radius + other.radius);
                Self { center: self.center + apart * ((radius - self.radius) / distance), radius }
            }
        }
    }
}

impl Bounds {
    /// The box around a ball, which for a disk is a safe and simple choice.
    pub fn of_ball(center: DVec3, radius: f64) -> Self {
        Self { min: center - radius, max: center + radius }
    }

    /// The smallest box around both.
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The middle.
    pub fn center(&self) -> DVec3 {
        self.min + 0.5 * (self.max - self.min)
    }

    /// The radius of the sphere around the box; 0 for a box without extent.
    pub fn radius(&self) -> f64 {
        0.5 * (self.max - self.min).length()
    }
}
