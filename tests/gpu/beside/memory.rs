//! Memory of the host's: all of it comes from there and goes back, and what it refuses is an error after which the next frame works.

use std::{
    collections::HashMap,
    ptr::NonNull,
    sync::{
        Arc, Mutex,
        atomic::{AtomicU32, AtomicUsize, Ordering::Relaxed},
    },
};

use ash::vk;
use surfel::{
    ErrorKind,
    embed::{Device, HostAllocation, HostMemory, Import, MemoryInUse, MemoryRequest, MemoryUse, Renderer},
};

use super::{Beside, Engine, REVERSED, faults::frame};
use crate::{common::scenes, memory::ALLOCATIONS};

/// An engine's allocator: each piece a memory object of its own.
pub(super) struct OfEngine {
    device: ash::Device,
    types: vk::PhysicalDeviceMemoryProperties,
    /// Requests that are still answered; the one after them is not.
    left: AtomicU32,
    asked: AtomicUsize,
    live: AtomicUsize,
    /// Of each piece how it is used, and its bytes.
    pieces: Mutex<HashMap<vk::DeviceMemory, (MemoryUse, bool, u64)>>,
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
            pieces: Mutex::default(),
        })
    }

    /// Answers so many requests more, or all.
    pub fn answer(&self, most: Option<u32>) {
        self.left.store(most.unwrap_or(ALL), Relaxed);
    }

    /// What of it is for what.
    fn by_use(&self) -> MemoryInUse {
        let mut all = MemoryInUse::default();
        for (touched_by, linear, bytes) in self.pieces.lock().unwrap().values() {
            let part = match (touched_by, linear) {
                (MemoryUse::Device, true) => &mut all.buffers,
                (MemoryUse::Device, false) => &mut all.images,
                (MemoryUse::Upload, _) => &mut all.upload,
                (MemoryUse::Readback, _) => &mut all.readback,
            };
            *part += bytes;
        }
        all
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
        let MemoryRequest { touched_by, linear, requirements, .. } = *request;
        self.pieces.lock().unwrap().insert(memory, (touched_by, linear, requirements.size));
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
        self.pieces.lock().unwrap().remove(&allocation.memory).unwrap();
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

/// What is told of memory is what the engine gave, of a scene on its way, and of one that is there; of an allocator of ours idle blocks come to it.
#[test]
fn memory_is_told_by_what_it_is_for() {
    crate::common::arm();
    let engine = Engine::new(REVERSED);
    let memory = OfEngine::new(&engine);
    let host = Import { memory: Some(memory.clone()), ..engine.lent() };
    // SAFETY: all is the engine's own, which goes last.
    let device = unsafe { Device::import(&host) }.unwrap();
    let beside = Beside::on(engine, device);
    let scene = surfel::Scene::from(scenes::sphere(5000, glam::DVec3::ZERO));
    let told = |beside: &Beside| {
        let told = beside.device.memory_by_use();
        assert_eq!(told, memory.by_use());
        assert_eq!((told.total(), told.idle), (beside.device.memory_held(), 0));
        assert_eq!(told.total(), beside.device.memory_in_use().0);
        told
    };
    let before = told(&beside);
    beside.engine.begin();
    // SAFETY: recording; submitted at once.
    let prepared = unsafe { beside.renderer.upload(beside.engine.commands, &scene) }.unwrap();
    let on_its_way = told(&beside);
    assert!(
        on_its_way.upload >= before.upload + 5000 * 40 && on_its_way.buffers >= before.buffers + 5000 * 40
    );
    beside.engine.begin_rendering(true);
    beside.engine.end_rendering();
    beside.submit();
    // What is copied from has run, and goes with the next epoch: in which one it was submitted is not known.
    // SAFETY: all that was submitted is done.
    unsafe { beside.device.epoch_done(beside.device.end_epoch()) };
    let there = told(&beside);
    println!("{there:?}, of which a scene has {}", prepared.bytes());
    assert_eq!((there.upload, there.buffers), (before.upload, on_its_way.buffers));
    drop(prepared);
    beside.end();

    let beside = Beside::new(REVERSED);
    let prepared = beside.upload(&scene);
    let (told, used) = (beside.device.memory_by_use(), beside.device.memory_in_use().0);
    assert!(told.idle > 0 && told.total() - told.idle == used && told.total() == beside.device.memory_held());
    drop(prepared);
    beside.end();
}

#[test]
fn heaps_are_those_of_the_device_and_take_nothing_from_the_heap() {
    let beside = Beside::new(REVERSED);
    let engine = &beside.engine;
    // SAFETY: the instance is alive.
    let properties = unsafe { engine.instance.get_physical_device_memory_properties(engine.physical) };
    let before = ALLOCATIONS.get();
    let told = beside.device.memory_heaps();
    assert_eq!(ALLOCATIONS.get(), before);
    println!("{:?}", told.heaps());
    let sizes = properties.memory_heaps_as_slice().iter().map(|heap| heap.size);
    assert!(
        told.heaps().iter().map(|heap| heap.size).eq(sizes) && told.heaps().iter().any(|heap| heap.is_local)
    );
    for heap in told.heaps() {
        assert!(
            0 < heap.budget && heap.budget <= heap.size && heap.usage.is_some() == told.is_told(),
            "{heap:?}"
        );
    }
    beside.end();
}
