//! The memory of a chunk on the device: its buffers, and the descriptor set that shaders find them by.

use ash::vk;

use crate::{
    error::{Error, Result},
    vk::{
        Binding, Buffer, BufferDesc, Descriptor, DescriptorPool, Device, MemoryUse, PoolSizes, SealedPool,
        SetLayout, Staging,
    },
};

/// The descriptor set of a chunk: binding 0 shapes, binding 1 colors, binding 2 levels of detail or a mesh's
/// indices, binding 3 clip curves or a mesh's cells.
pub struct SplatSetLayout(SetLayout);

impl SplatSetLayout {
    /// The layout.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn new(device: &Device) -> Result<Self> {
        let stages = vk::ShaderStageFlags::VERTEX | vk::ShaderStageFlags::COMPUTE;
        let binding = Binding { kind: vk::DescriptorType::STORAGE_BUFFER, stages };
        Ok(Self(SetLayout::new(device, "splats", &[binding; 4])?))
    }

    /// The set's layout.
    pub fn set(&self) -> &SetLayout {
        &self.0
    }
}

/// Where chunks are made: the device, the layout of their sets, and whoever runs batches of uploads.
pub(super) struct Uploader<'u> {
    pub device: &'u Device,
    pub layout: &'u SplatSetLayout,
    pub submit: &'u mut dyn FnMut(Staging) -> Result<()>,
}

/// Buffers of a chunk, and their set.
pub(super) struct ChunkMemory {
    pub set: vk::DescriptorSet,
    _pool: SealedPool,
    // Not read by the host, but the set names them.
    pub buffers: Vec<Buffer>,
}

impl Uploader<'_> {
    /// Has a batch recorded: what is on the device else would be whatever was there before, as which no scene may be drawn.
    pub fn submit(&mut self, batch: Staging) -> Result<()> {
        let is_recorded = batch.is_recorded();
        (self.submit)(batch)?;
        match is_recorded() {
            true => Ok(()),
            false => Err(Error::option("submit", "a batch of uploads was not recorded")),
        }
    }

    /// A buffer of device memory that is filled by uploads.
    pub fn buffer(&self, name: &str, size: u64, usage: vk::BufferUsageFlags) -> Result<Buffer> {
        let usage = usage | vk::BufferUsageFlags::TRANSFER_DST;
        Buffer::new(self.device, BufferDesc { name, size, usage }, MemoryUse::Device)
    }
}

impl ChunkMemory {
    /// The set of the first `named` of some buffers, one at least; the last of them stands in for those that are missing. `name`: the
    /// chunk's.
    pub fn new(uploader: &Uploader<'_>, name: &str, buffers: Vec<Buffer>, named: usize) -> Result<Self> {
        let room = PoolSizes { sets: 1, buffers: 4, ..PoolSizes::default() };
        let pool = DescriptorPool::new(uploader.device, &format!("set of {name}"), room)?;
        let named = &buffers[..named];
        let bindings = (0..4).zip(named.iter().chain(named.last().into_iter().cycle()));
        let given: Vec<_> = bindings
            .map(|(number, buffer)| (number, Descriptor::Buffer(buffer.raw(), buffer.size())))
            .collect();
        // SAFETY: storage buffers of this device, which are kept beside the set.
        let set = unsafe { pool.set(uploader.layout.set(), &given) }?;
        Ok(Self { set, _pool: pool.seal(), buffers })
    }

    /// Bytes of device memory.
    pub fn bytes(&self) -> u64 {
        self.buffers.iter().map(Buffer::size).sum()
    }
}
