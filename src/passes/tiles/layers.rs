//! Transparent layers of splats alone, by tiles: all of them in one dispatch, or in as few as a shader's loops allow.

use super::{
    super::{
        Inputs,
        constants::TileConstants,
        splat_shaders::find,
        sum_format,
        variant::{Constants, shading_constants, splat_constants},
    },
    COLOR_SUMS, DEPTH_BEFORE, LIGHTS, OVERFULL_ARGUMENTS, PEELED_STATE, PEELED_WEIGHT, SEEN_ARGUMENTS,
    TilePass, TilePlan, Tiles, VISIBLE_DEPTH, after_dispatches_before,
    splat::VISIBLE_FORMAT,
};
use crate::{
    error::Result,
    graph::{
        Access, Buffer, BufferDesc, Graph, Handle, Image, PassBuilder, ResourceId, Start,
        execute::{Body, PassContext},
    },
    scene::{Accumulate, LastLayer, Settings},
    shaders::Shader,
};

/// Bytes of what is known of an overfull tile between dispatches: four vectors a pixel.
const STATE_BYTES: u64 = 64 * 64;

/// What depends on the scene beside the splats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) struct Beside {
    /// There are opaque things.
    pub opaque: bool,
    /// The scene has lights of its own.
    pub lit: bool,
}

/// What one dispatch does of all layers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Share {
    surfaces: u32,
    blends_rest: bool,
}

/// How the layers are dispatched.
fn shares(settings: &Settings, plan: &TilePlan) -> Vec<Share> {
    let most = settings.layers.most();
    let rest = settings.last_layer != LastLayer::Drop;
    let surfaces = if rest { most - 1 } else { most };
    let at_once = plan.layers_at_once;
    let mut shares: Vec<_> = (0..surfaces)
        .step_by(at_once as usize)
        .map(|first| Share { surfaces: at_once.min(surfaces - first), blends_rest: false })
        .collect();
    match shares.last_mut() {
        Some(last) if rest && last.surfaces < at_once => last.blends_rest = true,
        _ if rest => shares.push(Share { surfaces: 0, blends_rest: true }),
        _ => {}
    }
    shares
}

/// The steps of a layer in parts, as in `glsl/tile_layers.comp.glsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Step {
    See,
    Sum,
    Rest,
}

/// How a dispatch works on a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) enum Work {
    /// All layers at once.
    Whole,
    /// Some layers after the other.
    Several,
    /// A step of a layer, and a part of the splats, after the other.
    Parts,
}

/// The shader, and its constants.
pub(in super::super) fn shader(
    settings: &Settings,
    plan: &TilePlan,
    beside: Beside,
    work: Work,
) -> Result<(&'static Shader, Constants)> {
    let words = [
        Some(match settings.accumulate {
            Accumulate::F16 => "half",
            Accumulate::F32 => "single",
        }),
        beside.lit.then_some("lit"),
        beside.opaque.then_some("behind"),
        match work {
            Work::Whole => None,
            Work::Several => Some("several"),
            Work::Parts => Some("parts"),
        },
        plan.direct.then_some("direct"),
    ];
    let name: String = words.into_iter().flatten().map(|word| format!("_{word}")).collect();
    let mut constants = splat_constants(settings, false, false);
    constants.extend(shading_constants(settings.shading));
    constants.extend([(19, plan.part_length), (20, u32::from(stacked(settings)))]);
    constants.push((21, plan.walk_length));
    Ok((find(&format!("tile_layers{name}.comp"))?, constants))
}

/// Whether the last layer counts as several surfaces: it does where there is a layer before it.
fn stacked(settings: &Settings) -> bool {
    settings.last_layer == LastLayer::Stack && settings.layers.most() > 1
}

/// Declares the pass; returns what the layers add up to: linear light times alpha, and alpha.
pub(in super::super) fn layers<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    tiles: &Tiles<'a>,
    opaque: Option<&Handle<Image>>,
    lights: Option<&Handle<Buffer>>,
) -> Result<Handle<Image>> {
    let mut layers = graph.create_image("layers", inputs.image(sum_format(inputs.settings.accumulate)));
    super::clear(graph, "clear layers", &mut [&mut layers]);
    whole(graph, inputs, tiles, (opaque, lights), &mut layers)?;
    if tiles.plan.may_be_overfull() {
        in_parts(graph, inputs, tiles, (opaque, lights), &mut layers)?;
    }
    Ok(layers)
}

/// Opaque depth and lights.
type Around<'f> = (Option<&'f Handle<Image>>, Option<&'f Handle<Buffer>>);

fn tile_pass<'a>(
    inputs: Inputs<'a>,
    tiles: &Tiles<'a>,
    (opaque, lights): Around<'_>,
    layers: &Handle<Image>,
    work: Work,
) -> Result<TilePass<'a>> {
    let beside = Beside { opaque: opaque.is_some(), lit: lights.is_some() };
    let shader = shader(inputs.settings, tiles.plan, beside, work)?;
    let mut pass = TilePass::new(inputs, tiles.plan, shader, tiles.lists())?;
    pass.storage_images = vec![(COLOR_SUMS, layers.id())];
    pass.sampled_images = opaque.map(|opaque| (DEPTH_BEFORE, opaque.id())).into_iter().collect();
    pass.buffers.extend(lights.map(|lights| (LIGHTS, lights.id())));
    Ok(pass)
}

fn declare<'g, 'a>(
    graph: &'g mut Graph<Body<'a>>,
    name: &str,
    tiles: &Tiles<'_>,
    (opaque, lights): Around<'_>,
    layers: &mut Handle<Image>,
) -> PassBuilder<'g, Body<'a>> {
    let mut pass =
        tiles.read_lists(graph.pass(name)).write(layers, Access::StorageReadWriteCompute, Start::Load);
    if let Some(opaque) = opaque {
        pass = pass.read(opaque, Access::SampledCompute);
    }
    if let Some(lights) = lights {
        pass = pass.read(lights, Access::StorageReadCompute);
    }
    pass
}

/// How all tiles but the overfull are worked on.
pub(super) fn work_of_whole_tiles(settings: &Settings, plan: &TilePlan) -> Work {
    if shares(settings, plan).len() > 1 { Work::Several } else { Work::Whole }
}

/// All tiles but the overfull.
fn whole<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    tiles: &Tiles<'a>,
    around: Around<'_>,
    layers: &mut Handle<Image>,
) -> Result<()> {
    let shares = shares(inputs.settings, tiles.plan);
    let work = work_of_whole_tiles(inputs.settings, tiles.plan);
    let mut pass = tile_pass(inputs, tiles, around, layers, work)?;
    let mut between = Vec::new();
    if work == Work::Several {
        for (binding, name) in [(VISIBLE_DEPTH, "peeled depth"), (PEELED_WEIGHT, "peeled weight")] {
            let image = graph.create_image(name, inputs.image(VISIBLE_FORMAT));
            pass.storage_images.push((binding, image.id()));
            between.push(image);
        }
    }
    let mut declared = declare(graph, "layers of tiles", tiles, around, layers);
    for image in &mut between {
        declared = declared.write(image, Access::StorageReadWriteCompute, Start::Discard);
    }
    let arguments = tiles.arguments.id();
    let dispatches: Vec<_> = (0..)
        .zip(&shares)
        .map(|(part, share)| TileConstants {
            part,
            surfaces: share.surfaces,
            blends_rest: u32::from(share.blends_rest),
            ..pass.constants
        })
        .collect();
    declared.finish(Box::new(move |context| record(context, &pass, arguments, SEEN_ARGUMENTS, &dispatches)));
    Ok(())
}

/// The overfull tiles: a step of a layer, and a part of the splats, in each dispatch.
fn in_parts<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    tiles: &Tiles<'a>,
    around: Around<'_>,
    layers: &mut Handle<Image>,
) -> Result<()> {
    let mut pass = tile_pass(inputs, tiles, around, layers, Work::Parts)?;
    let size_bytes = tiles.plan.most_overfull() * STATE_BYTES;
    let mut state = graph.create_buffer("state of overfull tiles", BufferDesc { size_bytes });
    pass.buffers.push((PEELED_STATE, state.id()));
    let declared = declare(graph, "layers of overfull tiles", tiles, around, layers).write(
        &mut state,
        Access::StorageReadWriteCompute,
        Start::Discard,
    );
    let arguments = tiles.arguments.id();
    let parts = tiles.plan.parts();
    let mut dispatches = Vec::new();
    for (surfaces, step) in steps(inputs.settings) {
        dispatches.extend((0..parts).map(|part| TileConstants {
            part,
            surfaces,
            step: step as u32,
            ends: u32::from(part + 1 == parts),
            ..pass.constants
        }));
    }
    declared
        .finish(Box::new(move |context| record(context, &pass, arguments, OVERFULL_ARGUMENTS, &dispatches)));
    Ok(())
}

/// The steps of all layers, each with the number of surfaces before it.
fn steps(settings: &Settings) -> Vec<(u32, Step)> {
    let most = settings.layers.most();
    let rest = settings.last_layer != LastLayer::Drop;
    let surfaces = if rest { most - 1 } else { most };
    let mut steps: Vec<_> = (0..surfaces).flat_map(|n| [(n, Step::See), (n, Step::Sum)]).collect();
    steps.extend(rest.then_some((surfaces, Step::Rest)));
    steps
}

/// Records dispatches, each after the one before.
fn record(
    context: &PassContext<'_>,
    pass: &TilePass<'_>,
    arguments: ResourceId,
    offset: u64,
    dispatches: &[TileConstants],
) -> Result<()> {
    pass.bind(context)?;
    let arguments = context.buffer(arguments)?;
    for (number, constants) in dispatches.iter().enumerate() {
        if number > 0 {
            after_dispatches_before(context);
        }
        pass.push(context, constants)?;
        // SAFETY: all is bound that the pipeline needs; the arguments are within the buffer and declared to be read.
        unsafe { context.device().cmd_dispatch_indirect(context.commands(), arguments, offset) };
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{scene::Layers, vk::Limits};

    #[test]
    fn the_shares_are_all_layers_and_no_dispatch_exceeds_the_iterations() {
        for records in [1, 4000, 54_000, 540_000] {
            for lights in [0, 1, 16] {
                let limits = Limits { shuffles: true, ..Limits::for_tests() };
                for (most, last_layer) in [
                    (1, LastLayer::Stack),
                    (1, LastLayer::Drop),
                    (4, LastLayer::Stack),
                    (16, LastLayer::Blend),
                    (64, LastLayer::Blend),
                    (256, LastLayer::Drop),
                ] {
                    let plan = TilePlan::of_boxes(&[(records, 10.0)], [512, 512], &limits).unwrap();
                    let plan = plan.with_layers(most, lights);
                    let settings =
                        Settings { layers: Layers::Fixed(most), last_layer, ..Settings::default() };
                    let shares = shares(&settings, &plan);
                    let all: u32 =
                        shares.iter().map(|share| share.surfaces + u32::from(share.blends_rest)).sum();
                    assert_eq!(all, most);
                    let rests = shares.iter().filter(|share| share.blends_rest).count();
                    assert_eq!(rests, usize::from(last_layer != LastLayer::Drop));
                    assert!(shares.iter().rev().skip(1).all(|share| !share.blends_rest));
                    for share in &shares {
                        // Two walks and a loop over the lights for each pixel of a column; the rest is lit splat by splat.
                        let surface = 2 * plan.part_length.div_ceil(8) + 8 * lights + 1;
                        let rest = (1 + lights) * plan.part_length.div_ceil(8);
                        let iterations = share.surfaces * surface + u32::from(share.blends_rest) * rest;
                        assert!(iterations < 65_535, "{records} {most} {lights}: {share:?}");
                    }
                    assert!((1 + lights) * plan.walk_length.div_ceil(8) + 8 * lights + 3 < 65_535);
                }
            }
        }
    }
}
