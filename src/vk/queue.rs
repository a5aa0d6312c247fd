//! Our own queue with its timeline: each submission counts it up by one epoch.

use std::sync::{
    Mutex, PoisonError,
    atomic::{AtomicU64, Ordering},
};

use ash::vk;

use super::{commands::CommandPool, device::Device, garbage::Retired, result::VkResultExt};
#[cfg(feature = "view")]
use super::{semaphore::Semaphore, swapchain::SwapchainImage};
use crate::error::{Error, Result};

/// The one queue of an owned device. An embedding host has its own and needs none of this.
pub struct Queue {
    device: Device,
    raw: Mutex<vk::Queue>,
    timeline: vk::Semaphore,
    submitted: AtomicU64,
    /// Up to which epoch validation was told that all is done.
    told: AtomicU64,
}

/// All stages of ours that read or write; best-practices validation wants them by name.
const ALL_STAGES: vk::PipelineStageFlags2 = {
    use vk::PipelineStageFlags2 as Stages;
    let graphics = Stages::DRAW_INDIRECT.as_raw()
        | Stages::VERTEX_SHADER.as_raw()
        | Stages::FRAGMENT_SHADER.as_raw()
        | Stages::EARLY_FRAGMENT_TESTS.as_raw()
        | Stages::LATE_FRAGMENT_TESTS.as_raw()
        | Stages::COLOR_ATTACHMENT_OUTPUT.as_raw();
    Stages::from_raw(graphics | Stages::COMPUTE_SHADER.as_raw() | Stages::TRANSFER.as_raw())
};

/// Records that all commands before are done before any that follows begins.
///
/// # Safety
/// `commands` is recording outside of rendering.
pub(crate) unsafe fn wait_for_all(device: &Device, commands: vk::CommandBuffer) {
    let barrier = [vk::MemoryBarrier2::default()
        .src_stage_mask(ALL_STAGES)
        .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
        .dst_stage_mask(ALL_STAGES)
        .dst_access_mask(vk::AccessFlags2::MEMORY_READ | vk::AccessFlags2::MEMORY_WRITE)];
    let info = vk::DependencyInfo::default().memory_barriers(&barrier);
    // SAFETY: this function's contract.
    unsafe { device.raw().cmd_pipeline_barrier2(commands, &info) };
}

impl Queue {
    /// The first queue of the device's family. At most one `Queue` may exist for a device at a time: its lock is what
    /// keeps submissions apart, and its timeline what tells which epochs are done.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for a borrowed device, whose queue is the host's, and for a second `Queue`;
    /// whatever the driver answers.
    pub fn new(device: &Device) -> Result<Self> {
        if !device.take_queue() {
            let problem = "the device's queue belongs to its host, or to another owner already";
            return Err(Error::option("queue", problem));
        }
        Self::with_timeline(device).inspect_err(|_| device.free_queue())
    }

    fn with_timeline(device: &Device) -> Result<Self> {
        // SAFETY: the device was made with one queue of this family.
        let raw = unsafe { device.raw().get_device_queue(device.queue_family(), 0) };
        device.set_name(raw, "queue");
        let mut kind = vk::SemaphoreTypeCreateInfo::default().semaphore_type(vk::SemaphoreType::TIMELINE);
        let info = vk::SemaphoreCreateInfo::default().push_next(&mut kind);
        // SAFETY: the device is alive, timelineSemaphore is enabled.
        let timeline =
            unsafe { device.raw().create_semaphore(&info, None) }.of_call("vkCreateSemaphore", "timeline")?;
        device.set_name(timeline, "timeline");
        Ok(Self {
            device: device.clone(),
            raw: Mutex::new(raw),
            timeline,
            submitted: AtomicU64::new(0),
            told: AtomicU64::new(0),
        })
    }

    /// Submits a recorded command buffer and returns its epoch, to [wait](Self::wait) for.
    ///
    /// # Safety
    /// `commands` is recorded and belongs to the device, and all that it uses is alive until the epoch is done.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub unsafe fn submit(&self, commands: vk::CommandBuffer) -> Result<u64> {
        // SAFETY: this function's contract.
        unsafe { self.submit_with(commands, &[], None) }
    }

    /// Before anything is recorded that draws to an image of a window: waits until it is free, where validation was told since it was drawn to last that all is done. Layers of 1.3.239
    /// take from an image that is acquired again what its submission before has accessed, even where the queue was idle since and others have that memory now. A barrier over all does
    /// not end that, for they take what follows for unsafe where it names no access; an idle queue does. Nothing without validation.
    ///
    /// # Safety
    /// As [`Queue::submit_for_window`], which comes next for this image.
    ///
    /// # Errors
    /// Whatever the driver answers.
    #[cfg(feature = "view")]
    pub unsafe fn tell_acquired(&self, acquired: &Semaphore, image: &SwapchainImage) -> Result<()> {
        let before = image.epoch.load(Ordering::Acquire);
        if before == 0 || before > self.told.load(Ordering::Acquire) {
            return Ok(());
        }
        let waits = [acquired.before_colors()];
        let info = [vk::SubmitInfo2::default().wait_semaphore_infos(&waits)];
        let queue = self.raw.lock().unwrap_or_else(PoisonError::into_inner);
        // SAFETY: this function's contract; the lock synchronizes the queue.
        unsafe { self.device.raw().queue_submit2(*queue, &info, vk::Fence::null()) }
            .of_call("vkQueueSubmit2", "queue")?;
        image.is_waited_for.store(true, Ordering::Release);
        // SAFETY: as above.
        unsafe { self.device.raw().queue_wait_idle(*queue) }.of_call("vkQueueWaitIdle", "queue")?;
        self.told.store(self.submitted.load(Ordering::Acquire), Ordering::Release);
        Ok(())
    }

    /// Submits between the acquisition of a window's image and its presentation: colors are written once `acquired` is signaled, and
    /// the image's `drawn` is signaled at the end.
    ///
    /// # Safety
    /// As [`Queue::submit`]; `acquired` is signaled or about to be, and nothing else waits for it; `drawn` is waited for by nothing but the
    /// presentation that follows, and neither signaled nor about to be.
    ///
    /// # Errors
    /// Whatever the driver answers.
    #[cfg(feature = "view")]
    pub unsafe fn submit_for_window(
        &self,
        commands: vk::CommandBuffer,
        acquired: &Semaphore,
        image: &SwapchainImage,
    ) -> Result<u64> {
        let waits = [acquired.before_colors()];
        let waits = if image.is_waited_for.swap(false, Ordering::AcqRel) { &[][..] } else { &waits[..] };
        // SAFETY: this function's contract.
        let epoch = unsafe { self.submit_with(commands, waits, Some(image.drawn.raw())) }?;
        image.epoch.store(epoch, Ordering::Release);
        Ok(epoch)
    }

    /// Presents an image of a window once it is drawn.
    ///
    /// # Safety
    /// The image was acquired and is not presented yet; a submission that signals its `drawn` came before.
    ///
    /// # Errors
    /// Whatever the driver answers, such as a lost device.
    #[cfg(feature = "view")]
    pub unsafe fn present(&self, swapchain: &super::Swapchain, index: usize) -> Result<super::Turn<()>> {
        let (loader, raw) = swapchain.raw();
        let Some(image) = swapchain.image(index) else {
            return Err(Error::option("window image", format!("{index}: there is none of this number")));
        };
        let (semaphores, swapchains, indices) = ([image.drawn.raw()], [raw], [index as u32]);
        let info = vk::PresentInfoKHR::default()
            .wait_semaphores(&semaphores)
            .swapchains(&swapchains)
            .image_indices(&indices);
        let queue = self.raw.lock().unwrap_or_else(PoisonError::into_inner);
        // SAFETY: this function's contract; the lock synchronizes the queue.
        let answer = unsafe { loader.queue_present(*queue, &info) };
        super::swapchain::turn(answer.map(|suboptimal| ((), suboptimal)), "vkQueuePresentKHR")
    }

    /// # Safety
    /// As [`Queue::submit`]; the semaphores are as Vulkan wants them for a submission.
    unsafe fn submit_with(
        &self,
        commands: vk::CommandBuffer,
        waits: &[vk::SemaphoreSubmitInfo<'_>],
        signaled: Option<vk::Semaphore>,
    ) -> Result<u64> {
        let queue = self.raw.lock().unwrap_or_else(PoisonError::into_inner);
        let epoch = self.device.end_epoch();
        let buffers = [vk::CommandBufferSubmitInfo::default().command_buffer(commands)];
        let all = vk::PipelineStageFlags2::ALL_COMMANDS;
        let timeline =
            vk::SemaphoreSubmitInfo::default().semaphore(self.timeline).value(epoch).stage_mask(all);
        let others = signaled.map(|raw| vk::SemaphoreSubmitInfo::default().semaphore(raw).stage_mask(all));
        let signals: Vec<_> = std::iter::once(timeline).chain(others).collect();
        let info = vk::SubmitInfo2::default()
            .wait_semaphore_infos(waits)
            .command_buffer_infos(&buffers)
            .signal_semaphore_infos(&signals);
        // SAFETY: this function's contract; the lock synchronizes the queue.
        unsafe { self.device.raw().queue_submit2(*queue, &[info], vk::Fence::null()) }
            .of_call("vkQueueSubmit2", "queue")?;
        self.submitted.store(epoch, Ordering::Release);
        Ok(epoch)
    }

    /// Whether an epoch is done.
    ///
    /// # Errors
    /// Whatever the driver answers, such as a lost device.
    pub fn is_done(&self, epoch: u64) -> Result<bool> {
        // SAFETY: the semaphore is alive.
        let reached = unsafe { self.device.raw().get_semaphore_counter_value(self.timeline) };
        Ok(reached.of_call("vkGetSemaphoreCounterValue", "timeline")? >= epoch)
    }

    /// Waits until an epoch is done, then destroys what was dropped up to it.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for an epoch that was not submitted; whatever the driver answers, such as a lost
    /// device.
    pub fn wait(&self, epoch: u64) -> Result<()> {
        let submitted = self.submitted.load(Ordering::Acquire);
        if epoch > submitted {
            let problem = format!("{epoch} is not submitted yet, {submitted} was the last");
            return Err(Error::option("epoch", problem));
        }
        let (semaphores, values) = ([self.timeline], [epoch]);
        let info = vk::SemaphoreWaitInfo::default().semaphores(&semaphores).values(&values);
        // SAFETY: the semaphore is alive. Its values reach `epoch`, for that or a later one was submitted.
        unsafe { self.device.raw().wait_semaphores(&info, u64::MAX) }
            .of_call("vkWaitSemaphores", "timeline")?;
        let is_last = epoch == self.submitted.load(Ordering::Acquire);
        if self.device.instance().is_validated() && (is_last || self.device.frees_at(epoch)) {
            // Layers of 1.3.239 don't follow timeline semaphores when they look for hazards across submits. Of what was submitted last the
            // queue is idle already, and memory that others get from now on is not in use any more; this tells them.
            let queue = self.raw.lock().unwrap_or_else(PoisonError::into_inner);
            // SAFETY: the lock synchronizes the queue.
            unsafe { self.device.raw().queue_wait_idle(*queue) }.of_call("vkQueueWaitIdle", "queue")?;
            self.told.store(self.submitted.load(Ordering::Acquire), Ordering::Release);
        }
        // SAFETY: the timeline counts every submission of this device in order.
        unsafe { self.device.epoch_done(epoch) };
        Ok(())
    }

    /// Waits for all that was submitted, then destroys all that was dropped so far: a device without a next frame
    /// would keep it. A device that is lost executes nothing any more, so that this holds for it, too, before the error is told.
    ///
    /// # Safety
    /// Nothing that was dropped is used by commands that are recorded and not submitted yet.
    ///
    /// # Errors
    /// Whatever the driver answers, such as a lost device.
    pub unsafe fn wait_idle(&self) -> Result<()> {
        let waited = self.wait(self.submitted.load(Ordering::Acquire));
        let queue = self.raw.lock().unwrap_or_else(PoisonError::into_inner);
        // SAFETY: the lock synchronizes the queue.
        let idle = unsafe { self.device.raw().queue_wait_idle(*queue) };
        if matches!(idle, Ok(()) | Err(vk::Result::ERROR_DEVICE_LOST)) {
            // SAFETY: under the lock nothing was submitted since; the rest is this function's contract.
            unsafe { self.device.epoch_done(self.device.end_epoch()) };
        }
        waited?;
        idle.of_call("vkQueueWaitIdle", "queue")
    }

    /// Waits for all that was submitted so far; at once where that is done.
    ///
    /// # Errors
    /// As [`Queue::wait`].
    pub fn wait_submitted(&self) -> Result<()> {
        match self.submitted.load(Ordering::Acquire) {
            0 => Ok(()),
            epoch => self.wait(epoch),
        }
    }

    /// Records, submits and waits: for work that is done once.
    ///
    /// # Errors
    /// What `record` or the driver answers.
    pub fn run_once(&self, name: &str, record: impl FnOnce(vk::CommandBuffer) -> Result<()>) -> Result<()> {
        let pool = CommandPool::new(&self.device, name)?;
        // SAFETY: the pool is new.
        record(unsafe { pool.begin() }?)?;
        // SAFETY: just recorded; this function waits before anything can be dropped.
        let epoch = unsafe { self.submit(pool.end()?) }?;
        self.wait(epoch)
    }
}

impl Drop for Queue {
    fn drop(&mut self) {
        // The timeline must not be destroyed while a submission is to signal it, and an epoch that is being
        // recorded is never "done" without another submission: so wait here for the last one.
        let _ = self.wait(self.submitted.load(Ordering::Acquire));
        self.device.retire(Retired::Semaphore(self.timeline));
        self.device.free_queue();
    }
}
