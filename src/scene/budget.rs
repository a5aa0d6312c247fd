//! How many splats a frame may draw.

use super::OptionValue;

/// The most splats of objects in levels of detail that a frame draws: those of them that leave the least error, the size τ on the screen below which nothing
/// is told apart ([`super::Lod`]). What is outside of the view, or faces away and is not drawn, does not count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Budget {
    /// As many as [`super::Settings::lod`] asks for.
    #[default]
    Unlimited,
    /// So many, at least 1.
    Splats(u32),
}

/// `none`, `250000`, `250k`, `1.5M`.
impl OptionValue for Budget {
    fn word(&self) -> String {
        match self {
            Self::Unlimited => "none".to_owned(),
            Self::Splats(count) => count.to_string(),
        }
    }

    fn parse(word: &str) -> Result<Self, String> {
        if word == "none" {
            return Ok(Self::Unlimited);
        }
        let units = [('k', 1e3), ('M', 1e6)];
        let unit = units.into_iter().find_map(|(letter, unit)| Some((word.strip_suffix(letter)?, unit)));
        let (number, unit) = unit.unwrap_or((word, 1.0));
        let count = number.parse::<f64>().map(|number| (number * unit).round());
        match count {
            Ok(count) if (1.0..=f64::from(u32::MAX)).contains(&count) => Ok(Self::Splats(count as u32)),
            _ => Err("expected none, or a number of splats from 1 on, such as 250k".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_and_nothing_else() {
        let count = |word: &str| Budget::parse(word).ok();
        assert_eq!(count("none"), Some(Budget::Unlimited));
        for (word, expected) in [("1", 1), ("250k", 250_000), ("1.5M", 1_500_000), ("4294967295", u32::MAX)] {
            assert_eq!(count(word), Some(Budget::Splats(expected)), "{word}");
            assert_eq!(Budget::parse(&Budget::Splats(expected).word()), Ok(Budget::Splats(expected)));
        }
        for word in ["", "0", "-1", "NaN", "inf", "k", "5M5", "0.4", "4294967296", "many"] {
            assert_eq!(count(word), None, "{word}");
        }
    }
}
