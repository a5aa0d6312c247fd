//! The kernel as a texture, where it is to be read from one (Guennebaud et al. 2006, section 3.2). Written anew each frame:
//! 65 536 pixels, so that a frame depends on nothing but its settings.

use ash::vk;

use crate::passes::{
    inputs::Inputs,
    pass::Pass,
    pipeline::{
        key::{GraphicsKey, Layout},
        variant::kernel_constants,
    },
};
use crate::{
    error::Result,
    graph::{Access, Graph, Handle, Image, ImageDesc, Start, execute::Body},
    scene::Kernel,
    shaders::{self, config::*},
};

/// Half floats: every device filters them.
const FORMAT: vk::Format = vk::Format::R16_SFLOAT;

/// What its pipeline is; `cut_off`: it is 0 outside of the disk, for the paper's programs. It reads no set and no push constants: any
/// layout will do.
fn key(kernel: Kernel, cut_off: bool) -> GraphicsKey {
    let mut constants = kernel_constants(kernel);
    constants.push((SPEC_CUT_OFF, cut_off.into()));
    GraphicsKey {
        color_formats: [FORMAT].into(),
        ..GraphicsKey::fullscreen(&shaders::KERNEL_TEXTURE_FRAG, Layout::Finalize, constants)
    }
}

/// Declares the pass; returns the texture.
pub(crate) fn kernel_texture<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    cut_off: bool,
) -> Result<Handle<Image>> {
    let extent = vk::Extent2D { width: KERNEL_TEXTURE_SIDE, height: KERNEL_TEXTURE_SIDE };
    let mut texture = graph.create_image("kernel", ImageDesc { format: FORMAT, extent });
    let pass = Pass::new(graph, inputs.source, "kernel texture", "the kernel is read from a texture").attach(
        &mut texture,
        Access::ColorAttachment,
        Start::Discard,
    );
    let pipeline = pass.graphics(key(inputs.settings.kernel, cut_off))?;
    pass.finish(move |pass| {
        pass.bind(pipeline);
        pass.draw([3, 1]);
        Ok(())
    });
    Ok(texture)
}
