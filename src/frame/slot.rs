//! What a frame needs until the device has finished it. One slot for each frame in flight.

use std::sync::Arc;

use ash::vk;

use crate::{
    arena::Arena,
    error::{ErrorKind, Result},
    graph::{
        Graph, Plan, ResourceId,
        execute::{Body, Kept, Part, Physical, Profile, Profiler},
    },
    passes::{Needs, PLANES_BYTES, Planes, ShaderPlane},
    vk::{Buffer, BufferDesc, DescriptorPool, Device, MemoryUse, Occlusion},
};

/// Descriptor sets, queries, plan and transients of one frame at a time.
pub struct FrameSlot {
    device: Device,
    written: Written,
    profiler: Option<(Profiler, Profile)>,
    occlusion: Option<Occlusion>,
    /// The frame counts with them.
    counts_layers: bool,
    kept: Kept,
    arena: Arena,
}

/// What the host writes for a frame, and the device reads while the frame runs: no barrier keeps the next frame's apart.
#[derive(Default)]
pub(crate) struct Written {
    descriptors: Option<DescriptorPool>,
    /// What cuts the frame, where something does: so that it takes no pass.
    planes: Option<Buffer>,
}

/// The parts of a slot, each to be borrowed by itself: bodies of passes borrow the first two.
pub(crate) struct SlotParts<'a> {
    pub descriptors: &'a DescriptorPool,
    pub occlusion: Option<&'a Occlusion>,
    pub execution: Execution<'a>,
}

/// Records the slot's frame.
pub(crate) struct Execution<'a> {
    device: &'a Device,
    kept: &'a mut Kept,
    profiler: Option<&'a mut Profiler>,
}

impl FrameSlot {
    /// An empty slot.
    pub fn new(device: &Device) -> Self {
        let device = device.clone();
        Self {
            device,
            written: Written::default(),
            profiler: None,
            occlusion: None,
            counts_layers: false,
            kept: Kept::default(),
            arena: Arena::new(),
        }
    }

    /// Memory for a frame in the making, to be given back by [`Self::give_back`].
    pub(crate) fn take_arena(&mut self) -> Arena {
        std::mem::take(&mut self.arena)
    }

    /// Keeps a frame's memory for the next frame.
    pub(crate) fn give_back(&mut self, mut arena: Arena) {
        arena.reset();
        self.arena = arena;
    }

    /// Takes what the host has written for another frame, and gives what it has written for the one that was recorded last.
    pub(crate) fn exchange(&mut self, written: &mut Written) {
        std::mem::swap(&mut self.written, written);
    }

    /// The profiler of the frame recorded last, if it was measured.
    pub fn profiler(&self) -> Option<&Profiler> {
        self.profiler.as_ref().map(|(profiler, _)| profiler)
    }

    /// Bytes of device memory that the transients of the frame recorded last take.
    pub fn frame_bytes(&self) -> u64 {
        self.kept.last_bytes()
    }

    /// Bytes of device memory in transients, of this frame and of those before.
    pub fn transient_bytes(&self) -> u64 {
        self.kept.bytes()
    }

    /// Gives back transients where frames of before have needed far more than the one recorded last: for hosts that draw nothing for a while. The next frame makes its own anew then.
    pub fn give_back_excess(&mut self) {
        self.kept.give_back_excess();
    }

    /// Makes the slot ready for a frame that takes so much from it.
    ///
    /// # Safety
    /// The frame for which the host has written last what it writes now has finished, and all frames recorded in this slot go to one queue, in their order.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub(crate) unsafe fn begin(&mut self, needs: Needs, profile: Option<Profile>) -> Result<()> {
        let Needs { room: wanted, occlusion_queries: queries } = needs;
        if self.occlusion.as_ref().map_or(0, |pool| pool.count()) < queries {
            self.occlusion = Some(Occlusion::new(&self.device, "layers", queries)?);
        }
        self.counts_layers = queries > 0;
        match &mut self.written.descriptors {
            Some(pool) => {
                // SAFETY: this function's contract.
                unsafe { pool.reset() };
                pool.make_room_for(&wanted);
            }
            none => *none = Some(DescriptorPool::new(&self.device, "frame sets", wanted)?),
        }
        if self.profiler.as_ref().map(|(_, kept)| *kept) != profile {
            let profiler = |profile| Profiler::new(&self.device, profile).map(|made| (made, profile));
            self.profiler = profile.map(profiler).transpose()?;
        }
        Ok(())
    }

    /// Puts the planes that cut the frame where shaders find them.
    ///
    /// # Safety
    /// As [`Self::begin`].
    ///
    /// # Errors
    /// Whatever the allocator answers.
    pub(crate) unsafe fn planes(&mut self, planes: &[ShaderPlane]) -> Result<Planes> {
        if planes.is_empty() {
            return Ok(Planes::default());
        }
        let buffer = match &mut self.written.planes {
            Some(buffer) => buffer,
            none => none.insert(Buffer::new(&self.device, planes_desc(), MemoryUse::Upload)?),
        };
        let bytes: &[u8] = bytemuck::cast_slice(planes);
        // SAFETY: this function's contract: the frame before has finished.
        let room = unsafe { buffer.bytes_mut() };
        room[..bytes.len()].copy_from_slice(bytes);
        Ok(Planes { count: planes.len() as u32, buffer: buffer.raw() })
    }

    /// Its parts.
    ///
    /// # Errors
    /// [`ErrorKind::Graph`] before [`FrameSlot::begin`].
    pub(crate) fn parts(&mut self) -> Result<SlotParts<'_>> {
        let Some(descriptors) = &self.written.descriptors else {
            let reason = "the frame slot was not begun".to_owned();
            return Err(ErrorKind::Graph { pass: String::new(), resource: String::new(), reason }.into());
        };
        let profiler = self.profiler.as_mut().map(|(profiler, _)| profiler);
        let execution = Execution { device: &self.device, kept: &mut self.kept, profiler };
        let occlusion = self.occlusion.as_ref().filter(|_| self.counts_layers);
        Ok(SlotParts { descriptors, occlusion, execution })
    }
}

/// The buffer of planes.
pub(crate) fn planes_desc() -> BufferDesc<'static> {
    BufferDesc { name: "planes", size: PLANES_BYTES, usage: vk::BufferUsageFlags::UNIFORM_BUFFER }
}

impl Execution<'_> {
    /// Compiles a graph, where none like it is kept, and records it. The plan that was recorded.
    ///
    /// # Safety
    /// As [`Kept::execute`].
    ///
    /// # Errors
    /// As [`Kept::execute`].
    pub unsafe fn record(
        self,
        commands: vk::CommandBuffer,
        graph: &Graph<'_, Body<'_>>,
        imports: &[(ResourceId, Physical)],
    ) -> Result<Arc<Plan>> {
        // SAFETY: this function's contract.
        unsafe { self.kept.execute(self.device, commands, graph, imports, self.profiler) }
    }

    /// Records a part of a graph; the pass that comes next, if one is left.
    ///
    /// # Safety
    /// As [`Kept::execute_part`].
    ///
    /// # Errors
    /// As [`Kept::execute_part`].
    pub unsafe fn record_part(
        self,
        commands: vk::CommandBuffer,
        graph: &Graph<'_, Body<'_>>,
        imports: &[(ResourceId, Physical)],
        part: Part<'_>,
    ) -> Result<Option<usize>> {
        // SAFETY: this function's contract.
        unsafe { self.kept.execute_part(self.device, commands, graph, imports, self.profiler, part) }
    }
}
