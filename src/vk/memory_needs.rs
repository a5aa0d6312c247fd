//! What device memory will be asked for, told before anything is.

use ash::vk;

use super::{buffer::BufferDesc, device::Device, image::ImageDesc, memory::MemoryUse};
use crate::error::Result;

/// A piece of device memory that will be asked for, as a [`MemoryRequest`](super::MemoryRequest) asks for it.
///
/// ```no_run
/// use surfel::embed::{MemoryPiece, MemoryUse};
///
/// /// What must be mapped.
/// fn is_mapped(piece: &MemoryPiece) -> bool {
///     piece.touched_by != MemoryUse::Device
/// }
/// ```
#[derive(Clone, Debug)]
pub struct MemoryPiece {
    /// For what, in words.
    pub name: String,
    /// What Vulkan says that it needs: bytes, alignment, memory types.
    pub requirements: vk::MemoryRequirements,
    /// Who touches it.
    pub touched_by: MemoryUse,
    /// For buffers; else for images of optimal tiling.
    pub linear: bool,
}

/// All pieces that will be asked for, in their order: [`crate::Renderer::scene_needs`] and [`crate::Renderer::view_needs`] tell them.
///
/// ```no_run
/// use surfel::{Scene, ash::vk, embed::{MemoryNeeds, MemoryUse, Placed, Renderer, Rendering, ViewFrame}};
///
/// /// One block for a scene and a view of it, before either is there; `granularity` is the device's `bufferImageGranularity`.
/// fn block(renderer: &Renderer, scene: &Scene, rendering: &Rendering, like: &ViewFrame<'_>, granularity: u64) -> surfel::Result<vk::MemoryRequirements> {
///     let (mut needs, measured) = renderer.scene_needs(scene)?;
///     let placed = [Placed::at_home(&measured)];
///     needs.pieces.extend(renderer.view_needs(rendering, &ViewFrame { scenes: &placed, ..*like })?.pieces);
///     Ok(needs.block(granularity, |piece| piece.touched_by == MemoryUse::Device))
/// }
/// ```
#[derive(Clone, Debug, Default)]
pub struct MemoryNeeds {
    /// One by one.
    pub pieces: Vec<MemoryPiece>,
}

impl MemoryNeeds {
    /// One block with room for those pieces that are meant, one behind the other in their order, each at a multiple of its alignment and of `granularity`
    /// (Vulkan's `bufferImageGranularity`, where buffers and images lie in one block; else 1). Of memory of any type that is among all of theirs.
    pub fn block(&self, granularity: u64, meant: impl Fn(&MemoryPiece) -> bool) -> vk::MemoryRequirements {
        let none = vk::MemoryRequirements { size: 0, alignment: 1, memory_type_bits: u32::MAX };
        self.pieces.iter().filter(|piece| meant(piece)).fold(none, |block, piece| {
            let vk::MemoryRequirements { size, alignment, memory_type_bits } = piece.requirements;
            let alignment = alignment.max(granularity).max(1);
            vk::MemoryRequirements {
                size: block.size.checked_next_multiple_of(alignment).unwrap_or(u64::MAX).saturating_add(size),
                alignment: block.alignment.max(alignment),
                memory_type_bits: block.memory_type_bits & memory_type_bits,
            }
        })
    }

    /// Bytes of all pieces, without what lies between them.
    pub fn bytes(&self) -> u64 {
        self.pieces.iter().map(|piece| piece.requirements.size).sum()
    }

    /// Adds what a buffer with memory of its own will ask for.
    ///
    /// # Errors
    /// As [`super::Buffer::new`], but for those of the driver and the allocator.
    pub(crate) fn buffer(
        &mut self,
        device: &Device,
        desc: BufferDesc<'_>,
        touched_by: MemoryUse,
    ) -> Result<()> {
        desc.check(device)?;
        let create = vk::BufferCreateInfo::default().size(desc.size).usage(desc.usage);
        let info = vk::DeviceBufferMemoryRequirements::default().create_info(&create);
        let mut needed = vk::MemoryRequirements2::default();
        // SAFETY: the device has such buffers; maintenance4 is enabled.
        unsafe { device.raw().get_device_buffer_memory_requirements(&info, &mut needed) };
        self.piece(desc.name, needed.memory_requirements, (touched_by, true));
        Ok(())
    }

    /// Adds what an image with memory of its own will ask for.
    ///
    /// # Errors
    /// As [`super::Image::new`], but for those of the driver and the allocator.
    pub(crate) fn image(&mut self, device: &Device, desc: ImageDesc<'_>) -> Result<()> {
        desc.check(device)?;
        let create = desc.create_info();
        let info = vk::DeviceImageMemoryRequirements::default().create_info(&create);
        let mut needed = vk::MemoryRequirements2::default();
        // SAFETY: the device has such images; maintenance4 is enabled.
        unsafe { device.raw().get_device_image_memory_requirements(&info, &mut needed) };
        self.piece(desc.name, needed.memory_requirements, (MemoryUse::Device, false));
        Ok(())
    }

    /// Adds a piece.
    pub(crate) fn piece(
        &mut self,
        name: &str,
        requirements: vk::MemoryRequirements,
        (touched_by, linear): (MemoryUse, bool),
    ) {
        self.pieces.push(MemoryPiece { name: name.to_owned(), requirements, touched_by, linear });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_holds_pieces_in_their_order_each_where_it_may_begin() {
        let mut needs = MemoryNeeds::default();
        for (size, alignment, memory_type_bits, touched_by, linear) in [
            (10, 16, 0b111, MemoryUse::Device, true),
            (100, 64, 0b110, MemoryUse::Device, false),
            (3, 4, 0b011, MemoryUse::Upload, true),
        ] {
            let requirements = vk::MemoryRequirements { size, alignment, memory_type_bits };
            needs.piece("", requirements, (touched_by, linear));
        }
        let words = |granularity, meant: &dyn Fn(&MemoryPiece) -> bool| {
            let block = needs.block(granularity, meant);
            (block.size, block.alignment, block.memory_type_bits)
        };
        // From 0 to 10, 64 to 164, 164 to 167.
        assert_eq!(words(1, &|_| true), (167, 64, 0b010));
        // From 0 to 10, 1024 to 1124, 2048 to 2051.
        assert_eq!(words(1024, &|_| true), (2051, 1024, 0b010));
        assert_eq!(words(1, &|piece| piece.linear), (15, 16, 0b011));
        assert_eq!(words(1, &|_| false), (0, 1, u32::MAX));
        // No device has as much.
        assert_eq!(words(u64::MAX, &|_| true).0, u64::MAX);
        assert_eq!(needs.bytes(), 113);
    }
}
