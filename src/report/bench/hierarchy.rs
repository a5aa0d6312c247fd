//! Levels of detail in the making (Pajarola, Sainz, Guidotti 2003, table 1): the octree and the splats of its nodes, over numbers of splats.

use serde::Serialize;

use super::gate::{GateFigure, GateKind};
use crate::report::{
    Grid, Spread,
    cells::{figure, interval, median, number},
};

/// `bench p1`.
#[derive(Clone, Debug, Default, Serialize)]
pub struct HierarchyReport {
    /// The model.
    pub model: String,
    /// Threads that made it.
    pub threads: usize,
    /// One for each number of splats.
    pub rows: Vec<HierarchyRow>,
}

/// A hierarchy, and what it took to make it.
#[derive(Clone, Debug, Serialize)]
pub struct HierarchyRow {
    /// Splats of the model.
    pub splats: u64,
    /// Nodes of the tree.
    pub nodes: u64,
    /// Levels of nodes.
    pub levels: u64,
    /// Bytes of the hierarchy beside the splats.
    pub bytes: u64,
    /// Seconds until all splats have their place in the tree.
    pub octree_secs: Option<Spread>,
    /// Seconds for all of it.
    pub all_secs: Option<Spread>,
}

/// The rows of the paper's table 1 that can be read: splats, nodes, and seconds on a processor of 1.5 GHz of 2003.
pub const PAPER_HIERARCHIES: [(u64, u64, f64); 3] =
    [(137_062, 54_992, 1.378), (302_948, 121_439, 2.978), (437_645, 173_507, 4.268)];

impl HierarchyRow {
    /// Nanoseconds of all for each splat and level of an ideal binary tree, `n log2 n`.
    fn ns_per_step(&self) -> Option<f64> {
        let splats = self.splats as f64;
        self.all_secs.map(|secs| 1e9 * secs.median / (splats * splats.log2().max(1.0)))
    }

    fn paper(&self) -> Option<(u64, u64, f64)> {
        PAPER_HIERARCHIES.into_iter().find(|(splats, ..)| *splats == self.splats)
    }
}

impl HierarchyReport {
    /// The figures by which it is judged: those that do not depend on the machine.
    pub fn gate(&self) -> Vec<GateFigure> {
        let of = |row: &HierarchyRow| {
            let count = |what: &str, count: u64| {
                GateFigure::count(format!("p1, {} splats, {what}", row.splats), GateKind::Work, Some(count))
            };
            [count("nodes", row.nodes), count("bytes", row.bytes)]
        };
        self.rows.iter().flat_map(of).flatten().collect()
    }

    /// The table.
    pub fn grid(&self) -> Grid {
        let rate = |row: &HierarchyRow| Some(1e-6 * row.splats as f64 / row.all_secs?.median);
        Grid::of(format!("levels of detail, {}, {} threads", self.model, self.threads), &self.rows)
            .column("splats", |row| row.splats)
            .column("nodes", |row| row.nodes)
            .column("(paper)", |row| figure(row.paper().map(|(_, nodes, _)| nodes)))
            .column("levels", |row| row.levels)
            .column("octree s", |row| median(row.octree_secs, 3))
            .column("all s", |row| median(row.all_secs, 3))
            .column("95% of the median", |row| interval(row.all_secs, 3))
            .column("(paper)", |row| number(row.paper().map(|(.., secs)| secs), 3))
            .column("M splats/s", |row| number(rate(row), 2))
            .column("ns / n log2 n", |row| number(row.ns_per_step(), 1))
            .column("bytes a splat", |row| number(Some(row.bytes as f64 / row.splats.max(1) as f64), 1))
            .note("the paper: other models with as many splats, on a processor of 2003; bytes: beside the splats themselves")
            .grid()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_paper_stands_beside_rows_of_its_size_and_counts_are_judged() {
        let row = |splats| HierarchyRow {
            splats,
            nodes: 100,
            levels: 5,
            bytes: 50 * splats,
            octree_secs: Spread::of([0.5; 6]),
            all_secs: Spread::of([2.0; 6]),
        };
        let report =
            HierarchyReport { model: "ball".to_owned(), threads: 2, rows: vec![row(1 << 20), row(302_948)] };
        let grid = report.grid();
        let column = |i: usize| grid.rows.iter().map(|row| row[i].as_str()).collect::<Vec<_>>();
        assert_eq!(column(2), ["-", "121439"]);
        assert_eq!(column(7), ["-", "2.978"]);
        assert_eq!(column(8), ["0.52", "0.15"]);
        // 2 s over 2²⁰ · 20 steps.
        assert_eq!(column(9)[0], "95.4");
        assert_eq!(column(10), ["50.0", "50.0"]);
        assert_eq!(report.gate().len(), 4);
    }
}
