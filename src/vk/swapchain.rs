//! Swapchains: the images that a window shows in turn.

use std::sync::atomic::{AtomicBool, AtomicU64};

use ash::{khr, vk};

use super::{
    device::Device,
    garbage::Retired,
    image::color_view,
    result::VkResultExt,
    semaphore::Semaphore,
    surface::{Surface, SurfaceFacts},
};
use crate::error::{Error, ErrorKind, Result};

/// The images of a window, for one size of it.
pub struct Swapchain {
    device: Device,
    loader: khr::swapchain::Device,
    raw: vk::SwapchainKHR,
    surface: Surface,
    format: vk::Format,
    extent: vk::Extent2D,
    images: Vec<SwapchainImage>,
}

/// One of its images.
pub struct SwapchainImage {
    /// The image; usage `COLOR_ATTACHMENT`.
    pub image: vk::Image,
    /// A view of all of it.
    pub view: vk::ImageView,
    /// Signaled by the submission that draws to it, waited for by its presentation.
    pub drawn: Semaphore,
    /// The submission that drew to it last; 0 before the first.
    pub(super) epoch: AtomicU64,
    /// It is acquired, and the queue has waited for that already.
    pub(super) is_waited_for: AtomicBool,
}

/// What a call to acquire or to present an image came to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn<T> {
    /// It was done.
    Done(T),
    /// It was done, and another swapchain would fit the window better.
    Suboptimal(T),
    /// It was not done: the window has changed, and wants another swapchain.
    OutOfDate,
    /// It was not done: the surface is no more, and the window wants another one.
    SurfaceLost,
}

impl Swapchain {
    /// The images of a surface as large as its window; `None` where that has no pixels, as one that is minimized may have.
    /// `window_px` is the size where the surface leaves that to us. `old`, which shows nothing any more then, makes way for it.
    ///
    /// # Errors
    /// [`ErrorKind::NoDevice`] for a surface of another instance, or one that the device can't draw colors of 8 bits to; whatever the
    /// driver answers.
    pub fn new(
        device: &Device,
        surface: &Surface,
        window_px: [u32; 2],
        old: Option<Self>,
    ) -> Result<Option<Self>> {
        let refused = |reason: &str| -> Error {
            let reason = format!("{}: {reason}", device.facts().name);
            ErrorKind::NoDevice { reasons: vec![reason] }.into()
        };
        if !device.presents_to(surface) {
            return Err(refused("was not opened for this surface"));
        }
        // SAFETY: the device was opened for this surface.
        let SurfaceFacts { capabilities, formats } = unsafe { surface.facts(device.physical()) }?;
        let extent = extent(&capabilities, window_px);
        let side = device.facts().limits.max_image_side;
        if extent.width.min(extent.height) == 0 || extent.width.max(extent.height) > side {
            return Ok(None);
        }
        let format = choose_format(&formats).ok_or_else(|| refused("shows no sRGB colors of 8 bits"))?;
        if !capabilities.supported_usage_flags.contains(vk::ImageUsageFlags::COLOR_ATTACHMENT) {
            return Err(refused("can't draw to the window"));
        }
        // One of another window has nothing to make way for.
        let old = old.filter(|old| {
            old.surface.raw() == surface.raw() && old.device.raw().handle() == device.raw().handle()
        });
        let most = if capabilities.max_image_count == 0 { u32::MAX } else { capabilities.max_image_count };
        let info = vk::SwapchainCreateInfoKHR::default()
            .surface(surface.raw())
            // One more than the least, so that no frame waits for the window system to hand one back.
            .min_image_count(capabilities.min_image_count.saturating_add(1).max(3).min(most))
            .image_format(format.format)
            .image_color_space(format.color_space)
            .image_extent(extent)
            .image_array_layers(1)
            .image_usage(vk::ImageUsageFlags::COLOR_ATTACHMENT)
            .image_sharing_mode(vk::SharingMode::EXCLUSIVE)
            .pre_transform(capabilities.current_transform)
            .composite_alpha(composite_alpha(capabilities.supported_composite_alpha))
            // In the screen's own time, without tearing; every device has it.
            .present_mode(vk::PresentModeKHR::FIFO)
            .clipped(true)
            .old_swapchain(old.as_ref().map_or(vk::SwapchainKHR::null(), |old| old.raw));
        let loader = khr::swapchain::Device::new(device.instance().raw(), device.raw());
        // SAFETY: the surface is alive and of the same instance; the old swapchain is of this surface and device, and alive until the end of this function.
        let raw =
            unsafe { loader.create_swapchain(&info, None) }.of_call("vkCreateSwapchainKHR", "window")?;
        device.set_name(raw, "window");
        let mut made = Self {
            device: device.clone(),
            loader,
            raw,
            surface: surface.clone(),
            format: format.format,
            extent,
            images: Vec::new(),
        };
        // An owner already: what fails from here on leaks nothing.
        made.add_images()?;
        Ok(Some(made))
    }

    fn add_images(&mut self) -> Result<()> {
        // SAFETY: the swapchain is alive.
        let images = unsafe { self.loader.get_swapchain_images(self.raw) }
            .of_call("vkGetSwapchainImagesKHR", "window")?;
        for (number, image) in images.into_iter().enumerate() {
            let name = format!("window image {number}");
            self.device.set_name(image, &name);
            let drawn = Semaphore::new(&self.device, &format!("{name} is drawn"))?;
            // SAFETY: the image is alive as long as the swapchain, which goes after the view.
            let view = unsafe { color_view(&self.device, image, self.format, &name) }?;
            self.images.push(SwapchainImage {
                image,
                view,
                drawn,
                epoch: AtomicU64::new(0),
                is_waited_for: AtomicBool::new(false),
            });
        }
        Ok(())
    }

    /// The format of its images, an sRGB format.
    pub fn format(&self) -> vk::Format {
        self.format
    }

    /// Their width and height in pixels.
    pub fn extent(&self) -> vk::Extent2D {
        self.extent
    }

    /// One of its images.
    pub fn image(&self, index: usize) -> Option<&SwapchainImage> {
        self.images.get(index)
    }

    /// The next image to draw to, free once `acquired` is signaled; waits for it at most a second.
    ///
    /// # Safety
    /// `acquired` is neither signaled nor about to be, and no unfinished submission waits for it. Fewer images are acquired and not
    /// presented than the surface allows (one always may be).
    ///
    /// # Errors
    /// Whatever the driver answers, such as a lost device.
    pub unsafe fn acquire(&self, acquired: &Semaphore) -> Result<Turn<usize>> {
        const MOST_NS: u64 = 1_000_000_000;
        // SAFETY: this function's contract.
        let answer =
            unsafe { self.loader.acquire_next_image(self.raw, MOST_NS, acquired.raw(), vk::Fence::null()) };
        turn(answer.map(|(index, suboptimal)| (index as usize, suboptimal)), "vkAcquireNextImageKHR")
    }

    pub(super) fn raw(&self) -> (&khr::swapchain::Device, vk::SwapchainKHR) {
        (&self.loader, self.raw)
    }
}

impl Drop for Swapchain {
    fn drop(&mut self) {
        for image in self.images.drain(..) {
            self.device.retire(Retired::Image(vk::Image::null(), image.view, None));
        }
        let owner = Box::new((self.loader.clone(), self.surface.clone()));
        self.device.retire(Retired::Swapchain(self.raw, owner));
    }
}

/// Tells what is an event of a window's life from what is an error.
pub(super) fn turn<T>(
    answer: std::result::Result<(T, bool), vk::Result>,
    call: &'static str,
) -> Result<Turn<T>> {
    match answer {
        Ok((value, false)) => Ok(Turn::Done(value)),
        Ok((value, true)) => Ok(Turn::Suboptimal(value)),
        Err(vk::Result::ERROR_OUT_OF_DATE_KHR | vk::Result::NOT_READY | vk::Result::TIMEOUT) => {
            Ok(Turn::OutOfDate)
        }
        Err(vk::Result::ERROR_SURFACE_LOST_KHR) => Ok(Turn::SurfaceLost),
        Err(error) => Err(error).of_call(call, "window"),
    }
}

/// The surface's own size; where it has none, that of the window within its limits.
fn extent(capabilities: &vk::SurfaceCapabilitiesKHR, window_px: [u32; 2]) -> vk::Extent2D {
    let own = capabilities.current_extent;
    if own.width != u32::MAX {
        return own;
    }
    let (least, most) = (capabilities.min_image_extent, capabilities.max_image_extent);
    let [width, height] = window_px;
    vk::Extent2D {
        width: width.min(most.width).max(least.width.min(most.width)),
        height: height.min(most.height).max(least.height.min(most.height)),
    }
}

/// Colors of 8 bits in sRGB, which Vulkan encodes on writing.
fn choose_format(offered: &[vk::SurfaceFormatKHR]) -> Option<vk::SurfaceFormatKHR> {
    let wanted = [vk::Format::B8G8R8A8_SRGB, vk::Format::R8G8B8A8_SRGB, vk::Format::A8B8G8R8_SRGB_PACK32];
    let is_srgb = |offer: &&vk::SurfaceFormatKHR| offer.color_space == vk::ColorSpaceKHR::SRGB_NONLINEAR;
    let find = |format: &vk::Format| offered.iter().filter(is_srgb).find(|offer| offer.format == *format);
    wanted.iter().find_map(find).copied()
}

/// The window hides what is behind it, where that can be chosen.
fn composite_alpha(offered: vk::CompositeAlphaFlagsKHR) -> vk::CompositeAlphaFlagsKHR {
    use vk::CompositeAlphaFlagsKHR as C;
    [C::OPAQUE, C::INHERIT, C::PRE_MULTIPLIED, C::POST_MULTIPLIED]
        .into_iter()
        .find(|alpha| offered.contains(*alpha))
        .unwrap_or(C::OPAQUE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_surface_that_has_a_size_decides_it_and_else_the_window_does_within_limits() {
        let extent_of = |width, height| vk::Extent2D { width, height };
        let mut capabilities = vk::SurfaceCapabilitiesKHR {
            current_extent: extent_of(7, 0),
            min_image_extent: extent_of(2, 2),
            max_image_extent: extent_of(100, 100),
            ..Default::default()
        };
        assert_eq!(extent(&capabilities, [50, 50]), extent_of(7, 0));
        capabilities.current_extent = extent_of(u32::MAX, u32::MAX);
        assert_eq!(extent(&capabilities, [50, 500]), extent_of(50, 100));
        assert_eq!(extent(&capabilities, [0, 1]), extent_of(2, 2));
    }

    #[test]
    fn what_happens_to_windows_is_no_error() {
        assert_eq!(turn(Ok((3, true)), "c").unwrap(), Turn::Suboptimal(3));
        let of = |result| turn::<()>(Err(result), "c");
        assert_eq!(of(vk::Result::ERROR_OUT_OF_DATE_KHR).unwrap(), Turn::OutOfDate);
        assert_eq!(of(vk::Result::ERROR_SURFACE_LOST_KHR).unwrap(), Turn::SurfaceLost);
        assert_eq!(of(vk::Result::ERROR_DEVICE_LOST).unwrap_err().exit_code(), 2);
    }
}
