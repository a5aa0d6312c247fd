//! Colors replaced, and surfaces made transparent.

use super::{Colors, MeshColors, UNKNOWN_SRGB};
use crate::math::srgb::linear_from_srgb;

impl Colors {
    /// Gives all splats this color (linear, 0–1) where one is given, and multiplies every alpha by `alpha`.
    pub fn tint(&mut self, color: Option<[f32; 3]>, alpha: f32) {
        match self {
            Self::Uniform(all) => *all = tinted(*all, color, alpha),
            Self::PerSplat(each) => {
                if let Some(all) = tint_each(each, color, alpha) {
                    *self = Self::Uniform(all);
                }
            }
        }
    }
}

impl MeshColors {
    /// As [`Colors::tint`]; a mesh without colors has that of [`Colors::unknown`].
    pub fn tint(&mut self, color: Option<[f32; 3]>, alpha: f32) {
        match self {
            Self::None if color.is_none() && alpha == 1.0 => {}
            Self::None => {
                let gray = linear_from_srgb(UNKNOWN_SRGB);
                *self = Self::Uniform(tinted([gray, gray, gray, 1.0], color, alpha));
            }
            Self::Uniform(all) => *all = tinted(*all, color, alpha),
            Self::PerVertex(each) => {
                if let Some(all) = tint_each(each, color, alpha) {
                    *self = Self::Uniform(all);
                }
            }
        }
    }
}

fn tinted(own: [f32; 4], color: Option<[f32; 3]>, alpha: f32) -> [f32; 4] {
    let [red, green, blue] = color.unwrap_or([own[0], own[1], own[2]]);
    [red, green, blue, own[3] * alpha]
}

/// Where all have become the same, that one: it need not be kept for each.
fn tint_each(colors: &mut [[f32; 4]], color: Option<[f32; 3]>, alpha: f32) -> Option<[f32; 4]> {
    colors.iter_mut().for_each(|own| *own = tinted(*own, color, alpha));
    let (first, others) = colors.split_first()?;
    (color.is_some() && others.iter().all(|other| other == first)).then_some(*first)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_color_replaces_and_an_alpha_multiplies() {
        let own = [[0.1, 0.2, 0.3, 1.0], [0.4, 0.5, 0.6, 0.5]];
        let tinted = |color, alpha| {
            let (mut splats, mut mesh) = (Colors::PerSplat(own.into()), MeshColors::PerVertex(own.into()));
            splats.tint(color, alpha);
            mesh.tint(color, alpha);
            let Colors::PerSplat(each) = splats else { panic!("one color") };
            assert!(matches!(mesh, MeshColors::PerVertex(of_mesh) if of_mesh == each));
            each
        };
        assert_eq!(tinted(None, 0.5), [[0.1, 0.2, 0.3, 0.5], [0.4, 0.5, 0.6, 0.25]]);
        assert_eq!(tinted(Some([1.0, 0.0, 0.5]), 1.0), [[1.0, 0.0, 0.5, 1.0], [1.0, 0.0, 0.5, 0.5]]);
    }

    #[test]
    fn one_color_for_all_is_kept_once() {
        let mut same = Colors::PerSplat(vec![[0.1, 0.2, 0.3, 0.5], [0.4, 0.5, 0.6, 0.5]]);
        same.tint(Some([1.0, 0.5, 0.0]), 0.5);
        assert!(matches!(same, Colors::Uniform([1.0, 0.5, 0.0, 0.25])));
        let mut none = MeshColors::None;
        none.tint(None, 1.0);
        assert!(matches!(none, MeshColors::None));
        none.tint(None, 0.5);
        let (MeshColors::Uniform(gray), Colors::Uniform(unknown)) = (none, Colors::unknown()) else {
            panic!("each its own")
        };
        assert_eq!((gray[..3].to_vec(), gray[3]), (unknown[..3].to_vec(), 0.5));
    }
}
