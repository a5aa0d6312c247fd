//! The device memory of transients, which stays where a frame of another shape comes: as much as any frame of late has needed.

use std::sync::Arc;

use ash::vk;

use super::super::{BLOCK_BYTES, Block, MemoryClass};
use crate::{
    error::Result,
    vk::{Device, Memory},
};

/// Blocks of memory that frames of all shapes share, one after the other.
#[derive(Default)]
pub(crate) struct Blocks(Vec<Shared>);

struct Shared {
    class: MemoryClass,
    /// What was asked for.
    requirements: vk::MemoryRequirements,
    memory: Arc<Memory>,
    /// The most that was needed since it was looked at last.
    most_bytes: u64,
}

/// What so many frames, one after the other, have not used is given back.
pub(crate) const FRAMES_OF_LATE: u64 = 1000;

/// What a block gets more than it needs, as a part of it, where it has to grow: other frames are likely to need more still.
const RESERVE: u64 = 4;

/// A block is given back that has more than so many times what was needed of it.
const MOST_TIMES_TOO_LARGE: u64 = 2;

impl Blocks {
    /// Gives memory for each block of a plan, by names for what lies in it, in place of what was served before: what there is where that will do; where it does not, it is left to
    /// whoever holds it, and is replaced.
    ///
    /// # Errors
    /// Whatever the allocator answers.
    pub fn serve<'n>(
        &mut self,
        device: &Device,
        name: impl Fn(MemoryClass) -> &'n str,
        wanted: &[Block],
        served: &mut Vec<Arc<Memory>>,
    ) -> Result<()> {
        served.clear();
        for block in wanted {
            let is_free = |shared: &Shared| !served.iter().any(|memory| Arc::ptr_eq(memory, &shared.memory));
            let place = self.0.iter().position(|shared| shared.could_serve(block) && is_free(shared));
            let memory = match place {
                Some(place) if self.0[place].serves(block) => Arc::clone(&self.0[place].memory),
                Some(place) => {
                    let before = self.0.remove(place).requirements;
                    let shared = Shared::in_place_of(before, device, name(block.class), block)?;
                    let memory = Arc::clone(&shared.memory);
                    self.0.insert(place, shared);
                    memory
                }
                None => {
                    let shared = Shared::new(device, name(block.class), block.class, requirements(block))?;
                    let memory = Arc::clone(&shared.memory);
                    self.0.push(shared);
                    memory
                }
            };
            served.push(memory);
        }
        Ok(())
    }

    /// Takes down that a plan is executed in memory that it was given.
    pub fn note(&mut self, wanted: &[Block], served: &[Arc<Memory>]) {
        for (block, memory) in wanted.iter().zip(served) {
            if let Some(shared) = self.0.iter_mut().find(|shared| Arc::ptr_eq(&shared.memory, memory)) {
                shared.most_bytes = shared.most_bytes.max(block.size_bytes);
            }
        }
    }

    /// Gives back what is far too large for all that was noted since it was asked before.
    pub fn give_back(&mut self) {
        self.0.retain(|shared| shared.memory.size() / MOST_TIMES_TOO_LARGE <= shared.most_bytes);
        self.0.iter_mut().for_each(|shared| shared.most_bytes = 0);
    }

    /// Whether memory that a plan was given is still here.
    pub fn have(&self, served: &[Arc<Memory>]) -> bool {
        served.iter().all(|memory| self.0.iter().any(|shared| Arc::ptr_eq(&shared.memory, memory)))
    }

    /// Bytes of device memory.
    pub fn bytes(&self) -> u64 {
        self.0.iter().map(|shared| shared.memory.size()).sum()
    }
}

impl Shared {
    fn new(
        device: &Device,
        name: &str,
        class: MemoryClass,
        requirements: vk::MemoryRequirements,
    ) -> Result<Self> {
        let memory = Arc::new(Memory::new(device, name, requirements, class == MemoryClass::Buffers)?);
        Ok(Self { class, requirements, memory, most_bytes: 0 })
    }

    /// Memory that does for a block, and for what the memory before it did for; with a reserve, where there is room for it.
    fn in_place_of(
        before: vk::MemoryRequirements,
        device: &Device,
        name: &str,
        block: &Block,
    ) -> Result<Self> {
        let [needed, with_reserve] = grown(before, requirements(block));
        Self::new(device, name, block.class, with_reserve)
            .or_else(|_| Self::new(device, name, block.class, needed))
    }

    /// Whether it, or what is made in its place, does for a block.
    fn could_serve(&self, block: &Block) -> bool {
        self.class == block.class && self.requirements.memory_type_bits & block.type_bits != 0
    }

    fn serves(&self, block: &Block) -> bool {
        serves(self.requirements, requirements(block))
    }
}

pub(crate) fn requirements(block: &Block) -> vk::MemoryRequirements {
    vk::MemoryRequirements {
        size: block.size_bytes,
        alignment: block.alignment_bytes,
        memory_type_bits: block.type_bits,
    }
}

/// Whether memory that was asked for so does for what asks so: whichever of its types it has got.
fn serves(kept: vk::MemoryRequirements, needed: vk::MemoryRequirements) -> bool {
    kept.size >= needed.size
        && kept.alignment.is_multiple_of(needed.alignment.max(1))
        && kept.memory_type_bits & !needed.memory_type_bits == 0
}

/// What does for both: as large as is needed, and with a reserve where more is needed than there was.
fn grown(kept: vk::MemoryRequirements, needed: vk::MemoryRequirements) -> [vk::MemoryRequirements; 2] {
    let both = vk::MemoryRequirements {
        size: needed.size.max(kept.size),
        alignment: needed.alignment.max(kept.alignment),
        memory_type_bits: needed.memory_type_bits & kept.memory_type_bits,
    };
    let reserve = if needed.size > kept.size { needed.size / RESERVE } else { 0 };
    let with_reserve = both.size.saturating_add(reserve).min(BLOCK_BYTES).max(both.size);
    [both, vk::MemoryRequirements { size: with_reserve, ..both }]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(size: u64, alignment: u64, memory_type_bits: u32) -> vk::MemoryRequirements {
        vk::MemoryRequirements { size, alignment, memory_type_bits }
    }

    #[test]
    fn memory_serves_what_is_smaller_of_the_same_types_and_no_stricter() {
        let kept = of(1000, 256, 0b110);
        assert!(serves(kept, of(1000, 256, 0b110)) && serves(kept, of(10, 4, 0b1111)));
        for other in [of(1001, 256, 0b110), of(10, 512, 0b110), of(10, 4, 0b010)] {
            assert!(!serves(kept, other), "{other:?}");
            // What takes its place serves both.
            for grown in grown(kept, other) {
                assert!(serves(grown, kept) && serves(grown, other), "{other:?}: {grown:?}");
            }
        }
    }

    #[test]
    fn what_grows_has_a_reserve_within_what_a_device_allocates_at_once() {
        let sizes = |kept, needed| grown(of(kept, 16, 1), of(needed, 16, 1)).map(|grown| grown.size);
        assert_eq!(sizes(1000, 2000), [2000, 2500]);
        assert_eq!(sizes(2000, 1000), [2000, 2000]);
        assert_eq!(sizes(1000, BLOCK_BYTES - 1), [BLOCK_BYTES - 1, BLOCK_BYTES]);
        assert_eq!(sizes(1000, 3 * BLOCK_BYTES), [3 * BLOCK_BYTES; 2]);
    }
}
