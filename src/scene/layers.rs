//! The number of transparent surfaces of a pixel that are told apart.

use std::fmt;

use super::OptionValue;

/// The most layers that may be asked for.
pub const MOST_LAYERS: u32 = 256;

/// The number of layers in which transparent things are drawn, each one surface a pixel, the nearest first (Guennebaud
/// et al. 2006, section 6). A scene without transparent things has none, whatever is said here.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Layers {
    /// So many, whether the scene needs them or not; 1 to [`MOST_LAYERS`].
    Fixed(u32),
    /// As many as the scene has in the view, at most so many; 1 to [`MOST_LAYERS`].
    Auto(u32),
}

impl Layers {
    /// At most so many are drawn.
    pub fn most(self) -> u32 {
        match self {
            Self::Fixed(layers) | Self::Auto(layers) => layers,
        }
    }
}

impl fmt::Display for Layers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fixed(layers) => write!(f, "{layers}"),
            Self::Auto(most) => write!(f, "auto:{most}"),
        }
    }
}

impl OptionValue for Layers {
    fn word(&self) -> String {
        self.to_string()
    }

    fn parse(word: &str) -> Result<Self, String> {
        let parsed = match word.strip_prefix("auto:") {
            Some(most) => most.parse().map(Self::Auto),
            None => word.parse().map(Self::Fixed),
        };
        parsed.map_err(|_| "expected a number of layers, or auto:MAX, such as 4 or auto:16".to_owned())
    }

    fn check(&self) -> Result<(), String> {
        match self.most() {
            1..=MOST_LAYERS => Ok(()),
            most => Err(format!("{most}: expected 1 to {MOST_LAYERS} layers")),
        }
    }
}
