//! The kernel as a texture, where it is to be read from one (Guennebaud et al. 2006, section 3.2). Written anew each frame:
//! 65 536 pixels, so that a frame depends on nothing but its settings.

use ash::vk;

use super::{
    Inputs,
    pipelines::{GraphicsKey, Layout},
    variant::kernel_constants,
};
use crate::{
    error::Result,
    graph::{Access, Graph, Handle, Image, ImageDesc, Start, execute::Body},
    scene::Kernel,
    shaders::Shader,
};

/// Texels along a side, as in `glsl/inc/kernel_texture.glsl`.
const SIDE: u32 = 256;

/// Half floats: every device filters them.
const FORMAT: vk::Format = vk::Format::R16_SFLOAT;

/// What the pipeline is of a shader that writes a kernel. It reads no set and no push constants: any layout will do.
pub(super) fn key(shader: &'static Shader, kernel: Kernel) -> GraphicsKey {
    GraphicsKey {
        color_formats: vec![FORMAT],
        ..GraphicsKey::fullscreen(shader, Layout::Finalize, kernel_constants(kernel))
    }
}

/// Declares the pass; returns the texture.
pub(super) fn kernel_texture<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    shader: &'static Shader,
) -> Result<Handle<Image>> {
    let pipeline = inputs.shaders.graphics(key(shader, inputs.settings.kernel))?;
    let extent = vk::Extent2D { width: SIDE, height: SIDE };
    let mut texture = graph.create_image("kernel", ImageDesc { format: FORMAT, extent });
    graph.pass("kernel texture").write(&mut texture, Access::ColorAttachment, Start::Discard).finish(
        Box::new(move |context| {
            let (device, commands) = (context.device(), context.commands());
            // SAFETY: inside of rendering; the pipeline needs no set, no push constants and no vertices.
            unsafe {
                device.cmd_bind_pipeline(commands, vk::PipelineBindPoint::GRAPHICS, pipeline.raw());
                device.cmd_draw(commands, 3, 1, 0, 0);
            }
            Ok(())
        }),
    );
    Ok(texture)
}
