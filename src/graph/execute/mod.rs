//! Records a plan into a command buffer that is given: the only part of the graph that knows a device. It never
//! submits and never waits.

mod blocks;
mod context;
mod kept;
mod one_shape;
mod part;
mod profiler;
mod recorder;
mod rooms;
mod transients;

use ash::vk;

pub(crate) use self::blocks::{Blocks, FRAMES_OF_LATE, requirements};
use self::{context::Binding, recorder::Recorder};
pub use self::{
    context::{Body, PassContext},
    kept::Kept,
    part::{Part, Runs},
    profiler::{FrameProfile, PassCounts, PassFigures, PassProfile, Profile, Profiler},
    transients::{Transients, memory_need},
};
use super::{Graph, PassKind, Plan, ResourceDesc, ResourceId};
use crate::{
    error::{ErrorKind, Result},
    vk::Device,
};

/// The Vulkan object behind a resource.
#[derive(Clone, Copy, Debug)]
pub enum Physical {
    /// An image and the view of all of it.
    Image(vk::Image, vk::ImageView),
    /// One layer of an image that has others, by its number, and the view of that one.
    Layer(vk::Image, vk::ImageView, u32),
    /// A buffer.
    Buffer(vk::Buffer),
    /// A buffer, and the view of all of its texels.
    TexelBuffer(vk::Buffer, vk::BufferView),
}

/// Records the passes of a plan that a part has, which is that of the graph or of one of the same shape: barriers, debug label, queries, rendering, body. The pass that comes
/// next, where the part ends before the plan does.
///
/// # Errors
/// [`ErrorKind::Graph`] if an import is missing or of the wrong kind, before anything is recorded; whatever a body
/// answers: then the command buffer is well-formed, but must not be submitted, for later passes are missing.
///
/// # Safety
/// `commands` must be recording, outside of rendering, and be submitted to the queue of the device's family, after
/// earlier executions with the same `transients`, which are those of this plan or of one that differs in sizes of buffers alone.
/// `imports` must be alive until it has run, of the declared description, and in their declared initial states.
/// `profiler`'s earlier frame must have finished. Where the part has not the first pass, the one before it was recorded last with these transients and this profiler, of a graph
/// that differs in nothing.
pub unsafe fn execute(
    device: &Device,
    commands: vk::CommandBuffer,
    (plan, graph): (&Plan, &Graph<'_, Body<'_>>),
    transients: &Transients,
    imports: &[(ResourceId, Physical)],
    mut profiler: Option<&mut Profiler>,
    part: Part<'_>,
) -> Result<Option<usize>> {
    let arena = graph.arena();
    let mut physical = arena.growing();
    physical.extend(transients.physical());
    physical.resize(plan.resources.len(), None);
    for (id, object) in imports {
        if let Some(place) = physical.get_mut(id.index()) {
            *place = Some(*object);
        }
    }
    // Before the first command: what fails later would leave labels and queries open.
    check_objects(plan, &physical)?;
    let recorder = Recorder { device, commands, plan, physical: &physical, arena, runs: part.runs };
    if let (0, Some(profiler)) = (part.first, &mut profiler) {
        // SAFETY: this function's contract.
        unsafe { profiler.begin_frame(commands, &plan.passes) };
    }
    let profiler = profiler.as_deref();
    let mut bindings = arena.growing();
    bindings.resize(plan.resources.len(), Binding::default());
    for (index, pass) in (0..).zip(&plan.passes).skip(part.first) {
        let draws = pass.rendering.is_some();
        // Copies have nothing to count.
        let counting = profiler.filter(|_| draws || pass.kind == PassKind::Compute);
        device.begin_label(commands, &pass.name);
        // SAFETY: this function's contract, here and below.
        unsafe {
            recorder.barriers(pass.barriers.memory, &pass.barriers.resources)?;
            recorder.begin_rendering(pass)?;
            counting.inspect(|profiler| profiler.begin_counts(commands, index));
        }
        Binding::declare(&mut bindings, index, pass);
        let done = (graph.bodies[pass.declared])(&PassContext {
            recorder: &recorder,
            bindings: &bindings,
            index,
            pass,
        });
        // Also after a body that failed, so that the command buffer stays well-formed.
        // SAFETY: as above.
        unsafe {
            counting.inspect(|profiler| profiler.end_counts(commands, index));
            if draws {
                device.raw().cmd_end_rendering(commands);
            }
            profiler.inspect(|profiler| profiler.end_pass(commands, index));
        }
        device.end_label(commands);
        done?;
        let next = index as usize + 1;
        if next < plan.passes.len() && part.ends() {
            return Ok(Some(next));
        }
    }
    // SAFETY: this function's contract.
    unsafe { recorder.barriers(None, &plan.final_barriers) }?;
    Ok(None)
}

/// Refuses a plan of which a resource in use has no object, or one of another kind.
fn check_objects(plan: &Plan, physical: &[Option<Physical>]) -> Result<()> {
    for (resource, object) in plan.resources.iter().zip(physical) {
        let reason = match (object, resource.desc) {
            (Some(Physical::Image(..) | Physical::Layer(..)), ResourceDesc::Image(_))
            | (Some(Physical::Buffer(_) | Physical::TexelBuffer(..)), ResourceDesc::Buffer(_)) => continue,
            (None, _) if resource.lifetime.is_none() => continue,
            (None, _) => "has no Vulkan object: an import was not given",
            (Some(_), ResourceDesc::Buffer(_)) => "is a buffer, and an image was given",
            (Some(_), ResourceDesc::Image(_)) => "is an image, and a buffer was given",
        };
        let (pass, resource) = (String::new(), resource.name.clone());
        return Err(ErrorKind::Graph { pass, resource, reason: reason.to_owned() }.into());
    }
    Ok(())
}
