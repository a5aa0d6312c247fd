//! A frame of splats of which every device has a part, in stages: what each sees, what each sums of what is not behind the nearest surface of
//! all, and the picture of all sums. Splatting asks nothing else of other parts: depth by its maximum (it is reversed), sums by addition, which
//! hosts do in between. Opaque splats come first, then, where there are transparent ones, layer by layer the same two stages and one that shades.

pub(crate) mod layers;
mod upload;

use crate::passes::{
    cull::lists::Lists,
    inputs::Inputs,
    pass::Pass,
    pipeline::formats::{DEPTH_FORMAT, sum_format},
    plan::FramePlan,
    resolve,
    resolve::finalize::Opaque,
    splats::{self, accumulate::Sums},
    tiles::{
        self,
        clear::clear,
        splat::{TileImages, VISIBLE_FORMAT},
    },
};
use crate::{
    error::Result,
    graph::{Access, Buffer, ClearValue, Graph, Handle, Image, Start, execute::Body},
    passes::resolve::export::Exported,
    scene::{Accumulate, Shading},
};
use upload::upload;

/// Why a frame has what it has for others.
const WHY: &str = "a part of a scene: other parts are on other devices";

/// The format of what a stage leaves to the host: the depth.
pub(crate) const PART_DEPTH_FORMAT: ash::vk::Format = DEPTH_FORMAT;

/// And each of the two images of sums.
pub(crate) const PART_SUM_FORMAT: ash::vk::Format = ash::vk::Format::R32G32B32A32_SFLOAT;

/// What all parts left to the host.
pub(crate) struct OfAll<'h> {
    /// The nearest depth.
    pub depth: &'h Handle<Buffer>,
    /// The sums: colors and weights, normals and depths.
    pub sums: [&'h Handle<Buffer>; 2],
    /// What transparent layers add up to, where there are any.
    pub layers: Option<&'h Handle<Buffer>>,
}

/// Declares the first stage; gives the depth of the nearest surface of these splats, reversed and moved away by ε: 0 where there is none.
pub(crate) fn see<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    plan: &'a FramePlan<'a>,
) -> Result<Handle<Image>> {
    let inputs = inputs.of(&plan.opaque);
    let Some(common) = inputs.bands.first().map(|band| &band.plan) else {
        if inputs.draws.is_empty() {
            return Ok(nothing_seen(graph, inputs));
        }
        let lists = Lists::make(graph, inputs, "")?;
        return splats::visibility::visibility(graph, inputs, &lists);
    };
    let mut images = TileImages::create(graph, inputs, common, false);
    clear(graph, inputs.source, "clear depth", WHY, &mut [&mut images.depth]);
    let mut depth = None;
    for (band, inputs, plan) in inputs.of_bands(graph.arena()) {
        let tiles = tiles::list(graph, inputs, band, plan)?;
        if plan.may_be_large {
            depth = Some(tiles::see_large(graph, inputs, band, &tiles, depth)?);
        }
        let large = depth.as_ref().filter(|_| plan.may_be_large);
        tiles::see(graph, inputs, band, &tiles, &mut images, large, true)?;
        depth = Some(tiles::depth_buffer(graph, inputs, band, &tiles, &images.depth, depth)?);
    }
    Ok(depth.unwrap_or_else(|| nothing_seen(graph, inputs)))
}

/// Declares the second stage: the sums of splats that are not behind `of_all`, the nearest depth of all parts. `with_depth`: depth is summed, too.
pub(crate) fn sum<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    plan: &'a FramePlan<'a>,
    of_all: &Handle<Buffer>,
    with_depth: bool,
) -> Result<[Handle<Image>; 2]> {
    let inputs = inputs.of(&plan.opaque);
    let Some(common) = inputs.bands.first().map(|band| &band.plan) else {
        if inputs.draws.is_empty() {
            return Ok(nothing_summed(graph, inputs));
        }
        let kernel = splats::accumulate::kernel_of(graph, inputs)?;
        let lists = Lists::make(graph, inputs, "")?;
        let depth = upload(graph, inputs, "depth", of_all, DEPTH_FORMAT);
        let lists = lists.without_hidden(graph, inputs, &depth)?;
        let kernel = kernel.as_ref();
        let sums = splats::accumulate::accumulate(graph, inputs, &lists, &depth, None, kernel, with_depth)?;
        return Ok([sums.color, sums.normal]);
    };
    let mut images = TileImages::create(graph, inputs, common, false);
    let Sums { color, normal } = &mut images.sums;
    clear(graph, inputs.source, "clear sums", WHY, &mut [color, normal]);
    images.depth = upload(graph, inputs, "nearest depth", of_all, VISIBLE_FORMAT);
    let may_be_large = inputs.bands.iter().any(|band| band.plan.may_be_large);
    let for_large = may_be_large.then(|| upload(graph, inputs, "depth", of_all, DEPTH_FORMAT));
    for (band, inputs, plan) in inputs.of_bands(graph.arena()) {
        let tiles = tiles::list(graph, inputs, band, plan)?;
        tiles::sum(graph, inputs, band, &tiles, &mut images, (None, with_depth), true)?;
        if let (true, Some(depth)) = (plan.may_be_large, &for_large) {
            tiles::sum_large(graph, inputs, band, &tiles, &mut images, (depth, None), with_depth)?;
        }
    }
    Ok([images.sums.color, images.sums.normal])
}

/// Declares the third stage: the picture of the sums of all parts, and what is exported of them.
pub(crate) fn shade<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    plan: &'a FramePlan<'a>,
    OfAll { depth, sums: [color, normal], layers }: OfAll<'_>,
    (target, target_format): (&mut Handle<Image>, ash::vk::Format),
    export: bool,
) -> Result<Option<Exported>> {
    let lights = resolve::lights::lights(graph, inputs.source, plan.lights);
    let inputs = Inputs { lights: plan.lights.len() as u32, ..inputs };
    let depth = upload(graph, inputs, "depth", depth, DEPTH_FORMAT);
    let sums = Sums {
        color: upload(graph, inputs, "color sums", color, PART_SUM_FORMAT),
        normal: upload(graph, inputs, "normal sums", normal, PART_SUM_FORMAT),
    };
    let layers = layers.map(|layers| upload(graph, inputs, "layers", layers, PART_SUM_FORMAT));
    let opaque = Opaque { splats: Some(sums), splat_depth: Some(depth), ..Opaque::nothing(graph.arena()) };
    let surface = opaque.splats.as_ref().zip(opaque.splat_depth.as_ref());
    match surface.filter(|_| inputs.settings.shading == Shading::EyeDome) {
        Some(surface) => resolve::eye_dome::eye_dome(graph, inputs, surface, target, target_format)?,
        None => {
            let (layers, lights) = (layers.as_ref(), lights.as_ref());
            resolve::finalize::finalize(graph, inputs, &opaque, layers, lights, target, target_format)?
        }
    }
    export.then(|| resolve::export::export(graph, inputs, surface)).transpose()
}

fn nothing_seen<'a>(graph: &mut Graph<'a, Body<'a>>, inputs: Inputs<'a>) -> Handle<Image> {
    let mut depth = graph.create_image("depth", inputs.image(DEPTH_FORMAT));
    let clear = Start::Clear(ClearValue::Depth(0.0));
    Pass::new(graph, inputs.source, "nothing seen", WHY)
        .attach(&mut depth, Access::DepthAttachment, clear)
        .finish(|_| Ok(()));
    depth
}

fn nothing_summed<'a>(graph: &mut Graph<'a, Body<'a>>, inputs: Inputs<'a>) -> [Handle<Image>; 2] {
    let format = sum_format(Accumulate::F32);
    let [mut color, mut normal] =
        ["color sums", "normal sums"].map(|name| graph.create_image(name, inputs.image(format)));
    clear(graph, inputs.source, "nothing summed", WHY, &mut [&mut color, &mut normal]);
    [color, normal]
}
