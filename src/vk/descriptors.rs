//! Descriptor sets: layouts, and pools that are reset as a whole.

use std::{
    cell::RefCell,
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
};

use ash::vk;

use super::{
    descriptor::{Descriptor, Info},
    device::Device,
    garbage::Retired,
    layout::STAGES,
    owned::Owned,
    pool_sizes::PoolSizes,
    result::VkResultExt,
    sampler::Sampler,
    stand_ins::StandIns,
};
use crate::{
    error::{Error, Result},
    inline_vec::InlineVec,
};

/// Bindings that are written by one call.
const AT_ONCE: usize = 8;

/// No layout has more bindings: sets have a bit for each.
const MOST_BINDINGS: usize = u64::BITS as usize;

/// One binding of a set: its type and the stages that see it. Its number is its place in the layout.
#[derive(Clone, Copy, Debug)]
pub struct Binding {
    /// Its type. `COMBINED_IMAGE_SAMPLER` comes with a bilinear sampler of the layout's own.
    pub kind: vk::DescriptorType,
    /// The stages that see it.
    pub stages: vk::ShaderStageFlags,
}

/// The bindings of a set.
pub struct SetLayout {
    owned: Owned<vk::DescriptorSetLayout>,
    /// Of no other layout of the process, as a handle may be.
    number: u64,
    bindings: Vec<Binding>,
    // Used by the layout, so that it goes after it.
    _sampler: Option<Sampler>,
    /// The stand-ins for what its sets are not given, and the bindings of texels that are unsigned integers.
    stand_ins: Option<(Arc<StandIns>, Vec<u32>)>,
}

impl SetLayout {
    /// A set of bindings numbered from 0.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for a binding of another kind than those of Vulkan 1.0, or for other stages than vertices, fragments and compute; whatever the driver answers.
    ///
    /// # Panics
    /// With more than 64 bindings.
    pub fn new(device: &Device, name: &str, bindings: &[Binding]) -> Result<Self> {
        assert!(bindings.len() <= MOST_BINDINGS, "{name}: {} bindings", bindings.len());
        let is_known = |binding: &Binding| {
            let kinds = vk::DescriptorType::COMBINED_IMAGE_SAMPLER..=vk::DescriptorType::STORAGE_BUFFER;
            kinds.contains(&binding.kind) && STAGES.contains(binding.stages)
        };
        if let Some(other) = bindings.iter().find(|binding| !is_known(binding)) {
            return Err(Error::option(name, format!("a binding of {:?} for {:?}", other.kind, other.stages)));
        }
        let filtered = |binding: &Binding| binding.kind == vk::DescriptorType::COMBINED_IMAGE_SAMPLER;
        let sampler = bindings.iter().any(filtered).then(|| Sampler::new(device, name)).transpose()?;
        let samplers = [sampler.as_ref().map_or(vk::Sampler::null(), Sampler::raw)];
        let raw_bindings: Vec<_> = (0..)
            .zip(bindings)
            .map(|(number, binding)| {
                let raw = vk::DescriptorSetLayoutBinding::default()
                    .binding(number)
                    .descriptor_type(binding.kind)
                    .descriptor_count(1)
                    .stage_flags(binding.stages);
                if filtered(binding) { raw.immutable_samplers(&samplers) } else { raw }
            })
            .collect();
        let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&raw_bindings);
        // SAFETY: the device is alive.
        let raw = unsafe { device.raw().create_descriptor_set_layout(&info, None) }
            .of_call("vkCreateDescriptorSetLayout", name)?;
        let owned = device.own(raw, name, Retired::SetLayout);
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let bindings = bindings.to_vec();
        Ok(Self { owned, number, bindings, _sampler: sampler, stand_ins: None })
    }

    /// This layout with sets that are complete: what they are not given has a stand-in. `integers`: the bindings of texels that are
    /// unsigned integers.
    pub fn with_stand_ins(mut self, stand_ins: &Arc<StandIns>, integers: &[u32]) -> Self {
        self.stand_ins = Some((Arc::clone(stand_ins), integers.to_vec()));
        self
    }

    /// Its bindings.
    pub(super) fn bindings(&self) -> &[Binding] {
        &self.bindings
    }

    /// Whether it is of this device.
    pub(super) fn is_of(&self, device: &Device) -> bool {
        self.owned.device.is(device)
    }

    /// The raw layout.
    pub fn raw(&self) -> vk::DescriptorSetLayout {
        self.owned.raw
    }
}

/// A pool of sets that live and die together. Sets that are taken back are given out again where the same are wanted: a frame like the
/// one before makes none, and none gets a name anew, each of which lavapipe (Mesa 22.3) keeps until the end.
pub struct DescriptorPool {
    owned: Owned<vk::DescriptorPool>,
    name: String,
    // Not `Sync`: Vulkan wants the pool's calls one at a time.
    sets: RefCell<Sets>,
}

/// The sets of a pool.
#[derive(Default)]
struct Sets {
    given: Vec<Set>,
    free: Vec<Set>,
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
        let of_layout = |set: &Set| set.layout == layout;
        let place = self.free.iter().position(|set| of_layout(set) && set.bindings == Some(bindings));
        let place = place.or_else(|| self.free.iter().position(of_layout))?;
        Some(self.free.swap_remove(place))
    }
}

/// A pool from which no further set is taken: it only keeps its sets alive, and so may be shared between threads.
pub struct SealedPool(#[expect(dead_code, reason = "kept for its drop")] Owned<vk::DescriptorPool>);

impl DescriptorPool {
    /// A pool to be reset and used again, with room for this much at a time: beside sets that are taken back, others may be wanted in their place.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn for_frames(device: &Device, name: &str, sizes: PoolSizes) -> Result<Self> {
        Self::new(device, name, sizes.plus(&sizes))
    }

    /// A pool with this much room.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn new(device: &Device, name: &str, sizes: PoolSizes) -> Result<Self> {
        if sizes.sets == 0 {
            return Err(Error::option(name, "a pool of no sets"));
        }
        let kinds = sizes.kinds().into_iter().filter(|(_, count)| *count > 0);
        let size = |(kind, count)| vk::DescriptorPoolSize::default().ty(kind).descriptor_count(count);
        let of_kinds: Vec<_> = kinds.map(size).collect();
        let info = vk::DescriptorPoolCreateInfo::default().max_sets(sizes.sets).pool_sizes(&of_kinds);
        // SAFETY: the device is alive.
        let raw = unsafe { device.raw().create_descriptor_pool(&info, None) }
            .of_call("vkCreateDescriptorPool", name)?;
        let owned = device.own(raw, name, Retired::DescriptorPool);
        Ok(Self { owned, name: name.to_owned(), sets: RefCell::default() })
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
        for (number, Binding { kind, .. }) in (0..).zip(&layout.bindings) {
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
            let Binding { kind, .. } = layout.bindings[*number as usize];
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
        unsafe { self.owned.device.raw().update_descriptor_sets(&writes, &[]) };
    }

    fn allocate(&self, layout: &SetLayout) -> Result<vk::DescriptorSet> {
        let Owned { device, raw, .. } = &self.owned;
        let layouts = [layout.raw()];
        let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(*raw).set_layouts(&layouts);
        // SAFETY: pool and layout are alive and of this device. The pool is not `Sync`, so nobody else allocates.
        let set = unsafe { device.raw().allocate_descriptor_sets(&info) }
            .of_call("vkAllocateDescriptorSets", &self.name)?[0];
        device.set_name(set, &self.name);
        Ok(set)
    }

    /// Takes all sets back.
    ///
    /// # Safety
    /// No submission that uses one of the sets may be unfinished.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub unsafe fn reset(&self) -> Result<()> {
        let sets = &mut *self.sets.borrow_mut();
        // All that are there were wanted: as many as there was asked for room for, and they may be wanted again.
        if sets.free.is_empty() {
            std::mem::swap(&mut sets.free, &mut sets.given);
            return Ok(());
        }
        *sets = Sets::default();
        let Owned { device, raw, .. } = &self.owned;
        // SAFETY: this function's contract.
        unsafe { device.raw().reset_descriptor_pool(*raw, vk::DescriptorPoolResetFlags::empty()) }
            .of_call("vkResetDescriptorPool", &self.name)
    }

    /// Takes no further set from the pool.
    pub fn seal(self) -> SealedPool {
        SealedPool(self.owned)
    }
}
