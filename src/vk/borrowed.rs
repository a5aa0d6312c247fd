//! The device that an embedding host lends.

use ash::vk;

/// Optional features that are enabled on a device.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EnabledFeatures {
    /// Points above one pixel.
    pub large_points: bool,
    /// Counts of vertices and fragments.
    pub pipeline_statistics: bool,
    /// `drawIndirectCount` of Vulkan 1.2, on a device whose `maxDrawIndirectCount` is 2³⁰ at least: without it all layers of `--layers auto` are drawn, the empty ones too.
    pub draw_indirect_count: bool,
    /// `drawIndirectFirstInstance`: without it splats are not drawn by tiles.
    pub first_instance: bool,
}

/// A host's device, for [`Device::borrow`](super::Device::borrow).
pub struct BorrowedDevice {
    /// The physical device.
    pub physical: vk::PhysicalDevice,
    /// The logical device.
    pub raw: ash::Device,
    /// The family of the queue to which the host submits what we record; graphics and compute.
    pub queue_family: u32,
    /// The optional features that the host enabled.
    pub features: EnabledFeatures,
}
