//! Levels of detail: how large on the screen a splat may be that stands for others.

use super::OptionValue;

/// The largest size on the screen, τ, of a splat that is drawn in place of those below it (Pajarola, Sainz, Guidotti 2003, section 5.1).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Lod {
    /// One pixel, where the scene has levels of detail.
    #[default]
    Auto,
    /// So many pixels, at least 0: how far what the splat stands for spreads, the root of the mean squared distance from its center. One pixel
    /// is as far as the low-pass filter spreads what it sees. With 0, what is drawn is the scene itself.
    Px(f64),
    /// So many percent of the picture's area, as the paper has it: of a disk, which spreads by its radius over √2.
    Percent(f64),
}

/// Splats from which on a scene has levels of detail where nobody asks for them: fewer are drawn in less time than levels take to build.
pub const LOD_FROM_SPLATS: usize = 3_000_000;

impl Lod {
    /// In pixels, of a picture of this size.
    pub fn tau_px(self, size_px: [u32; 2]) -> f64 {
        match self {
            Self::Auto => 1.0,
            Self::Px(px) => px,
            Self::Percent(percent) => {
                let area = size_px.map(f64::from).iter().product::<f64>() * percent / 100.0;
                (0.5 * area / std::f64::consts::PI).sqrt()
            }
        }
    }

    /// Whether a scene of so many splats is to have levels of detail.
    pub fn wants_levels(self, splats: usize) -> bool {
        match self {
            Self::Auto => splats >= LOD_FROM_SPLATS,
            Self::Px(tau) | Self::Percent(tau) => tau > 0.0,
        }
    }
}

/// `auto`, `1px`, `1`, `0.01%`.
impl OptionValue for Lod {
    fn word(&self) -> String {
        match self {
            Self::Auto => "auto".to_owned(),
            Self::Px(px) => format!("{px}px"),
            Self::Percent(percent) => format!("{percent}%"),
        }
    }

    fn parse(word: &str) -> Result<Self, String> {
        let parsed = match (word, word.strip_suffix('%')) {
            ("auto", _) => return Ok(Self::Auto),
            (_, Some(percent)) => percent.parse().map(Self::Percent),
            (_, None) => word.strip_suffix("px").unwrap_or(word).parse().map(Self::Px),
        };
        parsed.map_err(|_| {
            "expected auto, pixels, such as 1px, or percent of the picture, such as 0.01%".to_owned()
        })
    }

    fn check(&self) -> Result<(), String> {
        let (Self::Px(tau) | Self::Percent(tau)) = self else { return Ok(()) };
        match *tau >= 0.0 && tau.is_finite() {
            true => Ok(()),
            false => Err(format!("{}: expected a finite number, at least 0", self.word())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_pixels_or_parts_of_the_picture() {
        assert_eq!(Lod::parse("auto"), Ok(Lod::Auto));
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
        assert!(Lod::Px(1.0).wants_levels(1) && !Lod::Px(0.0).wants_levels(usize::MAX));
        assert!(!Lod::Auto.wants_levels(1000) && Lod::Auto.wants_levels(LOD_FROM_SPLATS));
    }
}
