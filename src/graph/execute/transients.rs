//! The physical transients of a plan: memory blocks, and the images and buffers placed in them.

use ash::vk;

use super::{
    super::{Block, ImageDesc, MemoryClass, MemoryNeed, Plan, ResourceDesc, Slot, Usage, Use},
    Physical,
};
use crate::{
    error::Result,
    vk::{Buffer, BufferDesc, Device, Image, ImageDesc as PhysicalImageDesc, Memory},
};

/// What memory a transient needs on a device, for [`super::super::Graph::compile`].
pub fn memory_need(device: &Device, desc: &ResourceDesc, usage: Usage) -> MemoryNeed {
    let mut requirements = vk::MemoryRequirements2::default();
    match (desc, usage) {
        (ResourceDesc::Image(desc), Usage::Image(usage)) => {
            let create = image_desc("", *desc, usage).create_info();
            let info = vk::DeviceImageMemoryRequirements::default().create_info(&create);
            // SAFETY: the description is valid; maintenance4 is enabled.
            unsafe { device.raw().get_device_image_memory_requirements(&info, &mut requirements) };
        }
        (ResourceDesc::Buffer(desc), Usage::Buffer(usage)) => {
            let create = vk::BufferCreateInfo::default().size(desc.size_bytes).usage(usage);
            let info = vk::DeviceBufferMemoryRequirements::default().create_info(&create);
            // SAFETY: as above.
            unsafe { device.raw().get_device_buffer_memory_requirements(&info, &mut requirements) };
        }
        // The graph gives an image's usage to images only; no memory type makes it refuse by name.
        _ => {}
    }
    let needed = requirements.memory_requirements;
    MemoryNeed {
        size_bytes: needed.size,
        alignment_bytes: needed.alignment,
        type_bits: needed.memory_type_bits,
    }
}

/// The transients of one plan; reusable for every plan that has the same ones and accesses them alike.
pub struct Transients {
    // Dropped, and so destroyed, before the memory that they are bound to.
    objects: Vec<Option<Object>>,
    memory: Vec<Memory>,
    key: Key,
}

enum Object {
    Image(Image),
    Buffer(Buffer),
}

/// All that the objects depend on.
#[derive(PartialEq)]
struct Key {
    resources: Vec<Option<(ResourceDesc, Usage, Slot)>>,
    blocks: Vec<Block>,
    /// The first accesses wait for the last ones of the execution before, taken to be the same.
    uses: Vec<Vec<Use>>,
}

impl Key {
    fn of(plan: &Plan) -> Self {
        let resources = plan.resources.iter();
        let resources = resources.map(|r| r.slot.map(|slot| (r.desc, r.usage, slot))).collect();
        let uses = plan.passes.iter().map(|pass| pass.uses.clone()).collect();
        Self { resources, blocks: plan.blocks.clone(), uses }
    }
}

impl Transients {
    /// Allocates and creates all transients of a plan.
    ///
    /// # Errors
    /// Whatever the allocator or the driver answers.
    pub fn new(device: &Device, plan: &Plan) -> Result<Self> {
        let memory = plan.blocks.iter().map(|block| {
            let requirements = vk::MemoryRequirements {
                size: block.size_bytes,
                alignment: block.alignment_bytes,
                memory_type_bits: block.type_bits,
            };
            let (name, linear) = match block.class {
                MemoryClass::Images => ("transient images", false),
                MemoryClass::Buffers => ("transient buffers", true),
            };
            Memory::new(device, name, requirements, linear)
        });
        let memory = memory.collect::<Result<Vec<_>>>()?;
        let objects = plan.resources.iter().map(|resource| {
            let Some(slot) = resource.slot else { return Ok(None) };
            let (block, offset) = (&memory[slot.block], slot.offset_bytes);
            Ok(match (resource.desc, resource.usage) {
                (ResourceDesc::Image(desc), Usage::Image(usage)) => {
                    let desc = image_desc(&resource.name, desc, usage);
                    Some(Object::Image(Image::placed(device, desc, block, offset)?))
                }
                (ResourceDesc::Buffer(desc), Usage::Buffer(usage)) => {
                    let texels =
                        usage.contains(vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER).then_some(desc.texels);
                    let desc = BufferDesc { name: &resource.name, size: desc.size_bytes, usage };
                    let buffer = Buffer::placed(device, desc, block, offset)?;
                    Some(Object::Buffer(match texels {
                        Some(format) => buffer.with_texels(&resource.name, format)?,
                        None => buffer,
                    }))
                }
                _ => None,
            })
        });
        let objects = objects.collect::<Result<Vec<_>>>()?;
        Ok(Self { objects, memory, key: Key::of(plan) })
    }

    /// Whether they serve this plan too.
    pub fn fit(&self, plan: &Plan) -> bool {
        self.key == Key::of(plan)
    }

    /// Those of the frame before where they serve this plan too; else new ones. The old ones are destroyed once the frames that
    /// use them are done.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn for_plan<'k>(kept: &'k mut Option<Self>, device: &Device, plan: &Plan) -> Result<&'k mut Self> {
        match kept.take_if(|transients| transients.fit(plan)) {
            Some(transients) => Ok(kept.insert(transients)),
            None => Ok(kept.insert(Self::new(device, plan)?)),
        }
    }

    /// Bytes of device memory.
    pub fn bytes(&self) -> u64 {
        self.memory.iter().map(Memory::size).sum()
    }

    /// The objects by resource index.
    pub(super) fn physical(&self, count: usize) -> Vec<Option<Physical>> {
        let object = |object: &Option<Object>| match object {
            Some(Object::Image(image)) => Some(Physical::Image(image.raw(), image.view())),
            Some(Object::Buffer(buffer)) => Some(match buffer.texels() {
                Some(texels) => Physical::TexelBuffer(buffer.raw(), texels),
                None => Physical::Buffer(buffer.raw()),
            }),
            None => None,
        };
        let mut physical: Vec<_> = self.objects.iter().map(object).collect();
        physical.resize(count, None);
        physical
    }
}

fn image_desc(name: &str, desc: ImageDesc, usage: vk::ImageUsageFlags) -> PhysicalImageDesc<'_> {
    PhysicalImageDesc { name, format: desc.format, extent: desc.extent, usage }
}
