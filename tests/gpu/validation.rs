//! Silence means something: each mode of validation finds a defect that was put there for it, and is silent about the
//! same program without the defect.
//!
//! **What layer 1.3.239 (Debian 12) was found not to see**:
//! - attachments: dynamic rendering takes no part in its synchronization checks, so that a missing barrier around a
//!   render target goes unnoticed. Those barriers are held to the graph's own simulator (`src/graph/tests`);
//! - accesses of the host: bytes written to a mapped buffer that the device reads, or read without a wait;
//! - the host's wait for a timeline semaphore, the other way round: it takes what comes after for a hazard. Hence
//!   `vkQueueWaitIdle` in `Queue::wait` where validation is on.
//!
//! What it does see: two buffers, or two images, in the same memory; a timeline semaphore that one submission waits for.
//!
//! From lavapipe follows that one queue and one coherent memory type never show a missing flush or a missing transfer of
//! ownership.
//!
//! Of the layer's known traps, two do not bite here, which tests below hold fast: with the settings given in
//! `VkInstanceCreateInfo` and no settings file, repeated messages are all reported (the limit of 10 is the file's), and
//! threads are checked.

use std::{
    sync::atomic::{AtomicBool, Ordering},
    time::{Duration, Instant},
};

use crate::common::{
    ran_alone,
    watched::{TRANSFER_WRITE, Watched, barrier, fill},
};
use ash::vk;
use surfel::vk::{ALLOWED, Instance, Validation};

const WRITE_AFTER_WRITE: &str = "SYNC-HAZARD-WRITE-AFTER-WRITE";

#[test]
fn core_finds_a_fill_of_a_buffer_without_the_usage() {
    let watched = Watched::new();
    let wrong = watched.buffer(vk::BufferUsageFlags::TRANSFER_SRC);
    assert_eq!(watched.run(&[&|d, c| fill(d, c, &wrong)]), ["VUID-vkCmdFillBuffer-dstBuffer-00029"]);
    let right = watched.buffer(vk::BufferUsageFlags::TRANSFER_DST);
    assert!(watched.run(&[&|d, c| fill(d, c, &right)]).is_empty());
}

#[test]
fn synchronization_finds_two_writes_without_a_barrier() {
    let watched = Watched::new();
    let buffer = watched.buffer(vk::BufferUsageFlags::TRANSFER_DST);
    let said = watched.run(&[&|d, c| {
        fill(d, c, &buffer);
        fill(d, c, &buffer);
    }]);
    assert_eq!(said, [WRITE_AFTER_WRITE]);
    let said = watched.run(&[&|d, c| {
        fill(d, c, &buffer);
        barrier(d, c, TRANSFER_WRITE, TRANSFER_WRITE);
        fill(d, c, &buffer);
    }]);
    assert!(said.is_empty(), "{said:?}");
}

#[test]
fn synchronization_finds_two_writes_in_two_submissions_in_queue_order() {
    let watched = Watched::new();
    let buffer = watched.buffer(vk::BufferUsageFlags::TRANSFER_DST);
    let said = watched.run(&[&|d, c| fill(d, c, &buffer), &|d, c| fill(d, c, &buffer)]);
    assert_eq!(said, [WRITE_AFTER_WRITE]);
    let said = watched.run(&[&|d, c| fill(d, c, &buffer), &|d, c| {
        barrier(d, c, TRANSFER_WRITE, TRANSFER_WRITE);
        fill(d, c, &buffer);
    }]);
    assert!(said.is_empty(), "{said:?}");
    // A wait of the host between them does as well.
    assert!(watched.run(&[&|d, c| fill(d, c, &buffer)]).is_empty());
    assert!(watched.run(&[&|d, c| fill(d, c, &buffer)]).is_empty());
}

#[test]
fn best_practices_finds_a_small_allocation() {
    let watched = Watched::new();
    let allocate = |bytes| {
        let info = vk::MemoryAllocateInfo::default().allocation_size(bytes);
        let device = watched.device.raw();
        // SAFETY: memory type 0 always exists; the memory is freed once.
        unsafe { device.free_memory(device.allocate_memory(&info, None).unwrap(), None) };
        watched.said()
    };
    assert_eq!(allocate(4096), ["BestPractices-vkAllocateMemory-small-allocation"]);
    assert!(allocate(1 << 20).is_empty());
}

#[test]
fn a_defect_that_repeats_is_reported_every_time() {
    let watched = Watched::new();
    let buffer = watched.buffer(vk::BufferUsageFlags::TRANSFER_DST);
    for _ in 0..25 {
        let said = watched.run(&[&|d, c| {
            fill(d, c, &buffer);
            fill(d, c, &buffer);
        }]);
        assert_eq!(said, [WRITE_AFTER_WRITE]);
    }
}

#[test]
fn threads_are_watched() {
    let watched = Watched::new();
    let device = watched.device.raw();
    // SAFETY: destroyed below.
    let fence = unsafe { device.create_fence(&vk::FenceCreateInfo::default(), None) }.unwrap();
    let reset_from = |threads: usize, time: Duration| {
        let (begin, stop) = (Instant::now(), AtomicBool::new(false));
        std::thread::scope(|scope| {
            for _ in 0..threads {
                scope.spawn(|| {
                    while !stop.load(Ordering::Relaxed) {
                        // SAFETY: with two threads this is the defect: the fence wants one at a time. The layer makes
                        // the second wait, so that the driver sees one after the other.
                        let _ = unsafe { device.reset_fences(&[fence]) };
                    }
                });
            }
            while begin.elapsed() < time && watched.messages.all().is_empty() {
                std::thread::sleep(Duration::from_millis(1));
            }
            stop.store(true, Ordering::Relaxed);
        });
        watched.said()
    };
    let alone = reset_from(1, Duration::from_millis(100));
    let together = reset_from(2, Duration::from_secs(20));
    // SAFETY: created above, used by nobody any more.
    unsafe { device.destroy_fence(fence, None) };
    assert!(alone.is_empty(), "{alone:?}");
    // As layer 1.3.239 (Debian 12) calls it, or 1.4.309 (Debian 13).
    let names = ["Threading-MultipleThreads", "Threading-MultipleThreads-Write"];
    assert!(together.first().is_some_and(|name| names.contains(&name.as_str())), "{together:?}");
}

#[test]
fn what_is_allowed_is_counted_and_not_reported_and_has_a_reason() {
    for allowed in ALLOWED {
        assert!(allowed.vuid.contains('-') && allowed.reason.split(' ').count() >= 5, "{allowed:?}");
    }
    // Watching an instance is itself such a case: it enables extensions that are meant for debugging.
    let watched = Watched::new();
    let hits = watched.messages.allowed_hits();
    hits.iter().for_each(|(vuid, hits)| println!("allowed: {vuid} {hits} times"));
    assert!(hits.iter().any(|(vuid, hits)| vuid.contains("specialuse-extension") && *hits > 0));
    assert_eq!(watched.messages.all(), []);
    watched.messages.check().unwrap();
}

#[test]
fn a_message_makes_the_check_fail_with_its_name() {
    let watched = Watched::new();
    let wrong = watched.buffer(vk::BufferUsageFlags::TRANSFER_SRC);
    let pool = surfel::vk::CommandPool::new(&watched.device, "program").unwrap();
    // SAFETY: the pool is new, and what is recorded is never submitted.
    fill(watched.device.raw(), unsafe { pool.begin() }.unwrap(), &wrong);
    let error = watched.messages.check().unwrap_err();
    assert_eq!(error.exit_code(), 3);
    assert!(error.to_string().contains("VUID-vkCmdFillBuffer-dstBuffer-00029"), "{error}");
}

/// In a process whose loader finds no layer: the variable that says so is read when the loader starts.
#[test]
fn validation_without_the_layer_is_an_error() {
    let empty = temp_dir::TempDir::new().unwrap();
    let test = "validation::validation_without_the_layer_is_an_error";
    if ran_alone(test, &[("VK_LAYER_PATH", empty.path().as_os_str())]) {
        return;
    }
    let error = Instance::new(Validation::On).err().expect("there is no layer");
    assert_eq!(error.exit_code(), 2);
    assert!(error.to_string().contains("VK_LAYER_KHRONOS_validation is not installed"), "{error}");
    Instance::new(Validation::Off).expect("without validation nothing is missing");
}
