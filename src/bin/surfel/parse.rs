//! The values of options, as text. Whether they are in range is for the library to say, see `Settings::validate`.

use std::{fmt::Display, ops::RangeInclusive, str::FromStr};

use surfel::scene::{Epsilon, Kernel, Layers};

/// `1024x768`.
pub fn size(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    sides.ok_or_else(|| "expected width x height in pixels, such as 1024x768".to_owned())
}

/// `1024x768`, or `512` for a square.
pub fn square_or_size(text: &str) -> Result<[u32; 2], String> {
    let square = text.parse().ok().map(|side| [side; 2]);
    square.or_else(|| size(text).ok()).ok_or_else(|| {
        "expected width x height in pixels, such as 1024x768, or the side of a square, such as 512".to_owned()
    })
}

/// `0.5,1,-2`.
pub fn triple(text: &str) -> Result<[f64; 3], String> {
    numbers(text).ok_or_else(|| "expected three numbers with commas between, such as 0,0.5,-2".to_owned())
}

/// A whole number within `range`.
pub fn whole<T>(range: RangeInclusive<T>) -> impl Fn(&str) -> Result<T, String> + Clone
where
    T: FromStr + PartialOrd + Display + Clone + Send + Sync + 'static,
{
    move |text| {
        let number = text.parse().ok().filter(|number| range.contains(number));
        number.ok_or_else(|| format!("expected a whole number, {} to {}", range.start(), range.end()))
    }
}

/// `460000`, `460k` or `1.4M`.
pub fn splats(text: &str) -> Result<u64, String> {
    let (number, scale) = match (text.strip_suffix('k'), text.strip_suffix('M')) {
        (Some(number), _) => (number, 1e3),
        (_, Some(number)) => (number, 1e6),
        _ => (text, 1.0),
    };
    let splats = number.parse::<f64>().ok().map(|number| (number * scale).round());
    let splats = splats.filter(|splats| (1.0..=f64::from(u32::MAX)).contains(splats));
    splats
        .map(|splats| splats as u64)
        .ok_or_else(|| "expected a number of splats, 1 to 4294967295, such as 154k or 1.4M".to_owned())
}

/// `2.5`: a percentage.
pub fn percent(text: &str) -> Result<f64, String> {
    let percent = text.parse().ok().filter(|percent| (0.0..=1000.0).contains(percent));
    percent.ok_or_else(|| "expected percent, 0 to 1000".to_owned())
}

/// `75`: degrees between a plane and the view, not quite edge-on.
pub fn tilt(text: &str) -> Result<f64, String> {
    let degrees = text.parse().ok().filter(|degrees| (0.0..=85.0).contains(degrees));
    degrees.ok_or_else(|| "expected degrees, 0 to 85".to_owned())
}

/// `1r`: multiples of a splat's radius; or `0.02`: a length.
pub fn epsilon(text: &str) -> Result<Epsilon, String> {
    let parsed = match text.strip_suffix('r') {
        Some(radii) => radii.parse().map(Epsilon::Radii),
        None => text.parse().map(Epsilon::Length),
    };
    parsed.map_err(|_| {
        "expected multiples of a splat's radius, such as 1r, or a length, such as 0.02".to_owned()
    })
}

/// `4`, or `auto:16`: at most so many.
pub fn layers(text: &str) -> Result<Layers, String> {
    let parsed = match text.strip_prefix("auto:") {
        Some(most) => most.parse().map(Layers::Auto),
        None => text.parse().map(Layers::Fixed),
    };
    parsed.map_err(|_| "expected a number of layers, or auto:MAX, such as 4 or auto:16".to_owned())
}

/// `gaussian:S` or `psi_e:A,B,N`.
pub fn kernel(text: &str) -> Result<Kernel, String> {
    let parsed = text.split_once(':').and_then(|(name, parameters)| match name {
        "gaussian" => parameters.parse().ok().map(|sigma| Kernel::Gaussian { sigma }),
        "psi_e" => numbers(parameters).map(|[a, b, n]| Kernel::PsiE { a, b, n }),
        _ => None,
    });
    parsed
        .ok_or_else(|| "expected gaussian:S or psi_e:A,B,N, such as gaussian:0.5 or psi_e:6,1.5,3".to_owned())
}

/// The outer `Option` of the background's value would be taken for the option's own absence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Background(pub Option<[f32; 3]>);

/// `1,1,1` or `none`.
pub fn background(text: &str) -> Result<Background, String> {
    match text {
        "none" => Ok(Background(None)),
        _ => numbers(text)
            .map(|color| Background(Some(color)))
            .ok_or_else(|| "expected red,green,blue from 0 to 1, such as 1,1,1, or none".to_owned()),
    }
}

/// Three numbers with commas between.
fn numbers<T: std::str::FromStr>(text: &str) -> Option<[T; 3]> {
    let numbers: Vec<T> = text.split(',').map(|part| part.trim().parse().ok()).collect::<Option<_>>()?;
    numbers.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use surfel::report::{epsilon_option, kernel_option};

    #[test]
    fn what_a_report_prints_can_be_given_again() {
        for value in [Kernel::Gaussian { sigma: 0.1 }, Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 }] {
            assert_eq!(kernel(&kernel_option(value)), Ok(value));
        }
        for value in [Epsilon::Radii(1.0), Epsilon::Length(0.1), Epsilon::Length(1e-300)] {
            assert_eq!(epsilon(&epsilon_option(value)), Ok(value));
        }
    }

    #[test]
    fn values_are_read() {
        assert_eq!(size("1024x768"), Ok([1024, 768]));
        assert_eq!((square_or_size("512"), square_or_size("3x2")), (Ok([512, 512]), Ok([3, 2])));
        assert_eq!(triple("-1, 2.5,3e-2"), Ok([-1.0, 2.5, 0.03]));
        assert_eq!((splats("154k"), splats("1.4M"), splats("7")), (Ok(154_000), Ok(1_400_000), Ok(7)));
        assert_eq!(percent("2.5"), Ok(2.5));
        assert_eq!(background("none"), Ok(Background(None)));
        assert_eq!(background("1,0.5,0"), Ok(Background(Some([1.0, 0.5, 0.0]))));
    }

    #[test]
    fn what_is_no_value_is_refused() {
        for text in ["", "5", "5x", "x5", "-5x5", "5x5x5", "5.5x5", "99999999999x1"] {
            assert!(size(text).is_err(), "{text}");
            assert!(text == "5" || square_or_size(text).is_err(), "{text}");
        }
        for text in ["", "1,2", "1,2,3,4", "1,,2", "a,b,c"] {
            assert!(triple(text).is_err() && background(text).is_err(), "{text}");
        }
        for text in ["", "k", "0", "-1", "5G", "NaN", "1e30", "0.1"] {
            assert!(splats(text).is_err(), "{text}");
        }
        for text in ["", "-1", "NaN", "1001"] {
            assert!(percent(text).is_err(), "{text}");
        }
        for text in ["", "r", "1rr", "one", "1 r"] {
            assert!(epsilon(text).is_err(), "{text}");
        }
        for text in ["", "gaussian", "gaussian:", "gaussian:a", "psi_e:1,2", "box:1"] {
            assert!(kernel(text).is_err(), "{text}");
        }
    }
}
