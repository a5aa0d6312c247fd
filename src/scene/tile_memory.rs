//! How much memory lists of splats by tile may take.

/// Bytes of records and lists that a frame by tiles holds at once ([`super::Rasterizer::Compute`]). Where all of the image would take
/// more, it is drawn in bands of rows, one after the other in the same memory. The picture is the same but for the rounding of sums.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum TileMemory {
    /// As much as splats and lists together are one and a half times what the splats take in a scene
    /// ([`crate::scene::Splats::bytes`]), but 16 MB in any case.
    #[default]
    Auto,
    /// So many bytes, or what the 16th part of an image needs.
    Most(u64),
}

/// A megabyte, in which it is told.
const MEGABYTE: u64 = 1_000_000;

impl std::fmt::Display for TileMemory {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Auto => write!(f, "auto"),
            Self::Most(bytes) => write!(f, "{}", *bytes as f64 / MEGABYTE as f64),
        }
    }
}

impl std::str::FromStr for TileMemory {
    type Err = String;

    /// `auto`, or megabytes.
    fn from_str(word: &str) -> Result<Self, String> {
        if word == "auto" {
            return Ok(Self::Auto);
        }
        match word.parse::<f64>() {
            Ok(megabytes) if (0.0..=1e9).contains(&megabytes) => {
                Ok(Self::Most((megabytes * MEGABYTE as f64).round() as u64))
            }
            _ => Err("expected auto, or a number of megabytes".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_printed_can_be_read() {
        for memory in
            [TileMemory::Auto, TileMemory::Most(0), TileMemory::Most(12_500_000), TileMemory::Most(1)]
        {
            assert_eq!(memory.to_string().parse(), Ok(memory));
        }
        for wrong in ["", "-1", "NaN", "1e10", "half"] {
            assert!(wrong.parse::<TileMemory>().is_err(), "{wrong}");
        }
    }
}
