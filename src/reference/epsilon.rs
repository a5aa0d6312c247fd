//! How far behind the nearest splat others belong to one surface, for each splat by itself.

use super::near_surfaces::shares;
use crate::scene::{Epsilon, Object, Opacity, Scene, Settings, Shapes, SplatFormat};

/// The rule for the splats of an object.
pub(super) enum EpsilonRule {
    Length(f64),
    /// So many radii, and of them for each splat so much, where they differ.
    Radii(f64, Option<Vec<f64>>),
}

/// Where edges are not hard, ε of what is seen slanted is many radii. Toward a polygon it counts no more than as many radii of the image as it would have
/// without that: what is behind a polygon is not to be seen through it. An ε that has a length is not made larger.
pub(super) fn polygon_reach(scene: &Scene, settings: &Settings) -> f64 {
    let of_object = |object: usize| match scene.epsilon(object, settings) {
        Epsilon::Length(_) => f64::INFINITY,
        Epsilon::Radii(radii) => radii.max(1.0),
        Epsilon::Auto => 1.0,
    };
    (0..scene.objects.len()).map(of_object).fold(0.0, f64::max)
}

impl EpsilonRule {
    pub fn of(scene: &Scene, object: usize, settings: &Settings, opacity: Opacity) -> Self {
        match scene.epsilon(object, settings) {
            Epsilon::Length(length) => Self::Length(length),
            Epsilon::Radii(radii) => Self::Radii(radii, None),
            Epsilon::Auto => {
                let object = &scene.objects[object];
                let radii = if opacity == Opacity::Transparent { 2.0 } else { 1.0 };
                // The far side of what is closed and opaque is not drawn, and where pixels are covered in part no opaque surface has both
                // sides. Packed disks have no room for a share.
                let one_side = object.closed || settings.covers_in_part();
                let sides = opacity == Opacity::Transparent || !one_side || !object.splats.clips.is_empty();
                let ellipses = matches!(object.splats.shapes, Shapes::Ellipses { .. });
                let exact = scene.storage.format == SplatFormat::Exact || ellipses;
                Self::Radii(radii, (sides && exact).then(|| shares(&object.splats, radii)))
            }
        }
    }

    /// Of splat `i`, whose surface is so thick: its larger radius, or more where a filter makes it thicker.
    pub fn epsilon(&self, i: usize, thickness: f64) -> f64 {
        match self {
            Self::Length(length) => *length,
            Self::Radii(radii, shares) => radii * thickness * shares.as_ref().map_or(1.0, |shares| shares[i]),
        }
    }

    /// Of a length that stands for a radius, whatever share splats have; none where ε is a length itself.
    pub fn of_length(&self, length: f64) -> f64 {
        match self {
            Self::Length(_) => 0.0,
            Self::Radii(radii, _) => radii * length,
        }
    }
}

/// The ε of transparent polygons, which have no radius: with one in radii the mean of transparent splats, of all that can
/// be drawn; 0 where there is none.
pub(super) fn mean_epsilon(scene: &Scene, epsilon: Epsilon) -> f64 {
    let factor = match epsilon {
        Epsilon::Length(length) => return length,
        Epsilon::Radii(factor) => factor,
        Epsilon::Auto => 2.0,
    };
    let (mut sum, mut count) = (0.0, 0_u64);
    let transparent =
        scene.objects.iter().filter(|object| object.splats.colors.opacity() == Opacity::Transparent);
    for Object { splats, .. } in transparent {
        for i in (0..splats.len()).filter(|&i| splats.defect(i).is_none()) {
            sum += splats.major_radius(i);
            count += 1;
        }
    }
    if count > 0 { factor * sum / count as f64 } else { 0.0 }
}
