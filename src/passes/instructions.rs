//! The instructions of a frame's pipelines, counted without a device.

use super::catalog::{PipelineRecipe, PipelineStages, Traits, frame_pipelines};
use crate::{
    count::{Counts, PassCounts, count},
    error::{Error, Result},
    scene::Settings,
    shaders::Shader,
};

/// The instructions of one pipeline.
///
/// # Errors
/// [`crate::error::ErrorKind::Option`] where a shader of ours can't be counted, which is a fault of the rule.
pub fn counts_of_pipeline(recipe: &PipelineRecipe) -> Result<PassCounts> {
    let of = |shader: &Shader| -> Result<Counts> {
        count(shader.spirv, recipe.constants())
            .map_err(|problem| Error::option("counts", format!("{}: {problem}", shader.name)))
    };
    let mut counts = PassCounts { pass: recipe.pass.to_owned(), vertex: None, fragment: None, compute: None };
    match recipe.stages() {
        PipelineStages::Graphics(vertex, fragment) => {
            counts.vertex = Some(of(vertex)?);
            counts.fragment = Some(of(fragment)?);
        }
        PipelineStages::Compute(shader) => counts.compute = Some(of(shader)?),
    }
    Ok(counts)
}

/// The instructions of a frame of small disks on a closed surface, pass by pass.
///
/// # Errors
/// As [`frame_pipelines`] and [`counts_of_pipeline`].
pub fn counts_of(settings: &Settings) -> Result<Vec<PassCounts>> {
    frame_pipelines(settings, Traits::default())?.iter().map(counts_of_pipeline).collect()
}
