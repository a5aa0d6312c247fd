//! The picture itself, GPU against oracle: what layers and transitions add up to.

use std::collections::BTreeMap;

use crate::{reference::Picture, renderer::Frame};

use super::agreement::is_compared;

/// How far two pictures are apart, in linear light with alpha multiplied in: what is not there has no color.
#[derive(Clone, Copy, Debug, Default)]
pub struct LightErrors {
    /// Pixels in which something is seen that is not background.
    pub seen: usize,
    /// Seen pixels that are left out because rounding alone may turn a decision, see [`crate::reference::Pixel::epsilon_margin`] and
    /// [`crate::reference::Pixel::rim`].
    pub exempt: usize,
    /// Compared pixels.
    pub compared: usize,
    /// The largest difference of a component.
    pub worst: f64,
    /// Root mean square over all components of the compared pixels.
    pub rms: f64,
    /// Root mean square over all pixels, those that are exempt too.
    pub rms_of_all: f64,
    /// NaN or infinite values.
    pub not_finite: usize,
}

/// Compares a frame that has its linear picture with the oracle's.
///
/// # Panics
/// Where they differ in size.
pub fn compare_light(frame: &Frame, oracle: &Picture) -> LightErrors {
    assert_eq!(frame.size_px, oracle.size_px);
    let mut errors = LightErrors::default();
    let (mut compared, mut all) = (0.0, 0.0);
    for (got, expected) in frame.linear.iter().zip(&oracle.pixels) {
        errors.not_finite += got.iter().filter(|value| !value.is_finite()).count();
        let [got, wanted] = [got.map(f64::from), expected.color].map(premultiplied);
        let squares: f64 = got.iter().zip(wanted).map(|(a, b)| (a - b).powi(2)).sum();
        all += squares;
        errors.seen += usize::from(expected.is_covered() || expected.polygon || expected.layers > 0);
        if !is_compared(expected) {
            errors.exempt += 1;
            continue;
        }
        errors.compared += 1;
        compared += squares;
        for (got, wanted) in got.iter().zip(wanted) {
            let error = (got - wanted).abs();
            errors.worst = if error.is_nan() { f64::INFINITY } else { errors.worst.max(error) };
        }
    }
    errors.rms = (compared / (4 * errors.compared.max(1)) as f64).sqrt();
    errors.rms_of_all = (all / (4 * oracle.pixels.len().max(1)) as f64).sqrt();
    errors
}

/// With alpha multiplied in.
fn premultiplied([red, green, blue, alpha]: [f64; 4]) -> [f64; 4] {
    [alpha * red, alpha * green, alpha * blue, alpha]
}

impl LightErrors {
    /// The errors that exceed the tolerances, in words; empty where nothing does. Of `seen` and `compared` the limits are the fewest.
    pub fn beyond(&self, limit: &Self) -> Vec<String> {
        let mut beyond = Vec::new();
        let at_most = [
            ("color", self.worst, limit.worst),
            ("color (rms of all pixels)", self.rms_of_all, limit.rms_of_all),
        ];
        for (name, value, limit) in at_most {
            // What is not a number is beyond any limit.
            if value.is_nan() || value > limit {
                beyond.push(format!("{name} {value:.3e} > {limit:.3e}"));
            }
        }
        if self.not_finite > 0 {
            beyond.push(format!("{} values not finite", self.not_finite));
        }
        for (what, px, fewest) in
            [("seen", self.seen, limit.seen), ("compared", self.compared, limit.compared)]
        {
            if px < fewest {
                beyond.push(format!("{px} pixels {what}, expected {fewest}"));
            }
        }
        beyond
    }

    /// The errors by name, for reports.
    pub fn figures(&self) -> BTreeMap<&'static str, f64> {
        BTreeMap::from([
            ("seen_px", self.seen as f64),
            ("exempt_px", self.exempt as f64),
            ("compared_px", self.compared as f64),
            ("not_finite_values", self.not_finite as f64),
            ("color", self.worst),
            ("color_rms", self.rms),
            ("color_rms_of_all", self.rms_of_all),
        ])
    }

    /// One row of the table that the tests print.
    pub fn row(&self, name: &str) -> String {
        format!(
            "{name:52} {:6} px seen, exempt {:5.2}% | worst {:.1e} rms {:.1e}, of all pixels {:.1e}",
            self.seen,
            100.0 * self.exempt as f64 / (self.exempt + self.compared).max(1) as f64,
            self.worst,
            self.rms,
            self.rms_of_all,
        )
    }
}
