//! The splats that are too large for tiles, or not regular: drawn as quads by the graphics pipeline, from the lists of chunks.

use crate::passes::{
    inputs::Inputs,
    pass::Pass,
    pipeline::{constants::FrameConstants, key::Layout, splat_shaders::Summed},
    place::{Place, arguments, lists},
    splats::{
        accumulate::{self, read_depths},
        draw::{SplatPass, bind_read},
        visibility,
    },
    tiles::{depth::depth_after, lists::Tiles, splat::TileImages},
};
use crate::{
    error::Result,
    graph::{Access, Graph, Handle, Image, Role, Start, execute::Body},
    shaders::config::*,
};

/// Why a frame draws them so.
const WHY: &str = "a splat may be too large for tiles, or come near the eye plane";

/// Declares their visibility; returns the depth, as that of all splats is. `kind`, in front of the splats, tells those of several bands
/// apart; `before`: the depth of other bands.
pub(crate) fn see_large<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    tiles: &Tiles<'a>,
    before: Option<Handle<Image>>,
) -> Result<Handle<Image>> {
    let (mut depth, start) = depth_after(graph, inputs, before);
    let pass = Pass::new(graph, inputs.source, format_args!("see {kind}large splats"), WHY).attach(
        &mut depth,
        Access::DepthAttachment,
        start,
    );
    finish(pass, inputs, tiles, &visibility::splat_pass(inputs.settings, None))?;
    Ok(depth)
}

/// Declares their accumulation, upon the sums of tiles. `polygons`, `with_depth`: as for all splats.
pub(crate) fn sum_large<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    tiles: &Tiles<'a>,
    images: &mut TileImages,
    (depth, polygons): (&Handle<Image>, Option<&Handle<Image>>),
    with_depth: bool,
) -> Result<()> {
    let pass = Pass::new(graph, inputs.source, format_args!("sum {kind}large splats"), WHY)
        .role(Role::Blends)
        .attach(&mut images.sums.color, Access::ColorAttachment, Start::Load)
        .attach(&mut images.sums.normal, Access::ColorAttachment, Start::Load);
    let pass = read_depths(pass, depth, polygons, with_depth);
    let summed = Summed::Opaque { with_depth, beside_polygons: polygons.is_some() };
    finish(pass, inputs, tiles, &accumulate::splat_pass(inputs.settings, summed))
}

/// Adds the lists of chunks, and declares the pass that draws them.
fn finish<'a>(pass: Pass<'_, 'a>, inputs: Inputs<'a>, tiles: &Tiles<'a>, splats: &SplatPass) -> Result<()> {
    let pass = pass.read(lists(BIND_LIST_ITEMS), &tiles.entries, Access::StorageReadVertex).read(
        arguments(0),
        &tiles.arguments,
        Access::IndirectRead,
    );
    let pipelines = splats.quad_pipelines(&pass, inputs)?;
    let area = tiles.plan.area(inputs.extent());
    pass.finish(move |pass| {
        bind_read(pass)?;
        // SAFETY: inside of rendering; within the image. A splat that touches several bands is listed in each.
        unsafe { pass.device().cmd_set_scissor(pass.commands(), 0, &[area]) };
        let lists = pass.set(Place::Lists(0))?;
        for ((number, draw), pipeline) in (0..).zip(inputs.draws).zip(pipelines.iter().copied()) {
            // Of listed splats the lists have indices within their chunks.
            let first_record = if inputs.listed.is_some() { 0 } else { draw.place.first_record };
            pass.bind(pipeline);
            pass.bind_sets(Layout::Splat, 0, &[draw.chunk.set(), lists])?;
            pass.push(Layout::Splat, &FrameConstants { first_record, ..draw.told() })?;
            // They begin at any instance, as the device can.
            pass.draw_indirect(arguments(0), 4 * u64::from(ARGUMENTS_CHUNKS) + 16 * number)?;
        }
        Ok(())
    });
    Ok(())
}
