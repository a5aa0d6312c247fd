//! The comparison for people: what the methods cost, then how wrong they are.

use std::fmt;

use super::{CompareReport, Deviation, ErrorFigures, MethodRow, Skipped};
use crate::report::Spread;

/// The passes that every frame has; all others are summed up.
const COMMON_PASSES: [&str; 3] = ["visibility", "accumulate", "finalize"];

/// What the columns mean.
const FOOT: &str = "\
ms: milliseconds, medians, each with how far the smallest and the largest lie from it; other: all further passes together;
frame: one whose passes are not timed, which may take less than they do together
fragments: invocations of the fragment stage in one frame; VP/FP: instructions as in vertex and fragment programs of 2006
implementation error: against the 64-bit oracle of the same method; method error: against the ground truth
max, rms: linear color, white is 1; psnr: decibels below white; ssim: 1 for equal pictures, over the whole picture
normal: degrees, rms; depth: relative, rms; both and the color over pixels that both pictures cover
image: rms of linear color over a white background, over pixels that either picture touches
cov px: pixels covered in one and empty in the other (the truth covers from one half on)
out: share of the covered pixels left out because a rim or the epsilon-threshold falls on their center within rounding
*: on the Pareto front: no other method is at least as good in frame ms and image (within 1%: equal) and better in one";

impl fmt::Display for CompareReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let side = |[width, height]: [u32; 2]| format!("{width}x{height}");
        writeln!(f, "{}, {}; {} splats", self.device.name, self.device.driver, self.splats)?;
        writeln!(
            f,
            "times and fragments at {}, {} frames each, in turn; errors at {}; ground truth of {} samples a pixel",
            side(self.time_size_px),
            self.timed_frames,
            side(self.error_size_px),
            u64::from(self.samples_per_side).pow(2),
        )?;
        self.times(f)?;
        writeln!(f)?;
        self.errors(f)?;
        writeln!(f, "{FOOT}")?;
        for (reason, methods) in grouped(&self.skipped) {
            let (count, plural) = (methods.len(), if methods.len() == 1 { "" } else { "s" });
            writeln!(f, "skipped, {count} method{plural}: {reason}")?;
        }
        let flagged: Vec<&MethodRow> = self.methods.iter().filter(|row| !row.flags.is_empty()).collect();
        if let Some(first) = flagged.first() {
            let count = flagged.len();
            writeln!(
                f,
                "note: the times of {count} methods are flagged (all in the JSON); {}: {}",
                first.method.line(),
                first.flags[0]
            )?;
        }
        for note in &self.notes {
            writeln!(f, "note: {note}")?;
        }
        Ok(())
    }
}

impl CompareReport {
    fn times(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{} {:>8} {:9} {:>8} {:9} {:>8} {:9} {:>8} {:>8} {:9} {:>11} {:>11} {:>11} {:>10} {:>10}",
            heads(),
            "vis. ms",
            "",
            "acc. ms",
            "",
            "fin. ms",
            "",
            "other ms",
            "frame ms",
            "",
            "vis. frag.",
            "acc. frag.",
            "fin. frag.",
            "vis. VP/FP",
            "acc. VP/FP",
        )?;
        for row in &self.methods {
            let ms = |name: &str| {
                median_sum(row.passes.iter().filter(|pass| pass.name == name).map(|pass| pass.ms))
            };
            let [visibility, accumulate, finalize] = COMMON_PASSES.map(ms);
            let spread = |name: &str| {
                spread(row.passes.iter().find(|pass| pass.name == name).and_then(|pass| pass.ms))
            };
            let further = row.passes.iter().filter(|pass| !COMMON_PASSES.contains(&pass.name.as_str()));
            let [vis_fragments, acc_fragments, fin_fragments] = COMMON_PASSES.map(|name| row.fragments(name));
            writeln!(
                f,
                "{} {} {} {} {} {} {} {} {} {} {} {} {} {:>10} {:>10}",
                names(row),
                ms_column(visibility),
                spread(COMMON_PASSES[0]),
                ms_column(accumulate),
                spread(COMMON_PASSES[1]),
                ms_column(finalize),
                spread(COMMON_PASSES[2]),
                ms_column(median_sum(further.map(|pass| pass.ms))),
                ms_column(row.frame_ms.map(|ms| ms.median)),
                self::spread(row.frame_ms),
                count(vis_fragments),
                count(acc_fragments),
                count(fin_fragments),
                row.instructions(COMMON_PASSES[0]),
                row.instructions(COMMON_PASSES[1]),
            )?;
        }
        Ok(())
    }

    fn errors(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let width = heads().len();
        writeln!(f, "{:width$} {:40}   method error", "", "implementation error")?;
        writeln!(
            f,
            "{} {:>8} {:>8} {:>6} {:>6} {:>8}   {:>8} {:>8} {:>6} {:>8} {:>7} {:>6} {:>8} {:>8}",
            heads(),
            "max",
            "rms",
            "out",
            "cov px",
            "normal",
            "max",
            "rms",
            "psnr",
            "image",
            "ssim",
            "cov px",
            "normal",
            "depth",
        )?;
        for row in &self.methods {
            let (own, method) = (&row.implementation_error, &row.method_error);
            writeln!(
                f,
                "{} {} {} {:5.2}% {:6} {}   {} {} {} {} {} {:6} {} {}",
                names(row),
                small(max(own.color), 8),
                small(rms(own.color), 8),
                100.0 * own.left_out_share,
                own.coverage_px,
                small(rms(own.normal_deg), 8),
                small(max(method.color), 8),
                small(rms(method.color), 8),
                psnr(method),
                digits(rms(method.image)),
                method.ssim.map_or_else(|| format!("{:>7}", "-"), |ssim| format!("{ssim:7.4}")),
                method.coverage_px,
                small(rms(method.normal_deg), 8),
                small(rms(method.depth), 8),
            )?;
        }
        Ok(())
    }
}

/// The columns that say which method it is.
fn heads() -> String {
    format!("  {:21} {:17} {:4} {:8}", "rasterizer", "filter", "sums", "kernel")
}

fn names(row: &MethodRow) -> String {
    let method = &row.method;
    let front = if row.pareto { '*' } else { ' ' };
    // Early depth changes no picture: a mark behind the rasterizer is enough.
    let rasterizer = method.rasterizer.to_owned();
    let filter = method.filter_and_weight();
    format!("{front} {rasterizer:21} {filter:17} {:4} {:8}", method.accumulate, method.kernel_eval)
}

/// The medians together; `None` where one is missing, or there is none at all.
fn median_sum(spreads: impl Iterator<Item = Option<Spread>>) -> Option<f64> {
    let medians: Vec<f64> =
        spreads.map(|spread| spread.map(|spread| spread.median)).collect::<Option<_>>()?;
    (!medians.is_empty()).then(|| medians.iter().sum())
}

fn max(deviation: Option<Deviation>) -> Option<f64> {
    deviation.map(|deviation| deviation.max)
}

fn rms(deviation: Option<Deviation>) -> Option<f64> {
    deviation.map(|deviation| deviation.rms)
}

fn ms_column(ms: Option<f64>) -> String {
    ms.map_or_else(|| format!("{:>8}", "-"), |ms| format!("{ms:8.3}"))
}

/// The smallest and the largest beside the median, in percent.
fn spread(ms: Option<Spread>) -> String {
    let beside = |ms: Spread| {
        let percent = |value: f64| 100.0 * (value / ms.median - 1.0);
        format!("{:.0}+{:.0}%", percent(ms.min).min(-0.0), percent(ms.max))
    };
    format!("{:9}", ms.filter(|ms| ms.median > 0.0).map_or_else(String::new, beside))
}

/// Enough digits to tell methods on the front from others.
fn digits(value: Option<f64>) -> String {
    value.map_or_else(|| format!("{:>8}", "-"), |value| format!("{:>8}", format!("{value:.2e}")))
}

fn count(count: Option<u64>) -> String {
    count.map_or_else(|| format!("{:>11}", "-"), |count| format!("{count:11}"))
}

/// A number of any magnitude.
fn small(value: Option<f64>, width: usize) -> String {
    match value {
        None => format!("{:>width$}", "-"),
        Some(0.0) => format!("{:>width$}", "0"),
        Some(value) => format!("{:>width$}", format!("{value:.1e}")),
    }
}

fn psnr(figures: &ErrorFigures) -> String {
    match figures.psnr_db {
        Some(decibels) => format!("{decibels:6.2}"),
        None if figures.color.is_some_and(|color| color.rms == 0.0) => format!("{:>6}", "equal"),
        None => format!("{:>6}", "-"),
    }
}

/// The reasons in the order in which they came, each with its methods.
fn grouped(skipped: &[Skipped]) -> Vec<(&str, Vec<&Skipped>)> {
    let mut groups: Vec<(&str, Vec<&Skipped>)> = Vec::new();
    for method in skipped {
        match groups.iter_mut().find(|(reason, _)| *reason == method.reason) {
            Some((_, methods)) => methods.push(method),
            None => groups.push((&method.reason, vec![method])),
        }
    }
    groups
}
