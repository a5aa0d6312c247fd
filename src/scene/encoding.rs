//! How linear light becomes the 8-bit colors of a picture.

use super::{
    OptionValue,
    option::{named, settings},
};
use crate::math::tonemap::{aces, agx};

named! {
    /// The curve from linear light to what a screen shows.
    Tonemap {
        /// Light above 1 is cut off.
        None = "none",
        /// Stephen Hill's fit of ACES.
        Aces = "aces",
        /// AgX by Troy Sobotka, in Benjamin Wrensch's fit.
        Agx = "agx",
    }
}

/// A change of exposure in stops: each doubles the light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stops(pub f64);

/// The most stops that a change of exposure is, either way.
const MOST_STOPS: f64 = 64.0;

impl OptionValue for Stops {
    fn word(&self) -> String {
        self.0.to_string()
    }

    fn parse(word: &str) -> Result<Self, String> {
        word.parse().map(Self).map_err(|_| "expected a number of stops, such as 1.5 or -2".to_owned())
    }

    fn check(&self) -> Result<(), String> {
        match self.0.abs() <= MOST_STOPS {
            true => Ok(()),
            false => Err(format!("{}: expected -{MOST_STOPS} to {MOST_STOPS} stops", self.0)),
        }
    }
}

settings! {
    /// How what is drawn becomes a picture of 8 bits. The background stays what it is.
    #[derive(Clone, Copy, Debug, PartialEq)]
    Encoding {
        /// By how many stops the picture (.png) is brighter than the light that is drawn, which is 2 to that power; .exr stays as drawn.
        "exposure" "STOPS" exposure: Stops,
        /// The curve by which bright light fits the picture (.png), after the exposure; .exr stays linear.
        "tonemap" "NAME" tonemap: Tonemap,
    }
}

impl Encoding {
    /// Whether colors are encoded as they are.
    pub fn is_plain(&self) -> bool {
        *self == Self::default()
    }

    /// What a screen shows of a linear color, linear too, from 0 to 1.
    pub fn shown(&self, color: [f32; 3]) -> [f32; 3] {
        let exposed = color.map(|component| f64::from(component) * self.exposure.0.exp2());
        let shown = match self.tonemap {
            Tonemap::None => exposed.map(|component| component.clamp(0.0, 1.0)),
            Tonemap::Aces => aces(exposed),
            Tonemap::Agx => agx(exposed),
        };
        shown.map(|component| component as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stop_is_twice_the_light_and_comes_before_the_curve() {
        let stops = |stops: f64, tonemap| Encoding { exposure: Stops(stops), tonemap };
        assert_eq!(stops(1.0, Tonemap::None).shown([0.25, 0.5, 0.75]), [0.5, 1.0, 1.0]);
        assert_eq!(stops(-2.0, Tonemap::None).shown([1.0, 2.0, 8.0]), [0.25, 0.5, 1.0]);
        for tonemap in [Tonemap::Aces, Tonemap::Agx] {
            assert_eq!(stops(3.0, tonemap).shown([0.1; 3]), stops(0.0, tonemap).shown([0.8; 3]));
        }
        assert!(Encoding::default().is_plain() && !stops(0.5, Tonemap::None).is_plain());
    }

    #[test]
    fn stops_out_of_range_are_refused() {
        assert_eq!(Stops::parse("-1.5"), Ok(Stops(-1.5)));
        assert!(Stops::parse("one").is_err() && Stops(64.0).check().is_ok());
        for stops in [64.5, f64::NAN, f64::NEG_INFINITY] {
            assert!(Stops(stops).check().is_err(), "{stops}");
        }
    }
}
