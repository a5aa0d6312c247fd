//! The floor under the three passes: the same pixels through the same fixed-function stages, with nothing computed.
//!
//! Position and size of every point are precomputed, by the very setup that the splat passes use. Then, pass by pass:
//! depth is written; a constant is added into sums of the same formats, with the depth test against the first; a
//! constant fills the target. What a splat pass costs more is its own work.

pub(crate) mod limits;

use ash::vk;

use crate::passes::pipeline::formats::{DEPTH_FORMAT, sum_format};
use crate::passes::{
    inputs::Inputs,
    pipeline::{
        cache::{ComputeKey, GraphicsKey, Layout},
        variant::Constants,
    },
    plan::draws::Draw,
};
use crate::{
    error::Result,
    graph::{Access, Buffer, ClearValue, Graph, Handle, Image, Start, execute::Body},
    scene::Settings,
    shaders::{self, config::*},
    vk::Blend,
};

/// Bytes of a point: its place in clip space, its reversed depth, its size in pixels; four floats.
pub const FLOOR_POINT_BYTES: u64 = 16;

/// Invocations of a workgroup, as in `glsl/floor_points.comp.glsl`.
const GROUP: u32 = 256;

/// What the pipeline is that precomputes the points.
pub(crate) fn points_key(variant: &Constants) -> ComputeKey {
    ComputeKey { shader: &shaders::FLOOR_POINTS_COMP, layout: Layout::List, constants: variant.clone() }
}

/// What the pipelines of the three passes are, in their order.
pub(crate) fn keys(settings: &Settings, target_format: vk::Format) -> [GraphicsKey; 3] {
    let key = |fragment| {
        let stages = (&shaders::FLOOR_POINTS_VERT, fragment);
        GraphicsKey::new(stages, Layout::Splat, vk::PrimitiveTopology::POINT_LIST, Vec::new())
    };
    let depth = (vk::CompareOp::GREATER, true);
    [
        GraphicsKey { depth: Some(depth), ..key(&shaders::FLOOR_DEPTH_FRAG) },
        GraphicsKey {
            color_formats: vec![sum_format(settings.accumulate); 2],
            blend: Blend::Add,
            depth: Some((vk::CompareOp::GREATER_OR_EQUAL, false)),
            ..key(&shaders::FLOOR_ADD_FRAG)
        },
        GraphicsKey {
            color_formats: vec![target_format],
            ..GraphicsKey::fullscreen(&shaders::FLOOR_FILL_FRAG, Layout::Finalize, Vec::new())
        },
    ]
}

/// The precomputed points of a chunk.
pub struct FloorPoints<'a> {
    /// [`FLOOR_POINT_BYTES`] each.
    pub buffer: &'a Handle<Buffer>,
    /// How many are drawn.
    pub count: u32,
}

/// Declares the pass that precomputes the points of one chunk, the one with this number.
///
/// # Errors
/// Whatever the driver answers when a pipeline is made.
pub fn floor_points<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    draw: &'a Draw<'a>,
    number: usize,
    points: &mut Handle<Buffer>,
) -> Result<()> {
    let layout = &inputs.shaders.list_layout;
    let pipeline = inputs.shaders.compute(points_key(&draw.variant))?;
    let id = points.id();
    graph
        .pass(&format!("floor points {number}"))
        .write(points, Access::StorageWriteCompute, Start::Discard)
        .finish(Box::new(move |context| {
            let given = [(BIND_LIST_POINTS, context.descriptor(id)?)];
            let sets = [draw.chunk.set(), inputs.descriptors.set(&inputs.shaders.list_set, &given)?];
            let (device, commands) = (context.device(), context.commands());
            let bind_point = vk::PipelineBindPoint::COMPUTE;
            // SAFETY: pipeline, sets and push constants have one layout.
            unsafe {
                device.cmd_bind_pipeline(commands, bind_point, pipeline.raw());
                device.cmd_bind_descriptor_sets(commands, bind_point, layout.raw(), 0, &sets, &[]);
                let constants = bytemuck::bytes_of(&draw.constants);
                device.cmd_push_constants(commands, layout.raw(), layout.push_stages(), 0, constants);
                device.cmd_dispatch(commands, draw.chunk.count.div_ceil(GROUP), 1, 1);
            }
            Ok(())
        }));
    Ok(())
}

/// Declares the floor's three passes over precomputed points.
///
/// # Errors
/// Whatever the driver answers when a pipeline is made.
pub fn floor_frame<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    points: &[FloorPoints<'_>],
    target: &mut Handle<Image>,
    target_format: vk::Format,
) -> Result<()> {
    let sums = sum_format(inputs.settings.accumulate);
    let [depth_key, add_key, fill_key] = keys(inputs.settings, target_format);
    let mut depth = graph.create_image("floor depth", inputs.image(DEPTH_FORMAT));
    let mut color = graph.create_image("floor color sums", inputs.image(sums));
    let mut normal = graph.create_image("floor normal sums", inputs.image(sums));

    let body = draw_points(inputs, depth_key, points)?;
    let pass = graph.pass("floor depth").write(
        &mut depth,
        Access::DepthAttachment,
        Start::Clear(ClearValue::Depth(0.0)),
    );
    points.iter().fold(pass, |pass, chunk| pass.read(chunk.buffer, Access::StorageReadVertex)).finish(body);

    let body = draw_points(inputs, add_key, points)?;
    let zero = Start::Clear(ClearValue::Color([0.0; 4]));
    let pass = graph
        .pass("floor add")
        .write(&mut color, Access::ColorAttachment, zero)
        .write(&mut normal, Access::ColorAttachment, zero)
        .read(&depth, Access::DepthTest);
    points.iter().fold(pass, |pass, chunk| pass.read(chunk.buffer, Access::StorageReadVertex)).finish(body);

    let pipeline = inputs.shaders.graphics(fill_key)?;
    graph
        .pass("floor fill")
        // Reads the sums, though the shader doesn't: so that nothing is culled and they are stored.
        .read(&color, Access::SampledFragment)
        .read(&normal, Access::SampledFragment)
        .write(target, Access::ColorAttachment, Start::Discard)
        .finish(Box::new(move |context| {
            let (device, commands) = (context.device(), context.commands());
            // SAFETY: inside of rendering; the shaders use neither sets nor push constants.
            unsafe {
                device.cmd_bind_pipeline(commands, vk::PipelineBindPoint::GRAPHICS, pipeline.raw());
                device.cmd_draw(commands, 3, 1, 0, 0);
            }
            Ok(())
        }));
    Ok(())
}

/// The body that draws the points.
fn draw_points<'a>(inputs: Inputs<'a>, key: GraphicsKey, points: &[FloorPoints<'_>]) -> Result<Body<'a>> {
    let layout = &inputs.shaders.splat_layout;
    let pipeline = inputs.shaders.graphics(key)?;
    let chunks: Vec<_> = points.iter().map(|chunk| (chunk.buffer.id(), chunk.count)).collect();
    Ok(Box::new(move |context| {
        let (device, commands) = (context.device(), context.commands());
        let bind_point = vk::PipelineBindPoint::GRAPHICS;
        // SAFETY: inside of rendering.
        unsafe { device.cmd_bind_pipeline(commands, bind_point, pipeline.raw()) };
        for &(id, count) in &chunks {
            let given = [(BIND_LIST_POINTS, context.descriptor(id)?)];
            let set = inputs.descriptors.set(&inputs.shaders.list_set, &given)?;
            // SAFETY: inside of rendering; pipeline and set have one layout.
            unsafe {
                device.cmd_bind_descriptor_sets(commands, bind_point, layout.raw(), 1, &[set], &[]);
                device.cmd_draw(commands, count, 1, 0, 0);
            }
        }
        Ok(())
    }))
}
