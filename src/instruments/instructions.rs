//! The instructions of a frame's pipelines, counted without a device.

use std::collections::{HashMap, hash_map::Entry};

use crate::instruments::catalog::{Traits, frame_pipelines};
use crate::passes::pipeline::recipe::{PipelineRecipe, PipelineStages};
use crate::{
    count::{Counts, PassCounts, constant_numbers, count},
    error::{Error, Result},
    scene::Settings,
    shaders::Shader,
};

/// A shader's variant: its name, and those constants that it has.
type Variant = (&'static str, Vec<(u32, u32)>);

/// Counts pipelines, each shader's variant once.
#[derive(Default)]
pub struct Counter {
    counted: HashMap<Variant, Counts>,
}

impl Counter {
    /// The instructions of one pipeline.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`] where a shader of ours can't be counted, which is a fault of the rule.
    pub fn pipeline(&mut self, recipe: &PipelineRecipe) -> Result<PassCounts> {
        let mut counts =
            PassCounts { pass: recipe.pass.to_owned(), vertex: None, fragment: None, compute: None };
        match recipe.stages() {
            PipelineStages::Graphics(vertex, fragment) => {
                counts.vertex = Some(self.stage(vertex, recipe)?);
                counts.fragment = Some(self.stage(fragment, recipe)?);
            }
            PipelineStages::Compute(shader) => counts.compute = Some(self.stage(shader, recipe)?),
        }
        Ok(counts)
    }

    fn stage(&mut self, shader: &'static Shader, recipe: &PipelineRecipe) -> Result<Counts> {
        let fault = |problem: String| Error::option("counts", format!("{}: {problem}", shader.name));
        let own = constant_numbers(shader.spirv()).map_err(fault)?;
        let constants = recipe.constants().iter().copied().filter(|(number, _)| own.contains(number));
        match self.counted.entry((shader.name, constants.collect())) {
            Entry::Occupied(counted) => Ok(counted.get().clone()),
            Entry::Vacant(none) => {
                let counts = count(shader.spirv(), &none.key().1).map_err(fault)?;
                Ok(none.insert(counts).clone())
            }
        }
    }
}

/// The instructions of a frame of small disks, pass by pass; `closed`: on a closed surface, whose back is not drawn.
///
/// # Errors
/// As [`frame_pipelines`] and [`Counter::pipeline`].
pub fn counts_of(settings: &Settings, closed: bool) -> Result<Vec<PassCounts>> {
    let mut counter = Counter::default();
    frame_pipelines(settings, Traits { closed, ..Traits::default() })?
        .iter()
        .map(|recipe| counter.pipeline(recipe))
        .collect()
}
