//! How many splats a frame sets up, which only the device knows: it lists them, and draws nothing.

use ash::vk;

use super::{
    in_use::{inputs_of, read_back},
    list_occupancy,
};
use crate::{
    arena::Arena,
    error::Result,
    frame::FrameSlot,
    graph::{Graph, ImageDesc},
    passes,
    prepare::{Placed, PreparedScene},
    renderer::Headless,
    scene::{Camera, Edges, Rasterizer, Settings, TileMemory},
    vk::{Buffer, CommandPool, Queue},
};

/// A count of splats that the device is at, or done with.
pub struct Counting {
    epoch: u64,
    /// Of each list where its parts start: the last word is how many splats it has.
    starts: Vec<Buffer>,
    _slot: FrameSlot,
    _commands: CommandPool,
}

impl Counting {
    /// How many they are; `None` until the device is done. `queue`: that of the host which has begun it.
    ///
    /// # Errors
    /// Whatever the driver answers, such as a lost device.
    pub fn listed(&self, queue: &Queue) -> Result<Option<u64>> {
        if !queue.is_done(self.epoch)? {
            return Ok(None);
        }
        let last = |buffer: &Buffer| -> Option<u32> {
            // SAFETY: its submission is done.
            unsafe { buffer.bytes() }.chunks_exact(4).next_back().map(bytemuck::pod_read_unaligned)
        };
        Ok(Some(self.starts.iter().filter_map(last).map(u64::from).sum()))
    }
}

#[cfg(feature = "inside")]
impl Headless {
    /// How many splats a frame sets up, where it lists those that may be seen, as it does of levels of detail. 0 where it lists none.
    ///
    /// # Errors
    /// As [`Self::begin_count`]; whatever the driver answers.
    pub fn count_listed(&self, scene: &PreparedScene, camera: &Camera, settings: &Settings) -> Result<u64> {
        let counting = self.begin_count(scene, camera, settings)?;
        self.queue().wait(counting.epoch)?;
        Ok(counting.listed(self.queue())?.unwrap_or(0))
    }

    /// The same for hosts that go on meanwhile: what makes the lists is submitted, and not waited for.
    ///
    /// # Errors
    /// As [`crate::renderer::Renderer::record`].
    pub fn begin_count(
        &self,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
    ) -> Result<Counting> {
        // In one band: splats that reach into two are in the lists of both.
        let mut settings = Settings { tile_memory: TileMemory::Most(1 << 33), ..settings.clone() };
        let (arena, scenes) = (Arena::new(), [Placed::at_home(scene)]);
        let mut frame = self.renderer.frame_plan(&arena, &scenes, camera, &settings)?;
        if [&frame.opaque, &frame.transparent].iter().any(|plan| plan.bands().len() > 1) {
            (settings.edges, settings.rasterizer) = (Edges::Hard, Rasterizer::Compute);
            frame = self.renderer.frame_plan(&arena, &scenes, camera, &settings)?;
        }
        let device = self.device();
        let mut slot = FrameSlot::new(device);
        let commands = CommandPool::new(device, "count of splats")?;
        let starts = {
            let (inputs, execution) = inputs_of(&self.renderer, &mut slot, &frame, (camera, &settings))?;
            let (mut graph, mut imports) = (Graph::new(&arena), arena.growing());
            let format = vk::Format::R8G8B8A8_SRGB;
            // Nobody reads it, so that of all passes those are left that make what is read below.
            let mut target = graph.create_image("target", ImageDesc { format, extent: inputs.extent() });
            passes::frame(&mut graph, inputs, &frame, &mut target, format, (false, None))?;
            let names = list_occupancy::counter_buffers(&arena, inputs, &frame);
            let names = names.into_iter().filter(|name| name.starts_with("starts of visible"));
            let starts = read_back((&mut graph, &mut imports), inputs.source, names, device)?;
            // SAFETY: the pool is new.
            let commands = unsafe { commands.begin() }?;
            // SAFETY: recording; what is used is the scene's and the renderer's, which outlive what was submitted before they are dropped, the slot's, and the buffers, which wait likewise.
            unsafe {
                self.renderer.shaders().begin_frame(commands)?;
                execution.record(commands, &graph, &imports)
            }?;
            starts
        };
        // SAFETY: recorded just now; as above.
        let epoch = unsafe { self.queue().submit(commands.end()?) }?;
        let starts = starts.into_iter().map(|(_, buffer)| buffer).collect();
        Ok(Counting { epoch, starts, _slot: slot, _commands: commands })
    }
}
