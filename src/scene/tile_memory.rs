//! The memory that lists of splats by tile may take.

use super::OptionValue;

/// Bytes of records and lists that a frame by tiles holds at once ([`super::Rasterizer::Compute`]). Where all of the image would take
/// more by at least a third, it is drawn in bands of rows, one after the other in the same memory: for less, bands gain nothing. The picture is the same but
/// for the rounding of sums.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum TileMemory {
    /// As much as splats and lists together are one and a half times what the splats take in a scene
    /// ([`crate::scene::Splats::bytes`]), but 16 MB in any case.
    #[default]
    Auto,
    /// So many bytes, or what the 16th part of an image needs.
    Most(u64),
}

/// A megabyte, the unit of the option.
const MEGABYTE: f64 = 1e6;

impl OptionValue for TileMemory {
    fn word(&self) -> String {
        match self {
            Self::Auto => "auto".to_owned(),
            Self::Most(bytes) => format!("{}", *bytes as f64 / MEGABYTE),
        }
    }

    fn parse(word: &str) -> Result<Self, String> {
        match word.parse::<f64>() {
            _ if word == "auto" => Ok(Self::Auto),
            Ok(megabytes) if (0.0..=1e9).contains(&megabytes) => {
                Ok(Self::Most((megabytes * MEGABYTE).round() as u64))
            }
            _ => Err("expected auto, or a number of megabytes".to_owned()),
        }
    }
}
