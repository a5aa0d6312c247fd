//! Opaque polygons that cover pixels in part, beside splats that do: drawn four times, each time with other places of the pixels in their middles. Tiles lay
//! splats between them sample by sample; where there are no tiles, what they show is their mean.
//!
//! So samples are as far apart as the low-pass filter of splats is wide, on every device alike; those of an attachment with several samples a pixel lie
//! within it.

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
        draw::{mesh_pass, shaded_mesh_pass},
        mesh_pass::{MeshPass, draw_meshes, draw_meshes_at},
    },
    recording::Recording,
    splats::draw::bind_read,
};
use crate::{
    error::Result,
    graph::{Access, Buffer, ClearValue, Graph, Handle, Image, ImageDesc, Start, execute::Body},
    scene::{Accumulate, Settings},
    shaders::{self, config::*},
};

/// How far from the middle of a pixel its samples are. Along both axes the parts of the filter beside and between them are a quarter each: they lie where an
/// eighth and three eighths of a Gaussian are beyond, whose standard deviation is half of the filter's radius, √2 pixels. In 256ths of a pixel, to which
/// corners are snapped; the mean is the middle, so that the mean depth of a plane is the middle's.
const PLACES_PX: [[f32; 2]; MOST_POLYGON_SAMPLES as usize] =
    [[-NEAR_PX, -FAR_PX], [FAR_PX, -NEAR_PX], [-FAR_PX, NEAR_PX], [NEAR_PX, FAR_PX]];

const NEAR_PX: f32 = 58.0 / 256.0;
const FAR_PX: f32 = 208.0 / 256.0;

/// What they leave, sample by sample: in an image twice as wide and twice as high, the first sample of all pixels at the top left, then to the right and down.
pub(crate) struct SampledPolygons {
    /// Linear light, 1.
    pub color: Handle<Image>,
    /// Of the nearest one.
    pub depth: Handle<Image>,
}

/// What the pass is made of that draws them; `precision`: of what it leaves.
fn sampled_mesh_pass(settings: &Settings, precision: Accumulate, lights: u32) -> MeshPass {
    MeshPass { fragment: &shaders::POLYGONS_SAMPLED_FRAG, ..shaded_mesh_pass(settings, precision, lights) }
}

/// Records that what is drawn next is drawn to the part of the image that this sample has.
fn draw_to_sample(pass: &Recording<'_, '_>, extent: vk::Extent2D, sample: u32) {
    let vk::Extent2D { width, height } = extent;
    let [left, top] = [sample % 2 * width, sample / 2 * height];
    let viewport = vk::Viewport::default()
        .x(left as f32)
        .y(top as f32)
        .width(width as f32)
        .height(height as f32)
        .max_depth(1.0);
    let offset = vk::Offset2D { x: left as i32, y: top as i32 };
    let (device, commands) = (pass.device(), pass.commands());
    // SAFETY: recording; both lie within the attachments, whose sides are within the device's limits.
    unsafe {
        device.cmd_set_viewport(commands, 0, &[viewport]);
        device.cmd_set_scissor(commands, 0, &[vk::Rect2D { offset, extent }]);
    }
}

/// Declares the pass that draws them, and the one that brings what they show to `shown`, of that precision; and, where layers or a host want it, that of
/// their depth at the middles of pixels, the second answer.
pub(crate) fn sampled<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    (shown, precision): (&mut Handle<Image>, Accumulate),
    lights: Option<&Handle<Buffer>>,
    outputs: Outputs,
) -> Result<(SampledPolygons, Option<Handle<Image>>)> {
    let of_samples = outputs.sample_precision();
    let cells = cells::choose(graph, inputs)?;
    let extent = inputs.extent();
    let all = vk::Extent2D { width: 2 * extent.width, height: 2 * extent.height };
    let mut samples = SampledPolygons {
        color: graph
            .create_image("samples of polygons", ImageDesc { format: sum_format(of_samples), extent: all }),
        depth: graph
            .create_image("depth of samples of polygons", ImageDesc { format: DEPTH_FORMAT, extent: all }),
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
        (0..).zip(PLACES_PX).try_for_each(|(sample, place_px)| {
            draw_to_sample(pass, extent, sample);
            draw_meshes_at(pass, inputs, pipelines, place_px)
        })
    });

    let why = "polygons that cover pixels in part: what they show beside tiles";
    let pass = Pass::new(graph, inputs.source, "resolve polygons", why)
        .read(sums(BIND_SUMS_POLYGON_COLORS), &samples.color, Access::SampledFragment)
        .attach(shown, Access::ColorAttachment, Start::Discard);
    let pipeline = pass.graphics(GraphicsKey {
        color_formats: [sum_format(precision)].into(),
        ..GraphicsKey::fullscreen(&shaders::POLYGONS_RESOLVE_FRAG, Layout::Finalize, [].into())
    })?;
    let constants = inputs.finalize_constants();
    pass.finish(move |pass| {
        pass.bind(pipeline);
        pass.bind_sets(pipeline.layout, 0, &[pass.set(Place::Sums)?])?;
        pass.push(pipeline.layout, &constants)?;
        pass.draw([3, 1]);
        Ok(())
    });
    let keeps_depth = outputs.layers || outputs.depth;
    let depth = keeps_depth.then(|| at_the_middle(graph, inputs, cells.as_ref())).transpose()?;
    Ok((samples, depth))
}

/// Declares the pass that leaves their depth at the middles of pixels.
fn at_the_middle<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    cells: Option<&Handle<Buffer>>,
) -> Result<Handle<Image>> {
    let mut depth = graph.create_image("depth of polygons", inputs.image(DEPTH_FORMAT));
    let why = "polygons that cover pixels in part: layers and hosts have the depth of those that cover half of one, which is that at its middle";
    let pass = Pass::new(graph, inputs.source, "depth of polygons", why)
        .attach(&mut depth, Access::DepthAttachment, Start::Clear(ClearValue::Depth(0.0)))
        .read_if(CELLS, cells, Access::IndirectRead);
    let pipelines = MeshPass {
        fragment: &shaders::POLYGONS_HIDING_FRAG,
        color_formats: [].into(),
        ..mesh_pass(inputs.settings)
    }
    .pipelines(&pass, inputs)?;
    pass.finish(move |pass| {
        bind_read(pass)?;
        draw_meshes(pass, inputs, pipelines)
    });
    Ok(depth)
}
