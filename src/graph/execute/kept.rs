//! What executions leave for those that follow: their plans, and their transients. A frame that declares what one before did takes both; one in
//! which only sizes of buffers differ, too, as long as these have room. All share one memory, which grows to what the largest has needed.

use std::{collections::HashSet, sync::Arc};

use ash::vk;

use super::{
    super::{BufferDesc, Graph, MemoryClass, Plan, ResourceDesc, ResourceId},
    Body, Part, Physical, Profiler,
    blocks::{Blocks, FRAMES_OF_LATE, requirements},
    execute,
    rooms::{Room, renew, serve},
    transients::{Transients, memory_need, transient_name},
};
use crate::{
    error::{ErrorKind, Result},
    vk::{Device, MemoryNeeds, MemoryUse, texel_bytes, wait_for_all},
};

/// The plans and the transients of executions, for those that follow.
#[derive(Default)]
pub struct Kept {
    /// The one that was executed last is the first.
    ready: Vec<Ready>,
    blocks: Blocks,
    executions: u64,
    /// The execution before was of another plan, in the same memory.
    is_another: bool,
}

/// What a frame of one shape is executed with.
struct Ready {
    plan: Arc<Plan>,
    transients: Transients,
    /// One a resource.
    rooms: Vec<Room>,
    /// Which execution was its last.
    executed: u64,
}

/// More than so many times what is needed is excess.
const EXCESS: u64 = 2;

/// Plans that are kept at most.
const MOST_PLANS: usize = 64;

impl Kept {
    /// Compiles a graph, where none like it is kept, and records it as [`execute`] does, on transients that are made where those that are kept
    /// don't serve. The plan that was recorded.
    ///
    /// # Errors
    /// As [`Graph::compile`] and [`execute`], and whatever the allocator or the driver answers.
    ///
    /// # Safety
    /// As [`execute`]; the execution before has finished, for another plan's transients lie in the same memory.
    pub unsafe fn execute(
        &mut self,
        device: &Device,
        commands: vk::CommandBuffer,
        graph: &Graph<'_, Body<'_>>,
        imports: &[(ResourceId, Physical)],
        profiler: Option<&mut Profiler>,
    ) -> Result<Arc<Plan>> {
        // SAFETY: this function's contract.
        unsafe { self.execute_part(device, commands, graph, imports, profiler, Part::default()) }?;
        Ok(Arc::clone(&self.ready[0].plan))
    }

    /// Records a part of a graph's passes as [`execute`] does; the pass that comes next, if one is left.
    ///
    /// # Errors
    /// As [`Self::execute`]; [`ErrorKind::Graph`] for a part that goes on with another graph.
    ///
    /// # Safety
    /// As [`Self::execute`]; of a part that goes on, as [`execute`], and the part before has finished.
    pub unsafe fn execute_part(
        &mut self,
        device: &Device,
        commands: vk::CommandBuffer,
        graph: &Graph<'_, Body<'_>>,
        imports: &[(ResourceId, Physical)],
        profiler: Option<&mut Profiler>,
        part: Part<'_>,
    ) -> Result<Option<usize>> {
        if part.first == 0 {
            self.ready(device, graph)?;
        } else if !self.ready.first().is_some_and(|ready| ready.goes_on(graph)) {
            let reason = "is not the one of which a part was recorded last".to_owned();
            let (pass, resource) = (String::new(), "the graph".to_owned());
            return Err(ErrorKind::Graph { pass, resource, reason }.into());
        }
        let ready = &self.ready[0];
        if self.is_another {
            // What another plan had in this memory no barrier of this one knows.
            // SAFETY: this function's contract.
            unsafe { wait_for_all(device, commands) };
        }
        // SAFETY: this function's contract.
        unsafe { execute(device, commands, (&ready.plan, graph), &ready.transients, imports, profiler, part) }
    }

    /// Adds what memory the first execution of a graph will ask for to what is needed.
    ///
    /// # Errors
    /// As [`Graph::compile`].
    pub(crate) fn tell(device: &Device, graph: &Graph<'_, Body<'_>>, needs: &mut MemoryNeeds) -> Result<()> {
        let Ready { plan, .. } = Self::default().make(device, graph)?;
        for block in &plan.blocks {
            let of = (MemoryUse::Device, block.class == MemoryClass::Buffers);
            needs.piece(transient_name(block.class), requirements(block), of);
        }
        Ok(())
    }

    /// Gives back all, where it is far more than the last execution has needed.
    pub fn give_back_excess(&mut self) {
        if self.bytes() > EXCESS * self.last_bytes() {
            *self = Self::default();
        }
    }

    /// Bytes of device memory that the transients of the last execution take.
    pub fn last_bytes(&self) -> u64 {
        self.ready.first().map_or(0, |ready| ready.plan.blocks.iter().map(|block| block.size_bytes).sum())
    }

    /// Bytes of device memory in transients, of all executions.
    pub fn bytes(&self) -> u64 {
        self.blocks.bytes()
    }

    /// Puts what serves a graph first.
    fn ready(&mut self, device: &Device, graph: &Graph<'_, Body<'_>>) -> Result<()> {
        self.executions += 1;
        if self.executions.is_multiple_of(FRAMES_OF_LATE) {
            self.give_back();
        }
        let sizes = graph.declared.resources.iter().map(|resource| sizes_of(&resource.desc, device));
        let serves = |ready: &Ready| ready.plan.has_shape_of(graph) && serve(&ready.rooms, sizes.clone());
        let place = self.ready.iter().position(serves);
        self.is_another = place != Some(0) && !self.ready.is_empty();
        match place {
            Some(place) => self.ready[..=place].rotate_right(1),
            None => {
                let made = self.make(device, graph);
                // What is refused finds all memory idle next time.
                let made = made.inspect_err(|_| *self = Self::default())?;
                self.ready.insert(0, made);
            }
        }
        self.settle(device).inspect_err(|_| *self = Self::default())?;
        let ready = &mut self.ready[0];
        ready.executed = self.executions;
        if !ready.plan.has_sizes_of(graph) {
            Arc::make_mut(&mut ready.plan).resize(graph);
        }
        self.blocks.note(&ready.plan.blocks, ready.transients.memory());
        Ok(())
    }

    /// What a graph is executed with for which nothing that is kept serves.
    fn make(&mut self, device: &Device, graph: &Graph<'_, Body<'_>>) -> Result<Ready> {
        let resources = &graph.declared.resources;
        let sizes = resources.iter().map(|resource| sizes_of(&resource.desc, device));
        let rooms = match self.ready.iter().position(|ready| ready.plan.has_shape_of(graph)) {
            Some(place) => {
                let (rooms, replaces) = renew(&self.ready[place].rooms, sizes);
                if replaces {
                    self.ready.remove(place);
                }
                rooms
            }
            None => {
                let varying = self.ready.first().map(Ready::varying).unwrap_or_default();
                let room = |(name, (size, most))| Room::new(size, varying.contains(name), most);
                resources.iter().map(|resource| resource.name).zip(sizes).map(room).collect()
            }
        };
        let need = |id: ResourceId, desc: &ResourceDesc, usage| {
            let desc = match *desc {
                ResourceDesc::Buffer(desc) => {
                    ResourceDesc::Buffer(BufferDesc { size_bytes: rooms[id.index()].room_bytes, ..desc })
                }
                image => image,
            };
            memory_need(device, &desc, usage)
        };
        let plan = graph.compile(need)?;
        self.ready.truncate(MOST_PLANS - 1);
        Ok(Ready {
            plan: Arc::new(plan),
            transients: Transients::homeless(),
            rooms,
            executed: self.executions,
        })
    }

    /// Puts the transients of the first plan in place. Others whose memory had to grow for that, or goes, leave it, and are placed when they are wanted next.
    fn settle(&mut self, device: &Device) -> Result<()> {
        let Self { ready, blocks, .. } = self;
        let Some((Ready { plan, transients, rooms, .. }, others)) = ready.split_first_mut() else {
            return Ok(());
        };
        if !transients.is_homeless(plan) {
            return Ok(());
        }
        transients.place(device, plan, blocks, |place| rooms[place].room_bytes)?;
        let left = others.iter_mut().filter(|other| !blocks.have(other.transients.memory()));
        left.for_each(|other| other.transients.leave());
        Ok(())
    }

    /// Gives back what executions of late have not used.
    fn give_back(&mut self) {
        let since = self.executions.saturating_sub(FRAMES_OF_LATE);
        self.ready.retain(|ready| ready.executed >= since);
        self.blocks.give_back();
        self.drop_homeless();
    }

    /// Drops plans of which the memory was given back: they would hold it.
    fn drop_homeless(&mut self) {
        let Self { ready, blocks, .. } = self;
        ready.retain(|ready| blocks.have(ready.transients.memory()));
    }
}

impl Ready {
    /// Whether it is the plan of a graph, in every size, and in place.
    fn goes_on(&self, graph: &Graph<'_, Body<'_>>) -> bool {
        let Self { plan, transients, .. } = self;
        plan.has_shape_of(graph) && plan.has_sizes_of(graph) && !transients.is_homeless(plan)
    }

    /// The names of the buffers whose sizes vary.
    fn varying(&self) -> HashSet<&str> {
        let varying = self.plan.resources.iter().zip(&self.rooms).filter(|(_, room)| room.varies);
        varying.map(|(resource, _)| resource.name.as_str()).collect()
    }
}

/// A buffer's size in bytes, and the largest that it could have; of images nothing.
fn sizes_of(desc: &ResourceDesc, device: &Device) -> (u64, u64) {
    let limits = &device.facts().limits;
    match desc {
        ResourceDesc::Image(_) => (0, 0),
        ResourceDesc::Buffer(BufferDesc { size_bytes, texels }) => {
            let most_texels = texel_bytes(*texels).map(|bytes| u64::from(limits.max_texels) * bytes);
            (*size_bytes, most_texels.unwrap_or(u64::MAX).min(limits.max_buffer_size))
        }
    }
}
