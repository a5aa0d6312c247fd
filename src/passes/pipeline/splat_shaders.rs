//! Which shaders draw splats: the permutations of `glsl/visibility.*` and `glsl/accumulate.*` for a rasterizer and a filter.

use ash::vk;

use crate::{
    scene::{Filter, Rasterizer, Settings},
    shaders::{self, Shader},
};

/// A vertex stage and a fragment stage.
pub(crate) type Stages = (&'static Shader, &'static Shader);

/// What splats are drawn as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Primitive {
    /// A sprite: one vertex.
    Point,
    /// A strip of four vertices, an instance a splat.
    Quad,
    /// Three vertices.
    Triangle,
}

impl Primitive {
    /// What a rasterizer draws; splats that don't fit are drawn as quads beside it.
    pub fn of(rasterizer: Rasterizer) -> Self {
        match rasterizer {
            Rasterizer::Quad => Self::Quad,
            Rasterizer::Triangle => Self::Triangle,
            Rasterizer::Auto
            | Rasterizer::Perspective
            | Rasterizer::PerspectivePaper
            | Rasterizer::Raycast
            | Rasterizer::RaycastApproximate
            | Rasterizer::AffineCenter
            | Rasterizer::AffineContour
            | Rasterizer::Compute => Self::Point,
        }
    }

    /// How vertices make primitives.
    pub fn topology(self) -> vk::PrimitiveTopology {
        match self {
            Self::Point => vk::PrimitiveTopology::POINT_LIST,
            Self::Quad => vk::PrimitiveTopology::TRIANGLE_STRIP,
            Self::Triangle => vk::PrimitiveTopology::TRIANGLE_LIST,
        }
    }

    /// Vertices an instance, and instances, for so many splats.
    pub fn counts(self, splats: u32) -> [u32; 2] {
        match self {
            Self::Point => [splats, 1],
            Self::Quad => [4, splats],
            Self::Triangle => [3 * splats, 1],
        }
    }
}

/// A primitive and what its vertex stage hands to fragments (`glsl/inc/varyings.glsl`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Drawn {
    PlainPoints,
    CenterPoints,
    RayPoints,
    FullQuads,
    CenterQuads,
    RayQuads,
    Triangles,
}

impl Drawn {
    /// Splats of these settings as that primitive.
    pub fn of(primitive: Primitive, settings: &Settings) -> Self {
        use Rasterizer::{AffineContour, PerspectivePaper, Raycast, RaycastApproximate};
        let rays = matches!(settings.rasterizer, Raycast | RaycastApproximate);
        let max = settings.filter == Filter::Max;
        // Not expanded about the projected center, which the low-pass filter is around.
        let elsewhere = matches!(settings.rasterizer, PerspectivePaper | AffineContour);
        match primitive {
            Primitive::Point if rays => Self::RayPoints,
            Primitive::Point if max && elsewhere => Self::CenterPoints,
            Primitive::Point => Self::PlainPoints,
            Primitive::Quad if rays => Self::RayQuads,
            Primitive::Quad if max => Self::CenterQuads,
            Primitive::Quad => Self::FullQuads,
            Primitive::Triangle => Self::Triangles,
        }
    }

    /// The shaders of visibility; `layer`: of a transparent layer.
    pub fn visibility(self, layer: bool) -> Stages {
        match self {
            Self::PlainPoints => (&shaders::VISIBILITY_POINTS_PLAIN_VERT, &shaders::VISIBILITY_PLAIN_FRAG),
            Self::CenterPoints => (&shaders::VISIBILITY_POINTS_CENTER_VERT, &shaders::VISIBILITY_CENTER_FRAG),
            Self::RayPoints => (&shaders::VISIBILITY_POINTS_RAYS_VERT, &shaders::VISIBILITY_RAYS_FRAG),
            Self::FullQuads => (&shaders::VISIBILITY_QUADS_FULL_VERT, &shaders::VISIBILITY_FULL_FRAG),
            Self::CenterQuads => (&shaders::VISIBILITY_QUADS_CENTER_VERT, &shaders::VISIBILITY_CENTER_FRAG),
            Self::RayQuads => (&shaders::VISIBILITY_QUADS_RAYS_VERT, &shaders::VISIBILITY_RAYS_FRAG),
            Self::Triangles if layer => {
                (&shaders::VISIBILITY_TRIANGLES_VERT, &shaders::VISIBILITY_TRIANGLES_OWN_DEPTH_FRAG)
            }
            Self::Triangles => (&shaders::VISIBILITY_TRIANGLES_VERT, &shaders::VISIBILITY_TRIANGLES_FRAG),
        }
    }

    /// The shaders that find whose the visible surface is.
    pub fn objects(self) -> Stages {
        let fragment: &'static Shader = match self {
            Self::PlainPoints => &shaders::OBJECTS_PLAIN_FRAG,
            Self::FullQuads => &shaders::OBJECTS_FULL_FRAG,
            Self::CenterPoints | Self::CenterQuads => &shaders::OBJECTS_CENTER_FRAG,
            Self::RayPoints | Self::RayQuads => &shaders::OBJECTS_RAYS_FRAG,
            Self::Triangles => &shaders::OBJECTS_TRIANGLES_FRAG,
        };
        (self.visibility(false).0, fragment)
    }

    /// The shaders of accumulation.
    pub fn accumulate(self, summed: Summed) -> Stages {
        let alone = matches!(summed, Summed::Opaque { beside_polygons: false, .. });
        match self {
            Self::PlainPoints if alone => {
                (&shaders::ACCUMULATE_POINTS_PLAIN_VERT, &shaders::ACCUMULATE_PLAIN_FRAG)
            }
            Self::PlainPoints => {
                (&shaders::ACCUMULATE_POINTS_PLAIN_FOURTH_VERT, &shaders::ACCUMULATE_PLAIN_FOURTH_FRAG)
            }
            Self::CenterPoints => (&shaders::ACCUMULATE_POINTS_CENTER_VERT, &shaders::ACCUMULATE_CENTER_FRAG),
            Self::RayPoints => {
                (&shaders::ACCUMULATE_POINTS_RAYS_FOURTH_VERT, &shaders::ACCUMULATE_RAYS_FOURTH_FRAG)
            }
            Self::FullQuads => (&shaders::ACCUMULATE_QUADS_FULL_VERT, &shaders::ACCUMULATE_FULL_FRAG),
            Self::CenterQuads => (&shaders::ACCUMULATE_QUADS_CENTER_VERT, &shaders::ACCUMULATE_CENTER_FRAG),
            Self::RayQuads => {
                (&shaders::ACCUMULATE_QUADS_RAYS_FOURTH_VERT, &shaders::ACCUMULATE_RAYS_FOURTH_FRAG)
            }
            Self::Triangles if summed.is_transparent() => {
                (&shaders::ACCUMULATE_TRIANGLES_VERT, &shaders::ACCUMULATE_TRIANGLES_OWN_DEPTH_FRAG)
            }
            Self::Triangles => (&shaders::ACCUMULATE_TRIANGLES_VERT, &shaders::ACCUMULATE_TRIANGLES_FRAG),
        }
    }
}

/// The permutations that cut off splats what clip curves remove.
pub(crate) fn clipped((vertex, fragment): Stages) -> Stages {
    let clipped = |shader: &Shader| {
        let (file, stage) = shader.name.rsplit_once('.').unwrap_or((shader.name, ""));
        let is_clipped = |other: &str| {
            other.strip_prefix(file).and_then(|rest| rest.strip_prefix("_clipped.")) == Some(stage)
        };
        shaders::ALL.iter().find(|other| is_clipped(other.name)).copied()
    };
    (clipped(vertex).unwrap_or(vertex), clipped(fragment).unwrap_or(fragment))
}

/// What accumulation sums, and of which fragments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Summed {
    /// The opaque surface: color and normal.
    Opaque {
        /// Depth too.
        with_depth: bool,
        /// Where it is not behind polygons.
        beside_polygons: bool,
    },
    /// A transparent layer: color, normal and alpha.
    Layer,
    /// All that is left for the last layer: lit colors, weighted by alpha.
    Rest,
}

impl Summed {
    fn is_transparent(self) -> bool {
        !matches!(self, Self::Opaque { .. })
    }
}
