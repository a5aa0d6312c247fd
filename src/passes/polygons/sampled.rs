//! Opaque polygons that cover pixels in part, beside splats that do: drawn with four samples of each pixel, each shaded by itself. Tiles lay splats
//! between them sample by sample; where there are no tiles, what they show is their mean.

use ash::vk;

use crate::passes::{
    inputs::Inputs,
    pass::Pass,
    pipeline::{
        formats::{DEPTH_FORMAT, sum_format},
        key::{GraphicsKey, Layout},
    },
    place::{Place, read, sums},
    plan::outputs::Outputs,
    polygons::{
        cells::{self, CELLS},
        draw::shaded_mesh_pass,
        mesh_pass::{MeshPass, draw_meshes},
    },
    recording::Recording,
    splats::draw::bind_read,
};
use crate::{
    error::Result,
    graph::{Access, Buffer, ClearValue, Graph, Handle, Image, ImageDesc, Start, execute::Body},
    scene::{Accumulate, Settings},
    shaders::{self, config::*},
    vk::Attachments,
};

/// As many as `MOST_POLYGON_SAMPLES`.
const SAMPLES: vk::SampleCountFlags = vk::SampleCountFlags::TYPE_4;

const _: () = assert!(SAMPLES.as_raw() == MOST_POLYGON_SAMPLES);

/// Where the samples of a pixel are, from its middle, on devices that have them at Vulkan's standard places; elsewhere a silhouette is another by less than a pixel.
pub(crate) const STANDARD_PLACES: [[f32; 2]; MOST_POLYGON_SAMPLES as usize] =
    [[-0.125, -0.375], [0.375, -0.125], [-0.375, 0.125], [0.125, 0.375]];

/// Records that what is drawn next has in the middle of each pixel what this place of it would have.
pub(crate) fn move_to_sample(pass: &Recording<'_, '_>, inputs: Inputs<'_>, [right_px, down_px]: [f32; 2]) {
    let vk::Extent2D { width, height } = inputs.extent();
    let viewport = vk::Viewport::default()
        .x(-right_px)
        .y(-down_px)
        .width(width as f32)
        .height(height as f32)
        .max_depth(1.0);
    // SAFETY: recording, with a pipeline whose viewport is dynamic; one viewport of a size within the limits, less than a pixel beside the image.
    unsafe { pass.device().cmd_set_viewport(pass.commands(), 0, &[viewport]) };
}

/// What they leave, sample by sample.
pub(crate) struct SampledPolygons {
    /// Linear light, 1.
    pub color: Handle<Image>,
    /// Of the nearest one.
    pub depth: Handle<Image>,
}

/// What the pass is made of that draws them; `precision`: of what it leaves.
fn sampled_mesh_pass(settings: &Settings, precision: Accumulate, lights: u32) -> MeshPass {
    MeshPass {
        fragment: &shaders::POLYGONS_SAMPLED_FRAG,
        attachments: Attachments { samples: SAMPLES, ..Attachments::default() },
        ..shaded_mesh_pass(settings, precision, lights)
    }
}

/// Declares the pass that draws them, and the one that brings what they show to `shown`, of that precision; and, where layers or a host want it, leaves the
/// depth from which on they cover half of a pixel, the second answer.
pub(crate) fn sampled<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    (shown, precision): (&mut Handle<Image>, Accumulate),
    lights: Option<&Handle<Buffer>>,
    outputs: Outputs,
) -> Result<(SampledPolygons, Option<Handle<Image>>)> {
    let (of_samples, keeps_depth) = (outputs.sample_precision(), outputs.layers || outputs.depth);
    let cells = cells::choose(graph, inputs)?;
    let image = |format| ImageDesc { samples: SAMPLES, ..inputs.image(format) };
    let mut samples = SampledPolygons {
        color: graph.create_image("samples of polygons", image(sum_format(of_samples))),
        depth: graph.create_image("depth of samples of polygons", image(DEPTH_FORMAT)),
    };
    let why = "opaque polygons, where they are nearest, at four places of each pixel: they cover it in part at their silhouettes, as splats do";
    let pass = Pass::new(graph, inputs.source, "polygons", why)
        .attach(&mut samples.color, Access::ColorAttachment, Start::Clear(ClearValue::Color([0.0; 4])))
        .attach(&mut samples.depth, Access::DepthAttachment, Start::Clear(ClearValue::Depth(0.0)))
        .read_if(read(BIND_READ_LIGHTS), lights, Access::UniformReadFragment)
        .read_if(CELLS, cells.as_ref(), Access::IndirectRead);
    let pipelines = sampled_mesh_pass(inputs.settings, of_samples, inputs.lights).pipelines(&pass, inputs)?;
    pass.finish(move |pass| {
        bind_read(pass)?;
        draw_meshes(pass, inputs, pipelines)
    });

    let why = "polygons that cover pixels in part: what they show beside tiles";
    let mut depth = keeps_depth.then(|| graph.create_image("depth of polygons", inputs.image(DEPTH_FORMAT)));
    let mut pass = Pass::new(graph, inputs.source, "resolve polygons", why)
        .read(sums(BIND_SUMS_POLYGON_COLORS), &samples.color, Access::SampledFragment)
        .attach(shown, Access::ColorAttachment, Start::Discard);
    if let Some(depth) = &mut depth {
        pass = pass.read(sums(BIND_SUMS_DEPTH), &samples.depth, Access::SampledFragment).attach(
            depth,
            Access::DepthAttachment,
            Start::Discard,
        );
    }
    let fragment = match keeps_depth {
        true => &shaders::POLYGONS_RESOLVE_DEPTH_FRAG,
        false => &shaders::POLYGONS_RESOLVE_FRAG,
    };
    let pipeline = pass.graphics(GraphicsKey {
        color_formats: [sum_format(precision)].into(),
        depth: keeps_depth.then_some((vk::CompareOp::ALWAYS, true)),
        ..GraphicsKey::fullscreen(fragment, Layout::Finalize, [].into())
    })?;
    let constants = inputs.finalize_constants();
    pass.finish(move |pass| {
        pass.bind(pipeline);
        pass.bind_sets(pipeline.layout, 0, &[pass.set(Place::Sums)?])?;
        pass.push(pipeline.layout, &constants)?;
        pass.draw([3, 1]);
        Ok(())
    });
    Ok((samples, depth))
}
