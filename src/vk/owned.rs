//! The owner of a raw handle that needs nothing but its device to be destroyed.

use ash::vk;

use super::{device::Device, garbage::Retired};

/// A raw handle with its device, to which it goes when it is dropped.
pub(super) struct Owned<T: vk::Handle + Copy> {
    pub device: Device,
    pub raw: T,
    retired: fn(T) -> Retired,
}

impl Device {
    /// The owner of a handle that was just made from this device; gives it its debug name.
    pub(super) fn own<T: vk::Handle + Copy>(
        &self,
        raw: T,
        name: &str,
        retired: fn(T) -> Retired,
    ) -> Owned<T> {
        self.set_name(raw, name);
        Owned { device: self.clone(), raw, retired }
    }
}

impl<T: vk::Handle + Copy> Drop for Owned<T> {
    fn drop(&mut self) {
        self.device.retire((self.retired)(self.raw));
    }
}
