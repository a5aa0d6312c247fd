//! Frames of opaque splats of which each of several devices has a part (`passes/in_parts/`): recorded stage by stage, with buffers between them
//! that hosts reduce over all devices.

use std::sync::Arc;

use ash::vk;

use super::{
    Readbacks, Renderer, Seen,
    declare::{Imports, bytes_per_pixel, copy_out, copy_surface},
};
use crate::{
    arena::Arena,
    error::{Error, Result},
    frame::{FrameSlot, SlotParts, Target},
    graph::{
        Buffer, BufferDesc, BufferState, Graph, Handle, ImageDesc, Plan,
        execute::{Body, Physical},
    },
    passes::{
        self, FramePlan, Inputs, Place,
        in_parts::{self, OfAll, PART_DEPTH_FORMAT, PART_SUM_FORMAT},
    },
    prepare::Placed,
    scene::{Accumulate, Budget, Camera, Edges, Settings},
};

/// A stage of a frame in parts. Buffers have a value for each pixel, rows without padding, top row first; usage `TRANSFER_DST` where a stage
/// leaves something in them, `TRANSFER_SRC` where it reads them.
#[derive(Clone, Copy)]
pub enum Stage<'t> {
    /// What is seen of a part.
    See {
        /// Is left here: an f32 a pixel, near / z of the nearest surface, moved away from the eye by ε; 0 where there is none. That of all
        /// parts is the largest.
        depth: vk::Buffer,
    },
    /// What is summed of a part.
    Sum {
        /// That of all parts.
        depth: vk::Buffer,
        /// Are left here, four f32 a pixel each: Σ weight · linear albedo, Σ weight; Σ weight · normal in view space, and with `with_depth`
        /// Σ weight · z / z_visible. Those of all parts are their sums.
        sums: [vk::Buffer; 2],
        /// Depth is summed, too: for the surface as data, and for eye-dome lighting.
        with_depth: bool,
    },
    /// The picture of all parts.
    Shade {
        /// Their depth.
        depth: vk::Buffer,
        /// Their sums.
        sums: [vk::Buffer; 2],
        /// As for [`Renderer::record`].
        target: &'t Target,
        /// As for [`Renderer::record`], without samples.
        readbacks: Readbacks,
    },
}

impl Renderer {
    /// Records one stage of a frame of which the scene is a part. The camera and the settings are the same for all parts, and edges are hard. Returns the
    /// plan that was recorded.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for what is not done in parts: an orthographic camera, whose depth begins where the scene does, several samples, and a
    /// budget of splats, which would have to be shared; [`crate::ErrorKind::Input`] for polygons and what is transparent. As [`Renderer::record`].
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
        let settings = &Settings { edges: Edges::Hard, accumulate: Accumulate::F32, ..settings.clone() };
        let frame = self.frame_plan(arena, &[Placed::at_home(scene)], camera, settings)?;
        if !frame.transparent.is_empty() || !frame.opaque.meshes.is_empty() {
            let problem = "polygons, or something transparent; expected opaque splats of a frame in parts";
            return Err(Error::input("the scene", "", problem));
        }
        // SAFETY: this function's contract.
        unsafe { slot.begin(passes::needs(&frame, settings, false), None) }?;
        let SlotParts { descriptors, execution, .. } = slot.parts()?;
        let inputs = Inputs::new(camera, settings, Place::Device(&self.shaders, descriptors));
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

/// The graph of a stage.
fn declare<'a>(
    arena: &'a Arena,
    inputs: Inputs<'a>,
    plan: &'a FramePlan<'a>,
    stage: Stage<'_>,
) -> Result<(Graph<'a, Body<'a>>, Imports<'a>)> {
    let (mut graph, mut imports) = (Graph::new(arena), arena.growing());
    match stage {
        Stage::See { depth } => {
            let seen = in_parts::see(&mut graph, inputs, plan)?;
            copy_out(&mut graph, &mut imports, inputs, ("depth", &seen, PART_DEPTH_FORMAT), depth);
        }
        Stage::Sum { depth, sums, with_depth } => {
            let depth =
                import(&mut graph, &mut imports, inputs, ("depth of all parts", PART_DEPTH_FORMAT, depth));
            let summed = in_parts::sum(&mut graph, inputs, plan, &depth, with_depth)?;
            for ((what, image), buffer) in ["colors", "normals"].into_iter().zip(&summed).zip(sums) {
                copy_out(&mut graph, &mut imports, inputs, (what, image, PART_SUM_FORMAT), buffer);
            }
        }
        Stage::Shade { depth, sums: [color, normal], target, readbacks } => {
            let mut of =
                |what, format, buffer| import(&mut graph, &mut imports, inputs, (what, format, buffer));
            let depth = of("depth of all parts", PART_DEPTH_FORMAT, depth);
            let color = of("colors of all parts", PART_SUM_FORMAT, color);
            let normal = of("normals of all parts", PART_SUM_FORMAT, normal);
            let of_all = OfAll { depth: &depth, sums: [&color, &normal] };
            let desc = ImageDesc { format: target.format, extent: target.extent };
            let mut image = graph.import_image("target", desc, target.initial, target.last);
            imports.push((image.id(), Physical::Image(target.image, target.view)));
            let into = (&mut image, target.format);
            let exported =
                in_parts::shade(&mut graph, inputs, plan, of_all, into, readbacks.surface.is_some())?;
            if let Some(buffer) = readbacks.target {
                copy_out(&mut graph, &mut imports, inputs, ("target", &image, target.format), buffer);
            }
            copy_surface(&mut graph, &mut imports, inputs, exported.as_ref(), readbacks.surface);
        }
    }
    Ok((graph, imports))
}

/// A buffer that the host has filled.
fn import(
    graph: &mut Graph<'_, Body<'_>>,
    imports: &mut Imports<'_>,
    inputs: Inputs<'_>,
    (what, format, buffer): (&str, vk::Format, vk::Buffer),
) -> Handle<Buffer> {
    let [width, height] = inputs.settings.size_px.map(u64::from);
    let desc = BufferDesc::of_bytes(width * height * bytes_per_pixel(format));
    let handle = graph.import_buffer(what, desc, BufferState::default(), None);
    imports.push((handle.id(), Physical::Buffer(buffer)));
    handle
}
