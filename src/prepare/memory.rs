//! The memory of a chunk on the device: its buffers, and the descriptor set that shaders find them by.

use std::cell::RefCell;

use ash::vk;

use crate::{
    error::{Error, Result},
    vk::{
        Binding, Buffer, BufferDesc, Descriptor, DescriptorPool, Device, MemoryNeeds, MemoryUse, PoolSizes,
        SealedPool, SetLayout, Staging,
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
    pub to: To<'u>,
}

/// Where uploads go.
pub(super) enum To<'u> {
    /// To the device, by whoever runs batches of them.
    Device(&'u mut dyn FnMut(Staging) -> Result<()>),
    /// Nowhere: what memory they would take is told.
    Needs(&'u RefCell<MemoryNeeds>),
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
        let To::Device(submit) = &mut self.to else { return Ok(()) };
        let is_recorded = batch.is_recorded();
        submit(batch)?;
        match is_recorded() {
            true => Ok(()),
            false => Err(Error::option("submit", "a batch of uploads was not recorded")),
        }
    }

    /// A buffer of device memory that is filled by uploads; `None` where it is only told what they need.
    pub fn buffer(&self, name: &str, size: u64, usage: vk::BufferUsageFlags) -> Result<Option<Buffer>> {
        let desc = BufferDesc { name, size, usage: usage | vk::BufferUsageFlags::TRANSFER_DST };
        match &self.to {
            To::Device(_) => Buffer::new(self.device, desc, MemoryUse::Device).map(Some),
            To::Needs(needs) => {
                needs.borrow_mut().buffer(self.device, desc, MemoryUse::Device).map(|()| None)
            }
        }
    }

    /// A batch of uploads, alike.
    pub fn staging(&self, name: &str, bytes: u64) -> Result<Option<Staging>> {
        match &self.to {
            To::Device(_) => Staging::new(self.device, name, bytes).map(Some),
            To::Needs(needs) => {
                Staging::tell(self.device, name, bytes, &mut needs.borrow_mut()).map(|()| None)
            }
        }
    }
}

impl ChunkMemory {
    /// The set of the first `named` of some buffers, one at least; the last of them stands in for those that are missing. `name`: the
    /// chunk's. `None` where one of them is none.
    pub fn new(
        uploader: &Uploader<'_>,
        name: &str,
        buffers: Vec<Option<Buffer>>,
        named: usize,
    ) -> Result<Option<Self>> {
        let Some(buffers) = buffers.into_iter().collect::<Option<Vec<_>>>() else { return Ok(None) };
        let room = PoolSizes { sets: 1, buffers: 4, ..PoolSizes::default() };
        let pool = DescriptorPool::new(uploader.device, &format!("set of {name}"), room)?;
        let named = &buffers[..named];
        let bindings = (0..4).zip(named.iter().chain(named.last().into_iter().cycle()));
        let given: Vec<_> = bindings
            .map(|(number, buffer)| (number, Descriptor::Buffer(buffer.raw(), buffer.size())))
            .collect();
        // SAFETY: storage buffers of this device, which are kept beside the set.
        let set = unsafe { pool.set(uploader.layout.set(), &given) }?;
        Ok(Some(Self { set, _pool: pool.seal(), buffers }))
    }

    /// Bytes of device memory.
    pub fn bytes(&self) -> u64 {
        self.buffers.iter().map(Buffer::size).sum()
    }
}
