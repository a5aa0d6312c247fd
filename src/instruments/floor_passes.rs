//! The floor under the three passes: the same pixels through the same fixed-function stages, with nothing computed.
//!
//! Position and size of every point are precomputed, by the very setup that the splat passes use. Then, pass by pass:
//! depth is written; a constant is added into sums of the same formats, with the depth test against the first; a
//! constant fills the target. What a splat pass costs more is its own work.

pub(crate) mod limits;

use ash::vk;

use crate::passes::pipeline::formats::{DEPTH_FORMAT, sum_format};
use crate::passes::{
    cull::dispatch::dispatch,
    inputs::Inputs,
    pass::Pass,
    pipeline::{
        key::{ComputeKey, GraphicsKey, Layout},
        variant::Constants,
    },
    place::{Place, lists},
    plan::draws::Draw,
};
use crate::{
    error::Result,
    graph::{Access, Buffer, ClearValue, Graph, Handle, Image, Start, execute::Body},
    scene::Settings,
    shaders::{self, config::*},
    vk::Blend,
};

/// Why there are its passes.
const WHY: &str = "bench floor: the same pixels with nothing computed";

/// Bytes of a point: its place in clip space, its reversed depth, its size in pixels; four floats.
pub const FLOOR_POINT_BYTES: u64 = 16;

/// What the pipeline is that precomputes the points.
fn points_key(variant: &Constants) -> ComputeKey {
    ComputeKey { shader: &shaders::FLOOR_POINTS_COMP, layout: Layout::List, constants: *variant }
}

/// What the pipelines of the three passes are, in their order.
fn keys(settings: &Settings, target_format: vk::Format) -> [GraphicsKey; 3] {
    let key = |fragment| {
        let stages = (&shaders::FLOOR_POINTS_VERT, fragment);
        GraphicsKey::new(stages, Layout::Splat, vk::PrimitiveTopology::POINT_LIST, [].into())
    };
    let depth = (vk::CompareOp::GREATER, true);
    [
        GraphicsKey { depth: Some(depth), ..key(&shaders::FLOOR_DEPTH_FRAG) },
        GraphicsKey {
            color_formats: [sum_format(settings.accumulate); 2].into(),
            blend: Blend::Add,
            depth: Some((vk::CompareOp::GREATER_OR_EQUAL, false)),
            ..key(&shaders::FLOOR_ADD_FRAG)
        },
        GraphicsKey {
            color_formats: [target_format].into(),
            ..GraphicsKey::fullscreen(&shaders::FLOOR_FILL_FRAG, Layout::Finalize, [].into())
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
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    draw: &'a Draw<'a>,
    number: usize,
    points: &mut Handle<Buffer>,
) -> Result<()> {
    let pass = Pass::new(graph, inputs.source, format_args!("floor points {number}"), WHY).write(
        lists(BIND_LIST_POINTS),
        points,
        Access::StorageWriteCompute,
        Start::Discard,
    );
    let pipeline = pass.compute(points_key(draw.variant))?;
    pass.finish(move |pass| {
        let groups = [draw.chunk.count.div_ceil(FLOOR_GROUP_SIZE), 1];
        dispatch(pass, draw.chunk, &draw.told(), pipeline, pass.set(Place::Lists(0))?, groups)
    });
    Ok(())
}

/// Declares the floor's three passes over precomputed points.
///
/// # Errors
/// Whatever the driver answers when a pipeline is made.
pub fn floor_frame<'a>(
    graph: &mut Graph<'a, Body<'a>>,
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

    let far = Start::Clear(ClearValue::Depth(0.0));
    let pass = Pass::new(graph, inputs.source, "floor depth", WHY);
    draw_points(pass.attach(&mut depth, Access::DepthAttachment, far), depth_key, points)?;

    let zero = Start::Clear(ClearValue::Color([0.0; 4]));
    let pass = Pass::new(graph, inputs.source, "floor add", WHY)
        .attach(&mut color, Access::ColorAttachment, zero)
        .attach(&mut normal, Access::ColorAttachment, zero)
        .uses(&depth, Access::DepthTest);
    draw_points(pass, add_key, points)?;

    // Reads the sums, though the shader doesn't: so that nothing is culled and they are stored.
    let pass = Pass::new(graph, inputs.source, "floor fill", WHY)
        .uses(&color, Access::SampledFragment)
        .uses(&normal, Access::SampledFragment)
        .attach(target, Access::ColorAttachment, Start::Discard);
    let pipeline = pass.graphics(fill_key)?;
    pass.finish(move |pass| {
        pass.bind(pipeline);
        pass.draw([3, 1]);
        Ok(())
    });
    Ok(())
}

/// Declares the pass that draws the points.
fn draw_points(mut pass: Pass<'_, '_>, key: GraphicsKey, points: &[FloorPoints<'_>]) -> Result<()> {
    for (chunk, points) in (0..).zip(points) {
        let at = Place::Lists(chunk).at(BIND_LIST_POINTS);
        pass = pass.read(at, points.buffer, Access::StorageReadVertex);
    }
    let pipeline = pass.graphics(key)?;
    let counts = pass.arena().list(points.iter().map(|chunk| chunk.count));
    pass.finish(move |pass| {
        pass.bind(pipeline);
        for (chunk, count) in (0..).zip(counts.iter().copied()) {
            pass.bind_sets(pipeline.layout, 1, &[pass.set(Place::Lists(chunk))?])?;
            pass.draw([count, 1]);
        }
        Ok(())
    });
    Ok(())
}
