//! Two-dimensional images, each with its one view.

use ash::vk;

use super::{
    device::Device,
    garbage::Retired,
    host_memory::{MemoryRequest, Piece},
    memory::{Memory, MemoryUse},
    result::VkResultExt,
};
use crate::error::{Error, Result};

/// The description of an image: two-dimensional, one mip level, one layer, one sample, optimal tiling.
#[derive(Clone, Copy, Debug)]
pub struct ImageDesc<'a> {
    /// Its debug name.
    pub name: &'a str,
    /// The format of a pixel.
    pub format: vk::Format,
    /// Width and height in pixels.
    pub extent: vk::Extent2D,
    /// Its uses.
    pub usage: vk::ImageUsageFlags,
}

impl ImageDesc<'_> {
    /// Refuses what the device does not have.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for a size, a format or a usage.
    pub(crate) fn check(&self, device: &Device) -> Result<()> {
        let vk::Extent2D { width, height } = self.extent;
        let side = device.facts().limits.max_image_side;
        if ![width, height].iter().all(|side_px| (1..=side).contains(side_px)) {
            let problem = format!("an image of {width}x{height} pixels: the device has 1 to {side} a side");
            return Err(Error::option(self.name, problem));
        }
        if !is_made(device, *self) {
            let problem = format!("an image of {:?} for {:?}: the device has none", self.format, self.usage);
            return Err(Error::option(self.name, problem));
        }
        Ok(())
    }

    /// The description in Vulkan's own form.
    pub fn create_info(&self) -> vk::ImageCreateInfo<'static> {
        vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(self.format)
            .extent(self.extent.into())
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .tiling(vk::ImageTiling::OPTIMAL)
            .usage(self.usage)
    }

    /// The same for an image that may share its memory. Newer layers (1.4.309) look for hazards between two such images only
    /// where both say so, and are alike. Without a layer nothing is said: a driver may then not compress them.
    pub(crate) fn placed_info(&self, device: &Device) -> vk::ImageCreateInfo<'static> {
        let info = self.create_info();
        if device.instance().is_validated() { info.flags(vk::ImageCreateFlags::ALIAS) } else { info }
    }

    /// Which aspect of the format there is.
    pub fn aspect(&self) -> vk::ImageAspectFlags {
        match self.format {
            vk::Format::D32_SFLOAT => vk::ImageAspectFlags::DEPTH,
            _ => vk::ImageAspectFlags::COLOR,
        }
    }
}

/// An image and its view, with memory of its own or in a shared block.
pub struct Image {
    device: Device,
    raw: vk::Image,
    view: vk::ImageView,
    format: vk::Format,
    extent: vk::Extent2D,
    allocation: Option<Piece>,
}

impl Image {
    /// An image with device memory of its own.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for a size, a format or a usage that the device doesn't have; whatever the driver or the allocator answers.
    pub fn new(device: &Device, desc: ImageDesc<'_>) -> Result<Self> {
        let mut image = Self::unbound(device, desc, &desc.create_info())?;
        // SAFETY: the image was just made from this device.
        let requirements = unsafe { device.raw().get_image_memory_requirements(image.raw) };
        let touched_by = MemoryUse::Device;
        let allocation =
            device.allocate(&MemoryRequest { name: desc.name, requirements, touched_by, linear: false })?;
        // SAFETY: the memory outlives the image: both are retired together, the image destroyed first.
        let bound = unsafe {
            let (memory, offset) = allocation.place();
            device.raw().bind_image_memory(image.raw, memory, offset)
        };
        image.allocation = Some(allocation);
        bound.of_call("vkBindImageMemory", desc.name)?;
        image.create_view(desc)?;
        Ok(image)
    }

    /// An image at an offset of a shared block; the block must be dropped after it.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub(crate) fn placed(device: &Device, desc: ImageDesc<'_>, memory: &Memory, offset: u64) -> Result<Self> {
        let mut image = Self::unbound(device, desc, &desc.placed_info(device))?;
        let (block, start) = memory.raw();
        // SAFETY: the image was just made from this device.
        let needed = unsafe { device.raw().get_image_memory_requirements(image.raw) };
        memory.check_room(desc.name, offset, needed)?;
        // SAFETY: the caller keeps the block until after this image; the place was checked.
        unsafe { device.raw().bind_image_memory(image.raw, block, start + offset) }
            .of_call("vkBindImageMemory", desc.name)?;
        image.create_view(desc)?;
        Ok(image)
    }

    /// Bytes of memory of its own.
    pub fn bytes(&self) -> u64 {
        self.allocation.as_ref().map_or(0, Piece::size)
    }

    /// The raw image.
    pub fn raw(&self) -> vk::Image {
        self.raw
    }

    /// The view of the whole image; null for one that is only copied, which Vulkan gives no view.
    pub fn view(&self) -> vk::ImageView {
        self.view
    }

    /// The format of a pixel.
    pub fn format(&self) -> vk::Format {
        self.format
    }

    /// Width and height in pixels.
    pub fn extent(&self) -> vk::Extent2D {
        self.extent
    }

    /// The image without memory and view: an owner already, so that no failure after it leaks the handle.
    fn unbound(device: &Device, desc: ImageDesc<'_>, info: &vk::ImageCreateInfo<'_>) -> Result<Self> {
        desc.check(device)?;
        // SAFETY: the device is alive; the size is within its limits; it has such images.
        let raw = unsafe { device.raw().create_image(info, None) }.of_call("vkCreateImage", desc.name)?;
        device.set_name(raw, desc.name);
        Ok(Self {
            device: device.clone(),
            raw,
            view: vk::ImageView::null(),
            format: desc.format,
            extent: desc.extent,
            allocation: None,
        })
    }

    fn create_view(&mut self, desc: ImageDesc<'_>) -> Result<()> {
        let copied = vk::ImageUsageFlags::TRANSFER_SRC | vk::ImageUsageFlags::TRANSFER_DST;
        if copied.contains(desc.usage) {
            return Ok(());
        }
        // SAFETY: the image is alive and bound.
        self.view = unsafe { view(&self.device, self.raw, self.format, desc.aspect(), desc.name) }?;
        Ok(())
    }
}

/// Whether a device makes such images, as large as any: of colors that are not compressed, or of depths in 32 bits, so that a view is of their one aspect.
fn is_made(device: &Device, desc: ImageDesc<'_>) -> bool {
    use vk::{FormatFeatureFlags as F, ImageUsageFlags as U};
    let colors = vk::Format::R4G4_UNORM_PACK8..=vk::Format::E5B9G9R9_UFLOAT_PACK32;
    if !colors.contains(&desc.format) && desc.format != vk::Format::D32_SFLOAT {
        return false;
    }
    let (instance, physical) = (device.instance().raw(), device.physical());
    // SAFETY: the device is alive; the format is one of Vulkan 1.0.
    let has = unsafe { instance.get_physical_device_format_properties(physical, desc.format) };
    let usages = [
        (U::TRANSFER_SRC, F::TRANSFER_SRC),
        (U::TRANSFER_DST, F::TRANSFER_DST),
        (U::SAMPLED, F::SAMPLED_IMAGE),
        (U::STORAGE, F::STORAGE_IMAGE),
        (U::COLOR_ATTACHMENT, F::COLOR_ATTACHMENT),
        (U::DEPTH_STENCIL_ATTACHMENT, F::DEPTH_STENCIL_ATTACHMENT),
    ];
    let had = usages.iter().filter(|(_, feature)| has.optimal_tiling_features.contains(*feature));
    let had = had.fold(U::empty(), |had, (usage, _)| had | *usage);
    !desc.usage.is_empty() && had.contains(desc.usage)
}

/// A view of all of an image, and its name.
///
/// # Safety
/// The image is the device's, alive and bound, of this format and aspect.
unsafe fn view(
    device: &Device,
    image: vk::Image,
    format: vk::Format,
    aspect: vk::ImageAspectFlags,
    name: &str,
) -> Result<vk::ImageView> {
    let range = vk::ImageSubresourceRange::default().aspect_mask(aspect).level_count(1).layer_count(1);
    let info = vk::ImageViewCreateInfo::default()
        .image(image)
        .view_type(vk::ImageViewType::TYPE_2D)
        .format(format)
        .subresource_range(range);
    // SAFETY: this function's contract.
    let view = unsafe { device.raw().create_image_view(&info, None) }.of_call("vkCreateImageView", name)?;
    device.set_name(view, name);
    Ok(view)
}

/// As [`view`], of colors.
///
/// # Safety
/// As [`view`].
#[cfg(feature = "view")]
pub(super) unsafe fn color_view(
    device: &Device,
    image: vk::Image,
    format: vk::Format,
    name: &str,
) -> Result<vk::ImageView> {
    // SAFETY: this function's contract.
    unsafe { view(device, image, format, vk::ImageAspectFlags::COLOR, name) }
}

impl Drop for Image {
    fn drop(&mut self) {
        self.device.retire(Retired::Image(self.raw, self.view, self.allocation.take()));
    }
}
