//! The error over the distance as a plot.

use plotters::prelude::*;

use super::ZoomReport;
use crate::{
    error::Result,
    report::plot::{
        LEGEND_WIDTH_PX, LogAxis, SIZE_PX, Sign, band, color, failed, legend, log_chart, logarithmic,
    },
};

impl ZoomReport {
    /// The RMS of each filter's error over the distance, as SVG; both axes are logarithmic. Steps without an error are not
    /// in it.
    ///
    /// # Errors
    /// None that an input could lead to.
    pub fn plot_svg(&self) -> Result<String> {
        let mut svg = String::new();
        self.draw(SVGBackend::with_string(&mut svg, SIZE_PX)).map_err(failed)?;
        Ok(svg)
    }

    fn draw<B: DrawingBackend>(
        &self,
        backend: B,
    ) -> std::result::Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        let line = |filter: usize| {
            let place = move |step: &super::ZoomStep| Some((step.pixels_per_splat, step.rms(filter)?));
            let drawn = |(_, rms): &(f64, f64)| *rms > 0.0 && rms.is_finite();
            self.steps.iter().filter_map(place).filter(drawn).collect::<Vec<_>>()
        };
        let lines: Vec<_> = (0..self.filters.len()).map(line).collect();
        let px = logarithmic(self.steps.iter().map(|step| step.pixels_per_splat));
        let rms = logarithmic(lines.iter().flatten().map(|(_, rms)| *rms));
        let (bottom, top) = (rms.0.start, rms.0.end);
        let root = backend.into_drawing_area();
        root.fill(&WHITE)?;
        let ([width, height], side) = (self.size_px, self.board.splats_per_side);
        let caption = format!(
            "checkerboard of {side}x{side} splats, tilted by {} degrees, {width}x{height} pixels",
            self.board.tilt_deg
        );
        let (left, right) = root.split_horizontally(SIZE_PX.0 - LEGEND_WIDTH_PX);
        let mut chart = log_chart(
            &left,
            &caption,
            LogAxis { name: "pixels a splat, in the middle of the picture", range: px },
            LogAxis { name: "RMS of linear color against the ground truth", range: rms },
        )?;
        let mixed: Vec<f64> = self
            .steps
            .iter()
            .filter(|step| step.is_mixed(&self.board))
            .map(|step| step.pixels_per_splat)
            .collect();
        if let (Some(first), Some(last)) = (mixed.first(), mixed.last()) {
            chart.draw_series([Rectangle::new([(*first, bottom), (*last, top)], band())])?;
        }
        for (i, line) in lines.into_iter().enumerate() {
            chart.draw_series(LineSeries::new(line, color(i).stroke_width(2)).point_size(3))?;
        }
        let names = self.filters.iter().enumerate();
        let lines = names.map(|(i, filter)| (Sign::Line(color(i), 2), filter.line()));
        let mixed = [(Sign::Band, "mixed: larger than the"), (Sign::Letters(""), "filter along one axis")];
        legend(&right, lines.chain(mixed.map(|(sign, text)| (sign, text.to_owned()))))?;
        root.present()
    }
}
