//! What is looked at for a pick, and what the device's answer means.

use std::collections::HashMap;

use glam::DVec3;

use super::{Nearest, PickRay, RUN};
use crate::passes::pipeline::{constants::FrameConstants, variant::Constants};
use crate::passes::plan::{
    FramePlan, SurfacePlan,
    block_list::ListedBlocks,
    budget::within_budget,
    draws::{Draw, draws, with_hard_steps, without_levels},
    mesh_draws::{MeshDraw, mesh_draws},
    planes::{ShaderPlane, if_they_cut, shader_planes},
    range::DepthRange,
    splat_variants::change_variants,
};
use crate::{
    arena::{Arena, ArenaVec},
    inline_vec::InlineVec,
    prepare::{Chunk, Placed, PreparedScene},
    scene::{Camera, Edges, Lod, MOST_PLANES, Settings, Window},
    shaders::config::*,
    vk::Limits,
};

/// What is looked at for a pick.
///
/// ```no_run
/// use surfel::{Settings, ash::vk, embed::{FrameSlot, HostCamera, Picked, PreparedScene, Renderer}};
///
/// /// `submit` submits `commands`, waits for them, and gives the bytes of `answer`, a buffer of [`Self::size_bytes`] that may be copied to.
/// unsafe fn look(
///     renderer: &Renderer, commands: vk::CommandBuffer, scene: &PreparedScene, camera: &HostCamera, settings: &Settings, answer: vk::Buffer, submit: impl FnOnce() -> Vec<u8>,
/// ) -> surfel::Result<Option<Picked>> {
///     let mut slot = FrameSlot::new(renderer.device());
///     let plan = renderer.plan_pick(scene, &camera.camera(settings.size_px)?.0, settings, [320, 240])?;
///     // SAFETY: this function's contract; the slot lives until the commands have run.
///     unsafe { renderer.record_pick(commands, &mut slot, &plan, answer) }?;
///     Ok(plan.read(&submit()))
/// }
/// ```
pub struct PickPlan<'a> {
    pub(super) draws: Vec<PickedChunk<'a>>,
    pub(super) meshes: Vec<MeshDraw<'a>>,
    pub(super) listed: Vec<u32>,
    /// Through the one pixel.
    pub(super) ray: PickRay,
    planes: InlineVec<ShaderPlane, MOST_PLANES>,
    scene: &'a PreparedScene,
}

/// A chunk of splats that is looked at.
pub(super) struct PickedChunk<'a> {
    pub chunk: &'a Chunk,
    pub constants: FrameConstants,
    /// The specialization constants of its pipeline.
    pub variant: Constants,
}

/// What is seen in a pixel: of splats the one whose depth, moved away from the eye by ε, is nearest, as visibility has it; of polygons the
/// nearest. Transparent things count as any.
#[derive(Clone, Debug, PartialEq)]
pub struct Picked {
    /// Where the ray through the pixel's center meets it, in world space.
    pub position: DVec3,
    /// Its unit normal, toward the eye, in world space.
    pub normal: DVec3,
    /// How far the position is from the eye.
    pub distance: f64,
    /// Its depth along the view's axis, in world units.
    pub depth: f64,
    /// The number of its object in [`PreparedScene::objects`].
    pub object: usize,
    /// What of the object.
    pub part: PickedPart,
}

/// What of an object is picked, by its number among all of its kind, from 0 on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PickedPart {
    /// A splat. Its number in the object is known of scenes that were prepared so ([`crate::scene::Scene::numbered`]), but not of objects that
    /// came with their levels of detail, of which only a part may be there.
    Splat(Option<u32>),
    /// A splat that stands for others in levels of detail.
    Node,
    /// A triangle; its number is known alike.
    Triangle(Option<u32>),
}

impl<'a> PickPlan<'a> {
    /// What is looked at for a pixel of a picture with these settings, whose frame is planned so.
    pub(crate) fn new(
        frame: &FramePlan<'_>,
        scene: &'a PreparedScene,
        camera: &Camera,
        settings: &Settings,
        limits: &Limits,
        pixel: [u32; 2],
    ) -> Self {
        // Sizes are of the picture, not of the pixel.
        let arena = &Arena::new();
        let settings = within_budget(arena, &[Placed::at_home(scene)], camera, settings);
        let settings = if_they_cut(&[Placed::at_home(scene)], &settings);
        let lod = Lod::Px(settings.tau_px());
        let window = Window {
            whole_px: Some(camera.window.whole_px.unwrap_or(settings.size_px)),
            corner_px: [0, 1].map(|i| camera.window.corner_px[i] + f64::from(pixel[i])),
        };
        let range = DepthRange::of(&[Placed::at_home(scene)], camera);
        let eye = camera.eye;
        let camera = Camera { window, ..range.begin(camera) };
        let settings = Settings { size_px: [1; 2], lod, ..settings.into_owned() };
        let mut all = arena.growing();
        for (transparent, plan) in [(false, &frame.opaque), (true, &frame.transparent)] {
            let own = draws(arena, Placed::at_home(scene), (&camera, range), &settings, limits);
            let mut splats = arena.growing();
            splats.extend(own.filter(|draw| draw.chunk.count > 0 && draw.chunk.transparent == transparent));
            as_drawn(arena, &mut splats, plan);
            all.extend_from_slice_copy(&splats);
        }
        // Of hybrids what is picked are polygons, whatever is drawn.
        let in_cells =
            |object: usize| scene.meshes.iter().any(|mesh| mesh.levels.is_some() && mesh.object == object);
        all.retain(|draw| !in_cells(draw.chunk.object));
        let seen = arena.list(all.iter().map(|draw| draw.potentially_visible_runs(arena)));
        let listed = ListedBlocks::of(arena, &mut all, seen, 0..1).words().to_vec();
        // What is planned goes with its arena; chunks stay.
        let chunks: HashMap<*const Chunk, &Chunk> =
            scene.chunks.iter().map(|chunk| (std::ptr::from_ref(chunk), chunk)).collect();
        let chunk = |draw: &Draw<'_>| {
            let (constants, variant) = (draw.told(), *draw.variant);
            chunks.get(&std::ptr::from_ref(draw.chunk)).map(|chunk| PickedChunk { chunk, constants, variant })
        };
        let draws: Vec<_> = all.iter().filter_map(chunk).collect();
        let mut meshes: Vec<_> =
            mesh_draws(Placed::at_home(scene), (arena, &camera, range), &settings).collect();
        let mut first = words_of(&draws);
        for draw in &mut meshes {
            draw.constants.splat_count = draw.chunk.triangles;
            draw.constants.first_record = first;
            first += runs_of(draw);
        }
        let planes = shader_planes((&camera, range), &settings);
        let is_empty = draws.is_empty() && meshes.is_empty();
        let ray = PickRay { camera, eye, range, is_empty };
        Self { draws, meshes, listed, ray, planes, scene }
    }

    /// Nothing is there that may be seen: the device has nothing to do.
    pub(crate) fn is_empty(&self) -> bool {
        self.ray.is_empty
    }

    /// The planes that cut what is seen.
    pub(crate) fn planes(&self) -> &[ShaderPlane] {
        &self.planes
    }

    /// Bytes of the device's answer.
    pub fn size_bytes(&self) -> u64 {
        let records = words_of(&self.draws) + self.meshes.iter().map(runs_of).sum::<u32>();
        u64::from(records.max(1)) * size_of::<Nearest>() as u64
    }

    /// The ray through the pixel, which outlives the scene.
    pub fn ray(&self) -> PickRay {
        self.ray
    }

    /// What the device's answer means; `None` where nothing is seen. Of depths that are equal, the first one is taken.
    pub fn read(&self, answer: &[u8]) -> Option<Picked> {
        let (place, record) = self.ray.nearest(answer)?;
        let place = place as u32;
        let index = record.index as usize;
        let of_mesh = self.meshes.iter().rfind(|draw| draw.constants.first_record <= place);
        let of_splats = || self.draws.iter().rfind(|draw| draw.constants.first_record / WORD <= place);
        let (object, part) = match of_mesh {
            Some(MeshDraw { chunk, .. }) => (chunk.object, PickedPart::Triangle(chunk.number_of(index))),
            None => {
                let chunk = of_splats()?.chunk;
                let splat = PickedPart::Splat(chunk.number_of(index));
                (chunk.object, if chunk.is_of_nodes() { PickedPart::Node } else { splat })
            }
        };
        let (position, depth) = self.ray.place(record.depth.into());
        let view_from_world = self.ray.camera.view_from_world();
        let [x, y, z, _] = record.normal.map(f64::from);
        Some(Picked {
            position,
            normal: (view_from_world.rotation.transpose() * DVec3::new(x, y, z)).normalize(),
            distance: position.distance(self.ray.eye),
            depth,
            object,
            part,
        })
    }

    /// The names of the scene's objects.
    pub fn object_name(&self, object: usize) -> &str {
        self.scene.objects.get(object).map_or("", String::as_str)
    }
}

/// Splats with the levels of detail and the ε that a frame draws them with.
fn as_drawn<'a>(arena: &'a Arena, splats: &mut ArenaVec<'_, Draw<'a>>, plan: &SurfacePlan<'_>) {
    let mut levels = plan.drawn().iter().filter_map(|draw| draw.levels).peekable();
    if levels.peek().is_none() {
        without_levels(arena, splats);
    } else if !levels.any(|levels| levels.blends()) {
        with_hard_steps(arena, splats);
    }
    if plan.settings.edges == Edges::Coverage {
        change_variants(arena, splats, |_| (), |variant, ()| variant.push((SPEC_COVERAGE_EDGES, 1)));
    }
}

/// Splats of a record.
const WORD: u32 = u32::BITS;

/// Records of splats.
fn words_of(draws: &[PickedChunk<'_>]) -> u32 {
    draws.iter().map(|draw| draw.constants.listed_blocks()).sum::<u32>() * (BLOCK_SPLATS / WORD)
}

/// Records of a piece of a mesh.
pub(super) fn runs_of(draw: &MeshDraw<'_>) -> u32 {
    draw.chunk.triangles.div_ceil(RUN)
}
