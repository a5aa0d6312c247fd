//! A mesh as polygons and splats in levels of detail (Guennebaud, Barthe, Paulin 2006, section 5.2): an octree with splats in its nodes and
//! polygons in its leaves, here called cells, and on the edges between two of them splats that belong to both.
//!
//! **Sizes.** Splats of a cell stand for its surface, each for an equal part of it: that spreads by √(a / 2π) for the area a of a disk. That is a
//! cell's spread, the same measure as a node's; and like a node's it is a quarter of the largest half axis at least. The ball is one for the cell and all nodes below its root, so
//! that what is drawn of a cell is of one level, and sizes rise from its polygons to the root.
//!
//! **Splats on edges** are drawn for any of the cells that have the edge, once. For the nodes above they are one cell's.

mod joined;
mod sampled;

use std::ops::Range;

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::{HybridOptions, HybridReport, SAMPLES, cells::Cells};
use crate::{
    error::Result,
    geometry::{
        creased_mesh,
        hierarchy::{Bounds, Hierarchy, NormalCone, PartSums, Top, rounded_up},
        overlaps::{Overlaps, area_of},
        resample::{Areas, check_count, no_area},
    },
    progress::Progress,
    scene::{ErrorBall, HybridLevels, Mesh, Splats},
};
use joined::Joined;
use sampled::{Sampled, sampled};

/// As of nodes: no half axis is more times the spread.
const LONGEST: f64 = 4.0;

/// A mesh, and what it is drawn as where that would be small.
#[derive(Clone, Debug)]
pub struct Multiresolution {
    /// The mesh, as [`creased_mesh`] makes it; its triangles lie cell by cell.
    pub mesh: Mesh,
    /// It is closed.
    pub closed: bool,
    /// Its levels of detail, as of the scene's first mesh.
    pub levels: HybridLevels,
    /// How it was made.
    pub report: HybridReport,
}

/// A cell's splats, and the nodes below its root.
struct Part {
    /// The numbers of its splats.
    numbers: Vec<u32>,
    splats: Splats,
    hierarchy: Hierarchy,
    sums: PartSums,
    ball: ErrorBall,
    weights: Vec<f32>,
    /// The area of its disks, each over what the surface overlaps itself there.
    area: f64,
}

/// Makes cells and splats of a mesh: `options.samples` of these, spread evenly over its area, but for those near the edges between cells, on which
/// others are, whatever `options.sample_edges` says. It is cut apart at creases as [`creased_mesh`] does.
///
/// # Errors
/// [`crate::error::ErrorKind::Option`] for a number of samples out of range or of more than there is memory for;
/// [`crate::error::ErrorKind::Input`] for a mesh without area.
pub fn multiresolution(
    mesh: Mesh,
    name: String,
    options: &HybridOptions,
    progress: &dyn Progress,
) -> Result<Multiresolution> {
    let count = check_count(options.samples, SAMPLES)?;
    let total = Areas::of(&mesh, &|_| 1.0)?.total;
    let (mut whole, mesh_report) = creased_mesh(mesh);
    if whole.triangles.is_empty() {
        return Err(no_area(&whole));
    }
    let Cells { order, cells, nodes } = Cells::of(&whole, count as f64 / total);
    whole.triangles = order.iter().map(|i| whole.triangles[*i as usize]).collect();
    let mut report =
        HybridReport { mesh: mesh_report, polygons: whole.triangles.len(), ..HybridReport::default() };
    let sampled = sampled(&whole, &cells, (count, options.seed), &mut report, progress)?;

    let bounds = sampled.splats.bounds();
    let origin = bounds.map_or(DVec3::ZERO, |bounds| bounds.center());
    let overlaps = Overlaps::of(&sampled.splats);
    let groups = groups(&sampled, cells.len());
    let parts: Result<Vec<Part>> = groups
        .into_par_iter()
        .zip(&cells)
        .map(|(numbers, cell)| Part::of(&sampled, numbers, (&whole, cell), origin, &overlaps))
        .collect();
    let parts = parts?;
    let sums: Vec<PartSums> = parts.iter().map(|part| part.sums).collect();
    let mut top = Top::new(&nodes, &sums, origin);
    for (number, part) in parts.iter().enumerate() {
        top.add(number, &part.splats, &part.hierarchy);
    }
    let part_parents: Vec<Option<usize>> = (0..parts.len()).map(|part| top.parent_of(part)).collect();
    let top = top.finish();
    let joined = Joined { sampled: &sampled, overlaps: &overlaps, parts: &parts, part_parents, top, origin };
    let levels = joined.levels(name, &cells, mesh_report.closed);
    Ok(Multiresolution { mesh: whole, closed: mesh_report.closed, levels, report })
}

/// The numbers of the splats of each cell; those on edges are the first one's.
fn groups(sampled: &Sampled, count: usize) -> Vec<Vec<u32>> {
    let mut groups = vec![Vec::new(); count];
    (0..).zip(&sampled.cells).for_each(|(number, cells)| groups[cells[0] as usize].push(number));
    groups
}

impl Part {
    fn of(
        sampled: &Sampled,
        numbers: Vec<u32>,
        (mesh, cell): (&Mesh, &Range<usize>),
        origin: DVec3,
        overlaps: &Overlaps,
    ) -> Result<Self> {
        let splats = sampled.splats.picked(numbers.iter().map(|number| *number as usize));
        let inverse = numbers.iter().map(|number| overlaps.inverse[*number as usize]).collect();
        let own = Overlaps { inverse, mean: overlaps.mean };
        let mut hierarchy = Hierarchy::build_part(&splats, origin, &())?;
        let largest = (0..splats.len()).map(|i| splats.major_radius(i)).fold(0.0, f64::max);
        let of_splat = || ErrorBall { center: (splats.positions[0] - origin).as_vec3(), ..ErrorBall::LEAF };
        let around = hierarchy.bounds.first().map_or_else(of_splat, |bounds| bounds.error);
        let middle = around.center.as_dvec3();
        let corners = mesh.triangles[cell.clone()].iter().flatten();
        let corners = corners.map(|vertex| (mesh.positions[*vertex as usize] - origin).distance(middle));
        let spread = (sampled.area_each / std::f64::consts::TAU).sqrt().max(largest / LONGEST);
        let ball = ErrorBall {
            center: around.center,
            radius: rounded_up(f64::from(around.radius).max(corners.fold(0.0, f64::max) + largest)),
            spread: rounded_up(spread),
        };
        let nodes = hierarchy.bounds.iter_mut();
        nodes.for_each(|bounds| {
            let spread = bounds.error.spread.max(ball.spread);
            bounds.error = ErrorBall { spread, ..ball };
        });
        if hierarchy.bounds.is_empty() {
            // So that the nodes above bound the cell, too.
            hierarchy.bounds.push(Bounds { error: ball, cone: NormalCone { axis: Vec3::Z, cos: -1.0 } });
        }
        let weights = hierarchy.weights(&splats, (&own, own.mean));
        let areas = (0..splats.len()).map(|i| area_of(&splats, i) * own.mean * f64::from(own.inverse[i]));
        let (area, sums) = (areas.sum(), PartSums::of(&splats));
        let sums = sums.ok_or_else(|| no_area(mesh))?;
        Ok(Self { numbers, splats, hierarchy, sums, ball, weights, area })
    }
}
