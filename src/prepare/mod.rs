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

/// Uploads a scene, in chunks within `limits`. Splats with a defect are left out and counted. `submit` runs one batch of uploads: our own queue,
/// or the host's, which may defer it as long as it comes before the first frame and the batch lives until then.
/// `progress` is called with splats done and splats in all.
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
        for first in (0..splats.len()).step_by(capacity) {
            let range = first..splats.len().min(first + capacity);
            done += range.len() as u64;
            let rebase = Rebase::of(splats, range.clone());
            let packed = pack::pack(splats, range, rebase);
            prepared.defects.merge(&packed.defects);
            if packed.count > 0 {
                let number = prepared.chunks.len();
                let (chunk, staging) = Chunk::new(device, layout, number, object.closed, &packed)?;
                submit(staging)?;
                prepared.chunks.push(chunk);
            }
            progress(done, total);
        }
    }
    Ok(prepared)
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
