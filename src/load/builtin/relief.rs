//! The surface of the built-in model: a height over the unit sphere, with its gradient, and a color that follows it.
//!
//! Like an agate cut to a relief: ridges follow the contours of a slow random field, narrow where it is steep and wide
//! where it is flat, and carry small beads. Both fields are sums of plane waves of one length and random directions.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::math::random::SplitMix;

/// A point of the surface.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct SurfacePoint {
    pub position: DVec3,
    /// Unit, outward.
    pub normal: DVec3,
    /// Linear albedo and alpha 1.
    pub color: [f32; 4],
}

/// A value that depends on a direction, and how it changes with it.
#[derive(Clone, Copy, Debug)]
struct Field {
    value: f64,
    /// In the ambient space; its part along the direction has no meaning and is dropped at the end.
    gradient: DVec3,
}

impl Field {
    const fn constant(value: f64) -> Self {
        Self { value, gradient: DVec3::ZERO }
    }

    /// `g(self)`, given `g` and `g′` there.
    fn then(self, value: f64, slope: f64) -> Self {
        Self { value, gradient: slope * self.gradient }
    }

    fn plus(self, other: Self) -> Self {
        Self { value: self.value + other.value, gradient: self.gradient + other.gradient }
    }

    fn times(self, other: Self) -> Self {
        let gradient = self.value * other.gradient + other.value * self.gradient;
        Self { value: self.value * other.value, gradient }
    }

    fn scaled(self, factor: f64) -> Self {
        self.then(factor * self.value, factor)
    }

    fn tanh(self) -> Self {
        let t = self.value.tanh();
        self.then(t, 1.0 - t * t)
    }

    /// 0 below `from`, 1 above `to`, smooth between.
    fn smoothstep(self, from: f64, to: f64) -> Self {
        let x = ((self.value - from) / (to - from)).clamp(0.0, 1.0);
        self.then(x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x) / (to - from))
    }
}

/// Which random fields: chosen by eye.
const SEED: u64 = 3;

/// `amplitude · cos(vector · d + phase)`.
#[derive(Clone, Copy)]
struct Wave {
    vector: DVec3,
    phase: f64,
    amplitude: f64,
}

/// The slow field whose contours the ridges follow; it bends the whole ball too.
const BEND_WAVENUMBER: f64 = 3.4;
const BEND_WAVES: usize = 8;
const BEND_HEIGHT: f64 = 0.035;
/// Ridges a unit of the slow field.
const RIDGES: f64 = 4.5;
/// Half the height between groove and ridge.
const RIDGE_HEIGHT: f64 = 0.013;
/// How sharply ridges are cut off to flat tops.
const RIDGE_CUT: f64 = 1.7;
/// The beads on the ridges: about as fine as the default number of splats can show.
const BEAD_WAVENUMBER: f64 = 75.0;
const BEAD_WAVES: usize = 10;
const BEAD_HEIGHT: f64 = 0.0034;

/// Everything that is the same for all points.
pub(super) struct Relief {
    bend: Vec<Wave>,
    beads: Vec<Wave>,
}

impl Relief {
    pub(super) fn new() -> Self {
        let mut random = SplitMix(SEED);
        let bend = waves(&mut random, BEND_WAVES, BEND_WAVENUMBER);
        let beads = waves(&mut random, BEAD_WAVES, BEAD_WAVENUMBER);
        Self { bend, beads }
    }

    /// The point of the surface in this unit direction.
    pub(super) fn point(&self, direction: DVec3) -> SurfacePoint {
        let (radius, color) = self.evaluate(direction);
        let slope = radius.gradient - direction * radius.gradient.dot(direction);
        // The surface r(d)·d has the normal r·d − ∇r, ∇r along the sphere.
        let normal = (radius.value * direction - slope).normalize();
        SurfacePoint { position: radius.value * direction, normal, color }
    }

    fn evaluate(&self, direction: DVec3) -> (Field, [f32; 4]) {
        let bend = sum(&self.bend, direction);
        let (sin, cos) = (TAU * RIDGES * bend.value).sin_cos();
        let ridges = bend.then(RIDGE_CUT * sin, RIDGE_CUT * TAU * RIDGES * cos).tanh();
        let on_ridge = ridges.smoothstep(-0.2, 0.8);
        let beads = sum(&self.beads, direction).tanh();
        let radius = Field::constant(1.0)
            .plus(bend.scaled(BEND_HEIGHT))
            .plus(ridges.scaled(RIDGE_HEIGHT))
            .plus(beads.times(on_ridge).scaled(BEAD_HEIGHT));
        // The middle of a ridge is at a quarter turn of the sine.
        let ridge_number = (RIDGES * bend.value - 0.25).round();
        (radius, color(ridge_number, ridges.value, beads.value * on_ridge.value))
    }
}

fn sum(waves: &[Wave], direction: DVec3) -> Field {
    let mut field = Field::constant(0.0);
    for wave in waves {
        let (sin, cos) = (wave.vector.dot(direction) + wave.phase).sin_cos();
        field.value += wave.amplitude * cos;
        field.gradient -= wave.amplitude * sin * wave.vector;
    }
    field
}

/// Waves of random direction and phase whose sum has variance 1.
fn waves(random: &mut SplitMix, count: usize, wavenumber: f64) -> Vec<Wave> {
    let amplitude = (2.0 / count as f64).sqrt();
    let wave = |random: &mut SplitMix| {
        let z = 2.0 * random.unit() - 1.0;
        let (sin, cos) = (TAU * random.unit()).sin_cos();
        let ring = (1.0 - z * z).sqrt();
        let vector = wavenumber * DVec3::new(ring * cos, ring * sin, z);
        Wave { vector, phase: TAU * random.unit(), amplitude }
    };
    (0..count).map(|_| wave(random)).collect()
}

/// Linear albedo: deep blue grooves, and ridges that take turns in four colors, lighter on the beads. Neighboring ridges
/// meet in a groove, so that the color has no step.
fn color(ridge_number: f64, ridge: f64, bead: f64) -> [f32; 4] {
    const GROOVE: DVec3 = DVec3::new(0.012, 0.035, 0.095);
    const RIDGES: [DVec3; 4] = [
        DVec3::new(0.030, 0.330, 0.330),
        DVec3::new(0.830, 0.640, 0.380),
        DVec3::new(0.760, 0.200, 0.090),
        DVec3::new(0.850, 0.450, 0.100),
    ];
    let top = RIDGES[ridge_number.rem_euclid(4.0) as usize % 4];
    let t = 0.5 * (ridge + 1.0);
    let color = GROOVE.lerp(top, t * t * (3.0 - 2.0 * t)) * (1.0 + 0.18 * bead);
    let [r, g, b] = color.clamp(DVec3::ZERO, DVec3::ONE).as_vec3().to_array();
    [r, g, b, 1.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gradients_are_those_of_finite_differences() {
        let relief = Relief::new();
        let mut random = SplitMix(99);
        let mut largest = 0.0_f64;
        for _ in 0..2000 {
            let direction = (DVec3::new(random.unit(), random.unit(), random.unit()) - 0.5).normalize();
            let (field, _) = relief.evaluate(direction);
            let along = direction.any_orthonormal_vector();
            let step = 1e-7;
            let radius = |d: DVec3| relief.evaluate(d).0.value;
            let difference =
                (radius(direction + step * along) - radius(direction - step * along)) / (2.0 * step);
            let error = (field.gradient.dot(along) - difference).abs();
            assert!(error < 1e-6, "{direction}: {error}");
            largest = largest.max(field.gradient.dot(along).abs());
        }
        assert!(largest > 0.3, "the relief has slopes, or nothing was tested");
    }
}
