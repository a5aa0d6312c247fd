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

/// The shaders of `pass` ("visibility" or "accumulate"); `options` are the words of its fragment stage, in their order.
pub(super) fn splat_shaders(pass: &str, settings: &Settings, options: &[&str]) -> Result<SplatShaders> {
    let [own, quads] = interfaces(settings);
    let stages = |vertex: &str, interface: &str| {
        let fragment: String = options.iter().map(|word| format!("_{word}")).collect();
        Ok((find(&format!("{pass}_{vertex}.vert"))?, find(&format!("{pass}_{interface}{fragment}.frag"))?))
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
            let all = stages_of_triangles(pass, "triangles", options);
            (all, stages_of_triangles(pass, "small_triangles", options))
        }
    };
    Ok(SplatShaders { all: all?, small: small?, listed: stages(&format!("listed_quads_{quads}"), quads)? })
}

/// The words that both passes share of their fragment stage's options.
pub(super) fn early_word(settings: &Settings) -> Option<&'static str> {
    settings.early_depth.then_some("early")
}

/// The words of accumulation's fragment stage.
pub(super) fn accumulate_words(settings: &Settings, with_depth: bool) -> Vec<&'static str> {
    let textured = (settings.kernel_eval == KernelEval::Texture).then_some("textured");
    [early_word(settings), textured, with_depth.then_some("with_depth")].into_iter().flatten().collect()
}

fn stages_of_triangles(pass: &str, vertex: &str, options: &[&str]) -> Result<Stages> {
    // Their depth is the rasterizer's own, so that tests are early anyway.
    let words: String =
        options.iter().filter(|word| **word != "early").map(|word| format!("_{word}")).collect();
    Ok((find(&format!("{pass}_{vertex}.vert"))?, find(&format!("{pass}_triangles{words}.frag"))?))
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

fn find(name: &str) -> Result<&'static Shader> {
    shaders::by_name(name).ok_or_else(|| Error::option("shader", format!("{name}: not compiled")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_setting_has_its_shaders() {
        let mut checked = 0;
        for (_, rasterizer) in Rasterizer::NAMES {
            for (_, filter) in Filter::NAMES {
                for (_, kernel_eval) in KernelEval::NAMES {
                    for early_depth in [false, true] {
                        let settings = Settings {
                            rasterizer: *rasterizer,
                            filter: *filter,
                            kernel_eval: *kernel_eval,
                            early_depth,
                            ..Settings::default()
                        };
                        if settings.validate().is_err() {
                            continue;
                        }
                        let early: Vec<_> = early_word(&settings).into_iter().collect();
                        splat_shaders("visibility", &settings, &early).unwrap();
                        for with_depth in [false, true] {
                            let words = accumulate_words(&settings, with_depth);
                            splat_shaders("accumulate", &settings, &words).unwrap();
                        }
                        checked += 1;
                    }
                }
            }
        }
        assert!(checked > 100, "{checked}");
    }
}
