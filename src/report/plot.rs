//! What the plots have in common: logarithmic axes, colors, SVG as text.

use std::{fmt::Display, io, ops::Range};

use plotters::style::RGBColor;

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

/// A mark's text, without the noise of its last bits.
pub(super) fn mark(value: f64) -> String {
    match value {
        _ if (1e-3..1e6).contains(&value) => format!("{}", (value * 1e6).round() / 1e6),
        _ => format!("{value:.0e}"),
    }
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
