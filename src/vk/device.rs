//! The logical device, owned or borrowed, with its allocator and its deferred destruction.

use std::sync::{
    Arc, Mutex, MutexGuard, PoisonError,
    atomic::{AtomicBool, AtomicU64, Ordering},
};

use ash::{ext, vk};
use gpu_allocator::vulkan::{Allocator, AllocatorCreateDesc};

use super::{
    choose::{DeviceFacts, choose},
    facts::{all_facts, check_executables, has_extension},
    garbage::{Garbage, Retired},
    host_memory::{HostMemory, Source},
    host_timeline::HostTimeline,
    instance::Instance,
    requirements::offered,
    result::VkResultExt,
    uploads::Uploads,
    wanted::Wanted,
};
use crate::error::{ErrorKind, Result};

/// A logical device; clones share it. See [the module](super) for how things die, and [`Device::end_epoch_at`] for an example.
#[derive(Clone)]
pub struct Device(pub(super) Arc<Shared>);

pub(super) struct Shared {
    raw: ash::Device,
    instance: Instance,
    physical: vk::PhysicalDevice,
    facts: DeviceFacts,
    queue_family: u32,
    names: Option<ext::debug_utils::Device>,
    /// The epoch in which commands are being recorded now: one more than the last submission's.
    epoch: AtomicU64,
    /// All epochs up to this one are done.
    done: AtomicU64,
    // `None` only while `drop` runs. Locked together, so that there is one order of locks.
    memory: Mutex<Option<(Source, Garbage)>>,
    pub(super) uploads: Uploads,
    pub(super) timeline: HostTimeline,
    /// Whether a [`super::Queue`] counts the epochs; a host does so for a borrowed device.
    queue_taken: AtomicBool,
    origin: Origin,
    /// The physical device has `VK_EXT_memory_budget`.
    tells_budget: bool,
}

/// The epoch before the first submission.
const FIRST_EPOCH: u64 = 1;

/// Whose device it is, and what more it can be asked.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Origin {
    /// It is destroyed with us.
    Ours { executables: bool, presents: bool },
    /// The host destroys it.
    Host,
}

impl Device {
    /// Opens the device asked for (see [`choose`]) with one queue of graphics and compute.
    ///
    /// # Errors
    /// As [`choose`], or whatever the driver answers.
    pub fn new(instance: &Instance, asked: Option<&str>) -> Result<Self> {
        Self::open(instance, asked, Wanted::default())
    }

    /// As [`Device::new`], of the devices that can present to a surface.
    ///
    /// # Errors
    /// As [`Device::new`]; where none presents to the surface, for each the reason.
    #[cfg(feature = "view")]
    pub fn for_surface(surface: &super::Surface, asked: Option<&str>) -> Result<Self> {
        Self::open(surface.instance(), asked, Wanted { executables: false, surface: Some(surface) })
    }

    pub(super) fn open(instance: &Instance, asked: Option<&str>, wanted: Wanted<'_>) -> Result<Self> {
        let executables = wanted.executables;
        let mut all = all_facts(instance)?;
        wanted.refuse(&mut all);
        let facts: Vec<_> = all.iter().map(|(_, facts)| facts.clone()).collect();
        let (physical, facts) = all.swap_remove(choose(&facts, asked)?);
        let Some(queue_family) = facts.queue_family else {
            return Err(ErrorKind::NoDevice { reasons: facts.refusals() }.into());
        };
        if executables {
            check_executables(instance, physical, &facts)?;
        }
        let features = offered(&facts);
        let mut features10 = vk::PhysicalDeviceFeatures2::default().features(features.core());
        // Our own queue counts by it.
        let mut features12 = features.vulkan12().timeline_semaphore(true);
        let mut features13 = features.vulkan13();
        let mut executable_info = vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR::default()
            .pipeline_executable_info(true);
        let extensions = wanted.extensions();
        let queues =
            [vk::DeviceQueueCreateInfo::default().queue_family_index(queue_family).queue_priorities(&[1.0])];
        let mut info = vk::DeviceCreateInfo::default()
            .queue_create_infos(&queues)
            .push_next(&mut features10)
            .push_next(&mut features12)
            .push_next(&mut features13);
        info = info.enabled_extension_names(&extensions);
        if executables {
            info = info.push_next(&mut executable_info);
        }
        // SAFETY: `physical` was enumerated from this instance and offers all that is enabled here.
        let raw = unsafe { instance.raw().create_device(physical, &info, None) }
            .of_call("vkCreateDevice", &facts.name)?;
        let origin = Origin::Ours { executables, presents: wanted.surface.is_some() };
        Self::assemble(instance, physical, facts, raw, queue_family, (origin, None))
    }

    pub(super) fn assemble(
        instance: &Instance,
        physical: vk::PhysicalDevice,
        facts: DeviceFacts,
        raw: ash::Device,
        queue_family: u32,
        (origin, memory): (Origin, Option<Arc<dyn HostMemory>>),
    ) -> Result<Self> {
        let owned = origin != Origin::Host;
        let source = match memory {
            Some(host) => Source::host(host),
            None => match Allocator::new(&AllocatorCreateDesc {
                instance: instance.raw().clone(),
                device: raw.clone(),
                physical_device: physical,
                debug_settings: gpu_allocator::AllocatorDebugSettings::default(),
                buffer_device_address: false,
                allocation_sizes: block_sizes(),
            }) {
                Ok(allocator) => Source::ours(allocator),
                Err(error) => {
                    if owned {
                        // SAFETY: just created, used by nobody.
                        unsafe { raw.destroy_device(None) };
                    }
                    let (object, reason) = (facts.name.clone(), error.to_string());
                    return Err(ErrorKind::Memory { object, bytes: 0, reason }.into());
                }
            },
        };
        let names = instance.has_debug_utils().then(|| ext::debug_utils::Device::new(instance.raw(), &raw));
        Ok(Self(Arc::new(Shared {
            raw,
            instance: instance.clone(),
            physical,
            facts,
            queue_family,
            names,
            epoch: AtomicU64::new(FIRST_EPOCH),
            done: AtomicU64::new(FIRST_EPOCH - 1),
            memory: Mutex::new(Some((source, Garbage::default()))),
            uploads: Uploads::default(),
            timeline: HostTimeline::default(),
            queue_taken: AtomicBool::new(!owned),
            origin,
            // SAFETY: both are alive and belong together.
            tells_budget: unsafe { has_extension(instance.raw(), physical, ext::memory_budget::NAME) },
        })))
    }

    /// Whether this is a clone of that one.
    pub(crate) fn is(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }

    /// Whose device it is.
    pub(super) fn origin(&self) -> Origin {
        self.0.origin
    }

    /// The raw device.
    pub fn raw(&self) -> &ash::Device {
        &self.0.raw
    }

    /// The instance it was made from.
    pub fn instance(&self) -> &Instance {
        &self.0.instance
    }

    /// The physical device.
    pub fn physical(&self) -> vk::PhysicalDevice {
        self.0.physical
    }

    /// The device and what it can do: of optional features, those that are enabled.
    pub fn facts(&self) -> &DeviceFacts {
        &self.0.facts
    }

    pub(super) fn tells_budget(&self) -> bool {
        self.0.tells_budget
    }

    /// The family of the one queue that is used.
    pub fn queue_family(&self) -> u32 {
        self.0.queue_family
    }

    /// Names and labels for people, where the extension is enabled.
    pub(super) fn debug_utils(&self) -> Option<&ext::debug_utils::Device> {
        self.0.names.as_ref()
    }

    /// Ends the epoch in which commands were recorded and returns its number. Whoever submits (our queue, or the embedding host once per submission that contains our commands) calls it at the submission.
    pub fn end_epoch(&self) -> u64 {
        self.0.epoch.fetch_add(1, Ordering::AcqRel)
    }

    /// The epoch in which commands are recorded now.
    pub(crate) fn epoch(&self) -> u64 {
        self.0.epoch.load(Ordering::Acquire)
    }

    /// The last epoch that is done, with all before it.
    pub(crate) fn epochs_done(&self) -> u64 {
        self.0.done.load(Ordering::Acquire)
    }

    /// Destroys all that was dropped up to the end of an epoch.
    ///
    /// # Safety
    /// The device has finished every submission up to the one whose [`Device::end_epoch`] gave `epoch`.
    pub unsafe fn epoch_done(&self, epoch: u64) {
        self.0.done.fetch_max(epoch, Ordering::AcqRel);
        self.0.uploads.let_go();
        if let Some((allocator, garbage)) = self.memory().as_mut() {
            // SAFETY: this function's contract.
            unsafe { garbage.collect(epoch, &self.0.raw, allocator) };
        }
    }

    /// Whether something that was dropped is destroyed once an epoch is done.
    pub(super) fn frees_at(&self, epoch: u64) -> bool {
        self.memory().as_ref().is_some_and(|(_, garbage)| garbage.has(epoch))
    }

    /// Whether the queue was free; it is taken now.
    pub(super) fn take_queue(&self) -> bool {
        !self.0.queue_taken.swap(true, Ordering::AcqRel)
    }

    /// Frees the queue for another owner.
    pub(super) fn free_queue(&self) {
        self.0.queue_taken.store(false, Ordering::Release);
    }

    /// Hands a raw object over, to be destroyed once the epoch that is being recorded now is done.
    pub(super) fn retire(&self, object: Retired) {
        if let Some((_, garbage)) = self.memory().as_mut() {
            // Read under the lock, so that epochs enter the queue in order.
            garbage.push(self.0.epoch.load(Ordering::Acquire), object);
        }
    }

    pub(super) fn memory(&self) -> MutexGuard<'_, Option<(Source, Garbage)>> {
        self.0.memory.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Shared {
    fn drop(&mut self) {
        // Every object holds a clone of the `Arc` around this, so all of them are retired by now.
        // A lost device answers with an error and is idle all the same. For a borrowed device the host's
        // contract says that its submissions have finished.
        let owned = self.origin != Origin::Host;
        // Where nothing was submitted there is nothing to wait for; RADV without hardware crashes in this call.
        if owned && *self.epoch.get_mut() > FIRST_EPOCH {
            // SAFETY: the device is alive.
            let _ = unsafe { self.raw.device_wait_idle() };
        }
        let memory = self.memory.get_mut().unwrap_or_else(PoisonError::into_inner);
        if let Some((mut allocator, mut garbage)) = memory.take() {
            // SAFETY: the device is idle.
            unsafe { garbage.collect(u64::MAX, &self.raw, &mut allocator) };
            drop(allocator);
        }
        if owned {
            // SAFETY: all children are destroyed.
            unsafe { self.raw.destroy_device(None) };
        }
    }
}

/// How much device memory is taken at once. What is larger than a block gets memory of its own, of its exact size; so a block is what may lie idle beside it, and the crate's own 256 MiB would be six times the memory of a million splats.
fn block_sizes() -> gpu_allocator::AllocationSizes {
    const FIRST_BYTES: u64 = 8 << 20;
    const MOST_BYTES: u64 = 16 << 20;
    gpu_allocator::AllocationSizes::new(FIRST_BYTES, FIRST_BYTES)
        .with_max_device_memblock_size(MOST_BYTES)
        .with_max_host_memblock_size(MOST_BYTES)
}
