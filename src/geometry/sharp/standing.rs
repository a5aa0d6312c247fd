//! How far an ellipse stands off the surface over sides of triangles that are no ridge, where it goes on in the plane of its own triangle and the surface
//! bends away.
//!
//! **While edges collapse**, over a side between two triangles: ellipses are images of circles around equilateral triangles (`ellipse`), which reach beyond a
//! side by a third of the height over it. So of triangles with normals a and b, as long as twice their areas, over a side of length l one reaches by |a| / 3l,
//! and stands off the plane of the other one by the sine of the angle between them as much.
//!
//! **Of what is made**: the largest distance from places of the rim that clips leave, on each side between the corners of its triangle, to the
//! nearest of the triangles that it reaches over. Of these a ridge is no end, for up to its curve the surface goes on.

use glam::{DVec2, DVec3};

use super::{around::Around, clips::COS_BENT, collapse::State, model::Model, ridges::Kind};
use crate::{geometry::clip::removes, scene::Clip};

/// Cosine of half a ten-thousandth: what bends by less is flat.
const COS_FLAT: f64 = 1.0 - 1e-9;

/// Where the rim is looked at on each side, radians from the middle between two corners.
const PLACES_RAD: [f64; 7] = [-0.9, -0.6, -0.3, 0.0, 0.3, 0.6, 0.9];

/// An ellipse in its plane.
pub(super) struct Disk {
    pub center: DVec3,
    pub s: DVec3,
    pub t: DVec3,
}

impl Disk {
    /// u and v of a place, as x and y.
    pub fn flat(&self, place: DVec3) -> DVec3 {
        let away = place - self.center;
        let along = |axis: DVec3| away.dot(axis / axis.length_squared());
        DVec3::new(along(self.s), along(self.t), 0.0)
    }

    /// How far what a clip leaves stands off, over triangles the first of which is its own. `p`: the corners through which it passes.
    pub fn stands_off(&self, model: &Model<'_>, p: [DVec3; 3], reached: &[usize], clip: &Clip) -> f64 {
        let own = model.normals[reached[0]];
        if reached.iter().all(|of| own.dot(model.normals[*of]) >= COS_FLAT) {
            return 0.0;
        }
        let middles = p.map(|corner| -self.flat(corner).truncate());
        let places = middles.iter().flat_map(|m| PLACES_RAD.map(|angle| DVec2::from_angle(angle).rotate(*m)));
        let off = |uv: DVec2| {
            let place = self.center + uv.x * self.s + uv.y * self.t;
            reached.iter().map(|of| distance(place, model, *of)).fold(f64::INFINITY, f64::min)
        };
        places.filter(|uv| !removes(clip, *uv)).map(off).fold(0.0, f64::max)
    }
}

/// To a triangle, which has no end where it has a ridge.
fn distance(place: DVec3, model: &Model<'_>, triangle: usize) -> f64 {
    let (corners, normal) = (model.triangles[triangle], model.normals[triangle]);
    let mut nearest = None::<f64>;
    for i in 0..3 {
        let (from, to) = (corners[i], corners[(i + 1) % 3]);
        let [a, b] = [from, to].map(|vertex| model.positions[vertex as usize]);
        let (away, side) = (place - a, b - a);
        if normal.cross(side).dot(away) < 0.0 && model.piece(from, to).is_none() {
            let share = (away.dot(side) / side.length_squared()).clamp(0.0, 1.0);
            let off = (away - share * side).length();
            nearest = Some(nearest.map_or(off, |nearest| nearest.min(off)));
        }
    }
    nearest.unwrap_or_else(|| (place - model.positions[corners[0] as usize]).dot(normal).abs())
}

/// Of both ellipses beside a side, by the normals of their triangles, as long as twice their areas.
fn over_side(side: DVec3, [a, b]: [DVec3; 2]) -> f64 {
    let [long, wide] = [a.length(), b.length()];
    if a.dot(b) < COS_BENT * long * wide {
        // Each ends there.
        return 0.0;
    }
    a.cross(b).length() / (3.0 * side.length() * long.min(wide))
}

impl State<'_> {
    /// How far ellipses of triangles around a vertex stand off those beside them, and these off them. `to`: once it lies there, and has a
    /// ridge to `new_end`.
    pub fn stands_off(&self, from: u32, to: Option<u32>, around: &Around, new_end: Option<u32>) -> f64 {
        let moved = |corners: [u32; 3]| {
            corners.map(|vertex| if vertex == from { to.unwrap_or(from) } else { vertex })
        };
        let of_vertex = |vertex: u32| around.of_vertex(vertex).iter().map(|i| self.triangles[*i as usize]);
        let stays = |corners: &[u32; 3]| to.is_none_or(|to| !corners.contains(&to));
        let fan: Vec<[u32; 3]> = of_vertex(from).filter(stays).map(moved).collect();
        let normal = |corners: [u32; 3]| {
            let [p, q, r] = corners.map(|i| self.place(i));
            (q - p).cross(r - p)
        };
        let beyond = |a: u32, b: u32| {
            let passes = |corners: &[u32; 3]| (0..3).any(|i| corners[i] == b && corners[(i + 1) % 3] == a);
            let beside = || of_vertex(a).find(|corners| !corners.contains(&from) && passes(corners));
            fan.iter().copied().find(passes).or_else(beside)
        };
        let is_new = |a: u32, b: u32| {
            to.zip(new_end).is_some_and(|(to, end)| [(to, end), (end, to)].contains(&(a, b)))
        };
        let mut most = 0.0_f64;
        for &corners in &fan {
            for i in 0..3 {
                let (a, b) = (corners[i], corners[(i + 1) % 3]);
                if is_new(a, b) || self.is_ridge(a, b) {
                    continue;
                }
                if let Some(other) = beyond(a, b) {
                    most = most.max(over_side(self.place(b) - self.place(a), [corners, other].map(normal)));
                }
            }
        }
        most
    }

    /// Whether a triangle beside those of a vertex changes in the same pass: both could come to stand off by more than either was asked about.
    pub fn changes_beside(&self, vertex: u32, around: &Around, locked: &[bool]) -> bool {
        around.of_vertex(vertex).iter().any(|i| {
            self.triangles[*i as usize].iter().filter(|corner| locked[**corner as usize]).count() > 1
        })
    }

    fn is_ridge(&self, a: u32, b: u32) -> bool {
        let is_smooth = |vertex: u32| self.ridges.kinds[vertex as usize] == Kind::Smooth;
        !is_smooth(a) && !is_smooth(b) && self.piece_between(a, b).is_some()
    }
}
