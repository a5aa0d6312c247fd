//! Visibility, accumulation and shading of the listed splats in one dispatch, a tile at a time: tiles leave what they show. Those with
//! more splats than one dispatch takes, of which there are few, if any, are seen and summed in parts after it, in images of such tiles
//! alone, then shaded from these.

use crate::passes::{
    inputs::Inputs,
    pass::Pass,
    pipeline::formats::sum_format,
    pipeline::variant::resolve_constants,
    pipeline::{key::ComputeKey, variant::shading_constants},
    place::tiles as at,
    plan::{outputs::Outputs, tiles::TilePlan},
    tiles::{
        clear::clear,
        dispatch,
        lists::Tiles,
        overflow,
        splat::{self, TileImages, VISIBLE_FORMAT, beside_polygons},
        start::TileStart,
    },
};
use crate::{
    error::Result,
    graph::{Access, Buffer, Graph, Handle, Image, Role, Start, execute::Body},
    scene::{Accumulate, Settings},
    shaders::{self, config::*},
};

/// What tiles show, in place of sums.
pub(crate) struct ShadedTiles {
    pub image: Handle<Image>,
    /// The image's.
    pub precision: Accumulate,
    /// The depth that hides transparent layers, where there are any.
    pub depth: Option<Handle<Image>>,
    /// The surface's own depth, where a host wants it.
    pub own_depth: Option<Handle<Image>>,
    /// What both depths hold when the next band's tiles write to them.
    depth_start: Start,
}

impl ShadedTiles {
    /// Images with nothing in them yet; where layers read all of them, and no polygons are drawn before, 0 everywhere.
    pub fn create<'a>(graph: &mut Graph<'a, Body<'a>>, inputs: Inputs<'a>, outputs: Outputs) -> Self {
        let precision = outputs.shaded_precision(inputs.settings);
        let mut image = graph.create_image("shaded tiles", inputs.image(sum_format(precision)));
        let mut of_depth = |name| graph.create_image(name, inputs.image(VISIBLE_FORMAT));
        let depth = outputs.layers.then(|| of_depth("visible depth"));
        let own_depth = outputs.depth.then(|| of_depth("own depth"));
        if outputs.layers && inputs.meshes.is_empty() {
            let why = "transparent layers lie over all of what tiles show";
            clear(graph, inputs.source, "clear shaded tiles", why, &mut [&mut image]);
        }
        Self { image, precision, depth, own_depth, depth_start: Start::Discard }
    }
}

/// Polygons, drawn as if there were no splats.
#[derive(Clone, Copy)]
pub(crate) enum PolygonsBefore<'p> {
    None,
    /// Their depth; what they show is in the image of what tiles do.
    Whole(&'p Handle<Image>),
    /// Light and depth, sample by sample.
    Sampled(&'p Handle<Image>, &'p Handle<Image>),
}

/// Beside what tiles are shaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Beside {
    polygons: bool,
    /// Transparent layers, which read the depth.
    layers: bool,
    /// A host, which reads the surface's own.
    host: bool,
    /// The scene's own lights.
    lights: u32,
}

/// The pipeline. `precision`: of what is shown.
fn key(
    settings: &Settings,
    plan: &TilePlan,
    precision: Accumulate,
    Beside { polygons, layers, host, lights }: Beside,
) -> ComputeKey {
    let shader = plan.invocations.shader(match (plan.hidden, plan.samples_polygons) {
        (false, false) => [&shaders::TILE_SHADE_COLUMN_COMP, &shaders::TILE_SHADE_PIXEL_COMP],
        (true, _) => [&shaders::TILE_SHADE_COLUMN_HIDDEN_COMP, &shaders::TILE_SHADE_PIXEL_HIDDEN_COMP],
        (false, true) => {
            [&shaders::TILE_SHADE_COLUMN_POLYGONS_COMP, &shaders::TILE_SHADE_PIXEL_POLYGONS_COMP]
        }
    });
    let mut constants = splat::constants(settings, plan, precision);
    constants.extend(resolve_constants(settings, true, polygons, lights));
    if polygons {
        constants.extend(beside_polygons(settings));
    }
    constants.push((SPEC_KEEPS_DEPTH, layers.into()));
    constants.extend(host.then_some((SPEC_WITH_DEPTH, 1)));
    dispatch::key(shader, constants)
}

/// Declares all of it, shading too. `kind`, `start`: as in
/// [`crate::passes::tiles::splat::fused`].
pub(crate) fn shaded<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    tiles: &mut Tiles<'a>,
    shown: &mut ShadedTiles,
    (polygons, lights): (PolygonsBefore<'_>, Option<&Handle<Buffer>>),
    start: TileStart,
) -> Result<()> {
    let plan = tiles.plan;
    let layers = shown.depth.is_some();
    let host = shown.own_depth.is_some();
    let has_polygons = !matches!(polygons, PolygonsBefore::None);
    let beside = Beside { polygons: has_polygons, layers, host, lights: inputs.lights };
    let (depth, samples) = match polygons {
        PolygonsBefore::None => (None, None),
        PolygonsBefore::Whole(depth) => (Some(depth), None),
        PolygonsBefore::Sampled(color, depth) => (Some(depth), Some(color)),
    };
    let (access, content) = start.access();
    let why = "opaque splats: visibility, sums and shading of one tile after the other";
    let pass = Pass::new(graph, inputs.source, format_args!("see, sum and shade {kind}tiles"), why)
        .role(Role::DrawsAll);
    let mut pass = match plan.hidden {
        true => tiles.shorten_lists(pass),
        false => tiles.read_lists(pass),
    }
    .read_if(at(BIND_LIGHTS), lights, Access::UniformReadCompute)
    .read_if(at(BIND_POLYGON_DEPTH), depth, Access::SampledCompute)
    .read_if(at(BIND_COLORS_BEFORE), samples, Access::SampledCompute)
    .write(at(BIND_COLORS), &mut shown.image, access, content);
    if beside.polygons && samples.is_none() {
        pass = pass.also(at(BIND_COLORS_BEFORE));
    }
    // An image that is not written has to be one that may be: a stand-in is only read.
    let access = match shown.depth_start {
        Start::Discard => Access::StorageWriteCompute,
        _ => Access::StorageReadWriteCompute,
    };
    let depths = [(BIND_VISIBLE_DEPTH, &mut shown.depth), (BIND_NORMALS, &mut shown.own_depth)];
    for (binding, depth) in depths {
        pass = match depth {
            Some(depth) => pass.write(at(binding), depth, access, shown.depth_start),
            None => pass.also(at(binding)),
        };
    }
    shown.depth_start = Start::Load;
    let key = key(inputs.settings, plan, shown.precision, beside);
    dispatch::finish_whole(pass, inputs, (plan, key))?;
    match plan.may_overflow() {
        true => shade_overflow(graph, inputs, kind, tiles, shown, lights),
        false => Ok(()),
    }
}

/// Declares the passes of overflow tiles.
fn shade_overflow<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    tiles: &Tiles<'a>,
    shown: &mut ShadedTiles,
    lights: Option<&Handle<Buffer>>,
) -> Result<()> {
    let plan = tiles.plan;
    let mut images = TileImages::of_overflow(graph, kind, plan, inputs.settings.edges);
    splat::see(graph, inputs, kind, tiles, &mut images, None, false)?;
    let host = shown.own_depth.is_some();
    splat::sum(graph, inputs, kind, tiles, &mut images, (None, host), false)?;

    let mut constants = shading_constants(inputs.settings.shading, inputs.lights);
    constants.extend(splat::constants(inputs.settings, plan, shown.precision));
    let (access, content) = TileStart::Bands.access(); // the other tiles
    let pass = Pass::new(graph, inputs.source, format_args!("shade {kind}overflow tiles"), overflow::WHY);
    let mut pass = tiles
        .read_lists(pass)
        .read(at(BIND_VISIBLE_BEFORE), &images.depth, Access::SampledCompute)
        .read(at(BIND_COLORS_BEFORE), &images.sums.color, Access::SampledCompute)
        .read(at(BIND_NORMALS_BEFORE), &images.sums.normal, Access::SampledCompute)
        .read_if(at(BIND_LIGHTS), lights, Access::UniformReadCompute)
        .write(at(BIND_COLORS), &mut shown.image, access, content);
    pass = match &mut shown.own_depth {
        Some(depth) => pass.write(at(BIND_NORMALS), depth, Access::StorageReadWriteCompute, Start::Load),
        None => pass.also(at(BIND_NORMALS)),
    };
    constants.extend(host.then_some((SPEC_WITH_DEPTH, 1)));
    let key = dispatch::key(&shaders::TILE_SHADE_OVERFLOW_COMP, constants);
    dispatch::finish_indirect(pass, inputs, (plan, key), ARGUMENTS_OVERFLOW)
}
