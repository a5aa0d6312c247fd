//! The tables of limits and of what they bound.

use super::LimitsReport;
use crate::report::{
    Grid, ThroughputProbe,
    cells::{figure, median, number},
};

/// The limits in the order of the second table's columns; those are left out of which no pass is known to do anything.
const COLUMNS: [ThroughputProbe; 8] = [
    ThroughputProbe::Points,
    ThroughputProbe::DrawnPoints,
    ThroughputProbe::Fragments,
    ThroughputProbe::DepthFragments,
    ThroughputProbe::BlendedFragments,
    ThroughputProbe::Bytes,
    ThroughputProbe::Invocations,
    ThroughputProbe::Kernels,
];

impl LimitsReport {
    /// The table of what the device can do.
    pub(super) fn limits_grid(&self) -> Grid {
        Grid::of("limits: what the device does at most, one thing at a time", &self.limits)
            .column("limit", |row| row.limit.name())
            .column("work", |row| row.units)
            .column("ms", |row| median(row.ms, 3))
            .column("G a second", |row| number(row.units_per_sec.map(|units| 1e-9 * units), 4))
            .column("GB a second", |row| number(row.bytes_per_sec.map(|bytes| 1e-9 * bytes), 2))
            .note(
                "points: outside of the clip volume; drawn points: one pixel each, behind what is there; fragments: one color, \
                 without blending; depth fragments: depth alone; blended fragments: added into both sums; bytes: read and \
                 written by a copy; invocations: of compute; atomics: a sum of each invocation, on a million words; kernels: \
                 splats seen at a pixel and added to it, in registers",
            )
            .with_notes(self.notes.iter().cloned())
    }

    /// How far from it each pass is.
    pub(super) fn bounds_grid(&self) -> Grid {
        let title = "bounds: milliseconds that each limit alone would take, in the same rounds";
        let table = Grid::of(title, &self.bounds)
            .column("", |row| row.name.clone())
            .column("ms", |row| median(row.ms, 3));
        let is_known =
            |limit: &ThroughputProbe| self.bounds.iter().any(|row| row.limit_ms.contains_key(limit));
        let limits = COLUMNS.into_iter().filter(is_known);
        let table = limits.fold(table, |table, limit| {
            table.column(limit.name(), |row| number(row.limit_ms.get(&limit).copied(), 3))
        });
        let unknown = self.bounds.iter().any(|row| row.bound_ms.is_none());
        table
            .column("bound", |row| median(row.bound_ms, 3))
            .column("binds", |row| figure(row.binds.map(ThroughputProbe::name)))
            .column("x bound", |row| median(row.ratio, 2))
            .note("bound: the largest of them, of the frame the sum of its passes'; medians, of ratios those of the rounds' own")
            .with_notes(unknown.then(|| "a pass without a bound: how much it does is not known".to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::super::limits::tests::report;

    #[test]
    fn the_tables_say_what_binds_and_how_far_a_pass_is_from_it() {
        let (limits, bounds) = (report().limits_grid(), report().bounds_grid());
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
