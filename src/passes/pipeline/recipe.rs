//! A pipeline of a pass, without a scene: what it is made of, and how it is made.

use std::hash::{Hash, Hasher};

use ash::vk;

use crate::passes::pipeline::{
    cache::Shaders,
    formats::sum_format,
    key::{ComputeKey, GraphicsKey, Layout},
    splat_shaders::Stages,
};
use crate::{
    error::Result,
    scene::Accumulate,
    shaders::{Shader, config::*},
};

/// A pipeline, and the first pass that has it. Those of two passes are equal where one pipeline serves both.
#[derive(Clone, Debug)]
pub struct PipelineRecipe {
    /// The pass.
    pub pass: String,
    pub(crate) key: Key,
}

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Key {
    Graphics(GraphicsKey),
    Compute(ComputeKey),
    /// Never drawn, only counted.
    Counted(Stages),
}

impl PartialEq for PipelineRecipe {
    fn eq(&self, other: &Self) -> bool {
        self.key == other.key
    }
}

impl Eq for PipelineRecipe {}

impl Hash for PipelineRecipe {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.key.hash(state);
    }
}

/// The shaders of a pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PipelineStages {
    /// A vertex and a fragment stage.
    Graphics(&'static Shader, &'static Shader),
    /// A compute stage.
    Compute(&'static Shader),
}

impl PipelineRecipe {
    /// The shaders.
    pub fn stages(&self) -> PipelineStages {
        match &self.key {
            Key::Graphics(key) => PipelineStages::Graphics(key.vertex, key.fragment),
            Key::Compute(key) => PipelineStages::Compute(key.shader),
            Key::Counted((vertex, fragment)) => PipelineStages::Graphics(vertex, fragment),
        }
    }

    /// The specialization constants of all stages: number and 32-bit pattern.
    pub fn constants(&self) -> &[(u32, u32)] {
        match &self.key {
            Key::Graphics(key) => &key.constants,
            Key::Compute(key) => &key.constants,
            Key::Counted(_) => &[],
        }
    }

    /// Whether it has this specialization constant.
    pub fn has(&self, constant: u32) -> bool {
        self.constants().iter().any(|(number, _)| *number == constant)
    }

    /// Whether colors that it draws have 32 bits.
    pub fn draws_into_f32(&self) -> bool {
        let Key::Graphics(key) = &self.key else { return false };
        key.color_formats.first() == Some(&sum_format(Accumulate::F32))
    }

    /// Whether what it draws may be hidden by a depth that is there.
    pub fn tests_depth(&self) -> bool {
        matches!(&self.key, Key::Graphics(key) if key.depth.is_some())
    }

    /// Whether it projects splats or draws them, and so depends on rasterizer and filter.
    pub fn projects_splats(&self) -> bool {
        self.has(SPEC_RASTERIZER)
    }

    /// What it draws: `points`, `small points`, `listed quads` and so on; empty for compute, and where that is the whole target.
    pub fn draws(&self) -> &'static str {
        let Key::Graphics(key) = &self.key else { return "" };
        let some_large = key.constants.contains(&(SPEC_SOME_LARGE, 1));
        match (key.layout, key.topology) {
            (Layout::TileQuads, _) if key.depth.is_some() && !key.color_formats.is_empty() => {
                "tiles beside polygons"
            }
            (Layout::TileQuads, _) => "tiles",
            (Layout::Splat, vk::PrimitiveTopology::POINT_LIST) if some_large => "small points",
            (Layout::Splat, vk::PrimitiveTopology::POINT_LIST) => "points",
            (Layout::Splat, vk::PrimitiveTopology::TRIANGLE_STRIP) if some_large => "listed quads",
            (Layout::Splat, vk::PrimitiveTopology::TRIANGLE_STRIP) => "quads",
            (Layout::Splat, _) if some_large => "small triangles",
            (Layout::Splat, _) => "triangles",
            _ => "",
        }
    }

    /// What table 1 of Guennebaud et al. 2006 has for it: instructions of the vertex and the fragment program.
    pub fn published(&self) -> Option<[u32; 2]> {
        match self.pass.as_str() {
            "paper visibility" => Some([46, 3]),
            "paper accumulate" => Some([58, 3]),
            "botsch visibility" => Some([34, 9]),
            "botsch accumulate" => Some([35, 13]),
            _ => None,
        }
    }

    /// Makes the pipeline, where it was not made yet; none of programs that are only counted.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn make(&self, shaders: &Shaders) -> Result<Option<vk::Pipeline>> {
        match &self.key {
            Key::Graphics(key) => shaders.graphics(key.clone()).map(Some),
            Key::Compute(key) => shaders.compute(key.clone()).map(Some),
            Key::Counted(_) => Ok(None),
        }
    }
}
