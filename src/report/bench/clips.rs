//! What clip curves cost (Ivo et al. 2012, tables 1 and 2): splats that nothing cuts, cut by lines and by curves.

use serde::Serialize;

use super::{Measurement, gate::GateFigure};
use crate::report::{
    Grid,
    cells::{interval, median, number},
};

/// `bench i1` or `bench i2`.
#[derive(Clone, Debug, Serialize)]
pub struct ClipsReport {
    /// The table's name.
    pub title: String,
    /// The model.
    pub model: String,
    /// One for each number of splats, or for each share of the image.
    pub rows: Vec<ClipsRow>,
}

/// One number of splats that cover one share of the image.
#[derive(Clone, Debug, Serialize)]
pub struct ClipsRow {
    /// Splats that were asked for; all where it is the largest number.
    #[serde(skip)]
    pub wanted: u64,
    /// Splats before those are culled that face away.
    pub splats: u64,
    /// The share of the image that they cover.
    pub occupancy: f64,
    /// The ways to cut them, timed in turn, nothing cut first.
    pub ways: Vec<Measurement<Clipped>>,
    /// Frames a second and millions of splats a second, as the paper prints them.
    pub paper: Option<[f64; 2]>,
}

/// How many splats are cut.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Clipped {
    /// Those with a clip.
    pub clipped: u64,
}

/// Table 1 of the paper: splats (all is the largest number), frames a second, millions of splats a second. Its first row is not what the
/// others are: 114.65 frames of 2 500 splats are 0.287 million, as its table 2 has it.
pub const PAPER_PARTS: [(u64, f64, f64); 3] =
    [(2_500, 114.65, 0.143), (5_000, 97.82, 0.489), (u64::MAX, 31.35, 2.782)];

/// Its table 2, of 2 500 splats: percent of the image, frames a second, millions of splats a second. 31.35 frames of 54 192 splats in table 1
/// are 1.699 million.
pub const PAPER_OCCUPANCIES: [(f64, f64, f64); 3] =
    [(3.1, 298.75, 0.746), (37.5, 196.18, 0.490), (80.7, 115.57, 0.288)];

impl ClipsReport {
    /// The figures by which it is judged.
    pub fn gate(&self) -> Vec<GateFigure> {
        let of = |row: &ClipsRow| {
            let place = format!("{}, {} splats, {:.0}%", self.title, row.splats, 100.0 * row.occupancy);
            row.ways.iter().flat_map(|way| way.gate(&place)).collect::<Vec<_>>()
        };
        self.rows.iter().flat_map(of).collect()
    }

    /// The table.
    pub fn grid(&self) -> Grid {
        let ways: Vec<_> =
            self.rows.iter().flat_map(|row| row.ways.iter().map(move |way| (row, way))).collect();
        type Way<'a> = (&'a ClipsRow, &'a Measurement<Clipped>);
        let rate = |(row, way): &Way<'_>| way.fps.map(|fps| 1e-6 * fps * row.splats as f64);
        let paper =
            |(row, way): &Way<'_>, i: usize| row.paper.filter(|_| way.name == "curves").map(|paper| paper[i]);
        Grid::of(format!("{}, {}", self.title, self.model), &ways)
            .column("splats", |(row, _)| row.splats)
            .column("% of the image", |(row, _)| number(Some(100.0 * row.occupancy), 1))
            .column("cut by", |(_, way)| way.name.clone())
            .column("clipped", |(_, way)| way.subject.clipped)
            .column("frame ms", |(_, way)| median(way.frames.frame_ms, 2))
            .column("95% of the median", |(_, way)| interval(way.frames.frame_ms, 2))
            .column("x nothing cut", |(_, way)| median(way.beside_first, 3))
            .column("fps", |(_, way)| number(way.fps, 1))
            .column("(paper)", |own| number(paper(own, 0), 1))
            .column("M splats/s", |own| number(rate(own), 3))
            .column("(paper)", |own| number(paper(own, 1), 3))
            .note(
                "M splats/s: frames a second times splats, which two of the paper's rows are not: 2500 splats are 0.287 in its table 1, and \
                 its all, 54192, are 1.699",
            )
            .grid()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::TimedFrames;

    #[test]
    fn rates_are_frames_times_splats_and_the_paper_stands_beside_curves() {
        let contestants = [("nothing cut", 0), ("curves", 1300)]
            .map(|(name, clipped)| (name.to_owned(), Clipped { clipped }, TimedFrames::default()));
        let mut ways = Measurement::all(contestants.into(), None);
        ways[1].fps = Some(200.0);
        let row =
            ClipsRow { wanted: 2_500, splats: 2_480, occupancy: 0.401, ways, paper: Some([114.65, 0.143]) };
        let report = ClipsReport { title: "i1".to_owned(), model: "part".to_owned(), rows: vec![row] };
        let rows = report.grid().rows;
        assert_eq!(rows[0][7..], ["-"; 4].map(str::to_owned));
        assert_eq!(rows[1][7..], ["200.0", "114.7", "0.496", "0.143"].map(str::to_owned));
        assert_eq!(rows[1][..4], ["2480", "40.1", "curves", "1300"].map(str::to_owned));
    }

    /// Where the paper's columns agree with each other, they are what ours are.
    #[test]
    fn two_rows_of_the_paper_are_not_frames_times_splats() {
        let agrees = |splats: u64, fps: f64, rate: f64| (1e-6 * splats as f64 * fps - rate).abs() < 0.002;
        let parts = PAPER_PARTS.map(|(splats, fps, rate)| agrees(splats.min(54_192), fps, rate));
        assert_eq!(parts, [false, true, false]);
        assert!(PAPER_OCCUPANCIES.into_iter().all(|(_, fps, rate)| agrees(2_500, fps, rate)));
    }
}
