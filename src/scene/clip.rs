//! Curves that cut parts off elliptical splats (Ivo et al., "Adaptive clipping of splats to models with sharp features",
//! 2012, section 3).

use glam::Vec2;

/// A rational Bézier curve of degree 2 in the plane of a splat, which removes one of its two sides.
///
/// Places are (u, v), the splat's own: `center + u·s + v·t`, its rim `u² + v² = 1`; the weights of the three control points are 1,
/// `weight` and 1. The removed side is that to the right of the way from the start to the end along the curve: with an end
/// ahead of the start counterclockwise, that of the arc from the one to the other.
///
/// Unlike the paper's (its equation 5), the angles are those of the unit circle before it becomes an ellipse: 45° is where
/// `u = v`, whatever the lengths of `s` and `t`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClipCurve {
    /// Where the curve starts on the rim, P1 = (cos, sin); radians, any, from `s` toward `t`.
    pub start_rad: f32,
    /// Where it ends, P3. Where that is the start, nothing is removed.
    pub end_rad: f32,
    /// The middle control point P2; any place. On the chord: a line.
    pub middle: Vec2,
    /// The weight of the middle control point, at least 0: 0 is the chord, 1 a parabola, below it ellipses, above it hyperbolas, very
    /// large the two lines to the middle control point. A circle's arc is the cosine of half its angle.
    pub weight: f32,
}

/// How it is decided on which side of a clip curve a place lies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ClipTest {
    /// By the implicit form of the conic: no root, no case for the way in which it bends, right for any middle control point.
    #[default]
    Conic,
    /// By the crossings with the line to the middle of the chord (Ivo et al. 2012, equation 7), and outside of the control triangle by the
    /// lines through the middle control point, which are right only where that lies within the disk.
    Ivo,
}

/// What is cut off a splat.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Clip {
    /// Nothing.
    #[default]
    None,
    /// What the curve removes.
    One(ClipCurve),
    /// What either of two curves removes: a convex corner.
    Either(ClipCurve, ClipCurve),
    /// What both of two curves remove: a concave corner.
    Both(ClipCurve, ClipCurve),
}

/// The clips of some splats; takes no memory where none of them has any.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Clips {
    /// One a splat, or none at all.
    each: Vec<Clip>,
}

impl ClipCurve {
    /// A straight cut from one place of the rim to another.
    pub fn line(start_rad: f32, end_rad: f32) -> Self {
        let middle = 0.5 * (Vec2::from_angle(start_rad) + Vec2::from_angle(end_rad));
        Self { start_rad, end_rad, middle, weight: 0.0 }
    }

    /// Whether all its values are finite and its weight not negative.
    pub fn is_valid(&self) -> bool {
        self.start_rad.is_finite() && self.end_rad.is_finite() && self.middle.is_finite() && {
            self.weight.is_finite() && self.weight >= 0.0
        }
    }

    /// The same curve on a splat whose tangent vectors have changed places.
    #[must_use]
    pub fn swapped(&self) -> Self {
        let quarter = std::f64::consts::FRAC_PI_2;
        let angle = |rad: f32| (quarter - f64::from(rad)) as f32;
        // What was to the right of the way is to its left now, and to the right of the way back.
        Self {
            start_rad: angle(self.end_rad),
            end_rad: angle(self.start_rad),
            middle: Vec2::new(self.middle.y, self.middle.x),
            weight: self.weight,
        }
    }

    /// The same curve on a splat whose second tangent vector points the other way.
    #[must_use]
    pub fn flipped(&self) -> Self {
        let middle = Vec2::new(self.middle.x, -self.middle.y);
        Self { start_rad: -self.end_rad, end_rad: -self.start_rad, middle, weight: self.weight }
    }
}

impl Clip {
    /// What two curves remove, each of which may be missing; `both` where only what both remove is cut off. One alone removes its
    /// side either way.
    pub fn of(curves: [Option<ClipCurve>; 2], both: bool) -> Self {
        match (curves, both) {
            ([Some(first), Some(second)], false) => Self::Either(first, second),
            ([Some(first), Some(second)], true) => Self::Both(first, second),
            ([Some(curve), None] | [None, Some(curve)], _) => Self::One(curve),
            ([None, None], _) => Self::None,
        }
    }

    /// Its curves.
    pub fn curves(&self) -> [Option<&ClipCurve>; 2] {
        match self {
            Self::None => [None; 2],
            Self::One(curve) => [Some(curve), None],
            Self::Either(first, second) | Self::Both(first, second) => [Some(first), Some(second)],
        }
    }

    /// Whether each of its curves is [valid](ClipCurve::is_valid).
    pub fn is_valid(&self) -> bool {
        self.curves().into_iter().flatten().all(ClipCurve::is_valid)
    }

    /// With each curve replaced.
    #[must_use]
    pub fn map(self, of: impl Fn(&ClipCurve) -> ClipCurve) -> Self {
        match self {
            Self::None => Self::None,
            Self::One(curve) => Self::One(of(&curve)),
            Self::Either(first, second) => Self::Either(of(&first), of(&second)),
            Self::Both(first, second) => Self::Both(of(&first), of(&second)),
        }
    }
}

impl Clips {
    /// Of so many splats, one for each.
    pub fn of(each: Vec<Clip>) -> Self {
        let clipped = each.iter().any(|clip| *clip != Clip::None);
        Self { each: if clipped { each } else { Vec::new() } }
    }

    /// Whether no splat has one.
    pub fn is_empty(&self) -> bool {
        self.each.is_empty()
    }

    /// That of splat `i`.
    pub fn get(&self, i: usize) -> Clip {
        self.each.get(i).copied().unwrap_or_default()
    }

    /// One a splat, or none at all where none has any.
    pub fn iter(&self) -> impl Iterator<Item = &Clip> {
        self.each.iter()
    }

    /// How many splats have one.
    pub fn count(&self) -> usize {
        self.iter().filter(|clip| **clip != Clip::None).count()
    }

    /// Bytes of memory.
    pub fn bytes(&self) -> u64 {
        (self.each.len() * size_of::<Clip>()) as u64
    }

    /// With each curve replaced.
    #[must_use]
    pub fn map(self, of: impl Fn(&ClipCurve) -> ClipCurve) -> Self {
        Self { each: self.each.into_iter().map(|clip| clip.map(&of)).collect() }
    }

    /// Those of some splats, in their order.
    #[must_use]
    pub(super) fn picked(&self, which: impl Iterator<Item = usize>) -> Self {
        if self.is_empty() { Self::default() } else { Self::of(which.map(|i| self.get(i)).collect()) }
    }

    /// Adds those of `more` splats behind the `count` that there are.
    pub(super) fn append(&mut self, count: usize, others: Self, more: usize) {
        if self.is_empty() && others.is_empty() {
            return;
        }
        self.each.resize(count, Clip::None);
        self.each.extend(others.each);
        self.each.resize(count + more, Clip::None);
    }
}

#[cfg(test)]
mod tests {
    use glam::{DAffine3, DMat3, DVec3, Vec3};

    use super::*;
    use crate::scene::{Colors, Defect, DefectCounts, Shapes, Splats};

    fn curve(weight: f32) -> ClipCurve {
        ClipCurve { start_rad: 0.4, end_rad: 2.0, middle: Vec2::new(0.3, 0.5), weight }
    }

    /// As many as there are clips.
    fn clipped(clips: Vec<Clip>) -> Splats {
        let count = clips.len();
        let shapes = Shapes::Ellipses {
            s: vec![Vec3::new(1.0, 0.5, 0.0); count],
            t: vec![Vec3::new(0.0, 1.0, 2.0); count],
        };
        let positions = (0..count).map(|i| DVec3::new(i as f64, 0.0, 0.0)).collect();
        Splats { clips: Clips::of(clips), ..Splats::new(positions, shapes, Colors::unknown()) }
    }

    fn each(splats: &Splats) -> Vec<Clip> {
        (0..splats.len()).map(|i| splats.clips.get(i)).collect()
    }

    #[test]
    fn clips_go_with_their_splats() {
        let one = |weight| Clip::One(curve(weight));
        let all = vec![one(0.0), Clip::None, Clip::Both(curve(1.0), curve(2.0)), one(3.0)];
        let splats = clipped(all.clone());
        assert_eq!((splats.clips.count(), splats.clips.bytes()), (3, 4 * 44));
        assert_eq!(each(&splats.picked([3, 1, 3].into_iter())), [all[3], all[1], all[3]]);
        assert!(splats.picked([1, 1].into_iter()).clips.is_empty());
        let mut kept = splats.clone();
        kept.keep(&[false, true, true, false]);
        assert_eq!(each(&kept), all[1..3]);

        let plain = clipped(vec![Clip::None; 2]);
        assert!(plain.clips.is_empty() && plain.clips.bytes() == 0);
        let mut put_together = plain.with_room(8);
        for (part, clipped) in [(&plain, 0), (&splats, 3), (&plain, 3), (&splats, 6)] {
            put_together.append(part.clone());
            assert_eq!(put_together.clips.count(), clipped);
        }
        let none = [Clip::None; 2].as_slice();
        assert_eq!(each(&put_together), [none, &all, none, &all].concat());
    }

    #[test]
    fn curves_that_nothing_can_be_cut_by_are_a_defect() {
        let broken = [
            ClipCurve { start_rad: f32::NAN, ..curve(1.0) },
            ClipCurve { end_rad: f32::INFINITY, ..curve(1.0) },
            ClipCurve { middle: Vec2::new(0.0, f32::NAN), ..curve(1.0) },
            curve(-1e-30),
            curve(f32::INFINITY),
        ];
        let mut clips: Vec<_> = broken.map(|broken| Clip::Either(curve(1.0), broken)).to_vec();
        clips.extend([Clip::None, Clip::One(curve(0.0)), Clip::One(curve(1e30))]);
        let mut splats = clipped(clips);
        let mut expected = DefectCounts::default();
        broken.iter().for_each(|_| expected.add(Some(Defect::Clip)));
        assert_eq!(splats.drop_defective(), expected);
        assert_eq!(splats.len(), 3);
        let shapes = Shapes::Disks { normals: vec![Vec3::Z; 3], radii: vec![1.0; 3] };
        let disks = Splats { shapes, ..splats };
        assert_eq!([0, 1, 2].map(|i| disks.defect(i)), [None, Some(Defect::Clip), Some(Defect::Clip)]);
    }

    /// Control points stay where they are on the surface, and so does the side that is removed.
    #[test]
    fn a_map_of_space_moves_the_curve_with_the_surface() {
        let shear = DMat3::from_cols(DVec3::X, DVec3::new(0.7, 1.0, 0.0), DVec3::new(-0.2, 0.4, 1.0));
        let place = |splats: &Splats, at: Vec2| {
            let Shapes::Ellipses { s, t } = &splats.shapes else { panic!("ellipses") };
            splats.positions[0] + f64::from(at.x) * s[0].as_dvec3() + f64::from(at.y) * t[0].as_dvec3()
        };
        let points = |splats: &Splats| {
            let Clip::One(curve) = splats.clips.get(0) else { panic!("one curve") };
            let rim = |rad: f32| place(splats, Vec2::from_angle(rad));
            [rim(curve.start_rad), place(splats, curve.middle), rim(curve.end_rad)]
        };
        let right = |splats: &Splats, at: DVec3| {
            let Shapes::Ellipses { s, t } = &splats.shapes else { panic!("ellipses") };
            let [start, _, end] = points(splats);
            (end - start).cross(s[0].cross(t[0]).as_dvec3()).dot(at - start) > 0.0
        };
        for (matrix, mirrors) in
            [(shear, false), (DMat3::from_diagonal(DVec3::new(1.0, -3.0, 1.0)) * shear, true)]
        {
            let map = DAffine3::from_mat3(matrix);
            let before = clipped(vec![Clip::One(curve(0.7))]);
            let after = before.clone().transformed(&map);
            let mut expected = points(&before).map(|point| map.transform_point3(point));
            if mirrors {
                expected.reverse();
            }
            for (point, expected) in points(&after).into_iter().zip(expected) {
                assert!(point.distance(expected) < 1e-5, "{matrix}: {point} {expected}");
            }
            for at in [Vec2::from_angle(1.2), Vec2::ZERO] {
                let [removed, image] = [place(&before, at), map.transform_point3(place(&before, at))];
                assert_eq!(right(&before, removed), right(&after, image), "{matrix}");
            }
            assert!(right(&before, place(&before, Vec2::from_angle(1.2))));
        }
    }
}
