//! The physical transients of a plan: memory blocks, and the images and buffers placed in them.

use std::sync::Arc;

use ash::vk;

use super::{
    super::{BufferDesc, ImageDesc, MemoryClass, MemoryNeed, Plan, ResourceDesc, Usage},
    Physical,
    blocks::Blocks,
    one_shape,
};
use crate::{
    error::{Error, Result},
    vk::{Buffer, BufferDesc as PhysicalBufferDesc, Device, Image, ImageDesc as PhysicalImageDesc, Memory},
};

/// What memory a transient needs on a device, for [`super::super::Graph::compile`].
///
/// # Errors
/// [`crate::ErrorKind::Option`] for what the device does not have, and for the usage of another kind of resource.
pub fn memory_need(device: &Device, desc: &ResourceDesc, usage: Usage) -> Result<MemoryNeed> {
    const NAME: &str = "transient";
    let mut requirements = vk::MemoryRequirements2::default();
    match (desc, usage) {
        (ResourceDesc::Image(desc), Usage::Image(usage)) => {
            let desc = image_desc(device, NAME, *desc, usage);
            desc.check(device)?;
            let create = desc.placed_info(device);
            let info = vk::DeviceImageMemoryRequirements::default().create_info(&create);
            // SAFETY: the device has such images; maintenance4 is enabled.
            unsafe { device.raw().get_device_image_memory_requirements(&info, &mut requirements) };
        }
        (ResourceDesc::Buffer(desc), Usage::Buffer(usage)) => {
            let desc = buffer_desc(device, NAME, *desc, usage);
            desc.check(device)?;
            let create = vk::BufferCreateInfo::default().size(desc.size).usage(usage);
            let info = vk::DeviceBufferMemoryRequirements::default().create_info(&create);
            // SAFETY: as above.
            unsafe { device.raw().get_device_buffer_memory_requirements(&info, &mut requirements) };
        }
        // The graph gives an image's usage to images only.
        _ => return Err(Error::option(NAME, "an image for a buffer's usage, or a buffer for an image's")),
    }
    let needed = requirements.memory_requirements;
    Ok(MemoryNeed {
        size_bytes: needed.size,
        alignment_bytes: needed.alignment,
        type_bits: needed.memory_type_bits,
    })
}

/// The transients of one plan.
pub struct Transients {
    // Dropped, and so destroyed, before the memory that they are bound to.
    objects: Vec<Option<Object>>,
    /// One a block of the plan's; other plans' transients may lie there, too.
    memory: Vec<Arc<Memory>>,
}

enum Object {
    Image(Image),
    Buffer(Buffer),
}

impl Transients {
    /// Allocates and creates all transients of a plan.
    ///
    /// # Errors
    /// Whatever the allocator or the driver answers.
    pub fn new(device: &Device, plan: &Plan) -> Result<Self> {
        let size_bytes = |place: usize| match plan.resources[place].desc {
            ResourceDesc::Buffer(desc) => desc.size_bytes,
            ResourceDesc::Image(_) => 0,
        };
        let mut transients = Self::homeless();
        transients.place(device, plan, &mut Blocks::default(), size_bytes)?;
        Ok(transients)
    }

    /// None yet.
    pub(super) fn homeless() -> Self {
        Self { objects: Vec::new(), memory: Vec::new() }
    }

    /// Lets go of all objects and their memory, to be placed elsewhere.
    pub(super) fn leave(&mut self) {
        self.objects.clear();
        self.memory.clear();
    }

    /// Whether there are none, of a plan that has some.
    pub(super) fn is_homeless(&self, plan: &Plan) -> bool {
        self.objects.len() < plan.resources.len()
    }

    /// Creates all transients of a plan, of which there are none, in memory of these blocks. `room`: how many bytes the buffer has room for that is in this place among the
    /// resources; as many as it needs, or more where the plan's memory was asked for so.
    ///
    /// # Errors
    /// Whatever the allocator or the driver answers; then there are none.
    pub(super) fn place(
        &mut self,
        device: &Device,
        plan: &Plan,
        blocks: &mut Blocks,
        room: impl Fn(usize) -> u64,
    ) -> Result<()> {
        let placed = self.try_place(device, plan, blocks, room);
        placed.inspect_err(|_| self.leave())
    }

    fn try_place(
        &mut self,
        device: &Device,
        plan: &Plan,
        blocks: &mut Blocks,
        room: impl Fn(usize) -> u64,
    ) -> Result<()> {
        let Self { objects, memory } = self;
        blocks.serve(device, transient_name, &plan.blocks, memory)?;
        objects.reserve(plan.resources.len());
        for (place, resource) in plan.resources.iter().enumerate() {
            let Some(slot) = resource.slot else {
                objects.push(None);
                continue;
            };
            let (block, offset) = (&memory[slot.block], slot.offset_bytes);
            objects.push(match (resource.desc, resource.usage) {
                (ResourceDesc::Image(desc), Usage::Image(usage)) => {
                    let desc = image_desc(device, &resource.name, desc, usage);
                    Some(Object::Image(Image::placed(device, desc, block, offset)?))
                }
                (ResourceDesc::Buffer(desc), Usage::Buffer(usage)) => {
                    let texels =
                        usage.contains(vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER).then_some(desc.texels);
                    let room = BufferDesc { size_bytes: room(place), ..desc };
                    let desc = buffer_desc(device, &resource.name, room, usage);
                    let buffer = Buffer::placed(device, desc, block, offset)?;
                    Some(Object::Buffer(match texels {
                        Some(format) => buffer.with_texels(&resource.name, format)?,
                        None => buffer,
                    }))
                }
                _ => None,
            });
        }
        Ok(())
    }

    /// Bytes of device memory.
    pub fn bytes(&self) -> u64 {
        self.memory.iter().map(|memory| memory.size()).sum()
    }

    /// The memory of the plan's blocks.
    pub(super) fn memory(&self) -> &[Arc<Memory>] {
        &self.memory
    }

    /// The objects by resource index.
    pub(super) fn physical(&self) -> impl Iterator<Item = Option<Physical>> {
        let object = |object: &Option<Object>| match object {
            Some(Object::Image(image)) => Some(Physical::Image(image.raw(), image.view())),
            Some(Object::Buffer(buffer)) => Some(match buffer.texels() {
                Some(texels) => Physical::TexelBuffer(buffer.raw(), texels),
                None => Physical::Buffer(buffer.raw()),
            }),
            None => None,
        };
        self.objects.iter().map(object)
    }
}

/// What a block of memory is called.
pub(super) fn transient_name(class: MemoryClass) -> &'static str {
    match class {
        MemoryClass::Images => "transient images",
        MemoryClass::Buffers => "transient buffers",
    }
}

fn image_desc<'a>(
    device: &Device,
    name: &'a str,
    desc: ImageDesc,
    usage: vk::ImageUsageFlags,
) -> PhysicalImageDesc<'a> {
    let extent = one_shape::image_extent(&device.facts().limits, desc, usage);
    PhysicalImageDesc { name, format: desc.format, extent, usage }
}

fn buffer_desc<'a>(
    device: &Device,
    name: &'a str,
    BufferDesc { size_bytes, texels }: BufferDesc,
    usage: vk::BufferUsageFlags,
) -> PhysicalBufferDesc<'a> {
    let size = one_shape::buffer_bytes(&device.facts().limits, size_bytes, texels, usage);
    PhysicalBufferDesc { name, size, usage }
}
