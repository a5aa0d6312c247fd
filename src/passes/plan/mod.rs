//! The plan of a frame: what scene, camera, settings and device decide about it, decided here, once. Whatever records a frame,
//! sizes its pools or explains it reads the plan.

pub(crate) mod ahead;
pub(crate) mod bands;
pub(crate) mod block_list;
pub(crate) mod blocks;
pub(crate) mod budget;
pub(crate) mod chunk_view;
pub(crate) mod culling;
pub(crate) mod digits;
pub(crate) mod draws;
pub(crate) mod edges;
pub(crate) mod few;
pub(crate) mod frame_constants;
pub(crate) mod in_view;
pub(crate) mod invocations;
pub(crate) mod levels;
pub(crate) mod lights;
pub(crate) mod mesh_draws;
pub(crate) mod method;
pub(crate) mod needs;
pub(crate) mod objects;
pub(crate) mod outputs;
pub(crate) mod planes;
pub(crate) mod range;
pub(crate) mod scene_view;
pub(crate) mod seen;
pub(crate) mod splat_variants;
pub(crate) mod sums;
pub(crate) mod tiles;
pub(crate) mod words;

use std::borrow::Cow;

use crate::passes::plan::{
    ahead::Ahead,
    bands::Band,
    block_list::ListedBlocks,
    draws::{Draw, draw},
    mesh_draws::{MeshDraw, mesh_draw},
    range::DepthRange,
    scene_view::CameraView,
    splat_variants::SplatVariants,
    tiles::TilePlan,
};
use crate::{
    arena::{Arena, ArenaVec},
    inline_vec::InlineVec,
    prepare::{Chunk, Placed},
    scene::{Accumulate, Camera, MOST_PLANES, Rasterizer, Settings, Transition},
    vk::Limits,
};

/// How a scene is drawn as seen from a camera.
#[derive(Default)]
pub struct FramePlan<'a> {
    /// What hides all that is behind it.
    pub opaque: SurfacePlan<'a>,
    /// What is drawn in layers.
    pub transparent: SurfacePlan<'a>,
    /// What shines on both, where the scene has lights of its own.
    pub lights: &'a [lights::ShaderLight],
    /// The planes that cut both.
    pub planes: InlineVec<planes::ShaderPlane, MOST_PLANES>,
    /// How deep it reaches.
    pub range: DepthRange,
    /// What is opaque once more, for the pass that finds whose the visible surface is, where that is asked for.
    pub objects: Option<SurfacePlan<'a>>,
}

/// How things are drawn that are drawn alike: all that is opaque, or all that is transparent.
#[derive(Default)]
pub struct SurfacePlan<'a> {
    /// Splats, as the graphics pipeline draws them; each band of tiles has its own copies.
    pub splats: &'a [Draw<'a>],
    /// Polygons.
    pub meshes: &'a [MeshDraw<'a>],
    /// How splats are drawn.
    pub method: SplatMethod<'a>,
    /// Why they are drawn so; empty where there are none.
    pub reason: &'static str,
    /// The settings they are drawn with: as asked for, but for the precision of sums, which is found.
    pub settings: Settings,
    /// Why sums have that precision.
    pub sums: &'static str,
}

/// How splats are drawn.
pub enum SplatMethod<'a> {
    /// By the graphics pipeline, as points, quads or triangles.
    Primitives {
        /// Where splats that may be seen are looked for, if only those are drawn.
        visible: Option<ListedBlocks<'a>>,
        /// Splats that visible ones hide are left out of the sums.
        culls_hidden: bool,
    },
    /// By tiles, in compute: the bands of the image from top to bottom. The whole image is one band where lists of all of it have
    /// room.
    Tiles(&'a [Band<'a>]),
}

impl Default for SplatMethod<'_> {
    fn default() -> Self {
        Self::Primitives { visible: None, culls_hidden: false }
    }
}

impl<'a> FramePlan<'a> {
    /// Plans the frame that shows scenes, in a frame's memory.
    pub fn new(
        arena: &'a Arena,
        scenes: &[Placed<'a>],
        camera: &Camera,
        settings: &Settings,
        limits: &Limits,
    ) -> Self {
        Self::of(arena, scenes, camera, (settings, limits), None)
    }

    /// The same; `ahead`: as a frame may become that shows them from elsewhere, and is not drawn.
    pub(crate) fn of(
        arena: &'a Arena,
        scenes: &[Placed<'a>],
        camera: &Camera,
        (settings, limits): (&Settings, &Limits),
        ahead: Option<Ahead>,
    ) -> Self {
        let settings = &*match ahead {
            None => budget::within_budget(arena, scenes, camera, settings),
            Some(ahead) => ahead.settings(settings),
        };
        let settings = &*match ahead {
            None => planes::if_they_cut(scenes, settings),
            Some(_) => Cow::Borrowed(settings),
        };
        let range = DepthRange::of(scenes, camera);
        let camera = &range.begin(camera);
        let lights = lights::shader_lights(arena, scenes, camera);
        let seen = arena.keep(CameraView::new((camera, range), settings));
        let variants = SplatVariants::new(arena, settings, limits);
        let surface = |transparent: bool| {
            // What is to come has pipelines ahead.
            let is_drawn =
                |chunk: &Chunk| chunk.transparent == transparent && (chunk.count > 0 || ahead.is_some());
            let (mut splats, mut meshes) = (arena.growing(), arena.growing());
            let drawn = scenes.iter().flat_map(|placed| &placed.scene.chunks).filter(|chunk| is_drawn(chunk));
            splats.reserve(drawn.count());
            for (placed, number) in scenes.iter().zip(0..) {
                let mut chunks = placed.scene.chunks.iter().filter(|chunk| is_drawn(chunk)).peekable();
                let own = placed.scene.meshes.iter().filter(|chunk| chunk.transparent == transparent);
                let mut own = own.peekable();
                if chunks.peek().is_none() && own.peek().is_none() {
                    continue;
                }
                let view = &seen.of_scene(arena, &placed.at);
                for chunk in chunks {
                    splats.extend(draw(arena, (placed, number, chunk), view, settings, &variants));
                }
                meshes.extend(
                    own.map(|chunk| MeshDraw { placed: number, ..mesh_draw(*placed, chunk, view, settings) }),
                );
            }
            let lights = transparent.then_some(lights.len() as u32);
            SurfacePlan::new(arena, (splats, meshes), lights, (settings, limits), ahead)
        };
        let (opaque, transparent) = (surface(false), surface(true));
        let planes = planes::shader_planes((camera, range), settings);
        Self { opaque, transparent, lights, planes, range, objects: None }
    }
}

/// Splats and polygons.
type Things<'a> = (ArenaVec<'a, Draw<'a>>, ArenaVec<'a, MeshDraw<'a>>);

impl<'a> SurfacePlan<'a> {
    /// Meshes that are all splats have no draw, unless levels of detail turn out not to be chosen. `lights`: those under which layers are shaded, of what is
    /// transparent.
    fn new(
        arena: &'a Arena,
        (splats, meshes): Things<'a>,
        lights: Option<u32>,
        how: (&Settings, &Limits),
        ahead: Option<Ahead>,
    ) -> Self {
        let is_all_splats = |draw: &MeshDraw<'_>| match ahead {
            None => draw.is_all_splats(),
            Some(ahead) => ahead.without_cells && draw.levels.is_some(),
        };
        if meshes.iter().any(is_all_splats) {
            let (mut same, mut others) = (arena.growing(), arena.growing());
            same.extend_from_slice_copy(&splats);
            others.extend(meshes.iter().filter(|draw| !is_all_splats(draw)).copied());
            let plan = Self::of(arena, (same, others), lights, how, ahead);
            if plan.chooses_levels() {
                return plan;
            }
        }
        Self::of(arena, (splats, meshes), lights, how, ahead)
    }

    fn of(
        arena: &'a Arena,
        (mut splats, mut meshes): Things<'a>,
        lights: Option<u32>,
        (settings, limits): (&Settings, &Limits),
        ahead: Option<Ahead>,
    ) -> Self {
        let (accumulate, mut sums) = sums::sums(settings, limits);
        // Behind the splats; what chooses cells counts them by itself.
        let number_meshes = |meshes: &mut [MeshDraw<'a>], first: usize| {
            for (draw, number) in meshes.iter_mut().zip(first as u32..) {
                draw.constants.number_chunk(number);
            }
        };
        let mut settings = Settings { accumulate, ..settings.clone() };
        if splats.is_empty() {
            meshes.iter_mut().for_each(|draw| draw.levels = None);
            number_meshes(&mut meshes, 0);
            return Self { meshes: meshes.into_bump_slice(), settings, sums, ..Self::default() };
        }
        let polygons = !meshes.is_empty();
        let transparent = lights.is_some();
        let tiles = method::tiles(arena, &splats, polygons, (&settings, limits), ahead);
        // Tiles weigh splats without floors, also where they leave sums in images to others; layers do where all are tiles.
        let exact = settings.rasterizer == Rasterizer::Compute || tiles.is_ok() && !transparent;
        if exact && settings.weighs_splats() {
            (settings.accumulate, sums) = (Accumulate::F32, sums::OF_TILES);
        }
        let (method, reason) = match tiles {
            Ok((bands, reason)) => (SplatMethod::Tiles(bands), reason),
            Err(reason) => {
                (method::primitives(arena, &mut splats, polygons, (&settings, limits), ahead), reason)
            }
        };
        let drawn = match &method {
            SplatMethod::Tiles(bands) => bands.first().map_or(&splats[..], |band| band.splats),
            SplatMethod::Primitives { .. } => &splats,
        };
        if drawn.iter().all(|draw| draw.levels.is_none()) {
            meshes.iter_mut().for_each(|draw| draw.levels = None);
        }
        number_meshes(&mut meshes, splats.len());
        let (splats, meshes) = (splats.into_bump_slice(), meshes.into_bump_slice());
        let mut plan = Self { splats, meshes, method, reason, settings, sums };
        plan.finish_bands(arena, lights, limits);
        plan
    }

    /// Whether levels of detail are chosen; else things are drawn as they are, and hybrids as polygons.
    fn chooses_levels(&self) -> bool {
        self.drawn().iter().any(|draw| draw.levels.is_some())
    }

    /// The splats as they are drawn: of tiles those of a band.
    pub(crate) fn drawn(&self) -> &'a [Draw<'a>] {
        self.bands().first().map_or(self.splats, |band| band.splats)
    }

    /// Bands of tiles; none where the graphics pipeline draws the splats.
    pub fn bands(&self) -> &'a [Band<'a>] {
        match &self.method {
            SplatMethod::Tiles(bands) => bands,
            SplatMethod::Primitives { .. } => &[],
        }
    }

    /// Where the graphics pipeline's splats are looked for, if only those that may be seen are drawn.
    pub(crate) fn visible(&self) -> Option<ListedBlocks<'a>> {
        match &self.method {
            SplatMethod::Primitives { visible, .. } => *visible,
            SplatMethod::Tiles(_) => None,
        }
    }

    /// Whether tiles can be shaded in the dispatch that sums their splats: the graphics pipeline draws none of these, and polygons,
    /// which are shaded before, blend with them as colors, beside tiles that one dispatch takes.
    pub(crate) fn tiles_can_shade(&self, settings: &Settings) -> bool {
        let polygons = !self.meshes.is_empty();
        let by_sums = |plan: &TilePlan| plan.may_be_large || polygons && plan.may_overflow();
        let as_colors = !polygons || settings.transition != Transition::Attributes;
        as_colors && !self.bands().iter().any(|band| by_sums(&band.plan))
    }

    /// Whether it is what is drawn in layers.
    pub(crate) fn is_transparent(&self) -> bool {
        let splats = self.splats.first().map(|draw| draw.chunk.transparent);
        splats.or(self.meshes.first().map(|draw| draw.chunk.transparent)).unwrap_or_default()
    }

    /// Nothing at all.
    pub fn is_empty(&self) -> bool {
        self.splats.is_empty() && self.meshes.is_empty()
    }
}
