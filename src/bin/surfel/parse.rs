//! The words of options that are no settings.

use std::{fmt::Display, ops::RangeInclusive, str::FromStr};

use surfel::scene::OptionValue as _;

/// `1024x768`: width and height in pixels.
pub fn size(word: &str) -> Result<[u32; 2], String> {
    <[u32; 2]>::parse(word)
}

/// `1024x768`, or `512` for a square.
pub fn square_or_size(word: &str) -> Result<[u32; 2], String> {
    word.parse().map(|side| [side; 2]).or_else(|_| size(word)).map_err(|_| {
        "expected width x height in pixels, such as 1024x768, or the side of a square, such as 512".to_owned()
    })
}

/// `0.5,1,-2`: a point.
pub fn triple(word: &str) -> Result<[f64; 3], String> {
    <[f64; 3]>::parse(word)
}

/// A whole number within `range`.
pub fn whole<T>(range: RangeInclusive<T>) -> impl Fn(&str) -> Result<T, String> + Clone
where
    T: FromStr + PartialOrd + Display + Clone + Send + Sync + 'static,
{
    move |word| {
        let number = word.parse().ok().filter(|number| range.contains(number));
        number.ok_or_else(|| format!("expected a whole number, {} to {}", range.start(), range.end()))
    }
}

/// `2.5`: so many of `unit`, within `range`.
pub fn number(
    unit: &'static str,
    range: RangeInclusive<f64>,
) -> impl Fn(&str) -> Result<f64, String> + Clone {
    move |word| {
        let number = word.parse().ok().filter(|number| range.contains(number));
        number.ok_or_else(|| format!("expected {unit}, {} to {}", range.start(), range.end()))
    }
}

/// `460000`, `460k` or `1.4M`.
pub fn splats(word: &str) -> Result<u64, String> {
    let (number, scale) = match (word.strip_suffix('k'), word.strip_suffix('M')) {
        (Some(number), _) => (number, 1e3),
        (_, Some(number)) => (number, 1e6),
        _ => (word, 1.0),
    };
    let splats = number.parse::<f64>().ok().map(|number| (number * scale).round());
    let splats = splats.filter(|splats| (1.0..=f64::from(u32::MAX)).contains(splats));
    splats
        .map(|splats| splats as u64)
        .ok_or_else(|| "expected a number of splats, 1 to 4294967295, such as 154k or 1.4M".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_read() {
        assert_eq!((square_or_size("512"), square_or_size("3x2")), (Ok([512, 512]), Ok([3, 2])));
        assert_eq!((splats("154k"), splats("1.4M"), splats("7")), (Ok(154_000), Ok(1_400_000), Ok(7)));
        assert_eq!(number("percent", 0.0..=1000.0)("2.5"), Ok(2.5));
    }

    #[test]
    fn words_without_a_value_are_refused() {
        for word in ["", "5x", "x5", "-5x5", "5x5x5", "5.5x5", "99999999999x1"] {
            assert!(square_or_size(word).is_err(), "{word}");
        }
        for word in ["", "k", "0", "-1", "5G", "NaN", "1e30", "0.1"] {
            assert!(splats(word).is_err(), "{word}");
        }
        for word in ["", "-1", "NaN", "1001"] {
            assert!(number("percent", 0.0..=1000.0)(word).is_err(), "{word}");
        }
    }
}
