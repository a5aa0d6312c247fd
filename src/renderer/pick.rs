//! Picking: what is seen in one pixel of a picture, and where it is.

use ash::vk;

use super::{Headless, Renderer, headless::submit_and_wait};
use crate::{
    arena::Arena,
    error::{Error, Result},
    frame::FrameSlot,
    graph::{BufferDesc as GraphBufferDesc, BufferState, Graph, execute::Physical},
    passes::{self, PickPlan, Picked, Place},
    prepare::{Placed, PreparedScene},
    scene::{Camera, Settings},
    vk::{Buffer, BufferDesc, MemoryUse},
};

impl Renderer {
    /// Plans to look at a pixel, from the top left corner, of a picture with these settings. A device is then asked by
    /// [`Self::record_pick`].
    ///
    /// # Errors
    /// As [`Renderer::check`]; a pixel that is not in the picture.
    pub fn plan_pick<'a>(
        &self,
        scene: &'a PreparedScene,
        camera: &Camera,
        settings: &Settings,
        pixel: [u32; 2],
    ) -> Result<PickPlan<'a>> {
        // Whatever cannot be drawn cannot be seen.
        scene.check_is_somewhere()?;
        let arena = Arena::new();
        let frame = self.frame_plan(&arena, &[Placed::at_home(scene)], camera, settings)?;
        let [width, height] = settings.size_px;
        if pixel[0] >= width || pixel[1] >= height {
            let [x, y] = pixel;
            return Err(Error::option("--pick", format!("{x},{y}: expected a pixel of {width}x{height}")));
        }
        Ok(PickPlan::new(&frame, scene, camera, settings, &self.limits, pixel))
    }

    /// Records what the device does for a pick. Once it has run, [`PickPlan::read`] says what the bytes in the buffer mean.
    ///
    /// # Errors
    /// Whatever driver or allocator answer.
    ///
    /// # Safety
    /// `commands` must be recording, outside of rendering, and be submitted to the device's queue. The scene, the buffer, the slot and the renderer must stay alive until
    /// it has run. The slot is not a frame's, and the pick recorded before in it has finished; the buffer may be copied to and has [`PickPlan::size_bytes`] of room; the host
    /// may read it after its own wait.
    pub unsafe fn record_pick(
        &self,
        commands: vk::CommandBuffer,
        slot: &mut FrameSlot,
        plan: &PickPlan<'_>,
        answer: vk::Buffer,
    ) -> Result<()> {
        if plan.is_empty() {
            return Ok(());
        }
        // SAFETY: this function's contract.
        unsafe { slot.begin(passes::needs_of_pick(), None) }?;
        // SAFETY: this function's contract.
        let planes = unsafe { slot.planes(plan.planes()) }?;
        let parts = slot.parts()?;
        let arena = Arena::new();
        let mut graph = Graph::new(&arena);
        let initial = BufferState {
            stages: vk::PipelineStageFlags2::ALL_TRANSFER,
            access: vk::AccessFlags2::TRANSFER_WRITE,
        };
        let last = BufferState { stages: vk::PipelineStageFlags2::HOST, access: vk::AccessFlags2::HOST_READ };
        let desc = GraphBufferDesc::of_bytes(plan.size_bytes());
        let mut to = graph.import_buffer("read-back of picked", desc, initial, Some(last));
        let imports = [(to.id(), Physical::Buffer(answer))];
        passes::pick(&mut graph, (Place::Device(&self.shaders, parts.descriptors), planes), plan, &mut to)?;
        // SAFETY: this function's contract.
        unsafe {
            self.shaders.begin_frame(commands)?;
            parts.execution.record(commands, &graph, &imports)
        }?;
        Ok(())
    }
}

impl Headless {
    /// What is seen in a pixel of a picture with these settings, from its top left corner; `None` where nothing is. Of several samples, it
    /// is what lies under the pixel's center.
    ///
    /// # Errors
    /// As [`Renderer::plan_pick`] and [`Renderer::record_pick`].
    pub fn pick(
        &mut self,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
        pixel: [u32; 2],
    ) -> Result<Option<Picked>> {
        self.check_renderer()?;
        let plan = self.renderer.plan_pick(scene, camera, settings, pixel)?;
        let desc = BufferDesc {
            name: "read-back of picked",
            size: plan.size_bytes(),
            usage: vk::BufferUsageFlags::TRANSFER_DST,
        };
        let answer = Buffer::new(self.device(), desc, MemoryUse::Readback)?;
        let mut slot = FrameSlot::new(self.device());
        submit_and_wait(self, |commands| {
            // SAFETY: recording; all that it uses is alive until the wait; the slot is new.
            unsafe { self.renderer.record_pick(commands, &mut slot, &plan, answer.raw()) }
        })?;
        // SAFETY: waited for.
        Ok(plan.read(unsafe { answer.bytes() }))
    }
}
