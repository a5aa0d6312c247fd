//! Rendering by levels of detail (Pajarola, Sainz, Guidotti 2003, table 2): how many splats are drawn for a tolerance, and what that takes.

use serde::Serialize;

use super::{LevelError, Measurement, gate::GateFigure};
use crate::report::{
    Grid,
    cells::{interval, median, number},
};

/// `bench p2`.
#[derive(Clone, Debug, Serialize)]
pub struct TolerancesReport {
    /// The model.
    pub model: String,
    /// Its own splats.
    pub splats: u64,
    /// The tolerances, timed in turn, the splats themselves first.
    pub rows: Vec<Measurement<Tolerance>>,
}

/// What a tolerance leaves.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Tolerance {
    /// In pixels: how far what is drawn as one spreads.
    pub tau_px: f64,
    /// Splats that are set up: those that may be seen.
    pub drawn: u64,
    /// Against the picture of the splats themselves.
    pub error: LevelError,
}

/// A row of the paper's table 2: tolerance in percent of the window's area, splats, and milliseconds for levels of detail, splatting and in all, of
/// 512×512 pixels on hardware of 2003.
pub struct PaperTolerance {
    /// The model and the tolerance.
    pub name: &'static str,
    /// Splats drawn.
    pub drawn: u64,
    /// Milliseconds: levels of detail, splatting, normalization, in all.
    pub ms: [f64; 4],
}

/// Those that can be read.
pub const PAPER_TOLERANCES: [PaperTolerance; 6] = [
    PaperTolerance { name: "David, 0.01%", drawn: 454_656, ms: [269.0, 791.0, 0.19, 1061.0] },
    PaperTolerance { name: "David, 0.12%", drawn: 340_537, ms: [195.0, 612.0, 0.2, 808.0] },
    PaperTolerance { name: "Male, 0", drawn: 116_549, ms: [38.0, 160.0, 2.03, 199.0] },
    PaperTolerance { name: "Female, 0", drawn: 147_098, ms: [48.0, 217.0, 0.19, 266.0] },
    PaperTolerance { name: "Balljoint, 0", drawn: 60_663, ms: [18.0, 81.0, 0.19, 100.0] },
    PaperTolerance { name: "Dragon, 0.01%", drawn: 163_238, ms: [70.0, 246.0, 0.19, 317.0] },
];

/// The parts of a frame that the paper tells apart.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    /// What is drawn is chosen.
    Levels,
    /// It is drawn.
    Splatting,
    /// Sums are divided, where tiles do not, and shown.
    Normalization,
}

impl Part {
    /// That of a pass.
    fn of(pass: &str) -> Self {
        let of_levels = ["blocks of visible", "mark visible", "scan visible", "list visible"];
        match pass {
            "finalize" => Self::Normalization,
            _ if of_levels.iter().any(|name| pass.starts_with(name)) => Self::Levels,
            _ => Self::Splatting,
        }
    }
}

impl Measurement<Tolerance> {
    /// The median milliseconds of a part's passes together.
    fn part_ms(&self, part: Part) -> Option<f64> {
        let passes = self.frames.passes.iter().filter(|pass| Part::of(&pass.name) == part);
        passes.map(|pass| pass.ms.map(|ms| ms.median)).sum()
    }
}

impl TolerancesReport {
    /// The figures by which it is judged: what is counted.
    pub fn gate(&self) -> Vec<GateFigure> {
        let of = |own: &Measurement<Tolerance>| {
            let name = format!("p2, {}, splats", own.name);
            let count = GateFigure::count(name, super::gate::GateKind::Work, Some(own.subject.drawn));
            own.gate("p2").into_iter().chain(count)
        };
        self.rows.iter().flat_map(of).collect()
    }

    /// Ours, and the paper's.
    pub(super) fn grids(&self) -> [(&'static str, Grid); 2] {
        let ours = Grid::of(format!("levels of detail, {}, {} splats", self.model, self.splats), &self.rows)
            .column("tolerance", |own| own.name.clone())
            .column("px", |own| number(Some(own.subject.tau_px), 2))
            .column("splats", |own| own.subject.drawn)
            .column("LOD ms", |own| number(own.part_ms(Part::Levels), 2))
            .column("splatting ms", |own| number(own.part_ms(Part::Splatting), 2))
            .column("normalization ms", |own| number(own.part_ms(Part::Normalization), 2))
            .column("total ms", |own| median(own.frames.frame_ms, 2))
            .column("95% of the median", |own| interval(own.frames.frame_ms, 2))
            .column("x first", |own| median(own.beside_first, 3))
            .column("RMS", |own| number(Some(own.subject.error.rms), 2))
            .column("FLIP", |own| number(Some(own.subject.error.flip), 2))
            .column("silhouette px", |own| own.subject.error.silhouette_px)
            .note(
                "splats: those that may be seen; LOD: to choose and list them; splatting: sums and, by tiles, their division and shading; the \
                 parts are of frames whose passes are timed, the total is not; RMS, FLIP: against tolerance 0 over white, means over covered pixels, in 255ths; silhouette: covered by half in one only",
            )
            .grid();
        let paper = Grid::of("the paper's table 2, of 2003, 512x512", &PAPER_TOLERANCES)
            .column("model, tolerance", |row| row.name)
            .column("splats", |row| row.drawn)
            .column("LOD ms", |row| number(Some(row.ms[0]), 0))
            .column("splatting ms", |row| number(Some(row.ms[1]), 0))
            .column("normalization ms", |row| number(Some(row.ms[2]), 2))
            .column("total ms", |row| number(Some(row.ms[3]), 0))
            .grid();
        [("p2", ours), ("p2-paper", paper)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::timed::tests::timed;

    #[test]
    fn passes_are_the_parts_that_the_paper_tells_apart() {
        let passes = ["mark visible splats", "list visible band-2 splats", "project splats", "finalize"];
        let row = |name: &str, tau_px, drawn| {
            let timed = timed(&passes, &[1.0, 2.0, 4.0, 8.0], &[None; 4], 1000);
            (name.to_owned(), Tolerance { tau_px, drawn, error: LevelError::default() }, timed)
        };
        let rows = Measurement::all(vec![row("0", 0.0, 100), row("1px", 1.0, 40)], None);
        let report = TolerancesReport { model: "ball".to_owned(), splats: 150, rows };
        let [(_, ours), (_, paper)] = report.grids();
        let ms = |cell: usize| ours.rows[1][cell].parse::<f64>().unwrap();
        assert_eq!(ours.rows[1][..3], ["1px", "1.00", "40"]);
        assert!((ms(3) / ms(5) - 3.0 / 8.0).abs() < 0.01 && (ms(4) / ms(5) - 0.5).abs() < 0.01, "{ours}");
        assert_eq!(ours.rows[1][8], "1.000");
        assert_eq!(paper.rows[0][..3], ["David, 0.01%", "454656", "269"]);
        assert!(report.gate().len() >= 2);
    }
}
