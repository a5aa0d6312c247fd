//! The colors of splats and vertices: replaced, made transparent, and what is seen through them.

use super::Opacity;
use crate::math::srgb::linear_from_srgb;

/// Linear albedo (red, green, blue) and straight alpha, each 0–1. What is finite and outside of that is taken for the nearer end, and is no defect: a color has no more light than
/// white, and of an alpha of 0 or below nothing is seen. More light is that of [`super::Light`]. What is not finite is [`super::Defect::Color`].
#[derive(Clone, Debug)]
pub enum Colors {
    /// One color for all.
    Uniform([f32; 4]),
    /// One for each splat or vertex.
    Each(Vec<[f32; 4]>),
}

/// The albedo of surfaces without colors, as an sRGB value.
pub const UNKNOWN_SRGB: f32 = 204.0 / 255.0;

impl Colors {
    /// The color of a surface that has none: the sRGB value 204/255, opaque.
    pub fn unknown() -> Self {
        let gray = linear_from_srgb(UNKNOWN_SRGB);
        Self::Uniform([gray, gray, gray, 1.0])
    }

    /// The color of splat or vertex `i`; `None` where there are fewer.
    pub fn get(&self, i: usize) -> Option<[f32; 4]> {
        match self {
            Self::Uniform(color) => Some(*color),
            Self::Each(colors) => colors.get(i).copied(),
        }
    }

    /// How much a thing of these colors hides.
    pub fn opacity(&self) -> Opacity {
        match self {
            Self::Uniform(color) => Opacity::of(std::slice::from_ref(color)),
            Self::Each(colors) => Opacity::of(colors),
        }
    }

    /// Gives all this color (linear, 0–1) where one is given, and multiplies every alpha by `alpha`.
    pub fn tint(&mut self, color: Option<[f32; 3]>, alpha: f32) {
        let tinted = |own: [f32; 4]| {
            let [red, green, blue] = color.unwrap_or([own[0], own[1], own[2]]);
            [red, green, blue, own[3] * alpha]
        };
        match self {
            Self::Uniform(all) => *all = tinted(*all),
            Self::Each(each) => {
                each.iter_mut().for_each(|own| *own = tinted(*own));
                // Where all have become the same, it need not be kept for each.
                if color.is_some()
                    && let Some((&first, others)) = each.split_first()
                    && others.iter().all(|other| *other == first)
                {
                    *self = Self::Uniform(first);
                }
            }
        }
    }
}

impl Default for Colors {
    fn default() -> Self {
        Self::unknown()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_color_replaces_and_an_alpha_multiplies() {
        let own = [[0.1, 0.2, 0.3, 1.0], [0.4, 0.5, 0.6, 0.5]];
        let tinted = |color, alpha| {
            let mut colors = Colors::Each(own.into());
            colors.tint(color, alpha);
            let Colors::Each(each) = colors else { panic!("one color") };
            each
        };
        assert_eq!(tinted(None, 0.5), [[0.1, 0.2, 0.3, 0.5], [0.4, 0.5, 0.6, 0.25]]);
        assert_eq!(tinted(Some([1.0, 0.0, 0.5]), 1.0), [[1.0, 0.0, 0.5, 1.0], [1.0, 0.0, 0.5, 0.5]]);
    }

    #[test]
    fn one_color_for_all_is_kept_once() {
        let mut same = Colors::Each(vec![[0.1, 0.2, 0.3, 0.5], [0.4, 0.5, 0.6, 0.5]]);
        same.tint(Some([1.0, 0.5, 0.0]), 0.5);
        assert!(matches!(same, Colors::Uniform([1.0, 0.5, 0.0, 0.25])));
    }
}
