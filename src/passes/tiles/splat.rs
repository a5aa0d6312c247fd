//! Visibility and accumulation of the listed splats, a tile at a time: both at once, or one of them where the graphics
//! pipeline draws in between.

use ash::vk;

use crate::passes::pipeline::formats::sum_format;
use crate::passes::{
    inputs::Inputs,
    pass::Pass,
    pipeline::{
        key::ComputeKey,
        variant::{Constants, outline_constant, splat_constants},
    },
    place::tiles as at,
    plan::tiles::TilePlan,
    splats::accumulate::Sums,
    tiles::{
        clear::clear,
        dispatch::{self, CLIPS, CUTS},
        lists::Tiles,
        overflow::{self, extent_of_slots, in_parts},
        start::TileStart,
    },
};
use crate::{
    error::Result,
    graph::{Access, Graph, Handle, Image, ImageDesc, Role, Start, execute::Body},
    scene::{Accumulate, Edges, Settings, Transition},
    shaders::{self, config::*},
};

/// The depth that tiles find, for other compute passes and for fragments.
pub(crate) const VISIBLE_FORMAT: vk::Format = vk::Format::R32_SFLOAT;

/// What tiles leave. Outside of tiles with splats, the images hold nothing unless they were cleared.
pub(crate) struct TileImages {
    pub sums: Sums,
    pub depth: Handle<Image>,
    /// They hold overflow tiles alone, one beside the other.
    in_slots: bool,
}

impl TileImages {
    /// Images with nothing in them yet; `cleared`: 0 everywhere, for what draws into them or reads all of them.
    pub fn create<'a>(
        graph: &mut Graph<'a, Body<'a>>,
        inputs: Inputs<'a>,
        plan: &TilePlan,
        cleared: bool,
    ) -> Self {
        let format = sum_format(accumulate_of(inputs.settings, plan));
        let mut image = |name, format| graph.create_image(name, inputs.image(format));
        let mut images = Self {
            sums: Sums { color: image("color sums", format), normal: image("normal sums", format) },
            depth: image("visible depth", VISIBLE_FORMAT),
            in_slots: false,
        };
        if cleared {
            let TileImages { sums: Sums { color, normal }, depth, .. } = &mut images;
            let why = "more than splats in tiles: the images are read as a whole";
            clear(graph, inputs.source, "clear sums", why, &mut [color, normal, depth]);
        }
        images
    }

    /// Images of as many overflow tiles as there may be. Where `edges` are covered in part, what covers pixels is below their colors, and below that what splats at borders do.
    pub fn of_overflow<'a>(
        graph: &mut Graph<'a, Body<'a>>,
        kind: &str,
        plan: &TilePlan,
        edges: Edges,
    ) -> Self {
        let extent = extent_of_slots(plan.most_overflow() as u32, plan.tile_px());
        let of_colors = match edges {
            Edges::Coverage if plan.reaches => 3 * extent.height,
            Edges::Coverage => 2 * extent.height,
            Edges::Hard => extent.height,
        };
        let mut image = |what, format, height| {
            let extent = vk::Extent2D { height, ..extent };
            graph.create_image(format_args!("{what} of {kind}overflow tiles"), ImageDesc { format, extent })
        };
        let format = sum_format(Accumulate::F32);
        let color = image("color sums", format, of_colors);
        Self {
            sums: Sums { color, normal: image("normal sums", format, extent.height) },
            depth: image("visible depth", VISIBLE_FORMAT, extent.height),
            in_slots: true,
        }
    }

    /// How a pass over parts begins.
    fn start(&self) -> Start {
        if self.in_slots { Start::Discard } else { Start::Load }
    }
}

/// The precision of the sums in the images. Those of an overflow tile go on from part to part, which half floats, which end at
/// 65504, would not bear; but what the graphics pipeline adds to is as it was asked for.
fn accumulate_of(settings: &Settings, plan: &TilePlan) -> Accumulate {
    match plan.may_overflow() && !plan.may_be_large {
        true => Accumulate::F32,
        false => settings.accumulate,
    }
}

/// What one pass does, and beside what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Step {
    sees: bool,
    sums: bool,
    /// What is hidden is left out of sums.
    hidden: bool,
    /// Depth is summed, too.
    with_depth: bool,
    /// The graphics pipeline has drawn visible splats before.
    preloaded: bool,
    polygons: bool,
}

impl Step {
    /// Visibility and accumulation of splats alone.
    const FUSED: Self =
        Self { sees: true, sums: true, hidden: false, with_depth: false, preloaded: false, polygons: false };
    const VISIBLE: Self = Self { sums: false, ..Self::FUSED };
    const SUMMED: Self = Self { sees: false, ..Self::FUSED };
}

/// The constants of what draws from the lists. What differs between chunks is in their records.
pub(crate) fn constants(settings: &Settings, plan: &TilePlan, images: Accumulate) -> Constants {
    let mut constants = splat_constants(settings, settings.size_px, false, false);
    constants.extend([
        (SPEC_PART_LENGTH, plan.part_length),
        (SPEC_TILE_HEIGHT, plan.invocations.tile_height()),
        (SPEC_HALF_FLOATS, u32::from(images == Accumulate::F16)),
    ]);
    if plan.parted_by() != 0 {
        constants.extend([(SPEC_PARTED, plan.parted_by()), CUTS]);
        constants.extend(plan.clips.then_some(CLIPS));
    }
    constants.extend(outline_constant(settings));
    if settings.edges == Edges::Coverage {
        let filter_px = settings.samples.filter_radius_px() as f32;
        constants.extend([(SPEC_COVERAGE_EDGES, 1), (SPEC_FILTER_PX, filter_px.to_bits())]);
        constants.extend(plan.two_sided.then_some((SPEC_TWO_SIDED, 1)));
        constants.extend(plan.reaches.then_some((SPEC_REACHES, 1)));
        constants.extend(plan.blended.then_some((SPEC_BLENDED, 1)));
    }
    constants
}

/// The constants of what draws beside polygons.
pub(crate) fn beside_polygons(settings: &Settings) -> Constants {
    let shifted_for_all = u32::from(settings.transition == Transition::Paper);
    [(SPEC_WITH_POLYGONS, 1), (SPEC_SHIFTED_FOR_ALL, shifted_for_all)].into()
}

/// The pipeline of a step.
fn key(settings: &Settings, plan: &TilePlan, step: Step) -> ComputeKey {
    let shader = plan.invocations.shader(match step.hidden {
        false => [&shaders::TILE_ACCUMULATE_COLUMN_COMP, &shaders::TILE_ACCUMULATE_PIXEL_COMP],
        true => [&shaders::TILE_ACCUMULATE_COLUMN_HIDDEN_COMP, &shaders::TILE_ACCUMULATE_PIXEL_HIDDEN_COMP],
    });
    let mut constants = constants(settings, plan, accumulate_of(settings, plan));
    constants.extend([
        (SPEC_SEES, u32::from(step.sees)),
        (SPEC_SUMS, u32::from(step.sums)),
        (SPEC_WITH_DEPTH, u32::from(step.with_depth)),
        (SPEC_DEPTH_PRELOADED, u32::from(step.preloaded)),
    ]);
    if step.polygons {
        constants.extend(beside_polygons(settings));
    }
    dispatch::key(shader, constants)
}

/// Declares visibility and accumulation in one pass. `before`: the depth of visible splats that the graphics pipeline has drawn; `kind`, in front of the
/// tiles, tells those of several bands apart; `with_depth`: depth is summed too; `start`: what the images hold.
pub(crate) fn fused<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    tiles: &mut Tiles<'a>,
    images: &mut TileImages,
    before: Option<&Handle<Image>>,
    (with_depth, start): (bool, TileStart),
) -> Result<()> {
    let plan = tiles.plan;
    let step = Step { hidden: plan.hidden, with_depth, preloaded: before.is_some(), ..Step::FUSED };
    let mut key = key(inputs.settings, plan, step);
    key.constants.push((SPEC_KEEPS_DEPTH, u32::from(start == TileStart::Cleared)));
    let why = "opaque splats: visibility and sums of one tile after the other";
    let pass =
        Pass::new(graph, inputs.source, format_args!("see and sum {kind}tiles"), why).role(Role::DrawsAll);
    let pass = if plan.hidden { tiles.shorten_lists(pass) } else { tiles.read_lists(pass) };
    let (access, content) = start.access();
    let pass = pass
        .write(at(BIND_COLORS), &mut images.sums.color, access, content)
        .write(at(BIND_NORMALS), &mut images.sums.normal, access, content)
        .write(at(BIND_VISIBLE_DEPTH), &mut images.depth, access, content)
        .read_if(at(BIND_DEPTH_BEFORE), before, Access::SampledCompute);
    dispatch::finish_whole(pass, inputs, (plan, key))?;
    if plan.may_overflow() {
        see(graph, inputs, kind, tiles, images, before, false)?;
        sum(graph, inputs, kind, tiles, images, (None, with_depth), false)?;
    }
    Ok(())
}

/// Declares visibility alone: of parts of overflow tiles, or of `all` tiles. `before`: as in [`fused`].
pub(crate) fn see<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    tiles: &Tiles<'a>,
    images: &mut TileImages,
    before: Option<&Handle<Image>>,
    all: bool,
) -> Result<()> {
    let step = Step { preloaded: before.is_some(), ..Step::VISIBLE };
    let start = images.start();
    let why = "opaque splats beside polygons: the depth of the nearest surface of each tile";
    let pass = begin(graph, inputs, "see", (kind, why), all);
    let pass = tiles
        .read_lists(pass)
        .write(at(BIND_VISIBLE_DEPTH), &mut images.depth, Access::SampledAndStoredCompute, start)
        .also(at(BIND_VISIBLE_BEFORE))
        // An image that the step does not write has to be one that it may: a stand-in is only read.
        .also(at(BIND_COLORS))
        .also(at(BIND_NORMALS))
        .read_if(at(BIND_DEPTH_BEFORE), before, Access::SampledCompute);
    finish(pass, inputs, tiles, images, step, all)
}

/// Declares accumulation alone. `polygons`: the larger one of visible depth and that of polygons, where there are any;
/// `with_depth`: as in [`fused`].
pub(crate) fn sum<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    tiles: &Tiles<'a>,
    images: &mut TileImages,
    (polygons, with_depth): (Option<&Handle<Image>>, bool),
    all: bool,
) -> Result<()> {
    let step = Step { polygons: polygons.is_some(), with_depth, ..Step::SUMMED };
    let (update, start) = (Access::SampledAndStoredCompute, images.start());
    let why = "opaque splats beside polygons: sums of the nearest surface of each tile";
    let pass = begin(graph, inputs, "sum", (kind, why), all);
    let pass = tiles
        .read_lists(pass)
        .read(at(BIND_VISIBLE_BEFORE), &images.depth, Access::SampledCompute)
        .write(at(BIND_COLORS), &mut images.sums.color, update, start)
        .also(at(BIND_COLORS_BEFORE))
        .write(at(BIND_NORMALS), &mut images.sums.normal, update, start)
        .also(at(BIND_NORMALS_BEFORE))
        .also(at(BIND_VISIBLE_DEPTH)) // as above
        .read_if(at(BIND_POLYGON_DEPTH), polygons, Access::SampledCompute);
    finish(pass, inputs, tiles, images, step, all)
}

/// A pass over `all` tiles, or over parts of overflow tiles.
fn begin<'g, 'a>(
    graph: &'g mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    what: &str,
    (kind, why): (&str, &'static str),
    all: bool,
) -> Pass<'g, 'a> {
    let (of, why) = if all { ("tiles", why) } else { ("overflow tiles", overflow::WHY) };
    Pass::new(graph, inputs.source, format_args!("{what} {kind}{of}"), why)
}

fn finish<'a>(
    pass: Pass<'_, 'a>,
    inputs: Inputs<'a>,
    tiles: &Tiles<'a>,
    images: &TileImages,
    step: Step,
    all: bool,
) -> Result<()> {
    let mut key = key(inputs.settings, tiles.plan, step);
    key.constants.push((SPEC_IN_SLOTS, u32::from(images.in_slots)));
    let parts = tiles.plan.parts_of_overflow();
    dispatch::finish(pass, inputs, (tiles.plan, key), move |pass| in_parts(pass, all, parts))
}
