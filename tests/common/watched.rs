//! A small Vulkan program under validation, made of the library's own objects.

use std::sync::Arc;

use ash::vk;
use surfel::vk::{
    Buffer, BufferDesc, CommandPool, Device, Instance, MemoryUse, Message, Messages, Queue, Validation,
};

/// A device that is watched, and what is said of it.
pub struct Watched {
    pub device: Device,
    pub queue: Queue,
    pub messages: Arc<Messages>,
}

/// Records one command buffer.
pub type Record<'a> = &'a dyn Fn(&ash::Device, vk::CommandBuffer);

impl Watched {
    /// Fails, and does not skip, without a device or the layer.
    pub fn new() -> Self {
        super::arm();
        let instance = Instance::new(Validation::On).expect("tests need the validation layer");
        let asked = std::env::var("SURFEL_TEST_DEVICE").ok();
        let device = Device::new(&instance, asked.as_deref()).expect("tests need a Vulkan device");
        let queue = Queue::new(&device).unwrap();
        let messages = instance.messages();
        Self { device, queue, messages }
    }

    /// The identifiers of what was said since the last call, without the prefix that later layers dropped.
    pub fn said(&self) -> Vec<String> {
        let name = |message: Message| message.vuid.trim_start_matches("UNASSIGNED-").to_owned();
        self.messages.take().into_iter().map(name).collect()
    }

    /// A buffer of 4 KiB.
    pub fn buffer(&self, usage: vk::BufferUsageFlags) -> Buffer {
        let desc = BufferDesc { name: "the buffer", size: 4096, usage };
        Buffer::new(&self.device, desc, MemoryUse::Device).unwrap()
    }

    /// Submits the command buffers one after the other, each by itself, waits for the last, and says what was said.
    pub fn run(&self, programs: &[Record<'_>]) -> Vec<String> {
        let mut pools = Vec::new();
        let mut epoch = 0;
        for record in programs {
            let pool = CommandPool::new(&self.device, "program").unwrap();
            // SAFETY: the pool is new; all that is recorded is alive until the wait below.
            epoch = unsafe {
                record(self.device.raw(), pool.begin().unwrap());
                self.queue.submit(pool.end().unwrap()).unwrap()
            };
            pools.push(pool);
        }
        self.queue.wait(epoch).unwrap();
        self.said()
    }
}

/// Records a fill of the whole buffer.
pub fn fill(device: &ash::Device, commands: vk::CommandBuffer, buffer: &Buffer) {
    // SAFETY: recording, outside of rendering; the callers keep the buffer until the program has run.
    unsafe { device.cmd_fill_buffer(commands, buffer.raw(), 0, vk::WHOLE_SIZE, 7) };
}

/// Records a barrier over all memory.
pub fn barrier(
    device: &ash::Device,
    commands: vk::CommandBuffer,
    src: (vk::PipelineStageFlags2, vk::AccessFlags2),
    dst: (vk::PipelineStageFlags2, vk::AccessFlags2),
) {
    let barriers = [vk::MemoryBarrier2::default()
        .src_stage_mask(src.0)
        .src_access_mask(src.1)
        .dst_stage_mask(dst.0)
        .dst_access_mask(dst.1)];
    let info = vk::DependencyInfo::default().memory_barriers(&barriers);
    // SAFETY: recording, outside of rendering.
    unsafe { device.cmd_pipeline_barrier2(commands, &info) };
}

/// The writes of fills and copies.
pub const TRANSFER_WRITE: (vk::PipelineStageFlags2, vk::AccessFlags2) =
    (vk::PipelineStageFlags2::ALL_TRANSFER, vk::AccessFlags2::TRANSFER_WRITE);
