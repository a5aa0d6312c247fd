//! From a scene to GPU buffers: what is done once, before any frame.
//!
//! World coordinates are `f64`; shaders have `f32`. So each chunk is *rebased*: moved by an origin in its thick and scaled
//! by a power of two. Both are exact; what is left is one rounding of each coordinate to `f32`, 6e-8 of its distance from
//! that origin, and where that is too much a second part (`sites.rs`).

mod as_packed;
mod block_bounds;
mod block_tree;
mod blocks;
mod chunk;
mod clip_vectors;
mod cut;
pub mod dynamic;
mod facing;
mod far_apart;
mod level_bounds;
mod level_words;
mod levels;
mod made_levels;
mod memory;
mod mesh_chunk;
mod mesh_levels;
mod near_surfaces;
mod pack;
mod packed;
mod part;
mod placed;
mod quad;
mod radii;
mod rebase;
mod refinements;
mod sequence;
mod sites;
mod updatable;

pub use as_packed::as_packed;
pub use block_tree::{BlockTree, CHILDREN};
pub use blocks::Block;
pub use chunk::Chunk;
pub use dynamic::{DynamicBuffers, DynamicSplats};
pub use level_bounds::{BallBounds, LevelBounds};
pub use levels::{BlockLevels, ChunkLevels, LevelPart, LevelSpace};
pub use memory::SplatSetLayout;
pub use mesh_chunk::MeshChunk;
pub use mesh_levels::MeshLevels;
pub use pack::inverse_overlap_in_upper_half;
pub use packed::LARGEST_TURN_RAD;
pub use placed::{NO_TINT, Placed};
pub use quad::Quad;
pub use radii::RadiusStep;
pub use rebase::{Rebase, ViewFromLocal};
pub use refinements::{Group, Refinement, Refinements};

use std::{cell::RefCell, ops::Range};

use cut::cut;
use memory::{To, Uploader};
pub(crate) use updatable::{Changes, RoomOf, Update};

use crate::{
    error::{Error, Result},
    scene::{Bounds, DefectCounts, Light, Scene, Storage},
    vk::{Device, Limits, MemoryNeeds, Staging, Upload},
};

/// A scene on the device. Chunks have the order of the scene's objects, and their splats that of its [`Storage`].
///
/// ```no_run
/// use surfel::{Scene, ash::vk, embed::{PreparedScene, Renderer}};
///
/// /// `commands` are recording, and submitted before any frame that shows the scene.
/// unsafe fn upload(renderer: &Renderer, commands: vk::CommandBuffer, scene: &Scene) -> surfel::Result<PreparedScene> {
///     // SAFETY: this function's contract.
///     let prepared = unsafe { renderer.upload(commands, scene) }?;
///     println!("{} splats in {} bytes; left out: {}", prepared.splat_count(), prepared.bytes(), prepared.defects.total());
///     Ok(prepared)
/// }
/// ```
pub struct PreparedScene {
    /// Pieces of objects, each within the device's limits. What is invisible has none.
    pub(crate) chunks: Vec<Chunk>,
    /// The names of all objects: of splats, of those that came with their levels of detail, then of meshes.
    pub objects: Vec<String>,
    /// Pieces of meshes alike.
    pub(crate) meshes: Vec<MeshChunk>,
    /// Where it is; nowhere, where frames of it are only listed.
    pub(crate) device: Option<Device>,
    /// The scene's lights.
    pub lights: Vec<Light>,
    /// How its splats are kept.
    pub storage: Storage,
    /// The mean of the major radii of all transparent splats, world space; 0 where there is none. So thick is a
    /// transparent polygon where ε is told in radii.
    pub mean_transparent_radius: f64,
    /// Of objects in levels of detail, where [`Scene::budget`] asks for them.
    pub refinements: Vec<Refinements>,
    /// The splats that were left out, in all objects together.
    pub defects: DefectCounts,
    /// The box around all of it, where none of it changes and all of it is there.
    pub(crate) bounds: Option<Bounds>,
    /// What changes of its splats are found with.
    pub(crate) changes: Changes,
    /// Of objects that have room for more splats, by their number.
    pub(crate) rooms: Vec<Option<RoomOf>>,
    /// What it is copied from, until that has run.
    #[expect(dead_code, reason = "kept for its drop")]
    pub(crate) upload: Upload,
}

impl PreparedScene {
    /// Pieces of objects, each within the device's limits. What is invisible has none.
    pub fn chunks(&self) -> &[Chunk] {
        &self.chunks
    }

    /// Pieces of meshes alike.
    pub fn meshes(&self) -> &[MeshChunk] {
        &self.meshes
    }

    /// Whether it is on that device.
    pub(crate) fn is_on(&self, device: &Device) -> bool {
        self.device.as_ref().is_some_and(|own| own.is(device))
    }

    /// Whether it is on no device: frames of it are listed or measured alone.
    pub(crate) fn is_nowhere(&self) -> bool {
        self.device.is_none()
    }

    /// # Errors
    /// Nothing of it can be drawn, nor picked: it is on no device.
    pub(crate) fn check_is_somewhere(&self) -> Result<()> {
        match self.is_nowhere() {
            true => Err(Error::option("scene", "is on no device: it was measured alone")),
            false => Ok(()),
        }
    }

    /// Whether anything of it is transparent, so that it is drawn in layers.
    pub fn is_transparent(&self) -> bool {
        let splats = self.chunks.iter().any(|chunk| chunk.transparent);
        splats || self.meshes.iter().any(|mesh| mesh.transparent)
    }

    /// How many splats there are, without those that stand for others.
    pub fn splat_count(&self) -> u64 {
        let own = self.chunks.iter().filter(|chunk| !chunk.is_of_nodes());
        own.map(|chunk| u64::from(chunk.present())).sum()
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

/// Uploads a scene, in chunks within `limits`. Splats with a defect are left out and counted. `submit` runs one batch of
/// uploads, of which a chunk has several, and records it before it returns: for our own queue, or the host's, which may defer the submission as long as it comes before the
/// first frame and the batch lives until then. `progress` is called with splats done and splats in all.
///
/// # Errors
/// [`crate::ErrorKind::Option`] for an object of which a list is shorter or longer than that of its positions, for lights or an ε that are none, for a scene that is to be updatable and can't be, for a layout of another device, and for a batch that `submit` did not record; whatever the allocator, the driver or `submit` answers.
pub fn prepare(
    device: &Device,
    limits: &Limits,
    layout: &SplatSetLayout,
    scene: &Scene,
    submit: &mut dyn FnMut(Staging) -> Result<()>,
    progress: &dyn Fn(u64, u64),
) -> Result<PreparedScene> {
    if !layout.set().is_of(device) {
        return Err(Error::option("layout", "is another device's"));
    }
    let uploader = Uploader { device, layout, to: To::Device(submit) };
    cut(Some(uploader), &bindable(device, limits), scene, progress)
}

/// What memory [`prepare`] of a scene will ask for, and the scene as it would be prepared, which is nowhere: for a frame of which it is asked, too, what it needs.
///
/// # Errors
/// As [`prepare`], but for those of driver and allocator.
pub(crate) fn needs(
    device: &Device,
    limits: &Limits,
    layout: &SplatSetLayout,
    scene: &Scene,
) -> Result<(PreparedScene, MemoryNeeds)> {
    let needs = RefCell::default();
    let uploader = Uploader { device, layout, to: To::Needs(&needs) };
    let prepared = cut(Some(uploader), &bindable(device, limits), scene, &|_, _| {})?;
    Ok((prepared, needs.into_inner()))
}

/// The limits with no buffer larger than this device can bind, whatever is asked for.
fn bindable(device: &Device, limits: &Limits) -> Limits {
    let own = device.facts().limits.max_storage_buffer_range;
    Limits { max_storage_buffer_range: limits.max_storage_buffer_range.min(own), ..*limits }
}

/// A scene as it would be prepared on a device with these limits, without its memory: for a frame that is listed, never drawn.
///
/// # Errors
/// As [`prepare`], but for those of a device.
pub(crate) fn prepare_without_device(limits: &Limits, scene: &Scene) -> Result<PreparedScene> {
    cut(None, limits, scene, &|_, _| {})
}

/// A range cut into pieces of a size, the last one shorter.
fn pieces(range: Range<usize>, size: usize) -> impl Iterator<Item = Range<usize>> {
    let end = range.end;
    range.step_by(size).map(move |first| first..end.min(first.saturating_add(size)))
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec3};

    use super::*;
    use crate::scene::{Colors, Epsilon, Mesh, MeshObject, Object, Shapes, Splats};

    #[test]
    fn lists_that_are_not_as_long_as_the_positions_are_refused_by_name() {
        let positions = vec![DVec3::ZERO; 10];
        let said = |scene: &Scene| {
            prepare_without_device(&Limits::plain(), scene).map(drop).map_err(|e| e.to_string())
        };
        let of = |shapes, colors| {
            let splats = Splats::new(positions.clone(), shapes, colors);
            let objects = vec![Object { name: "ball".to_owned(), splats, closed: true }];
            said(&Scene { objects, ..Scene::default() })
        };
        let disks =
            |normals, radii| Shapes::Disks { normals: vec![Vec3::Z; normals], radii: vec![1.0; radii] };
        let ellipses = |s, t| Shapes::Ellipses { s: vec![Vec3::X; s], t: vec![Vec3::Y; t] };
        let one = || Colors::Uniform([1.0; 4]);
        assert_eq!(of(disks(10, 10), one()), Ok(()));
        assert_eq!(of(disks(10, 10), Colors::Each(vec![[1.0; 4]; 10])), Ok(()));
        for (shapes, colors, words) in [
            (disks(10, 9), one(), "9 radii"),
            (disks(11, 10), one(), "11 normals"),
            (ellipses(0, 10), one(), "0 first tangents"),
            (ellipses(10, 1), one(), "1 second tangents"),
            (disks(10, 10), Colors::Each(vec![[1.0; 4]; 3]), "3 colors"),
        ] {
            let words = format!("object 'ball': 10 positions, and {words}; expected as many");
            assert_eq!(of(shapes, colors), Err(words));
        }
        let normals = Some(vec![Vec3::Z; 2]);
        let mesh = Mesh { positions, normals, colors: one(), triangles: vec![[0, 1, 2]] };
        let meshes = vec![MeshObject { name: "part".to_owned(), mesh, closed: false }];
        let words = "mesh 'part': 10 positions, and 2 normals; expected as many";
        assert_eq!(said(&Scene { meshes, ..Scene::default() }), Err(words.to_owned()));
    }

    /// What a file may not say, a host may not either: a light or an ε that is none would be pixels that are no numbers.
    #[test]
    fn lights_and_epsilons_that_are_none_are_refused_by_name() {
        let said =
            |scene: &Scene| prepare_without_device(&Limits::plain(), scene).err().map(|e| e.to_string());
        let light = |red| Light { color: [red, 1.0, 1.0], ..Light::DEFAULT };
        let lit = |lights| Scene { lights, ..Scene::default() };
        assert_eq!(said(&lit(vec![light(2.0); 16])), None);
        for red in [f32::NAN, f32::INFINITY, -1.0] {
            let refused = said(&lit(vec![Light::DEFAULT, light(red)])).unwrap();
            assert!(refused.starts_with("light: color"), "{refused}");
        }
        assert_eq!(said(&lit(vec![light(1.0); 17])).unwrap(), "lights: 17: expected at most 16");
        let with = |epsilon| Scene { epsilons: vec![None, Some(epsilon)], ..Scene::default() };
        assert_eq!(said(&with(Epsilon::Length(0.0))), None);
        for epsilon in [Epsilon::Length(f64::NAN), Epsilon::Radii(-1.0), Epsilon::Length(f64::INFINITY)] {
            let refused = said(&with(epsilon)).unwrap();
            assert!(refused.starts_with("epsilon of object 1: "), "{refused}");
        }
    }

    /// A host may draw one scene from several threads. Fails to compile where that is not so.
    #[test]
    fn a_scene_is_shared_between_threads() {
        fn shared<T: Send + Sync>() {}
        shared::<super::PreparedScene>();
    }
}
