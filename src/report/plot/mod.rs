//! Plots as SVG: charts over each other, their axes linear or logarithmic, and a legend. Whoever shows one has the fonts.

mod axis;

use std::{fmt::Display, io};

use plotters::{
    coord::{Shift, ranged1d::Ranged as _},
    prelude::*,
};

pub use axis::Axis;

use crate::error::{Error, Result};
use axis::tick;

/// Width and height of a plot where nothing else is asked for.
pub const PLOT_SIZE_PX: [u32; 2] = [1280, 800];

const FONT: &str = "sans-serif";

/// Width of the legend in pixels.
const LEGEND_PX: u32 = 200;

/// Pixels from one line of the title to the next.
const TITLE_LINE_PX: u32 = 24;

/// Colors that can be told apart, also by most who see fewer (Okabe, Ito 2008).
const COLORS: [RGBColor; 8] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
    RGBColor(150, 140, 20),
];

/// The color with this number, in rotation.
pub(super) fn color(i: usize) -> RGBColor {
    COLORS[i % COLORS.len()]
}

/// The style of areas.
fn band() -> ShapeStyle {
    BLACK.mix(0.08).filled()
}

/// Charts with what explains them.
#[derive(Clone, Debug, Default)]
pub struct Plot {
    /// Over all, from the left, a line each.
    pub title: Vec<String>,
    /// From above to below.
    pub charts: Vec<Chart>,
    /// A sign and what it stands for.
    pub(super) legend: Vec<(Sign, String)>,
    /// The legend lies over the chart's upper right, not beside it.
    pub(super) legend_inside: bool,
}

/// A plane with marks on it.
#[derive(Clone, Debug)]
pub struct Chart {
    /// Over it; may be empty.
    pub caption: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// The marks, in the order in which they are drawn.
    pub(super) marks: Vec<Mark>,
}

/// A place in a chart, in the units of its axes.
pub(super) type Place = (f64, f64);

/// Something in a chart.
#[derive(Clone, Debug)]
pub(super) enum Mark {
    /// A line of this width, with dots of this radius at its points.
    Line { points: Vec<Place>, color: RGBColor, width: u32, dot_px: u32 },
    /// A circle, filled or not.
    Dot { at: Place, color: RGBColor, filled: bool },
    /// Text so many pixels to the right and below; how black it is.
    Text { at: Place, text: String, offset_px: (i32, i32), size_px: u32, black: f64 },
    /// All between two places of the horizontal axis.
    Band { x: [f64; 2] },
}

/// The sign before a legend's text.
#[derive(Clone, Debug)]
pub(super) enum Sign {
    /// A circle, filled or not.
    Dot(RGBColor, bool),
    /// A line of this width.
    Line(RGBColor, u32),
    /// An area.
    Band,
    /// Letters beside the dots.
    Letters(&'static str),
}

/// The result of drawing.
type Drawn<B> = std::result::Result<(), DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;

impl Plot {
    /// A linear chart of curves with their names; over it a title.
    pub fn of_curves(title: Vec<String>, [x, y]: [Axis; 2], curves: Vec<(String, Vec<(f64, f64)>)>) -> Self {
        let (mut marks, mut legend) = (Vec::new(), Vec::new());
        for (i, (name, points)) in curves.into_iter().enumerate() {
            marks.push(Mark::Line { points, color: color(i), width: 2, dot_px: 0 });
            legend.push((Sign::Line(color(i), 2), name));
        }
        let chart = Chart { caption: String::new(), x, y, marks };
        Self { title, charts: vec![chart], legend, legend_inside: true }
    }

    /// The names in its legend.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.legend.iter().map(|(_, name)| name.as_str())
    }

    /// The plot as SVG of this size in pixels.
    ///
    /// # Errors
    /// None that an input could lead to.
    pub fn svg(&self, size_px: [u32; 2]) -> Result<String> {
        let failed = |error: &dyn Display| Error::file("plot", "draw", io::Error::other(error.to_string()));
        let mut svg = String::new();
        let area = SVGBackend::with_string(&mut svg, size_px.into()).into_drawing_area();
        self.draw(&area).map_err(|error| failed(&error))?;
        drop(area);
        Ok(svg)
    }

    fn draw<B: DrawingBackend>(&self, root: &DrawingArea<B, Shift>) -> Drawn<B> {
        root.fill(&WHITE)?;
        let (left, right) = root.split_horizontally(root.dim_in_pixel().0.saturating_sub(LEGEND_PX));
        let title_px = TITLE_LINE_PX * self.title.len() as u32;
        for (i, line) in self.title.iter().enumerate() {
            let (top, size_px) = (12 + TITLE_LINE_PX as i32 * i as i32, if i == 0 { 20 } else { 15 });
            root.draw(&Text::new(line.as_str(), (16, top), (FONT, size_px)))?;
        }
        let below = if self.legend_inside { root } else { &left }.split_vertically(title_px).1;
        for (chart, area) in self.charts.iter().zip(below.split_evenly((self.charts.len().max(1), 1))) {
            chart.draw(&area)?;
        }
        for (y, (sign, text)) in (title_px as i32 + 60..).step_by(20).zip(&self.legend) {
            sign.draw(&right, y)?;
            right.draw(&Text::new(text.as_str(), (38, y - 7), (FONT, 13)))?;
        }
        root.present()
    }
}

impl Sign {
    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, y: i32) -> Drawn<B> {
        match *self {
            Self::Dot(color, filled) => area.draw(&Circle::new((18, y), 4, dot_style(color, filled))),
            Self::Line(color, width) => {
                area.draw(&PathElement::new([(6, y), (30, y)], color.stroke_width(width)))
            }
            Self::Band => area.draw(&Rectangle::new([(6, y - 6), (30, y + 6)], band())),
            Self::Letters(letters) => area.draw(&Text::new(letters, (10, y - 6), (FONT, 12))),
        }
    }
}

fn dot_style(color: RGBColor, filled: bool) -> ShapeStyle {
    ShapeStyle { color: color.to_rgba(), filled, stroke_width: 1 }
}

impl Chart {
    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B> {
        let Self { caption, x, y, marks } = self;
        let mut builder = ChartBuilder::on(area);
        if !caption.is_empty() {
            builder.caption(caption, (FONT, 20));
        }
        let mut chart = builder
            .margin(16)
            .x_label_area_size(48)
            .y_label_area_size(84)
            .build_cartesian_2d(x.clone(), y.clone())?;
        chart
            .configure_mesh()
            .x_desc(x.name.as_str())
            .y_desc(y.name.as_str())
            .x_label_formatter(&|value| tick(*value))
            .y_label_formatter(&|value| tick(*value))
            .label_style((FONT, 14))
            .draw()?;
        let plane = chart.plotting_area();
        for mark in marks {
            match mark {
                Mark::Line { points, color, width, dot_px } => {
                    plane.draw(&PathElement::new(points.clone(), color.stroke_width(*width)))?;
                    for point in points.iter().filter(|_| *dot_px > 0) {
                        plane.draw(&Circle::new(*point, *dot_px, color.filled()))?;
                    }
                }
                Mark::Dot { at, color, filled } => {
                    plane.draw(&Circle::new(*at, 4, dot_style(*color, *filled)))?;
                }
                Mark::Text { at, text, offset_px, size_px, black } => {
                    let font = (FONT, *size_px).into_font().color(&BLACK.mix(*black));
                    plane.draw(&(EmptyElement::at(*at) + Text::new(text.clone(), *offset_px, font)))?;
                }
                Mark::Band { x: [first, last] } => {
                    let ends = [(*first, y.range().start), (*last, y.range().end)];
                    plane.draw(&Rectangle::new(ends, band()))?;
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plot_has_its_titles_labels_and_a_line_for_each_curve() {
        let curve = |name: &str, y: f64| (name.to_owned(), vec![(0.0, y), (1.5, 0.0)]);
        let title = ["first line", "second line"].map(str::to_owned).to_vec();
        let axes = [Axis::linear("across", 0.0..1.5), Axis::linear("up", 0.0..1.0)];
        let plot = Plot::of_curves(title, axes, vec![curve("high", 1.0), curve("low", 0.5)]);
        let svg = plot.svg([640, 400]).unwrap();
        assert!(svg.starts_with("<svg") && svg.contains("width=\"640\" height=\"400\""), "{svg}");
        for text in ["first line", "second line", "across", "up", "high", "low", "0.5"] {
            assert!(svg.contains(&format!("\n{text}\n")), "'{text}' is not in {svg}");
        }
        // A line in the plot and one in the legend for each curve.
        for hex in ["#0072B2", "#D55E00"] {
            let lines = svg.lines().filter(|line| line.starts_with("<polyline") && line.contains(hex));
            assert_eq!(lines.count(), 2, "{hex}");
        }
        // However small.
        assert!(plot.svg([16, 16]).unwrap().starts_with("<svg"));
    }
}
