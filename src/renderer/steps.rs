//! A frame in steps, for drivers that compile a pipeline when it first runs, as those of CPUs do: a host goes on between.

use std::cell::Cell;

use ash::vk;

use super::{Imports, Renderer, SceneFrame};
use crate::{
    error::Result,
    frame::{Execution, FrameSlot},
    graph::{
        Graph,
        execute::{Body, Part, Runs},
    },
    passes::{MissingPipelines, Run, Shaders},
};

/// A step ends with the pass in which so many pipelines have run that never did before. Where a driver has each of them on disk, a step more costs some milliseconds.
const NEW_IN_STEP: usize = 3;

/// Counts pipelines that never ran before.
struct Counter<'a> {
    shaders: &'a Shaders,
    new: Cell<usize>,
    unknown: Cell<usize>,
}

impl Runs for Counter<'_> {
    fn runs(&self, pipeline: vk::Pipeline) {
        let run = self.shaders.ran().runs(pipeline);
        self.new.set(self.new.get() + usize::from(run != Run::Again));
        self.unknown.set(self.unknown.get() + usize::from(run == Run::First));
    }

    fn ends(&self) -> bool {
        self.new.get() >= NEW_IN_STEP
    }
}

/// What a step of a frame is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameStep {
    /// The pass with which the next step begins; `None` where the frame is whole.
    pub next: Option<usize>,
    /// How many pipelines ran in it that no step had before.
    pub new_pipelines: usize,
    /// Of these, how many had not run on another device either ([`Shaders::ran_elsewhere`]).
    pub unknown_pipelines: usize,
}

impl Renderer {
    /// Records a step of a frame: its passes from one on, as many as run few pipelines for the first time, and all where there are none of these. The frame is whole once each step
    /// has run.
    ///
    /// # Errors
    /// As [`Renderer::record`]; [`crate::ErrorKind::Graph`] where another frame was recorded in the slot since the step before.
    ///
    /// # Safety
    /// As [`Renderer::record`]; a step that does not begin with pass 0 begins where the one before ended, which was recorded last in this slot and has finished, of a frame that is the
    /// same in everything: scene, camera, settings, target, and what is read back. Until the last step the target is in no state to be used.
    #[cfg(feature = "inside")]
    pub unsafe fn record_step(
        &self,
        commands: vk::CommandBuffer,
        slot: &mut FrameSlot,
        frame: &SceneFrame<'_>,
        first: usize,
    ) -> Result<FrameStep> {
        let SceneFrame { seen, target, readbacks, profile } = *frame;
        let arena = slot.take_arena();
        let counter = Counter { shaders: &self.shaders, new: Cell::new(0), unknown: Cell::new(0) };
        let record = |execution: Execution<'_>, graph: &Graph<'_, Body<'_>>, imports: &Imports<'_>| {
            let part = Part { first, runs: Some(&counter) };
            // SAFETY: this function's contract.
            unsafe {
                self.shaders.begin_frame(commands)?;
                execution.record_part(commands, graph, imports, part)
            }
        };
        let how = (profile, MissingPipelines::Make);
        // SAFETY: this function's contract.
        let recorded = unsafe { self.declare_in(&arena, slot, seen, (target, readbacks), how, record) };
        slot.give_back(arena);
        Ok(FrameStep {
            next: recorded?,
            new_pipelines: counter.new.get(),
            unknown_pipelines: counter.unknown.get(),
        })
    }
}
