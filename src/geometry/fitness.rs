//! Whether disks at a mesh's vertices show its surface, or whether it takes more of them, or its own triangles.
//!
//! **The measure.** A disk at a vertex lies in the plane of the vertex's normal and is as large as the triangles around it. Where
//! one of them is tilted by θ against that plane, the rim of a disk of radius r stands `r sin θ` off the surface; at an open border
//! it stands out by r. So density and curvature are one number: a dense mesh may be sharp, since its disks are small, and a coarse one
//! may be splats where it is smooth. A vertex is *rough* where that is more than [`VISIBLE`] of the mesh's size (the diagonal of its
//! box), and the mesh's roughness is the share of its area at such vertices: a floor of two triangles below a dense
//! statue counts as what is seen of it, not as 4 of 100 000 vertices. Measured are the round disks, as if none ended where the mesh
//! turns (`flat_splats.rs`): they tell what the mesh is like, and edges are triangles' to show.
//!
//! **The rule.** At most [`MOST_ROUGH`] of the area: disks at the vertices. More, but less than [`MOST_SPREAD`], and hardly any of it
//! because of folds and borders: the mesh is smooth and uneven (long or very different edges), and disks that are
//! spread evenly show it. Else it is made of faces and edges, and its triangles show it best.
//!
//! Measured: fandisk (6 475 vertices, sharp edges) is 13% rough, a ball of 266 vertices and a cube 100%; igea (134 345 vertices) and a ball
//! of 2 562 vertices are not, so that the threshold decides nothing near to it.

use std::fmt;

use glam::DVec3;

use super::{corners, resample::RADIUS_PER_DISTANCE};
use crate::scene::{Bounds, Mesh};

/// How far disks may stand off the surface, as a share of the mesh's size: two pixels where it fills a picture of 1024.
const VISIBLE: f64 = 1.0 / 500.0;

/// The share of the area that may be rough: holes of a scan, and a few sharp corners, make no furniture of it.
const MOST_ROUGH: f64 = 0.02;

/// The share of rough area from which on the mesh as a whole is coarse.
const MOST_SPREAD: f64 = 0.5;

/// Cosine of the tilt of a fold: 30°, so faces that meet at 60° and more.
const COS_FOLD: f64 = 0.866;

/// The most disks that are spread over a mesh where nobody says how many: what they cost stays bounded.
const MOST_SPREAD_DISKS: f64 = 1e6;

/// As what a mesh is drawn best.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Suited {
    /// Disks at its vertices.
    VertexDisks,
    /// So many disks, spread evenly over its area: so many that none is larger than what is visible, at least as many as
    /// vertices that the surface has, and at most a million or that.
    SpreadDisks(u64),
    /// Its triangles.
    Triangles,
}

/// How well disks at its vertices show a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fitness {
    /// The share of the area at vertices whose disks stand visibly off the surface: 0 to 1.
    pub rough: f64,
    /// The share of the area at rough vertices that are folded by 30° and more or on an open border: at most `rough`.
    pub folded: f64,
    /// The mean distance by which disks of the rough area stand off the surface, as a share of the mesh's size.
    pub off: f64,
    /// The area in squares of the size.
    area: f64,
    /// Vertices that have a face.
    vertices: usize,
}

impl Fitness {
    /// Measures disks of these radii at a mesh's vertices; `normals` are unit or zero. A radius is 0 where there is no face. Borders are
    /// looked for where the mesh has any.
    pub(super) fn of(mesh: &Mesh, normals: &[DVec3], radii: &[f64], has_borders: bool) -> Self {
        let faces = || mesh.triangles.iter().filter_map(|&t| corners(mesh, t).map(|p| (t, p)));
        let boxes = faces().flat_map(|(_, p)| p).map(|corner| Bounds::of_ball(corner, 0.0));
        let Some(size) = boxes.reduce(Bounds::union).map(|bounds| 2.0 * bounds.radius()) else {
            return Self::default();
        };
        let visible = VISIBLE * size;
        // The smallest cosine of a vertex's normal and a face of it.
        let mut tilts = vec![1.0_f64; normals.len()];
        let mut areas = vec![0.0_f64; normals.len()];
        for (triangle, p) in faces() {
            let doubled = (p[1] - p[0]).cross(p[2] - p[0]);
            let face = doubled.normalize();
            for vertex in triangle.map(|vertex| vertex as usize) {
                tilts[vertex] = tilts[vertex].min(normals[vertex].dot(face).abs());
                areas[vertex] += doubled.length() / 6.0;
            }
        }
        // A disk that is smaller than what is visible stands nowhere off by more.
        if has_borders && radii.iter().any(|radius| *radius > visible) {
            mark_borders(mesh, &mut tilts);
        }
        let mut fitness = Self::default();
        let (mut area, mut rough, mut folded, mut off) = (0.0, 0.0, 0.0, 0.0);
        for ((&own, &tilt), &radius) in areas.iter().zip(&tilts).zip(radii) {
            area += own;
            fitness.vertices += usize::from(own > 0.0);
            let stands_off = radius * (1.0 - tilt * tilt).max(0.0).sqrt();
            if stands_off > visible {
                rough += own;
                off += own * stands_off / size;
                folded += if tilt < COS_FOLD { own } else { 0.0 };
            }
        }
        if area > 0.0 && area.is_finite() {
            fitness.rough = rough / area;
            fitness.folded = folded / area;
            fitness.off = if rough > 0.0 { off / rough } else { 0.0 };
            fitness.area = area / (size * size);
        }
        fitness
    }

    /// What the rule makes of it.
    pub fn suited(&self) -> Suited {
        match () {
            () if self.rough <= MOST_ROUGH => Suited::VertexDisks,
            () if self.rough < MOST_SPREAD && self.folded <= MOST_ROUGH => {
                Suited::SpreadDisks(self.spread_disks())
            }
            () => Suited::Triangles,
        }
    }

    /// So many disks, spread evenly over its area, that none stands visibly off it, as [`Suited::SpreadDisks`] has it.
    pub fn spread_disks(&self) -> u64 {
        let distance = VISIBLE / RADIUS_PER_DISTANCE;
        let smallest = (self.area / (distance * distance)).min(MOST_SPREAD_DISKS);
        (smallest as u64).max(self.vertices as u64)
    }
}

/// Takes vertices on an open border as folded: nothing goes on there.
fn mark_borders(mesh: &Mesh, tilts: &mut [f64]) {
    let sides = mesh.triangles.iter().filter(|[a, b, c]| a != b && b != c && c != a);
    let sides = sides.flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    let mut edges: Vec<(u32, u32)> = sides.map(|(from, to)| (from.min(to), from.max(to))).collect();
    edges.sort_unstable();
    for edge in edges.chunk_by(|a, b| a == b).filter(|alike| alike.len() == 1).flatten() {
        for vertex in [edge.0, edge.1] {
            if let Some(tilt) = tilts.get_mut(vertex as usize) {
                *tilt = 0.0;
            }
        }
    }
}

impl fmt::Display for Fitness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [rough, off] = [self.rough, self.off].map(|share| 100.0 * share);
        write!(f, "disks at its vertices would stand {off:.1}% of its size off {rough:.0}% of its surface")
    }
}

#[cfg(test)]
mod tests;
