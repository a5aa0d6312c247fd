//! Points at random on surfaces whose normals are known.

use glam::{DVec2, DVec3};

use crate::math::random::SplitMix;

/// A point of a surface, and the normal there.
pub type Sample = (DVec3, DVec3);

/// Points spread at random over known surfaces.
pub struct Surfaces(pub SplitMix);

impl Surfaces {
    fn unit(&mut self) -> f64 {
        self.0.unit()
    }

    pub fn sphere(&mut self) -> Sample {
        let (z, angle) = (2.0 * self.unit() - 1.0, std::f64::consts::TAU * self.unit());
        let p = (DVec2::from_angle(angle) * (1.0 - z * z).sqrt()).extend(z);
        (p, p)
    }

    /// Radii 1 and 0.4; by rejection as much on each area.
    pub fn torus(&mut self) -> Sample {
        loop {
            let [a, b] = [self.unit(), self.unit()].map(|u| DVec2::from_angle(std::f64::consts::TAU * u));
            if self.unit() * 1.4 < 1.0 + 0.4 * b.x {
                let normal = (a * b.x).extend(b.y);
                return (a.extend(0.0) + 0.4 * normal, normal);
            }
        }
    }

    /// From −1 to 1.
    pub fn cube(&mut self) -> Sample {
        let face = (6.0 * self.unit()) as usize;
        let mut normal = DVec3::ZERO;
        normal[face % 3] = if face < 3 { 1.0 } else { -1.0 };
        let mut p = DVec3::from_array([0; 3].map(|_| 2.0 * self.unit() - 1.0));
        p[face % 3] = normal[face % 3];
        (p, normal)
    }

    /// Both sides of a square from −1 to 1, `thickness` apart, without rims.
    pub fn plate(&mut self, thickness: f64) -> Sample {
        let side = if self.unit() < 0.5 { 0.5 } else { -0.5 };
        let at = DVec2::new(2.0 * self.unit() - 1.0, 2.0 * self.unit() - 1.0);
        (at.extend(side * thickness), DVec3::new(0.0, 0.0, 2.0 * side))
    }

    /// 10 times as many points a unit of area at x = 1 as at x = −1.
    pub fn uneven(&mut self, mut one: impl FnMut(&mut Self) -> Sample) -> Sample {
        loop {
            let (p, normal) = one(self);
            if self.unit() < 0.1 + 0.45 * (p.x.clamp(-1.0, 1.0) + 1.0) {
                return (p, normal);
            }
        }
    }

    pub fn many(&mut self, count: usize, mut one: impl FnMut(&mut Self) -> Sample) -> Vec<Sample> {
        (0..count).map(|_| one(self)).collect()
    }
}
