//! The renderer: records frames of prepared scenes into command buffers that it is given. It never submits and never
//! waits, so that an embedding host keeps device, queue and submission to itself; [`Headless`] is such a host.

mod ahead;
mod declare;
mod explain;
pub(crate) mod headless;
mod in_parts;
#[cfg(feature = "files")]
mod paged;
mod pick;
mod scene_frame;
mod steps;

use std::sync::{
    Arc,
    atomic::{AtomicU64, Ordering},
};

use ash::vk;

pub(crate) use declare::{Imports, bytes_per_pixel, declare, import_readback};
pub use explain::{ExplainedChunk, ExplainedMesh, ExplainedPass, ExplainedUse, Explanation};
pub use headless::{Frame, Headless, HeadlessOptions, LayerSums, PartSums, PartsAround, Wanted};
pub use in_parts::{Around, PartLayer, Stage};
#[cfg(feature = "files")]
pub use paged::{Drawn, PagedScene, Prepare};
pub use scene_frame::{Readbacks, SampleSum, SceneFrame, Seen};
pub use steps::FrameStep;

use crate::{
    arena::Arena,
    error::{Error, Result},
    frame::{Execution, FrameSlot, SlotParts, Target},
    graph::{
        Graph, Plan,
        execute::{Body, Profile},
    },
    passes::{self, FramePlan, Inputs, MissingPipelines, Place, Shaders, Source},
    prepare::{Placed, PreparedScene, prepare},
    scene::{Accumulate, Camera, Edges, Scene, Settings, Shading},
    vk::{Device, Limits, Staging, StagingRing},
};

/// Draws splats on a device: one for all scenes and views of it.
///
/// ```no_run
/// use surfel::{Scene, ash::vk, embed::{Device, PreparedScene, Renderer}};
///
/// unsafe fn upload(device: &Device, commands: vk::CommandBuffer, scene: &Scene) -> surfel::Result<(Renderer, PreparedScene)> {
///     let renderer = Renderer::new(device, None)?;
///     // SAFETY: this function's contract, that of `upload`.
///     let prepared = unsafe { renderer.upload(commands, scene) }?;
///     Ok((renderer, prepared))
/// }
/// ```
pub struct Renderer {
    device: Device,
    /// No other renderer of this process has it.
    pub(crate) number: u64,
    pub(crate) limits: Limits,
    pub(crate) shaders: Shaders,
    /// What splats that change go through.
    pub(crate) staging: StagingRing,
}

impl Renderer {
    /// A renderer without any pipeline yet; they are made when a frame first needs them, and kept in `cache_folder`
    /// from run to run.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn new(device: &Device, cache_folder: Option<&std::path::Path>) -> Result<Self> {
        static MADE: AtomicU64 = AtomicU64::new(0);
        let (limits, number) = (device.facts().limits, MADE.fetch_add(1, Ordering::Relaxed));
        let (shaders, staging) = (Shaders::new(device, cache_folder)?, StagingRing::new(device));
        Ok(Self { device: device.clone(), number, limits, shaders, staging })
    }

    /// Pipelines and their layouts.
    #[cfg(feature = "inside")]
    pub fn shaders(&self) -> &Shaders {
        &self.shaders
    }

    /// Makes a formula of its shaders wrong, from the next frame on; for tests of the tests.
    #[cfg(feature = "test-formulas")]
    #[cfg_attr(not(feature = "inside"), doc(hidden))]
    pub fn perturb(&mut self, formula: Option<passes::Formula>) {
        self.shaders.perturbed = formula;
    }

    /// The device that it records for.
    pub fn device(&self) -> &Device {
        &self.device
    }

    /// Stays within lower limits than the device's own: points, storage buffers and images as on another device, so
    /// that its paths can be tried here. A limit above the device's has no effect.
    #[cfg(feature = "inside")]
    pub fn lower_limits(&mut self, to: &Limits) {
        let own = self.device.facts().limits;
        self.limits.max_storage_buffer_range = own.max_storage_buffer_range.min(to.max_storage_buffer_range);
        self.limits.max_texels = own.max_texels.min(to.max_texels);
        self.limits.point_size_range[1] = own.point_size_range[1].min(to.point_size_range[1]);
        self.limits.max_image_side = own.max_image_side.min(to.max_image_side);
        self.limits.shuffles = own.shuffles && to.shuffles;
        self.limits.first_instance = own.first_instance && to.first_instance;
        self.limits.is_cpu = own.is_cpu && to.is_cpu;
        self.limits.storage_buffers_a_stage = own.storage_buffers_a_stage.min(to.storage_buffers_a_stage);
    }

    /// Uploads a scene; see [`prepare`].
    ///
    /// # Errors
    /// As [`prepare`].
    pub fn prepare(
        &self,
        scene: &Scene,
        submit: &mut dyn FnMut(Staging) -> Result<()>,
        progress: &dyn Fn(u64, u64),
    ) -> Result<PreparedScene> {
        prepare(&self.device, &self.limits, &self.shaders.splat_set, scene, submit, progress)
    }

    /// Refuses a camera without a picture, and settings that this device can't do.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`].
    pub fn check(&self, camera: &Camera, settings: &Settings) -> Result<()> {
        camera.validate()?;
        settings.check_camera(camera)?;
        self.check_settings(settings)
    }

    /// Refuses settings that this device can't do: what can be known before there is a scene.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`].
    pub fn check_settings(&self, settings: &Settings) -> Result<()> {
        settings.validate()?;
        let facts = self.device.facts();
        let [width, height] = settings.size_px;
        let side = self.limits.max_image_side;
        if width > side || height > side {
            return Err(Error::option(
                "--size",
                format!("{width}x{height}: the device '{}' draws at most {side}x{side}", facts.name),
            ));
        }
        if settings.shading == Shading::EyeDome && !self.limits.blend_f32 {
            let problem = format!("edl: the device '{}' can't blend 32-bit floats", facts.name);
            return Err(Error::option("--shading", problem));
        }
        if settings.accumulate == Accumulate::F32 && !self.limits.blend_f32 {
            let problem = format!("f32: the device '{}' can't blend 32-bit floats; use f16", facts.name);
            return Err(Error::option("--accumulate", problem));
        }
        if settings.samples.0 > 1 && !self.limits.blend_f32 {
            let problem = format!("the device '{}' can't blend 32-bit floats; expected 1", facts.name);
            return Err(Error::option("--samples", problem));
        }
        passes::check_method(settings, &self.limits)
    }

    /// The plan of scenes that can be drawn so.
    pub(crate) fn frame_plan<'a>(
        &self,
        arena: &'a Arena,
        scenes: &[Placed<'a>],
        camera: &Camera,
        settings: &Settings,
    ) -> Result<FramePlan<'a>> {
        self.check_frame(scenes, camera, settings)?;
        Ok(FramePlan::new(arena, scenes, camera, settings, &self.limits))
    }

    /// Refuses what can't be drawn of scenes.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`].
    pub(crate) fn check_frame(
        &self,
        scenes: &[Placed<'_>],
        camera: &Camera,
        settings: &Settings,
    ) -> Result<()> {
        self.check(camera, settings)?;
        passes::check_lights(scenes)?;
        for (number, placed) in scenes.iter().enumerate() {
            let Placed { scene, at, .. } = placed;
            let of_scene = |what: &str, error: Error| match scenes.len() {
                1 => error,
                _ => Error::option(what, format!("of scene {number}: {error}")),
            };
            at.validate().map_err(|error| of_scene("placement", error))?;
            if let Some(before) = placed.before {
                before.validate().map_err(|error| of_scene("placement before", error))?;
            }
            placed.check_tint().map_err(|error| of_scene("tint", error))?;
            if !scene.is_on(&self.device) && !scene.is_nowhere() {
                return Err(Error::option("scene", "was prepared for another device"));
            }
            for chunk in &scene.chunks {
                settings.check_object("the scene", chunk.ellipses)?;
                if chunk.transparent {
                    settings.check_eye_dome("the scene", "transparent in part")?;
                }
            }
            if !scene.meshes.is_empty() {
                settings.check_eye_dome("the scene", "drawn as triangles in part")?;
            }
        }
        passes::check_digits(scenes, camera)
    }

    /// Records one frame, as `record` does for who sees what is inside (`scene_frame.rs`).
    ///
    /// # Safety
    /// Its.
    pub(crate) unsafe fn record_frame(
        &self,
        commands: vk::CommandBuffer,
        slot: &mut FrameSlot,
        frame: &SceneFrame<'_>,
    ) -> Result<Arc<Plan>> {
        let SceneFrame { seen, target, readbacks, profile } = *frame;
        seen.scene.check_is_somewhere()?;
        let arena = slot.take_arena();
        let record = |execution: Execution<'_>, graph: &Graph<'_, Body<'_>>, imports: &Imports<'_>| {
            // SAFETY: this function's contract.
            unsafe {
                self.shaders.begin_frame(commands)?;
                execution.record(commands, graph, imports)
            }
        };
        let how = (profile, MissingPipelines::Make);
        // SAFETY: this function's contract.
        let recorded = unsafe { self.declare_in(&arena, slot, seen, (target, readbacks), how, record) };
        slot.give_back(arena);
        recorded
    }

    /// Declares a frame in a frame's memory, with its pipelines, for what is then done with it.
    ///
    /// # Safety
    /// The frame recorded before in this slot must have finished.
    unsafe fn declare_in<T>(
        &self,
        arena: &Arena,
        slot: &mut FrameSlot,
        Seen { scene, camera, settings }: Seen<'_>,
        (target, readbacks): (&Target, Readbacks),
        (profile, missing): (Option<Profile>, MissingPipelines),
        then: impl FnOnce(Execution<'_>, &Graph<'_, Body<'_>>, &Imports<'_>) -> Result<T>,
    ) -> Result<T> {
        // The surface as data has no opacity of its own: a pixel is of it or not.
        let edges = if readbacks.surface.is_some() { Edges::Hard } else { settings.edges };
        let settings = &Settings { edges, ..settings.clone() };
        let frame = self.frame_plan(arena, &[Placed::at_home(scene)], camera, settings)?;
        let [width, height] = settings.size_px;
        if target.extent != (vk::Extent2D { width, height }) {
            let vk::Extent2D { width: w, height: h } = target.extent;
            let problem = format!("{w}x{h} pixels, but the settings say {width}x{height}");
            return Err(Error::option("target", problem));
        }
        let counts_draws = self.device.facts().draw_indirect_count;
        // SAFETY: this function's contract.
        unsafe { slot.begin(passes::needs(&frame, settings, counts_draws), profile) }?;
        // SAFETY: this function's contract.
        let planes = unsafe { slot.planes(&frame.planes) }?;
        // The graph's bodies borrow the pool of sets while the execution borrows the rest of the slot.
        let SlotParts { descriptors, occlusion, execution } = slot.parts()?;
        let inputs = Inputs::new(camera, settings, Place::Device(&self.shaders, descriptors));
        let source = Source { missing, ..inputs.source.cut_by(planes) };
        let inputs = Inputs { occlusion, range: frame.range, source, ..inputs };
        let (graph, imports) = declare(arena, inputs, &frame, target, readbacks)?;
        then(execution, &graph, &imports)
    }
}
