//! Clipped splats in the making (Ivo et al. 2012, section 5): seconds over triangles.

use serde::Serialize;

use super::gate::{GateFigure, GateKind};
use crate::report::{
    Grid, Spread,
    cells::{interval, median, number},
};

/// `bench i3`.
#[derive(Clone, Debug, Default, Serialize)]
pub struct ConversionReport {
    /// The model.
    pub model: String,
    /// Threads that made them.
    pub threads: usize,
    /// One for each number of triangles.
    pub rows: Vec<ConversionRow>,
}

/// A mesh, and what it took to make splats of it.
#[derive(Clone, Debug, Serialize)]
pub struct ConversionRow {
    /// Triangles of the mesh.
    pub triangles: u64,
    /// Splats that it became.
    pub splats: u64,
    /// Those with a clip.
    pub clipped: u64,
    /// Seconds from the mesh in memory to its splats.
    pub secs: Option<Spread>,
}

impl ConversionReport {
    /// The figures by which it is judged: those that do not depend on the machine.
    pub fn gate(&self) -> Vec<GateFigure> {
        let of = |row: &ConversionRow| {
            let name = format!("i3, {} triangles, splats", row.triangles);
            GateFigure::count(name, GateKind::Work, Some(row.splats))
        };
        self.rows.iter().filter_map(of).collect()
    }

    /// The table.
    pub fn grid(&self) -> Grid {
        let each = |row: &ConversionRow| Some(1e6 * row.secs?.median / row.triangles.max(1) as f64);
        Grid::of(format!("clipped splats of meshes, {}, {} threads", self.model, self.threads), &self.rows)
            .column("triangles", |row| row.triangles)
            .column("splats", |row| row.splats)
            .column("clipped", |row| row.clipped)
            .column("seconds", |row| median(row.secs, 3))
            .column("95% of the median", |row| interval(row.secs, 3))
            .column("microseconds a triangle", |row| number(each(row), 2))
            .note("from the mesh in memory to its splats: ridges, edges collapsed, curves fitted, ellipses clipped")
            .grid()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_tells_the_time_of_a_triangle_and_counts_are_judged() {
        let row = ConversionRow {
            triangles: 1_000_000,
            splats: 2_500,
            clipped: 70,
            secs: Spread::of([1.5, 2.0, 2.0, 2.0, 2.0, 2.5]),
        };
        let report = ConversionReport { model: "part".to_owned(), threads: 2, rows: vec![row] };
        let cells = &report.grid().rows[0];
        assert_eq!(cells[..4], ["1000000", "2500", "70", "2.000"].map(str::to_owned));
        assert_eq!(cells[5], "2.00");
        assert_eq!(report.gate().len(), 1);
    }
}
