//! Visibility, accumulation and shading of the listed splats in one dispatch, a tile at a time: tiles leave what they show. Those with
//! more splats than one dispatch takes, of which there are few, if any, are seen and summed in parts after it, in images of such tiles
//! alone, then shaded from these.

use crate::passes::{
    inputs::Inputs,
    pass::Pass,
    pipeline::variant::resolve_constants,
    pipeline::{key::ComputeKey, variant::shading_constants},
    place::tiles as at,
    plan::tiles::TilePlan,
    tiles::{
        dispatch,
        lists::Tiles,
        overflow,
        splat::{self, TileImages, TileStart, beside_polygons},
    },
};
use crate::{
    error::Result,
    graph::{Access, Buffer, Graph, Handle, Image, Role, execute::Body},
    scene::{Accumulate, Settings},
    shaders::{self, config::*},
};

/// What tiles show, in place of sums.
pub(crate) struct ShadedTiles {
    pub image: Handle<Image>,
    /// The image's.
    pub precision: Accumulate,
}

/// Beside what tiles are shaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Beside {
    polygons: bool,
    /// The scene's own lights.
    lights: u32,
}

/// The pipeline. `precision`: of what is shown.
fn key(
    settings: &Settings,
    plan: &TilePlan,
    precision: Accumulate,
    Beside { polygons, lights }: Beside,
) -> ComputeKey {
    let shader = plan.invocations.shader(match plan.hidden {
        false => [&shaders::TILE_SHADE_COLUMN_COMP, &shaders::TILE_SHADE_PIXEL_COMP],
        true => [&shaders::TILE_SHADE_COLUMN_HIDDEN_COMP, &shaders::TILE_SHADE_PIXEL_HIDDEN_COMP],
    });
    let mut constants = splat::constants(settings, plan, precision);
    constants.extend(resolve_constants(settings, true, polygons, lights));
    if polygons {
        constants.extend(beside_polygons(settings));
    }
    dispatch::key(shader, constants)
}

/// Declares all of it, shading too. `polygons`: their depth, as if there were no splats; `kind`, `start`: as in
/// [`crate::passes::tiles::splat::fused`].
pub(crate) fn shaded<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    tiles: &mut Tiles<'a>,
    shown: &mut ShadedTiles,
    (polygons, lights): (Option<&Handle<Image>>, Option<&Handle<Buffer>>),
    start: TileStart,
) -> Result<()> {
    let plan = tiles.plan;
    let beside = Beside { polygons: polygons.is_some(), lights: inputs.lights };
    let (access, content) = start.access();
    let why = "opaque splats: visibility, sums and shading of one tile after the other";
    let pass =
        Pass::new(graph, inputs.source, &format!("see, sum and shade {kind}tiles"), why).role(Role::DrawsAll);
    let mut pass = match plan.hidden {
        true => tiles.shorten_lists(pass),
        false => tiles.read_lists(pass),
    }
    .read_if(at(BIND_LIGHTS), lights, Access::UniformReadCompute)
    .read_if(at(BIND_POLYGON_DEPTH), polygons, Access::SampledCompute)
    .write(at(BIND_COLORS), &mut shown.image, access, content);
    if beside.polygons {
        pass = pass.also(at(BIND_COLORS_BEFORE));
    }
    let key = key(inputs.settings, plan, shown.precision, beside);
    dispatch::finish_indirect(pass, inputs, (plan, key), ARGUMENTS_TILES)?;
    match plan.may_overflow() {
        true => shade_overflow(graph, inputs, kind, tiles, shown, lights),
        false => Ok(()),
    }
}

/// Declares the passes of overflow tiles.
fn shade_overflow<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    tiles: &Tiles<'a>,
    shown: &mut ShadedTiles,
    lights: Option<&Handle<Buffer>>,
) -> Result<()> {
    let plan = tiles.plan;
    let mut images = TileImages::of_overflow(graph, kind, plan);
    splat::see(graph, inputs, kind, tiles, &mut images, None, false)?;
    splat::sum(graph, inputs, kind, tiles, &mut images, (None, false), false)?;

    let mut constants = shading_constants(inputs.settings.shading, inputs.lights);
    constants.extend(splat::constants(inputs.settings, plan, shown.precision));
    let (access, content) = TileStart::Bands.access(); // the other tiles
    let pass = Pass::new(graph, inputs.source, &format!("shade {kind}overflow tiles"), overflow::WHY);
    let pass = tiles
        .read_lists(pass)
        .read(at(BIND_COLORS_BEFORE), &images.sums.color, Access::SampledCompute)
        .read(at(BIND_NORMALS_BEFORE), &images.sums.normal, Access::SampledCompute)
        .read_if(at(BIND_LIGHTS), lights, Access::UniformReadCompute)
        .write(at(BIND_COLORS), &mut shown.image, access, content);
    let key = dispatch::key(&shaders::TILE_SHADE_OVERFLOW_COMP, constants);
    dispatch::finish_indirect(pass, inputs, (plan, key), ARGUMENTS_OVERFLOW)
}
