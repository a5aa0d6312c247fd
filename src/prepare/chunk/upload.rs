//! What of a chunk goes to the device, beside its bare memory.

use super::{
    super::{
        block_bounds,
        block_tree::BlockTree,
        clip_vectors::ClipVectors,
        level_words::LevelWords,
        memory::{ChunkMemory, Uploader},
        pack::Packed,
    },
    Chunk,
};
use crate::error::Result;

/// Words of levels of detail that are uploaded at once: 4 MB.
const BATCH_WORDS: usize = 1 << 20;

impl Chunk {
    /// Uploads the splats from number `first` of the chunk on.
    pub(super) fn upload(&self, uploader: &mut Uploader<'_>, first: u32, packed: &Packed) -> Result<()> {
        let shapes: &[u8] = bytemuck::cast_slice(&packed.shapes);
        let colors: &[u8] = bytemuck::cast_slice(&packed.colors);
        // The one color comes with the first splats.
        let colors = if self.uniform_color && first > 0 { &[] } else { colors };
        let clips: &[u8] = bytemuck::cast_slice(&packed.clips);
        let bytes = (shapes.len() + colors.len() + clips.len()) as u64;
        let Some(mut staging) = uploader.staging("upload of splats", bytes)? else { return Ok(()) };
        let Some(ChunkMemory { buffers, .. }) = &self.memory else { return Ok(()) };
        let first = u64::from(first);
        staging.push(&buffers[0], first * self.bytes_each[0], shapes)?;
        if !colors.is_empty() {
            staging.push(&buffers[1], first * self.bytes_each[1], colors)?;
        }
        if !clips.is_empty() {
            staging.push(&buffers[buffers.len() - 1], first * size_of::<ClipVectors>() as u64, clips)?;
        }
        uploader.submit(staging)
    }

    /// Behind the colors.
    pub(super) fn upload_bounds(&self, uploader: &mut Uploader<'_>) -> Result<()> {
        let words = block_bounds::words(&self.blocks);
        let bytes: &[u8] = bytemuck::cast_slice(&words);
        let Some(mut staging) = uploader.staging("upload of bounds", bytes.len() as u64)? else {
            return Ok(());
        };
        let Some(ChunkMemory { buffers, .. }) = &self.memory else { return Ok(()) };
        staging.push(&buffers[1], buffers[1].size() - bytes.len() as u64, bytes)?;
        uploader.submit(staging)
    }

    /// Puts what decides about its levels of detail on the device, if there is one, and to its blocks.
    pub(in super::super) fn fill_levels(
        &mut self,
        uploader: Option<&mut Uploader<'_>>,
        levels: &LevelWords,
    ) -> Result<()> {
        for (block, levels) in self.blocks.iter_mut().zip(&levels.blocks) {
            block.levels = Some(Box::new(*levels));
        }
        self.tree = BlockTree::new(&self.blocks);
        let Some(uploader) = uploader else { return Ok(()) };
        let words = levels.words.chunks(BATCH_WORDS).zip((0..).step_by(BATCH_WORDS * size_of::<u32>()));
        for (words, at) in words {
            let bytes: &[u8] = bytemuck::cast_slice(words);
            let batch = uploader.staging("upload of levels", bytes.len() as u64)?;
            let (Some(mut staging), Some(memory)) = (batch, &self.memory) else { continue };
            staging.push(&memory.buffers[2], at, bytes)?;
            uploader.submit(staging)?;
        }
        Ok(())
    }
}
