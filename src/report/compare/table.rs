//! The comparison for people: what the methods cost, then how wrong they are.

use std::fmt;

use super::{CompareReport, Deviation, ErrorFigures, MethodRow, PassRow};
use crate::report::{
    Grid, Spread,
    cells::{figure, interval, median, number, scientific},
    grid::Table,
};

/// The passes that every frame has; all others are summed up.
const COMMON_PASSES: [(&str, &str); 3] =
    [("visibility", "vis."), ("accumulate", "acc."), ("finalize", "fin.")];

/// The columns in words.
const COSTS: &str = "\
ms: milliseconds, medians, each with how far the smallest and the largest lie from it; other: all further passes together;
frame: one whose passes are not timed, which may take less than they do together
fragments: invocations of the fragment stage in one frame; VP/FP: instructions as in vertex and fragment programs of 2006
*: on the Pareto front: no other method is at least as good in frame ms and image (within 1%: equal) and better in one";
const ERRORS: &str = "\
max, rms: linear color, white is 1; psnr: decibels below white; ssim: 1 for equal pictures, over the whole picture
normal: degrees, rms; depth: relative, rms; both and the color over pixels that both pictures cover
image: rms of linear color over a white background, over pixels that either picture touches
cov px: pixels covered in one and empty in the other (the truth covers from one half on)
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
        let grids = self.grids().map(|grid| grid.to_string());
        write!(f, "{}", grids.join("\n"))?;
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

    /// The methods' costs, and both of their errors. The rows are those of the methods.
    pub fn grids(&self) -> [Grid; 3] {
        [self.costs(), self.implementation_errors(), self.method_errors()]
    }

    /// A table with a row for each method, which says first which it is.
    fn table(&self, title: &str) -> Table<'_, MethodRow> {
        Grid::of(title, &self.methods)
            .names(4)
            .column("  rasterizer", |row| {
                format!("{} {}", if row.pareto { '*' } else { ' ' }, row.method.rasterizer.name())
            })
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
            .grid()
    }

    fn method_errors(&self) -> Grid {
        self.table("method error: against the ground truth")
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
