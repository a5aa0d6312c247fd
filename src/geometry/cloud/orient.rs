//! The sides of normals, found along a spanning tree (Hoppe, DeRose, Duchamp, McDonald, Stuetzle, "Surface Reconstruction from
//! Unorganized Points", 1992).
//!
//! The graph joins each point with its neighbors; the tree that joins all at the least cost hands the side on. Two rules
//! differ from the paper's:
//! - A normal is compared with the other's mirror image in the plane halfway between the two points, not with the other itself.
//!   On a sphere the two are equal, however far apart, across a right-angled edge they agree, and two sides of a plate oppose.
//! - An edge that does not lie in both planes costs more, so that it is taken last: with noise, points of one surface lie
//!   above each other, too.
//!
//! Sets of points know their side against the set's first. Edges that are [`SURE`] join them in any order, as they do not contradict each other; the
//! rest of the tree is found by Kruskal's algorithm on costs in 256 steps, of what edges are left between sets.
//!
//! **Sheets.** Edges that cost [`SHEET_COST`] or more join no points, but the sheets that the others made: all between two of them vote,
//! each with what the mirror tells over the fourth power of its length. Of two parallel sheets, h apart and one above the other, an edge
//! to a point r beside the one below tells (r² − h²) / (r² + h²); the sum over all r of that by (r² + h²)⁻² is negative whatever the reach,
//! so that they oppose as sides of a plate, although most edges may be slanted, and tell that they are one surface.

use std::collections::BTreeMap;

use glam::DVec3;
use rayon::prelude::*;

use super::plane::NEIGHBORS;

/// Sets of places, and of each place on which side it is against its set's root: bit 31 of the parent.
struct Sets(Vec<u32>);

/// The length of the mean normal above which a surface is a sheet. That of half a ball is 1/2.
const SHEET: f64 = 0.7;

/// Edges of which that product is larger join at once: the two normals and the edge are within some 5° of one plane.
const SURE: f64 = 0.98;

/// Below, the product of what the mirror tells and of how far an edge lies in both planes is more than 0.8.
const SHEET_COST: usize = 114;

/// So many points may be a sheet.
const FEWEST_OF_SHEET: u32 = 100;

/// The other side.
const TURNED: u32 = 1 << 31;

impl Sets {
    /// The root of a place, and its side against it in bit 31.
    fn root(&mut self, place: u32) -> u32 {
        let (mut at, mut side) = (place, 0);
        loop {
            let up = self.0[at as usize];
            let parent = up & !TURNED;
            if parent == at {
                return at | side;
            }
            // Halve the path: a place that is two below a root is then one below.
            let above = self.0[parent as usize];
            let short = (above & !TURNED) | ((above ^ up) & TURNED);
            if above & !TURNED != parent {
                self.0[at as usize] = short;
            }
            side ^= short & TURNED;
            at = short & !TURNED;
        }
    }

    fn join(&mut self, a: u32, b: u32, turned: bool) {
        let (a, b) = (self.root(a), self.root(b));
        let (low, high) = ((a & !TURNED).min(b & !TURNED), (a & !TURNED).max(b & !TURNED));
        if low != high {
            self.0[high as usize] = low | ((a ^ b) & TURNED) ^ if turned { TURNED } else { 0 };
        }
    }

    /// Joins places along edges that leave no doubt.
    fn join_sure(&mut self, positions: &[DVec3], neighbors: &[[u32; NEIGHBORS]], normals: &[DVec3]) {
        for (i, near) in neighbors.iter().enumerate() {
            let mut own = self.root(i as u32);
            for &j in near.iter().filter(|j| **j != u32::MAX) {
                if (own ^ self.root(j)) & !TURNED == 0 {
                    continue;
                }
                let along = positions[j as usize] - positions[i];
                match told(along, normals[i], normals[j as usize]) {
                    Some(told) if told.agreement.abs() * told.in_planes > SURE => {
                        self.join(i as u32, j, told.agreement < 0.0);
                        own = self.root(i as u32);
                    }
                    _ => {}
                }
            }
        }
    }
}

/// What an edge tells of the sides of two normals: above zero the same, and how sure it is.
#[derive(Clone, Copy)]
struct Told {
    agreement: f64,
    in_planes: f64,
}

/// `None` of an edge that has no length, or none with a reciprocal.
fn told(along: DVec3, a: DVec3, b: DVec3) -> Option<Told> {
    let per_squared = along.length_squared().recip();
    let (out_a, out_b) = (along.dot(a), along.dot(b));
    per_squared.is_normal().then(|| Told {
        agreement: a.dot(b) - 2.0 * out_a * out_b * per_squared,
        in_planes: (1.0 - out_a * out_a * per_squared) * (1.0 - out_b * out_b * per_squared),
    })
}

/// The cost of handing the side on along an edge, in 256 steps, and whether the normals are on different sides.
fn edge(along: DVec3, a: DVec3, b: DVec3) -> (u8, bool) {
    let Some(Told { agreement, in_planes }) = told(along, a, b) else { return (u8::MAX, a.dot(b) < 0.0) };
    let cost = (1.0 - agreement.abs() * in_planes).clamp(0.0, 1.0);
    // The root spreads the small costs, of which most are.
    ((255.0 * cost.sqrt()) as u8, agreement < 0.0)
}

/// Turns normals so that they are on one side of each connected surface: outward, where that is known.
///
/// `neighbors` are places, [`NEIGHBORS`] for each, `u32::MAX` for none; `areas` are the shares of the surface.
///
/// **Outward.** By the divergence theorem the sum of area · normal of a closed surface is zero, and that of area · normal ·
/// (position − center) is three times its volume if normals point outward: so they are turned. Where the mean normal is longer
/// than [`SHEET`], the surface is a sheet, of which no side is outside: there its largest component becomes positive.
pub(super) fn orient(
    positions: &[DVec3],
    neighbors: &[[u32; NEIGHBORS]],
    areas: &[f64],
    normals: &mut [DVec3],
) {
    let sets = spanning_tree(positions, neighbors, areas, normals);
    #[derive(Clone, Copy, Default)]
    struct Sum {
        area: f64,
        center: DVec3,
        normal: DVec3,
        outward: f64,
    }
    // A root is the first place of its set.
    let (mut sums, mut numbers) = (Vec::new(), vec![0_u32; positions.len()]);
    for (i, &up) in sets.iter().enumerate() {
        let root = (up & !TURNED) as usize;
        if root == i {
            numbers[i] = sums.len() as u32;
            sums.push(Sum::default());
        }
        if up & TURNED != 0 {
            normals[i] = -normals[i];
        }
        let sum = &mut sums[numbers[root] as usize];
        sum.area += areas[i];
        sum.center += areas[i] * positions[i];
        sum.normal += areas[i] * normals[i];
    }
    let number = |up: u32| numbers[(up & !TURNED) as usize] as usize;
    for (i, &up) in sets.iter().enumerate() {
        let sum = &mut sums[number(up)];
        let from_center = positions[i] - sum.center / sum.area;
        sum.outward += areas[i] * normals[i].dot(from_center);
    }
    let turn = |sum: &Sum| match sum.normal.length() > SHEET * sum.area {
        true => sum.normal[sum.normal.abs().max_position()] < 0.0,
        false => sum.outward < 0.0,
    };
    let turned: Vec<bool> = sums.iter().map(turn).collect();
    for (normal, &up) in normals.iter_mut().zip(&sets) {
        if turned[number(up)] {
            *normal = -*normal;
        }
    }
}

/// Of each place the root of its tree, and its side against it in bit 31.
fn spanning_tree(
    positions: &[DVec3],
    neighbors: &[[u32; NEIGHBORS]],
    areas: &[f64],
    normals: &[DVec3],
) -> Vec<u32> {
    let mut sets = Sets((0..positions.len() as u32).collect());
    sets.join_sure(positions, neighbors, normals);
    let roots: Vec<u32> = (0..positions.len() as u32).map(|place| sets.root(place) & !TURNED).collect();
    // An edge that both ends know counts once.
    let counts = |i: usize, j: u32| {
        j != u32::MAX
            && roots[i] != roots[j as usize]
            && (i < j as usize || !neighbors[j as usize].contains(&(i as u32)))
    };
    let of_place = |i: usize| -> [Option<(u8, bool)>; NEIGHBORS] {
        neighbors[i].map(|j| {
            counts(i, j).then(|| edge(positions[j as usize] - positions[i], normals[i], normals[j as usize]))
        })
    };
    let costs: Vec<_> = (0..positions.len()).into_par_iter().map(of_place).collect();
    // Sorted by counting: where each cost's edges begin.
    let mut begins = [0_usize; 257];
    for (cost, _) in costs.iter().flatten().flatten() {
        begins[usize::from(*cost) + 1] += 1;
    }
    for cost in 0..256 {
        begins[cost + 1] += begins[cost];
    }
    let mut edges = vec![(0_u32, 0_u32); begins[256]];
    for (i, costs) in costs.iter().enumerate() {
        for (&j, edge) in neighbors[i].iter().zip(costs) {
            let Some((cost, turned)) = *edge else { continue };
            let next = &mut begins[usize::from(cost)];
            edges[*next] = (i as u32, j | if turned { TURNED } else { 0 });
            *next += 1;
        }
    }
    drop(costs);
    // Where a cost's edges begin has become where they end.
    let (of_sheets, between) = edges.split_at(begins[SHEET_COST - 1]);
    for &(a, b) in of_sheets {
        sets.join(a, b & !TURNED, b & TURNED != 0);
    }
    // Few points are no sheet, but noise: they join as points do.
    let mut sizes = vec![0_u32; positions.len()];
    (0..positions.len() as u32).for_each(|place| sizes[(sets.root(place) & !TURNED) as usize] += 1);
    for &(a, b) in between {
        let [low, high] = [a, b & !TURNED].map(|place| (sets.root(place) & !TURNED) as usize);
        if low != high && sizes[low].min(sizes[high]) < FEWEST_OF_SHEET {
            sizes[low.min(high)] += sizes[low.max(high)];
            sets.join(a, b & !TURNED, b & TURNED != 0);
        }
    }
    // Of two roots, how surely they are on one side.
    let mut votes: BTreeMap<(u32, u32), f64> = BTreeMap::new();
    for &(a, b) in between {
        let (i, j) = (a as usize, (b & !TURNED) as usize);
        let roots = [sets.root(a), sets.root(j as u32)];
        let [low, high] = roots.map(|root| root & !TURNED);
        if low == high {
            continue;
        }
        let along = positions[j] - positions[i];
        let agreement = told(along, normals[i], normals[j]).map_or(0.0, |told| told.agreement);
        let weight = areas[i] * areas[j] / along.length_squared().powi(2);
        let vote = if weight.is_finite() { weight * agreement } else { 0.0 };
        let is_turned = (roots[0] ^ roots[1]) & TURNED != 0;
        *votes.entry((low.min(high), low.max(high))).or_default() += if is_turned { -vote } else { vote };
    }
    let mut votes: Vec<_> = votes.into_iter().collect();
    votes.sort_by(|(_, a), (_, b)| b.abs().total_cmp(&a.abs()));
    for ((a, b), vote) in votes {
        sets.join(a, b, vote < 0.0);
    }
    (0..positions.len() as u32).map(|place| sets.root(place)).collect()
}
