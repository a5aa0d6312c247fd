//! A small graph of transfers, in which one image can have the memory of another.

use ash::vk;
use surfel::{
    arena::Arena,
    graph::{
        Access, BufferDesc as GraphBufferDesc, BufferState, Graph, ImageDesc, Plan, ResourceId, Start,
        execute::{Body, Part, PassContext, Physical, Transients, execute, memory_need},
    },
    vk::{Buffer, BufferDesc, CommandPool, MemoryUse},
};

use crate::common::watched::{TRANSFER_WRITE, Watched};

/// The caller's objects.
pub type Imports = Vec<(ResourceId, Physical)>;

const EXTENT: vk::Extent2D = vk::Extent2D { width: 64, height: 48 };
const BYTES: u64 = 4 * EXTENT.width as u64 * EXTENT.height as u64;

/// `pattern` to `first` to `second` to `third` to `result`: the third image can have the first one's memory.
pub fn chain<'a>(
    arena: &'a Arena,
    watched: &Watched,
    pattern: &Buffer,
    result: &Buffer,
) -> (Plan, Graph<'a, Body<'a>>, Imports) {
    let mut graph: Graph<'_, Body<'_>> = Graph::new(arena);
    let desc = ImageDesc { format: vk::Format::R8G8B8A8_UNORM, extent: EXTENT };
    let bytes = GraphBufferDesc::of_bytes(BYTES);
    let written = BufferState { stages: TRANSFER_WRITE.0, access: TRANSFER_WRITE.1 };
    let read = BufferState { stages: vk::PipelineStageFlags2::HOST, access: vk::AccessFlags2::HOST_READ };
    let from = graph.import_buffer("pattern", bytes, BufferState::default(), None);
    let mut to = graph.import_buffer("result", bytes, written, Some(read));
    let mut images = ["first", "second", "third"].map(|name| graph.create_image(name, desc));
    let imports =
        vec![(from.id(), Physical::Buffer(pattern.raw())), (to.id(), Physical::Buffer(result.raw()))];

    let region = || {
        let layers =
            vk::ImageSubresourceLayers::default().aspect_mask(vk::ImageAspectFlags::COLOR).layer_count(1);
        vk::BufferImageCopy::default().image_subresource(layers).image_extent(EXTENT.into())
    };
    let (source, target) = (from.id(), images[0].id());
    graph
        .pass("upload")
        .read(&from, Access::TransferRead)
        .write(&mut images[0], Access::TransferWrite, Start::Discard)
        .finish(arena.keep(move |context: &PassContext<'_>| {
            let (buffer, (image, _)) = (context.buffer(source)?, context.image(target)?);
            let layout = context.layout(target);
            // SAFETY: both are 64×48 pixels; the graph's barriers come before.
            unsafe {
                let (device, commands) = (context.device(), context.commands());
                device.cmd_copy_buffer_to_image(commands, buffer, image, layout, &[region()]);
            }
            Ok(())
        }));
    for i in 0..2 {
        let [source, target] = [images[i].id(), images[i + 1].id()];
        let (before, after) = images.split_at_mut(i + 1);
        graph
            .pass(["copy to second", "copy to third"][i])
            .read(&before[i], Access::TransferRead)
            .write(&mut after[0], Access::TransferWrite, Start::Discard)
            .finish(arena.keep(move |context: &PassContext<'_>| {
                let (from, to) = (context.image(source)?.0, context.image(target)?.0);
                let (from_layout, to_layout) = (context.layout(source), context.layout(target));
                let layers = region().image_subresource;
                let copy = vk::ImageCopy::default()
                    .src_subresource(layers)
                    .dst_subresource(layers)
                    .extent(EXTENT.into());
                // SAFETY: as above.
                unsafe {
                    let (device, commands) = (context.device(), context.commands());
                    device.cmd_copy_image(commands, from, from_layout, to, to_layout, &[copy]);
                }
                Ok(())
            }));
    }
    let (source, target) = (images[2].id(), to.id());
    graph
        .pass("read back")
        .read(&images[2], Access::TransferRead)
        .write(&mut to, Access::TransferWrite, Start::Discard)
        .finish(arena.keep(move |context: &PassContext<'_>| {
            let ((image, _), buffer) = (context.image(source)?, context.buffer(target)?);
            let layout = context.layout(source);
            // SAFETY: as above.
            unsafe {
                let (device, commands) = (context.device(), context.commands());
                device.cmd_copy_image_to_buffer(commands, image, layout, buffer, &[region()]);
            }
            Ok(())
        }));
    let need = |_, desc: &_, usage| memory_need(&watched.device, desc, usage);
    (graph.compile(need).unwrap(), graph, imports)
}

/// A pattern to upload, and the buffer for the result.
pub fn buffers(watched: &Watched) -> (Buffer, Buffer) {
    let desc = |name, usage| BufferDesc { name, size: BYTES, usage };
    let pattern = desc("pattern", vk::BufferUsageFlags::TRANSFER_SRC);
    let mut pattern = Buffer::new(&watched.device, pattern, MemoryUse::Upload).unwrap();
    // SAFETY: the device has not seen it yet.
    for (i, byte) in (0_u32..).zip(unsafe { pattern.bytes_mut() }) {
        *byte = (i.wrapping_mul(2_654_435_761) >> 24) as u8;
    }
    let result = desc("result", vk::BufferUsageFlags::TRANSFER_DST);
    (pattern, Buffer::new(&watched.device, result, MemoryUse::Readback).unwrap())
}

/// Records and submits without a wait; the pool must live until one.
pub fn submit(
    watched: &Watched,
    (plan, graph): (&Plan, &Graph<'_, Body<'_>>),
    transients: &Transients,
    imports: &Imports,
) -> (CommandPool, u64) {
    let pool = CommandPool::new(&watched.device, "chain").unwrap();
    // SAFETY: the pool is new and the queue one; all that is used is alive until the callers' wait.
    unsafe {
        let commands = pool.begin().unwrap();
        execute(&watched.device, commands, (plan, graph), transients, imports, None, Part::default())
            .unwrap();
        let epoch = watched.queue.submit(pool.end().unwrap()).unwrap();
        (pool, epoch)
    }
}
