//! Numbers as programs write them.

/// The number that a word is. Beyond what Rust reads: what Microsoft's C library prints of values that are no numbers, such as `-1.#IND`,
/// `1.#QNAN0`, `1.#INF` and `-nan(ind)`.
pub(super) fn read(word: &str) -> Option<f64> {
    word.parse().ok().or_else(|| of_no_number(word)).or_else(|| of_fortran(word))
}

/// An exponent that stands behind a D, and in a number of few letters.
fn of_fortran(word: &str) -> Option<f64> {
    let (digits, exponent) = word.split_once(['D', 'd'])?;
    let is_number = word.len() < MOST_LETTERS && digits.ends_with(|c: char| c.is_ascii_digit() || c == '.');
    is_number.then(|| format!("{digits}e{exponent}").parse().ok()).flatten()
}

/// The most letters of a number with a D.
const MOST_LETTERS: usize = 64;

/// An infinity, or NaN.
pub(super) fn of_no_number(word: &str) -> Option<f64> {
    let (sign, unsigned) = match word.strip_prefix('-') {
        Some(rest) => (-1.0, rest),
        None => (1.0, word.strip_prefix('+').unwrap_or(word)),
    };
    let name = unsigned.strip_prefix("1.#").or(unsigned.strip_prefix("nan("))?;
    match name.trim_end_matches(['0', ')']).to_ascii_uppercase().as_str() {
        "INF" => Some(sign * f64::INFINITY),
        "IND" | "QNAN" | "SNAN" | "NAN" => Some(f64::NAN),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_has_names() {
        for word in ["nan", "-nan", "-1.#IND", "1.#QNAN0", "-1.#IND000", "1.#SNAN", "-nan(ind)", "nan(snan)"]
        {
            assert!(read(word).is_some_and(f64::is_nan), "{word}");
        }
        for (word, value) in [
            ("1.#INF", f64::INFINITY),
            ("-1.#INF000", f64::NEG_INFINITY),
            ("-1.5e3", -1500.0),
            ("1.0D+00", 1.0),
            ("-2.D3", -2000.0),
        ] {
            assert_eq!(read(word), Some(value), "{word}");
        }
        for word in ["", "1.#", "1.#IN", "#IND", "2.#INF", "nan(", "1.#INF1", "one", "D3", "1D", "1Dx"] {
            assert_eq!(read(word), None, "{word}");
        }
    }
}
