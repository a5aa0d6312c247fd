//! The plan of a frame: what scene, camera, settings and device decide about it, decided here, once. Whatever records a frame,
//! sizes its pools or explains it reads the plan.

pub(crate) mod bands;
pub(crate) mod block_list;
pub(crate) mod blocks;
pub(crate) mod budget;
pub(crate) mod culling;
pub(crate) mod digits;
pub(crate) mod draws;
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
pub(crate) mod seen;
pub(crate) mod sums;
pub(crate) mod tiles;
pub(crate) mod words;

use crate::passes::pipeline::variant::culls;
use crate::passes::plan::{
    bands::Band,
    block_list::ListedBlocks,
    draws::{Draw, draws},
    mesh_draws::{MeshDraw, mesh_draws},
    range::DepthRange,
    tiles::TilePlan,
};
use crate::{
    prepare::Placed,
    scene::{Accumulate, Camera, Edges, Rasterizer, Settings, Transition},
    shaders::config::{SPEC_COVERAGE_EDGES, SPEC_OWN_EPSILON, SPEC_TWO_SIDED},
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
    pub lights: Vec<lights::ShaderLight>,
    /// The planes that cut both.
    pub planes: Vec<planes::ShaderPlane>,
    /// How deep it reaches.
    pub range: DepthRange,
    /// What is opaque once more, for the pass that finds whose the visible surface is, where that is asked for.
    pub objects: Option<SurfacePlan<'a>>,
}

/// How things are drawn that are drawn alike: all that is opaque, or all that is transparent.
#[derive(Default)]
pub struct SurfacePlan<'a> {
    /// Splats, as the graphics pipeline draws them; each band of tiles has its own copies.
    pub splats: Vec<Draw<'a>>,
    /// Polygons.
    pub meshes: Vec<MeshDraw<'a>>,
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
        visible: Option<ListedBlocks>,
        /// Splats that visible ones hide are left out of the sums.
        culls_hidden: bool,
    },
    /// By tiles, in compute: the bands of the image from top to bottom. The whole image is one band where lists of all of it have
    /// room.
    Tiles(Vec<Band<'a>>),
}

impl Default for SplatMethod<'_> {
    fn default() -> Self {
        Self::Primitives { visible: None, culls_hidden: false }
    }
}

impl<'a> FramePlan<'a> {
    /// Plans the frame that shows scenes.
    pub fn new(scenes: &[Placed<'a>], camera: &Camera, settings: &Settings, limits: &Limits) -> Self {
        let settings = &*budget::within_budget(scenes, camera, settings);
        let range = DepthRange::of(scenes, camera);
        let camera = &range.begin(camera);
        let all = || {
            (0..).zip(scenes).flat_map(|(number, placed)| {
                let of_number = move |mut draw: Draw<'a>| {
                    draw.placed = number;
                    draw
                };
                draws(*placed, (camera, range), settings, limits).into_iter().map(of_number)
            })
        };
        let (clear_splats, splats) = all().partition(|draw| draw.chunk.transparent);
        let again = |transparent: bool| all().filter(|draw| draw.chunk.transparent == transparent).collect();
        let meshes = (0..).zip(scenes).flat_map(|(number, placed)| {
            let of_number = move |draw| MeshDraw { placed: number, ..draw };
            mesh_draws(*placed, (camera, range), settings).into_iter().map(of_number)
        });
        let (clear_meshes, meshes) = meshes.partition(|draw| draw.chunk.transparent);
        let mut transparent = SurfacePlan::new(clear_splats, || again(true), clear_meshes, settings, limits);
        let lights = lights::shader_lights(scenes, camera);
        for band in transparent.bands_mut() {
            band.plan = band.plan.clone().with_layers(settings.layers.most(), lights.len() as u32);
        }
        Self {
            opaque: SurfacePlan::new(splats, || again(false), meshes, settings, limits),
            transparent,
            lights,
            planes: planes::shader_planes((camera, range), settings),
            range,
            objects: None,
        }
    }
}

impl<'a> SurfacePlan<'a> {
    /// Meshes that are all splats have no draw, unless levels of detail turn out not to be chosen: then all of it is planned `again`.
    fn new(
        splats: Vec<Draw<'a>>,
        again: impl FnOnce() -> Vec<Draw<'a>>,
        meshes: Vec<MeshDraw<'a>>,
        settings: &Settings,
        limits: &Limits,
    ) -> Self {
        if !meshes.iter().any(MeshDraw::is_all_splats) {
            return Self::of(splats, meshes, settings, limits);
        }
        let others = meshes.iter().filter(|draw| !draw.is_all_splats()).cloned().collect();
        let plan = Self::of(splats, others, settings, limits);
        if plan.chooses_levels() { plan } else { Self::of(again(), meshes, settings, limits) }
    }

    fn of(
        mut splats: Vec<Draw<'a>>,
        mut meshes: Vec<MeshDraw<'a>>,
        settings: &Settings,
        limits: &Limits,
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
            return Self { meshes, settings, sums, ..Self::default() };
        }
        let polygons = !meshes.is_empty();
        let transparent = splats.iter().any(|draw| draw.chunk.transparent);
        let tiles = method::tiles(&splats, polygons, &settings, limits);
        // Tiles weigh splats without floors, also where they leave sums in images to others; layers do where all are tiles.
        let exact = settings.rasterizer == Rasterizer::Compute || tiles.is_ok() && !transparent;
        if exact && settings.weighs_splats() {
            (settings.accumulate, sums) = (Accumulate::F32, sums::OF_TILES);
        }
        let (method, reason) = match tiles {
            Ok((bands, reason)) => (SplatMethod::Tiles(bands), reason),
            Err(reason) => (method::primitives(&mut splats, polygons, &settings, limits), reason),
        };
        let mut plan = Self { splats, meshes, method, reason, settings, sums };
        if !plan.chooses_levels() {
            plan.meshes.iter_mut().for_each(|draw| draw.levels = None);
        }
        number_meshes(&mut plan.meshes, plan.splats.len());
        plan.choose_edges(transparent);
        plan
    }

    /// Tiles that shade what they sum cover pixels in part where surfaces end; what leaves sums does not.
    fn choose_edges(&mut self, transparent: bool) {
        let shades = !self.bands().is_empty() && (transparent || self.tiles_can_shade(&self.settings));
        if !shades || !self.settings.covers_in_part() {
            self.settings.edges = Edges::Hard;
            return;
        }
        let two_sided = !transparent && self.splats.iter().any(|draw| !culls(&draw.variant));
        let blended = self.splats.iter().filter_map(|draw| draw.levels).any(|levels| levels.blends());
        for band in self.bands_mut() {
            let sides = two_sided.then_some((SPEC_TWO_SIDED, 1));
            let told = || [(SPEC_COVERAGE_EDGES, 1)].into_iter().chain(sides);
            for draw in &mut band.splats {
                draw.variant.extend(told());
                if two_sided {
                    // Surfaces are of one side: how near the other one is does not matter.
                    draw.variant.retain(|(number, _)| *number != SPEC_OWN_EPSILON);
                }
            }
            if !transparent {
                band.plan = band.plan.clone().with_edges(two_sided, blended);
            }
        }
    }

    /// Whether levels of detail are chosen; else things are drawn as they are, and hybrids as polygons.
    fn chooses_levels(&self) -> bool {
        let splats = self.bands().first().map_or(&self.splats, |band| &band.splats);
        splats.iter().any(|draw| draw.levels.is_some())
    }

    /// Bands of tiles; none where the graphics pipeline draws the splats.
    pub fn bands(&self) -> &[Band<'a>] {
        match &self.method {
            SplatMethod::Tiles(bands) => bands,
            SplatMethod::Primitives { .. } => &[],
        }
    }

    fn bands_mut(&mut self) -> &mut [Band<'a>] {
        match &mut self.method {
            SplatMethod::Tiles(bands) => bands,
            SplatMethod::Primitives { .. } => &mut [],
        }
    }

    /// Where the graphics pipeline's splats are looked for, if only those that may be seen are drawn.
    pub(crate) fn visible(&self) -> Option<&ListedBlocks> {
        match &self.method {
            SplatMethod::Primitives { visible, .. } => visible.as_ref(),
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
