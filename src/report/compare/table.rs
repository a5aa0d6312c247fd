//! The comparison for people: one table of what the methods cost and how near they are, and all figures for pages.

use std::fmt;

use super::{CompareReport, Deviation, ErrorFigures, MethodRow, PassRow};
use crate::{
    report::{
        Grid, Spread,
        cells::{figure, interval, median, number, scientific},
        grid::Table,
        picture::{PictureError, RegionError},
    },
    scene::KernelEval,
};

/// The passes that every frame has; all others are summed up.
const COMMON_PASSES: [(&str, &str); 3] =
    [("visibility", "vis."), ("accumulate", "acc."), ("finalize", "fin.")];

/// The columns in words.
const COSTS: &str = "\
ms: milliseconds, medians, each with how far the smallest and the largest lie from it; other: all further passes together;
frame: one whose passes are not timed, which may take less than they do together
fragments: invocations of the fragment stage in one frame; VP/FP: instructions as in vertex and fragment programs of 2006
*: on the Pareto front: no other method is at least as good in frame ms and whole (within 1%: equal) and better in one";
const SUMMARY: &str = "\
frame ms: median; own: rms of linear color against the 64-bit oracle of the same method; tex.: the kernel from a texture
whole, inside, edges: rms in linear light over white or black, the larger; edges: within 2 px of an edge of the truth
FLIP: the mean difference that is seen, 0 to 1; dark: the darkest fringe over white, 255ths of sRGB; all else in --json
*: on the Pareto front: no other method is at least as good in frame ms and whole (within 1%: equal) and better in one";
const PLACES: &str = "\
rms in linear light, white is 1, and the mean of FLIP, 0 to 1; each over white or over black, the larger
edges: within 2 pixels of one through which an edge of the truth passes; inside: all others that the truth covers
dark: by how much a pixel of an edge is darker over white at most, in 255ths of sRGB
px wider: area covered beyond the truth, a pixel of the outline; partial px: pixels at edges that are covered in part";
const ERRORS: &str = "\
max, rms: linear color, white is 1; psnr: decibels below white; ssim: 1 for equal pictures, over the whole picture
normal: degrees, rms; depth: relative, rms; both and the color over pixels that both pictures cover
image: rms of linear color over a white background, over pixels that either picture touches
cov px: pixels covered in one and empty in the other (the truth covers from one half on)";
const OWN: &str = "\
out: share of the covered pixels left out because a rim or the epsilon-threshold falls on their center within rounding";

impl fmt::Display for CompareReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{}, {}; {} splats\n{}",
            self.device.name,
            self.device.driver,
            self.splats,
            self.setting()
        )?;
        write!(f, "{}", self.summary())?;
        for line in &self.why {
            writeln!(f, "{line}")?;
        }
        for (reason, count) in self.reasons() {
            let plural = if count == 1 { "" } else { "s" };
            writeln!(f, "skipped, {count} method{plural}: {reason}")?;
        }
        let mut flagged = self.methods.iter().filter(|row| !row.flags.is_empty());
        if let Some(first) = flagged.next() {
            let (count, line, flag) = (1 + flagged.count(), first.method, &first.flags[0]);
            writeln!(f, "note: the times of {count} methods are flagged (all in the JSON); {line}: {flag}")?;
        }
        self.notes.iter().try_for_each(|note| writeln!(f, "note: {note}"))
    }
}

impl CompareReport {
    /// How it was measured.
    pub fn setting(&self) -> String {
        let side = |[width, height]: [u32; 2]| format!("{width}x{height}");
        format!(
            "times and fragments at {}, {} frames each, in turn; errors at {}; ground truth of {} samples a pixel",
            side(self.time_size_px),
            self.timed_frames,
            side(self.error_size_px),
            u64::from(self.samples_per_side).pow(2),
        )
    }

    /// Why methods were left out, in the order in which that came, and how many.
    pub fn reasons(&self) -> Vec<(&str, usize)> {
        let mut reasons: Vec<(&str, usize)> = Vec::new();
        for skipped in &self.skipped {
            match reasons.iter_mut().find(|(reason, _)| *reason == skipped.reason) {
                Some((_, count)) => *count += 1,
                None => reasons.push((&skipped.reason, 1)),
            }
        }
        reasons
    }

    /// The methods' costs, and each of their errors. The rows are those of the methods.
    pub fn grids(&self) -> [Grid; 4] {
        [self.costs(), self.picture_errors(), self.method_errors(), self.implementation_errors()]
    }

    /// All of it at a glance: the time, and how near the pictures are. Terminals have 120 columns.
    pub fn summary(&self) -> Grid {
        let table = Grid::of(
            "methods: what a frame costs, and how far its picture is from the ground truth",
            &self.methods,
        )
        .names(3)
        .column("  rasterizer", starred)
        .column("filter", |row| row.method.filter)
        .column("sums", sums)
        .column("frame ms", |row| median(row.frame_ms, 1))
        .column("own", |row| {
            figure(row.implementation_error.color.map(|color| format!("{:.0e}", color.rms)))
        });
        by_place(table).with_notes(SUMMARY.lines().map(str::to_owned))
    }

    /// A table with a row for each method, which says first which it is.
    fn table(&self, title: &str) -> Table<'_, MethodRow> {
        Grid::of(title, &self.methods)
            .names(4)
            .column("  rasterizer", starred)
            .column("filter", |row| row.method.filter)
            .column("sums", |row| row.method.accumulate.name())
            .column("kernel", |row| row.method.kernel_eval.name())
    }

    fn costs(&self) -> Grid {
        let mut table = self.table("what the methods cost");
        for (pass, short) in COMMON_PASSES {
            let ms = |row: &MethodRow| row.pass(pass).and_then(|pass| pass.figures.ms);
            table = table.column(format!("{short} ms"), |row| median(ms(row), 3));
            table = table.column("", |row| ends(ms(row)));
        }
        let is_common = |pass: &PassRow| COMMON_PASSES.iter().any(|(name, _)| *name == pass.figures.name);
        let others = |row: &MethodRow| {
            let others = row.passes.iter().filter(|pass| !is_common(pass));
            let ms: Option<Vec<f64>> = others.map(|pass| Some(pass.figures.ms?.median)).collect();
            ms.filter(|ms| !ms.is_empty()).map(|ms| ms.iter().sum())
        };
        table = table
            .column("other ms", |row| number(others(row), 3))
            .column("frame ms", |row| median(row.frame_ms, 3))
            .column("", |row| ends(row.frame_ms))
            .column("95% of the median", |row| interval(row.frame_ms, 3));
        for (pass, short) in COMMON_PASSES {
            let fragments = |row: &MethodRow| row.pass(pass).and_then(|pass| pass.figures.fragments);
            table = table.column(format!("{short} frag."), |row| figure(fragments(row)));
        }
        for (pass, short) in &COMMON_PASSES[..2] {
            let instructions = |row: &MethodRow| row.pass(pass).and_then(PassRow::instructions);
            table = table.column(format!("{short} VP/FP"), |row| figure(instructions(row)));
        }
        table.with_notes(COSTS.lines().map(str::to_owned))
    }

    fn implementation_errors(&self) -> Grid {
        self.table("implementation error: against the 64-bit oracle of the same method")
            .column("max", |row| max(row.implementation_error.color))
            .column("rms", |row| rms(row.implementation_error.color))
            .column("out", |row| format!("{:.2}%", 100.0 * row.implementation_error.left_out_share))
            .column("cov px", |row| row.implementation_error.coverage_px)
            .column("normal", |row| rms(row.implementation_error.normal_deg))
            .note(OWN)
            .grid()
    }

    fn picture_errors(&self) -> Grid {
        by_place(self.table("picture error: against the ground truth, by place"))
            .column("px wider", |row| number(row.picture_error.wider_px, 2))
            .column("partial px", |row| row.picture_error.partial_px)
            .with_notes(PLACES.lines().map(str::to_owned))
    }

    fn method_errors(&self) -> Grid {
        self.table("method error: against the ground truth, where both have a surface")
            .column("max", |row| max(row.method_error.color))
            .column("rms", |row| rms(row.method_error.color))
            .column("psnr", |row| psnr(&row.method_error))
            .column("image", |row| rms(row.method_error.image))
            .column("ssim", |row| number(row.method_error.ssim, 4))
            .column("cov px", |row| row.method_error.coverage_px)
            .column("normal", |row| rms(row.method_error.normal_deg))
            .column("depth", |row| rms(row.method_error.depth))
            .with_notes(ERRORS.lines().map(str::to_owned))
    }
}

/// The rasterizer, with a star on the Pareto front.
fn starred(row: &MethodRow) -> String {
    format!("{} {}", if row.pareto { '*' } else { ' ' }, row.method.rasterizer.name())
}

/// The precision of the sums, and the kernel where that is not computed.
fn sums(row: &MethodRow) -> String {
    let kernel = if row.method.kernel_eval == KernelEval::default() { "" } else { " tex." };
    format!("{}{kernel}", row.method.accumulate.name())
}

/// The errors of the picture as columns.
fn by_place(mut table: Table<'_, MethodRow>) -> Table<'_, MethodRow> {
    type Of = fn(&PictureError) -> &RegionError;
    let places: [(&str, Of); 3] = [
        ("whole", |error| &error.whole),
        ("inside", |error| &error.inside),
        ("edges", |error| &error.silhouette),
    ];
    for (name, place) in places {
        table = table
            .column(name, move |row| number(place(&row.picture_error).rms(), 4))
            .column("FLIP", move |row| number(place(&row.picture_error).flip(), 3));
    }
    table.column("dark", |row| number(Some(row.picture_error.dark_fringe), 0))
}

fn max(deviation: Option<Deviation>) -> String {
    scientific(deviation.map(|deviation| deviation.max))
}

fn rms(deviation: Option<Deviation>) -> String {
    scientific(deviation.map(|deviation| deviation.rms))
}

/// The smallest and the largest beside the median, in percent.
fn ends(ms: Option<Spread>) -> String {
    let beside = |ms: Spread| {
        let percent = |value: f64| 100.0 * (value / ms.median - 1.0);
        format!("{:.0}+{:.0}%", percent(ms.min).min(-0.0), percent(ms.max))
    };
    ms.filter(|ms| ms.median > 0.0).map_or_else(String::new, beside)
}

fn psnr(figures: &ErrorFigures) -> String {
    match figures.color {
        Some(color) if color.rms == 0.0 => "equal".to_owned(),
        _ => number(figures.psnr_db, 2),
    }
}
