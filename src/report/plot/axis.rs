//! The axes of charts, linear or logarithmic.

use std::ops::Range;

use plotters::coord::{
    ranged1d::{DefaultFormatting, KeyPointHint, Ranged},
    types::RangedCoordf64,
};

/// An axis of a chart.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Its name with the unit.
    pub name: String,
    /// From one end to the other.
    range: Range<f64>,
    /// Where it has a line.
    ticks: Vec<f64>,
    logarithmic: bool,
}

impl Axis {
    /// A linear axis.
    pub fn linear(name: impl Into<String>, range: Range<f64>) -> Self {
        let ticks = RangedCoordf64::from(range.clone()).key_points(11);
        Self { name: name.into(), range, ticks, logarithmic: false }
    }

    /// A logarithmic axis that holds these values, from a number 1, 2 or 5 · 10ⁿ to another, with a line at all such numbers.
    /// Values that have no logarithm are not on it.
    pub fn logarithmic(name: impl Into<String>, values: impl Iterator<Item = f64>) -> Self {
        let (range, ticks) = powers(values);
        Self { name: name.into(), range, ticks, logarithmic: true }
    }
}

impl Ranged for Axis {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (first, last): (i32, i32)) -> i32 {
        let Range { start, end } = self.range;
        let share = match self.logarithmic {
            true => (value / start).ln() / (end / start).ln(),
            false => (value - start) / (end - start),
        };
        first + (share * f64::from(last - first)).round() as i32
    }

    fn key_points<H: KeyPointHint>(&self, hint: H) -> Vec<f64> {
        if hint.weight().allow_light_points() { Vec::new() } else { self.ticks.clone() }
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

/// The ends of a logarithmic axis and all its ticks.
fn powers(values: impl Iterator<Item = f64>) -> (Range<f64>, Vec<f64>) {
    let (low, high) = values
        .filter(|value| *value > 0.0 && value.is_finite())
        .fold((f64::INFINITY, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
    if low > high {
        return (1.0..10.0, vec![1.0, 2.0, 5.0, 10.0]);
    }
    // Beyond that a power of ten is not a normal number.
    let exponent = |value: f64| value.log10().floor().clamp(-300.0, 300.0) as i32;
    let ticks: Vec<f64> = (exponent(low) - 1..=exponent(high) + 1)
        .flat_map(|exponent| [1.0, 2.0, 5.0].map(|digit| digit * 10.0_f64.powi(exponent)))
        .collect();
    let first = ticks.iter().rposition(|tick| *tick <= low).unwrap_or(0);
    let last = ticks.iter().position(|tick| *tick >= high).unwrap_or(ticks.len() - 1).max(first + 1);
    (ticks[first]..ticks[last], ticks[first..=last].to_vec())
}

/// A tick's text, without the noise of its last bits.
pub(super) fn tick(value: f64) -> String {
    match value {
        _ if value == 0.0 || (1e-3..1e6).contains(&value.abs()) => format!("{}", (value * 1e6).round() / 1e6),
        _ => format!("{value:.0e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_end_at_round_numbers_and_hold_every_value() {
        let (range, ticks) = powers([0.3, 7.0].into_iter());
        assert_eq!((range.start, range.end), (0.2, 10.0));
        let axis = Axis::logarithmic("", [0.3, 7.0].into_iter());
        let labels: Vec<String> = axis.ticks.iter().map(|value| tick(*value)).collect();
        assert_eq!(
            (ticks.len(), labels),
            (6, ["0.2", "0.5", "1", "2", "5", "10"].map(str::to_owned).to_vec())
        );
        let (range, ticks) = powers([1.0, 1.0].into_iter());
        assert!(range.start < range.end && ticks.len() >= 2, "{range:?}");
        let (range, _) = powers([1e-9, 3e-9].into_iter());
        assert!(range.start <= 1e-9 && range.end >= 3e-9 && range.end < 1e-7, "{range:?}");
        assert_eq!(tick(-2.5e7), "-2e7");
    }

    #[test]
    fn values_without_a_logarithm_make_no_axis() {
        for values in [&[][..], &[0.0, -1.0, f64::NAN, f64::INFINITY]] {
            let (range, ticks) = powers(values.iter().copied());
            assert_eq!((range.start, range.end, ticks.len()), (1.0, 10.0, 4));
        }
        let (range, _) = powers([f64::MIN_POSITIVE, f64::MAX].into_iter());
        assert!(range.start > 0.0 && range.end.is_finite() && range.start < range.end, "{range:?}");
    }
}
