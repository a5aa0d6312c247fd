//! Memory of the host's: all of it comes from there and goes back, and what it refuses is an error after which the next frame works.

use std::{
    ptr::NonNull,
    sync::{
        Arc,
        atomic::{AtomicU32, AtomicUsize, Ordering::Relaxed},
    },
};

use ash::vk;
use surfel::{
    ErrorKind,
    embed::{Device, HostAllocation, HostMemory, Import, MemoryRequest, MemoryUse, Renderer},
};

use super::{Engine, REVERSED, faults::frame};

/// An engine's allocator: each piece a memory object of its own.
pub(super) struct OfEngine {
    device: ash::Device,
    types: vk::PhysicalDeviceMemoryProperties,
    /// Requests that are still answered; the one after them is not.
    left: AtomicU32,
    asked: AtomicUsize,
    live: AtomicUsize,
}

const ALL: u32 = u32::MAX;

impl OfEngine {
    /// One that refuses nothing.
    pub fn new(engine: &Engine) -> Arc<Self> {
        Arc::new(Self {
            device: engine.device.clone(),
            // SAFETY: the instance is alive.
            types: unsafe { engine.instance.get_physical_device_memory_properties(engine.physical) },
            left: AtomicU32::new(ALL),
            asked: AtomicUsize::new(0),
            live: AtomicUsize::new(0),
        })
    }

    /// Answers so many requests more, or all.
    pub fn answer(&self, most: Option<u32>) {
        self.left.store(most.unwrap_or(ALL), Relaxed);
    }

    /// How many times it was asked.
    pub fn asked(&self) -> usize {
        self.asked.load(Relaxed)
    }
}

// SAFETY: each piece is a memory object of a type that was asked for, of at least the size.
unsafe impl HostMemory for OfEngine {
    fn allocate(&self, request: &MemoryRequest<'_>) -> Result<HostAllocation, vk::Result> {
        self.asked.fetch_add(1, Relaxed);
        let next = |left: u32| if left == ALL { Some(ALL) } else { left.checked_sub(1) };
        if self.left.fetch_update(Relaxed, Relaxed, next).is_err() {
            return Err(vk::Result::ERROR_OUT_OF_DEVICE_MEMORY);
        }
        let visible = request.touched_by != MemoryUse::Device;
        let wanted = match visible {
            true => vk::MemoryPropertyFlags::HOST_VISIBLE | vk::MemoryPropertyFlags::HOST_COHERENT,
            false => vk::MemoryPropertyFlags::empty(),
        };
        let will_do = |i: &u32| {
            request.requirements.memory_type_bits & (1 << i) != 0
                && self.types.memory_types[*i as usize].property_flags.contains(wanted)
        };
        let kind = (0..self.types.memory_type_count).find(will_do).unwrap();
        let info = vk::MemoryAllocateInfo::default()
            .allocation_size(request.requirements.size)
            .memory_type_index(kind);
        // SAFETY: the device is alive; what is mapped is unmapped as it is freed.
        let (memory, mapped) = unsafe {
            let memory = self.device.allocate_memory(&info, None)?;
            let map = || self.device.map_memory(memory, 0, vk::WHOLE_SIZE, vk::MemoryMapFlags::empty());
            (memory, visible.then(map).transpose()?)
        };
        self.live.fetch_add(1, Relaxed);
        Ok(HostAllocation {
            memory,
            offset: 0,
            mapped: mapped.and_then(|first| NonNull::new(first.cast())),
            token: 7,
        })
    }

    fn free(&self, allocation: HostAllocation) {
        assert_eq!(allocation.token, 7);
        self.live.fetch_sub(1, Relaxed);
        // SAFETY: nothing uses it any more.
        unsafe { self.device.free_memory(allocation.memory, None) };
    }
}

#[test]
fn all_memory_is_the_engines_and_what_it_refuses_is_an_error_after_which_the_next_frame_works() {
    crate::common::arm();
    let engine = Engine::new(REVERSED);
    let memory = OfEngine::new(&engine);
    let host = Import { memory: Some(memory.clone()), ..engine.lent() };
    // SAFETY: all is the engine's own, which goes last.
    let device = unsafe { Device::import(&host) }.unwrap();
    let renderer = Renderer::new(&device, None).unwrap();
    let finish = || {
        // SAFETY: nothing was ever submitted.
        unsafe { device.epoch_done(device.end_epoch()) };
        assert_eq!(device.memory_in_use().1, memory.live.load(Relaxed));
        memory.live.load(Relaxed)
    };
    drop(frame(&engine, &renderer).unwrap());
    let kept = finish();
    memory.asked.store(0, Relaxed);
    drop(frame(&engine, &renderer).unwrap());
    let asked = memory.asked();
    assert_eq!(finish(), kept);
    assert!(asked > 4, "{asked}");
    for answered in 0..asked {
        memory.answer(Some(answered as u32));
        let error = frame(&engine, &renderer).map(drop).unwrap_err();
        let ErrorKind::Memory { object, bytes, reason } = error.kind() else { panic!("{error}") };
        assert!(
            !object.is_empty() && *bytes > 0 && reason.contains("the host's allocator answered"),
            "{error}"
        );
        memory.answer(None);
        assert_eq!(finish(), kept, "{answered}: {error}");
        drop(frame(&engine, &renderer).unwrap());
        assert_eq!(finish(), kept, "{answered}: {error}");
    }
    println!("{asked} requests refused, one after the other");
    drop(renderer);
    assert_eq!(finish(), 0);
    drop(device);
    assert_eq!(engine.said(), [] as [String; 0]);
}
