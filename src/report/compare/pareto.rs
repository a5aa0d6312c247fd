//! The methods that no other beats in speed and error at once.

/// Errors up to this factor apart count as equal: rounding alone makes the pictures of two exact methods differ in the
/// fourth digit, and no one pays time for that.
const EQUAL_ERRORS: f64 = 1.01;

/// For each (time, error), smaller being better: whether no other is at least as good in both and better in one, or
/// faster with an equal error, which is one within 1%. Equal pairs are on the front together; a pair with a figure that is missing or not finite is not on it and beats none.
pub fn pareto_front(figures: &[Option<[f64; 2]>]) -> Vec<bool> {
    let finite =
        |figures: &Option<[f64; 2]>| figures.filter(|pair| pair.iter().all(|value| value.is_finite()));
    let beats = |a: [f64; 2], b: [f64; 2]| {
        let faster_and_equal = a[0] < b[0] && a[1] <= EQUAL_ERRORS * b[1];
        faster_and_equal || a[0] <= b[0] && a[1] <= b[1] && a != b
    };
    figures
        .iter()
        .map(|own| {
            finite(own).is_some_and(|own| !figures.iter().filter_map(finite).any(|other| beats(other, own)))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn front(figures: &[[f64; 2]]) -> Vec<bool> {
        pareto_front(&figures.iter().copied().map(Some).collect::<Vec<_>>())
    }

    #[test]
    fn what_is_beaten_in_both_is_not_on_the_front() {
        let figures = [[1.0, 9.0], [2.0, 5.0], [3.0, 6.0], [4.0, 1.0], [0.5, 10.0]];
        assert_eq!(front(&figures), [true, true, false, true, true]);
        assert_eq!(front(&[[7.0, 7.0]]), [true]);
        assert!(front(&[]).is_empty());
    }

    #[test]
    fn ties_in_one_figure_are_decided_by_the_other_and_equals_stay_together() {
        assert_eq!(front(&[[1.0, 2.0], [1.0, 3.0]]), [true, false]);
        assert_eq!(front(&[[2.0, 2.0], [1.0, 2.0]]), [false, true]);
        assert_eq!(front(&[[1.0, 2.0], [1.0, 2.0], [2.0, 1.0]]), [true; 3]);
        assert_eq!(front(&[[0.0, 1.0], [-0.0, 1.0]]), [true; 2]);
    }

    #[test]
    fn errors_within_a_percent_are_equal_and_the_faster_one_is_on_the_front() {
        assert_eq!(front(&[[1.0, 1.009], [2.0, 1.0]]), [true, false]);
        assert_eq!(front(&[[1.0, 1.011], [2.0, 1.0]]), [true, true]);
        assert_eq!(front(&[[1.0, 1.0], [1.0, 1.009]]), [true, false]);
    }

    #[test]
    fn what_is_not_a_number_is_neither_on_the_front_nor_beats_another() {
        let nan = f64::NAN;
        assert_eq!(
            front(&[[nan, 0.0], [0.0, nan], [5.0, 5.0], [f64::INFINITY, 1.0]]),
            [false, false, true, false]
        );
        assert_eq!(pareto_front(&[None, Some([1.0, 1.0]), None]), [false, true, false]);
    }
}
