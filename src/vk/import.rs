//! The device that an embedding host lends.

use std::sync::Arc;

use ash::vk;

use super::{
    device::{Device, Origin},
    facts::facts,
    features::Features,
    host_memory::HostMemory,
    instance::Instance,
};
use crate::error::{ErrorKind, Result};

/// A host's device, for [`Device::import`].
///
/// ```no_run
/// use surfel::{ash::{self, vk}, embed::{Device, Features, Import}};
///
/// unsafe fn import(instance: &ash::Instance, physical: vk::PhysicalDevice, device: &ash::Device, queue_family: u32) -> surfel::Result<Device> {
///     // As the device was created; all that splats can do without is said at `Features`.
///     let enabled = Features::NEEDED;
///     let host = Import { instance, debug_utils: false, physical, device, queue_family, enabled, memory: None };
///     // SAFETY: this function's contract, that of `import`: all of it is one device's, enabled as said.
///     unsafe { Device::import(&host) }
/// }
/// ```
#[derive(Clone)]
pub struct Import<'a> {
    /// The instance, with its entry points.
    pub instance: &'a ash::Instance,
    /// Whether `VK_EXT_debug_utils` is enabled on it: then all of our objects have names, and our passes labels.
    pub debug_utils: bool,
    /// The physical device.
    pub physical: vk::PhysicalDevice,
    /// The logical device, with its entry points.
    pub device: &'a ash::Device,
    /// The family of the queue to which the host submits what we record; graphics and compute.
    pub queue_family: u32,
    /// What the host really enabled.
    pub enabled: Features,
    /// The host's allocator, which all device memory is then taken from; else it is taken from the device, in blocks of 8 to 16 MiB.
    pub memory: Option<Arc<dyn HostMemory>>,
}

impl Device {
    /// Takes a host's device, which the host destroys after everything of ours is dropped; that leaves it as it is.
    ///
    /// # Safety
    /// All handles must belong together, be of Vulkan 1.3, and stay alive until every object made from this device is dropped; `enabled` and
    /// `debug_utils` are true of them. Before the last of our objects is dropped, all submissions of commands recorded by them must have
    /// finished.
    ///
    /// # Errors
    /// [`ErrorKind::NoDevice`] if the device, what is enabled on it, or the queue's family lacks what we need, by name.
    pub unsafe fn import(host: &Import<'_>) -> Result<Self> {
        // SAFETY: this function's contract.
        let mut facts = unsafe { facts(host.instance, host.physical, Some(host.queue_family)) };
        let mut reasons = facts.refusals();
        reasons.extend(host.enabled.missing().iter().map(|name| format!("{name} is not enabled")));
        if !reasons.is_empty() {
            return Err(ErrorKind::NoDevice { reasons }.into());
        }
        facts.large_points = host.enabled.large_points;
        facts.pipeline_statistics = host.enabled.pipeline_statistics_query;
        facts.independent_blend = host.enabled.independent_blend;
        facts.limits.first_instance = host.enabled.draw_indirect_first_instance;
        facts.draw_indirect_count &= host.enabled.draw_indirect_count;
        if !host.enabled.large_points {
            facts.limits.point_size_range = [1.0, 1.0];
        }
        // SAFETY: this function's contract.
        let instance = unsafe { Instance::borrow(host.instance.clone(), host.debug_utils) };
        let (device, of_host) = (host.device.clone(), (Origin::Host, host.memory.clone()));
        Self::assemble(&instance, host.physical, facts, device, host.queue_family, of_host)
    }
}
