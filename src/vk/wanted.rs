//! What a device is asked for beside what every frame needs.

use ash::{khr, vk};

use super::choose::DeviceFacts;

/// Optional parts of a device.
#[derive(Clone, Copy, Default)]
pub(super) struct Wanted<'a> {
    /// It tells what it makes of pipelines.
    pub executables: bool,
    /// It presents to this.
    pub surface: Option<&'a PresentedTo>,
}

#[cfg(feature = "view")]
type PresentedTo = super::Surface;
/// Nothing is, without windows.
#[cfg(not(feature = "view"))]
type PresentedTo = std::convert::Infallible;

impl Wanted<'_> {
    /// The extensions that have it.
    pub fn extensions(&self) -> Vec<*const std::ffi::c_char> {
        let all = [
            (self.executables, khr::pipeline_executable_properties::NAME),
            (self.surface.is_some(), khr::swapchain::NAME),
        ];
        all.iter().filter(|(is_wanted, _)| *is_wanted).map(|(_, name)| name.as_ptr()).collect()
    }

    /// Adds to the facts of devices what they lack for it.
    #[cfg(feature = "view")]
    pub fn refuse(&self, all: &mut [(vk::PhysicalDevice, DeviceFacts)]) {
        let Some(surface) = self.surface else { return };
        for (physical, facts) in all {
            let instance = surface.instance().raw();
            // SAFETY: the device was enumerated from the surface's instance.
            let offers = unsafe { super::facts::has_extension(instance, *physical, khr::swapchain::NAME) };
            // SAFETY: as above; the family is one of the device's.
            let serves = |family: u32| unsafe { surface.is_served_by(*physical, family) };
            if !(offers && facts.queue_family.is_some_and(serves)) {
                facts.missing.push("presenting to this window".to_owned());
            }
        }
    }

    /// As there is nothing to present to, nothing is missing.
    #[cfg(not(feature = "view"))]
    pub fn refuse(&self, _all: &mut [(vk::PhysicalDevice, DeviceFacts)]) {}
}

#[cfg(feature = "view")]
impl super::Device {
    /// Whether it was opened for surfaces, and serves this one.
    pub(super) fn presents_to(&self, surface: &super::Surface) -> bool {
        let presents = matches!(self.origin(), super::device::Origin::Ours { presents: true, .. });
        let is_of_instance = surface.instance().raw().handle() == self.instance().raw().handle();
        // SAFETY: just checked; the family is one of the device's.
        let serves = || unsafe { surface.is_served_by(self.physical(), self.queue_family()) };
        presents && is_of_instance && serves()
    }
}
