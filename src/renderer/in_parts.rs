//! Frames of splats of which each of several devices has a part (`passes/in_parts/`): recorded stage by stage, with buffers between them that hosts
//! reduce over all devices.

mod declare;
mod stage;

use std::sync::Arc;

use ash::vk;

use super::{Renderer, Seen};
use crate::{
    arena::Arena,
    error::{Error, Result},
    frame::{FrameSlot, SlotParts},
    graph::Plan,
    passes::{self, Inputs, Place},
    prepare::Placed,
    scene::{Accumulate, Budget, Camera, Edges, Rasterizer, Settings},
};
use declare::declare;
pub use stage::{Around, PartLayer, Stage};

impl Renderer {
    /// Records one stage of a frame of which the scene is a part. The camera and the settings are the same for all parts, edges are hard, and transparent layers
    /// are drawn by the graphics pipeline. Returns the plan that was recorded.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for what is not done in parts: an orthographic camera, whose depth begins where the scene does, several samples, and a
    /// budget of splats, which would have to be shared; [`crate::ErrorKind::Input`] for polygons. As [`Renderer::record`].
    ///
    /// # Safety
    /// As [`Renderer::record`]; the buffers are as [`Stage`] says, and the host neither reads nor writes them meanwhile.
    #[cfg(feature = "inside")]
    pub unsafe fn record_stage(
        &self,
        commands: vk::CommandBuffer,
        slot: &mut FrameSlot,
        seen: Seen<'_>,
        stage: Stage<'_>,
    ) -> Result<Arc<Plan>> {
        let arena = slot.take_arena();
        // SAFETY: this function's contract.
        let recorded = unsafe { self.record_stage_in(&arena, commands, slot, seen, stage) };
        slot.give_back(arena);
        recorded
    }

    /// The same, in a frame's memory.
    ///
    /// # Safety
    /// As [`Self::record_stage`].
    unsafe fn record_stage_in(
        &self,
        arena: &Arena,
        commands: vk::CommandBuffer,
        slot: &mut FrameSlot,
        Seen { scene, camera, settings }: Seen<'_>,
        stage: Stage<'_>,
    ) -> Result<Arc<Plan>> {
        check(camera, settings)?;
        let rasterizer = match (stage.is_of_layers(), settings.rasterizer) {
            (true, Rasterizer::Compute) => Rasterizer::Perspective,
            (_, asked) => asked,
        };
        let settings =
            &Settings { edges: Edges::Hard, accumulate: Accumulate::F32, rasterizer, ..settings.clone() };
        let frame = self.frame_plan(arena, &[Placed::at_home(scene)], camera, settings)?;
        if !frame.transparent.meshes.is_empty() || !frame.opaque.meshes.is_empty() {
            return Err(Error::input("the scene", "", "polygons; expected splats of a frame in parts"));
        }
        // SAFETY: this function's contract.
        unsafe { slot.begin(passes::needs(&frame, settings, false), None) }?;
        // SAFETY: this function's contract.
        let planes = unsafe { slot.planes(&frame.planes) }?;
        let SlotParts { descriptors, execution, .. } = slot.parts()?;
        let inputs = Inputs::new(camera, settings, Place::Device(&self.shaders, descriptors));
        let inputs = Inputs { source: inputs.source.cut_by(planes), ..inputs };
        let (graph, imports) = declare(arena, inputs, &frame, stage)?;
        // SAFETY: this function's contract.
        unsafe {
            self.shaders.begin_frame(commands)?;
            execution.record(commands, &graph, &imports)
        }
    }
}

fn check(camera: &Camera, settings: &Settings) -> Result<()> {
    let refused = |option: &str, problem: &str| Err(Error::option(option, problem));
    if camera.is_orthographic() {
        return refused("--orthographic", "not in parts, whose depth would begin at different places");
    }
    if settings.samples.0 > 1 {
        return refused("--samples", "expected 1 of a picture in parts");
    }
    if settings.budget != Budget::Unlimited {
        return refused(
            "--budget",
            "not in parts, none of which knows how much the others draw; expected --lod",
        );
    }
    Ok(())
}
