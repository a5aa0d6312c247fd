//! Numbers for people.

/// Six digits, which tell places on a map to the metre; without the sign of what rounds to 0.
pub fn number(value: f64) -> String {
    match value == 0.0 || !value.is_finite() {
        true => "0".to_owned(),
        false => {
            let digits = (6 - value.abs().log10().floor() as i32).clamp(0, 12);
            let scale = 10_f64.powi(digits);
            let rounded = (value * scale).round() / scale + 0.0;
            let huge = value.abs() >= 1e12 || value.abs() < 1e-9;
            if huge { format!("{value:e}") } else { format!("{rounded}") }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_keep_seven_digits() {
        let cases = [
            (0.0, "0"),
            (-1e-30, "-1e-30"),
            (1.0 / 3.0, "0.3333333"),
            (5_400_123.456, "5400123"),
            (-0.001_234_567_89, "-0.001234568"),
            (1e15, "1e15"),
            (f64::INFINITY, "0"),
        ];
        for (value, expected) in cases {
            assert_eq!(number(value), expected);
        }
    }
}
