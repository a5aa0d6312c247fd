//! Splats that reach over polygons end before they stand visibly off them.
//!
//! A splat at the transition lies in the plane of the smooth normal, and the polygons beyond the edge are chords below it: its rim
//! stands `r sin θ` off them, where θ is the angle between both planes. Seen along the surface, that is a fin at the
//! silhouette of the polygons. Where rims would stand off by more than [`MOST_OFF`] of the radius, the splat becomes an
//! ellipse that ends before. One on the edge stays centered, since its weight is wanted there; a sample's inner rim
//! stays, so that its center moves inward. The fade to the polygons is that much shorter; where the mesh is fine or flat
//! nothing changes.

use glam::DVec3;

use super::{chains::Place, near::Near};
use crate::scene::{Shapes, Splats};

/// How far a rim may stand off the polygons, in radii: a pixel where a splat is 64 pixels wide.
const MOST_OFF: f64 = 1.0 / 32.0;

/// The shortest half axis of a splat on the edge, in radii.
const THINNEST: f64 = 1.0 / 8.0;

/// Cosine of the largest angle between a splat and a polygon of one surface: normals of a file may be anything.
const LEAST_FACING: f64 = 0.5;

/// Shortens what stands off. The last `on_edges` of the splats are those on transition edges. Where none is shortened all
/// stay disks.
pub(super) fn end(splats: &mut Splats, on_edges: usize, near: &Near) {
    let Shapes::Disks { normals, radii } = &splats.shapes else { return };
    let first_on_edge = splats.len() - on_edges;
    let mut any = false;
    let (mut s_all, mut t_all) = (Vec::with_capacity(splats.len()), Vec::with_capacity(splats.len()));
    let mut positions = splats.positions.clone();
    for (i, (&normal, &radius)) in normals.iter().zip(radii).enumerate() {
        let (normal, radius) = (normal.as_dvec3(), f64::from(radius));
        let marks = near.within(splats.positions[i], radius);
        let on_edge = i >= first_on_edge;
        let cut = if normal == DVec3::ZERO {
            None
        } else {
            cut(splats.positions[i], normal, radius, &marks, on_edge)
        };
        any |= cut.is_some();
        let s = cut.map_or_else(|| normal.any_orthonormal_vector(), |cut| cut.across);
        let t = normal.cross(s);
        let reach = cut.map_or(radius, |cut| cut.reach);
        let half = match on_edge {
            true => reach.max(THINNEST * radius),
            false => 0.5 * (radius + reach),
        };
        if !on_edge && cut.is_some() {
            positions[i] += (half - radius) * s;
        }
        s_all.push((half * s).as_vec3());
        t_all.push((radius * t).as_vec3());
    }
    if any {
        splats.positions = positions;
        splats.shapes = Shapes::Ellipses { s: s_all, t: t_all };
    }
}

/// In which direction of a splat's plane it ends, and how far from its center.
#[derive(Clone, Copy)]
struct Cut {
    across: DVec3,
    reach: f64,
}

/// The cut that takes most off, if any does.
fn cut(center: DVec3, normal: DVec3, radius: f64, marks: &[Place], on_edge: bool) -> Option<Cut> {
    let cuts = marks.iter().filter_map(|mark| {
        let (polygon, toward) = (mark.beside.polygon, mark.beside.toward);
        // The polygon's side on which the splat is seen.
        let polygon = if polygon.dot(normal) < 0.0 { -polygon } else { polygon };
        if polygon.dot(normal) < LEAST_FACING {
            return None;
        }
        let flat = |v: DVec3| (v - normal * v.dot(normal)).try_normalize();
        let across = if on_edge { flat(toward)? } else { flat(polygon)? };
        // How fast the splat's plane rises over the polygon's on the way.
        let rise = across.dot(polygon);
        let height = (center - mark.position).dot(polygon);
        // What is not over the polygon is no fin.
        if rise <= 0.0 || (center + radius * across - mark.position).dot(toward) <= 0.0 {
            return None;
        }
        let edge = ((mark.position - center).dot(toward) / across.dot(toward).max(1e-3)).clamp(0.0, radius);
        let reach = ((MOST_OFF * radius - height) / rise).max(edge).max(0.0);
        (reach < radius).then_some(Cut { across, reach })
    });
    cuts.min_by(|a, b| a.reach.total_cmp(&b.reach))
}
