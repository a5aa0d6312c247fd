//! What a file has of an octree of points.

use serde::Serialize;
use surfel::{
    load::{LevelOfOctree, PointOctree},
    notes::counted,
};

use super::numbers::number;

/// The hierarchy, all pages of which were read.
#[derive(Serialize)]
pub struct Octree {
    /// Pages of the hierarchy.
    pages: usize,
    /// From the root down.
    levels: Vec<OctreeLevel>,
}

#[derive(Serialize)]
struct OctreeLevel {
    nodes: u64,
    points: u64,
    /// How far its points, with those above, are apart.
    spacing: f64,
}

impl Octree {
    /// That of an octree whose pages were read.
    pub fn of(octree: &PointOctree) -> Self {
        let levels = octree.levels();
        let spacings = std::iter::successors(Some(octree.spacing()), |spacing| Some(0.5 * spacing));
        let level = |(level, spacing): (&LevelOfOctree, f64)| OctreeLevel {
            nodes: level.nodes,
            points: level.points,
            spacing,
        };
        Self { pages: octree.pages(), levels: levels.iter().zip(spacings).map(level).collect() }
    }

    /// Of all levels.
    pub fn points(&self) -> usize {
        let points: u64 = self.levels.iter().map(|level| level.points).sum();
        usize::try_from(points).unwrap_or(usize::MAX)
    }

    /// For people.
    pub fn rows(&self) -> Vec<(&'static str, String)> {
        let Self { pages, levels } = self;
        let nodes: u64 = levels.iter().map(|level| level.nodes).sum();
        let s = if *pages == 1 { "" } else { "s" };
        let all = ("octree", format!("{} levels, {nodes} nodes, by {pages} page{s}", levels.len()));
        let each = levels.iter().enumerate().map(|(level, own)| {
            let OctreeLevel { nodes, points, spacing } = own;
            (
                "level",
                format!(
                    "{level}: {} in {}, {} apart",
                    counted(*points, "points"),
                    counted(*nodes, "nodes"),
                    number(*spacing)
                ),
            )
        });
        std::iter::once(all).chain(each).collect()
    }
}
