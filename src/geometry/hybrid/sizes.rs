//! How large splats may be where they lie over polygons: a splat is flat, and what it covers beyond a transition edge may bend away
//! below it, so that its rim would stick out of the polygons' outline.
//!
//! **On the edge** a splat is as large as those inside, or so small that no polygon within its radius is more than [`STAND_OFF`]
//! of the mesh's size away from its plane. Over a face tilted by θ that is `STAND_OFF · size / sin θ`.
//!
//! **Beside the edge** sizes grow by [`GROWTH`] of the distance from it, and no faster along it. A splat at the distance d from an edge
//! where they begin at ρ reaches over it by ρ − 3d/4 at most. Samples are the denser there: their number in an
//! area is as its inverse square. Over flat triangles large splats stand off farther than small ones. The faster sizes grow, the more do
//! single ones stick out of an outline between both.
//!
//! **Bounds.** No splat is smaller than [`LEAST`] of those inside, so that a sharp edge, whose splats would have to be nothing,
//! has at most [`LEAST`]⁻² samples in the place of one.

use glam::DVec3;

use super::{
    chains::{Chains, Place},
    pieces::Pieces,
};
use crate::{
    geometry::neighbors::{Nearest, Point, Tree},
    scene::{Bounds, Mesh},
};

/// How far a splat on a transition edge may stand off the polygons, as a share of the mesh's size (the diagonal of its box): half a
/// pixel where it fills a picture of 1024.
pub(super) const STAND_OFF: f64 = 1.0 / 2000.0;

/// How fast sizes grow with the distance from the edge.
const GROWTH: f64 = 0.25;

/// The least radius, in radii of the splats inside.
pub(super) const LEAST: f64 = 1.0 / 8.0;

/// Transition edges are marked so densely that the nearest mark is as good as the nearest place: at the clearance of the smallest
/// splats (`near`) it is 8% farther at most.
pub(super) const MARKS_PER_RADIUS: f64 = 4.0 / LEAST;

/// The radii of splats on and near the transition edges.
pub(super) struct Sizes {
    marks: Tree,
    /// Around the marks: most of a mesh is far from it.
    bounds: Option<Bounds>,
    /// Of each mark, by its number.
    at_marks: Vec<f64>,
    /// Of splats inside.
    inside: f64,
}

/// The place on transition edges that is nearest to another one.
pub(super) struct EdgePlace {
    pub position: DVec3,
    /// From the other place.
    pub distance: f64,
    /// Of splats on the edge there.
    pub radius: f64,
}

impl Sizes {
    /// Sizes without polygons to stand off: those inside, everywhere.
    pub(super) fn even(chains: &Chains, inside: f64) -> Self {
        let marks = chains.places(inside / MARKS_PER_RADIUS);
        let boxes = marks.iter().map(|mark| Bounds::of_ball(mark.position, 0.0));
        let bounds = boxes.reduce(Bounds::union);
        let at_marks = vec![inside; marks.len()];
        Self { marks: tree(marks.iter().map(|mark| mark.position)), bounds, at_marks, inside }
    }

    /// Those beside the polygons of a mesh.
    pub(super) fn of(mesh: &Mesh, polygon: &[bool], chains: &Chains, inside: f64) -> Self {
        let even = Self::even(chains, inside);
        let size = mesh.bounds().map_or(0.0, |bounds| bounds.min.distance(bounds.max));
        let longest = |middle: DVec3, reach: f64| {
            let away = even.distance(middle, inside + reach).map_or(f64::INFINITY, |away| away - reach);
            if away < inside { (0.25 * away).max(LEAST * inside) } else { f64::INFINITY }
        };
        let polygons = Pieces::of(mesh, &|triangle| polygon[triangle], &longest);
        let mut corners: Vec<u32> = polygons.mesh.triangles.iter().flatten().copied().collect();
        corners.sort_unstable();
        corners.dedup();
        let polygons = tree(corners.into_iter().map(|vertex| polygons.mesh.positions[vertex as usize]));
        // As dense as the smallest splats.
        let places = chains.places(LEAST * inside);
        let alone: Vec<f64> =
            places.iter().map(|place| largest(place, &polygons, STAND_OFF * size, inside)).collect();
        let small = (0..).zip(&places).filter(|(number, _): &(u32, _)| alone[*number as usize] < inside);
        let small =
            Tree::new(small.map(|(number, place)| Point { position: place.position, number }).collect());
        let mut at_marks = even.at_marks;
        for mark in even.marks.points() {
            let radius = &mut at_marks[mark.number as usize];
            small.within(mark.position, (1.0 - LEAST) * inside / GROWTH, &mut |small, distance| {
                *radius = radius.min(alone[small.number as usize] + GROWTH * distance);
            });
        }
        Self { at_marks, ..even }
    }

    /// Whether splats are as large as inside everywhere.
    pub(super) fn are_even(&self) -> bool {
        self.at_marks.iter().all(|radius| *radius == self.inside)
    }

    /// The radius of splats inside.
    pub(super) fn inside(&self) -> f64 {
        self.inside
    }

    /// The least radius of splats at a place of the surface.
    pub(super) fn at(&self, place: DVec3) -> f64 {
        let near = self.mark(place, self.inside / GROWTH);
        near.map_or(self.inside, |near| self.beside(near.number, near.distance))
    }

    /// The nearest mark that is less than `reach` away.
    fn mark(&self, place: DVec3, reach: f64) -> Option<Nearest> {
        let Bounds { min, max } = self.bounds?;
        let near = place.distance(place.clamp(min, max)) < reach;
        near.then(|| self.marks.nearest_to(place, reach)).flatten()
    }

    fn beside(&self, mark: u32, distance: f64) -> f64 {
        (self.at_marks[mark as usize] + GROWTH * distance).min(self.inside)
    }

    /// How far a place is from the transition edges, where that is less than `reach`.
    pub(super) fn distance(&self, place: DVec3, reach: f64) -> Option<f64> {
        self.mark(place, reach).map(|near| near.distance)
    }

    /// The nearest place on transition edges; none beyond `reach` of the radii inside.
    pub(super) fn nearest(&self, place: DVec3, reach: f64) -> Option<EdgePlace> {
        let Nearest { distance, position, number } = self.mark(place, reach * self.inside)?;
        Some(EdgePlace { position, distance, radius: self.at_marks[number as usize] })
    }

    /// The splat part's pieces, small enough that sizes are about the same within each.
    pub(super) fn pieces(&self, mesh: &Mesh, polygon: &[bool]) -> Pieces {
        let longest = |middle: DVec3, reach: f64| {
            let at = self.at(middle);
            if at - GROWTH * reach < self.inside { 0.5 * at } else { f64::INFINITY }
        };
        Pieces::of(mesh, &|triangle| !polygon[triangle], &longest)
    }
}

/// The largest splat on an edge that stands off no polygon by more than `stand_off`.
fn largest(mark: &Place, polygons: &Tree, stand_off: f64, inside: f64) -> f64 {
    let off = |position: DVec3| (position - mark.position).dot(mark.normal).abs();
    let first = polygons.nearest_of(mark.position, inside, &|position| off(position) > stand_off);
    first.map_or(inside, |first| {
        let radius = first.distance * stand_off / off(first.position);
        radius.clamp(LEAST * inside, inside)
    })
}

fn tree(positions: impl Iterator<Item = DVec3>) -> Tree {
    Tree::new((0..).zip(positions).map(|(number, position)| Point { position, number }).collect())
}
