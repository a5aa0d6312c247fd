//! The splat passes as Guennebaud, Barthe, Paulin 2006 publish them, without all that ours do for exactness: what the
//! instructions that we have more buy. For comparison only; see `glsl/paper.vert.glsl`.

use ash::vk;

use crate::passes::pipeline::formats::{DEPTH_FORMAT, sum_format};
use crate::passes::{
    inputs::Inputs,
    pass::Pass,
    pipeline::{
        constants::PaperConstants,
        key::{GraphicsKey, Layout},
    },
    place::read,
    plan::draws::Draw,
    resolve::finalize::{Opaque, finalize},
    splats::{accumulate::Sums, draw::bind_read, kernel_texture},
};
use crate::{
    error::Result,
    graph::{Access, ClearValue, Graph, Handle, Image, Start, execute::Body},
    scene::Settings,
    shaders::{self, config::*},
    vk::Blend,
};

/// Why there are its passes.
const WHY: &str = "the splat passes as Guennebaud et al. 2006 publish them";

/// What the pipelines of visibility and accumulation are. `filtered`: visibility too.
fn keys(settings: &Settings, filtered: bool) -> [GraphicsKey; 2] {
    let points = vk::PrimitiveTopology::POINT_LIST;
    let visibility = (&shaders::PAPER_VISIBILITY_VERT, &shaders::PAPER_VISIBILITY_FRAG);
    let accumulate = (&shaders::PAPER_ACCUMULATE_VERT, &shaders::PAPER_ACCUMULATE_FRAG);
    [
        GraphicsKey {
            depth: Some((vk::CompareOp::GREATER, true)),
            ..GraphicsKey::new(visibility, Layout::Splat, points, [(SPEC_FILTERED, filtered.into())].into())
        },
        GraphicsKey {
            color_formats: [sum_format(settings.accumulate); 2].into(),
            blend: Blend::AddWeighted,
            depth: Some((vk::CompareOp::GREATER_OR_EQUAL, false)),
            ..GraphicsKey::new(accumulate, Layout::Splat, points, [].into())
        },
    ]
}

/// Declares the frame: the kernel's texture, both splat passes, our own finalization. `filtered`: visibility is filtered, which
/// the paper's is not.
///
/// # Errors
/// Whatever the driver answers when a pipeline is made.
pub fn paper_frame<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    target: &mut Handle<Image>,
    target_format: vk::Format,
    filtered: bool,
) -> Result<()> {
    let kernel = kernel_texture::kernel_texture(graph, inputs, true)?;
    let [visibility_key, accumulate_key] = keys(inputs.settings, filtered);
    let mut depth = graph.create_image("depth", inputs.image(DEPTH_FORMAT));
    let clear = Start::Clear(ClearValue::Depth(0.0));
    let pass = Pass::new(graph, inputs.source, "paper visibility", WHY)
        .attach(&mut depth, Access::DepthAttachment, clear)
        .read(read(BIND_READ_KERNEL), &kernel, Access::SampledFragment);
    draw_points(pass, inputs, visibility_key)?;

    let format = sum_format(inputs.settings.accumulate);
    let mut sums = Sums {
        color: graph.create_image("color sums", inputs.image(format)),
        normal: graph.create_image("normal sums", inputs.image(format)),
    };
    let zero = Start::Clear(ClearValue::Color([0.0; 4]));
    let pass = Pass::new(graph, inputs.source, "paper accumulate", WHY)
        .attach(&mut sums.color, Access::ColorAttachment, zero)
        .attach(&mut sums.normal, Access::ColorAttachment, zero)
        .uses(&depth, Access::DepthTest)
        .read(read(BIND_READ_KERNEL), &kernel, Access::SampledFragment);
    draw_points(pass, inputs, accumulate_key)?;
    let opaque = Opaque { splats: Some(sums), splat_depth: Some(depth), ..Opaque::nothing(graph.arena()) };
    finalize(graph, inputs, &opaque, None, None, target, target_format)
}

/// Declares the pass that draws all chunks.
fn draw_points<'a>(pass: Pass<'_, 'a>, inputs: Inputs<'a>, key: GraphicsKey) -> Result<()> {
    let pipeline = pass.graphics(key)?;
    pass.finish(move |pass| {
        pass.bind(pipeline);
        // The shaders use no set 1.
        bind_read(pass)?;
        for draw in inputs.draws {
            pass.bind_sets(pipeline.layout, 0, &[draw.chunk.set()])?;
            pass.push(pipeline.layout, &paper_constants(draw))?;
            pass.draw([draw.chunk.count, 1]);
        }
        Ok(())
    });
    Ok(())
}

/// In the chunk's own unit, so that lengths need no scale.
fn paper_constants(draw: &Draw<'_>) -> PaperConstants {
    let frame = &draw.constants;
    let scale = frame.view_from_local_scale;
    let row = |[x, y, z, translation]: [f32; 4]| [x, y, z, translation / scale];
    let near = frame.near / scale;
    let [width, height] = frame.middle_px.map(|half| 2.0 * half); // no camera of an instrument is off-center
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
