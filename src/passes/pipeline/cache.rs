//! Pipelines, made when a frame first needs them, and the layouts that they share.

mod kept;
mod missing;
mod ran;

use std::{
    path::Path,
    sync::{Arc, Mutex, atomic::AtomicU64},
};

use ash::vk;

use crate::passes::{
    pipeline::tile_layouts::{STORAGE_BUFFERS, TileLayouts},
    pipeline::{
        constants,
        key::{ComputeKey, GraphicsKey, Layout},
        made::Made,
        variant::Constants,
    },
};
use crate::{
    error::{Error, Result},
    prepare::SplatSetLayout,
    shaders::{Shader, config::*},
    vk::{
        Binding, ComputePipeline, ComputePipelineDesc, DepthState, Device, GraphicsPipeline,
        GraphicsPipelineDesc, MemoryNeeds, PipelineCache, PipelineLayout, PoolSizes, SetLayout, Stage,
        StandIns,
    },
};

pub use missing::MissingPipelines;
pub(crate) use ran::Run;
use ran::{Ran, number_of_compute, number_of_graphics};

/// Bindings of set 1 of the splat passes.
const LIST_BINDINGS: u32 = BIND_LIST_BLOCKS + 1;

const _: () = assert!(3 + LIST_BINDINGS <= crate::vk::LEAST_STORAGE_BUFFERS);

/// Room for so many sets of lists: all bindings count, whatever a set has in them.
pub fn room_of_lists(sets: u32) -> PoolSizes {
    PoolSizes { sets, buffers: LIST_BINDINGS * sets, uniform_buffers: sets, ..PoolSizes::default() }
}

/// The layouts of all passes and the pipelines made so far.
pub struct Shaders {
    device: Device,
    graphics: Made<GraphicsKey, GraphicsPipeline>,
    compute: Made<ComputeKey, ComputePipeline>,
    /// How often a pipeline was asked for.
    asked: AtomicU64,
    /// How many were made.
    made: AtomicU64,
    ran: Mutex<Ran>,
    cache: PipelineCache,
    stand_ins: Arc<StandIns>,
    /// Set 0 of the splat passes.
    pub splat_set: SplatSetLayout,
    /// Set 1 of the splat passes: `BIND_LIST_*`.
    pub(crate) list_set: SetLayout,
    /// Set 2 of the splat passes and of polygons: `BIND_READ_*`.
    pub(crate) read_set: SetLayout,
    /// Set 0 of the passes over the whole image: `BIND_SUMS_*`.
    pub(crate) sums_set: SetLayout,
    /// Set 0 of the hierarchy of depth: the depth, the hierarchy.
    pub(crate) cells_set: SetLayout,
    /// Set 1 of what is laid over a host's picture: whose the surface is, and what is known of that.
    pub(crate) objects_set: SetLayout,
    pub(crate) splat_layout: PipelineLayout,
    /// The sets and constants of the splat passes for compute alone. lavapipe of Mesa 22.3 crashes where a query of
    /// counts begins after constants were pushed for the stages of a graphics pipeline and before one was bound.
    pub(crate) list_layout: PipelineLayout,
    pub(crate) finalize_layout: PipelineLayout,
    /// What meets a host's depth.
    pub(crate) host_layout: PipelineLayout,
    pub(crate) cells_layout: PipelineLayout,
    /// Those of tiles; none on a device with too few storage buffers.
    tiles: Option<TileLayouts>,
    /// The formula that is made wrong; for tests of the tests.
    #[cfg(feature = "test-formulas")]
    pub(crate) perturbed: Option<crate::passes::pipeline::formula::Formula>,
}

impl Shaders {
    /// Layouts without any pipeline yet. Compiled pipelines are kept in `cache_folder` from run to run.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn new(device: &Device, cache_folder: Option<&Path>) -> Result<Self> {
        let (vertex, fragment, compute) =
            (vk::ShaderStageFlags::VERTEX, vk::ShaderStageFlags::FRAGMENT, vk::ShaderStageFlags::COMPUTE);
        let buffer = Binding { kind: vk::DescriptorType::STORAGE_BUFFER, stages: vertex | compute };
        let lights = Binding { kind: vk::DescriptorType::UNIFORM_BUFFER, stages: vertex | fragment };
        let image = Binding { kind: vk::DescriptorType::SAMPLED_IMAGE, stages: fragment };
        let splat_set = SplatSetLayout::new(device)?;
        let stand_ins = Arc::new(StandIns::new(device));
        let set = |name, bindings: &[Binding]| -> Result<SetLayout> {
            Ok(SetLayout::new(device, name, bindings)?.with_stand_ins(&stand_ins, &[]))
        };
        let planes = |stages| Binding { kind: vk::DescriptorType::UNIFORM_BUFFER, stages };
        let mut of_lists = vec![buffer; LIST_BINDINGS as usize];
        of_lists.push(planes(compute));
        let list_set = set("lists", &of_lists)?;
        let filtered = Binding { kind: vk::DescriptorType::COMBINED_IMAGE_SAMPLER, stages: fragment };
        let tints = Binding { kind: vk::DescriptorType::STORAGE_BUFFER, stages: vertex };
        let read_set = set("read by fragments", &[image, filtered, image, lights, planes(fragment), tints])?;
        let sums_set = set("sums", &[image, image, image, image, image, lights])?;
        let splat_layout = PipelineLayout::new(
            device,
            "splat passes",
            &[splat_set.set(), &list_set, &read_set],
            size_of::<constants::FrameConstants>() as u32,
            vertex | fragment,
        )?;
        let list_layout = PipelineLayout::new(
            device,
            "lists",
            &[splat_set.set(), &list_set],
            size_of::<constants::FrameConstants>() as u32,
            compute,
        )?;
        let finalize_layout = PipelineLayout::new(
            device,
            "finalization",
            &[&sums_set],
            size_of::<constants::FinalizeConstants>() as u32,
            fragment,
        )?;
        let of_fragments = Binding { kind: vk::DescriptorType::STORAGE_BUFFER, stages: fragment };
        let objects_set = set("objects of a host", &[image, of_fragments])?;
        let host_layout = PipelineLayout::new(
            device,
            "beside a host",
            &[&sums_set, &objects_set],
            size_of::<constants::HostDepth>() as u32,
            fragment,
        )?;
        let fetched = Binding { kind: vk::DescriptorType::SAMPLED_IMAGE, stages: compute };
        let cells_set = set("cells of depth", &[fetched, buffer])?;
        let size_px = size_of::<[u32; 2]>() as u32;
        let cells_layout = PipelineLayout::new(device, "cells of depth", &[&cells_set], size_px, compute)?;
        let has_tiles = device.facts().limits.storage_buffers_a_stage >= STORAGE_BUFFERS;
        let tiles = has_tiles
            .then(|| TileLayouts::new(device, splat_set.set(), &sums_set, &stand_ins))
            .transpose()?;
        Ok(Self {
            device: device.clone(),
            graphics: Made::default(),
            compute: Made::default(),
            asked: AtomicU64::new(0),
            made: AtomicU64::new(0),
            ran: Mutex::default(),
            cache: PipelineCache::open(device, cache_folder)?,
            stand_ins,
            splat_set,
            list_set,
            read_set,
            sums_set,
            splat_layout,
            list_layout,
            finalize_layout,
            host_layout,
            cells_set,
            objects_set,
            cells_layout,
            tiles,
            #[cfg(feature = "test-formulas")]
            perturbed: None,
        })
    }

    /// Records what a frame's sets need before its passes.
    ///
    /// # Errors
    /// Whatever the driver or the allocator answers.
    ///
    /// # Safety
    /// As [`StandIns::make_ready`].
    pub unsafe fn begin_frame(&self, commands: vk::CommandBuffer) -> Result<()> {
        // SAFETY: this function's contract.
        unsafe { self.stand_ins.make_ready(commands) }
    }

    /// Adds what memory a first frame will ask for to what is needed: as [`StandIns::tell`].
    pub(crate) fn tell(&self, needs: &mut MemoryNeeds) -> Result<()> {
        self.stand_ins.tell(needs)
    }

    /// Writes compiled pipelines to the cache's file.
    ///
    /// # Errors
    /// Whatever the driver or the file system answers.
    pub fn save_cache(&self) -> Result<()> {
        self.cache.save()
    }

    /// The layouts of tiles, on a device that has them.
    pub(crate) fn tiles(&self) -> Result<&TileLayouts> {
        let reason = "compute: the device has too few storage buffers for a stage";
        self.tiles.as_ref().ok_or_else(|| Error::option("--rasterizer", reason.to_owned()))
    }

    pub(crate) fn layout(&self, layout: Layout) -> Result<&PipelineLayout> {
        Ok(match layout {
            Layout::Splat => &self.splat_layout,
            Layout::List => &self.list_layout,
            Layout::Finalize => &self.finalize_layout,
            Layout::Host => &self.host_layout,
            Layout::DepthCells => &self.cells_layout,
            Layout::Record => &self.tiles()?.record,
            Layout::Tile => &self.tiles()?.tile,
            Layout::TileQuads => &self.tiles()?.quads,
        })
    }

    /// A pipeline, made where there is none yet. It is alive until [`Self::keep_newest`] drops it, and then until what is recorded by then
    /// is done.
    pub(crate) fn graphics(&self, key: GraphicsKey) -> Result<vk::Pipeline> {
        self.graphics_if(key, MissingPipelines::Make)
    }

    /// The same, and what is done where it is not there.
    pub(crate) fn graphics_if(
        &self,
        mut key: GraphicsKey,
        missing: MissingPipelines,
    ) -> Result<vk::Pipeline> {
        self.perturb(&mut key.constants);
        self.graphics.get(key, self.now(), |key| {
            self.makes(missing, || key.name())?;
            let constants = &key.constants;
            let desc = GraphicsPipelineDesc {
                name: &key.name(),
                vertex: key.vertex.stage(constants),
                fragment: key.fragment.stage(constants),
                topology: key.topology,
                cull_clockwise: key.cull_clockwise,
                color_formats: &key.color_formats,
                blend: key.blend,
                depth: key.depth.map(|(compare, write)| DepthState {
                    format: key.depth_format,
                    compare,
                    write,
                }),
                attachments: key.attachments,
                layout: self.layout(key.layout)?,
            };
            // SAFETY: shaders of `glsl/` with their own layouts, on a device that has what they need; keys have formats that it draws into.
            let pipeline = unsafe { GraphicsPipeline::new(&self.device, &self.cache, &desc) }?;
            self.ran().made(pipeline.raw(), number_of_graphics(key));
            Ok(pipeline)
        })
    }

    /// As [`Self::graphics`].
    pub(crate) fn compute(&self, key: ComputeKey) -> Result<vk::Pipeline> {
        self.compute_if(key, MissingPipelines::Make)
    }

    /// The same, and what is done where it is not there.
    pub(crate) fn compute_if(&self, mut key: ComputeKey, missing: MissingPipelines) -> Result<vk::Pipeline> {
        self.perturb(&mut key.constants);
        self.compute.get(key, self.now(), |key| {
            self.makes(missing, || key.shader.name.to_owned())?;
            let desc = ComputePipelineDesc {
                name: key.shader.name,
                stage: key.shader.stage(&key.constants),
                layout: self.layout(key.layout)?,
            };
            // SAFETY: as above.
            let pipeline = unsafe { ComputePipeline::new(&self.device, &self.cache, &desc) }?;
            self.ran().made(pipeline.raw(), number_of_compute(key));
            Ok(pipeline)
        })
    }

    #[cfg(feature = "test-formulas")]
    fn perturb(&self, constants: &mut Constants) {
        if let Some(formula) = self.perturbed {
            constants.push((SPEC_PERTURBED_FORMULA, formula as u32));
        }
    }

    #[cfg(not(feature = "test-formulas"))]
    fn perturb(&self, _constants: &mut Constants) {}
}

impl Shader {
    /// The stage of a pipeline with these specialization constants.
    fn stage<'a>(&'static self, constants: &'a Constants) -> Stage<'a> {
        Stage { name: self.name, spirv: self.spirv(), constants }
    }
}
