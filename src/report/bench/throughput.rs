//! Table 1 of Guennebaud, Barthe, Paulin 2006 (section 7), on any device: the throughput of perspective splatting and of ray
//! casting at several numbers of splats, over the floor of the same points, beside the paper's own figures.

use serde::{Deserialize, Serialize};

use super::{
    Measurement,
    gate::{GateFigure, GateKind},
    instructions::stage_figures,
};
use crate::{
    count::PassCounts,
    report::{
        FrameTimes, Grid, PassFigures, Spread, TimedFrames,
        cells::{NONE, bracketed, figure, interval, median, megabytes, number},
    },
};

/// One number of splats.
#[derive(Clone, Debug, Serialize)]
pub struct ThroughputRow {
    /// Splats drawn.
    pub splats: u64,
    /// Each method, timed in turn with the others and with the floor.
    pub methods: Vec<Measurement<Throughput>>,
    /// The floor's frames: the same points into the same formats with nothing computed.
    pub floor: FrameTimes,
    /// How many times the first method's frame the others' take, round by round.
    pub beside_first: Vec<Option<Spread>>,
    /// Bytes of device memory in splat buffers.
    pub splat_bytes: u64,
    /// Bytes of device memory that a frame's own images and buffers share.
    pub transient_bytes: u64,
}

/// The figures of a method beside its frames.
#[derive(Clone, Debug, Serialize)]
pub struct Throughput {
    /// Million splats a second, drawn or culled.
    pub million_splats_per_sec: Option<f64>,
    /// The instructions of its passes.
    pub instructions: Vec<PassCounts>,
    /// Which of the paper's methods it is.
    pub paper_method: Option<PaperMethod>,
    /// The paper's figures of it at this number of splats.
    pub paper: Option<PaperThroughput>,
}

/// Figures of the paper, on its own hardware (GeForce 7800, 2006).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PaperThroughput {
    /// Frames a second.
    pub fps: f64,
    /// Million splats a second.
    pub million_splats_per_sec: f64,
}

/// The methods of the paper's table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PaperMethod {
    /// Perspective splatting.
    Perspective,
    /// Ray casting.
    Raycast,
}

/// The paper's numbers of splats.
pub const PAPER_SPLATS: [u64; 5] = [154_000, 460_000, 1_400_000, 2_500_000, 5_000_000];

/// The paper's frames a second of perspective splatting and of ray casting, at its numbers of splats.
const PAPER_FPS: [[f64; 2]; 5] = [[50.0, 33.0], [40.0, 26.0], [22.0, 13.0], [15.0, 9.2], [6.5, 5.0]];

/// The paper's instructions of a method's passes: vertex and fragment program of visibility, then of accumulation.
const PAPER_INSTRUCTIONS: [[&str; 2]; 2] = [["46/3", "58/3"], ["34/9", "35/13"]];

/// The paper's figures of a method at a number of splats, where it has them.
pub fn paper_throughput(method: PaperMethod, splats: u64) -> Option<PaperThroughput> {
    let fps = PAPER_FPS[PAPER_SPLATS.iter().position(|count| *count == splats)?][method as usize];
    Some(PaperThroughput { fps, million_splats_per_sec: fps * splats as f64 * 1e-6 })
}

impl Throughput {
    /// The figures of a method whose frames are still to be measured.
    pub fn new(paper_method: Option<PaperMethod>, splats: u64, instructions: Vec<PassCounts>) -> Self {
        let paper = paper_method.and_then(|method| paper_throughput(method, splats));
        Self { million_splats_per_sec: None, instructions, paper_method, paper }
    }

    /// The instructions of a pass, as `46/3`.
    pub(super) fn instructions_cell(&self, pass: &str) -> String {
        let counts = self.instructions.iter().find(|counts| counts.pass == pass);
        figure(counts.map(PassCounts::vertex_and_fragment))
    }

    /// The paper's instructions of a pass, where it has the method; else nothing.
    fn paper_instructions(&self, pass: &str) -> String {
        let column = ["visibility", "accumulate"].iter().position(|name| *name == pass);
        let figures = self.paper_method.zip(column);
        figures
            .map_or_else(String::new, |(method, i)| format!("({})", PAPER_INSTRUCTIONS[method as usize][i]))
    }
}

impl ThroughputRow {
    /// The row of methods and their floor, measured in turn.
    pub fn of(
        splats: u64,
        mut methods: Vec<Measurement<Throughput>>,
        floor: &TimedFrames,
        splat_bytes: u64,
    ) -> Self {
        for method in &mut methods {
            method.over_floor = method.timed.ratios_to_floor(floor);
            method.subject.million_splats_per_sec = method.fps.map(|fps| 1e-6 * splats as f64 * fps);
        }
        Self {
            splats,
            beside_first: methods.iter().map(|method| method.beside_first).collect(),
            transient_bytes: methods.last().map_or(0, |method| method.transient_bytes),
            methods,
            floor: floor.times(),
            splat_bytes,
        }
    }
}

/// Frames and splats a second and the ratios, beside the paper's.
pub fn throughput_grid(title: &str, rows: &[ThroughputRow]) -> Grid {
    let of_row = |row| move |method| (row, method);
    let methods: Vec<(&ThroughputRow, &Measurement<Throughput>)> =
        rows.iter().flat_map(|row| row.methods.iter().map(of_row(row))).collect();
    let paper_ratio = |row: &ThroughputRow, own: &Measurement<Throughput>| {
        Some(row.methods.first()?.subject.paper?.fps / own.subject.paper?.fps)
    };
    Grid::of(title, &methods)
        .column("splats", |(row, _)| row.splats)
        .column("method", |(_, own)| own.name.clone())
        .column("fps", |(_, own)| number(own.fps, 2))
        .column("(paper)", |(_, own)| bracketed(own.subject.paper.map(|paper| paper.fps), 1))
        .column("M splats/s", |(_, own)| number(own.subject.million_splats_per_sec, 2))
        .column("(paper)", |(_, own)| {
            bracketed(own.subject.paper.map(|paper| paper.million_splats_per_sec), 1)
        })
        .column("frame ms", |(_, own)| median(own.frames.frame_ms, 2))
        .column("95% of the median", |(_, own)| interval(own.frames.frame_ms, 2))
        .column("x first", |(_, own)| median(own.beside_first, 3))
        .column("(paper)", |(row, own)| bracketed(paper_ratio(row, own), 2))
        .column("x floor", |(_, own)| median(own.frame_over_floor(), 2))
        .column("record ms", |(_, own)| median(own.frames.record_ms, 3))
        .column("MB", |(row, _)| megabytes(row.splat_bytes + row.transient_bytes))
        .note(
            "medians; in brackets the paper's; ratios are medians of the rounds' own, each of the least of its frames: x first \
             beside the first method, x floor beside that one's points and formats with nothing computed",
        )
        .grid()
}

/// A pass of a method, or of the floor, which has no throughput.
struct PassRow<'a> {
    splats: u64,
    name: &'a str,
    pass: &'a PassFigures,
    over_floor: Option<Spread>,
    method: Option<&'a Throughput>,
}

/// The passes of every method, then of the floor.
fn passes(row: &ThroughputRow) -> Vec<PassRow<'_>> {
    let splats = row.splats;
    let mut passes = Vec::new();
    for own in &row.methods {
        for (pass, over_floor) in own.frames.passes.iter().zip(&own.over_floor) {
            let (over_floor, method) = (*over_floor, Some(&own.subject));
            passes.push(PassRow { splats, name: &own.name, pass, over_floor, method });
        }
    }
    let of_floor = |pass| PassRow { splats, name: "floor", pass, over_floor: None, method: None };
    passes.extend(row.floor.passes.iter().map(of_floor));
    passes
}

/// Every pass of every method: where the time goes. The floor's passes follow each number of splats.
pub fn passes_grid(title: &str, rows: &[ThroughputRow]) -> Grid {
    let passes: Vec<PassRow<'_>> = rows.iter().flat_map(passes).collect();
    Grid::of(title, &passes)
        .column("splats", |row| row.splats)
        .column("method", |row| row.name.to_owned())
        .column("pass", |row| row.pass.name.clone())
        .column("ms", |row| median(row.pass.ms, 2))
        .column("min", |row| number(row.pass.ms.map(|ms| ms.min), 2))
        .column("max", |row| number(row.pass.ms.map(|ms| ms.max), 2))
        .column("x floor", |row| median(row.over_floor, 2))
        .column("vertices", |row| figure(row.pass.vertices))
        .column("fragments", |row| figure(row.pass.fragments))
        .column("VP/FP", |row| match row.method {
            Some(method) => method.instructions_cell(&row.pass.name),
            None => NONE.to_owned(),
        })
        .column("(paper)", |row| {
            row.method.map_or_else(String::new, |own| own.paper_instructions(&row.pass.name))
        })
        .note("VP/FP: instructions of the pass's programs, counted as the paper does")
        .grid()
}

/// The figures by which rows of throughput are judged. `table` begins their names.
pub fn throughput_gate(table: &str, rows: &[ThroughputRow]) -> Vec<GateFigure> {
    let mut figures = Vec::new();
    for row in rows {
        for method in &row.methods {
            let name = |what: &str| format!("{table}, {} splats, {}, {what}", row.splats, method.name);
            let passes = &method.frames.passes;
            let names = passes.iter().map(|pass| pass.name.as_str()).chain(["frame"]);
            for (pass, over) in names.zip(&method.over_floor) {
                figures.extend(GateFigure::time(name(&format!("{pass}, x floor")), over.as_ref()));
            }
            for counts in &method.subject.instructions {
                figures.extend(stage_figures(&name(&counts.pass), counts));
            }
            for pass in passes {
                for (what, count) in [("vertices", pass.vertices), ("fragments", pass.fragments)] {
                    let name = name(&format!("{}, {what}", pass.name));
                    figures.extend(GateFigure::count(name, GateKind::Work, count));
                }
            }
        }
        let name = format!("{table}, {} splats, bytes", row.splats);
        let bytes = Some(row.splat_bytes + row.transient_bytes);
        figures.extend(GateFigure::count(name, GateKind::Work, bytes));
    }
    figures
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::timed::tests::timed;

    fn row() -> ThroughputRow {
        let of = |passes: [&str; 3], scale: f64| {
            timed(&passes, &[1.0, 2.0, 0.5].map(|ms| scale * ms), &[Some([7, 70]); 3], 500_000)
        };
        let method = |name: &str, paper, scale| {
            let subject = Throughput::new(paper, 154_000, Vec::new());
            (name.to_owned(), subject, of(["visibility", "accumulate", "finalize"], scale))
        };
        let methods = vec![
            method("perspective", Some(PaperMethod::Perspective), 2.0),
            method("other", None, 3.0),
            method("raycast", Some(PaperMethod::Raycast), 3.0),
        ];
        let floor = of(["floor depth", "floor add", "floor fill"], 1.0);
        ThroughputRow::of(154_000, Measurement::all(methods, Some(&floor)), &floor, 1_000_000)
    }

    #[test]
    fn ratios_are_those_of_each_round() {
        let row = row();
        assert_eq!(row.beside_first, [1.0, 1.5, 1.5].map(|ratio| Spread::of([ratio; 6])));
        assert_eq!(row.methods[0].over_floor, vec![Spread::of([2.0; 6]); 4]);
        // 7 ms in the first round, 42 in the last.
        assert_eq!(row.methods[0].fps, Some(1e3 / 24.5));
        assert_eq!(row.methods[1].subject.paper, None);
        let paper = PaperThroughput { fps: 33.0, million_splats_per_sec: 33.0 * 0.154 };
        assert_eq!(row.methods[2].subject.paper, Some(paper));
    }

    #[test]
    fn the_papers_splats_a_second_follow_from_its_frames() {
        // As printed: 50 (7.7), 40 (18.4), 22 (31), 15 (37.5), 6.5 (32.5); 33 (5), 26 (12), 13 (18.2), 9.2 (23), 5 (25).
        let printed = [[7.7, 5.0], [18.4, 12.0], [31.0, 18.2], [37.5, 23.0], [32.5, 25.0]];
        for (splats, printed) in PAPER_SPLATS.into_iter().zip(printed) {
            for (method, printed) in [PaperMethod::Perspective, PaperMethod::Raycast].into_iter().zip(printed)
            {
                let figure = paper_throughput(method, splats).unwrap();
                let near = (figure.million_splats_per_sec / printed - 1.0).abs() < 0.02;
                assert!(near, "{splats}: {figure:?} {printed}");
            }
        }
        assert_eq!(paper_throughput(PaperMethod::Raycast, 150_000), None);
    }

    #[test]
    fn every_pass_of_every_method_has_a_row() {
        let rows = [row()];
        let grid = throughput_grid("t", &rows);
        assert_eq!(grid.rows[2][..4], ["154000", "raycast", grid.rows[2][2].as_str(), "(33.0)"]);
        // What the paper does not have is not beside another's.
        assert_eq!((grid.rows[1][3].as_str(), grid.rows[1][9].as_str()), ("", ""));
        let passes = passes_grid("t", &rows);
        assert_eq!(passes.rows.len(), 12);
        let paper: Vec<&str> = passes.rows.iter().map(|row| row[10].as_str()).collect();
        assert_eq!(paper[..9], ["(46/3)", "(58/3)", "", "", "", "", "(34/9)", "(35/13)", ""]);
    }
}
