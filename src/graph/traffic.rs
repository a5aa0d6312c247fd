//! How many bytes a pass moves at least, as its plan tells: each attachment loaded and stored, each image and buffer read
//! or written once, without any compression.

use ash::vk;

use super::{
    access::Access,
    declare::Use,
    plan::{Plan, PlannedPass},
    resource::ResourceDesc,
};

impl Plan {
    /// Bytes that a pass of this plan moves at least; `None` where it has an image of a format that is not known here.
    /// `fragments`: what it shades, where that is known; of an image that fragments sample no more texels are read. What
    /// the graph does not know, such as buffers that bodies bind themselves, is not in it.
    pub fn least_bytes(&self, pass: &PlannedPass, fragments: Option<u64>) -> Option<u64> {
        pass.uses.iter().map(|usage| self.bytes_of(pass, usage, fragments)).sum()
    }

    fn bytes_of(&self, pass: &PlannedPass, usage: &Use, fragments: Option<u64>) -> Option<u64> {
        let desc = match self.resource(usage.resource).desc {
            ResourceDesc::Buffer(desc) => return Some(times(usage) * desc.size_bytes),
            ResourceDesc::Image(desc) => desc,
        };
        let pixels = u64::from(desc.extent.width) * u64::from(desc.extent.height);
        let pixel_bytes = bytes_per_pixel(desc.format)?;
        let texels = match usage.access {
            access if access.is_attachment() => {
                let rendering = pass.rendering.as_ref()?;
                let own = |attachment: &&super::Attachment| attachment.resource == usage.resource;
                let attachment = rendering.colors.iter().chain(&rendering.depth).find(own)?;
                let loaded = u64::from(attachment.load == vk::AttachmentLoadOp::LOAD);
                let stored = u64::from(attachment.store == vk::AttachmentStoreOp::STORE);
                pixels * (loaded + stored)
            }
            Access::SampledFragment => pixels.min(fragments.unwrap_or(pixels)),
            _ => pixels * times(usage),
        };
        Some(texels * pixel_bytes)
    }
}

/// How often all of a resource is moved.
fn times(usage: &Use) -> u64 {
    if usage.access == Access::StorageReadWriteCompute { 2 } else { 1 }
}

/// Bytes of a pixel, of the formats that frames are made of.
fn bytes_per_pixel(format: vk::Format) -> Option<u64> {
    use vk::Format as F;
    match format {
        F::R8_UNORM => Some(1),
        F::R16_SFLOAT | F::R16_UINT => Some(2),
        F::R8G8B8A8_UNORM
        | F::R8G8B8A8_SRGB
        | F::B8G8R8A8_UNORM
        | F::B8G8R8A8_SRGB
        | F::R16G16_SFLOAT
        | F::R32_UINT
        | F::R32_SFLOAT
        | F::D32_SFLOAT => Some(4),
        F::R16G16B16A16_SFLOAT | F::R32G32_SFLOAT | F::R32G32_UINT => Some(8),
        F::R32G32B32A32_SFLOAT | F::R32G32B32A32_UINT => Some(16),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::{
        BufferDesc, BufferState, ClearValue, Graph, ImageDesc, ImageState, MemoryNeed, Start,
    };
    use super::*;

    #[test]
    fn what_is_loaded_stored_and_read_is_counted_once_each() {
        let extent = vk::Extent2D { width: 10, height: 4 };
        let image = |format| ImageDesc { format, extent };
        let mut graph = Graph::new();
        let mut depth = graph.create_image("depth", image(vk::Format::D32_SFLOAT));
        let mut sums = graph.create_image("sums", image(vk::Format::R16G16B16A16_SFLOAT));
        let mut target =
            graph.import_image("target", image(vk::Format::R8G8B8A8_SRGB), ImageState::default(), None);
        let points = graph.import_buffer("points", BufferDesc::of_bytes(1000), BufferState::default(), None);
        graph
            .pass("draw")
            .write(&mut depth, Access::DepthAttachment, Start::Clear(ClearValue::Depth(0.0)))
            .read(&points, Access::StorageReadVertex)
            .finish(());
        graph
            .pass("sum")
            .write(&mut sums, Access::ColorAttachment, Start::Clear(ClearValue::Color([0.0; 4])))
            .read(&depth, Access::DepthTest)
            .finish(());
        graph
            .pass("show")
            .read(&sums, Access::SampledFragment)
            .write(&mut target, Access::ColorAttachment, Start::Discard)
            .finish(());
        let need =
            |_, _: &ResourceDesc, _| Ok(MemoryNeed { size_bytes: 1, alignment_bytes: 1, type_bits: 1 });
        let plan = graph.compile(need).unwrap().plan;
        let bytes = |i: usize, fragments| plan.least_bytes(&plan.passes[i], fragments);
        // A depth is stored, points are read; a depth is tested, sums are stored.
        assert_eq!((bytes(0, None), bytes(1, None)), (Some(40 * 4 + 1000), Some(40 * 4 + 40 * 8)));
        // Three fragments read three texels, but all of the target is stored.
        assert_eq!((bytes(2, None), bytes(2, Some(3))), (Some(40 * 8 + 40 * 4), Some(3 * 8 + 40 * 4)));
    }
}
