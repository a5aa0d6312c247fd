//! The splats of a mesh that is cut into cells: spread evenly over it, and on the edges between cells.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;

use crate::{
    error::Result,
    geometry::{
        hybrid::{
            EDGE_SPACING, HybridReport, SAMPLES, add,
            border::Border,
            chains::{Chains, On, Place},
            check_places, median,
            near::CLEARANCE,
        },
        neighbors::{Point, Tree},
        resample::{Areas, check_memory, radii::radii, sample, vertex_colors},
    },
    progress::Progress,
    scene::{Mesh, Shapes, Splats},
};

/// Transition edges are marked each so many parts of a radius: at the clearance of splats a mark is at most 2% farther than the edge.
const MARKS_PER_RADIUS: f64 = 8.0;

/// Splats, and the cells that each is drawn for.
pub(super) struct Sampled {
    pub splats: Splats,
    pub cells: Vec<Vec<u32>>,
    /// Of each cell those that it meets, rising.
    pub neighbors: Vec<Vec<u32>>,
    pub area_each: f64,
}

/// Samples of a mesh whose triangles lie cell by cell.
pub(super) fn sampled(
    whole: &Mesh,
    cells: &[Range<usize>],
    (count, seed): (usize, u64),
    report: &mut HybridReport,
    progress: &dyn Progress,
) -> Result<Sampled> {
    let colors = vertex_colors(whole);
    check_memory(count, colors.is_some(), SAMPLES)?;
    let areas = Areas::of(whole, &|_| 1.0)?;
    let area_each = areas.total / count as f64;
    let normals: Vec<DVec3> = whole.normals.iter().flatten().map(|normal| normal.as_dvec3()).collect();
    let samples = sample(whole, colors, &normals, &areas, count, seed, progress);
    let mut cell_of = vec![0; whole.triangles.len()];
    (0..).zip(cells).for_each(|(number, cell)| cell_of[cell.clone()].fill(number));
    let border = Border::of(whole, &cell_of);
    let chains = Chains::of(&border);
    let all_radii = radii(&samples.positions, area_each, progress);
    let inside = f64::from(median(&all_radii));
    check_places(&chains, inside, count, colors.is_some())?;
    let mut owners: Vec<u32> = samples.triangles.iter().map(|triangle| cell_of[*triangle as usize]).collect();
    let mut splats = samples.splats(whole, all_radii);

    let marks = (0..).zip(chains.places(inside / MARKS_PER_RADIUS));
    let marks = Tree::new(marks.map(|(number, place)| Point { position: place.position, number }).collect());
    let is_far = |sample: &DVec3| marks.nearest_to(*sample, CLEARANCE * inside).is_none();
    let mut keep: Vec<bool> = splats.positions.par_iter().map(is_far).collect();
    let mut left = vec![0_u32; cells.len()];
    (0..keep.len()).for_each(|i| left[owners[i] as usize] += u32::from(keep[i]));
    // A cell with no splat would have nothing to be drawn as.
    (0..keep.len()).for_each(|i| keep[i] |= left[owners[i] as usize] == 0);
    splats.keep(&keep);
    let mut kept = keep.iter();
    owners.retain(|_| *kept.next().unwrap_or(&true));
    let mut places = chains.places(EDGE_SPACING * inside);
    places.retain(|place| place.normal != DVec3::ZERO);
    report.removed = keep.iter().filter(|keep| !**keep).count();
    report.transition_edges = border.edges.len();
    report.transition_length = chains.length();
    (report.edge_radius, report.edge_splats) = (inside, places.len());
    add(&mut splats, &places, &|_| inside);
    correct_radii(&mut splats, owners.len(), area_each, progress);
    let at_joints = cells_of_joints(&border);
    let on_edges = places.iter().map(|place| cells_of(place, &border, &at_joints));
    let of_splats = owners.into_iter().map(|owner| vec![owner]).chain(on_edges).collect();
    let neighbors = neighbors(&border, &at_joints, cells.len());
    Ok(Sampled { splats, cells: of_splats, neighbors, area_each })
}

/// Of the first splats, which have others beside them now than they were sampled with.
fn correct_radii(splats: &mut Splats, first: usize, area_each: f64, progress: &dyn Progress) {
    let corrected = radii(&splats.positions, area_each, progress);
    if let Shapes::Disks { radii, .. } = &mut splats.shapes {
        radii[..first].copy_from_slice(&corrected[..first]);
    }
}

fn cells_of_joints(border: &Border) -> Vec<Vec<u32>> {
    let mut cells = vec![Vec::new(); border.joints.len()];
    for edge in &border.edges {
        edge.ends.iter().for_each(|joint| cells[*joint].extend(&edge.parts));
    }
    cells.iter_mut().for_each(|cells: &mut Vec<u32>| {
        cells.sort_unstable();
        cells.dedup();
    });
    cells
}

/// Where more cells meet, such as at the tip of a fan, those are neighbors that have an edge in common: else each would have all others, of which memory is not to
/// depend on the square. All of them still have the splat at that place.
const MOST_MEETING: usize = 32;

/// Of each cell those that it has a joint or an edge in common with.
fn neighbors(border: &Border, at_joints: &[Vec<u32>], count: usize) -> Vec<Vec<u32>> {
    let mut neighbors = vec![Vec::new(); count];
    let meetings = at_joints.iter().chain(border.edges.iter().map(|edge| &edge.parts));
    for cells in meetings.filter(|cells| cells.len() <= MOST_MEETING) {
        for cell in cells {
            neighbors[*cell as usize].extend(cells.iter().filter(|other| *other != cell));
        }
    }
    neighbors.iter_mut().for_each(|of_cell| {
        of_cell.sort_unstable();
        of_cell.dedup();
    });
    neighbors
}

fn cells_of(place: &Place, border: &Border, at_joints: &[Vec<u32>]) -> Vec<u32> {
    match place.on {
        On::Edge(edge) => border.edges[edge].parts.clone(),
        On::Joint(joint) => at_joints[joint].clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The neighbors of cells that are a triangle each, around one place.
    fn around_a_tip(triangles: u32) -> Vec<Vec<u32>> {
        let at = |i: u32| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(triangles)).sin_cos();
            DVec3::new(cos, sin, 0.0)
        };
        let positions = std::iter::once(DVec3::Z).chain((0..triangles).map(at)).collect();
        let triangles: Vec<[u32; 3]> = (0..triangles).map(|i| [0, 1 + i, 1 + (i + 1) % triangles]).collect();
        let cells: Vec<u32> = (0..triangles.len() as u32).collect();
        let border = Border::of(&Mesh { positions, triangles, ..Mesh::default() }, &cells);
        neighbors(&border, &cells_of_joints(&border), cells.len())
    }

    #[test]
    fn cells_at_one_place_are_neighbors_unless_they_are_too_many_to_be() {
        let few = around_a_tip(12);
        assert!(few.iter().all(|neighbors| neighbors.len() == 11), "{few:?}");
        // All pairs would be four million.
        let many = around_a_tip(2000);
        for (cell, neighbors) in (0..2000).zip(&many) {
            let mut beside = [(cell + 1999) % 2000, (cell + 1) % 2000];
            beside.sort_unstable();
            assert_eq!(neighbors[..], beside, "{cell}");
        }
    }
}
