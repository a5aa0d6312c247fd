//! The splats that are too large for tiles, or not regular: drawn as quads by the graphics pipeline, from the lists of chunks.

use ash::vk;

use crate::passes::{
    inputs::Inputs,
    pipeline::{constants::FrameConstants, splat_shaders::Summed},
    splats::{
        accumulate::{self, bind_read},
        draw::SplatPass,
        visibility,
    },
    tiles::{Tiles, splat::TileImages},
};
use crate::{
    error::Result,
    graph::{
        Access, ClearValue, Graph, Handle, Image, PassBuilder, ResourceId, Start,
        execute::{Body, PassContext},
    },
    shaders::config::*,
};

/// Declares their visibility; returns the depth, as that of all splats is. `kind`, in front of the splats, tells those of several bands
/// apart; `before`: the depth of other bands.
pub(crate) fn see_large<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    tiles: &Tiles<'a>,
    before: Option<Handle<Image>>,
) -> Result<Handle<Image>> {
    let draws = LargeDraws::new(inputs, tiles, &visibility::splat_pass(inputs.settings, None))?;
    let (mut depth, start) = match before {
        Some(before) => (before, Start::Load),
        None => {
            let depth =
                graph.create_image("depth", inputs.image(crate::passes::pipeline::formats::DEPTH_FORMAT));
            (depth, Start::Clear(ClearValue::Depth(0.0)))
        }
    };
    let pass = graph.pass(&format!("see {kind}large splats"));
    let pass = pass.write(&mut depth, Access::DepthAttachment, start);
    read_list(tiles, pass).finish(Box::new(move |context| {
        bind_read(context, inputs, [None; 3], None)?;
        draws.record(context)
    }));
    Ok(depth)
}

/// Declares their accumulation, upon the sums of tiles. `polygons`, `with_depth`: as for all splats.
pub(crate) fn sum_large<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    tiles: &Tiles<'a>,
    images: &mut TileImages,
    (depth, polygons): (&Handle<Image>, Option<&Handle<Image>>),
    with_depth: bool,
) -> Result<()> {
    let summed = Summed::Opaque { with_depth, beside_polygons: polygons.is_some() };
    let draws = LargeDraws::new(inputs, tiles, &accumulate::splat_pass(inputs.settings, summed))?;
    let sampled = [with_depth.then(|| depth.id()), None, polygons.map(Handle::id)];
    let access = if with_depth { Access::DepthTestAndSampled } else { Access::DepthTest };
    let mut pass = graph
        .pass(&format!("sum {kind}large splats"))
        .write(&mut images.sums.color, Access::ColorAttachment, Start::Load)
        .write(&mut images.sums.normal, Access::ColorAttachment, Start::Load)
        .read(depth, access);
    if let Some(polygons) = polygons {
        pass = pass.read(polygons, Access::SampledFragment);
    }
    read_list(tiles, pass).finish(Box::new(move |context| {
        bind_read(context, inputs, sampled, None)?;
        draws.record(context)
    }));
    Ok(())
}

fn read_list<'g, B>(tiles: &Tiles<'_>, pass: PassBuilder<'g, B>) -> PassBuilder<'g, B> {
    pass.read(&tiles.entries, Access::StorageReadVertex).read(&tiles.arguments, Access::IndirectRead)
}

/// The draws of one pass: one a chunk.
struct LargeDraws<'a> {
    inputs: Inputs<'a>,
    pipelines: Vec<std::sync::Arc<crate::vk::GraphicsPipeline>>,
    entries: ResourceId,
    arguments: ResourceId,
    /// The rows of the band.
    area: vk::Rect2D,
}

impl<'a> LargeDraws<'a> {
    fn new(inputs: Inputs<'a>, tiles: &Tiles<'a>, pass: &SplatPass) -> Result<Self> {
        Ok(Self {
            inputs,
            pipelines: pass.quad_pipelines(inputs)?,
            entries: tiles.entries.id(),
            arguments: tiles.arguments.id(),
            area: tiles.plan.area(inputs.extent()),
        })
    }

    fn record(&self, context: &PassContext<'_>) -> Result<()> {
        let shaders = self.inputs.shaders;
        let list = [(BIND_LIST_ITEMS, context.descriptor(self.entries)?)];
        let list = self.inputs.descriptors.set(&shaders.list_set, &list)?;
        let arguments = context.buffer(self.arguments)?;
        let layout = &shaders.splat_layout;
        let bind_point = vk::PipelineBindPoint::GRAPHICS;
        let (device, commands) = (context.device(), context.commands());
        // SAFETY: inside of rendering; within the image. A splat that touches several bands is listed in each.
        unsafe { device.cmd_set_scissor(commands, 0, &[self.area]) };
        for ((number, draw), pipeline) in (0..).zip(self.inputs.draws).zip(&self.pipelines) {
            let constants = FrameConstants {
                // Of listed splats the lists have indices within their chunks.
                first_record: if self.inputs.listed.is_some() { 0 } else { draw.constants.first_record },
                ..draw.constants
            };
            let constants = bytemuck::bytes_of(&constants);
            let sets = [draw.chunk.set(), list];
            // SAFETY: inside of rendering; pipeline, sets and push constants have one layout; the graph's barriers order
            // what is read; the arguments are within the buffer, and begin at any instance, as the device can.
            unsafe {
                device.cmd_bind_descriptor_sets(commands, bind_point, layout.raw(), 0, &sets, &[]);
                device.cmd_push_constants(commands, layout.raw(), layout.push_stages(), 0, constants);
                device.cmd_bind_pipeline(commands, bind_point, pipeline.raw());
                device.cmd_draw_indirect(
                    commands,
                    arguments,
                    4 * u64::from(ARGUMENTS_CHUNKS) + 16 * number,
                    1,
                    16,
                );
            }
        }
        Ok(())
    }
}
