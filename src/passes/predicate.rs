//! Layers that the device leaves out where the layer before was empty (`--layers auto`), without the host's knowledge.
//!
//! An occlusion query counts the fragments of a layer's last pass, which is 0 where no pixel has the layer; then none has
//! one behind it. The count is copied to a buffer, from which the draws of the next layer take their number: 0 or 1, for
//! a larger one is cut to the one that there are arguments for. A layer that is left out counts nothing itself.

use ash::vk;

use crate::passes::{
    inputs::Inputs,
    pass::Pass,
    pipeline::splat_shaders::Primitive,
    place::{At, Place, transfer},
    recording::Recording,
};
use crate::{
    error::Result,
    graph::{Access, Buffer, BufferDesc, Graph, Handle, Start, execute::Body},
    vk::Occlusion,
};

/// Bytes between the arguments of draws: room for five words.
const STEP: u32 = 32;

/// One `VkDrawIndirectCommand` for the whole target, one a chunk of splats; one `VkDrawIndexedIndirectCommand` a mesh.
const ARGUMENTS: At = Place::LayerArguments.at(0);

/// 32 bits: the fragments of the layer before, for a pass that draws only where there are some.
const FRAGMENTS: At = Place::LayerFragments.at(0);

/// Whether the draws of a pass depend on the layer before.
pub(crate) fn is_predicated(pass: &Recording<'_, '_>) -> bool {
    pass.has(FRAGMENTS)
}

/// Records the triangle over the whole target.
pub(crate) fn draw_fullscreen(pass: &Recording<'_, '_>) -> Result<()> {
    draw(pass, ARGUMENTS, 0)
}

/// Records the draw of a chunk of splats.
pub(crate) fn draw_splats(pass: &Recording<'_, '_>, chunk: usize) -> Result<()> {
    draw(pass, ARGUMENTS, 1 + chunk)
}

/// Records a draw whose arguments are another buffer's.
pub(crate) fn draw_listed(pass: &Recording<'_, '_>, arguments: At) -> Result<()> {
    draw(pass, arguments, 0)
}

/// Records the draw of a mesh, whose index buffer is bound.
pub(crate) fn draw_mesh(pass: &Recording<'_, '_>, inputs: Inputs<'_>, number: usize) -> Result<()> {
    let offset = (1 + inputs.draws.len() + number) as u64 * u64::from(STEP);
    draw_indexed(pass, pass.buffer(ARGUMENTS)?, offset)
}

/// Records a draw whose arguments are another buffer's, and whose index buffer is bound.
pub(crate) fn draw_indexed(pass: &Recording<'_, '_>, arguments: vk::Buffer, offset: u64) -> Result<()> {
    let fragments = pass.buffer(FRAGMENTS)?;
    let (device, commands) = (pass.device(), pass.commands());
    // SAFETY: as in `draw`; the index buffer is bound.
    unsafe { device.cmd_draw_indexed_indirect_count(commands, arguments, offset, fragments, 0, 1, STEP) };
    Ok(())
}

fn draw(pass: &Recording<'_, '_>, arguments: At, place: usize) -> Result<()> {
    let (arguments, fragments) = (pass.buffer(arguments)?, pass.buffer(FRAGMENTS)?);
    let offset = place as u64 * u64::from(STEP);
    let (device, commands) = (pass.device(), pass.commands());
    // SAFETY: inside of rendering with a pipeline bound; both buffers hold what is read, and the graph's barriers
    // order it; layers are predicated only where the device has drawIndirectCount.
    unsafe { device.cmd_draw_indirect_count(commands, arguments, offset, fragments, 0, 1, STEP) };
    Ok(())
}

/// What the layers of a frame depend on.
pub(crate) struct LayerPredicates<'a> {
    /// Counts the pixels of each layer.
    pub queries: &'a Occlusion,
    arguments: Handle<Buffer>,
    /// Of the layer that was declared last.
    fragments: Option<Handle<Buffer>>,
}

impl<'a> LayerPredicates<'a> {
    /// Declares the pass that writes the arguments of all draws and makes the queries ready.
    pub fn new(graph: &mut Graph<'a, Body<'a>>, inputs: Inputs<'a>, queries: &'a Occlusion) -> Self {
        let words = graph.arena().list(argument_words(inputs));
        let size_bytes = (words.len() * 4) as u64;
        let mut arguments = graph.create_buffer("arguments of layers", BufferDesc::of_bytes(size_bytes));
        let why = "--layers auto: layers are left out on the device where there is none";
        Pass::new(graph, inputs.source, "arguments of layers", why)
            .write(transfer(0), &mut arguments, Access::TransferWrite, Start::Discard)
            .finish(move |pass| {
                // SAFETY: outside of rendering; the frame that used the queries before has finished.
                unsafe { queries.reset(pass.commands(), queries.count()) };
                pass.update_buffer(transfer(0), bytemuck::cast_slice(words))
            });
        Self { queries, arguments, fragments: None }
    }

    /// Lets the draws of a pass depend on the layer that was declared last; the first depends on none.
    pub fn predicate<'g>(&self, pass: Pass<'g, 'a>) -> Pass<'g, 'a> {
        match &self.fragments {
            None => pass,
            Some(fragments) => pass.read(ARGUMENTS, &self.arguments, Access::IndirectRead).read(
                FRAGMENTS,
                fragments,
                Access::IndirectRead,
            ),
        }
    }

    /// Declares the pass that takes over the count of a layer, from 0 on, that was declared.
    pub fn count(&mut self, graph: &mut Graph<'a, Body<'a>>, inputs: Inputs<'a>, layer: u32) {
        let mut fragments =
            graph.create_buffer(format_args!("fragments of layer {}", layer + 1), BufferDesc::of_bytes(4));
        let queries = self.queries;
        let why = "--layers auto: whether the layer is empty";
        Pass::new(graph, inputs.source, format_args!("count layer {}", layer + 1), why)
            .write(transfer(0), &mut fragments, Access::TransferWrite, Start::Discard)
            .finish(move |pass| {
                // SAFETY: outside of rendering, after the layer's last pass, which ends the query.
                unsafe { queries.copy(pass.commands(), layer, pass.buffer(transfer(0))?) };
                Ok(())
            });
        self.fragments = Some(fragments);
    }
}

/// The arguments of all draws that may be predicated.
fn argument_words(inputs: Inputs<'_>) -> impl Iterator<Item = u32> {
    let primitive = Primitive::of(inputs.settings.rasterizer);
    let splats = inputs.draws.iter().map(move |draw| {
        let [vertices, instances] = primitive.counts(draw.chunk.count);
        [vertices, instances, 0, 0, 0, 0, 0, 0]
    });
    let meshes = inputs.meshes.iter().map(|draw| [3 * draw.chunk.triangles, 1, 0, 0, 0, 0, 0, 0]);
    std::iter::once([3, 1, 0, 0, 0, 0, 0, 0]).chain(splats).chain(meshes).flatten()
}
