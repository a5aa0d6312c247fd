//! How many transparent surfaces of a pixel are told apart.

use crate::error::{Error, Result};

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

    pub(super) fn validate(self) -> Result<()> {
        let most = self.most();
        if !(1..=MOST_LAYERS).contains(&most) {
            return Err(Error::option("--layers", format!("{most}: expected 1 to {MOST_LAYERS} layers")));
        }
        Ok(())
    }
}

impl Default for Layers {
    fn default() -> Self {
        Self::Fixed(4)
    }
}

impl std::fmt::Display for Layers {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Fixed(layers) => write!(f, "{layers}"),
            Self::Auto(most) => write!(f, "auto:{most}"),
        }
    }
}
