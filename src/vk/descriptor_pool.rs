//! Pools of descriptor sets, which are taken back as a whole.

use std::cell::{Cell, RefCell};

use ash::vk;

use super::{
    descriptor::{Descriptor, Info},
    descriptors::{Binding, SetLayout},
    device::Device,
    garbage::Retired,
    owned::Owned,
    pool_sizes::PoolSizes,
    result::VkResultExt,
};
use crate::{
    error::{Error, Result},
    inline_vec::InlineVec,
};

/// Bindings that are written by one call.
const AT_ONCE: usize = 8;

/// A pool of sets that live and die together. Sets that are taken back are given out again where the same are wanted: a frame like the
/// one before makes none, and none gets a name anew, each of which lavapipe (Mesa 22.3) keeps until the end.
///
/// Frames of several kinds that take turns have each all sets that it had before: what there is no room for comes from one more pool of Vulkan's.
pub struct DescriptorPool {
    device: Device,
    name: String,
    /// What a pool of Vulkan's has room for.
    sizes: Cell<PoolSizes>,
    /// With the room that is left in each.
    pools: RefCell<Vec<(Owned<vk::DescriptorPool>, PoolSizes)>>,
    // Not `Sync`: Vulkan wants the pool's calls one at a time.
    sets: RefCell<Sets>,
}

/// The sets of a pool.
#[derive(Default)]
struct Sets {
    given: Vec<Set>,
    /// By the numbers of layouts; those that are given next lie last.
    free: Vec<(u64, Vec<Set>)>,
}

struct Set {
    raw: vk::DescriptorSet,
    /// The number of its layout.
    layout: u64,
    /// The bindings that were given, a bit each: the others have the layout's stand-ins, if it has any. `None` of a set that has not all of them yet.
    bindings: Option<u64>,
}

impl Sets {
    /// One of this layout, of which the same bindings were given if there is such a one.
    fn take(&mut self, layout: u64, bindings: u64) -> Option<Set> {
        let (_, free) = self.free.iter_mut().find(|(of, _)| *of == layout)?;
        let place = free.iter().rposition(|set| set.bindings == Some(bindings));
        place.or(free.len().checked_sub(1)).map(|place| free.swap_remove(place))
    }

    /// Takes back all that are given.
    fn take_back(&mut self) {
        // So that a frame like the one before finds each where it looks first.
        while let Some(set) = self.given.pop() {
            match self.free.iter_mut().find(|(of, _)| *of == set.layout) {
                Some((_, free)) => free.push(set),
                None => self.free.push((set.layout, vec![set])),
            }
        }
    }
}

/// A pool from which no further set is taken: it only keeps its sets alive, and so may be shared between threads.
pub struct SealedPool(
    #[expect(dead_code, reason = "kept for its drop")] Vec<(Owned<vk::DescriptorPool>, PoolSizes)>,
);

impl DescriptorPool {
    /// A pool with this much room, and more where more is wanted.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn new(device: &Device, name: &str, sizes: PoolSizes) -> Result<Self> {
        if sizes.sets == 0 {
            return Err(Error::option(name, "a pool of no sets"));
        }
        let pools = RefCell::new(vec![(raw_pool(device, name, sizes)?, sizes)]);
        let (device, name) = (device.clone(), name.to_owned());
        Ok(Self { device, name, sizes: Cell::new(sizes), pools, sets: RefCell::default() })
    }

    /// A set with some of its bindings given, by number; the others have the layout's stand-ins, if it has any.
    ///
    /// # Errors
    /// Whatever the driver answers, such as an exhausted pool.
    ///
    /// # Safety
    /// What is given is of the pool's device, is what its binding takes, and stays alive until commands that use the set have run.
    pub unsafe fn set(&self, layout: &SetLayout, given: &[(u32, Descriptor)]) -> Result<vk::DescriptorSet> {
        let bindings = given.iter().fold(0, |bits, (number, _)| bits | 1 << number);
        let taken = self.sets.borrow_mut().take(layout.number, bindings);
        let (raw, has) = match taken {
            Some(set) => (set.raw, set.bindings),
            None => (self.allocate(layout)?, None),
        };
        // Stand-ins stay in a set.
        let complete = match has {
            Some(has) if has == bindings => Ok(()),
            // SAFETY: the set is new or was taken back, so that no command buffer uses it.
            _ => unsafe { self.complete(layout, raw, bindings) },
        };
        let has = complete.is_ok().then_some(bindings);
        self.sets.borrow_mut().given.push(Set { raw, layout: layout.number, bindings: has });
        complete?;
        // SAFETY: as above, and as the caller promises.
        given.chunks(AT_ONCE).for_each(|some| unsafe { self.write(layout, raw, some) });
        Ok(raw)
    }

    /// Writes the layout's stand-ins, if it has any, into the bindings that are not among these.
    ///
    /// # Safety
    /// The set is of this layout, and no command buffer uses it.
    unsafe fn complete(&self, layout: &SetLayout, set: vk::DescriptorSet, bindings: u64) -> Result<()> {
        let Some((stand_ins, integers)) = &layout.stand_ins else { return Ok(()) };
        for (number, Binding { kind, .. }) in (0..).zip(layout.bindings()) {
            if bindings >> number & 1 == 0 {
                let stand_in = stand_ins.of(*kind, integers.contains(&number))?;
                // SAFETY: as the caller promises; stand-ins are of the binding's kind, and live as long as the layout.
                unsafe { self.write(layout, set, &[(number, stand_in)]) };
            }
        }
        Ok(())
    }

    /// Writes at most [`AT_ONCE`] bindings.
    ///
    /// # Safety
    /// The set is of this layout, and no command buffer uses it; the descriptors are as for [`Self::set`].
    unsafe fn write(&self, layout: &SetLayout, set: vk::DescriptorSet, some: &[(u32, Descriptor)]) {
        let infos: InlineVec<_, AT_ONCE> =
            some.iter().map(|(number, descriptor)| (*number, Info::of(*descriptor))).collect();
        let writes = infos.iter().map(|(number, info)| {
            let Binding { kind, .. } = layout.bindings()[*number as usize];
            let write =
                vk::WriteDescriptorSet::default().dst_set(set).dst_binding(*number).descriptor_type(kind);
            match info {
                Info::Buffer(info) => write.buffer_info(info),
                Info::Texels(view) => write.texel_buffer_view(view),
                Info::Image(info) => write.image_info(info),
            }
        });
        let writes: InlineVec<_, AT_ONCE> = writes.collect();
        // SAFETY: as the caller promises.
        unsafe { self.device.raw().update_descriptor_sets(&writes, &[]) };
    }

    fn allocate(&self, layout: &SetLayout) -> Result<vk::DescriptorSet> {
        let (mut pools, needed) = (self.pools.borrow_mut(), layout.sizes());
        let place = match pools.iter().position(|(_, left)| left.holds(&needed)) {
            Some(place) => place,
            None => {
                let sizes = self.sizes.get().max(&needed);
                pools.push((raw_pool(&self.device, &self.name, sizes)?, sizes));
                pools.len() - 1
            }
        };
        let (Owned { raw, .. }, left) = &mut pools[place];
        let layouts = [layout.raw()];
        let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(*raw).set_layouts(&layouts);
        // SAFETY: pool and layout are alive and of this device. The pool is not `Sync`, so nobody else allocates.
        let set = unsafe { self.device.raw().allocate_descriptor_sets(&info) }
            .of_call("vkAllocateDescriptorSets", &self.name)?[0];
        *left = left.minus(&needed);
        self.device.set_name(set, &self.name);
        Ok(set)
    }

    /// Takes all sets back, which are given out again where the same are wanted.
    ///
    /// # Safety
    /// No submission that uses one of the sets may be unfinished.
    pub unsafe fn reset(&self) {
        self.sets.borrow_mut().take_back();
    }

    /// So much is wanted at a time from now on: what is made where there is no room has as much.
    pub fn make_room_for(&self, sizes: &PoolSizes) {
        self.sizes.set(self.sizes.get().max(sizes));
    }

    /// Takes no further set from the pool.
    pub fn seal(self) -> SealedPool {
        SealedPool(self.pools.into_inner())
    }
}

fn raw_pool(device: &Device, name: &str, sizes: PoolSizes) -> Result<Owned<vk::DescriptorPool>> {
    let kinds = sizes.kinds().into_iter().filter(|(_, count)| *count > 0);
    let size = |(kind, count)| vk::DescriptorPoolSize::default().ty(kind).descriptor_count(count);
    let of_kinds: Vec<_> = kinds.map(size).collect();
    let info = vk::DescriptorPoolCreateInfo::default().max_sets(sizes.sets).pool_sizes(&of_kinds);
    // SAFETY: the device is alive.
    let raw = unsafe { device.raw().create_descriptor_pool(&info, None) }
        .of_call("vkCreateDescriptorPool", name)?;
    Ok(device.own(raw, name, Retired::DescriptorPool))
}
