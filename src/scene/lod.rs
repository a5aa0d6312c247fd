//! Levels of detail: how large on the screen a splat may be that stands for others.

use super::OptionValue;

/// The largest size on the screen, τ, of a splat that is drawn in place of those below it (Pajarola, Sainz, Guidotti 2003, section 5.1).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Lod {
    /// One pixel, of what has levels of detail; none are made for it. With a [`super::Budget`], what that leaves.
    #[default]
    Auto,
    /// So many pixels, at least 0: how far the centers spread of what the splat stands for, the root of their mean squared distance from its own, up to
    /// twice as much where normals or colors differ. One pixel is as far as the low-pass filter spreads what it sees. With 0, what is drawn is the scene itself.
    Px(f64),
    /// So many percent of the picture's area, as the paper has it: of a disk, which spreads by its radius over √2.
    Percent(f64),
}

impl Lod {
    /// In pixels, of a picture of this size.
    pub(super) fn tau_px(self, size_px: [u32; 2]) -> f64 {
        match self {
            Self::Auto => 1.0,
            Self::Px(px) => px,
            Self::Percent(percent) => {
                let area = size_px.map(f64::from).iter().product::<f64>() * percent / 100.0;
                (0.5 * area / std::f64::consts::PI).sqrt()
            }
        }
    }

    /// Whether a scene has to have levels of detail for it.
    pub fn wants_levels(self) -> bool {
        matches!(self, Self::Px(tau) | Self::Percent(tau) if tau > 0.0)
    }
}

/// `auto`, `1px`, `1`, `0.01%`.
impl OptionValue for Lod {
    fn word(&self) -> String {
        match self {
            Self::Auto => "auto".to_owned(),
            Self::Px(px) if *px == 0.0 => "0".to_owned(),
            Self::Px(px) => format!("{px}px"),
            Self::Percent(percent) => format!("{percent}%"),
        }
    }

    fn parse(word: &str) -> Result<Self, String> {
        if word == "auto" {
            return Ok(Self::Auto);
        }
        let parsed = match word.strip_suffix('%') {
            Some(percent) => percent.parse().map(Self::Percent),
            None => word.strip_suffix("px").unwrap_or(word).parse().map(Self::Px),
        };
        parsed.map_err(|_| {
            "expected auto, pixels, such as 1px, or percent of the picture, such as 0.01%".to_owned()
        })
    }

    fn check(&self) -> Result<(), String> {
        match self {
            Self::Px(tau) | Self::Percent(tau) if !(*tau >= 0.0 && tau.is_finite()) => {
                Err(format!("{}: expected a finite number, at least 0", self.word()))
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_pixels_or_parts_of_the_picture() {
        assert_eq!([Lod::parse("2.5"), Lod::parse("2.5px")], [Ok(Lod::Px(2.5)), Ok(Lod::Px(2.5))]);
        let percent = Lod::parse("0.01%").unwrap();
        // A disk of 104.86 pixels has a radius of 5.777.
        assert!((percent.tau_px([1024, 1024]) - 4.0853).abs() < 1e-3, "{}", percent.tau_px([1024, 1024]));
        for word in ["", "px", "-", "1 px", "one", "1%%"] {
            assert!(Lod::parse(word).is_err(), "{word}");
        }
        for lod in [Lod::Px(-1.0), Lod::Px(f64::NAN), Lod::Percent(f64::INFINITY)] {
            assert!(lod.check().is_err(), "{lod:?}");
        }
        for lod in [Lod::default(), Lod::Px(0.0), Lod::Px(1.5), percent] {
            assert_eq!(Lod::parse(&lod.word()), Ok(lod));
        }
        assert!(Lod::Px(1.0).wants_levels());
        assert!(!Lod::Px(0.0).wants_levels() && !Lod::default().wants_levels());
    }
}
