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
    bins::list,
    layer_work::{Work, dispatches},
    splat::VISIBLE_FORMAT,
};
use crate::{
    error::Result,
    graph::{
        Access, Buffer, BufferDesc, Graph, Handle, Image, ResourceId, Start,
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
    /// The scene's own lights.
    pub lights: u32,
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
        (beside.lights > 0).then_some("lit"),
        beside.opaque.then_some("behind"),
        match work {
            Work::Whole => None,
            Work::Several => Some("several"),
            Work::Parts => Some("parts"),
        },
        plan.invocations.word(),
    ];
    let name: String = words.into_iter().flatten().map(|word| format!("_{word}")).collect();
    let mut constants = splat_constants(settings, false, false);
    constants.extend(shading_constants(settings.shading, beside.lights));
    let part = if work == Work::Parts { plan.walk_length } else { plan.part_length };
    constants.extend([(19, part), (20, u32::from(stacked(settings)))]);
    Ok((find(&format!("tile_layers{name}.comp"))?, constants))
}

/// Whether the last layer counts as several surfaces: it does where there is a layer before it.
fn stacked(settings: &Settings) -> bool {
    settings.last_layer == LastLayer::Stack && settings.layers.most() > 1
}

/// Declares the passes, of lists too; returns what the layers add up to: linear light times alpha, and alpha.
pub(in super::super) fn layers<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    opaque: Option<&Handle<Image>>,
    lights: Option<&Handle<Buffer>>,
) -> Result<Handle<Image>> {
    let mut layers = graph.create_image("layers", inputs.image(sum_format(inputs.settings.accumulate)));
    super::clear(graph, "clear layers", &mut [&mut layers]);
    let around = (opaque, lights);
    for (band, inputs, plan) in inputs.of_bands() {
        let tiles = list(graph, inputs, &format!("transparent {band}"), plan)?;
        let work = Work::of_whole_tiles(inputs.settings, plan);
        declare(graph, inputs, (&band, &tiles), around, &mut layers, work)?;
        if plan.may_be_overfull() {
            declare(graph, inputs, (&band, &tiles), around, &mut layers, Work::Parts)?;
        }
    }
    Ok(layers)
}

/// Opaque depth and lights.
type Around<'f> = (Option<&'f Handle<Image>>, Option<&'f Handle<Buffer>>);

/// Declares the pass of one kind of work, which keeps what it needs from dispatch to dispatch.
fn declare<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    (band, tiles): (&str, &Tiles<'a>),
    (opaque, lights): Around<'_>,
    layers: &mut Handle<Image>,
    work: Work,
) -> Result<()> {
    let beside = Beside { opaque: opaque.is_some(), lights: inputs.lights };
    let shader = shader(inputs.settings, tiles.plan, beside, work)?;
    let mut pass = TilePass::new(inputs, tiles.plan, shader, Vec::new())?;
    tiles.bind_lists(&mut pass, false);
    pass.storage_images = vec![(COLOR_SUMS, layers.id())];
    pass.sampled_images = opaque.map(|opaque| (DEPTH_BEFORE, opaque.id())).into_iter().collect();
    pass.buffers.extend(lights.map(|lights| (LIGHTS, lights.id())));

    let mut kept_images = Vec::new();
    if work == Work::Several {
        for (binding, name) in [(VISIBLE_DEPTH, "peeled depth"), (PEELED_WEIGHT, "peeled weight")] {
            let image = graph.create_image(&format!("{band}{name}"), inputs.image(VISIBLE_FORMAT));
            pass.storage_images.push((binding, image.id()));
            kept_images.push(image);
        }
    }
    let size_bytes = tiles.plan.most_overfull() * STATE_BYTES;
    let mut kept = (work == Work::Parts).then(|| {
        graph.create_buffer(&format!("state of {band}overfull tiles"), BufferDesc::of_bytes(size_bytes))
    });
    pass.buffers.extend(kept.iter().map(|kept| (PEELED_STATE, kept.id())));

    let (name, offset) = match work {
        Work::Whole | Work::Several => (format!("layers of {band}tiles"), SEEN_ARGUMENTS),
        Work::Parts => (format!("layers of {band}overfull tiles"), OVERFULL_ARGUMENTS),
    };
    let mut declared =
        tiles.read_lists(graph.pass(&name)).write(layers, Access::StorageReadWriteCompute, Start::Load);
    if let Some(opaque) = opaque {
        declared = declared.read(opaque, Access::SampledCompute);
    }
    if let Some(lights) = lights {
        declared = declared.read(lights, Access::UniformReadCompute);
    }
    for image in &mut kept_images {
        declared = declared.write(image, Access::StorageReadWriteCompute, Start::Discard);
    }
    if let Some(kept) = &mut kept {
        declared = declared.write(kept, Access::StorageReadWriteCompute, Start::Discard);
    }
    let arguments = tiles.arguments.id();
    let dispatches = dispatches(inputs.settings, tiles.plan, work, pass.constants);
    declared.finish(Box::new(move |context| record(context, &pass, arguments, offset, &dispatches)));
    Ok(())
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
