//! The model of a table at a number of splats.

use surfel::{
    Error, Result,
    compose::finish,
    geometry::check_memory_for,
    load::{LoadOptions, Model, PictureDescription, builtin, load},
    report::InputReport,
    scene::{Ball, Budget, Mesh, Object, Scene},
};

use super::context::BenchContext;
use crate::scene::{Loaded, not_a_mesh, resample_mesh};

/// The source of a table's model.
pub enum Source {
    /// The built-in model, which has as many splats as wanted.
    BuiltIn,
    /// A mesh and the name of its file.
    Mesh(Mesh, std::path::PathBuf),
}

impl Source {
    /// Reads the model that the command line names.
    ///
    /// # Errors
    /// As [`load`]; a file of splats, which can't be resampled.
    pub fn open(context: &BenchContext<'_>) -> Result<Self> {
        let Some(path) = &context.arguments.model else { return Ok(Self::BuiltIn) };
        match load(path, &LoadOptions::default(), &context.bars)?.model {
            Model::Mesh(mesh) => Ok(Self::Mesh(mesh, path.clone())),
            other => Err(not_a_mesh(path, &other, "to take samples of its triangles")),
        }
    }

    /// The model with so many splats, spread evenly over its area.
    ///
    /// # Errors
    /// A mesh without area; more splats than there is memory for.
    pub fn scene(&self, splats: u64, context: &BenchContext<'_>) -> Result<Loaded> {
        let (object, report): (Object, InputReport) = match self {
            Self::BuiltIn => {
                let count = usize::try_from(splats).unwrap_or(usize::MAX);
                check_memory_for(count, builtin::BYTES_PER_SPLAT)
                    .map_err(|problem| Error::option("--splats", problem))?;
                finish(builtin::relief(count), String::new(), None)
            }
            Self::Mesh(mesh, path) => resample_mesh(mesh, path, splats, 0, &context.bars)?,
        };
        let scene = Scene {
            objects: vec![object],
            levels: context.settings.wants_levels(),
            budget: context.settings.budget != Budget::Unlimited,
            ..Scene::default()
        };
        let ball = scene.ball().unwrap_or(Ball { center: glam::DVec3::ZERO, radius: 1.0 });
        Ok(Loaded {
            scene,
            ball,
            camera: None,
            picture: PictureDescription::default(),
            up: None,
            inputs: vec![report],
            steps: Vec::new(),
            hierarchies: Vec::new(),
            octrees: Default::default(),
        })
    }
}
