//! The splats of a vertex: one round disk where the surface goes on around it, else one for each flat part, which ends
//! where the surface turns.
//!
//! A round disk of the hole-free radius times the overlap stays wherever no side of the vertex's triangles turns below it: so
//! smooth meshes are what they were.

use glam::{DVec2, DVec3};

use super::{
    bounded::{Ellipse, Limit, ellipse},
    cells::cell,
    corners,
    creases::{Corner, Face, corners_of_vertices},
    radii::{MIN_COS_TILT, hole_free_radius},
    sectors::{COS_TILT, Sectors},
    surface::Surface,
    turns::turning_sides,
};
use crate::scene::{Mesh, Shapes};

/// A splat, and the vertex whose color it has.
#[derive(Clone, Copy, Debug)]
pub(super) struct FlatSplat {
    pub vertex: usize,
    pub position: DVec3,
    pub shape: Shape,
}

/// The orientation and size of a splat.
#[derive(Clone, Copy, Debug)]
pub(super) enum Shape {
    Round { normal: DVec3, radius: f64 },
    Ellipse { s: DVec3, t: DVec3 },
}

/// The splats of all vertices that have a face, in the order of those. `radii` are the round disks', `overlap` times the
/// hole-free ones.
pub(super) fn flat_splats(mesh: &Mesh, surface: &Surface, radii: &[f64], overlap: f64) -> Vec<FlatSplat> {
    let faces: Vec<Option<Face>> = mesh.triangles.iter().map(|&triangle| Face::of(mesh, triangle)).collect();
    let turning = turning_sides(mesh, &faces);
    let (starts, list) = corners_of_vertices(mesh);
    let of_file = |vertex: usize| {
        let normals = mesh.normals.as_ref().filter(|normals| normals.len() == mesh.positions.len());
        normals.is_some_and(|normals| normals[vertex].as_dvec3().try_normalize().is_some())
    };
    let mut maker = Maker {
        mesh,
        turning: &turning,
        sectors: Sectors::of(mesh, &faces),
        sign: if surface.report.turned { -1.0 } else { 1.0 },
        overlap,
    };
    let mut splats = Vec::with_capacity(mesh.positions.len());
    for vertex in (0..mesh.positions.len()).filter(|&vertex| surface.used[vertex]) {
        let around = &list[starts[vertex]..starts[vertex + 1]];
        let round = Shape::Round { normal: surface.normals[vertex], radius: radii[vertex] };
        let whole = FlatSplat { vertex, position: mesh.positions[vertex], shape: round };
        maker.add(whole, around, of_file(vertex), &mut splats);
    }
    splats
}

/// As the arrays of a scene. Only where all are round they are disks.
pub(super) fn shapes(splats: &[FlatSplat]) -> Shapes {
    let round = |splat: &FlatSplat| match splat.shape {
        Shape::Round { normal, radius } => Some((normal.as_vec3(), radius as f32)),
        Shape::Ellipse { .. } => None,
    };
    if let Some(disks) = splats.iter().map(round).collect::<Option<Vec<_>>>() {
        let (normals, radii) = disks.into_iter().unzip();
        return Shapes::Disks { normals, radii };
    }
    let tangents = splats.iter().map(|splat| match splat.shape {
        Shape::Round { normal, radius } => {
            let (s, t) = basis(normal);
            ((radius * s).as_vec3(), (radius * t).as_vec3())
        }
        Shape::Ellipse { s, t } => (s.as_vec3(), t.as_vec3()),
    });
    let (s, t) = tangents.unzip();
    Shapes::Ellipses { s, t }
}

/// Two unit vectors whose cross product is the unit normal; zero for the normal zero.
fn basis(normal: DVec3) -> (DVec3, DVec3) {
    if normal == DVec3::ZERO {
        return (DVec3::ZERO, DVec3::ZERO);
    }
    let s = normal.any_orthonormal_vector();
    (s, normal.cross(s))
}

struct Maker<'a> {
    mesh: &'a Mesh,
    /// By triangle and the opposite corner.
    turning: &'a [[bool; 3]],
    sectors: Sectors<'a>,
    /// −1 where the faces' normals point inward.
    sign: f64,
    overlap: f64,
}

impl Maker<'_> {
    /// Adds the splats of one vertex, whose round disk is `whole`.
    fn add(&mut self, whole: FlatSplat, around: &[Corner], of_file: bool, splats: &mut Vec<FlatSplat>) {
        let Shape::Round { normal, radius } = whole.shape else { return };
        let turns = around.iter().any(|corner| self.turning[corner.triangle as usize].contains(&true));
        let tilted = around
            .iter()
            .filter_map(|corner| self.sectors.face(*corner))
            .any(|face| face.normal.dot(normal).abs() < COS_TILT);
        if !turns && (of_file || !tilted) {
            splats.push(whole);
            return;
        }
        let mut sectors = if of_file { Vec::new() } else { self.sectors.find(around) };
        if sectors.len() < 2 {
            let drawn = around.iter().copied().filter(|corner| self.sectors.face(*corner).is_some());
            let (limits, cells) =
                self.flat(&drawn.collect::<Vec<_>>(), normal, radius, false).unwrap_or_default();
            splats.push(self.bounded(whole, &limits, &cells));
            return;
        }
        for (group, own) in sectors.drain(..) {
            let normal = self.sign * own;
            let triangles = group.iter().filter_map(|corner| {
                let triangle = corners(self.mesh, self.mesh.triangles[corner.triangle as usize])?;
                Some((triangle, usize::from(corner.place)))
            });
            let radius = self.overlap
                * triangles.map(|(p, place)| hole_free_radius(p, place, normal)).fold(0.0, f64::max);
            let round = FlatSplat { shape: Shape::Round { normal, radius }, ..whole };
            let (limits, cells) = self.flat(&group, normal, radius, true).unwrap_or_default();
            splats.push(self.bounded(round, &limits, &cells));
        }
    }

    /// The round splat, or the ellipse in its plane where there are limits.
    fn bounded(&self, round: FlatSplat, limits: &[Limit], cells: &[DVec2]) -> FlatSplat {
        let Shape::Round { normal, .. } = round.shape else { return round };
        let Some(Ellipse { center, across, half }) = ellipse(cells, limits, self.overlap) else {
            return round;
        };
        let (s, t) = basis(normal);
        let lift = |p: DVec2| p.x * s + p.y * t;
        let along = DVec2::new(across.y, -across.x);
        FlatSplat {
            position: round.position + lift(center),
            shape: Shape::Ellipse { s: half.x * lift(along), t: half.y * lift(across) },
            ..round
        }
    }

    /// In the plane of a normal: the lines at which the surface turns below a disk of that radius, and the corners of the
    /// cells. `None` where a face is so steep that it has no extent there.
    fn flat(
        &self,
        group: &[Corner],
        normal: DVec3,
        radius: f64,
        split: bool,
    ) -> Option<(Vec<Limit>, Vec<DVec2>)> {
        let (s, t) = basis(normal);
        let ends = group.iter().flat_map(|corner| self.ends(*corner)).collect::<Vec<_>>();
        let alone = |end: u32| ends.iter().filter(|other| **other == end).take(2).count() == 1;
        let (mut limits, mut cells) = (Vec::new(), Vec::new());
        for corner in group {
            let (triangle, place) = (corner.triangle as usize, usize::from(corner.place));
            let p = corners(self.mesh, self.mesh.triangles[triangle])?;
            let face = self.sectors.face(*corner)?.normal;
            let cos = face.dot(normal);
            if cos.abs() < MIN_COS_TILT {
                return None;
            }
            let flat = |point: DVec3| {
                let away = point - p[place];
                let seen = away - face * (away.dot(normal) / cos);
                DVec2::new(seen.dot(s), seen.dot(t))
            };
            cells.extend(cell(p, place).into_iter().map(flat));
            let [own, next, last] = [0, 1, 2].map(|step| flat(p[(place + step) % 3]));
            let [of_next, of_last] = self.ends(*corner);
            // Each side by the corner opposite to it.
            let sides = [
                (next, last, own, self.turning[triangle][place]),
                (own, next, last, alone(of_next) && (split || self.turning[triangle][(place + 2) % 3])),
                (last, own, next, alone(of_last) && (split || self.turning[triangle][(place + 1) % 3])),
            ];
            for (from, to, inside, turns) in sides {
                if turns && distance_to_side(from, to) < radius {
                    limits.extend(limit(from, to, inside));
                }
            }
        }
        Some((limits, cells))
    }

    /// The vertices at the other ends of a corner's sides.
    fn ends(&self, corner: Corner) -> [u32; 2] {
        let (vertices, place) = (self.mesh.triangles[corner.triangle as usize], usize::from(corner.place));
        [vertices[(place + 1) % 3], vertices[(place + 2) % 3]]
    }
}

/// From the origin.
fn distance_to_side(from: DVec2, to: DVec2) -> f64 {
    let side = to - from;
    let share = (-from.dot(side) / side.length_squared()).clamp(0.0, 1.0);
    (from + share * side).length()
}

fn limit(from: DVec2, to: DVec2, inside: DVec2) -> Option<Limit> {
    let outward = (to - from).perp().try_normalize()?;
    let outward = if (inside - from).dot(outward) > 0.0 { -outward } else { outward };
    // A side of the vertex's own goes through it but for rounding.
    let distance = if from == DVec2::ZERO || to == DVec2::ZERO { 0.0 } else { from.dot(outward).max(0.0) };
    Some(Limit { outward, distance })
}

#[cfg(test)]
mod tests;
