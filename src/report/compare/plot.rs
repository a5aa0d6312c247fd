//! Speed against error as a plot.

use plotters::prelude::*;

use super::{CompareReport, MethodRow};
use crate::{
    error::Result,
    report::plot::{
        FONT, LEGEND_WIDTH_PX, LogAxis, SIZE_PX, Sign, color, failed, legend, log_chart, logarithmic,
    },
    scene::{Filter, Rasterizer},
};

/// A method's place in the plot.
struct Dot<'a> {
    row: &'a MethodRow,
    place: (f64, f64),
}

impl CompareReport {
    /// Milliseconds of a frame against the RMS of the method error's color, as SVG; both axes are logarithmic, the Pareto
    /// front is a line with the names of its methods. Methods without one of the figures are not in it.
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
        let dots: Vec<Dot<'_>> = self.methods.iter().filter_map(Dot::of).collect();
        let ms = logarithmic(dots.iter().map(|dot| dot.place.0));
        let rms = logarithmic(dots.iter().map(|dot| dot.place.1));
        let root = backend.into_drawing_area();
        root.fill(&WHITE)?;
        let [[width, height], [error_width, error_height]] = [self.time_size_px, self.error_size_px];
        let caption = format!(
            "{}: {} splats, times at {width}x{height}, errors at {error_width}x{error_height}",
            self.device.name, self.splats
        );
        let (left, right) = root.split_horizontally(SIZE_PX.0 - LEGEND_WIDTH_PX);
        let mut chart = log_chart(
            &left,
            &caption,
            LogAxis { name: "milliseconds a frame (median)", range: ms },
            LogAxis { name: "RMS of the linear image against the ground truth", range: rms },
        )?;

        let mut front: Vec<&Dot<'_>> = dots.iter().filter(|dot| dot.row.pareto).collect();
        front.sort_by(|a, b| a.place.0.total_cmp(&b.place.0));
        chart.draw_series(LineSeries::new(front.iter().map(|dot| dot.place), BLACK.stroke_width(1)))?;
        for (i, (name, _)) in Filter::NAMES.iter().enumerate() {
            let own = dots.iter().filter(|dot| dot.row.method.filter == *name);
            // 32 bits are filled.
            let circle = |dot: &Dot<'_>| {
                let filled = dot.row.method.accumulate == "f32";
                let style = ShapeStyle { color: color(i).to_rgba(), filled, stroke_width: 1 };
                Circle::new(dot.place, 4, style)
            };
            chart.draw_series(own.map(circle))?;
        }
        chart.draw_series(dots.iter().map(|dot| {
            let code = code(dot.row.method.rasterizer).to_owned();
            EmptyElement::at(dot.place)
                + Text::new(code, (5, 3), (FONT, 10).into_font().color(&BLACK.mix(0.6)))
        }))?;
        chart.draw_series(front.iter().map(|dot| {
            EmptyElement::at(dot.place) + Text::new(dot.row.method.line(), (8, -16), (FONT, 13))
        }))?;
        legend(&right, legend_lines())?;
        root.present()
    }
}

impl<'a> Dot<'a> {
    fn of(row: &'a MethodRow) -> Option<Self> {
        let [ms, rms] = row.speed_and_error()?;
        let on_axes = ms > 0.0 && rms > 0.0 && ms.is_finite() && rms.is_finite();
        on_axes.then_some(Self { row, place: (ms, rms) })
    }
}

/// Filters by color, sums by filling, rasterizers by letters.
fn legend_lines() -> impl Iterator<Item = (Sign, String)> {
    let filters = Filter::NAMES.iter().enumerate().map(|(i, (name, _))| (Sign::Dot(color(i), true), *name));
    let sums = [(false, "16-bit sums"), (true, "32-bit sums")];
    let sums = sums.into_iter().map(|(filled, name)| (Sign::Dot(BLACK, filled), name));
    let rasterizers = Rasterizer::METHODS.iter().map(|(name, _)| (Sign::Letters(code(name)), *name));
    let front = (Sign::Line(BLACK, 1), "Pareto front");
    let lines = filters.chain(sums).chain(rasterizers).chain([front]);
    lines.map(|(sign, text)| (sign, text.to_owned()))
}

/// A rasterizer in two letters at most.
fn code(rasterizer: &str) -> &'static str {
    let found = Rasterizer::METHODS.iter().find(|(name, _)| *name == rasterizer).map(|(_, value)| *value);
    match found.unwrap_or_default() {
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
