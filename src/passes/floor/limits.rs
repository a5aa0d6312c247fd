//! What the device can do at most, one thing at a time: points without fragments, fragments without computing, blending,
//! copies, invocations, atomics. Each is a pass of its own that repeats the one thing, and nothing else, for long enough to be timed.
//!
//! Fragments come from points of 32 pixels: a triangle over the whole image would be drawn only once by a driver that
//! sees that the next one hides it tile by tile.

use ash::vk;

use super::super::{
    DEPTH_FORMAT, Shaders,
    pipelines::{ComputeKey, GraphicsKey, Layout},
    sum_format,
};
use crate::{
    error::{Error, ErrorKind, Result},
    graph::{
        Access, Buffer, ClearValue, Graph, Handle, Image, ImageDesc, ResourceId, Start,
        execute::{Body, PassContext},
    },
    report::Limit,
    scene::Settings,
    shaders,
    vk::{Blend, Descriptor, DescriptorPool},
};

/// Invocations of a workgroup, as in `glsl/limit_compute.comp.glsl` and `limit_atomics.comp.glsl`.
pub const LIMIT_GROUP: u64 = 256;

/// Workgroups in a row.
pub const LIMIT_GROUPS: u32 = 4096;

/// What the pass of a limit is given.
#[derive(Clone, Copy)]
pub struct LimitInputs<'a> {
    /// Size of the image and format of the sums.
    pub settings: &'a Settings,
    /// Pipelines and their layouts.
    pub shaders: &'a Shaders,
    /// Room for a set of lists.
    pub descriptors: &'a DescriptorPool,
    /// How often the work is done in the pass.
    pub repeats: u32,
}

impl LimitInputs<'_> {
    fn image(&self, graph: &mut Graph<Body<'_>>, name: &str, format: vk::Format) -> Handle<Image> {
        let [width, height] = self.settings.size_px;
        graph.create_image(name, ImageDesc { format, extent: vk::Extent2D { width, height } })
    }
}

/// Declares the pass that draws points: those of `count` in `points`, which lie outside of the clip volume for
/// [`Limit::Points`], are a pixel each for [`Limit::DrawnPoints`], and cover the image for limits of fragments.
///
/// # Errors
/// [`ErrorKind::Graph`] for a limit that is not one of drawing; whatever the driver answers when the pipeline is made.
pub fn limit_draws<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: LimitInputs<'a>,
    limit: Limit,
    points: &Handle<Buffer>,
    count: u32,
) -> Result<()> {
    let key = |fragment| {
        let stages = (&shaders::FLOOR_POINTS_VERT, fragment);
        GraphicsKey::new(stages, Layout::Splat, vk::PrimitiveTopology::POINT_LIST, Vec::new())
    };
    let sums = sum_format(inputs.settings.accumulate);
    let color = vk::Format::R8G8B8A8_UNORM;
    let mut far = 0.0;
    let (key, colors) = match limit {
        Limit::Points | Limit::Fragments => (key(&shaders::FLOOR_FILL_FRAG), vec![color]),
        Limit::DrawnPoints => {
            far = 1.0;
            let depth = Some((vk::CompareOp::GREATER, true));
            (GraphicsKey { depth, ..key(&shaders::FLOOR_DEPTH_FRAG) }, Vec::new())
        }
        // All have one depth, so that every fragment passes and is written.
        Limit::DepthFragments => {
            let depth = Some((vk::CompareOp::GREATER_OR_EQUAL, true));
            (GraphicsKey { depth, ..key(&shaders::FLOOR_DEPTH_FRAG) }, Vec::new())
        }
        Limit::BlendedFragments => {
            (GraphicsKey { blend: Blend::Add, ..key(&shaders::FLOOR_ADD_FRAG) }, vec![sums; 2])
        }
        Limit::Bytes | Limit::Invocations | Limit::Atomics => return Err(not_of(limit, "drawing")),
    };
    let has_depth = key.depth.is_some();
    let pipeline = inputs.shaders.graphics(GraphicsKey { color_formats: colors.clone(), ..key })?;
    let mut images: Vec<_> = (0..)
        .zip(colors)
        .map(|(i, format)| inputs.image(graph, &format!("limit color {i}"), format))
        .collect();
    let mut depth = has_depth.then(|| inputs.image(graph, "limit depth", DEPTH_FORMAT));
    // Nobody reads what is drawn.
    let mut pass = graph.pass(limit.name()).read(points, Access::StorageReadVertex).side_effect();
    for image in &mut images {
        pass = pass.write(image, Access::ColorAttachment, Start::Clear(ClearValue::Color([0.0; 4])));
    }
    if let Some(depth) = &mut depth {
        pass = pass.write(depth, Access::DepthAttachment, Start::Clear(ClearValue::Depth(far)));
    }
    let id = points.id();
    pass.finish(Box::new(move |context| {
        let (device, commands) = (context.device(), context.commands());
        let bind_point = vk::PipelineBindPoint::GRAPHICS;
        let layout = inputs.shaders.splat_layout.raw();
        let set = set_of(context, inputs, id)?;
        // SAFETY: inside of rendering; pipeline and set have one layout.
        unsafe {
            device.cmd_bind_pipeline(commands, bind_point, pipeline.raw());
            device.cmd_bind_descriptor_sets(commands, bind_point, layout, 1, &[set], &[]);
            for _ in 0..inputs.repeats {
                device.cmd_draw(commands, count, 1, 0, 0);
            }
        }
        Ok(())
    }));
    Ok(())
}

/// Declares the pass that fills a buffer: memory that was never written may not be there at all.
pub fn limit_fill(graph: &mut Graph<Body<'_>>, buffer: &mut Handle<Buffer>) {
    let id = buffer.id();
    graph.pass("fill what is copied").write(buffer, Access::TransferWrite, Start::Discard).finish(Box::new(
        move |context| {
            // SAFETY: outside of rendering; all of a buffer made for transfers, whose size is a multiple of 4.
            unsafe {
                let (device, commands) = (context.device(), context.commands());
                device.cmd_fill_buffer(commands, context.buffer(id)?, 0, vk::WHOLE_SIZE, 0x3c5a_96e1);
            }
            Ok(())
        },
    ));
}

/// Declares the pass that copies `size_bytes` once.
pub fn limit_copy(
    graph: &mut Graph<Body<'_>>,
    from: &Handle<Buffer>,
    to: &mut Handle<Buffer>,
    size_bytes: u64,
) {
    let (from_id, to_id) = (from.id(), to.id());
    graph
        .pass(Limit::Bytes.name())
        .read(from, Access::TransferRead)
        .write(to, Access::TransferWrite, Start::Discard)
        .finish(Box::new(move |context| {
            let region = vk::BufferCopy::default().size(size_bytes);
            let (from, to) = (context.buffer(from_id)?, context.buffer(to_id)?);
            // SAFETY: outside of rendering; two buffers of at least that size.
            unsafe { context.device().cmd_copy_buffer(context.commands(), from, to, &[region]) };
            Ok(())
        }));
}

/// Declares the pass that dispatches [`LIMIT_GROUPS`] × `repeats` workgroups of [`LIMIT_GROUP`] invocations: for
/// [`Limit::Invocations`], with 4 bytes in `words` for each group of a row; for [`Limit::Atomics`], for each invocation of one.
///
/// # Errors
/// [`ErrorKind::Graph`] for a limit that is not one of compute; whatever the driver answers when the pipeline is made.
pub fn limit_dispatch<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: LimitInputs<'a>,
    limit: Limit,
    words: &mut Handle<Buffer>,
) -> Result<()> {
    let (shader, access, content) = match limit {
        Limit::Invocations => (&shaders::LIMIT_COMPUTE_COMP, Access::StorageWriteCompute, Start::Discard),
        Limit::Atomics => (&shaders::LIMIT_ATOMICS_COMP, Access::StorageReadWriteCompute, Start::Load),
        _ => return Err(not_of(limit, "dispatches")),
    };
    let key = ComputeKey { shader, layout: Layout::List, constants: Vec::new() };
    let pipeline = inputs.shaders.compute(key)?;
    let id = words.id();
    graph.pass(limit.name()).write(words, access, content).finish(Box::new(move |context| {
        let (device, commands) = (context.device(), context.commands());
        let bind_point = vk::PipelineBindPoint::COMPUTE;
        let layout = inputs.shaders.list_layout.raw();
        let set = set_of(context, inputs, id)?;
        // SAFETY: pipeline and set have one layout, whose push constants the shader does not use.
        unsafe {
            device.cmd_bind_pipeline(commands, bind_point, pipeline.raw());
            device.cmd_bind_descriptor_sets(commands, bind_point, layout, 1, &[set], &[]);
            device.cmd_dispatch(commands, LIMIT_GROUPS, inputs.repeats, 1);
        }
        Ok(())
    }));
    Ok(())
}

fn not_of(limit: Limit, kind: &str) -> Error {
    let (pass, reason) = (limit.name().to_owned(), format!("is not a limit of {kind}"));
    ErrorKind::Graph { pass, resource: String::new(), reason }.into()
}

/// Set 1 with one buffer.
fn set_of(
    context: &PassContext<'_>,
    inputs: LimitInputs<'_>,
    buffer: ResourceId,
) -> Result<vk::DescriptorSet> {
    let given = [(0, Descriptor::Buffer(context.buffer(buffer)?))];
    inputs.descriptors.set(&inputs.shaders.list_set, &given)
}
