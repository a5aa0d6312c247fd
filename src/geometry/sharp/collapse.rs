//! Edges collapse until few triangles are left (Ivo et al. 2012, section 5.2): a vertex is moved onto a neighbor, which stays where it is, so
//! that ridges always end at vertices of the input and each of their pieces stands for a known part of it.
//!
//! **Which.** Vertices on no ridge may go to any neighbor, those within a ridge along it, corners nowhere. **At what price.** The mean squared
//! distance of the new place to the planes of the vertex's triangles (`quadric`), and for a ridge the square of what the new piece's curve is
//! off, too; where the mesh has colors, a vertex comes later by what they lose (`colored`). **Feasible** is what keeps the topology (vertices that both ends have for neighbors are the third corners of the triangles between
//! them), turns no triangle by more than 60°, leaves a curve to the ridge, and that curve within the ellipses of its triangles. Where an error is
//! given, it also lets no ellipse stand off the surface by more (`standing`).
//!
//! **In passes.** Each vertex around which something changed finds its cheapest collapse, at the same time as all others; from the cheapest on those are done that are feasible and
//! whose neighborhoods are untouched. So the result does not depend on threads, and no queue is kept.

use std::collections::{BinaryHeap, HashMap};

use glam::DVec3;
use rayon::prelude::*;

use super::{
    around::{Around, Marks},
    choice::{Candidate, Later, Target, sort_cheapest},
    colored::Colored,
    fit::{Fitted, fit},
    quadric::Quadric,
    ridges::{Kind, Ridges},
};
use crate::progress::Progress;

/// The part of all candidates that a pass collapses at the most: the next ones may be cheaper after it.
const PART_A_PASS: f64 = 0.125;

/// The same where fewer than twice as many triangles are left as there shall be: what is cheapest is worth most at the end, when passes cost least.
const PART_NEAR_THE_END: f64 = 0.03;

/// A piece of a ridge, from a vertex to another.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub ends: [u32; 2],
    pub fitted: Fitted,
    /// Of the chain, with the numbers of its vertices that the piece reaches.
    pub chain: u32,
    pub places: [u32; 2],
}

/// When it ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Goal {
    pub triangles: usize,
    /// The largest price, as a length.
    pub most_error: f64,
}

/// A chain some of whose vertices are gone.
pub(super) struct Links {
    pub next: Vec<u32>,
    pub last: Vec<u32>,
    /// Of the piece that begins there; `None` where it has no curve: it turns by too much.
    pub fitted: Vec<Option<Fitted>>,
}

/// A mesh on its way.
pub(super) struct State<'a> {
    pub(super) positions: &'a [DVec3],
    pub(super) ridges: &'a Ridges,
    pub triangles: Vec<[u32; 3]>,
    pub colored: Option<Colored>,
    /// The largest price that was paid.
    paid: f64,
    pub(super) quadrics: Vec<Quadric>,
    pub(super) links: Vec<Links>,
    /// Of chains between two corners.
    pub(super) between: HashMap<(u32, u32), u32>,
    /// Those of the last pass.
    candidates: Vec<Candidate>,
    /// Vertices of triangles that it changed: others may go where they could before.
    changed: Vec<bool>,
}

impl<'a> State<'a> {
    /// A sound mesh as it is. `normals` are the triangles'; `colored`: where it has colors.
    pub fn new(
        positions: &'a [DVec3],
        triangles: Vec<[u32; 3]>,
        normals: &[DVec3],
        ridges: &'a Ridges,
        colored: Option<Colored>,
    ) -> Self {
        let mut quadrics = vec![Quadric::default(); positions.len()];
        for (&[a, b, c], &normal) in triangles.iter().zip(normals) {
            let [p, q, r] = [a, b, c].map(|i| positions[i as usize]);
            let plane = Quadric::of_plane(normal, p, 0.5 * (q - p).cross(r - p).length());
            [a, b, c].into_iter().for_each(|i| quadrics[i as usize].add(&plane));
        }
        let links = ridges.chains.par_iter().map(|chain| {
            let count = chain.len() as u32;
            let ends = |pair: &[u32]| fit(&[positions[pair[0] as usize], positions[pair[1] as usize]]);
            Links {
                next: (1..=count).collect(),
                last: (0..count).map(|i| i.saturating_sub(1)).collect(),
                fitted: chain.windows(2).map(ends).collect(),
            }
        });
        let links = links.collect();
        let mut between = HashMap::new();
        for (number, chain) in ridges.chains.iter().enumerate() {
            let (a, b) = (chain[0], chain[chain.len() - 1]);
            between.insert((a.min(b), a.max(b)), number as u32);
        }
        let (candidates, changed) = (Vec::new(), vec![true; positions.len()]);
        Self {
            positions,
            ridges,
            triangles,
            colored,
            paid: 0.0,
            quadrics,
            links,
            between,
            candidates,
            changed,
        }
    }

    /// Collapses edges until the goal is reached, or nothing can be.
    pub fn collapse(&mut self, goal: Goal, progress: &dyn Progress) {
        const TASK: &str = "collapse edges";
        let start = self.triangles.len();
        let to_do = start.saturating_sub(goal.triangles).max(1) as u64;
        while self.triangles.len() > goal.triangles {
            progress.step(TASK, (start - self.triangles.len()) as u64, to_do);
            if self.pass(goal) == 0 {
                break;
            }
        }
        progress.step(TASK, to_do, to_do);
    }

    /// The largest error of a collapse, as a length.
    pub fn error(&self) -> f64 {
        self.paid.sqrt()
    }

    pub(super) fn place(&self, vertex: u32) -> DVec3 {
        self.positions[vertex as usize]
    }

    /// How many collapses were done.
    fn pass(&mut self, goal: Goal) -> usize {
        let around = Around::of(self.positions.len(), &self.triangles);
        let mut candidates = std::mem::take(&mut self.candidates);
        candidates.retain(|candidate| !self.changed[candidate.from as usize]);
        let changed = (0..self.positions.len() as u32)
            .into_par_iter()
            .filter(|vertex| self.changed[*vertex as usize] && !around.of_vertex(*vertex).is_empty())
            .filter_map(|vertex| self.cheapest(vertex, &around, goal.most_error));
        candidates.par_extend(changed);
        let part = if self.triangles.len() / 2 > goal.triangles { PART_A_PASS } else { PART_NEAR_THE_END };
        let most_done = 1 + (candidates.len() as f64 * part) as usize;
        let mut locked = vec![false; self.positions.len()];
        let mut became: Vec<u32> = (0..self.positions.len() as u32).collect();
        let mut marks = Marks::new(self.positions.len());
        let (mut done, mut waiting, mut left) = (0, 0, self.triangles.len());
        // Second choices of those before, by their own rank.
        let mut later: BinaryHeap<Later> = BinaryHeap::new();
        let (mut next, mut sorted) = (0, 0);
        while left > goal.triangles && done + waiting < most_done {
            // Few of all are looked at: no more than that are sorted.
            if next == sorted {
                sorted += sort_cheapest(&mut candidates[sorted..], 2 * most_done);
            }
            let fresh = candidates.get(next).map_or(f64::INFINITY, |candidate| candidate.best.rank);
            let again = later.peek().map_or(f64::INFINITY, |later| later.rank);
            if fresh.min(again) == f64::INFINITY {
                break;
            }
            let (number, choice) = if again <= fresh {
                let Some(Later { candidate, choice, .. }) = later.pop() else { break };
                (candidate, choice)
            } else {
                next += 1;
                (next - 1, 0)
            };
            let candidate = &candidates[number];
            let from = candidate.from;
            if locked[from as usize] {
                continue;
            }
            let target = match choice {
                0 => Some(candidate.best),
                _ => self.targets(candidate, &around, goal.most_error).get(choice).copied(),
            };
            let Some(Target { price, to, .. }) = target else { continue };
            if goal.most_error.is_finite() && self.changes_beside(from, &around, &locked) {
                // To a count, it is its turn in the next pass, before those that cost more.
                waiting += usize::from(goal.triangles > 0);
                continue;
            }
            let piece = candidate.piece.as_deref();
            let curve = piece.map(|piece| (piece.other_end(to), &piece.fitted.conic));
            let is_feasible = !locked[to as usize]
                && self.is_feasible(from, to, &around, &mut marks, curve, goal.most_error);
            if !is_feasible {
                let choice = choice + 1;
                let next = self.targets(candidate, &around, goal.most_error).get(choice).copied();
                later.extend(next.map(|next| Later { rank: next.rank, candidate: number, choice }));
                continue;
            }
            for &triangle in around.of_vertex(from) {
                let corners = self.triangles[triangle as usize];
                left -= usize::from(corners.contains(&to));
                corners.into_iter().for_each(|vertex| locked[vertex as usize] = true);
            }
            let fan = self.colored.is_some().then(|| self.fan(from, piece, &around));
            if let Some((colored, fan)) = self.colored.as_mut().zip(fan) {
                colored.collapse(self.positions, &fan, to);
            }
            became[from as usize] = to;
            let moved = self.quadrics[from as usize];
            self.quadrics[to as usize].add(&moved);
            self.shorten(from, piece.map(|piece| piece.fitted));
            (done, self.paid) = (done + 1, self.paid.max(price));
        }
        self.triangles.par_iter_mut().for_each(|triangle| *triangle = triangle.map(|i| became[i as usize]));
        let is_left = |[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
        if let Some(colored) = &mut self.colored {
            colored.keep(&self.triangles.iter().map(is_left).collect::<Vec<_>>());
        }
        self.triangles.retain(is_left);
        (self.candidates, self.changed) = (candidates, locked);
        done
    }

    /// Takes a vertex out of its chain.
    fn shorten(&mut self, vertex: u32, fitted: Option<Fitted>) {
        let Kind::Ridge { chain, place } = self.ridges.kinds[vertex as usize] else { return };
        let links = &mut self.links[chain as usize];
        let (last, next) = (links.last[place as usize], links.next[place as usize]);
        (links.next[last as usize], links.last[next as usize]) = (next, last);
        links.fitted[last as usize] = fitted;
    }

    /// The pieces of the ridges between the vertices that are left.
    pub fn pieces(&self) -> Vec<Piece> {
        let mut pieces = Vec::new();
        for (chain, (vertices, links)) in self.ridges.chains.iter().zip(&self.links).enumerate() {
            let mut place = 0;
            while place < vertices.len() - 1 {
                let next = links.next[place] as usize;
                if let Some(fitted) = links.fitted[place] {
                    let ends = [vertices[place], vertices[next]];
                    let places = [place as u32, next as u32];
                    pieces.push(Piece { ends, fitted, chain: chain as u32, places });
                }
                place = next;
            }
        }
        pieces
    }
}
