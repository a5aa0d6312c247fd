//! Why a frame has the passes, pipelines and memory that it has.

use super::Renderer;
use crate::{
    arena::Arena,
    error::{Error, Result},
    graph::{Access, PassKind, Plan, ResourceDesc},
    passes,
    prepare::{Placed, PreparedScene},
    scene::{Budget, Camera, Edges, Lod, OptionValue as _, Settings},
};

/// What a scene, a camera and settings made of a frame, and why. Lengths are in pixels, memory in bytes.
#[derive(Clone, Debug)]
pub struct Explanation {
    /// The pieces of the scene that are drawn as splats.
    pub chunks: Vec<ExplainedChunk>,
    /// Those that are drawn as polygons.
    pub meshes: Vec<ExplainedMesh>,
    /// The device's largest point: larger splats are listed and drawn as quads.
    pub point_cap_px: f32,
    /// How opaque splats are drawn and why so, where there are any; then transparent ones.
    pub drawn: [Option<String>; 2],
    /// The levels of detail that are drawn, if any are, in a sentence.
    pub levels: Option<String>,
    /// What is beyond f32, and what was asked for and is not drawn, a sentence each.
    pub beyond_f32: Vec<String>,
    /// What 16-bit sums ask of weights, in a sentence.
    pub floors: Option<String>,
    /// The passes, in order.
    pub passes: Vec<ExplainedPass>,
    /// Passes that were declared and left out, because nobody reads their results.
    pub culled: Vec<String>,
    /// All pipelines made so far.
    pub pipelines: Vec<String>,
    /// Device memory of the buffers of splats and meshes.
    pub scene_bytes: u64,
    /// Device memory of the frame's transients, as they share it.
    pub transient_bytes: u64,
    /// What the transients would take without sharing.
    pub unshared_bytes: u64,
}

/// A piece of the scene.
#[derive(Clone, Debug)]
pub struct ExplainedChunk {
    /// How many splats.
    pub splats: u32,
    /// They carry tangent vectors.
    pub ellipses: bool,
    /// They are nodes of levels of detail, drawn in place of those below them.
    pub stands_for_others: bool,
    /// They sample a closed surface.
    pub closed: bool,
    /// They are drawn in layers.
    pub transparent: bool,
    /// One color for all: no color buffer.
    pub uniform_color: bool,
    /// Disks in 16 bytes.
    pub packed: bool,
    /// Coordinates have two parts: 16 bytes more a splat.
    pub fine: bool,
    /// Device memory.
    pub bytes: u64,
    /// What no splat's box exceeds, as proved from the chunk's bounds; infinite where one may reach the near plane.
    pub largest_box_px: f64,
    /// That is above the device's largest point, so large splats are listed and drawn as quads.
    pub may_be_large: bool,
    /// It is drawn by tiles, not by points.
    pub by_tiles: bool,
}

/// A piece of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct ExplainedMesh {
    /// How many triangles.
    pub triangles: u32,
    /// How many vertices.
    pub vertices: u32,
    /// The surface is closed.
    pub closed: bool,
    /// It is drawn in layers.
    pub transparent: bool,
    /// Triangles that face away are not drawn.
    pub culled: bool,
    /// Device memory.
    pub bytes: u64,
}

/// A pass.
#[derive(Clone, Debug)]
pub struct ExplainedPass {
    /// Its name.
    pub name: String,
    /// What it records.
    pub kind: PassKind,
    /// Why the frame has it.
    pub why: &'static str,
    /// What it works on.
    pub uses: Vec<ExplainedUse>,
}

/// A resource of a pass.
#[derive(Clone, Debug)]
pub struct ExplainedUse {
    /// The resource's name.
    pub name: String,
    /// An image's format, or a buffer's size.
    pub what: String,
    /// How it is accessed.
    pub access: Access,
}

impl Renderer {
    /// Whether all surfaces of splats cover pixels in part where they end, as `--edges coverage` asks for: not by all methods, and not where splats are too large.
    ///
    /// # Errors
    /// As [`Renderer::check`].
    #[cfg(feature = "inside")]
    pub fn covers_in_part(
        &self,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
    ) -> Result<bool> {
        let arena = Arena::new();
        let frame = self.frame_plan(&arena, &[Placed::at_home(scene)], camera, settings)?;
        let covers = |plan: &passes::plan::SurfacePlan<'_>| {
            !plan.bands().is_empty() && plan.settings.edges == Edges::Coverage
        };
        Ok([&frame.opaque, &frame.transparent].into_iter().filter(|plan| !plan.splats.is_empty()).all(covers))
    }

    /// Refuses settings that draw no levels of detail, of a scene that holds no more than some view of these needs
    /// ([`crate::scene::LeveledObject`]).
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`].
    #[cfg(feature = "inside")]
    pub fn check_levels(&self, scene: &PreparedScene, camera: &Camera, settings: &Settings) -> Result<()> {
        let arena = Arena::new();
        let asked = match settings.budget {
            Budget::Splats(_) => ("--budget", settings.budget.word()),
            Budget::Unlimited => ("--lod", settings.lod.word()),
        };
        let settings = &*passes::within_budget(&arena, &[Placed::at_home(scene)], camera, settings);
        let frame = passes::FramePlan::new(&arena, &[Placed::at_home(scene)], camera, settings, &self.limits);
        match passes::unused_levels(scene, &frame, settings) {
            None => Ok(()),
            Some(_) => {
                let problem = "these settings draw no levels of detail, and the splats below them were not read; expected --rasterizer auto or \
                     compute, or --lod 0";
                Err(Error::option(asked.0, format!("{}: {problem}", asked.1)))
            }
        }
    }

    /// Explains the frame that was recorded as `plan`.
    #[cfg(feature = "inside")]
    pub fn explain(
        &self,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
        plan: &Plan,
    ) -> Explanation {
        let limits = &self.limits;
        let arena = Arena::new();
        let settings = &*passes::within_budget(&arena, &[Placed::at_home(scene)], camera, settings);
        let frame = passes::FramePlan::new(&arena, &[Placed::at_home(scene)], camera, settings, limits);
        let seen_from = &frame.range.begin(camera);
        let draws = passes::draws(&arena, Placed::at_home(scene), (seen_from, frame.range), settings, limits);
        let draws: Vec<_> = draws.collect();
        let chunks = draws.iter().map(|draw| ExplainedChunk {
            splats: draw.chunk.count,
            ellipses: draw.chunk.ellipses,
            stands_for_others: draw.chunk.stands_for_others(),
            closed: draw.chunk.closed,
            transparent: draw.chunk.transparent,
            uniform_color: draw.chunk.uniform_color,
            packed: draw.chunk.packed,
            fine: draw.chunk.fine,
            bytes: draw.chunk.bytes(),
            largest_box_px: draw.largest_box_px(),
            may_be_large: draw.may_be_large,
            by_tiles: !if draw.chunk.transparent { &frame.transparent } else { &frame.opaque }
                .bands()
                .is_empty(),
        });
        let meshes = passes::mesh_draws(Placed::at_home(scene), (&arena, seen_from, frame.range), settings);
        let meshes = meshes.map(|draw| ExplainedMesh {
            triangles: draw.chunk.triangles,
            vertices: draw.chunk.vertices,
            closed: draw.chunk.closed,
            transparent: draw.chunk.transparent,
            culled: draw.cull,
            bytes: draw.chunk.bytes(),
        });
        let drawn = [&frame.opaque, &frame.transparent].map(|surface| surface.explained(settings));
        Explanation {
            drawn,
            beyond_f32: passes::beyond_f32(scene, &frame, camera)
                .into_iter()
                .chain(passes::unused_levels(scene, &frame, settings))
                .chain(passes::unused_sums(&frame, settings))
                .collect(),
            levels: levels([frame.opaque.splats, frame.transparent.splats].concat(), settings),
            floors: passes::floors(&frame),
            chunks: chunks.collect(),
            meshes: meshes.collect(),
            point_cap_px: limits.point_size_range[1],
            passes: explain_passes(plan),
            culled: plan.culled.iter().map(|pass| pass.name.clone()).collect(),
            pipelines: self.shaders.pipeline_names(),
            scene_bytes: scene.bytes(),
            transient_bytes: plan.blocks.iter().map(|block| block.size_bytes).sum(),
            unshared_bytes: plan.resources.iter().filter_map(|r| r.slot).map(|slot| slot.size_bytes).sum(),
        }
    }
}

/// Of what is drawn. `settings`: those with the size for their budget.
fn levels(draws: Vec<passes::Draw<'_>>, settings: &Settings) -> Option<String> {
    let tau_px = settings.tau_px();
    let has_any = draws.iter().any(|draw| draw.levels.is_some());
    has_any.then(|| {
        let why = match (settings.lod, settings.budget) {
            (Lod::Auto, _) => ": the default of what has levels of detail (--lod)".to_owned(),
            (_, Budget::Splats(most)) => format!(", for --budget {most}"),
            (_, Budget::Unlimited) => String::new(),
        };
        let blended = match draws.iter().filter_map(|draw| draw.levels).any(|levels| levels.blends()) {
            true => format!(", blended up to {:.3} px", tau_px * settings.blended_size()),
            false => String::new(),
        };
        format!("splats that spread by up to {tau_px:.3} px on the screen are drawn as one{blended}{why}")
    })
}

fn explain_passes(plan: &Plan) -> Vec<ExplainedPass> {
    let passes = plan.passes.iter().map(|pass| {
        let uses = pass.uses.iter().map(|usage| {
            let resource = plan.resource(usage.resource);
            let what = match resource.desc {
                ResourceDesc::Image(desc) => format!("{:?}", desc.format),
                ResourceDesc::Buffer(desc) => format!("{} bytes", desc.size_bytes),
            };
            ExplainedUse { name: resource.name.clone(), what, access: usage.access }
        });
        ExplainedPass { name: pass.name.clone(), kind: pass.kind, why: pass.why, uses: uses.collect() }
    });
    passes.collect()
}
