//! From a scene to GPU buffers: what is done once, before any frame.
//!
//! World coordinates are `f64`; shaders have `f32`. So each chunk is *rebased*: moved by an origin in its thick and scaled
//! by a power of two. Both are exact; what is left is one rounding of each coordinate to `f32`, 6e-8 of its distance from
//! that origin, and where that is too much a second part (`sites.rs`).

mod as_packed;
mod blocks;
mod chunk;
mod memory;
mod mesh_chunk;
mod pack;
mod packed;
mod radii;
mod rebase;
mod sequence;
mod sites;

pub use as_packed::as_packed;
pub use blocks::Block;
pub use chunk::Chunk;
pub use memory::SplatSetLayout;
pub use mesh_chunk::MeshChunk;
pub use packed::LARGEST_TURN_RAD;
pub use radii::RadiusStep;
pub use rebase::{Rebase, ViewFromLocal};

use std::ops::Range;

use memory::Uploader;
use mesh_chunk::PackedMesh;
use sequence::Sequence;
use sites::sites;

use crate::{
    error::Result,
    scene::{DefectCounts, Light, Opacity, Scene, Storage},
    vk::{Device, Limits, Staging},
};

/// A scene on the device. Chunks have the order of the scene's objects, and their splats that of its [`Storage`].
pub struct PreparedScene {
    /// Pieces of objects, each within the device's limits. What is invisible has none.
    pub chunks: Vec<Chunk>,
    /// Pieces of meshes alike.
    pub meshes: Vec<MeshChunk>,
    /// The scene's lights.
    pub lights: Vec<Light>,
    /// How its splats are kept.
    pub storage: Storage,
    /// The mean of the major radii of all transparent splats, world space; 0 where there is none. So thick is a
    /// transparent polygon where ε is told in radii.
    pub mean_transparent_radius: f64,
    /// The splats that were left out, in all objects together.
    pub defects: DefectCounts,
}

impl PreparedScene {
    /// How many splats are drawn.
    pub fn splat_count(&self) -> u64 {
        self.chunks.iter().map(|chunk| u64::from(chunk.count)).sum()
    }

    /// How many triangles are drawn.
    pub fn triangle_count(&self) -> u64 {
        self.meshes.iter().map(|chunk| u64::from(chunk.triangles)).sum()
    }

    /// Bytes of device memory in buffers of splats and meshes.
    pub fn bytes(&self) -> u64 {
        let meshes = self.meshes.iter().map(MeshChunk::bytes).sum::<u64>();
        self.chunks.iter().map(Chunk::bytes).sum::<u64>() + meshes
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
    cut(Some(Uploader { device, layout, submit }), limits, scene, progress)
}

/// A scene as it would be prepared on a device with these limits, without its memory: for a frame that is listed, never drawn.
///
/// # Errors
/// None today.
pub(crate) fn prepare_without_device(limits: &Limits, scene: &Scene) -> Result<PreparedScene> {
    cut(None, limits, scene, &|_, _| {})
}

fn cut(
    mut uploader: Option<Uploader<'_>>,
    limits: &Limits,
    scene: &Scene,
    progress: &dyn Fn(u64, u64),
) -> Result<PreparedScene> {
    let total = scene.splat_count() as u64;
    let capacity = chunk::capacity(limits.max_storage_buffer_range);
    let mut prepared = PreparedScene {
        chunks: Vec::new(),
        meshes: Vec::new(),
        lights: scene.lights.clone(),
        storage: scene.storage,
        mean_transparent_radius: 0.0,
        defects: DefectCounts::default(),
    };
    let mut done = 0;
    let (mut transparent_splats, mut transparent_radii) = (0, 0.0);
    for object in &scene.objects {
        let splats = &object.splats;
        let opacity = splats.colors.opacity();
        if opacity == Opacity::Invisible {
            done += splats.len() as u64;
            progress(done, total);
            continue;
        }
        let transparent = opacity == Opacity::Transparent;
        // Before it is cut, so that chunks are compact.
        let sequence = Sequence::of(splats, scene.storage.order);
        for piece in pieces(0..sequence.len(), capacity) {
            for site in sites(splats, &sequence, &piece, scene.storage.format) {
                for range in pieces(0..site.len(&piece), chunk::part_of(capacity, site.fine)) {
                    let which = |places: Range<usize>| site.at(&sequence, &piece, places);
                    let survey = site.survey(splats, which(range.clone()));
                    prepared.defects.merge(&survey.defects);
                    if survey.count > 0 {
                        if transparent {
                            transparent_splats += survey.count;
                            transparent_radii += survey.sum_of_radii;
                        }
                        let number = prepared.chunks.len();
                        let traits = (object.closed, transparent);
                        let mut chunk = Chunk::new(uploader.as_ref(), number, traits, &survey)?;
                        let batches = pieces(range.clone(), BATCH_SPLATS).map(which);
                        let packed = batches.map(|which| pack::pack(splats, which, &survey));
                        let mut uploaded = |count| progress(done + count, total);
                        chunk.fill(uploader.as_mut(), packed, &survey, &mut uploaded)?;
                        chunk.scene_bytes = splats.bytes() * u64::from(survey.count) / splats.len() as u64;
                        prepared.chunks.push(chunk);
                    }
                    done += range.len() as u64;
                    progress(done, total);
                }
            }
        }
    }
    prepared.mean_transparent_radius = transparent_radii / f64::from(transparent_splats.max(1));
    for object in &scene.meshes {
        let opacity = object.mesh.colors.opacity();
        if opacity == Opacity::Invisible {
            continue;
        }
        for packed in PackedMesh::pieces(&object.mesh, capacity).filter(|packed| !packed.is_empty()) {
            let number = prepared.meshes.len();
            let traits = (object.closed, opacity == Opacity::Transparent);
            prepared.meshes.push(MeshChunk::new(uploader.as_mut(), number, traits, &packed)?);
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
