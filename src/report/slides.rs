//! The slides' table of Guennebaud, Barthe, Paulin 2006 ("splat rasterization implementations"): what the slides say of five
//! methods beside what they cost here.

use super::{
    ThroughputRow,
    grid::{Grid, cell},
    throughput_table::instructions_cell,
};

/// What the slides say of a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Slide {
    /// Its paper.
    pub paper: &'static str,
    /// Whether splats are perspectively correct.
    pub perspective: &'static str,
    /// Whether it has an EWA filter.
    pub ewa: &'static str,
    /// Whether it can be evaluated incrementally along a row.
    pub incremental: &'static str,
    /// Instructions of the setup and of the rasterization of a fragment; `None` for software.
    pub instructions: Option<[u32; 2]>,
}

/// The slides' rows, the paper's own method first.
pub const SLIDES: [Slide; 5] = [
    slide("PBG06", ["yes", "(yes)", "yes"], Some([58, 3])),
    slide("ZPvG01", ["no", "yes", "yes"], None),
    slide("Guennebaud03", ["no", "yes", "yes"], Some([51, 6])),
    slide("ZRB04", ["(yes)", "yes", "yes"], Some([93, 8])),
    slide("BHZK05", ["yes", "yes", "no"], Some([35, 13])),
];

const fn slide(paper: &'static str, says: [&'static str; 3], instructions: Option<[u32; 2]>) -> Slide {
    let [perspective, ewa, incremental] = says;
    Slide { paper, perspective, ewa, incremental, instructions }
}

/// What the slides say beside what was measured. Methods are in the order of [`SLIDES`].
pub fn slides_grid(row: &ThroughputRow) -> Grid {
    let head = [
        "method",
        "perspective",
        "EWA filter",
        "incremental",
        "VP/FP (slides)",
        "VP/FP",
        "visibility ms",
        "accumulate ms",
        "frame ms",
        "x first",
    ];
    let mut grid = Grid::new(format!("the slides' methods, {} splats", row.splats), &head);
    for ((slide, method), beside) in SLIDES.iter().zip(&row.methods).zip(&row.beside_first) {
        let ms = |name: &str| {
            let pass = method.frames.passes.iter().find(|pass| pass.name == name);
            cell(pass.and_then(|pass| pass.ms).map(|ms| ms.median), 2)
        };
        let said = slide.instructions.map_or_else(|| "software".to_owned(), |[vp, fp]| format!("{vp}/{fp}"));
        grid.row([
            method.name.clone(),
            slide.perspective.to_owned(),
            slide.ewa.to_owned(),
            slide.incremental.to_owned(),
            said,
            instructions_cell(method, "accumulate"),
            ms("visibility"),
            ms("accumulate"),
            cell(method.frames.frame_ms.map(|ms| ms.median), 2),
            cell(beside.map(|spread| spread.median), 3),
        ]);
    }
    grid.notes.push(
        "yes, no: what the slides say; VP/FP: instructions of the attribute pass, ours with all that keeps hard splats right"
            .to_owned(),
    );
    grid
}
