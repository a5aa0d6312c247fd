//! The settings that are numbers: the image's size, the kernel, the depth of a surface, the background.

use super::OptionValue;

/// The reconstruction kernel over the splat's own `r = √(u²+v²)`; zero beyond `r = 1`.
///
/// A fragment whose weight is below 2⁻²⁴ does not cover its pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kernel {
    /// `exp(−r²/2σ²)`.
    Gaussian {
        /// σ in radii, above 0.
        sigma: f32,
    },
    /// `exp(−a q/(1−q))`, `q = rⁿ` (Pajarola, Sainz, Guidotti 2003, section 4). The paper's `b` scales its own r
    /// and the support alike, so that it cancels here.
    PsiE {
        /// Fall-off, above 0.
        a: f32,
        /// The paper's support radius, above 0; without effect on the unit disk.
        b: f32,
        /// Flatness of the top, above 0.
        n: f32,
    },
}

/// The depth ε within which a fragment belongs to the nearest surface of its pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Epsilon {
    /// The splat's larger radius, of what is transparent twice that; and less where another surface is near that faces the other way, so that
    /// the sides of a plate stay two: so much as [`prepare`](crate::prepare::prepare) found room for.
    Auto,
    /// A multiple of the splat's larger radius, at least 0.
    Radii(f64),
    /// A length in world units, at least 0.
    Length(f64),
}

impl Epsilon {
    /// What [`Self::Auto`] is in radii, where no other surface is near. In one radius from the nearest one there are not all fragments of a
    /// surface that bends away within the pixel: what is left would be a layer more, a dark dot. Within two there are
    /// (`benches/ACCURACY.md`), and at the rim of a ball only pixels that it covers in part have its front and its back in one layer.
    pub(crate) fn auto_radii(transparent: bool) -> f64 {
        if transparent { 2.0 } else { 1.0 }
    }
}

/// The most pixels along a side.
const MAX_SIDE_PX: u32 = 65_536;

/// Width and height in pixels: `1024x768`.
impl OptionValue for [u32; 2] {
    fn word(&self) -> String {
        let [width, height] = self;
        format!("{width}x{height}")
    }

    fn parse(word: &str) -> Result<Self, String> {
        let sides = word.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
        sides.ok_or_else(|| "expected width x height in pixels, such as 1024x768".to_owned())
    }

    fn check(&self) -> Result<(), String> {
        match self.iter().all(|side| (1..=MAX_SIDE_PX).contains(side)) {
            true => Ok(()),
            false => Err(format!("{}: expected 1 to {MAX_SIDE_PX} pixels a side", self.word())),
        }
    }
}

impl Default for Kernel {
    fn default() -> Self {
        Self::Gaussian { sigma: 0.5 }
    }
}

impl OptionValue for Kernel {
    fn word(&self) -> String {
        match self {
            Self::Gaussian { sigma } => format!("gaussian:{sigma}"),
            Self::PsiE { a, b, n } => format!("psi_e:{a},{b},{n}"),
        }
    }

    fn parse(word: &str) -> Result<Self, String> {
        let parsed = match word.split_once(':') {
            Some(("gaussian", sigma)) => sigma.parse().ok().map(|sigma| Self::Gaussian { sigma }),
            Some(("psi_e", parameters)) => triple(parameters).map(|[a, b, n]| Self::PsiE { a, b, n }),
            _ => None,
        };
        parsed.ok_or_else(|| {
            "expected gaussian:S or psi_e:A,B,N, such as gaussian:0.5 or psi_e:6,1.5,3".to_owned()
        })
    }

    fn check(&self) -> Result<(), String> {
        let parameters: &[(&str, f32)] = match *self {
            Self::Gaussian { sigma } => &[("gaussian: σ", sigma)],
            Self::PsiE { a, b, n } => &[("psi_e: a", a), ("psi_e: b", b), ("psi_e: n", n)],
        };
        match parameters.iter().find(|(_, value)| !(*value > 0.0 && value.is_finite())) {
            Some((name, value)) => Err(format!("{name} is {value}: expected a finite number above 0")),
            None => Ok(()),
        }
    }
}

impl OptionValue for Epsilon {
    fn word(&self) -> String {
        match self {
            Self::Auto => "auto".to_owned(),
            Self::Radii(radii) => format!("{radii}r"),
            Self::Length(length) => format!("{length}"),
        }
    }

    fn parse(word: &str) -> Result<Self, String> {
        if word == "auto" {
            return Ok(Self::Auto);
        }
        let parsed = match word.strip_suffix('r') {
            Some(radii) => radii.parse().map(Self::Radii),
            None => word.parse().map(Self::Length),
        };
        parsed.map_err(|_| {
            "expected auto, multiples of a splat's radius, such as 1r, or a length, such as 0.02".to_owned()
        })
    }

    fn check(&self) -> Result<(), String> {
        let (Self::Radii(depth) | Self::Length(depth)) = self else { return Ok(()) };
        match *depth >= 0.0 && depth.is_finite() {
            true => Ok(()),
            false => Err(format!("{depth}: expected a finite number, at least 0")),
        }
    }
}

/// A background: an sRGB color, or none.
impl OptionValue for Option<[f32; 3]> {
    fn word(&self) -> String {
        self.map_or_else(|| "none".to_owned(), |[red, green, blue]| format!("{red},{green},{blue}"))
    }

    fn parse(word: &str) -> Result<Self, String> {
        match (word, triple(word)) {
            ("none", _) => Ok(None),
            (_, Some(color)) => Ok(Some(color)),
            _ => Err("expected red,green,blue from 0 to 1, such as 1,1,1, or none".to_owned()),
        }
    }

    fn check(&self) -> Result<(), String> {
        match self.iter().flatten().all(|component| (0.0..=1.0).contains(component)) {
            true => Ok(()),
            false => Err(format!("{}: expected three numbers from 0 to 1", self.word())),
        }
    }
}

/// A point or a color: `0.5,1,-2`.
impl OptionValue for [f64; 3] {
    fn word(&self) -> String {
        let [x, y, z] = self;
        format!("{x},{y},{z}")
    }

    fn parse(word: &str) -> Result<Self, String> {
        triple(word).ok_or_else(|| "expected three numbers with commas between, such as 0,0.5,-2".to_owned())
    }
}

/// Three numbers with commas between.
fn triple<T: std::str::FromStr>(word: &str) -> Option<[T; 3]> {
    let numbers: Vec<T> = word.split(',').map(|part| part.trim().parse().ok()).collect::<Option<_>>()?;
    numbers.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Layers, TileMemory};

    fn assert_read_again<T: OptionValue + PartialEq + std::fmt::Debug>(values: &[T]) {
        for value in values {
            assert_eq!(T::parse(&value.word()).as_ref(), Ok(value));
        }
    }

    #[test]
    fn every_value_is_read_from_its_own_word() {
        assert_read_again(&[[1, 65_536], [1024, 768]]);
        assert_read_again(&[Kernel::Gaussian { sigma: 0.5 }, Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 }]);
        assert_read_again(&[Epsilon::Auto, Epsilon::Radii(1.0), Epsilon::Length(0.02), Epsilon::Radii(-1.0)]);
        assert_read_again(&[None, Some([1.0, 0.5, 0.0])]);
        assert_read_again(&[Layers::Fixed(7), Layers::Auto(16)]);
        assert_read_again(&[TileMemory::Auto, TileMemory::Most(0), TileMemory::Most(12_500_000)]);
        assert_eq!(<[f64; 3]>::parse("-1, 2.5,3e-2"), Ok([-1.0, 2.5, 0.03]));
    }

    #[test]
    fn words_without_a_value_are_refused() {
        let refused = |parse: fn(&str) -> bool, words: &[&str]| {
            for word in words {
                assert!(!parse(word), "{word}");
            }
        };
        let sizes = ["", "5", "5x", "x5", "-5x5", "5x5x5", "5.5x5", "99999999999x1"];
        refused(|word| <[u32; 2]>::parse(word).is_ok(), &sizes);
        let triples = ["", "1,2", "1,2,3,4", "1,,2", "a,b,c"];
        refused(|word| <[f64; 3]>::parse(word).is_ok(), &triples);
        refused(|word| Option::<[f32; 3]>::parse(word).is_ok(), &triples);
        refused(|word| Epsilon::parse(word).is_ok(), &["", "r", "1rr", "one", "1 r", "Auto"]);
        let kernels = ["", "gaussian", "gaussian:", "gaussian:a", "psi_e:1,2", "box:1"];
        refused(|word| Kernel::parse(word).is_ok(), &kernels);
        refused(|word| Layers::parse(word).is_ok(), &["", "auto", "auto:", "-1", "1.5"]);
        refused(|word| TileMemory::parse(word).is_ok(), &["", "-1", "NaN", "1e10", "half"]);
    }
}
