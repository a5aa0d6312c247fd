//! Memory of an engine's own `gpu-allocator`, and of one block that an engine sets aside: of as much as a run before has asked for at most.

use std::{
    collections::HashMap,
    ptr::NonNull,
    sync::{Arc, Mutex, PoisonError},
};

use ash::vk;
use glam::{
    DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use gpu_allocator::{
    AllocationError, MemoryLocation,
    vulkan::{Allocation, AllocationCreateDesc, AllocationScheme, Allocator, AllocatorCreateDesc},
};
use surfel::{
    Scene, Settings,
    embed::{Device, HostAllocation, HostCamera, HostMemory, Import, MemoryRequest, MemoryUse, Placed},
};

use super::{Beside, Engine, RED, REVERSED, SIZE_PX};
use crate::common::scenes;

/// An engine's `gpu-allocator`, which its own images and buffers come from, too.
struct OfCrate(Mutex<Shared>);

struct Shared {
    allocator: Allocator,
    pieces: HashMap<u64, Allocation>,
    next: u64,
}

impl OfCrate {
    fn new(engine: &Engine) -> Arc<Self> {
        let desc = AllocatorCreateDesc {
            instance: engine.instance.clone(),
            device: engine.device.clone(),
            physical_device: engine.physical,
            debug_settings: Default::default(),
            buffer_device_address: false,
            allocation_sizes: Default::default(),
        };
        let allocator = Allocator::new(&desc).unwrap();
        Arc::new(Self(Mutex::new(Shared { allocator, pieces: HashMap::new(), next: 0 })))
    }
}

// SAFETY: gpu-allocator gives what is asked of it, each piece once.
unsafe impl HostMemory for OfCrate {
    fn allocate(&self, request: &MemoryRequest<'_>) -> Result<HostAllocation, vk::Result> {
        let mut shared = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let desc = AllocationCreateDesc {
            name: request.name,
            requirements: request.requirements,
            location: match request.touched_by {
                MemoryUse::Device => MemoryLocation::GpuOnly,
                MemoryUse::Upload => MemoryLocation::CpuToGpu,
                MemoryUse::Readback => MemoryLocation::GpuToCpu,
            },
            linear: request.linear,
            allocation_scheme: AllocationScheme::GpuAllocatorManaged,
        };
        let piece = shared.allocator.allocate(&desc).map_err(|error| match error {
            AllocationError::OutOfMemory => vk::Result::ERROR_OUT_OF_DEVICE_MEMORY,
            _ => vk::Result::ERROR_UNKNOWN,
        })?;
        let token = shared.next;
        shared.next += 1;
        // SAFETY: the piece stays until what is bound to it has gone.
        let memory = unsafe { piece.memory() };
        let (offset, mapped) = (piece.offset(), piece.mapped_ptr().map(NonNull::cast));
        shared.pieces.insert(token, piece);
        Ok(HostAllocation { memory, offset, mapped, token })
    }

    fn free(&self, allocation: HostAllocation) {
        let mut shared = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let piece = shared.pieces.remove(&allocation.token).unwrap();
        shared.allocator.free(piece).unwrap();
    }
}

/// More than a small picture needs.
const ROOMY_BYTES: u64 = 64 << 20;

/// One memory object, mapped; each piece is the first gap that is large enough.
pub(super) struct OneBlock {
    device: ash::Device,
    memory: vk::DeviceMemory,
    first: NonNull<u8>,
    kind: u32,
    bytes: u64,
    /// What pieces of images and buffers are apart from each other.
    pub granularity: u64,
    /// Begin and end of each piece, in their order; and the largest end that there was.
    taken: Mutex<(Vec<[u64; 2]>, u64)>,
}

// SAFETY: the pointer is handed out piece by piece, each once.
unsafe impl Send for OneBlock {}
// SAFETY: as above.
unsafe impl Sync for OneBlock {}

impl OneBlock {
    pub fn new(engine: &Engine, bytes: u64) -> Arc<Self> {
        let visible = vk::MemoryPropertyFlags::HOST_VISIBLE | vk::MemoryPropertyFlags::HOST_COHERENT;
        // SAFETY: the engine outlives its block, which is unmapped as it is freed.
        unsafe {
            let types = engine.instance.get_physical_device_memory_properties(engine.physical);
            let is_visible = |i: &u32| types.memory_types[*i as usize].property_flags.contains(visible);
            let kind = (0..types.memory_type_count).find(is_visible).unwrap();
            let info = vk::MemoryAllocateInfo::default().allocation_size(bytes).memory_type_index(kind);
            let memory = engine.device.allocate_memory(&info, None).unwrap();
            let flags = vk::MemoryMapFlags::empty();
            let first = engine.device.map_memory(memory, 0, vk::WHOLE_SIZE, flags).unwrap();
            let limits = engine.instance.get_physical_device_properties(engine.physical).limits;
            Arc::new(Self {
                device: engine.device.clone(),
                memory,
                first: NonNull::new(first.cast()).unwrap(),
                kind,
                bytes,
                granularity: limits.buffer_image_granularity,
                taken: Mutex::default(),
            })
        }
    }

    pub fn most_bytes(&self) -> u64 {
        self.taken.lock().unwrap().1
    }

    pub fn end(&self) {
        assert_eq!(self.taken.lock().unwrap().0, [[0; 2]; 0]);
        // SAFETY: all pieces have come back, and the engine is alive.
        unsafe { self.device.free_memory(self.memory, None) };
    }
}

// SAFETY: pieces are within the block, apart from each other, and aligned.
unsafe impl HostMemory for OneBlock {
    fn allocate(&self, request: &MemoryRequest<'_>) -> Result<HostAllocation, vk::Result> {
        let needs = request.requirements;
        assert!(needs.memory_type_bits >> self.kind & 1 == 1, "{}: another type of memory", request.name);
        let mut taken = self.taken.lock().unwrap_or_else(PoisonError::into_inner);
        let (pieces, most) = &mut *taken;
        let (mut offset, mut place) = (0, pieces.len());
        for (number, [begin, end]) in pieces.iter().enumerate() {
            if offset + needs.size <= *begin {
                place = number;
                break;
            }
            offset = end.next_multiple_of(needs.alignment.max(self.granularity));
        }
        // A piece ends where the granularity of the next one begins.
        let end = (offset + needs.size).next_multiple_of(self.granularity);
        if end > self.bytes {
            return Err(vk::Result::ERROR_OUT_OF_DEVICE_MEMORY);
        }
        pieces.insert(place, [offset, end]);
        *most = end.max(*most);
        let mapped = self.first.as_ptr().wrapping_add(offset as usize);
        Ok(HostAllocation { memory: self.memory, offset, mapped: NonNull::new(mapped), token: offset })
    }

    fn free(&self, allocation: HostAllocation) {
        let mut taken = self.taken.lock().unwrap_or_else(PoisonError::into_inner);
        let place = taken.0.iter().position(|[begin, _]| *begin == allocation.token).unwrap();
        taken.0.remove(place);
    }
}

/// A ball beside an engine's triangle, of whichever memory, all of which comes back.
fn picture(engine: Engine, memory: Option<Arc<dyn HostMemory>>) -> (Engine, Vec<[f32; 4]>) {
    // SAFETY: all is the engine's own, which goes last.
    let device = unsafe { Device::import(&Import { memory, ..engine.lent() }) }.unwrap();
    let mut beside = Beside::on(engine, device);
    let ball = beside.upload(&Scene::from(scenes::sphere(3000, DVec3::ZERO)));
    let camera = HostCamera {
        view_from_world: look_at_mat4(DVec3::new(0.4, 0.9, 4.0), DVec3::ZERO, DVec3::Y),
        clip_from_view: directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5),
        flips_y: true,
    };
    let settings = Settings { size_px: SIZE_PX, ..Settings::default() };
    let corners = [DVec3::new(-3.0, -2.0, 0.3), DVec3::new(3.0, -2.0, -0.4), DVec3::new(0.0, 3.0, -0.2)];
    beside.draw(&[Placed::at_home(&ball)], &camera, &settings, &corners, true);
    let pixels = beside.engine.pixels();
    drop(ball);
    (beside.leave(), pixels)
}

#[test]
fn a_picture_is_the_same_of_an_engines_allocator_and_of_one_block_of_no_more_than_it_needs() {
    crate::common::arm();
    let (engine, expected) = picture(Engine::new(REVERSED), None);
    assert!(expected.iter().any(|color| *color != RED && color[3] > 0.0));

    let of_crate = OfCrate::new(&engine);
    let (engine, pixels) = picture(engine, Some(of_crate.clone()));
    assert!(pixels == expected, "of gpu-allocator");
    assert!(of_crate.0.lock().unwrap().pieces.is_empty());
    drop(of_crate);

    let roomy = OneBlock::new(&engine, ROOMY_BYTES);
    let (engine, pixels) = picture(engine, Some(roomy.clone()));
    assert!(pixels == expected, "of a block with room");
    let most_bytes = roomy.most_bytes();
    roomy.end();

    let block = OneBlock::new(&engine, most_bytes);
    let (engine, pixels) = picture(engine, Some(block.clone()));
    assert!(pixels == expected, "of a block of {most_bytes} bytes");
    assert_eq!(block.most_bytes(), most_bytes);
    block.end();
    println!("{most_bytes} bytes");
    assert_eq!(engine.said(), [] as [String; 0]);
}
