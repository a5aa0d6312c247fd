//! Which columns a file needs for its splats' colors, and their values.

use std::io::{self, Write as _};

use crate::{
    math::srgb::{linear_from_srgb, srgb_from_linear},
    scene::{Colors, Splats},
};

/// The type of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Number {
    /// 0–255 stand for 0–1.
    UChar,
    /// 0–65 535 stand for 0–1.
    UShort,
    /// 0–1.
    Float,
}

/// The columns of the colors; `None` where none is needed.
pub(super) struct ColorColumns {
    /// Red, green and blue, sRGB.
    pub rgb: Option<Number>,
    /// Alpha, linear.
    pub alpha: Option<Number>,
}

impl ColorColumns {
    /// The narrowest that give back what the splats have.
    pub(super) fn of(splats: &Splats) -> Self {
        let colors: &[[f32; 4]] = match (&splats.colors, Colors::unknown()) {
            (Colors::Uniform(color), Colors::Uniform(unknown)) if *color == unknown => &[],
            (Colors::Uniform(color), _) => std::slice::from_ref(color),
            (Colors::Each(colors), _) => colors,
        };
        let mut columns = Self { rgb: None, alpha: None };
        for [red, green, blue, alpha] in colors {
            for linear in [red, green, blue] {
                let keeps = |number: Number| {
                    linear_from_srgb(number.rounded(srgb_from_linear(*linear))).to_bits() == linear.to_bits()
                };
                columns.rgb = Some(narrowest(columns.rgb, keeps));
            }
            // A file without alpha is opaque.
            if *alpha != 1.0 {
                let keeps = |number: Number| number.rounded(*alpha).to_bits() == alpha.to_bits();
                columns.alpha = Some(narrowest(columns.alpha, keeps));
            }
        }
        columns
    }

    /// Appends a color's values.
    pub(super) fn push(&self, row: &mut Vec<u8>, [red, green, blue, alpha]: [f32; 4]) -> io::Result<()> {
        if let Some(number) = self.rgb {
            for linear in [red, green, blue] {
                number.push(row, encoded(linear))?;
            }
        }
        self.alpha.map_or(Ok(()), |number| number.push(row, alpha))
    }
}

/// The narrowest type that is not narrower than the one needed so far and keeps this value; `Float` keeps all.
fn narrowest(so_far: Option<Number>, keeps: impl Fn(Number) -> bool) -> Number {
    let tried = [Number::UChar, Number::UShort].into_iter().filter(|number| Some(*number) >= so_far);
    tried.into_iter().find(|number| keeps(*number)).unwrap_or(Number::Float)
}

/// How far from the rounded inverse of the transfer function the value that gives back the same bits is looked for, in
/// units of the last place. Most are within 2; where the function is flatter than `f32`, there is none.
const SEARCH_ULPS: u32 = 4;

/// The sRGB value from which a linear one is read back: the same bits, where there is such a value.
fn encoded(linear: f32) -> f32 {
    let first = srgb_from_linear(linear);
    let gives_back = |value: &f32| linear_from_srgb(*value).to_bits() == linear.to_bits();
    let bits = first.to_bits();
    let nearby = (0..=SEARCH_ULPS).flat_map(|ulps| [bits.wrapping_add(ulps), bits.saturating_sub(ulps)]);
    nearby.map(f32::from_bits).find(gives_back).unwrap_or(first)
}

impl Number {
    /// In a header.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::UChar => "uchar",
            Self::UShort => "ushort",
            Self::Float => "float",
        }
    }

    /// The value that is read back for one from 0 to 1.
    fn rounded(self, value: f32) -> f32 {
        match self {
            Self::UChar => (f64::from(steps(value, 255.0)) / 255.0) as f32,
            Self::UShort => (f64::from(steps(value, 65_535.0)) / 65_535.0) as f32,
            Self::Float => value,
        }
    }

    fn push(self, row: &mut Vec<u8>, value: f32) -> io::Result<()> {
        match self {
            Self::UChar => row.write_all(&[steps(value, 255.0) as u8]),
            Self::UShort => row.write_all(&(steps(value, 65_535.0) as u16).to_le_bytes()),
            Self::Float => row.write_all(&value.to_le_bytes()),
        }
    }
}

/// A value as an integer from 0 to `full`.
fn steps(value: f32, full: f32) -> u32 {
    (value.clamp(0.0, 1.0) * full).round() as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns(colors: Vec<[f32; 4]>) -> (Option<Number>, Option<Number>) {
        let positions = vec![glam::DVec3::ZERO; colors.len()];
        let shapes = crate::scene::Shapes::Disks { normals: Vec::new(), radii: Vec::new() };
        let columns = ColorColumns::of(&Splats::new(positions, shapes, Colors::Each(colors)));
        (columns.rgb, columns.alpha)
    }

    #[test]
    fn the_narrowest_type_that_keeps_every_value_is_taken() {
        let of = |steps: f64, full: f64| linear_from_srgb((steps / full) as f32);
        let bytes = |alpha| (0..=255).map(|i| [of(f64::from(i), 255.0), 0.0, 1.0, alpha]).collect::<Vec<_>>();
        let shorts: Vec<_> = (0..=65_535).map(|i| [of(f64::from(i), 65_535.0), 0.5, 0.0, 1.0]).collect();
        assert_eq!(columns(bytes(1.0)), (Some(Number::UChar), None));
        assert_eq!(columns(bytes((51.0 / 255.0) as f32)), (Some(Number::UChar), Some(Number::UChar)));
        assert_eq!(columns(bytes((51.0 / 65_535.0) as f32)), (Some(Number::UChar), Some(Number::UShort)));
        assert_eq!(columns(bytes(0.1234)), (Some(Number::UChar), Some(Number::Float)));
        // 0.5 linear is none of 65 536 sRGB values.
        assert_eq!(columns(shorts.clone()), (Some(Number::Float), None));
        let shorts = shorts.into_iter().map(|[red, ..]| [red, 0.0, 0.0, 1.0]).collect();
        assert_eq!(columns(shorts), (Some(Number::UShort), None));
        assert_eq!(columns(vec![[f32::NAN, 0.0, 0.0, 1.0]]).0, Some(Number::Float));
    }
}
