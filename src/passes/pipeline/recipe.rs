//! A pipeline of a pass, without a scene: what it is made of, and how it is made.

use ash::vk;

use crate::passes::pipeline::{
    cache::{ComputeKey, GraphicsKey, Shaders},
    splat_shaders::Stages,
};
use crate::{
    error::Result,
    shaders::{Shader, config::*},
};

/// A pipeline of a pass.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct PipelineRecipe {
    /// The pass.
    pub pass: &'static str,
    /// What it draws: `points`, `small points`, `listed quads` and so on; empty where that is the whole target.
    pub draws: &'static str,
    pub(crate) key: Key,
}

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Key {
    Graphics(GraphicsKey),
    Compute(ComputeKey),
    /// Never drawn, only counted.
    Counted(Stages),
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

    /// Whether it sets splats up or draws them, and so depends on rasterizer and filter.
    pub fn sets_splats_up(&self) -> bool {
        self.constants().iter().any(|(number, _)| *number == SPEC_RASTERIZER)
    }

    /// What table 1 of Guennebaud et al. 2006 has for it: instructions of the vertex and the fragment program.
    pub fn published(&self) -> Option<[u32; 2]> {
        match (self.pass, self.draws) {
            ("paper visibility", _) => Some([46, 3]),
            ("paper accumulate", _) => Some([58, 3]),
            ("botsch visibility", _) => Some([34, 9]),
            ("botsch accumulate", _) => Some([35, 13]),
            _ => None,
        }
    }

    /// Makes the pipeline, where it was not made yet; none of programs that are only counted.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn make(&self, shaders: &Shaders) -> Result<Option<vk::Pipeline>> {
        Ok(match &self.key {
            Key::Graphics(key) => Some(shaders.graphics(key.clone())?.raw()),
            Key::Compute(key) => Some(shaders.compute(key.clone())?.raw()),
            Key::Counted(_) => None,
        })
    }
}

pub(crate) fn graphics(pass: &'static str, draws: &'static str, key: GraphicsKey) -> PipelineRecipe {
    PipelineRecipe { pass, draws, key: Key::Graphics(key) }
}

pub(crate) fn compute(pass: &'static str, key: ComputeKey) -> PipelineRecipe {
    PipelineRecipe { pass, draws: "", key: Key::Compute(key) }
}
