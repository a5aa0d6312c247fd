//! A vertex's sectors: the parts of the surface around it that one flat splat each can show.
//!
//! **The rule.** Faces that meet over less than a crease's bend are one sector, as in [`super::creases`]. A sector one of whose faces
//! is tilted by more than 30° against the sector's normal is told apart at smaller bends, at last into its faces: at the
//! tip of a cone no edge is a crease, and yet a disk across its axis floats. A sector of much more than half a turn that
//! has borders is cut in the middle, since an ellipse that covers it would stand out into its gap.

use std::f64::consts::PI;

use glam::DVec3;

use super::creases::{COS_CREASE, Corner, Face, Surfaces};
use crate::scene::Mesh;

/// Cosine of the largest tilt of a face against its sector's normal, 30°.
pub(super) const COS_TILT: f64 = 0.866;

/// Cosines of the bends at which sectors are told apart until none is folded: 40°, 20°, 10°; then each face is alone.
const COS_BENDS: [f64; 4] = [COS_CREASE, 0.940, 0.985, 2.0];

/// How much of a turn a sector with borders may have.
const WIDEST: f64 = 1.2 * PI;

/// Tells the sectors of vertices apart, one vertex after the other.
pub(super) struct Sectors<'a> {
    mesh: &'a Mesh,
    faces: &'a [Option<Face>],
    surfaces: Surfaces,
}

impl<'a> Sectors<'a> {
    pub(super) fn of(mesh: &'a Mesh, faces: &'a [Option<Face>]) -> Self {
        Self { mesh, faces, surfaces: Surfaces::default() }
    }

    /// The sectors among the corners around a vertex, each with the mean of its faces' normals weighted by angle. Corners
    /// of degenerate triangles are in none.
    pub(super) fn find(&mut self, around: &[Corner]) -> Vec<(Vec<Corner>, DVec3)> {
        let mut sectors = Vec::new();
        for cos_bend in COS_BENDS {
            let count = self.surfaces.find(self.mesh, self.faces, around, cos_bend);
            let mut groups = vec![Vec::new(); count];
            for (corner, &surface) in around.iter().zip(&self.surfaces.of_corners) {
                if self.face(*corner).is_some() {
                    groups[surface].push(*corner);
                }
            }
            groups.retain(|group| !group.is_empty());
            sectors = groups.into_iter().map(|group| self.with_normal(group)).collect();
            if sectors.iter().all(|(group, normal)| !self.folded(group, *normal)) {
                break;
            }
        }
        sectors.into_iter().flat_map(|sector| self.halves(sector)).collect()
    }

    pub(super) fn face(&self, corner: Corner) -> Option<&Face> {
        self.faces[corner.triangle as usize].as_ref()
    }

    fn angle(&self, corner: Corner) -> f64 {
        self.face(corner).map_or(0.0, |face| face.angles[usize::from(corner.place)])
    }

    fn with_normal(&self, group: Vec<Corner>) -> (Vec<Corner>, DVec3) {
        let weighted =
            |corner: &Corner| self.angle(*corner) * self.face(*corner).map_or(DVec3::ZERO, |f| f.normal);
        let sum: DVec3 = group.iter().map(weighted).sum();
        (group, sum.try_normalize().unwrap_or_default())
    }

    fn folded(&self, group: &[Corner], normal: DVec3) -> bool {
        group.iter().filter_map(|corner| self.face(*corner)).any(|face| face.normal.dot(normal) < COS_TILT)
    }

    /// A sector that is too wide as two; each other one as it is.
    fn halves(&self, (group, normal): (Vec<Corner>, DVec3)) -> Vec<(Vec<Corner>, DVec3)> {
        let whole: f64 = group.iter().map(|corner| self.angle(*corner)).sum();
        let fan = if whole > WIDEST { self.fan(&group) } else { None };
        let Some(mut fan) = fan else { return vec![(group, normal)] };
        let mut turned = 0.0;
        let middle = fan.iter().position(|corner| {
            turned += self.angle(*corner);
            turned > 0.5 * whole
        });
        let second = fan.split_off(middle.unwrap_or(0).clamp(1, fan.len() - 1));
        vec![self.with_normal(fan), self.with_normal(second)]
    }

    /// The corners in order from one border of the sector to the other; `None` where it goes around, or is no fan.
    fn fan(&self, group: &[Corner]) -> Option<Vec<Corner>> {
        let ends = |corner: Corner| {
            let (vertices, place) =
                (self.mesh.triangles[corner.triangle as usize], usize::from(corner.place));
            [vertices[(place + 1) % 3], vertices[(place + 2) % 3]]
        };
        let all: Vec<[u32; 2]> = group.iter().map(|corner| ends(*corner)).collect();
        // Time is the square of how many there are; more are no sector that one would cut.
        if group.len() > 64 {
            return None;
        }
        let alone = |end: u32| all.iter().flatten().filter(|other| **other == end).count() == 1;
        let mut end = all.iter().flatten().copied().find(|end| alone(*end))?;
        let mut left: Vec<usize> = (0..group.len()).collect();
        let mut fan = Vec::new();
        while let Some(at) = left.iter().position(|&i| all[i].contains(&end)) {
            let i = left.swap_remove(at);
            end = if all[i][0] == end { all[i][1] } else { all[i][0] };
            fan.push(group[i]);
        }
        (left.is_empty() && fan.len() > 1).then_some(fan)
    }
}
