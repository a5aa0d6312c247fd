//! What is seen of things that light passes through: nothing, in part, or all.

use super::{Colors, MeshColors};

/// How much an object hides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Opacity {
    /// Every alpha is 0: it is not drawn at all.
    Invisible,
    /// Some alpha is below 1: all of it is drawn in layers, its opaque parts too, so that it stays one surface.
    Transparent,
    /// Every alpha is 1 (or more, which counts as 1).
    Opaque,
}

impl Opacity {
    /// Of many alphas. Those that are not finite belong to nothing that is drawn; without any other it is opaque.
    fn of(alphas: impl Iterator<Item = f32>) -> Self {
        let (mut visible, mut transparent) = (false, false);
        for alpha in alphas.filter(|alpha| alpha.is_finite()) {
            visible |= alpha > 0.0;
            transparent |= alpha < 1.0;
        }
        match (visible, transparent) {
            (false, true) => Self::Invisible,
            (true, true) => Self::Transparent,
            (_, false) => Self::Opaque,
        }
    }
}

impl Colors {
    /// How much splats of these colors hide.
    pub fn opacity(&self) -> Opacity {
        match self {
            Self::Uniform([.., alpha]) => Opacity::of(std::iter::once(*alpha)),
            Self::PerSplat(colors) => Opacity::of(colors.iter().map(|color| color[3])),
        }
    }
}

impl MeshColors {
    /// How much a mesh of these colors hides.
    pub fn opacity(&self) -> Opacity {
        match self {
            Self::None => Opacity::Opaque,
            Self::Uniform([.., alpha]) => Opacity::of(std::iter::once(*alpha)),
            Self::PerVertex(colors) => Opacity::of(colors.iter().map(|color| color[3])),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_alpha_below_1_makes_a_thing_transparent_and_all_0_make_it_nothing() {
        let of =
            |alphas: &[f32]| Colors::PerSplat(alphas.iter().map(|a| [0.5, 0.5, 0.5, *a]).collect()).opacity();
        assert_eq!(of(&[1.0, 1.0]), Opacity::Opaque);
        assert_eq!(of(&[]), Opacity::Opaque);
        assert_eq!(of(&[2.0]), Opacity::Opaque);
        assert_eq!(of(&[1.0, 0.999]), Opacity::Transparent);
        assert_eq!(of(&[0.0, 1.0]), Opacity::Transparent);
        assert_eq!(of(&[0.0, 0.0]), Opacity::Invisible);
        assert_eq!(of(&[-1.0]), Opacity::Invisible);
        assert_eq!(of(&[f32::NAN, 1.0]), Opacity::Opaque);
        assert_eq!(of(&[f32::NAN, 0.0]), Opacity::Invisible);
        assert_eq!(Colors::Uniform([1.0, 1.0, 1.0, 0.5]).opacity(), Opacity::Transparent);
        assert_eq!(MeshColors::None.opacity(), Opacity::Opaque);
        assert_eq!(MeshColors::PerVertex(vec![[0.0; 4]]).opacity(), Opacity::Invisible);
    }
}
