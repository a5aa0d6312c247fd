//! Layers that the device leaves out where the layer before was empty (`--layers auto`), without the host's knowledge.
//!
//! An occlusion query counts the fragments of a layer's last pass, which is 0 where no pixel has the layer; then none has
//! one behind it. The count is copied to a buffer, from which the draws of the next layer take their number: 0 or 1, for
//! a larger one is cut to the one that there are arguments for. A layer that is left out counts nothing itself.

use ash::vk;

use crate::passes::inputs::Inputs;
use crate::{
    error::Result,
    graph::{
        Access, Buffer, BufferDesc, Graph, Handle, PassBuilder, ResourceId, Start,
        execute::{Body, PassContext},
    },
    vk::Occlusion,
};

/// Bytes between the arguments of draws: room for five words.
const STEP: u32 = 32;

/// `vkCmdUpdateBuffer` takes no more at once.
const MOST_BYTES_AT_ONCE: usize = 65_536;

/// What the draws of one layer depend on.
#[derive(Clone, Copy)]
pub(crate) struct Gate {
    /// One `VkDrawIndirectCommand` for the whole target, one a chunk of splats; one `VkDrawIndexedIndirectCommand` a mesh.
    arguments: ResourceId,
    /// 32 bits: fragments of the layer before.
    fragments: ResourceId,
    /// How many chunks of splats there are.
    chunks: usize,
}

impl Gate {
    /// Records the triangle over the whole target.
    pub fn draw_fullscreen(self, context: &PassContext<'_>) -> Result<()> {
        self.draw(context, context.buffer(self.arguments)?, 0)
    }

    /// Records the draw of a chunk of splats.
    pub fn draw_splats(self, context: &PassContext<'_>, number: usize) -> Result<()> {
        self.draw(context, context.buffer(self.arguments)?, 1 + number)
    }

    /// Records a draw whose arguments are another buffer's.
    pub fn draw_listed(self, context: &PassContext<'_>, arguments: vk::Buffer) -> Result<()> {
        self.draw(context, arguments, 0)
    }

    /// Records the draw of a mesh.
    pub fn draw_mesh(self, context: &PassContext<'_>, number: usize) -> Result<()> {
        let (arguments, fragments) = (context.buffer(self.arguments)?, context.buffer(self.fragments)?);
        let offset = (1 + self.chunks + number) as u64 * u64::from(STEP);
        let (device, commands) = (context.device(), context.commands());
        // SAFETY: as in `draw`; the index buffer is bound.
        unsafe {
            device.cmd_draw_indexed_indirect_count(commands, arguments, offset, fragments, 0, 1, STEP);
        }
        Ok(())
    }

    fn draw(self, context: &PassContext<'_>, arguments: vk::Buffer, place: usize) -> Result<()> {
        let fragments = context.buffer(self.fragments)?;
        let offset = place as u64 * u64::from(STEP);
        let (device, commands) = (context.device(), context.commands());
        // SAFETY: inside of rendering with a pipeline bound; both buffers hold what is read, and the graph's barriers
        // order it; there is a gate only where the device has drawIndirectCount.
        unsafe { device.cmd_draw_indirect_count(commands, arguments, offset, fragments, 0, 1, STEP) };
        Ok(())
    }
}

/// Makes the gates of a frame's layers.
pub(crate) struct Gates<'a> {
    queries: &'a Occlusion,
    arguments: Handle<Buffer>,
    chunks: usize,
    /// Of the layer that was declared last.
    fragments: Option<Handle<Buffer>>,
}

impl<'a> Gates<'a> {
    /// Declares the pass that writes the arguments of all draws and makes the queries ready.
    pub fn new(graph: &mut Graph<Body<'a>>, inputs: Inputs<'a>, queries: &'a Occlusion) -> Self {
        let words = argument_words(inputs);
        let size_bytes = (words.len() * 4) as u64;
        let mut arguments = graph.create_buffer("arguments of layers", BufferDesc::of_bytes(size_bytes));
        let id = arguments.id();
        graph
            .pass("arguments of layers")
            .write(&mut arguments, Access::TransferWrite, Start::Discard)
            .finish(Box::new(move |context| {
                let (device, commands, buffer) = (context.device(), context.commands(), context.buffer(id)?);
                let bytes: &[u8] = bytemuck::cast_slice(&words);
                // SAFETY: outside of rendering; the frame that used the queries before has finished; the buffer has room for
                // all that is written.
                unsafe {
                    queries.reset(commands);
                    for (i, part) in bytes.chunks(MOST_BYTES_AT_ONCE).enumerate() {
                        device.cmd_update_buffer(commands, buffer, (i * MOST_BYTES_AT_ONCE) as u64, part);
                    }
                }
                Ok(())
            }));
        Self { queries, arguments, chunks: inputs.draws.len(), fragments: None }
    }

    /// The gate of the next layer; the first has none.
    pub fn gate(&self) -> Option<Gate> {
        let fragments = self.fragments.as_ref()?.id();
        Some(Gate { arguments: self.arguments.id(), fragments, chunks: self.chunks })
    }

    /// Declares that a pass draws behind the gate.
    pub fn read<'g, B>(&self, pass: PassBuilder<'g, B>) -> PassBuilder<'g, B> {
        match &self.fragments {
            None => pass,
            Some(fragments) => {
                pass.read(&self.arguments, Access::IndirectRead).read(fragments, Access::IndirectRead)
            }
        }
    }

    /// Declares the pass that takes over the count of a layer, from 0 on, that was declared.
    pub fn count(&mut self, graph: &mut Graph<Body<'a>>, layer: u32) {
        let name = format!("fragments of layer {}", layer + 1);
        let mut fragments = graph.create_buffer(&name, BufferDesc::of_bytes(4));
        let (id, queries) = (fragments.id(), self.queries);
        graph
            .pass(&format!("count layer {}", layer + 1))
            .write(&mut fragments, Access::TransferWrite, Start::Discard)
            .finish(Box::new(move |context| {
                // SAFETY: outside of rendering, after the layer's last pass, which ends the query.
                unsafe { queries.copy(context.commands(), layer, context.buffer(id)?) };
                Ok(())
            }));
        self.fragments = Some(fragments);
    }

    /// The queries.
    pub fn queries(&self) -> &'a Occlusion {
        self.queries
    }
}

/// The arguments of all draws that may be gated.
fn argument_words(inputs: Inputs<'_>) -> Vec<u32> {
    let primitive = crate::passes::pipeline::splat_shaders::Primitive::of(inputs.settings.rasterizer);
    let splats = inputs.draws.iter().map(|draw| {
        let [vertices, instances] = primitive.counts(draw.chunk.count);
        [vertices, instances, 0, 0, 0, 0, 0, 0]
    });
    let meshes = inputs.meshes.iter().map(|draw| [3 * draw.chunk.triangles, 1, 0, 0, 0, 0, 0, 0]);
    std::iter::once([3, 1, 0, 0, 0, 0, 0, 0]).chain(splats).chain(meshes).flatten().collect()
}
