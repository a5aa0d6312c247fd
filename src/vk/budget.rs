//! How much memory a device has, how much of it this process may have, and how much of that is ours.

use ash::vk;

use super::device::Device;

/// Device memory that is taken from the host's allocator or from ours, by what it is for, in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MemoryInUse {
    /// Buffers that only the device touches: splats and meshes, and what frames list and sum in buffers.
    pub buffers: u64,
    /// Images that only the device touches: what frames sum in images.
    pub images: u64,
    /// What the host writes: scenes on their way, the ring of updates, what a frame is told.
    pub upload: u64,
    /// What the device writes and the host reads.
    pub readback: u64,
    /// What lies idle in blocks of ours; of a host's allocator nothing is known of that.
    pub idle: u64,
}

impl MemoryInUse {
    /// All of it: [`Device::memory_held`].
    pub fn total(&self) -> u64 {
        let Self { buffers, images, upload, readback, idle } = self;
        buffers + images + upload + readback + idle
    }
}

/// A heap of a device's memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MemoryHeap {
    /// How large it is, in bytes.
    pub size: u64,
    /// It is the device's own (`DEVICE_LOCAL`).
    pub is_local: bool,
    /// How many bytes of it the process may have before allocations fail or are moved elsewhere, as the driver has it now; of one that does not tell it, the size.
    pub budget: u64,
    /// How many bytes of it the process has now, all of its libraries together; of a driver that does not tell it, `None`.
    pub usage: Option<u64>,
}

/// The heaps of a device's memory, in Vulkan's order.
///
/// ```no_run
/// use surfel::embed::Device;
///
/// /// How many bytes may still be taken of the device's own memory: where the driver does not tell what all have, ours are what is known.
/// fn left(device: &Device) -> u64 {
///     let all = device.memory_heaps();
///     let own = all.heaps().iter().filter(|heap| heap.is_local);
///     own.map(|heap| heap.budget.saturating_sub(heap.usage.unwrap_or_else(|| device.memory_held()))).sum()
/// }
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MemoryHeaps {
    all: [MemoryHeap; vk::MAX_MEMORY_HEAPS],
    count: usize,
    is_told: bool,
}

impl MemoryHeaps {
    /// Each of them.
    pub fn heaps(&self) -> &[MemoryHeap] {
        &self.all[..self.count]
    }

    /// Whether budgets and what is used of them are the driver's (`VK_EXT_memory_budget`); else a budget is as large as its heap.
    pub fn is_told(&self) -> bool {
        self.is_told
    }

    /// What Vulkan answers.
    fn of(
        properties: &vk::PhysicalDeviceMemoryProperties,
        told: Option<&vk::PhysicalDeviceMemoryBudgetPropertiesEXT<'_>>,
    ) -> Self {
        let mut all = [MemoryHeap::default(); vk::MAX_MEMORY_HEAPS];
        for (number, heap) in properties.memory_heaps_as_slice().iter().enumerate() {
            all[number] = MemoryHeap {
                size: heap.size,
                is_local: heap.flags.contains(vk::MemoryHeapFlags::DEVICE_LOCAL),
                budget: told.map_or(heap.size, |told| told.heap_budget[number]),
                usage: told.map(|told| told.heap_usage[number]),
            };
        }
        Self { all, count: properties.memory_heap_count as usize, is_told: told.is_some() }
    }
}

impl Device {
    /// The memory of the device, what this process may have of it and has, as the driver tells it now. A host looks at it before it uploads, and every few frames; it takes nothing from the heap.
    ///
    /// `VK_EXT_memory_budget` need not be enabled for it: that the physical device has it is enough.
    pub fn memory_heaps(&self) -> MemoryHeaps {
        let mut told = vk::PhysicalDeviceMemoryBudgetPropertiesEXT::default();
        let mut properties = vk::PhysicalDeviceMemoryProperties2::default();
        let tells = self.tells_budget();
        if tells {
            properties = properties.push_next(&mut told);
        }
        let (instance, physical) = (self.instance().raw(), self.physical());
        // SAFETY: both are alive; the physical device has the extension of what is asked, which is a query of physical devices.
        unsafe { instance.get_physical_device_memory_properties2(physical, &mut properties) };
        let properties = properties.memory_properties;
        MemoryHeaps::of(&properties, tells.then_some(&told))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heaps_have_the_budget_that_is_told_and_else_their_size() {
        let mut properties =
            vk::PhysicalDeviceMemoryProperties { memory_heap_count: 2, ..Default::default() };
        properties.memory_heaps[0] = vk::MemoryHeap { size: 100, flags: vk::MemoryHeapFlags::DEVICE_LOCAL };
        properties.memory_heaps[1].size = 300;
        let mut told = vk::PhysicalDeviceMemoryBudgetPropertiesEXT::default();
        told.heap_budget[..2].copy_from_slice(&[80, 200]);
        told.heap_usage[..2].copy_from_slice(&[10, 20]);
        let heap = |size, is_local, budget, usage| MemoryHeap { size, is_local, budget, usage };
        let with = MemoryHeaps::of(&properties, Some(&told));
        assert_eq!(with.heaps(), [heap(100, true, 80, Some(10)), heap(300, false, 200, Some(20))]);
        let without = MemoryHeaps::of(&properties, None);
        assert_eq!(without.heaps(), [heap(100, true, 100, None), heap(300, false, 300, None)]);
        assert!(with.is_told() && !without.is_told());
    }
}
