//! How a scene is drawn: the settings that it has, and the methods that they allow.

use surfel::{
    renderer::Wanted,
    scene::{
        Accumulate, Backfaces, Cull, Edges, Epsilon, Filter, FilterWeight, Kernel, Rasterizer, Settings,
        Shapes,
    },
};

use super::{
    looking::{Draws as _, SIZE_PX},
    put::Made,
};
use crate::common::builder::Random;

const PSI_E: Kernel = Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 };

/// One way to a picture, or to the surface as data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// The surface as data.
    Surface(Rasterizer),
    /// The picture alone, in 32 bits: tiles are shaded in the dispatch that sums them, unless some splat is too large for them.
    Shaded,
    /// The same with all that is the default: 16-bit sums, 8-bit sRGB.
    Picture,
}

impl Method {
    pub fn name(self) -> &'static str {
        match self {
            Self::Surface(rasterizer) => rasterizer.name(),
            Self::Shaded => "compute, picture",
            Self::Picture => "compute, picture, sRGB",
        }
    }

    /// Whether it is a picture that is looked at, not the surface as data.
    pub fn is_picture(self) -> bool {
        matches!(self, Self::Shaded | Self::Picture)
    }

    pub fn rasterizer(self) -> Rasterizer {
        match self {
            Self::Surface(rasterizer) => rasterizer,
            Self::Shaded | Self::Picture => Rasterizer::Compute,
        }
    }

    pub fn wanted(self) -> Wanted {
        let picture = self.is_picture();
        Wanted { picture, linear: self != Self::Picture, surface: !picture, profile: None }
    }

    /// The settings for it.
    pub fn of(self, settings: &Settings) -> Settings {
        let accumulate = if self == Self::Picture { Accumulate::F16 } else { Accumulate::F32 };
        Settings { rasterizer: self.rasterizer(), accumulate, ..settings.clone() }
    }

    /// All that these settings allow.
    pub fn all(settings: &Settings) -> Vec<Self> {
        let surfaces = Rasterizer::METHODS.iter().map(|(_, rasterizer)| Self::Surface(*rasterizer));
        let all = surfaces.chain([Self::Shaded, Self::Picture]);
        all.filter(|method| method.of(settings).validate().is_ok()).collect()
    }
}

/// Settings at random, among those under which the scene shows something.
pub fn settings(random: &mut Random, made: &Made, plain: bool) -> Settings {
    let disks = matches!(made.object.splats.shapes, Shapes::Disks { .. });
    let allowed: Vec<Filter> = made
        .filters
        .iter()
        .copied()
        .filter(|filter| disks || *filter != Filter::AdjustPaper)
        .filter(|filter| !plain || matches!(filter, Filter::Adjust | Filter::None))
        .collect();
    let filter = random.one_of(&allowed);
    let epsilon = made.epsilon.unwrap_or_else(|| match random.count(0, 3) {
        0 => Epsilon::Length(made.radius * random.log(0.1, 10.0)),
        1 => Epsilon::Radii(random.between(0.0, 3.0)),
        _ => Epsilon::Radii(1.0),
    });
    let (kernel, filter_weight) = (random.is(0.25), random.is(0.2));
    let backfaces = random.one_of(&[Backfaces::Auto, Backfaces::Auto, Backfaces::Flip, Backfaces::Cull]);
    let cull = random.one_of(&[Cull::Auto, Cull::Setup, Cull::List, Cull::Hidden]);
    let default = Settings {
        edges: Edges::Hard, // of surfaces as data
        size_px: SIZE_PX,
        accumulate: Accumulate::F32,
        filter,
        epsilon,
        background: None,
        ..Settings::default()
    };
    if plain {
        let cull = random.one_of(&[Cull::Auto, Cull::List]);
        return Settings { backfaces: made.backfaces.unwrap_or_default(), cull, ..default };
    }
    Settings {
        kernel: if kernel && filter != Filter::Ewa { PSI_E } else { Kernel::default() },
        filter_weight: if filter_weight && filter.adjusts() {
            FilterWeight::Unit
        } else {
            FilterWeight::Area
        },
        backfaces: made.backfaces.unwrap_or(backfaces),
        cull,
        ..default
    }
}
