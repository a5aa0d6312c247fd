//! The error over the distance as a plot.

use super::ZoomReport;
use crate::report::plot::{Axis, Chart, Mark, Place, Plot, Sign, color};

impl ZoomReport {
    /// The RMS of each filter's error over the distance; both axes are logarithmic. Steps without an error are not in it.
    pub fn plot(&self) -> Plot {
        let line = |filter: usize| -> Vec<Place> {
            let places =
                self.steps.iter().filter_map(|step| Some((step.pixels_per_splat, step.rms(filter)?)));
            places.filter(|(_, rms)| *rms > 0.0 && rms.is_finite()).collect()
        };
        let lines: Vec<Vec<Place>> = (0..self.filters.len()).map(line).collect();
        let name = "pixels a splat, in the middle of the picture";
        let x = Axis::logarithmic(name, self.steps.iter().map(|step| step.pixels_per_splat));
        let name = "RMS of linear color against the ground truth";
        let y = Axis::logarithmic(name, lines.iter().flatten().map(|(_, rms)| *rms));
        let mixed = self.steps.iter().filter(|step| step.is_mixed(&self.board));
        let mut mixed = mixed.map(|step| step.pixels_per_splat);
        let mut marks = Vec::new();
        if let Some(first) = mixed.next() {
            marks.push(Mark::Band { x: [first, mixed.next_back().unwrap_or(first)] });
        }
        let mut legend = Vec::new();
        for (i, (points, filter)) in lines.into_iter().zip(&self.filters).enumerate() {
            marks.push(Mark::Line { points, color: color(i), width: 2, dot_px: 3 });
            legend.push((Sign::Line(color(i), 2), filter.to_string()));
        }
        legend.push((Sign::Band, "mixed: larger than the".to_owned()));
        legend.push((Sign::Letters(""), "filter along one axis".to_owned()));
        let ([width, height], side) = (self.size_px, self.board.splats_per_side);
        let caption = format!(
            "checkerboard of {side}x{side} splats, tilted by {} degrees, {width}x{height} pixels",
            self.board.tilt_deg
        );
        Plot { charts: vec![Chart { caption, x, y, marks }], legend, ..Plot::default() }
    }
}
