//! How many bytes a pass moves at least, as its plan tells: each attachment loaded and stored, each image and buffer read
//! or written once, without any compression.

use std::collections::BTreeMap;

use ash::vk;

use super::{
    access::{Access, PassKind},
    declare::Use,
    plan::{Plan, PlannedPass},
    resource::ResourceDesc,
};

/// What a plan does not tell of a pass, and only its execution shows.
#[derive(Clone, Copy, Debug)]
pub struct Executed<'a> {
    /// Fragments that it shades, where that is known: of an image that they sample no more texels are read.
    pub fragments: Option<u64>,
    /// Pixels of an image that its dispatches read or write, at least.
    pub pixels: u64,
    /// Bytes in use of buffers that have room for more, by name.
    pub in_use: &'a BTreeMap<String, u64>,
}

impl Plan {
    /// Bytes that a pass of this plan moves at least; `None` where it has an image of a format that is not known here.
    /// What the graph does not know, such as buffers that bodies bind themselves, is not in it.
    pub fn least_bytes(&self, pass: &PlannedPass, executed: Executed<'_>) -> Option<u64> {
        pass.uses.iter().map(|usage| self.bytes_of(pass, usage, executed)).sum()
    }

    fn bytes_of(&self, pass: &PlannedPass, usage: &Use, executed: Executed<'_>) -> Option<u64> {
        let resource = self.resource(usage.resource);
        let desc = match resource.desc {
            ResourceDesc::Buffer(desc) => {
                let in_use = executed.in_use.get(&resource.name).copied();
                return Some(times(usage) * in_use.unwrap_or(u64::MAX).min(desc.size_bytes));
            }
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
            Access::SampledFragment => pixels.min(executed.fragments.unwrap_or(pixels)),
            // Written or read: where both are declared, it may be for what is not touched and shall stay.
            _ if pass.kind == PassKind::Compute => pixels.min(executed.pixels),
            _ => pixels * times(usage),
        };
        Some(texels * pixel_bytes)
    }
}

/// How often all of a resource is moved, as far as one knows.
fn times(usage: &Use) -> u64 {
    match usage.access {
        Access::StorageUpdateCompute => 0,
        Access::StorageReadWriteCompute | Access::SampledAndStoredCompute => 2,
        _ => 1,
    }
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
    use super::super::{BufferDesc, BufferState, ClearValue, ImageDesc, ImageState, MemoryNeed, Start};
    use super::*;
    use crate::graph::tests::graph;

    #[test]
    fn what_is_loaded_stored_and_read_is_counted_once_each() {
        let extent = vk::Extent2D { width: 10, height: 4 };
        let image = |format| ImageDesc { format, extent };
        let mut graph = graph();
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
        let plan = graph.compile(need).unwrap();
        let in_use = BTreeMap::new();
        let bytes = |i: usize, fragments| {
            plan.least_bytes(&plan.passes[i], Executed { fragments, pixels: 0, in_use: &in_use })
        };
        // A depth is stored, points are read; a depth is tested, sums are stored.
        assert_eq!((bytes(0, None), bytes(1, None)), (Some(40 * 4 + 1000), Some(40 * 4 + 40 * 8)));
        // Three fragments read three texels, but all of the target is stored.
        assert_eq!((bytes(2, None), bytes(2, Some(3))), (Some(40 * 8 + 40 * 4), Some(3 * 8 + 40 * 4)));
    }

    #[test]
    fn of_dispatches_only_what_they_are_known_to_move_is_counted() {
        let extent = vk::Extent2D { width: 10, height: 4 };
        let format = vk::Format::R16G16B16A16_SFLOAT;
        let mut graph = graph();
        let mut shown = graph.create_image("shown", ImageDesc { format, extent });
        let mut counts = graph.create_buffer("counts", BufferDesc::of_bytes(100));
        let mut list = graph.create_buffer("list", BufferDesc::of_bytes(1000));
        graph.pass("clear image").write(&mut shown, Access::TransferWrite, Start::Discard).finish(());
        graph.pass("clear").write(&mut counts, Access::TransferWrite, Start::Discard).finish(());
        graph
            .pass("count")
            .write(&mut counts, Access::StorageUpdateCompute, Start::Load)
            .write(&mut list, Access::StorageWriteCompute, Start::Discard)
            .finish(());
        graph
            .pass("sum")
            .read(&list, Access::StorageReadCompute)
            .write(&mut counts, Access::StorageReadWriteCompute, Start::Load)
            .write(&mut shown, Access::StorageReadWriteCompute, Start::Load)
            .side_effect()
            .finish(());
        let need =
            |_, _: &ResourceDesc, _| Ok(MemoryNeed { size_bytes: 1, alignment_bytes: 1, type_bits: 1 });
        let plan = graph.compile(need).unwrap();
        let bytes = |in_use: &BTreeMap<String, u64>, pixels| {
            let executed = Executed { fragments: None, pixels, in_use };
            [1, 2, 3].map(|i: usize| plan.least_bytes(&plan.passes[i], executed).unwrap())
        };
        // Some places of the counts are no bytes that one knows of; all of them are read and written. No pixel is known; of those that
        // are, one can't tell whether all were read before they are written.
        assert_eq!(bytes(&BTreeMap::new(), 0), [100, 1000, 1000 + 200]);
        // Of a list, what is in use; never more than there is room for.
        let in_use = |bytes| BTreeMap::from([("list".to_owned(), bytes)]);
        assert_eq!(bytes(&in_use(12), 3), [100, 12, 12 + 200 + 3 * 8]);
        assert_eq!(bytes(&in_use(1001), 41), [100, 1000, 1000 + 200 + 40 * 8]);
    }
}
