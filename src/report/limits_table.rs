//! The tables of limits and of what they bound.

use super::{
    Limit, LimitsReport,
    grid::{Grid, NONE, cell},
};

/// The limits in the order of the second table's columns; those are left out of which no pass is known to do anything.
const COLUMNS: [Limit; 8] = [
    Limit::Points,
    Limit::DrawnPoints,
    Limit::Fragments,
    Limit::DepthFragments,
    Limit::BlendedFragments,
    Limit::Bytes,
    Limit::Invocations,
    Limit::Kernels,
];

impl LimitsReport {
    /// What the device can do, and how far from it each pass is.
    pub fn grids(&self) -> [Grid; 2] {
        [self.limits_grid(), self.bounds_grid()]
    }

    fn limits_grid(&self) -> Grid {
        let head = ["limit", "work", "ms", "G a second", "GB a second"];
        let mut grid = Grid::new("limits: what the device does at most, one thing at a time", &head);
        for row in &self.limits {
            grid.row([
                row.limit.name().to_owned(),
                row.units.to_string(),
                cell(row.ms.map(|ms| ms.median), 3),
                cell(row.units_per_sec.map(|units| 1e-9 * units), 4),
                cell(row.bytes_per_sec.map(|bytes| 1e-9 * bytes), 2),
            ]);
        }
        grid.notes.push(
            "points: outside of the clip volume; drawn points: one pixel each, behind what is there; fragments: one color, without blending; depth fragments: depth alone; \
             blended fragments: added into both sums; bytes: read and written by a copy; invocations: of compute; atomics: a sum of each invocation, on a million words; kernels: splats seen at a pixel and added to it, in registers"
                .to_owned(),
        );
        grid.notes.extend(self.notes.iter().cloned());
        grid
    }

    fn bounds_grid(&self) -> Grid {
        let is_known = |limit: &Limit| self.bounds.iter().any(|row| row.limit_ms.contains_key(limit));
        let columns: Vec<Limit> = COLUMNS.into_iter().filter(is_known).collect();
        let names = columns.iter().map(|limit| limit.name());
        let head: Vec<&str> =
            ["", "ms"].into_iter().chain(names).chain(["bound", "binds", "x bound"]).collect();
        let title = "bounds: milliseconds that each limit alone would take, in the same rounds";
        let mut grid = Grid::new(title, &head);
        for row in &self.bounds {
            let alone = columns.iter().map(|limit| cell(row.limit_ms.get(limit).copied(), 3));
            let cells = [row.name.clone(), cell(row.ms.map(|ms| ms.median), 3)].into_iter().chain(alone);
            grid.row(cells.chain([
                cell(row.bound_ms.map(|ms| ms.median), 3),
                row.binds.map_or(NONE, Limit::name).to_owned(),
                cell(row.ratio.map(|ratio| ratio.median), 2),
            ]));
        }
        grid.notes.push(
            "bound: the largest of them, of the frame the sum of its passes'; medians, of ratios those of the rounds' own"
                .to_owned(),
        );
        if self.bounds.iter().any(|row| row.bound_ms.is_none()) {
            grid.notes.push("a pass without a bound: how much it does is not known".to_owned());
        }
        grid
    }
}

#[cfg(test)]
mod tests {
    use super::super::limits::tests::report;

    #[test]
    fn the_tables_say_what_binds_and_how_far_a_pass_is_from_it() {
        let [limits, bounds] = report().grids();
        // 3 ms for a million blended fragments of 32 bytes.
        assert_eq!(limits.rows[1], ["blended fragments", "1000000", "3.000", "0.3333", "10.67"]);
        assert_eq!(limits.notes.last().map(String::as_str), Some("a note"));
        let row = &bounds.rows[1];
        // Only of three limits is anything known.
        assert_eq!(bounds.head[2..5], ["points", "blended fragments", "bytes"]);
        assert_eq!(row[..5], ["accumulate", "12.000", "1.500", "6.000", "-"].map(str::to_owned));
        assert_eq!(row[5..], ["6.000", "blended fragments", "2.00"]);
        assert_eq!(bounds.rows[2][5..], ["-", "-", "-"]);
        assert!(bounds.notes.last().is_some_and(|note| note.contains("without a bound")));
    }
}
