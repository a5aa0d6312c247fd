//! The host's device.

use std::ffi::c_void;

use surfel::{
    ash::vk,
    embed::{Device, Import},
};

use crate::{
    handle::{Out, Place, destroy, get, null},
    memory::{SurfelMemory, memory_of},
    requirements::{PFN_vkGetInstanceProcAddr, check_features, features_of, load_device, load_instance},
    result::{SurfelResult, guard},
    structs::{Struct, SurfelStructureType, read, write},
};

/// A host's device. May be used by several threads at once.
pub struct SurfelDevice(pub Device);

/// A device that a host lends.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelImport {
    /// `SURFEL_STRUCTURE_TYPE_IMPORT`.
    pub s_type: u32,
    /// `sizeof(SurfelImport)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// Of Vulkan 1.3.
    pub instance: vk::Instance,
    /// The physical device.
    pub physical_device: vk::PhysicalDevice,
    /// The device, created with at least what `surfel_requirements` says.
    pub device: vk::Device,
    /// All entry points come from it.
    pub get_instance_proc_addr: PFN_vkGetInstanceProcAddr,
    /// What the host really enabled, of `SURFEL_FEATURE_…`; other bits are refused.
    pub features: u64,
    /// The family of the queue to which the host submits what we record; graphics and compute.
    pub queue_family: u32,
    /// Whether `VK_EXT_debug_utils` is enabled: then all of our objects have names, and our passes labels.
    pub debug_utils: vk::Bool32,
    /// The host's allocator, which all device memory is then taken from; NULL: it is taken from the device, in blocks of 8 to 16 MiB.
    pub memory: *const SurfelMemory,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelImport {
    const TYPE: SurfelStructureType = SurfelStructureType::Import;
}

/// Takes a host's device; what it lacks is named, and the answer then is `SURFEL_RESULT_NO_DEVICE`. All handles must belong together and
/// stay alive until every object made from this device is destroyed; before the last one is, all submissions of commands that were
/// recorded by them must have finished. Then the host's device is as it was.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_device_import(
    host: *const SurfelImport,
    device: *mut *mut SurfelDevice,
) -> SurfelResult {
    guard("surfel_device_import", || {
        // SAFETY: the contract of the header, here and below.
        let (out, host) = unsafe { (Out::new(device, "device")?, read(host, "host")?) };
        check_features(host.features)?;
        if host.physical_device == vk::PhysicalDevice::null() {
            return Err(null("physicalDevice"));
        }
        // SAFETY: as above.
        let instance = unsafe { load_instance(host.get_instance_proc_addr, host.instance) }?;
        // SAFETY: as above.
        let device = unsafe { load_device(&instance, host.device) }?;
        let import = Import {
            instance: &instance,
            debug_utils: host.debug_utils != vk::FALSE,
            physical: host.physical_device,
            device: &device,
            queue_family: host.queue_family,
            enabled: features_of(host.features),
            // SAFETY: as above.
            memory: unsafe { memory_of(host.memory) }?,
        };
        // SAFETY: as above.
        out.give(SurfelDevice(unsafe { Device::import(&import) }?))
    })
}

/// Ends the epoch in which commands were recorded: to be called at each submission that contains our commands; where several threads submit,
/// both are one step. `epoch` gets its number; what is destroyed from now on waits for the next one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_device_end_epoch(
    device: *const SurfelDevice,
    epoch: *mut u64,
) -> SurfelResult {
    guard("surfel_device_end_epoch", || {
        // SAFETY: the contract of the header.
        let (device, epoch) = unsafe { (get(device, "device")?, Place::new(epoch, "epoch")?) };
        epoch.write(device.0.end_epoch());
        Ok(())
    })
}

/// Frees all that was destroyed up to the end of an epoch. The device must have finished every submission up to the one at which
/// `surfel_device_end_epoch` gave `epoch`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_device_epoch_done(device: *const SurfelDevice, epoch: u64) -> SurfelResult {
    guard("surfel_device_epoch_done", || {
        // SAFETY: the contract of the header.
        unsafe { get(device, "device")?.0.epoch_done(epoch) };
        Ok(())
    })
}

/// As `surfel_device_end_epoch`, by the value that the host's own timeline semaphore has once the device has finished the submission. Values rise from call to call, by
/// whichever steps; one that does not is refused, and the epoch goes on.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_device_end_epoch_at(device: *const SurfelDevice, value: u64) -> SurfelResult {
    guard("surfel_device_end_epoch_at", || {
        // SAFETY: the contract of the header.
        Ok(unsafe { get(device, "device")? }.0.end_epoch_at(value)?)
    })
}

/// As `surfel_device_epoch_done`, for all epochs that were ended by this value or one below (`surfel_device_end_epoch_at`): with what `vkGetSemaphoreCounterValue` tells of the host's timeline
/// semaphore.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_device_timeline_at(device: *const SurfelDevice, value: u64) -> SurfelResult {
    guard("surfel_device_timeline_at", || {
        // SAFETY: the contract of the header.
        unsafe { get(device, "device")?.0.timeline_at(value) };
        Ok(())
    })
}

/// Tells how much device memory our objects have: bytes in use, and bytes that are taken from the device for it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_device_memory(
    device: *const SurfelDevice,
    used: *mut u64,
    held: *mut u64,
) -> SurfelResult {
    guard("surfel_device_memory", || {
        // SAFETY: the contract of the header.
        let (device, used, held) =
            unsafe { (get(device, "device")?, Place::new(used, "used")?, Place::new(held, "held")?) };
        used.write(device.0.memory_in_use().0);
        held.write(device.0.memory_held());
        Ok(())
    })
}

/// A heap of a device's memory.
#[repr(C)]
#[derive(Clone, Copy, Default)]
pub struct SurfelMemoryHeap {
    /// How large it is, in bytes.
    pub size: u64,
    /// How many bytes of it the process may have before allocations fail or are moved elsewhere, as the driver has it now; of one that does not tell it, `size`.
    pub budget: u64,
    /// How many bytes of it the process has now, all of its libraries together; of a driver that does not tell it, 0.
    pub usage: u64,
    /// It is the device's own.
    pub is_local: vk::Bool32,
    /// 0.
    pub reserved: u32,
}

/// Device memory: what of it is ours, and what the process may have. `surfel_device_memory_report` fills it.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelMemoryReport {
    /// `SURFEL_STRUCTURE_TYPE_MEMORY_REPORT`.
    pub s_type: u32,
    /// `sizeof(SurfelMemoryReport)`.
    pub size: u32,
    /// NULL.
    pub p_next: *mut c_void,
    /// Bytes of our buffers that only the device touches: splats and meshes, and what frames list and sum in buffers.
    pub buffers: u64,
    /// Bytes of images: what frames sum in images.
    pub images: u64,
    /// Bytes that the host writes: scenes on their way, updates, what a frame is told.
    pub upload: u64,
    /// Bytes that the device writes and the host reads.
    pub readback: u64,
    /// Bytes that lie idle in blocks of ours; 0 with a `SurfelMemory`.
    pub idle: u64,
    /// How many heaps the device has, in Vulkan's order.
    pub heap_count: u32,
    /// Budgets and what is used of them are the driver's (`VK_EXT_memory_budget`, which need not be enabled); else a budget is as large as its heap.
    pub budgets_are_told: vk::Bool32,
    /// The heaps.
    pub heaps: [SurfelMemoryHeap; 16],
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelMemoryReport {
    const TYPE: SurfelStructureType = SurfelStructureType::MemoryReport;
}

/// Tells what device memory is for, and how much the process may have. It takes nothing from the heap.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_device_memory_report(
    device: *const SurfelDevice,
    report: *mut SurfelMemoryReport,
) -> SurfelResult {
    guard("surfel_device_memory_report", || {
        // SAFETY: the contract of the header, here and below.
        let device = &unsafe { get(device, "device") }?.0;
        let (ours, all) = (device.memory_by_use(), device.memory_heaps());
        let mut heaps = [SurfelMemoryHeap::default(); 16];
        for (into, heap) in heaps.iter_mut().zip(all.heaps()) {
            let (usage, is_local) = (heap.usage.unwrap_or(0), heap.is_local.into());
            *into = SurfelMemoryHeap { size: heap.size, budget: heap.budget, usage, is_local, reserved: 0 };
        }
        let value = SurfelMemoryReport {
            s_type: 0,
            size: 0,
            p_next: std::ptr::null_mut(),
            buffers: ours.buffers,
            images: ours.images,
            upload: ours.upload,
            readback: ours.readback,
            idle: ours.idle,
            heap_count: all.heaps().len() as u32,
            budgets_are_told: all.is_told().into(),
            heaps,
        };
        // SAFETY: as above.
        unsafe { write(report, "report", &value) }
    })
}

/// Lets go of a device; NULL is nothing. What was made from it may be destroyed later, and all must be before the host's own device is.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_device_destroy(device: *mut SurfelDevice) {
    // SAFETY: the contract of the header.
    unsafe { destroy("surfel_device_destroy", device) };
}
