//! The parts that a model becomes on the way to an object, and how long each step takes.

use std::time::Instant;

use crate::{
    geometry::Fitness,
    progress::Progress,
    report::{InputReport, Step},
    scene::{HybridLevels, MeshObject, Object},
};

/// Both parts, and what was done.
pub(super) struct Parts {
    pub splats: Option<Object>,
    pub triangles: Option<MeshObject>,
    /// Of the triangles.
    pub levels: Option<HybridLevels>,
    /// Of disks at the vertices of a mesh.
    pub fitness: Option<Fitness>,
    pub report: InputReport,
}

impl Parts {
    /// Splats alone.
    pub fn of_splats(splats: Object, report: InputReport) -> Self {
        Self { splats: Some(splats), triangles: None, levels: None, fitness: None, report }
    }
}

/// Long work, with its times.
pub(super) struct StepTimer<'a> {
    pub progress: &'a dyn Progress,
    pub steps: Vec<Step>,
}

impl StepTimer<'_> {
    /// Does a step and notes its time.
    pub(super) fn time<T>(&mut self, name: String, work: impl FnOnce(&dyn Progress) -> T) -> T {
        let start = Instant::now();
        let done = work(self.progress);
        self.steps.push(Step { name, secs: start.elapsed().as_secs_f64() });
        done
    }
}
