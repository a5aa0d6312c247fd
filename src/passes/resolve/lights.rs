//! The lights of a scene that has its own: a small buffer that each frame fills, for whoever shades. A scene without has
//! one at the eye, which is in the shaders and takes nothing.

use crate::passes::{
    pass::{Pass, Source},
    place::transfer,
    plan::lights::ShaderLight,
};
use crate::{
    graph::{Access, Buffer, BufferDesc, Graph, Handle, Start, execute::Body},
    scene::MOST_LIGHTS,
};

/// Declares the pass that fills the buffer; none where there are no lights.
pub(crate) fn lights<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    source: Source<'a>,
    lights: &'a [ShaderLight],
) -> Option<Handle<Buffer>> {
    if lights.is_empty() {
        return None;
    }
    // Shaders declare room for the most.
    let room = BufferDesc::of_bytes((MOST_LIGHTS * size_of::<ShaderLight>()) as u64);
    let mut buffer = graph.create_buffer("lights", room);
    Pass::new(graph, source, "lights", "the scene has lights of its own")
        .write(transfer(0), &mut buffer, Access::TransferWrite, Start::Discard)
        .finish(move |pass| pass.update_buffer(transfer(0), bytemuck::cast_slice(lights)));
    Some(buffer)
}
