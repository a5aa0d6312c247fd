//! What of a view is drawn within the host's rendering.

use ash::vk;

use super::view::{Prepared, View};
use crate::{
    error::{Error, Result},
    passes::pipeline::key::Layout,
    renderer::Renderer,
};

impl View {
    /// Records the draws of the frame that was prepared: up to three triangles. Clobbers viewport and scissor, and of the graphics bind point the
    /// pipeline, all descriptor sets and push constants.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for another renderer than the view's, and if no frame is prepared. Nothing is recorded then.
    ///
    /// # Safety
    /// `commands` are those of [`View::prepare`], or others that are submitted after them to the same queue; they are inside of a rendering as the
    /// view was made for, which covers the view's area. They are recorded before those of the next [`View::prepare`], or submitted before them; the view stays alive until they have run.
    pub unsafe fn draw(&self, renderer: &Renderer, commands: vk::CommandBuffer) -> Result<()> {
        self.check_renderer(renderer)?;
        let Some(Prepared { area, depth, draws, objects }) = &self.prepared else {
            return Err(Error::option("draw", "no frame is prepared: expected prepare before"));
        };
        let layout = renderer.shaders.layout(Layout::Host)?;
        let viewport = vk::Viewport {
            x: area.offset.x as f32,
            y: area.offset.y as f32,
            width: area.extent.width as f32,
            height: area.extent.height as f32,
            min_depth: 0.0,
            max_depth: 1.0,
        };
        let (raw, graphics) = (self.device.raw(), vk::PipelineBindPoint::GRAPHICS);
        // SAFETY: this function's contract; pipelines and sets have this layout, and live as long as renderer and view.
        unsafe {
            raw.cmd_set_viewport(commands, 0, &[viewport]);
            raw.cmd_set_scissor(commands, 0, std::slice::from_ref(area));
            raw.cmd_push_constants(
                commands,
                layout.raw(),
                layout.push_stages(),
                0,
                bytemuck::bytes_of(depth),
            );
            if let Some(set) = objects {
                raw.cmd_bind_descriptor_sets(commands, graphics, layout.raw(), 1, &[*set], &[]);
            }
            for (pipeline, set) in draws {
                raw.cmd_bind_pipeline(commands, graphics, *pipeline);
                raw.cmd_bind_descriptor_sets(commands, graphics, layout.raw(), 0, &[*set], &[]);
                raw.cmd_draw(commands, 3, 1, 0, 0);
            }
        }
        Ok(())
    }
}
