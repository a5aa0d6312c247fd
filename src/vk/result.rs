//! Raw Vulkan results become errors that name the call and the object.

use ash::vk;

use crate::error::{Error, Result};

/// Adds call and object to a raw Vulkan result.
pub trait VkResultExt<T> {
    /// The value, or [`crate::error::ErrorKind::Vulkan`] with the call's name and the object's debug name.
    ///
    /// # Errors
    /// Whatever the driver answered.
    fn of_call(self, call: &'static str, object: &str) -> Result<T>;
}

impl<T> VkResultExt<T> for std::result::Result<T, vk::Result> {
    fn of_call(self, call: &'static str, object: &str) -> Result<T> {
        self.map_err(|result| Error::vulkan(call, object, result))
    }
}
