//! Speed against error as a plot.

use plotters::style::BLACK;

use super::{CompareReport, MethodRow};
use crate::{
    report::plot::{Axis, Chart, Mark, Place, Plot, Sign, color},
    scene::{Accumulate, Filter, Rasterizer},
};

impl CompareReport {
    /// Milliseconds of a frame against the RMS of the whole picture's error; both axes are logarithmic, the Pareto front is a
    /// line with the names of its methods. Methods without one of the figures are not in it.
    pub fn plot(&self) -> Plot {
        let dots: Vec<(&MethodRow, Place)> =
            self.methods.iter().filter_map(|row| Some((row, place(row)?))).collect();
        let mut front: Vec<&(&MethodRow, Place)> = dots.iter().filter(|(row, _)| row.pareto).collect();
        front.sort_by(|a, b| a.1.0.total_cmp(&b.1.0));
        let points = front.iter().map(|(_, at)| *at).collect();
        let mut marks = vec![Mark::Line { points, color: BLACK, width: 1, dot_px: 0 }];
        let filter =
            |row: &MethodRow| Filter::NAMES.iter().position(|(_, own)| *own == row.method.filter.filter);
        marks.extend(dots.iter().filter_map(|(row, at)| {
            let filled = row.method.accumulate == Accumulate::F32;
            Some(Mark::Dot { at: *at, color: color(filter(row)?), filled })
        }));
        let text = |at: Place, text: String, offset_px, size_px, black| Mark::Text {
            at,
            text,
            offset_px,
            size_px,
            black,
        };
        let codes = dots.iter().map(|(row, at)| (code(row.method.rasterizer).to_owned(), *at));
        marks.extend(codes.map(|(code, at)| text(at, code, (5, 3), 10, 0.6)));
        marks.extend(front.iter().map(|(row, at)| text(*at, row.method.to_string(), (8, -16), 13, 1.0)));
        let [[width, height], [error_width, error_height]] = [self.time_size_px, self.error_size_px];
        let caption = format!(
            "{}: {} splats, times at {width}x{height}, errors at {error_width}x{error_height}",
            self.device.name, self.splats
        );
        let x = Axis::logarithmic("milliseconds a frame (median)", dots.iter().map(|(_, at)| at.0));
        let name = "RMS of the whole picture in linear light, against the ground truth";
        let y = Axis::logarithmic(name, dots.iter().map(|(_, at)| at.1));
        let charts = vec![Chart { caption, x, y, marks }];
        Plot { charts, legend: legend(), ..Plot::default() }
    }
}

fn place(row: &MethodRow) -> Option<Place> {
    let [ms, rms] = row.speed_and_error()?;
    (ms > 0.0 && rms > 0.0 && ms.is_finite() && rms.is_finite()).then_some((ms, rms))
}

/// Filters by color, sums by filling, rasterizers by letters.
fn legend() -> Vec<(Sign, String)> {
    let filters = Filter::NAMES.iter().enumerate().map(|(i, (name, _))| (Sign::Dot(color(i), true), *name));
    let sums = [(Sign::Dot(BLACK, false), "16-bit sums"), (Sign::Dot(BLACK, true), "32-bit sums")];
    let rasterizers = Rasterizer::METHODS.iter().map(|(name, own)| (Sign::Letters(code(*own)), *name));
    let lines = filters.chain(sums).chain(rasterizers).chain([(Sign::Line(BLACK, 1), "Pareto front")]);
    lines.map(|(sign, text)| (sign, text.to_owned())).collect()
}

/// A rasterizer in two letters at most.
fn code(rasterizer: Rasterizer) -> &'static str {
    match rasterizer {
        Rasterizer::Auto => "auto",
        Rasterizer::Perspective => "p",
        Rasterizer::PerspectivePaper => "pp",
        Rasterizer::Raycast => "r",
        Rasterizer::RaycastApproximate => "ra",
        Rasterizer::AffineCenter => "ac",
        Rasterizer::AffineContour => "ao",
        Rasterizer::Triangle => "t",
        Rasterizer::Quad => "q",
        Rasterizer::Compute => "s",
    }
}
