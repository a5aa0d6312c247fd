//! Transparent layers of splats alone, by tiles: all of them in one dispatch, or in as few as a shader's loops allow.

use ash::vk;

use crate::passes::pipeline::formats::sum_format;
use crate::passes::{
    inputs::Inputs,
    pass::Pass,
    pipeline::{key::ComputeKey, variant::shading_constants},
    place::tiles as at,
    plan::tiles::TilePlan,
    tiles::{
        bins::list,
        clear::clear,
        dispatch,
        layer_work::{Work, of_parts, of_shares},
        lists::Tiles,
        overflow, splat,
    },
};
use crate::{
    error::Result,
    graph::{Access, Buffer, BufferDesc, Graph, Handle, Image, Start, execute::Body},
    scene::{Edges, LastLayer, Settings},
    shaders::{self, config::*},
};

/// Bytes of what is known of an overflow tile between dispatches.
fn state_bytes(edges: Edges) -> u64 {
    let of_edges = if edges == Edges::Coverage { EDGE_STATE_VECTORS } else { 0 };
    u64::from(TILE_WIDTH * MOST_TILE_HEIGHT * (STATE_VECTORS + of_edges) * 16)
}

/// Depth and weight of the layer before, the depth of the last one that faces away, and what layers of one surface cover, between dispatches; and where edges cover pixels in part, what ended.
const PEELED_FORMAT: vk::Format = vk::Format::R32G32B32A32_SFLOAT;

/// What depends on the scene beside the splats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Beside {
    /// There are opaque things.
    opaque: bool,
    /// The scene's own lights.
    lights: u32,
}

/// The pipeline.
fn key(settings: &Settings, plan: &TilePlan, beside: Beside, work: Work) -> ComputeKey {
    let shader = plan.invocations.shader(match work {
        Work::Whole | Work::Several => [&shaders::TILE_LAYERS_COLUMN_COMP, &shaders::TILE_LAYERS_PIXEL_COMP],
        Work::Parts => {
            [&shaders::TILE_LAYERS_OVERFLOW_COLUMN_COMP, &shaders::TILE_LAYERS_OVERFLOW_PIXEL_COMP]
        }
    });
    let part_length = if work == Work::Parts { plan.walk_length } else { plan.part_length };
    let plan = &TilePlan { part_length, ..plan.clone() };
    let mut constants = splat::constants(settings, plan, settings.accumulate);
    constants.extend(shading_constants(settings.shading, beside.lights));
    constants.extend([
        (SPEC_STACKED, u32::from(stacked(settings))),
        (SPEC_DEPTH_PRELOADED, u32::from(beside.opaque)),
        (SPEC_SEVERAL, u32::from(work == Work::Several)),
    ]);
    dispatch::key(shader, constants)
}

/// Whether the last layer counts as several surfaces: it does where there is a layer before it.
fn stacked(settings: &Settings) -> bool {
    settings.last_layer == LastLayer::Stack && settings.layers.most() > 1
}

/// Declares the passes, of lists too; returns what the layers add up to: linear light times alpha, and alpha.
pub(crate) fn layers<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    opaque: Option<&Handle<Image>>,
    lights: Option<&Handle<Buffer>>,
) -> Result<Handle<Image>> {
    let mut layers = graph.create_image("layers", inputs.image(sum_format(inputs.settings.accumulate)));
    let why = "transparent splats: tiles without any have no layer";
    clear(graph, inputs.source, "clear layers", why, &mut [&mut layers]);
    let around = (opaque, lights);
    for (band, inputs, plan) in inputs.of_bands(graph.arena()) {
        let kind = graph.arena().text(format_args!("transparent {band}"));
        let tiles = list(graph, inputs, kind, plan)?;
        let work = Work::of_whole_tiles(inputs.settings, plan);
        declare(graph, inputs, (band, &tiles), around, &mut layers, work)?;
        if plan.may_overflow() {
            declare(graph, inputs, (band, &tiles), around, &mut layers, Work::Parts)?;
        }
    }
    Ok(layers)
}

/// Opaque depth and lights.
type Around<'f> = (Option<&'f Handle<Image>>, Option<&'f Handle<Buffer>>);

/// Declares the pass of one kind of work, which keeps what it needs from dispatch to dispatch.
fn declare<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    (band, tiles): (&str, &Tiles<'a>),
    (opaque, lights): Around<'_>,
    layers: &mut Handle<Image>,
    work: Work,
) -> Result<()> {
    let (settings, plan) = (inputs.settings, tiles.plan);
    let (which, why) = match work {
        Work::Whole | Work::Several => {
            let why = "transparent splats: all layers of one tile after the other";
            ("", why)
        }
        Work::Parts => ("overflow ", overflow::WHY),
    };
    let mut peeled = (work == Work::Several).then(|| {
        graph.create_image(format_args!("{band}peeled depth and weight"), inputs.image(PEELED_FORMAT))
    });
    let mut ends = (work == Work::Several && settings.edges == Edges::Coverage)
        .then(|| graph.create_image(format_args!("{band}layers that end"), inputs.image(PEELED_FORMAT)));
    let state_bytes = BufferDesc::of_bytes(plan.most_overflow() * state_bytes(settings.edges));
    let mut state = (work == Work::Parts)
        .then(|| graph.create_buffer(format_args!("state of {band}overflow tiles"), state_bytes));

    let update =
        if peeled.is_some() { Access::SampledAndStoredCompute } else { Access::StorageReadWriteCompute };
    let mut pass = tiles
        .read_lists(Pass::new(graph, inputs.source, format_args!("layers of {band}{which}tiles"), why))
        .read_if(at(BIND_DEPTH_BEFORE), opaque, Access::SampledCompute)
        .read_if(at(BIND_LIGHTS), lights, Access::UniformReadCompute)
        .write(at(BIND_COLORS), layers, update, Start::Load);
    pass = match &mut peeled {
        Some(peeled) => pass
            .also(at(BIND_COLORS_BEFORE))
            .write(at(BIND_NORMALS), peeled, update, Start::Discard)
            .also(at(BIND_NORMALS_BEFORE)),
        // An image that is not written has to be one that may be: a stand-in is only read.
        None => pass.also(at(BIND_NORMALS)),
    };
    pass = match &mut ends {
        Some(ends) => {
            pass.write(at(BIND_VISIBLE_DEPTH), ends, update, Start::Discard).also(at(BIND_VISIBLE_BEFORE))
        }
        None => pass.also(at(BIND_VISIBLE_DEPTH)),
    };
    if let Some(state) = &mut state {
        pass = pass.write(at(BIND_LAYER_STATE), state, Access::StorageReadWriteCompute, Start::Discard);
    }
    let key = key(settings, plan, Beside { opaque: opaque.is_some(), lights: inputs.lights }, work);
    dispatch::finish(pass, inputs, (plan, key), move |pass| match work {
        Work::Whole | Work::Several => {
            for (number, constants) in (0..).zip(of_shares(settings, plan, pass.constants)) {
                if number > 0 {
                    pass.wait();
                }
                pass.whole_tiles(constants)?;
            }
            Ok(())
        }
        Work::Parts => pass.indirect_in_turn(of_parts(settings, plan, pass.constants), ARGUMENTS_OVERFLOW),
    })
}
