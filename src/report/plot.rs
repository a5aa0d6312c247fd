//! What the plots have in common: logarithmic axes, colors, SVG as text.

use std::{fmt::Display, io, ops::Range};

use plotters::{
    coord::{
        Shift,
        combinators::{LogCoord, WithKeyPoints},
    },
    prelude::*,
};

use crate::error::Error;

/// Width and height of a plot.
pub(super) const SIZE_PX: (u32, u32) = (1280, 800);

/// The font of all text; whoever shows the plot has one.
pub(super) const FONT: &str = "sans-serif";

/// Colors that can be told apart, also by most who see fewer (Okabe, Ito 2008).
pub(super) const COLORS: [RGBColor; 8] = [
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

/// A logarithmic axis that holds these values, from a number 1, 2 or 5 · 10ⁿ to another, and all such numbers in it.
/// Values that have no logarithm are not on it.
pub(super) fn logarithmic(values: impl Iterator<Item = f64>) -> (Range<f64>, Vec<f64>) {
    let (low, high) = values
        .filter(|value| *value > 0.0 && value.is_finite())
        .fold((f64::INFINITY, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
    if low > high {
        return (1.0..10.0, vec![1.0, 2.0, 5.0, 10.0]);
    }
    // Beyond that a power of ten is not a normal number.
    let exponent = |value: f64| value.log10().floor().clamp(-300.0, 300.0) as i32;
    let marks: Vec<f64> = (exponent(low) - 1..=exponent(high) + 1)
        .flat_map(|exponent| [1.0, 2.0, 5.0].map(|digit| digit * 10.0_f64.powi(exponent)))
        .collect();
    let first = marks.iter().rposition(|mark| *mark <= low).unwrap_or(0);
    let last = marks.iter().position(|mark| *mark >= high).unwrap_or(marks.len() - 1).max(first + 1);
    (marks[first]..marks[last], marks[first..=last].to_vec())
}

/// What a logarithmic axis shows: its name, and the values that it holds.
pub(super) struct LogAxis<'a> {
    /// With the unit.
    pub name: &'a str,
    /// From [`logarithmic`].
    pub range: (Range<f64>, Vec<f64>),
}

/// A plane whose axes are logarithmic.
pub(super) type LogPlane = Cartesian2d<WithKeyPoints<LogCoord<f64>>, WithKeyPoints<LogCoord<f64>>>;

/// Fills an area with a grid, its axes and a caption; what is drawn then lies over it.
pub(super) fn log_chart<'a, B: DrawingBackend>(
    area: &'a DrawingArea<B, Shift>,
    caption: &str,
    x: LogAxis<'_>,
    y: LogAxis<'_>,
) -> Result<ChartContext<'a, B, LogPlane>, DrawingAreaErrorKind<B::ErrorType>> {
    let ((x_range, x_marks), (y_range, y_marks)) = (x.range, y.range);
    let mut chart = ChartBuilder::on(area)
        .caption(caption, (FONT, 20))
        .margin(16)
        .x_label_area_size(48)
        .y_label_area_size(84)
        .build_cartesian_2d(
            x_range.log_scale().with_key_points(x_marks),
            y_range.log_scale().with_key_points(y_marks),
        )?;
    chart
        .configure_mesh()
        .x_desc(x.name)
        .y_desc(y.name)
        .x_label_formatter(&|value| mark(*value))
        .y_label_formatter(&|value| mark(*value))
        .label_style((FONT, 14))
        .draw()?;
    Ok(chart)
}

/// A mark's text, without the noise of its last bits.
pub(super) fn mark(value: f64) -> String {
    match value {
        _ if (1e-3..1e6).contains(&value) => format!("{}", (value * 1e6).round() / 1e6),
        _ => format!("{value:.0e}"),
    }
}

/// What stands before a legend's text.
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

/// The color of bands.
pub(super) fn band() -> ShapeStyle {
    BLACK.mix(0.08).filled()
}

/// Width of a legend beside a plot, in pixels.
pub(super) const LEGEND_WIDTH_PX: u32 = 200;

/// Draws a legend, line by line.
pub(super) fn legend<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    lines: impl Iterator<Item = (Sign, String)>,
) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
    for (y, (sign, text)) in (60..).step_by(20).zip(lines) {
        match sign {
            Sign::Dot(color, filled) => {
                let style = ShapeStyle { color: color.to_rgba(), filled, stroke_width: 1 };
                area.draw(&Circle::new((18, y), 4, style))?;
            }
            Sign::Line(color, width) => {
                area.draw(&PathElement::new([(6, y), (30, y)], color.stroke_width(width)))?;
            }
            Sign::Band => area.draw(&Rectangle::new([(6, y - 6), (30, y + 6)], band()))?,
            Sign::Letters(letters) => area.draw(&Text::new(letters, (10, y - 6), (FONT, 12)))?,
        }
        area.draw(&Text::new(text, (38, y - 7), (FONT, 13)))?;
    }
    Ok(())
}

/// A plot that can't be drawn: no input leads there.
pub(super) fn failed(error: impl Display) -> Error {
    Error::file("plot", "draw", io::Error::other(error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_end_at_round_numbers_and_hold_every_value() {
        let (range, marks) = logarithmic([0.3, 7.0].into_iter());
        assert_eq!((range.start, range.end), (0.2, 10.0));
        assert_eq!(
            marks.iter().map(|value| mark(*value)).collect::<Vec<_>>(),
            ["0.2", "0.5", "1", "2", "5", "10"]
        );
        let (range, marks) = logarithmic([1.0, 1.0].into_iter());
        assert!(range.start < range.end && marks.len() >= 2, "{range:?}");
        let (range, _) = logarithmic([1e-9, 3e-9].into_iter());
        assert!(range.start <= 1e-9 && range.end >= 3e-9 && range.end < 1e-7, "{range:?}");
    }

    #[test]
    fn values_without_a_logarithm_make_no_axis() {
        for values in [&[][..], &[0.0, -1.0, f64::NAN, f64::INFINITY]] {
            let (range, marks) = logarithmic(values.iter().copied());
            assert_eq!((range.start, range.end, marks.len()), (1.0, 10.0, 4));
        }
        let (range, _) = logarithmic([f64::MIN_POSITIVE, f64::MAX].into_iter());
        assert!(range.start > 0.0 && range.end.is_finite() && range.start < range.end, "{range:?}");
    }
}
