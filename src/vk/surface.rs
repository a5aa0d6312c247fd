//! Surfaces: what a window shows images on.

use std::{ffi::CStr, sync::Arc};

use ash::{khr, vk};
use raw_window_handle::{HandleError, HasDisplayHandle, HasWindowHandle};

use super::{instance::Instance, result::VkResultExt, validation::Validation};
use crate::error::{Error, ErrorKind, Result};

/// A window and the display that it is on.
pub trait Window: HasDisplayHandle + HasWindowHandle + Send + Sync {}

impl<T: HasDisplayHandle + HasWindowHandle + Send + Sync> Window for T {}

/// The surface of a window, which it keeps alive; clones share it.
#[derive(Clone)]
pub struct Surface(Arc<Shared>);

struct Shared {
    raw: vk::SurfaceKHR,
    loader: khr::surface::Instance,
    instance: Instance,
    // Dropped after the surface is destroyed (`drop` below runs before any field's).
    _window: Arc<dyn Window>,
}

/// What a device can do with a surface.
pub(super) struct SurfaceFacts {
    pub capabilities: vk::SurfaceCapabilitiesKHR,
    pub formats: Vec<vk::SurfaceFormatKHR>,
}

impl Instance {
    /// As [`Instance::new`], of an instance that can make surfaces on this display.
    ///
    /// # Errors
    /// As [`Instance::new`]; [`ErrorKind::NoDevice`] where the loader has no surfaces of this kind of display.
    pub fn for_display(validation: Validation, display: &dyn HasDisplayHandle) -> Result<Self> {
        let handle = display.display_handle().map_err(no_handle)?;
        let names = ash_window::enumerate_required_extensions(handle.as_raw())
            .of_call("vkCreateInstance", "surfaces of this display")?;
        // SAFETY: the names are constants of ash, each with a zero byte at its end.
        let names: Vec<&CStr> = names.iter().map(|name| unsafe { CStr::from_ptr(*name) }).collect();
        Self::with_extensions(validation, &names, Arc::default())
    }
}

impl Surface {
    /// The surface of a window, for an instance of [`Instance::for_display`].
    ///
    /// # Errors
    /// [`ErrorKind::NoDevice`] for a host's instance, or a window without a handle; whatever the driver answers.
    pub fn new(instance: &Instance, window: Arc<dyn Window>) -> Result<Self> {
        let Some(entry) = instance.entry() else {
            let reason = "surfaces are for an instance that was made for a display".to_owned();
            return Err(ErrorKind::NoDevice { reasons: vec![reason] }.into());
        };
        let raw = {
            let display = window.display_handle().map_err(no_handle)?.as_raw();
            let handle = window.window_handle().map_err(no_handle)?.as_raw();
            // SAFETY: both handles are of a window that lives as long as the surface; the instance was made for a display. One of another
            // kind has no such function, in whose place ash ends the program.
            unsafe { ash_window::create_surface(entry, instance.raw(), display, handle, None) }
                .of_call("vkCreateSurfaceKHR", "window")?
        };
        let loader = khr::surface::Instance::new(entry, instance.raw());
        Ok(Self(Arc::new(Shared { raw, loader, instance: instance.clone(), _window: window })))
    }

    /// The instance that it was made by.
    pub(super) fn instance(&self) -> &Instance {
        &self.0.instance
    }

    pub(super) fn raw(&self) -> vk::SurfaceKHR {
        self.0.raw
    }

    /// Whether queues of a family of this device can present to it.
    ///
    /// # Safety
    /// The device was enumerated from the surface's instance, and has such a family.
    pub(super) unsafe fn is_served_by(&self, device: vk::PhysicalDevice, family: u32) -> bool {
        // SAFETY: this function's contract.
        unsafe { self.0.loader.get_physical_device_surface_support(device, family, self.0.raw) }
            .unwrap_or(false)
    }

    /// What a device can do with it now.
    ///
    /// # Safety
    /// The device was enumerated from the surface's instance, and serves it.
    pub(super) unsafe fn facts(&self, device: vk::PhysicalDevice) -> Result<SurfaceFacts> {
        let Shared { loader, raw, .. } = &*self.0;
        // SAFETY: this function's contract, for both calls.
        unsafe {
            Ok(SurfaceFacts {
                capabilities: loader
                    .get_physical_device_surface_capabilities(device, *raw)
                    .of_call("vkGetPhysicalDeviceSurfaceCapabilitiesKHR", "window")?,
                formats: loader
                    .get_physical_device_surface_formats(device, *raw)
                    .of_call("vkGetPhysicalDeviceSurfaceFormatsKHR", "window")?,
            })
        }
    }
}

impl Drop for Shared {
    fn drop(&mut self) {
        // SAFETY: swapchains hold a clone of the `Arc` around this, so none is left.
        unsafe { self.loader.destroy_surface(self.raw, None) };
    }
}

fn no_handle(error: HandleError) -> Error {
    ErrorKind::NoDevice { reasons: vec![format!("the window can't be drawn to: {error}")] }.into()
}
