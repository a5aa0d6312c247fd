//! Where splats and polygons of one surface meet (Guennebaud, Barthe, Paulin 2006, section 5.1): the splats' sum of
//! weights falls from 1 to 0 at the end of what is sampled, so that it says how much of either is to be seen.

use glam::DVec3;

use super::surface::{Attributes, direction};
use crate::scene::Transition;

/// A color that is multiplied by its alpha.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Premultiplied {
    /// Linear.
    pub color: DVec3,
    pub alpha: f64,
}

/// Splats of one surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Splatted {
    pub attributes: Attributes,
    /// `Σw`.
    pub weight: f64,
}

impl Premultiplied {
    /// Nothing is there.
    pub const NONE: Self = Self { color: DVec3::ZERO, alpha: 0.0 };
}

/// The look of one surface: `polygon + s (splats − polygon)` with `s = min(Σw, 1)` where both are there. The colors
/// are multiplied by alpha before they are blended, so that what is not seen has no color.
pub(super) fn join(
    transition: Transition,
    splats: Option<Splatted>,
    polygon: Option<Attributes>,
    shade: impl Fn(&Attributes) -> DVec3,
) -> Premultiplied {
    let shaded = |attributes: &Attributes| Premultiplied {
        color: attributes.alpha * shade(attributes),
        alpha: attributes.alpha,
    };
    let (splats, polygon) = match (splats, polygon) {
        (Some(splats), Some(polygon)) => (splats, polygon),
        (Some(one), None) => return shaded(&one.attributes),
        (None, Some(one)) => return shaded(&one),
        (None, None) => return Premultiplied::NONE,
    };
    let share = splats.weight.clamp(0.0, 1.0);
    let mix = |polygon: f64, splats: f64| (1.0 - share) * polygon + share * splats;
    let mix3 = |polygon: DVec3, splats: DVec3| (1.0 - share) * polygon + share * splats;
    match transition {
        Transition::None => shaded(&polygon),
        Transition::Color | Transition::Paper => {
            let (polygon, splats) = (shaded(&polygon), shaded(&splats.attributes));
            Premultiplied {
                color: mix3(polygon.color, splats.color),
                alpha: mix(polygon.alpha, splats.alpha),
            }
        }
        Transition::Attributes => shaded(&Attributes {
            albedo: mix3(polygon.albedo, splats.attributes.albedo),
            normal: direction(mix3(polygon.normal, splats.attributes.normal), 1.0),
            alpha: mix(polygon.alpha, splats.attributes.alpha),
        }),
    }
}
