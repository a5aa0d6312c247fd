//! Curves over linear axes as a plot.

use std::ops::Range;

use plotters::prelude::*;

use super::plot::{FONT, color, failed};
use crate::error::Result;

/// A line through points, with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// What the legend says.
    pub name: String,
    /// Its points, from left to right.
    pub points: Vec<(f64, f64)>,
}

/// Curves with what explains them.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvePlot {
    /// Over the plot, a line each.
    pub title: Vec<String>,
    /// Under the horizontal axis.
    pub x_label: String,
    /// Beside the vertical axis.
    pub y_label: String,
    /// The horizontal axis.
    pub x: Range<f64>,
    /// The vertical axis.
    pub y: Range<f64>,
    /// The curves, in the order of the legend.
    pub curves: Vec<Curve>,
}

/// Pixels from one line of the title to the next.
const TITLE_LINE_PX: i32 = 24;

impl CurvePlot {
    /// The plot as SVG of this size in pixels.
    ///
    /// # Errors
    /// None that an input could lead to.
    pub fn svg(&self, size_px: [u32; 2]) -> Result<String> {
        let mut svg = String::new();
        self.draw(SVGBackend::with_string(&mut svg, size_px.into())).map_err(failed)?;
        Ok(svg)
    }

    fn draw<B: DrawingBackend>(
        &self,
        backend: B,
    ) -> std::result::Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        let root = backend.into_drawing_area();
        root.fill(&WHITE)?;
        let mut below = 12;
        for (i, line) in self.title.iter().enumerate() {
            let height = if i == 0 { 20 } else { 15 };
            root.draw(&Text::new(line.clone(), (16, below), (FONT, height)))?;
            below += TITLE_LINE_PX;
        }
        let mut chart = ChartBuilder::on(&root)
            .margin(16)
            .margin_top(below + 8)
            .x_label_area_size(48)
            .y_label_area_size(72)
            .build_cartesian_2d(self.x.clone(), self.y.clone())?;
        chart
            .configure_mesh()
            .x_desc(self.x_label.as_str())
            .y_desc(self.y_label.as_str())
            .max_light_lines(0)
            .label_style((FONT, 14))
            .draw()?;
        for (i, curve) in self.curves.iter().enumerate() {
            chart
                .draw_series(LineSeries::new(curve.points.iter().copied(), color(i).stroke_width(2)))?
                .label(curve.name.as_str())
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 20, y)], color(i).stroke_width(2)));
        }
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::UpperRight)
            .background_style(WHITE.mix(0.85))
            .border_style(BLACK.mix(0.3))
            .label_font((FONT, 15))
            .draw()?;
        root.present()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plot_has_its_titles_labels_and_a_line_for_each_curve() {
        let curve = |name: &str, y: f64| Curve { name: name.to_owned(), points: vec![(0.0, y), (1.5, 0.0)] };
        let plot = CurvePlot {
            title: vec!["first line".to_owned(), "second line".to_owned()],
            x_label: "across".to_owned(),
            y_label: "up".to_owned(),
            x: 0.0..1.5,
            y: 0.0..1.0,
            curves: vec![curve("high", 1.0), curve("low", 0.5)],
        };
        let svg = plot.svg([640, 400]).unwrap();
        assert!(svg.starts_with("<svg") && svg.contains("width=\"640\" height=\"400\""), "{svg}");
        for text in ["first line", "second line", "across", "up", "high", "low"] {
            assert!(svg.contains(&format!("\n{text}\n")), "'{text}' is not in {svg}");
        }
        // A line in the plot and one in the legend for each curve.
        for hex in ["#0072B2", "#D55E00"] {
            let lines = svg.lines().filter(|line| line.starts_with("<polyline") && line.contains(hex));
            assert_eq!(lines.count(), 2, "{hex}");
        }
    }
}
