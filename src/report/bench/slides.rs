//! The slides' table of Guennebaud, Barthe, Paulin 2006 ("splat rasterization implementations"): what the slides say of five
//! methods beside what they cost here.

use super::{Measurement, Throughput, ThroughputRow};
use crate::report::{
    Grid,
    cells::{median, number},
};

/// A method's row in the slides.
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
    /// Instructions of the setup and of the rasterization of a fragment; those of software are not known.
    pub instructions: &'static str,
}

/// The slides' rows, the paper's own method first.
pub const SLIDES: [Slide; 5] = [
    slide("PBG06", ["yes", "(yes)", "yes"], "58/3"),
    slide("ZPvG01", ["no", "yes", "yes"], "software"),
    slide("Guennebaud03", ["no", "yes", "yes"], "51/6"),
    slide("ZRB04", ["(yes)", "yes", "yes"], "93/8"),
    slide("BHZK05", ["yes", "yes", "no"], "35/13"),
];

const fn slide(paper: &'static str, says: [&'static str; 3], instructions: &'static str) -> Slide {
    let [perspective, ewa, incremental] = says;
    Slide { paper, perspective, ewa, incremental, instructions }
}

/// The slides' table beside what was measured. Methods are in the order of [`SLIDES`].
pub fn slides_grid(row: &ThroughputRow) -> Grid {
    let rows: Vec<(&Slide, &Measurement<Throughput>)> = SLIDES.iter().zip(&row.methods).collect();
    let ms = |own: &Measurement<Throughput>, name: &str| {
        let pass = own.frames.passes.iter().find(|pass| pass.name == name);
        number(pass.and_then(|pass| pass.ms).map(|ms| ms.median), 2)
    };
    Grid::of(format!("the slides' methods, {} splats", row.splats), &rows)
        .column("method", |(_, own)| own.name.clone())
        .column("perspective", |(slide, _)| slide.perspective)
        .column("EWA filter", |(slide, _)| slide.ewa)
        .column("incremental", |(slide, _)| slide.incremental)
        .column("VP/FP (slides)", |(slide, _)| slide.instructions)
        .column("VP/FP", |(_, own)| own.subject.instructions_cell("accumulate"))
        .column("visibility ms", |(_, own)| ms(own, "visibility"))
        .column("accumulate ms", |(_, own)| ms(own, "accumulate"))
        .column("frame ms", |(_, own)| median(own.frames.frame_ms, 2))
        .column("x first", |(_, own)| median(own.beside_first, 3))
        .note(
            "yes, no: what the slides say; VP/FP: instructions of the attribute pass, ours with all that keeps hard splats right",
        )
        .grid()
}
