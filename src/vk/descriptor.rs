//! What a binding of a set is given.

use ash::vk;

/// The resource that a binding is given.
#[derive(Clone, Copy, Debug)]
pub enum Descriptor {
    /// The first bytes of a buffer, so many, storage or uniform as its binding is.
    Buffer(vk::Buffer, u64),
    /// The texels of a buffer.
    Texels(vk::BufferView),
    /// A sampled image in this layout, read by `texelFetch`, or through the sampler of its binding.
    Sampled(vk::ImageView, vk::ImageLayout),
    /// A storage image, in the layout `GENERAL`.
    Storage(vk::ImageView),
}

impl Default for Descriptor {
    fn default() -> Self {
        Self::Buffer(vk::Buffer::null(), 0)
    }
}

/// A [`Descriptor`] as Vulkan wants it.
#[derive(Clone, Copy)]
pub(super) enum Info {
    Buffer([vk::DescriptorBufferInfo; 1]),
    Texels([vk::BufferView; 1]),
    Image([vk::DescriptorImageInfo; 1]),
}

impl Default for Info {
    fn default() -> Self {
        Self::of(Descriptor::default())
    }
}

impl Info {
    pub fn of(descriptor: Descriptor) -> Self {
        let image = |view, layout| vk::DescriptorImageInfo::default().image_view(view).image_layout(layout);
        match descriptor {
            Descriptor::Buffer(raw, bytes) => {
                Self::Buffer([vk::DescriptorBufferInfo::default().buffer(raw).range(bytes)])
            }
            Descriptor::Texels(view) => Self::Texels([view]),
            Descriptor::Sampled(view, layout) => Self::Image([image(view, layout)]),
            Descriptor::Storage(view) => Self::Image([image(view, vk::ImageLayout::GENERAL)]),
        }
    }
}
