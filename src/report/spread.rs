//! Several measurements of one thing.

use serde::{Deserialize, Serialize};

/// The middle and the ends of several measurements, in their unit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// The middle one; of an even number the mean of the two in the middle.
    pub median: f64,
    /// The smallest.
    pub min: f64,
    /// The largest.
    pub max: f64,
    /// An interval that holds the true median with at least 95% confidence, whatever the distribution; `None` of fewer
    /// than 6 measurements, which can't give one.
    pub interval: Option<[f64; 2]>,
}

/// How often the true median may lie outside of the interval, on each side.
const TAIL: f64 = 0.025;

impl Spread {
    /// The spread of these values; `None` where there is none, or one is not finite.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut sorted: Vec<f64> = values.into_iter().collect();
        if !sorted.iter().all(|value| value.is_finite()) {
            return None;
        }
        sorted.sort_by(f64::total_cmp);
        let (min, max) = (*sorted.first()?, *sorted.last()?);
        let middle = sorted.len() / 2;
        let median = match sorted.len() % 2 {
            1 => sorted[middle],
            _ => 0.5 * (sorted[middle - 1] + sorted[middle]),
        };
        let interval = rank(sorted.len()).map(|rank| [sorted[rank], sorted[sorted.len() - 1 - rank]]);
        Some(Self { median, min, max, interval })
    }

    /// Half the interval's width as a part of the median; `None` without an interval, or of a median that is not above 0.
    pub fn uncertainty(&self) -> Option<f64> {
        let [low, high] = self.interval?;
        (self.median > 0.0).then(|| 0.5 * (high - low) / self.median)
    }

    /// Whether the true median may be this, as far as the interval tells; `None` without one.
    pub fn may_be(&self, value: f64) -> Option<bool> {
        self.interval.map(|[low, high]| low <= value && value <= high)
    }

    /// The spread of 1 over each value; `None` unless all are above 0.
    pub fn inverse(&self) -> Option<Self> {
        let of = |value: f64| 1.0 / value;
        (self.min > 0.0).then(|| Self {
            median: of(self.median),
            min: of(self.max),
            max: of(self.min),
            interval: self.interval.map(|[low, high]| [of(high), of(low)]),
        })
    }
}

/// The largest rank, from 0, such that the true median lies below that order statistic with a probability of at most
/// [`TAIL`]: fewer than `rank + 1` of `count` measurements are below the median then, each with a chance of a half.
fn rank(count: usize) -> Option<usize> {
    // The probability of exactly k, from k = 0 on: 2⁻ⁿ · n over k. It would underflow of more than 1000, where the normal
    // distribution is as good.
    if count > 1000 {
        return Some((0.5 * (count as f64 - 1.96 * (count as f64).sqrt()) - 1.0) as usize);
    }
    let mut term = 0.5_f64.powi(i32::try_from(count).ok()?);
    let mut below = term;
    let mut rank = None;
    for k in 0..count {
        if below > TAIL {
            break;
        }
        rank = Some(k);
        term *= (count - k) as f64 / (k + 1) as f64;
        below += term;
    }
    rank
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn median_and_ends_whatever_the_order() {
        let of = |values: &[f64]| Spread::of(values.iter().copied()).map(|s| (s.median, s.min, s.max));
        assert_eq!(of(&[3.0, 1.0, 2.0]), Some((2.0, 1.0, 3.0)));
        assert_eq!(of(&[4.0, 1.0, 2.0, 10.0]), Some((3.0, 1.0, 10.0)));
        assert_eq!(of(&[5.0]), Some((5.0, 5.0, 5.0)));
    }

    #[test]
    fn nothing_and_what_is_not_a_number_have_none() {
        assert_eq!(Spread::of([]), None);
        assert_eq!(Spread::of([1.0, f64::NAN]), None);
        assert_eq!(Spread::of([f64::INFINITY]), None);
    }

    /// Ranks from the published tables of the sign test's intervals (two-sided, 95%).
    #[test]
    fn the_interval_is_that_of_the_sign_test() {
        for (count, expected) in [(5, None), (6, Some(0)), (10, Some(1)), (20, Some(5)), (50, Some(17))] {
            assert_eq!(rank(count), expected, "{count}");
        }
        let spread = Spread::of((1..=20).map(f64::from)).unwrap();
        assert_eq!((spread.median, spread.interval), (10.5, Some([6.0, 15.0])));
        assert!((spread.uncertainty().unwrap() - 4.5 / 10.5).abs() < 1e-12);
        // Where the two ways meet.
        assert!(rank(1001).unwrap().abs_diff(rank(1000).unwrap()) <= 1);
    }

    #[test]
    fn the_inverse_turns_the_ends_and_an_interval_says_what_may_be() {
        let spread = Spread::of([2.0, 4.0, 4.0, 4.0, 4.0, 8.0]).unwrap();
        assert_eq!(spread.inverse(), Spread::of([0.5, 0.25, 0.25, 0.25, 0.25, 0.125]));
        assert_eq!((spread.may_be(2.0), spread.may_be(1.9)), (Some(true), Some(false)));
        let few = Spread::of([0.0, 1.0]).unwrap();
        assert_eq!((few.may_be(1.0), few.inverse()), (None, None));
    }

    #[test]
    fn the_interval_holds_the_true_median_as_often_as_it_says() {
        // Uniform numbers, whose median is a half.
        let mut random = crate::math::random::SplitMix(7);
        let runs = 4000;
        let held = (0..runs)
            .filter(|_| {
                let values: Vec<f64> = (0..20).map(|_| random.unit()).collect();
                let [low, high] = Spread::of(values).unwrap().interval.unwrap();
                low <= 0.5 && 0.5 <= high
            })
            .count();
        // 95.9% by the binomial distribution; 3 standard deviations are 0.9%.
        assert!((0.95..0.968).contains(&(held as f64 / f64::from(runs))), "{held} of {runs}");
    }
}
