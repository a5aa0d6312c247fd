//! The images of a window, made anew where it has changed, and its surface, where that is lost.

use std::sync::Arc;

use ash::vk;
use surfel::{
    Error, ErrorKind, Result,
    vk::{Surface, Swapchain},
};

use super::{
    super::{frame_desc::Drawn, overlay::OverlayPass, show::Show},
    Drawing, Gpu,
};

impl Gpu {
    /// The size of its images, as far as is known.
    pub fn window_px(&self) -> [u32; 2] {
        self.window_px
    }

    /// The window has this size now.
    pub fn resize(&mut self, window_px: [u32; 2]) {
        if self.window_px != window_px {
            (self.window_px, self.fits) = (window_px, false);
        }
    }

    /// Whether the window has images to draw to, made anew where it has changed.
    ///
    /// # Errors
    /// Whatever the driver answers, such as a lost device.
    pub fn make_images(&mut self) -> Result<bool> {
        if self.fits && self.swapchain.is_some() {
            return Ok(true);
        }
        // SAFETY: nothing is being recorded now.
        unsafe { self.headless.queue().wait_idle() }?;
        let old = self.swapchain.take();
        let made = Swapchain::new(self.headless.device(), &self.surface, self.window_px, old);
        self.swapchain = match made {
            Err(error) if is_surface_lost(&error) => {
                self.renew_surface()?;
                Swapchain::new(self.headless.device(), &self.surface, self.window_px, None)?
            }
            made => made?,
        };
        let device = self.headless.device();
        let Some(swapchain) = &self.swapchain else { return Ok(false) };
        let vk::Extent2D { width, height } = swapchain.extent();
        (self.window_px, self.fits) = ([width, height], true);
        let format = swapchain.format();
        if self.drawing.as_ref().is_none_or(|drawing| drawing.format != format) {
            let show = Show::new(device, format)?;
            let before = self.drawing.take().map(|drawing| drawing.overlay);
            let overlay = OverlayPass::new(device, &self.cache, format, before)?;
            self.drawing = Some(Drawing { format, show, overlay });
        }
        Ok(true)
    }

    /// The window wants other images; and another surface, where that is lost.
    pub(super) fn again(&mut self, is_lost: bool) -> Result<Drawn> {
        self.fits = false;
        if is_lost {
            self.renew_surface()?;
        }
        Ok(Drawn::Again)
    }

    /// Another surface of the same window.
    fn renew_surface(&mut self) -> Result<()> {
        self.swapchain = None;
        // SAFETY: nothing is being recorded now.
        unsafe { self.headless.queue().wait_idle() }?;
        self.surface = Surface::new(self.headless.device().instance(), Arc::clone(&self.window))?;
        Ok(())
    }

    /// Gives the window up, for another device: its surface. This one is lost.
    pub fn leave(&mut self) -> Surface {
        // Windows have one swapchain at a time.
        self.swapchain = None;
        // SAFETY: what was recorded and is not submitted never will be.
        let _ = unsafe { self.headless.queue().wait_idle() };
        self.surface.clone()
    }
}

fn is_surface_lost(error: &Error) -> bool {
    matches!(error.kind(), ErrorKind::Vulkan { result: vk::Result::ERROR_SURFACE_LOST_KHR, .. })
}
