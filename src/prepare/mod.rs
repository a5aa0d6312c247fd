//! From a scene to GPU buffers: what is done once, before any frame.
//!
//! World coordinates are `f64`; shaders have `f32`. So each chunk is *rebased*: moved by an origin in its thick and scaled
//! by a power of two. Both are exact; what is left is one rounding of each coordinate to `f32`, 6e-8 of its distance from
//! that origin.

mod chunk;
mod pack;
mod rebase;

pub use chunk::{Chunk, SplatSetLayout};
pub use rebase::{Rebase, ViewFromLocal};

use std::ops::Range;

use crate::{
    error::Result,
    scene::{DefectCounts, Scene},
    vk::{Device, Limits, Staging},
};

/// A scene on the device. Chunks keep the scene's order.
pub struct PreparedScene {
    /// Pieces of objects, each within the device's limits.
    pub chunks: Vec<Chunk>,
    /// What was left out, in all objects together.
    pub defects: DefectCounts,
}

impl PreparedScene {
    /// How many splats are drawn.
    pub fn splat_count(&self) -> u64 {
        self.chunks.iter().map(|chunk| u64::from(chunk.count)).sum()
    }

    /// Bytes of device memory in splat buffers.
    pub fn bytes(&self) -> u64 {
        self.chunks.iter().map(Chunk::bytes).sum()
    }
}

/// How many splats are packed and uploaded at once: 3.7 MB at most, so that neither the host nor the device holds a
/// second copy of a scene on its way.
const BATCH_SPLATS: usize = 1 << 16;

/// Uploads a scene, in chunks within `limits`. Splats with a defect are left out and counted. `submit` runs one batch of
/// uploads, of which a chunk has several: our own queue, or the host's, which may defer it as long as it comes before the
/// first frame and the batch lives until then. `progress` is called with splats done and splats in all.
///
/// # Errors
/// Whatever the allocator, the driver or `submit` answers.
pub fn prepare(
    device: &Device,
    limits: &Limits,
    layout: &SplatSetLayout,
    scene: &Scene,
    submit: &mut dyn FnMut(Staging) -> Result<()>,
    progress: &dyn Fn(u64, u64),
) -> Result<PreparedScene> {
    let total = scene.splat_count() as u64;
    let capacity = chunk::capacity(limits.max_storage_buffer_range);
    let mut prepared = PreparedScene { chunks: Vec::new(), defects: DefectCounts::default() };
    let mut done = 0;
    for object in &scene.objects {
        let splats = &object.splats;
        for range in pieces(0..splats.len(), capacity) {
            let survey = pack::survey(splats, range.clone(), Rebase::of(splats, range.clone()));
            prepared.defects.merge(&survey.defects);
            if survey.count == 0 {
                done += range.len() as u64;
                progress(done, total);
                continue;
            }
            let chunk = Chunk::new(device, layout, prepared.chunks.len(), object.closed, &survey)?;
            let mut first = 0;
            for batch in pieces(range, BATCH_SPLATS) {
                done += batch.len() as u64;
                let packed = pack::pack(splats, batch, survey.rebase);
                let count = packed.count(survey.ellipses);
                if count > 0 {
                    submit(chunk.upload(device, first, &packed)?)?;
                    first += count;
                }
                progress(done, total);
            }
            prepared.chunks.push(chunk);
        }
    }
    Ok(prepared)
}

/// A range cut into pieces of a size, the last one shorter.
fn pieces(range: Range<usize>, size: usize) -> impl Iterator<Item = Range<usize>> {
    let end = range.end;
    range.step_by(size).map(move |first| first..end.min(first.saturating_add(size)))
}

#[cfg(test)]
mod tests {
    /// A host may draw one scene from several threads. Fails to compile where that is not so.
    #[test]
    fn a_scene_is_shared_between_threads() {
        fn shared<T: Send + Sync>() {}
        shared::<super::PreparedScene>();
    }
}
