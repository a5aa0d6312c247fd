//! Runs `probe.comp.glsl`: the renderer's own formulas on the device, on splats that took the renderer's own way from f64
//! to f32.

use std::{fs, path::Path};

use ash::vk;
use bytemuck::{Pod, Zeroable};
use glam::{DVec2, DVec3};
use surfel::{
    arena::Arena,
    passes::{DepthRange, FrameConstants, draws},
    prepare::PreparedScene,
    renderer::Headless,
    scene::{Camera, Filter, Settings},
    vk::{
        Binding, Buffer, BufferDesc, ComputePipeline, ComputePipelineDesc, Descriptor, DescriptorPool,
        MemoryUse, PipelineCache, PipelineLayout, PoolSizes, SetLayout, Stage,
    },
};

/// Places a question, as in the shader.
pub const PLACES: usize = 16;

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Question {
    world_p: [f32; 4],
    places: [[f32; 4]; PLACES],
}

/// What the shader answers; see there.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Answer {
    state: [f32; 4],
    pub box_px: [f32; 4],
    pub naive_box_px: [f32; 4],
    pub world_box_px: [f32; 4],
    p: [f32; 4],
    s: [f32; 4],
    t: [f32; 4],
    padding: [f32; 4],
    pub point: [[f32; 4]; PLACES],
    pub quad: [[f32; 4]; PLACES],
    pub naive: [[f32; 4]; PLACES],
    pub world: [[f32; 4]; PLACES],
}

impl Answer {
    pub fn is_seen(&self) -> bool {
        self.state[0] > 0.0
    }

    pub fn is_regular(&self) -> bool {
        self.state[1] > 0.0
    }

    /// Center and tangent vectors after the filter, in the chunk's view unit.
    pub fn splat(&self) -> [DVec3; 3] {
        [self.p, self.s, self.t].map(|v| DVec3::new(v[0].into(), v[1].into(), v[2].into()))
    }
}

/// A scene of one splat on the device, how it is seen, and where its (u, v) is asked for.
pub struct Asked<'a> {
    pub scene: &'a PreparedScene,
    pub position: DVec3,
    pub camera: &'a Camera,
    pub settings: &'a Settings,
    pub places_px: Vec<DVec2>,
}

/// The answers, in order. `wrong`: a formula that is made wrong by 1%, by its name in `glsl/inc/perturb.glsl`.
pub fn ask(headless: &Headless, asked: &[Asked<'_>], wrong: Option<&str>) -> Vec<Answer> {
    let device = headless.device();
    let spirv = compile();
    let compute = vk::ShaderStageFlags::COMPUTE;
    let binding = Binding { kind: vk::DescriptorType::STORAGE_BUFFER, stages: compute };
    let set_layout = SetLayout::new(device, "probe", &[binding; 2]).unwrap();
    let sets = [headless.renderer.shaders().splat_set.set(), &set_layout];
    let push_bytes = size_of::<FrameConstants>() as u32;
    let layout = PipelineLayout::new(device, "probe", &sets, push_bytes, compute).unwrap();
    let cache = PipelineCache::open(device, None).unwrap();
    let pipeline = |ellipses: bool, filter: bool| {
        // ELLIPSES, FILTER of glsl/inc/variant.glsl, PERTURBED_FORMULA of glsl/inc/perturb.glsl.
        let constants = [(0, u32::from(ellipses)), (2, u32::from(filter)), (31, wrong.map_or(0, number_of))];
        let stage = Stage { name: "probe", spirv: &spirv, constants: &constants };
        let desc = ComputePipelineDesc { name: "probe", stage, layout: &layout };
        // SAFETY: compiled for this layout.
        unsafe { ComputePipeline::new(device, &cache, &desc) }.unwrap()
    };
    let pipelines =
        [[pipeline(false, false), pipeline(false, true)], [pipeline(true, false), pipeline(true, true)]];

    let questions: Vec<Question> = asked.iter().map(question).collect();
    let buffer = |name, size, memory| {
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER;
        Buffer::new(device, BufferDesc { name, size, usage }, memory).unwrap()
    };
    let mut given = buffer("questions", size_of_val(&questions[..]) as u64, MemoryUse::Upload);
    // SAFETY: the device has not seen it yet.
    let room = unsafe { given.bytes_mut() };
    room.copy_from_slice(bytemuck::cast_slice(&questions));
    let answers = buffer("answers", (asked.len() * size_of::<Answer>()) as u64, MemoryUse::Readback);
    let pool =
        DescriptorPool::new(device, "probe", PoolSizes { sets: 1, buffers: 2, ..PoolSizes::default() })
            .unwrap();
    let whole = |buffer: &Buffer| Descriptor::Buffer(buffer.raw(), buffer.size());
    let bound = [(0, whole(&given)), (1, whole(&answers))];
    // SAFETY: buffers of this device, which live until the wait.
    let set = unsafe { pool.set(&set_layout, &bound) }.unwrap();

    let limits = device.facts().limits;
    headless
        .queue()
        .run_once("probe", |commands| {
            let raw = device.raw();
            for (number, asked) in asked.iter().enumerate() {
                let arena = Arena::new();
                let draw = draws(
                    &arena,
                    surfel::prepare::Placed::at_home(asked.scene),
                    (asked.camera, DepthRange::default()),
                    asked.settings,
                    &limits,
                );
                let draw = draw.into_iter().next().unwrap();
                let constants = FrameConstants { splat_count: number as u32, ..draw.constants };
                let filter = usize::from(asked.settings.filter == Filter::Adjust);
                let pipeline = &pipelines[usize::from(draw.chunk.ellipses)][filter];
                let bind_point = vk::PipelineBindPoint::COMPUTE;
                // SAFETY: pipeline, sets and constants have one layout; each dispatch writes an answer of its own.
                unsafe {
                    raw.cmd_bind_pipeline(commands, bind_point, pipeline.raw());
                    let sets = [draw.chunk.set(), set];
                    raw.cmd_bind_descriptor_sets(commands, bind_point, layout.raw(), 0, &sets, &[]);
                    let bytes = bytemuck::bytes_of(&constants);
                    raw.cmd_push_constants(commands, layout.raw(), compute, 0, bytes);
                    raw.cmd_dispatch(commands, 1, 1, 1);
                }
            }
            let barrier = [vk::MemoryBarrier2::default()
                .src_stage_mask(vk::PipelineStageFlags2::COMPUTE_SHADER)
                .src_access_mask(vk::AccessFlags2::SHADER_STORAGE_WRITE)
                .dst_stage_mask(vk::PipelineStageFlags2::HOST)
                .dst_access_mask(vk::AccessFlags2::HOST_READ)];
            // SAFETY: the command buffer is recording.
            unsafe {
                raw.cmd_pipeline_barrier2(commands, &vk::DependencyInfo::default().memory_barriers(&barrier));
            }
            Ok(())
        })
        .unwrap();
    // SAFETY: waited for.
    unsafe { answers.bytes() }.chunks_exact(size_of::<Answer>()).map(bytemuck::pod_read_unaligned).collect()
}

fn question(asked: &Asked<'_>) -> Question {
    let mut places = [[0.0; 4]; PLACES];
    for (place, px) in places.iter_mut().zip(&asked.places_px) {
        *place = [px.x as f32, px.y as f32, 0.0, 0.0];
    }
    // As a shader does that is given world coordinates and a matrix: all of it in f32.
    let view = asked.camera.view_from_world();
    let scale = asked.scene.chunks()[0].rebase.view_from_local(asked.camera).view_from_world_scale;
    let rotation = view.rotation.as_mat3();
    let translation = (view.rotation * -view.eye).as_vec3();
    let p = (rotation * asked.position.as_vec3() + translation) * scale as f32;
    Question { world_p: p.extend(0.0).into(), places }
}

fn number_of(formula: &str) -> u32 {
    let text = include_str!("../../../glsl/inc/perturb.glsl");
    let define = format!("#define FORMULA_{formula} ");
    text.lines().find_map(|line| line.strip_prefix(&define)).expect(formula).parse().unwrap()
}

/// The probe as SPIR-V, with the includes and options of the crate's own shaders.
fn compile() -> Vec<u32> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let source = fs::read_to_string(root.join("tests/gpu/stability/probe.comp.glsl")).unwrap();
    let mut options = shaderc::CompileOptions::new().unwrap();
    options.set_target_env(shaderc::TargetEnv::Vulkan, shaderc::EnvVersion::Vulkan1_3 as u32);
    options.set_target_spirv(shaderc::SpirvVersion::V1_6);
    options.set_optimization_level(shaderc::OptimizationLevel::Performance);
    options.add_macro_definition("TEST_FORMULAS", None);
    options.set_include_callback(|name, _, _, _| {
        let path = root.join("glsl").join(name);
        let content = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        Ok(shaderc::ResolvedInclude { resolved_name: path.display().to_string(), content })
    });
    let compiler = shaderc::Compiler::new().unwrap();
    let kind = shaderc::ShaderKind::Compute;
    match compiler.compile_into_spirv(&source, kind, "probe.comp.glsl", "main", Some(&options)) {
        Ok(compiled) => compiled.as_binary().to_vec(),
        Err(error) => panic!("{error}"),
    }
}
