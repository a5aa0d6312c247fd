//! Why a filter ranks as it does: where its error is, and what of the filter makes it.

use super::{CompareReport, MethodRow, WeightedFilter};
use crate::{report::picture::RegionError, scene::Filter};

/// Errors inside up to this factor above the least count as near it.
const NEAR_THE_LEAST: f64 = 1.25;

/// A silhouette is hard where fewer of its pixels than this share are covered in part. In the truth it is the most of them.
const HARD_SHARE: f64 = 0.05;

impl CompareReport {
    /// A line for each filter, of that method of it whose picture is the nearest to the truth, the nearest filter first.
    pub(super) fn why_of_filters(&self) -> Vec<String> {
        let whole = |row: &MethodRow| row.picture_error.whole.rms().unwrap_or(f64::INFINITY);
        let mut best: Vec<&MethodRow> = Vec::new();
        for row in &self.methods {
            match best.iter_mut().find(|other| other.method.filter == row.method.filter) {
                Some(other) if whole(row) < whole(other) => *other = row,
                Some(_) => (),
                None => best.push(row),
            }
        }
        best.sort_by(|a, b| whole(a).total_cmp(&whole(b)));
        let inside = |row: &&MethodRow| row.picture_error.inside.rms();
        let least = best.iter().filter_map(inside).fold(f64::INFINITY, f64::min);
        best.iter().filter(|row| row.picture_error.whole.px > 0).map(|row| line(row, least)).collect()
    }
}

fn line(row: &MethodRow, least: f64) -> String {
    let error = &row.picture_error;
    let squares = |region: &RegionError| region.rms().map_or(0.0, |rms| rms * rms * region.px as f64);
    let share = 100.0 * squares(&error.silhouette) / squares(&error.whole).max(f64::MIN_POSITIVE);
    let hard = (error.partial_px as f64) < HARD_SHARE * error.silhouette.px as f64;
    let edges = if hard { "hard" } else { "soft" };
    let wide = match error.wider_px {
        Some(wider) if wider.abs() >= 0.05 => {
            format!(", {:.1} px too {}", wider.abs(), if wider > 0.0 { "wide" } else { "narrow" })
        }
        _ => String::new(),
    };
    let inside = match error.inside.rms() {
        Some(rms) if rms > NEAR_THE_LEAST * least => {
            format!("inside {:.1} x the least: {}", rms / least, cause(row.method.filter))
        }
        Some(_) => "inside as near as any".to_owned(),
        None => "nothing is inside".to_owned(),
    };
    let rms = error.whole.rms().unwrap_or(f64::INFINITY);
    format!("{}: {rms:.4}; {share:.0}% of its square at {edges} edges{wide}; {inside}", row.method.filter)
}

/// What a filter does inside of a surface that the truth does not.
fn cause(filter: WeightedFilter) -> &'static str {
    match filter.filter {
        Filter::None => "detail below a pixel aliases",
        Filter::Adjust => "splats below a pixel are widened, and blur",
        Filter::AdjustPaper => "clamped half axes blur tilted splats",
        Filter::Max => "the larger of two kernels blurs",
        Filter::Ewa => "splats that overlap are each blurred again",
    }
}
