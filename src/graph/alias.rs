//! Compile stage 5: transients that don't live at the same time share memory.
//!
//! A content that is read before it was written completely would have to survive, so that its memory could not be
//! shared. No transient has such a content: `validate` refuses to read or load one before a pass has cleared or
//! discarded it. What must survive from one execution to the next is an import.

use super::{
    declare::Declared,
    lifetime::{Lifetime, Usage},
    resource::{Origin, ResourceDesc, ResourceId},
};
use crate::error::{ErrorKind, Result};

/// What a device says about the memory of a transient (`VkMemoryRequirements`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MemoryNeed {
    /// Its size in bytes.
    pub size_bytes: u64,
    /// What its offset in bytes must be a multiple of.
    pub alignment_bytes: u64,
    /// The memory types that will do, a bit each; at least one.
    pub type_bits: u32,
}

/// What lies in a block. The two are never mixed, so that `bufferImageGranularity` doesn't matter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MemoryClass {
    /// Images of optimal tiling.
    Images,
    /// Buffers.
    Buffers,
}

/// One allocation of device memory for several transients.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Block {
    /// What lies in it.
    pub class: MemoryClass,
    /// Its size in bytes.
    pub size_bytes: u64,
    /// The largest alignment of its tenants in bytes.
    pub alignment_bytes: u64,
    /// The memory types that do for all of its tenants, a bit each; at least one.
    pub type_bits: u32,
}

/// The memory of one transient.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Slot {
    /// Which block, an index into [`super::Plan::blocks`].
    pub block: usize,
    /// Where in the block, in bytes.
    pub offset_bytes: u64,
    /// How much, in bytes.
    pub size_bytes: u64,
}

impl Slot {
    /// The first byte after it.
    pub fn end_bytes(&self) -> u64 {
        self.offset_bytes + self.size_bytes
    }

    /// Whether some byte belongs to both.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.block == other.block
            && self.offset_bytes < other.end_bytes()
            && other.offset_bytes < self.end_bytes()
    }
}

/// Where a block ends to grow: what every device can allocate at once (Vulkan 1.3, `maxMemoryAllocationSize`). A tenant
/// that is larger has a block of its own.
const BLOCK_BYTES: u64 = 1 << 30;

/// One that was asked for and is to be placed.
struct Tenant {
    id: ResourceId,
    class: MemoryClass,
    lifetime: Lifetime,
    need: MemoryNeed,
}

/// Gives memory to every transient that is used: the largest first, each at the lowest offset that is free during
/// its life, in the first block whose memory types it shares.
pub(super) fn alias(
    graph: &Declared,
    lifetimes: &[(Usage, Option<Lifetime>)],
    mut needs: impl FnMut(ResourceId, &ResourceDesc, Usage) -> Result<MemoryNeed>,
) -> Result<(Vec<Block>, Vec<Option<Slot>>)> {
    let mut tenants = Vec::new();
    for (i, (resource, &(usage, lifetime))) in graph.resources.iter().zip(lifetimes).enumerate() {
        if let (Origin::Transient, Some(lifetime)) = (resource.origin, lifetime) {
            let id = ResourceId(i as u32);
            let class = match resource.desc {
                ResourceDesc::Image(_) => MemoryClass::Images,
                ResourceDesc::Buffer(_) => MemoryClass::Buffers,
            };
            let mut need = needs(id, &resource.desc, usage)?;
            if need.type_bits == 0 {
                return refuse(&resource.name, "the device has no memory type for it");
            }
            // Some drivers have said 0; a resource still needs a place of its own.
            need.size_bytes = need.size_bytes.max(1);
            need.alignment_bytes = need.alignment_bytes.max(1);
            tenants.push(Tenant { id, class, lifetime, need });
        }
    }
    tenants.sort_by_key(|tenant| (std::cmp::Reverse(tenant.need.size_bytes), tenant.id));

    let mut blocks: Vec<Block> = Vec::new();
    let mut slots: Vec<Option<Slot>> = vec![None; graph.resources.len()];
    for Tenant { id, class, lifetime, need } in tenants {
        let fits = |block: &Block| block.class == class && block.type_bits & need.type_bits != 0;
        let place = |block: usize| {
            let alive = |(slot, other): (&Option<Slot>, &(Usage, Option<Lifetime>))| {
                slot.filter(|slot| {
                    slot.block == block && other.1.is_some_and(|other| other.overlaps(lifetime))
                })
            };
            first_fit(block, &need, slots.iter().zip(lifetimes).filter_map(alive).collect())
        };
        let candidates = blocks.iter().enumerate().filter(|(_, block)| fits(block));
        let roomy = candidates.filter_map(|(block, _)| place(block));
        let found = { roomy }.find(|slot| slot.end_bytes() <= BLOCK_BYTES);
        let slot = found.unwrap_or_else(|| {
            let MemoryNeed { size_bytes, alignment_bytes, type_bits } = need;
            blocks.push(Block { class, size_bytes: 0, alignment_bytes, type_bits });
            Slot { block: blocks.len() - 1, offset_bytes: 0, size_bytes }
        });
        let block = slot.block;
        let block = &mut blocks[block];
        block.size_bytes = block.size_bytes.max(slot.end_bytes());
        block.alignment_bytes = block.alignment_bytes.max(need.alignment_bytes);
        block.type_bits &= need.type_bits;
        slots[id.index()] = Some(slot);
    }
    Ok((blocks, slots))
}

/// The lowest free place among those taken; `None` where offsets overflow.
fn first_fit(block: usize, need: &MemoryNeed, mut taken: Vec<Slot>) -> Option<Slot> {
    taken.sort_by_key(|slot| slot.offset_bytes);
    let mut slot = Slot { block, offset_bytes: 0, size_bytes: need.size_bytes };
    for other in taken {
        if slot.overlaps(&other) {
            slot.offset_bytes = other.end_bytes().checked_next_multiple_of(need.alignment_bytes)?;
            slot.offset_bytes.checked_add(slot.size_bytes)?;
        }
    }
    Some(slot)
}

fn refuse<T>(resource: &str, reason: &str) -> Result<T> {
    Err(ErrorKind::Graph { pass: String::new(), resource: resource.into(), reason: reason.into() }.into())
}
