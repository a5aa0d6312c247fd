//! How much of a thing is seen: nothing, in part, or all.

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
    /// The opacity of a thing of these colors. Alphas that are not finite belong to nothing that is drawn; without any other it is opaque.
    pub(super) fn of(colors: &[[f32; 4]]) -> Self {
        let (mut visible, mut transparent) = (false, false);
        for [.., alpha] in colors.iter().filter(|[.., alpha]| alpha.is_finite()) {
            visible |= *alpha > 0.0;
            transparent |= *alpha < 1.0;
        }
        match (visible, transparent) {
            (false, true) => Self::Invisible,
            (true, true) => Self::Transparent,
            (_, false) => Self::Opaque,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Colors;

    #[test]
    fn one_alpha_below_1_makes_a_thing_transparent_and_all_0_make_it_nothing() {
        let of =
            |alphas: &[f32]| Colors::Each(alphas.iter().map(|a| [0.5, 0.5, 0.5, *a]).collect()).opacity();
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
    }
}
