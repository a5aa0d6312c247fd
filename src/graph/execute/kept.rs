//! What one execution leaves for the next: its plan, and its transients. A frame that declares what the one before did takes both;
//! one in which only sizes of buffers differ, too, as long as these have room.

use std::{collections::HashSet, sync::Arc};

use ash::vk;

use super::{
    super::{BufferDesc, Graph, Plan, ResourceDesc, ResourceId},
    Body, Physical, Profiler, execute,
    rooms::{Room, serve},
    transients::{Transients, memory_need},
};
use crate::{
    error::Result,
    vk::{Device, texel_bytes},
};

/// The plan and the transients of one execution, for the next.
#[derive(Default)]
pub struct Kept(Option<Last>);

struct Last {
    plan: Arc<Plan>,
    transients: Transients,
    /// One a resource.
    rooms: Vec<Room>,
}

impl Kept {
    /// Compiles a graph, where that has changed, and records it as [`execute`] does, on transients that are made where those of the
    /// execution before don't serve. The plan that was recorded.
    ///
    /// # Errors
    /// As [`Graph::compile`] and [`execute`], and whatever the allocator or the driver answers.
    ///
    /// # Safety
    /// As [`execute`]; the execution before has finished or goes before this one to the same queue.
    pub unsafe fn execute(
        &mut self,
        device: &Device,
        commands: vk::CommandBuffer,
        graph: &Graph<'_, Body<'_>>,
        imports: &[(ResourceId, Physical)],
        profiler: Option<&mut Profiler>,
    ) -> Result<Arc<Plan>> {
        let last = self.prepare(device, graph)?;
        // SAFETY: this function's contract.
        unsafe { execute(device, commands, (&last.plan, graph), &last.transients, imports, profiler) }?;
        Ok(Arc::clone(&last.plan))
    }

    /// Bytes of device memory in transients.
    pub fn bytes(&self) -> u64 {
        self.0.as_ref().map_or(0, |last| last.transients.bytes())
    }

    fn prepare(&mut self, device: &Device, graph: &Graph<'_, Body<'_>>) -> Result<&Last> {
        let resources = &graph.declared.resources;
        let sizes = resources.iter().map(|resource| sizes_of(&resource.desc, device));
        let rooms = match self.0.take() {
            Some(mut last) if last.plan.has_shape_of(graph) => {
                if serve(&mut last.rooms, sizes) {
                    if !last.plan.has_sizes_of(graph) {
                        Arc::make_mut(&mut last.plan).resize(graph);
                    }
                    return Ok(self.0.insert(last));
                }
                last.rooms
            }
            last => {
                let varying = last.as_ref().map(Last::varying).unwrap_or_default();
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
        let transients = Transients::new(device, &plan, |place| rooms[place].room_bytes)?;
        Ok(self.0.insert(Last { plan: Arc::new(plan), transients, rooms }))
    }
}

impl Last {
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
