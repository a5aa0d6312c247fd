//! Compile stage 4: transients that don't live at the same time share memory.
//!
//! A content that is read before it was written completely would have to survive, so that its memory could not be
//! shared. No transient has such a content: `validate` refuses to read or load one before a pass has cleared or
//! discarded it. What must survive from one execution to the next is an import.

use std::collections::HashMap;

use super::{
    declare::Declared,
    lifetime::{Lifetime, Usage},
    resource::{Origin, ResourceDesc, ResourceId},
};
use crate::error::{ErrorKind, Result};

/// What a device says about the memory of a transient (`VkMemoryRequirements`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MemoryNeed {
    /// Its size in bytes.
    pub size_bytes: u64,
    /// What its offset in bytes must be a multiple of.
    pub alignment_bytes: u64,
    /// The memory types that will do, a bit each; at least one.
    pub type_bits: u32,
}

/// What lies in a block. The two are never mixed, so that `bufferImageGranularity` doesn't matter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
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
pub(super) const BLOCK_BYTES: u64 = 1 << 30;

/// A transient that is to be placed.
struct Tenant {
    id: ResourceId,
    kind: TenantKind,
}

/// All that a tenant's place depends on.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct TenantKind {
    class: MemoryClass,
    lifetime: Lifetime,
    need: MemoryNeed,
}

/// The places of a block that are taken, by offset, and during which lives.
type Taken = Vec<(Slot, Lifetime)>;

/// Gives memory to every transient that is used: the largest first, each at the lowest offset that is free during
/// its life, in the first block whose memory types it shares.
pub(super) fn alias(
    graph: &Declared<'_>,
    lifetimes: &[(Usage, Option<Lifetime>)],
    needs: impl FnMut(ResourceId, &ResourceDesc, Usage) -> Result<MemoryNeed>,
) -> Result<(Vec<Block>, Vec<Option<Slot>>)> {
    let mut tenants = tenants(graph, lifetimes, needs)?;
    tenants.sort_by_key(|Tenant { id, kind }| (std::cmp::Reverse(kind.need.size_bytes), *id));

    let mut blocks: Vec<(Block, Taken)> = Vec::new();
    let mut slots: Vec<Option<Slot>> = vec![None; graph.resources.len()];
    // Where one of a kind was placed, nothing before it is free for the next of the kind.
    let mut last_of_kind: HashMap<TenantKind, Slot> = HashMap::new();
    for Tenant { id, kind } in tenants {
        let TenantKind { class, lifetime, need } = kind;
        let last = last_of_kind.get(&kind);
        let (first_block, first_byte) = last.map_or((0, 0), |slot| (slot.block, slot.end_bytes()));
        let place = |(number, (block, taken)): (usize, &(Block, Taken))| {
            let fits = block.class == class && block.type_bits & need.type_bits != 0;
            let from_bytes = if number == first_block { first_byte } else { 0 };
            let offset_bytes = fits.then(|| first_fit(taken, from_bytes, lifetime, need)).flatten()?;
            let slot = Slot { block: number, offset_bytes, size_bytes: need.size_bytes };
            (slot.end_bytes() <= BLOCK_BYTES).then_some(slot)
        };
        let slot = blocks.iter().enumerate().skip(first_block).find_map(place).unwrap_or_else(|| {
            let MemoryNeed { size_bytes, alignment_bytes, type_bits } = need;
            blocks.push((Block { class, size_bytes: 0, alignment_bytes, type_bits }, Vec::new()));
            Slot { block: blocks.len() - 1, offset_bytes: 0, size_bytes }
        });
        let (block, taken) = &mut blocks[slot.block];
        block.size_bytes = block.size_bytes.max(slot.end_bytes());
        block.alignment_bytes = block.alignment_bytes.max(need.alignment_bytes);
        block.type_bits &= need.type_bits;
        let place = taken.partition_point(|(other, _)| other.offset_bytes <= slot.offset_bytes);
        taken.insert(place, (slot, lifetime));
        last_of_kind.insert(kind, slot);
        slots[id.index()] = Some(slot);
    }
    Ok((blocks.into_iter().map(|(block, _)| block).collect(), slots))
}

/// The transients that are used, and what the device says of each.
fn tenants(
    graph: &Declared<'_>,
    lifetimes: &[(Usage, Option<Lifetime>)],
    mut needs: impl FnMut(ResourceId, &ResourceDesc, Usage) -> Result<MemoryNeed>,
) -> Result<Vec<Tenant>> {
    let mut tenants = Vec::new();
    for ((id, resource), &(usage, lifetime)) in (0..).map(ResourceId).zip(&graph.resources).zip(lifetimes) {
        let (Origin::Transient, Some(lifetime)) = (resource.origin, lifetime) else { continue };
        let class = match resource.desc {
            ResourceDesc::Image(_) => MemoryClass::Images,
            ResourceDesc::Buffer(_) => MemoryClass::Buffers,
        };
        let mut need = needs(id, &resource.desc, usage)?;
        if need.type_bits == 0 {
            let (pass, resource) = (String::new(), resource.name.to_string());
            let reason = "the device has no memory type for it".to_owned();
            return Err(ErrorKind::Graph { pass, resource, reason }.into());
        }
        // Some drivers have said 0; a resource still needs a place of its own.
        need.size_bytes = need.size_bytes.max(1);
        need.alignment_bytes = need.alignment_bytes.max(1);
        tenants.push(Tenant { id, kind: TenantKind { class, lifetime, need } });
    }
    Ok(tenants)
}

/// The lowest offset, no lower than `from_bytes`, that is free during a life; `None` where offsets overflow. What is
/// taken below `from_bytes` ends there, as far as it is taken during that life.
fn first_fit(taken: &Taken, from_bytes: u64, lifetime: Lifetime, need: MemoryNeed) -> Option<u64> {
    let mut offset = from_bytes.checked_next_multiple_of(need.alignment_bytes)?;
    let mut end = offset.checked_add(need.size_bytes)?;
    let start = taken.partition_point(|(other, _)| other.offset_bytes < from_bytes);
    for (other, _) in taken[start..].iter().filter(|(_, other)| other.overlaps(lifetime)) {
        if other.offset_bytes >= end {
            break;
        }
        if offset < other.end_bytes() {
            offset = other.end_bytes().checked_next_multiple_of(need.alignment_bytes)?;
            end = offset.checked_add(need.size_bytes)?;
        }
    }
    Some(offset)
}
