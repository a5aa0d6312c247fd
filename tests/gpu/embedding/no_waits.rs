//! A host's device that refuses to submit and to wait.

use ash::vk;

use crate::common::host::Host;

/// Functions that only a host may call: `record` must do with what it is given.
pub static SUBMISSIONS_AND_WAITS: std::sync::atomic::AtomicU32 = std::sync::atomic::AtomicU32::new(0);

/// The host's device with the functions that submit or wait made to count and fail.
pub fn without_submission_and_waits(host: &Host) -> ash::Device {
    use std::sync::atomic::Ordering::Relaxed;
    unsafe extern "system" fn submit2(
        _: vk::Queue,
        _: u32,
        _: *const vk::SubmitInfo2<'_>,
        _: vk::Fence,
    ) -> vk::Result {
        SUBMISSIONS_AND_WAITS.fetch_add(1, Relaxed);
        vk::Result::ERROR_UNKNOWN
    }
    unsafe extern "system" fn submit(
        _: vk::Queue,
        _: u32,
        _: *const vk::SubmitInfo<'_>,
        _: vk::Fence,
    ) -> vk::Result {
        SUBMISSIONS_AND_WAITS.fetch_add(1, Relaxed);
        vk::Result::ERROR_UNKNOWN
    }
    unsafe extern "system" fn queue_wait(_: vk::Queue) -> vk::Result {
        SUBMISSIONS_AND_WAITS.fetch_add(1, Relaxed);
        vk::Result::ERROR_UNKNOWN
    }
    unsafe extern "system" fn device_wait(_: vk::Device) -> vk::Result {
        SUBMISSIONS_AND_WAITS.fetch_add(1, Relaxed);
        vk::Result::ERROR_UNKNOWN
    }
    unsafe extern "system" fn fences(
        _: vk::Device,
        _: u32,
        _: *const vk::Fence,
        _: vk::Bool32,
        _: u64,
    ) -> vk::Result {
        SUBMISSIONS_AND_WAITS.fetch_add(1, Relaxed);
        vk::Result::ERROR_UNKNOWN
    }
    unsafe extern "system" fn semaphores(
        _: vk::Device,
        _: *const vk::SemaphoreWaitInfo<'_>,
        _: u64,
    ) -> vk::Result {
        SUBMISSIONS_AND_WAITS.fetch_add(1, Relaxed);
        vk::Result::ERROR_UNKNOWN
    }
    let own = &host.device;
    let (mut fp_1_0, mut fp_1_2, mut fp_1_3) =
        (own.fp_v1_0().clone(), own.fp_v1_2().clone(), own.fp_v1_3().clone());
    (fp_1_0.queue_submit, fp_1_0.queue_wait_idle) = (submit, queue_wait);
    (fp_1_0.device_wait_idle, fp_1_0.wait_for_fences) = (device_wait, fences);
    fp_1_2.wait_semaphores = semaphores;
    fp_1_3.queue_submit2 = submit2;
    ash::Device::from_parts_1_3(own.handle(), fp_1_0, own.fp_v1_1().clone(), fp_1_2, fp_1_3)
}
