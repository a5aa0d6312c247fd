//! Splats as a struct of arrays, and the rule that says which of them can't be drawn.

use glam::{DVec3, Vec3};

use super::{Bounds, Clip, Clips, Colors};

/// Oriented elliptical disks in world space, parts of which may be cut off. All arrays have one entry a splat.
#[derive(Clone, Debug)]
pub struct Splats {
    /// Centers.
    pub positions: Vec<DVec3>,
    /// Orientation and size.
    pub shapes: Shapes,
    /// Color and opacity.
    pub colors: Colors,
    /// What is cut off. Only ellipses have such: disks have no (u, v).
    pub clips: Clips,
}

/// Orientation and size of every splat.
#[derive(Clone, Debug)]
pub enum Shapes {
    /// Circular disks.
    Disks {
        /// Normals of any length; the surface is seen from the side to which they point.
        normals: Vec<Vec3>,
        /// Radii.
        radii: Vec<f32>,
    },
    /// Elliptical disks: a point of the splat is `center + u·s + v·t` with `u² + v² ≤ 1`. `s` and `t` need not be
    /// orthogonal. The normal is `s × t`.
    Ellipses {
        /// First tangent vectors, scaled by the radius along them.
        s: Vec<Vec3>,
        /// Second tangent vectors, scaled by the radius along them.
        t: Vec<Vec3>,
    },
}

/// The reason why a splat can't be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Defect {
    /// A coordinate of the center is NaN or infinite.
    Position,
    /// The normal is zero, NaN or infinite.
    Normal,
    /// The radius is zero, negative, NaN or infinite.
    Radius,
    /// The tangent vectors are NaN, infinite, zero or collinear.
    Tangents,
    /// A color component is NaN or infinite.
    Color,
    /// A value of a clip curve is NaN or infinite, or its weight negative; or a disk has one.
    Clip,
}

/// The numbers of splats with each defect.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DefectCounts {
    /// Indexed by [`Defect`].
    counts: [usize; 6],
}

impl Splats {
    /// Splats of which nothing is cut off.
    pub fn new(positions: Vec<DVec3>, shapes: Shapes, colors: Colors) -> Self {
        Self { positions, shapes, colors, clips: Clips::default() }
    }

    /// The number of splats.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// No splat at all.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// Bytes of memory that the splats themselves need: with disks 24 for a position, 12 for a normal, 4 for a radius;
    /// with ellipses 24 and twice 12; 16 more for a color of its own; 44 more where
    /// parts of some are cut off.
    pub fn bytes(&self) -> u64 {
        let shape = match &self.shapes {
            Shapes::Disks { .. } => size_of::<(Vec3, f32)>(),
            Shapes::Ellipses { .. } => 2 * size_of::<Vec3>(),
        };
        let color = match &self.colors {
            Colors::Uniform(_) => 0,
            Colors::Each(_) => size_of::<[f32; 4]>(),
        };
        self.len() as u64 * (size_of::<DVec3>() + shape + color) as u64 + self.clips.bytes()
    }

    /// Color and alpha of splat `i`.
    pub fn color(&self, i: usize) -> [f32; 4] {
        self.colors.get(i).unwrap_or_default()
    }

    /// The larger of the radii of splat `i`: for an ellipse its major semi-axis.
    pub fn major_radius(&self, i: usize) -> f64 {
        match &self.shapes {
            Shapes::Disks { radii, .. } => f64::from(radii[i]),
            Shapes::Ellipses { s, t } => {
                // The largest singular value of [s t].
                let (s, t) = (s[i].as_dvec3(), t[i].as_dvec3());
                let (ss, tt, st) = (s.dot(s), t.dot(t), s.dot(t));
                (0.5 * (ss + tt + (ss - tt).hypot(2.0 * st))).sqrt()
            }
        }
    }

    /// The defect of splat `i`; `None` where it can be drawn.
    pub fn defect(&self, i: usize) -> Option<Defect> {
        if !self.positions[i].is_finite() {
            return Some(Defect::Position);
        }
        match &self.shapes {
            Shapes::Disks { normals, radii } => {
                if !(normals[i].is_finite() && normals[i] != Vec3::ZERO) {
                    return Some(Defect::Normal);
                }
                if !(radii[i] > 0.0 && radii[i].is_finite()) {
                    return Some(Defect::Radius);
                }
            }
            Shapes::Ellipses { s, t } => {
                if !(s[i].is_finite() && t[i].is_finite()) || collinear(s[i], t[i]) {
                    return Some(Defect::Tangents);
                }
            }
        }
        if !self.color(i).iter().all(|c| c.is_finite()) {
            return Some(Defect::Color);
        }
        let clip = self.clips.get(i);
        let belongs = clip == Clip::None || matches!(self.shapes, Shapes::Ellipses { .. });
        (!(belongs && clip.is_valid())).then_some(Defect::Clip)
    }

    /// Removes every splat that has a [`Defect`], keeps the order of the others, and tells what was removed.
    pub fn drop_defective(&mut self) -> DefectCounts {
        let mut counts = DefectCounts::default();
        let keep: Vec<bool> = (0..self.len())
            .map(|i| {
                let defect = self.defect(i);
                counts.add(defect);
                defect.is_none()
            })
            .collect();
        if counts.total() > 0 {
            self.keep(&keep);
        }
        counts
    }

    /// Removes every splat whose value is false, and keeps the order of the others.
    ///
    /// # Panics
    /// If there is not a value for each splat.
    pub fn keep(&mut self, keep: &[bool]) {
        assert_eq!(keep.len(), self.len(), "a value for each splat");
        retain(&mut self.positions, keep);
        match &mut self.shapes {
            Shapes::Disks { normals, radii } => {
                retain(normals, keep);
                retain(radii, keep);
            }
            Shapes::Ellipses { s, t } => {
                retain(s, keep);
                retain(t, keep);
            }
        }
        if let Colors::Each(colors) = &mut self.colors {
            retain(colors, keep);
        }
        self.clips = self.clips.picked((0..keep.len()).filter(|&i| keep[i]));
    }

    /// The box around all disks (each taken as the ball of its major radius, or, of a surface that clip curves cut, as what is left of it);
    /// splats with a [`Defect`] are left out. `None` where nothing is left.
    pub fn bounds(&self) -> Option<Bounds> {
        (0..self.len()).filter(|&i| self.defect(i).is_none()).map(|i| self.bounds_of(i)).reduce(Bounds::union)
    }
}

impl DefectCounts {
    /// The number of splats with a defect.
    pub fn total(&self) -> usize {
        self.counts.iter().sum()
    }

    /// The number of splats with this defect; a splat counts once, with the first one found.
    pub fn of(&self, defect: Defect) -> usize {
        self.counts[defect as usize]
    }

    /// Counts a splat's [`Splats::defect`]; nothing for `None`.
    pub fn add(&mut self, defect: Option<Defect>) {
        if let Some(defect) = defect {
            self.counts[defect as usize] += 1;
        }
    }

    /// Adds the counts of others.
    pub fn merge(&mut self, other: &Self) {
        for (count, more) in self.counts.iter_mut().zip(other.counts) {
            *count += more;
        }
    }
}

impl std::fmt::Display for DefectCounts {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let words = [
            (Defect::Position, "position not finite"),
            (Defect::Normal, "normal zero or not finite"),
            (Defect::Radius, "radius not above zero or not finite"),
            (Defect::Tangents, "tangent vectors collinear or not finite"),
            (Defect::Color, "color not finite"),
            (Defect::Clip, "clip curve not finite or of negative weight"),
        ];
        let parts: Vec<String> = words
            .iter()
            .filter(|(defect, _)| self.of(*defect) > 0)
            .map(|(defect, text)| format!("{} {text}", self.of(*defect)))
            .collect();
        f.write_str(&parts.join(", "))
    }
}

/// Whether `s × t` is too small against `|s||t|` to give a direction: f32 vectors carry their direction to 2⁻²⁴, so
/// below 4 such steps the normal is rounding noise.
fn collinear(s: Vec3, t: Vec3) -> bool {
    let (s, t) = (s.as_dvec3(), t.as_dvec3());
    let limit = 4.0 * f64::from(f32::EPSILON) * 0.5;
    // Also true where either is zero.
    s.cross(t).length() <= limit * s.length() * t.length()
}

fn retain<T>(values: &mut Vec<T>, keep: &[bool]) {
    let mut keep = keep.iter();
    values.retain(|_| *keep.next().unwrap_or(&true));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_defect_is_found_dropped_and_counted() {
        let good = (DVec3::ZERO, Vec3::Z, 1.0_f32, [0.5_f32; 4]);
        let cases = [
            (good, None),
            ((DVec3::new(f64::NAN, 0.0, 0.0), good.1, good.2, good.3), Some(Defect::Position)),
            ((DVec3::new(0.0, f64::INFINITY, 0.0), good.1, good.2, good.3), Some(Defect::Position)),
            ((good.0, Vec3::ZERO, good.2, good.3), Some(Defect::Normal)),
            ((good.0, Vec3::new(0.0, f32::NAN, 1.0), good.2, good.3), Some(Defect::Normal)),
            ((good.0, good.1, 0.0, good.3), Some(Defect::Radius)),
            ((good.0, good.1, -1.0, good.3), Some(Defect::Radius)),
            ((good.0, good.1, f32::INFINITY, good.3), Some(Defect::Radius)),
            ((good.0, good.1, good.2, [0.0, f32::NAN, 0.0, 1.0]), Some(Defect::Color)),
        ];
        let mut splats = Splats::new(
            cases.iter().map(|c| c.0.0).collect(),
            Shapes::Disks {
                normals: cases.iter().map(|c| c.0.1).collect(),
                radii: cases.iter().map(|c| c.0.2).collect(),
            },
            Colors::Each(cases.iter().map(|c| c.0.3).collect()),
        );
        for (i, case) in cases.iter().enumerate() {
            assert_eq!(splats.defect(i), case.1, "case {i}");
        }
        let counts = splats.drop_defective();
        assert_eq!(splats.len(), 1);
        assert_eq!((counts.total(), counts.of(Defect::Position), counts.of(Defect::Radius)), (8, 2, 3));
        assert_eq!(splats.bounds(), Some(Bounds::of_ball(DVec3::ZERO, 1.0)));
    }

    #[test]
    fn collinear_tangents_are_a_defect_and_thin_ellipses_are_not() {
        let splats = Splats::new(
            vec![DVec3::ZERO; 3],
            Shapes::Ellipses {
                s: vec![Vec3::X; 3],
                t: vec![2.0 * Vec3::X, Vec3::new(0.0, 1e-6, 0.0), Vec3::ZERO],
            },
            Colors::Uniform([0.5; 4]),
        );
        assert_eq!(splats.defect(0), Some(Defect::Tangents));
        assert_eq!(splats.defect(1), None);
        assert_eq!(splats.defect(2), Some(Defect::Tangents));
    }
}
