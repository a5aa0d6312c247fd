//! The error over the distance as a plot.

use plotters::prelude::*;

use super::ZoomReport;
use crate::{
    error::Result,
    report::plot::{FONT, SIZE_PX, color, failed, logarithmic, mark},
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
        let (px, px_marks) = logarithmic(self.steps.iter().map(|step| step.pixels_per_splat));
        let (rms, rms_marks) = logarithmic(lines.iter().flatten().map(|(_, rms)| *rms));
        let bottom = rms.start;
        let top = rms.end;
        let root = backend.into_drawing_area();
        root.fill(&WHITE)?;
        let ([width, height], side) = (self.size_px, self.board.splats_per_side);
        let caption = format!(
            "checkerboard of {side}x{side} splats, tilted by {} degrees, {width}x{height} pixels",
            self.board.tilt_deg
        );
        let mut chart = ChartBuilder::on(&root)
            .caption(caption, (FONT, 20))
            .margin(16)
            .x_label_area_size(48)
            .y_label_area_size(84)
            .build_cartesian_2d(
                px.log_scale().with_key_points(px_marks),
                rms.log_scale().with_key_points(rms_marks),
            )?;
        chart
            .configure_mesh()
            .x_desc("pixels a splat, in the middle of the picture")
            .y_desc("RMS of linear color against the ground truth")
            .x_label_formatter(&|value| mark(*value))
            .y_label_formatter(&|value| mark(*value))
            .label_style((FONT, 14))
            .draw()?;
        let mixed: Vec<f64> = self
            .steps
            .iter()
            .filter(|step| step.is_mixed(&self.board))
            .map(|step| step.pixels_per_splat)
            .collect();
        if let (Some(first), Some(last)) = (mixed.first(), mixed.last()) {
            let band = Rectangle::new([(*first, bottom), (*last, top)], BLACK.mix(0.07).filled());
            chart
                .draw_series([band])?
                .label("splats larger than the filter along one axis alone")
                .legend(|(x, y)| Rectangle::new([(x, y - 5), (x + 20, y + 5)], BLACK.mix(0.15).filled()));
        }
        for (i, (filter, line)) in self.filters.iter().zip(lines).enumerate() {
            let style = color(i).stroke_width(2);
            chart
                .draw_series(LineSeries::new(line, style).point_size(3))?
                .label(filter.line())
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 20, y)], color(i).stroke_width(2)));
        }
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::LowerLeft)
            .background_style(WHITE.mix(0.85))
            .border_style(BLACK.mix(0.3))
            .label_font((FONT, 13))
            .draw()?;
        root.present()
    }
}
