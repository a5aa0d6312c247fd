//! The words of options that are no settings.

use std::{fmt::Display, ops::RangeInclusive, str::FromStr};

use surfel::{
    Error, ErrorKind,
    load::Columns,
    scene::{Lod, OptionValue as _},
};

/// The columns of rows of numbers. What is said around a fault names the option.
pub fn columns(word: &str) -> Result<Columns, String> {
    word.parse().map_err(|error: Error| match error.kind() {
        ErrorKind::Option { problem, .. } => problem.clone(),
        _ => error.to_string(),
    })
}

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

/// `512,300`: a pixel.
pub fn pixel(word: &str) -> Result<[u32; 2], String> {
    let pixel =
        word.split_once(',').and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]));
    pixel.ok_or_else(|| "expected a pixel from the picture's top left corner, such as 512,300".to_owned())
}

/// `256MB`: a number of bytes, `least` or more, with k, M or G for thousands, and a B behind it or not.
pub fn bytes(least: u64) -> impl Fn(&str) -> Result<u64, String> + Clone {
    move |word| {
        let number = word.strip_suffix('B').unwrap_or(word);
        let of = |letter: char, unit: u64| Some((number.strip_suffix(letter)?, unit));
        let (digits, unit) =
            of('k', 1_000).or(of('M', 1_000_000)).or(of('G', 1_000_000_000)).unwrap_or((number, 1));
        let is_number = digits.starts_with(|first: char| first.is_ascii_digit());
        let bytes = digits.parse().ok().filter(|_| is_number).map(|number: f64| number * unit as f64);
        let bytes = bytes.filter(|bytes| *bytes >= least as f64 && *bytes < 1e18).map(|bytes| bytes as u64);
        bytes.ok_or_else(|| format!("expected a number of bytes, {least} at least, such as 512MB or 2GB"))
    }
}

/// A whole number within `range`; `10k` is ten thousand, `1.4M` a million and four hundred thousand.
pub fn whole<T>(range: RangeInclusive<T>) -> impl Fn(&str) -> Result<T, String> + Clone
where
    T: FromStr + PartialOrd + Display + Clone + Send + Sync + 'static,
{
    move |word| {
        let number = digits(word).and_then(|digits| digits.parse().ok());
        let number = number.filter(|number| range.contains(number));
        number.ok_or_else(|| format!("expected a whole number, {} to {}", range.start(), range.end()))
    }
}

/// A tolerance of levels of detail.
pub fn tolerance(word: &str) -> Result<Lod, String> {
    let lod = Lod::parse(word)?;
    lod.check().map(|()| lod)
}

/// A number of splats, 1 to 2³² − 1, such as `460000`, `460k` or `1.4M`.
pub fn splats(word: &str) -> Result<u64, String> {
    whole(1..=u64::from(u32::MAX))(word)
        .map_err(|_| "expected a number of splats, 1 to 4294967295, such as 154k or 1.4M".to_owned())
}

/// A whole number without its suffix, exactly; `None` for what is none.
fn digits(word: &str) -> Option<String> {
    let (number, zeros) = match (word.strip_suffix('k'), word.strip_suffix('M')) {
        (Some(number), _) => (number, 3),
        (_, Some(number)) => (number, 6),
        _ => (word, 0),
    };
    let (whole, fraction) = number.split_once('.').unwrap_or((number, ""));
    let are_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    let all = !whole.is_empty() && are_digits(whole) && are_digits(fraction);
    let is_whole = fraction.len() <= zeros && (fraction.is_empty() != number.contains('.'));
    (all && is_whole).then(|| format!("{whole}{fraction}{}", "0".repeat(zeros - fraction.len())))
}

/// `2.5`: so many of `unit`, within `range`.
pub fn number(
    unit: &'static str,
    range: RangeInclusive<f64>,
) -> impl Fn(&str) -> Result<f64, String> + Clone {
    move |word| {
        let number = word.parse().ok().filter(|number| range.contains(number));
        // The ends of what f64 holds are none that anyone means.
        let ends = match (*range.start(), *range.end()) {
            (f64::MIN_POSITIVE, f64::MAX) => String::new(),
            (start, end) => format!(", {start} to {end}"),
        };
        number.ok_or_else(|| format!("expected {unit}{ends}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_read() {
        assert_eq!((square_or_size("512"), square_or_size("3x2")), (Ok([512, 512]), Ok([3, 2])));
        assert_eq!((splats("154k"), splats("1.4M"), splats("7")), (Ok(154_000), Ok(1_400_000), Ok(7)));
        assert_eq!(
            (splats("0.5k"), splats("4294967295"), splats("1.000001M")),
            (Ok(500), Ok(u64::from(u32::MAX)), Ok(1_000_001))
        );
        assert_eq!(
            (whole(0..=u64::MAX)("18446744073709551615"), whole(1..=9_000_u32)("9k")),
            (Ok(u64::MAX), Ok(9000))
        );
        assert_eq!(number("percent", 0.0..=1000.0)("2.5"), Ok(2.5));
    }

    #[test]
    fn bytes_have_thousands_as_units() {
        let of = |word: &str| bytes(1000)(word).ok();
        assert_eq!(
            [of("512MB"), of("2G"), of("1.5kB"), of("4096")],
            [512_000_000, 2_000_000_000, 1500, 4096].map(Some)
        );
        for word in ["", "999", "MB", "-1GB", "NaN", "infGB", "1TB", "1e30"] {
            assert_eq!(of(word), None, "{word}");
        }
    }

    #[test]
    fn words_without_a_value_are_refused() {
        for word in ["", "5x", "x5", "-5x5", "5x5x5", "5.5x5", "99999999999x1"] {
            assert!(square_or_size(word).is_err(), "{word}");
        }
        for word in [
            "",
            "k",
            "0",
            "-1",
            "5G",
            "NaN",
            "1e30",
            "0.1",
            "1.5",
            "1.",
            "1.k",
            ".5k",
            "1.2345k",
            "+1",
            "1kk",
            "4294967296",
            "4.3M0",
        ] {
            assert!(splats(word).is_err(), "{word}");
        }
        for word in ["", "-1", "NaN", "1001"] {
            assert!(number("percent", 0.0..=1000.0)(word).is_err(), "{word}");
        }
    }
}
