//! How much a pool of descriptor sets has room for.

use ash::vk;

/// Room in a pool.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PoolSizes {
    /// Sets.
    pub sets: u32,
    /// Storage buffers in all sets.
    pub buffers: u32,
    /// Uniform buffers.
    pub uniform_buffers: u32,
    /// Buffers read by texels.
    pub texel_buffers: u32,
    /// Sampled images.
    pub images: u32,
    /// Sampled images with a sampler.
    pub filtered_images: u32,
    /// Storage images.
    pub storage_images: u32,
}

impl PoolSizes {
    /// Of one descriptor; of kinds that no pool has room for, nothing.
    pub(super) fn one(kind: vk::DescriptorType) -> Self {
        let mut one = Self::default();
        let counts = [
            (vk::DescriptorType::STORAGE_BUFFER, &mut one.buffers),
            (vk::DescriptorType::UNIFORM_BUFFER, &mut one.uniform_buffers),
            (vk::DescriptorType::UNIFORM_TEXEL_BUFFER, &mut one.texel_buffers),
            (vk::DescriptorType::SAMPLED_IMAGE, &mut one.images),
            (vk::DescriptorType::COMBINED_IMAGE_SAMPLER, &mut one.filtered_images),
            (vk::DescriptorType::STORAGE_IMAGE, &mut one.storage_images),
        ];
        counts.into_iter().filter(|(own, _)| *own == kind).for_each(|(_, count)| *count = 1);
        one
    }

    /// The descriptors of each kind.
    pub(super) fn kinds(&self) -> [(vk::DescriptorType, u32); 6] {
        [
            (vk::DescriptorType::STORAGE_BUFFER, self.buffers),
            (vk::DescriptorType::UNIFORM_BUFFER, self.uniform_buffers),
            (vk::DescriptorType::UNIFORM_TEXEL_BUFFER, self.texel_buffers),
            (vk::DescriptorType::SAMPLED_IMAGE, self.images),
            (vk::DescriptorType::COMBINED_IMAGE_SAMPLER, self.filtered_images),
            (vk::DescriptorType::STORAGE_IMAGE, self.storage_images),
        ]
    }

    /// Room for both.
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            sets: self.sets + other.sets,
            buffers: self.buffers + other.buffers,
            uniform_buffers: self.uniform_buffers + other.uniform_buffers,
            texel_buffers: self.texel_buffers + other.texel_buffers,
            images: self.images + other.images,
            filtered_images: self.filtered_images + other.filtered_images,
            storage_images: self.storage_images + other.storage_images,
        }
    }

    /// What is left without that, which it [`holds`](Self::holds).
    pub(super) fn minus(&self, taken: &Self) -> Self {
        Self {
            sets: self.sets - taken.sets,
            buffers: self.buffers - taken.buffers,
            uniform_buffers: self.uniform_buffers - taken.uniform_buffers,
            texel_buffers: self.texel_buffers - taken.texel_buffers,
            images: self.images - taken.images,
            filtered_images: self.filtered_images - taken.filtered_images,
            storage_images: self.storage_images - taken.storage_images,
        }
    }

    /// Room for either.
    pub fn max(&self, other: &Self) -> Self {
        Self {
            sets: self.sets.max(other.sets),
            buffers: self.buffers.max(other.buffers),
            uniform_buffers: self.uniform_buffers.max(other.uniform_buffers),
            texel_buffers: self.texel_buffers.max(other.texel_buffers),
            images: self.images.max(other.images),
            filtered_images: self.filtered_images.max(other.filtered_images),
            storage_images: self.storage_images.max(other.storage_images),
        }
    }

    /// Whether a pool of this room has room for that.
    pub fn holds(&self, wanted: &Self) -> bool {
        let mut kinds = wanted.kinds().into_iter().zip(self.kinds());
        wanted.sets <= self.sets && kinds.all(|((_, wanted), (_, own))| wanted <= own)
    }
}
