//! The splat passes as Guennebaud, Barthe, Paulin 2006 publish them, without all that ours do for exactness: what the
//! instructions that we have more buy. For comparison only; see `glsl/inc/paper.glsl`.

use ash::vk;

use crate::passes::pipeline::formats::{DEPTH_FORMAT, sum_format};
use crate::passes::{
    inputs::Inputs,
    pipeline::{
        cache::{GraphicsKey, Layout},
        constants::PaperConstants,
    },
    plan::draws::Draw,
    resolve::finalize::{Opaque, finalize},
    splats::{accumulate::Sums, kernel_texture},
};
use crate::{
    error::Result,
    graph::{Access, ClearValue, Graph, Handle, Image, ResourceId, Start, execute::Body},
    scene::Settings,
    shaders::{self, config::*},
    vk::Blend,
};

/// What the pipelines of visibility and accumulation are. `filtered`: visibility too.
pub(crate) fn keys(settings: &Settings, filtered: bool) -> [GraphicsKey; 2] {
    let points = vk::PrimitiveTopology::POINT_LIST;
    let visibility = (&shaders::PAPER_VISIBILITY_VERT, &shaders::PAPER_VISIBILITY_FRAG);
    let accumulate = (&shaders::PAPER_ACCUMULATE_VERT, &shaders::PAPER_ACCUMULATE_FRAG);
    [
        GraphicsKey {
            depth: Some((vk::CompareOp::GREATER, true)),
            ..GraphicsKey::new(visibility, Layout::Splat, points, vec![(SPEC_FILTERED, filtered.into())])
        },
        GraphicsKey {
            color_formats: vec![sum_format(settings.accumulate); 2],
            blend: Blend::AddWeighted,
            depth: Some((vk::CompareOp::GREATER_OR_EQUAL, false)),
            ..GraphicsKey::new(accumulate, Layout::Splat, points, Vec::new())
        },
    ]
}

/// Declares the frame: the kernel's texture, both splat passes, our own finalization. `filtered`: visibility is filtered, which
/// the paper's is not.
///
/// # Errors
/// Whatever the driver answers when a pipeline is made.
pub fn paper_frame<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    target: &mut Handle<Image>,
    target_format: vk::Format,
    filtered: bool,
) -> Result<()> {
    let kernel = kernel_texture::kernel_texture(graph, inputs, true)?;
    let [visibility_key, accumulate_key] = keys(inputs.settings, filtered);
    let mut depth = graph.create_image("depth", inputs.image(DEPTH_FORMAT));
    let body = draw_points(inputs, visibility_key, kernel.id())?;
    graph
        .pass("paper visibility")
        .write(&mut depth, Access::DepthAttachment, Start::Clear(ClearValue::Depth(0.0)))
        .read(&kernel, Access::SampledFragment)
        .finish(body);

    let format = sum_format(inputs.settings.accumulate);
    let mut sums = Sums {
        color: graph.create_image("color sums", inputs.image(format)),
        normal: graph.create_image("normal sums", inputs.image(format)),
    };
    let body = draw_points(inputs, accumulate_key, kernel.id())?;
    let zero = Start::Clear(ClearValue::Color([0.0; 4]));
    graph
        .pass("paper accumulate")
        .write(&mut sums.color, Access::ColorAttachment, zero)
        .write(&mut sums.normal, Access::ColorAttachment, zero)
        .read(&depth, Access::DepthTest)
        .read(&kernel, Access::SampledFragment)
        .finish(body);
    let opaque = Opaque { splats: Some(sums), splat_depth: Some(depth), ..Opaque::default() };
    finalize(graph, inputs, &opaque, None, None, target, target_format)
}

/// The body that draws all chunks.
fn draw_points<'a>(inputs: Inputs<'a>, key: GraphicsKey, kernel: ResourceId) -> Result<Body<'a>> {
    let layout = &inputs.shaders.splat_layout;
    let pipeline = inputs.shaders.graphics(key)?;
    Ok(Box::new(move |context| {
        let texture = context.descriptor(kernel)?;
        let texture = inputs.descriptors.set(&inputs.shaders.read_set, &[(BIND_READ_KERNEL, texture)])?;
        let (device, commands) = (context.device(), context.commands());
        let bind_point = vk::PipelineBindPoint::GRAPHICS;
        for draw in inputs.draws {
            let constants = paper_constants(draw);
            // SAFETY: inside of rendering; pipeline, sets and push constants have one layout; the shaders use no set 1.
            unsafe {
                device.cmd_bind_pipeline(commands, bind_point, pipeline.raw());
                device.cmd_bind_descriptor_sets(
                    commands,
                    bind_point,
                    layout.raw(),
                    0,
                    &[draw.chunk.set()],
                    &[],
                );
                device.cmd_bind_descriptor_sets(commands, bind_point, layout.raw(), 2, &[texture], &[]);
                let bytes = bytemuck::bytes_of(&constants);
                device.cmd_push_constants(commands, layout.raw(), layout.push_stages(), 0, bytes);
                device.cmd_draw(commands, draw.chunk.count, 1, 0, 0);
            }
        }
        Ok(())
    }))
}

/// In the chunk's own unit, so that lengths need no scale.
fn paper_constants(draw: &Draw<'_>) -> PaperConstants {
    let frame = &draw.constants;
    let scale = frame.view_from_local_scale;
    let row = |[x, y, z, translation]: [f32; 4]| [x, y, z, translation / scale];
    let near = frame.near / scale;
    let [width, height] = frame.size_px;
    PaperConstants {
        view_from_local_x: row(frame.view_from_local_x),
        view_from_local_y: row(frame.view_from_local_y),
        view_from_local_z: row(frame.view_from_local_z),
        clip_from_view: [2.0 * frame.focal_px / width, 2.0 * frame.focal_px / height, 0.5, 1.0],
        scale: [near / frame.focal_px, near / frame.focal_px, near],
        size_px: frame.focal_px,
        middle_px: [0.5 * width, 0.5 * height],
        filter_radius: 2.0 * frame.filter_radius,
        epsilon_radii: frame.epsilon_radii,
    }
}
