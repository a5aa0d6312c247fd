//! Splats put into a scene one by one, and the scene that a row makes.

use glam::DVec3;
use surfel::scene::{Backfaces, Camera, Epsilon, Filter, Object};

use super::looking::Draws as _;
use crate::common::builder::{Builder, Random};

/// All filters: `adjust-paper` is for disks alone.
pub const EVERY_FILTER: &[Filter] =
    &[Filter::Adjust, Filter::None, Filter::Ewa, Filter::Max, Filter::AdjustPaper];

/// A scene before its settings are chosen.
pub struct Made {
    pub object: Object,
    pub camera: Camera,
    /// The filters under which there is something to see.
    pub filters: &'static [Filter],
    /// The one ε that the scene is about.
    pub epsilon: Option<Epsilon>,
    /// What becomes of back faces, where the scene is about that.
    pub backfaces: Option<Backfaces>,
    /// The radius of what is seen, by which an ε is chosen where it is a length.
    pub radius: f64,
    /// How far depths may be off, relative, before an ε-threshold is a tie.
    pub depth_steps: f64,
    /// The eye is as near to planes as it is meant to be: nothing that it is nearly in the plane of is left out.
    pub exact_planes: bool,
}

/// Where a fragment this near to the ε-threshold exempts its pixel: [`surfel::selftest::agreement`]'s own.
pub const DEPTH_MARGIN: f64 = 1e-4;

/// Splats of one object: disks, or skew ellipses.
pub struct Put {
    builder: Builder,
    ellipses: bool,
}

impl Put {
    pub fn new(random: &mut Random) -> Self {
        Self { builder: Builder::default(), ellipses: random.is(0.5) }
    }

    pub fn disks() -> Self {
        Self { builder: Builder::default(), ellipses: false }
    }

    pub fn ellipses() -> Self {
        Self { builder: Builder::default(), ellipses: true }
    }

    /// A splat with this normal: a disk, or an ellipse whose tangent vectors are 30° to 150° apart and up to 1 : 4.
    pub fn splat(&mut self, random: &mut Random, at: DVec3, normal: DVec3, radius: f64) {
        if !self.ellipses {
            self.builder.disk(at, normal, radius, random.color());
            return;
        }
        let first = normal.any_orthonormal_vector();
        let turned = |rad: f64| first * rad.cos() + normal.cross(first) * rad.sin();
        let angle = random.between(0.0, std::f64::consts::TAU);
        let s = turned(angle) * radius;
        let t = turned(angle + random.between(30.0, 150.0).to_radians()) * (radius * random.log(0.25, 1.0));
        self.builder.ellipse(at, s, t, random.color());
    }

    /// An ellipse by its tangent vectors.
    pub fn ellipse(&mut self, random: &mut Random, at: DVec3, s: DVec3, t: DVec3) {
        self.builder.ellipse(at, s, t, random.color());
    }

    /// The scene of these.
    pub fn made(self, camera: Camera, radius: f64) -> Made {
        self.made_of(camera, radius, false)
    }

    /// The scene of these, which may be a closed surface.
    pub fn made_of(self, camera: Camera, radius: f64, closed: bool) -> Made {
        Made {
            object: self.builder.object(closed),
            camera,
            filters: EVERY_FILTER,
            epsilon: None,
            backfaces: None,
            radius,
            depth_steps: DEPTH_MARGIN,
            exact_planes: false,
        }
    }
}
