//! Which shaders draw splats: the permutations of `glsl/visibility.*` and `glsl/accumulate.*` for a rasterizer and a filter.

use ash::vk;

use crate::{
    error::{Error, Result},
    scene::{Filter, KernelEval, Rasterizer, Settings},
    shaders::{self, Shader},
};

/// A vertex stage and a fragment stage.
pub(super) type Stages = (&'static Shader, &'static Shader);

/// What splats are drawn as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Primitive {
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
            _ => Self::Point,
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

/// The shaders of one splat pass.
pub(super) struct SplatShaders {
    /// For chunks whose splats are all drawn as the rasterizer's own primitive.
    pub all: Stages,
    /// For the others: those of their splats that are.
    pub small: Stages,
    /// And those that are drawn as quads, from the list.
    pub listed: Stages,
}

/// The words that choose among the permutations of a splat pass, beside primitive and interface.
pub(super) struct Words {
    /// `visibility` or `accumulate`.
    pub pass: &'static str,
    /// Of the vertex stage.
    pub vertex: Option<&'static str>,
    /// Of the vertex stage of triangles.
    pub triangle_vertex: Option<&'static str>,
    /// Of the fragment stage, in their order.
    pub fragment: Vec<&'static str>,
    /// Of the fragment stage of triangles.
    pub triangle_fragment: Vec<&'static str>,
}

/// What accumulation sums, and of which fragments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Summed {
    /// The opaque surface: color and normal.
    Opaque {
        /// Depth too.
        with_depth: bool,
        /// Where it is not behind polygons.
        beside_polygons: bool,
    },
    /// A transparent layer: color, normal and alpha.
    Layer {
        /// Behind the one before.
        peeled: bool,
    },
    /// All that is left for the last layer: lit colors, weighted by alpha.
    Rest {
        /// Behind the layer before.
        peeled: bool,
        /// By lights of the scene's own.
        lit: bool,
    },
}

impl Words {
    /// Of visibility: of the opaque part (`None`), or of a layer, perhaps behind one that was peeled off.
    pub fn visibility(layer: Option<bool>) -> Self {
        let peeled = (layer == Some(true)).then_some("peeled");
        Self {
            pass: "visibility",
            vertex: None,
            triangle_vertex: layer.map(|_| "layer"),
            fragment: peeled.into_iter().collect(),
            triangle_fragment: layer
                .map(|peeled| if peeled { "layer_peeled" } else { "layer" })
                .into_iter()
                .collect(),
        }
    }

    /// Of accumulation.
    pub fn accumulate(settings: &Settings, summed: Summed) -> Self {
        let textured = (settings.kernel_eval == KernelEval::Texture).then_some("textured");
        let (kind, [third, fourth]) = match summed {
            Summed::Opaque { with_depth, beside_polygons } => {
                let beside = beside_polygons.then_some("beside");
                (beside, [with_depth.then_some("with_depth"), beside])
            }
            Summed::Layer { peeled } => (Some("layer"), [Some("layer"), peeled.then_some("peeled")]),
            Summed::Rest { peeled, lit } => {
                let vertex = if lit { "blended_lit" } else { "blended" };
                (Some(vertex), [Some("blended"), peeled.then_some("peeled")])
            }
        };
        let fragment: Vec<_> = [textured, third, fourth].into_iter().flatten().collect();
        let triangle_fragment = fragment.clone();
        Self { pass: "accumulate", vertex: kind, triangle_vertex: kind, fragment, triangle_fragment }
    }
}

/// The shaders of a splat pass.
pub(super) fn splat_shaders(settings: &Settings, words: &Words) -> Result<SplatShaders> {
    let pass = words.pass;
    let [own, quads] = interfaces(settings);
    let stages = |vertex: &str, interface: &str| {
        let fragment: String = words.fragment.iter().map(|word| format!("_{word}")).collect();
        let kind = words.vertex.map(|word| format!("_{word}")).unwrap_or_default();
        Ok((
            find(&format!("{pass}_{vertex}{kind}.vert"))?,
            find(&format!("{pass}_{interface}{fragment}.frag"))?,
        ))
    };
    let (all, small) = match Primitive::of(settings.rasterizer) {
        Primitive::Point => {
            (stages(&format!("points_{own}"), own), stages(&format!("small_points_{own}"), own))
        }
        // All are quads: there is no list, and nothing small.
        Primitive::Quad => {
            let all = || stages(&format!("quads_{quads}"), quads);
            (all(), all())
        }
        Primitive::Triangle => {
            (stages_of_triangles("triangles", words), stages_of_triangles("small_triangles", words))
        }
    };
    Ok(SplatShaders { all: all?, small: small?, listed: stages(&format!("listed_quads_{quads}"), quads)? })
}

fn stages_of_triangles(vertex: &str, words: &Words) -> Result<Stages> {
    let pass = words.pass;
    let kind = words.triangle_vertex.map(|word| format!("_{word}")).unwrap_or_default();
    let fragment: String = words.triangle_fragment.iter().map(|word| format!("_{word}")).collect();
    Ok((find(&format!("{pass}_{vertex}{kind}.vert"))?, find(&format!("{pass}_triangles{fragment}.frag"))?))
}

/// What the vertex stage hands over (`glsl/inc/varyings.glsl`) of points, and of quads.
fn interfaces(settings: &Settings) -> [&'static str; 2] {
    use Rasterizer::{AffineContour, PerspectivePaper, Raycast, RaycastApproximate};
    let max = settings.filter == Filter::Max;
    match settings.rasterizer {
        Raycast | RaycastApproximate => ["rays", "rays"],
        // Not expanded about the projected center, which the low-pass filter is around.
        PerspectivePaper | AffineContour if max => ["center", "center"],
        _ if max => ["plain", "center"],
        _ => ["plain", "full"],
    }
}

pub(super) fn find(name: &str) -> Result<&'static Shader> {
    shaders::by_name(name).ok_or_else(|| Error::option("shader", format!("{name}: not compiled")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_setting_has_its_shaders() {
        let mut checked = 0;
        for (_, rasterizer) in Rasterizer::METHODS {
            for (_, filter) in Filter::NAMES {
                for (_, kernel_eval) in KernelEval::NAMES {
                    let settings = Settings {
                        rasterizer: *rasterizer,
                        filter: *filter,
                        kernel_eval: *kernel_eval,
                        ..Settings::default()
                    };
                    if settings.validate().is_err() {
                        continue;
                    }
                    for choice in [false, true] {
                        let of = |layer| splat_shaders(&settings, &Words::visibility(layer));
                        of(Some(choice)).and(of(None)).unwrap();
                        for other in [false, true] {
                            let opaque = Summed::Opaque { with_depth: choice, beside_polygons: other };
                            let layer = Summed::Layer { peeled: choice };
                            let rest = Summed::Rest { peeled: choice, lit: other };
                            for summed in [opaque, layer, rest] {
                                splat_shaders(&settings, &Words::accumulate(&settings, summed)).unwrap();
                            }
                        }
                    }
                    checked += 1;
                }
            }
        }
        assert!(checked > 100, "{checked}");
    }
}
