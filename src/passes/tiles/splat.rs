//! Visibility and accumulation of the listed splats, a tile at a time: both at once, or one of them where the graphics
//! pipeline draws in between.

use ash::vk;

use super::{
    super::{
        Inputs,
        accumulate::Sums,
        finalize::shown_constants,
        splat_shaders::find,
        sum_format,
        variant::{Constants, splat_constants},
    },
    COLOR_SUMS, DEPTH_BEFORE, NORMAL_SUMS, OVERFULL_ARGUMENTS, POLYGON_DEPTH, SEEN_ARGUMENTS, TilePass,
    TilePlan, Tiles, VISIBLE_DEPTH,
    bins::part_length,
    overfull::{Parts, extent_of_slots, of_parts},
};
use crate::{
    error::Result,
    graph::{Access, Graph, Handle, Image, ImageDesc, Start, execute::Body},
    scene::{Accumulate, Settings, Transition},
    shaders::Shader,
};

/// The depth that tiles find, for other compute passes and for fragments.
pub(in super::super) const VISIBLE_FORMAT: vk::Format = vk::Format::R32_SFLOAT;

/// The constant of whether anyone reads the depth that tiles find.
const KEEPS_DEPTH: u32 = 23;

/// The constant of whether images hold overfull tiles alone.
const IN_SLOTS: u32 = 26;

/// What tiles leave. Outside of tiles with splats, the images hold nothing unless they were cleared.
pub(in super::super) struct TileImages {
    pub sums: Sums,
    pub depth: Handle<Image>,
    /// They hold overfull tiles alone, one beside the other.
    in_slots: bool,
}

impl TileImages {
    /// Images with nothing in them yet; `cleared`: 0 everywhere, for what draws into them or reads all of them.
    pub fn create<'a>(
        graph: &mut Graph<Body<'a>>,
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
            super::clear(graph, "clear sums", &mut [color, normal, depth]);
        }
        images
    }

    /// Images of as many overfull tiles as there may be.
    pub fn of_overfull<'a>(graph: &mut Graph<Body<'a>>, kind: &str, plan: &TilePlan) -> Self {
        let extent = extent_of_slots(plan.most_overfull() as u32, plan.tile_px());
        let mut image = |what, format| {
            graph.create_image(&format!("{what} of {kind}overfull tiles"), ImageDesc { format, extent })
        };
        let format = sum_format(Accumulate::F32);
        Self {
            sums: Sums { color: image("color sums", format), normal: image("normal sums", format) },
            depth: image("visible depth", VISIBLE_FORMAT),
            in_slots: true,
        }
    }
}

/// The word of a precision in the names of permutations.
pub(super) fn bits(precision: Accumulate) -> &'static str {
    match precision {
        Accumulate::F16 => "half",
        Accumulate::F32 => "single",
    }
}

/// The precision of the sums in the images. Those of an overfull tile go on from part to part, which half floats, which end at
/// 65504, would not bear; but what the graphics pipeline adds to is as it was asked for.
fn accumulate_of(settings: &Settings, plan: &TilePlan) -> Accumulate {
    match plan.may_be_overfull() && !plan.may_be_large {
        true => Accumulate::F32,
        false => settings.accumulate,
    }
}

/// What the images hold when a pass writes to their tiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) enum TileStart {
    /// Nothing, and what tiles without splats hold then nobody reads.
    Empty,
    /// What polygons show, and nothing elsewhere: all of it is read.
    Polygons,
    /// The tiles of other bands; nothing else, as above.
    Bands,
    /// 0 everywhere, but where there are the tiles of other bands: all of it is read.
    Cleared,
}

impl TileStart {
    /// What they hold then.
    pub fn after_a_band(self) -> Self {
        if self == Self::Empty { Self::Bands } else { self }
    }

    /// How a pass writes to them.
    pub fn access(self) -> (Access, Start) {
        match self {
            Self::Empty => (Access::StorageWriteCompute, Start::Discard),
            Self::Polygons | Self::Bands | Self::Cleared => (Access::StorageReadWriteCompute, Start::Load),
        }
    }
}

/// What the shader does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) enum Step {
    Shaded { precision: Accumulate, beside: bool, lights: u32, hidden: bool },
    Fused { upon: bool, with_depth: bool, hidden: bool },
    Visible { upon: bool },
    Summed { beside: bool, with_depth: bool },
}

/// The shader of a step, and its constants.
pub(in super::super) fn shader(
    settings: &Settings,
    plan: &TilePlan,
    step: Step,
) -> Result<(&'static Shader, Constants)> {
    let sums = bits(accumulate_of(settings, plan));
    let word = |choice: bool, word: &'static str| choice.then_some(word);
    let words = match step {
        Step::Shaded { precision, beside, lights, hidden } => {
            let traits = [word(beside, "beside"), word(lights > 0, "lit"), word(hidden, "hidden")];
            [&[Some("shaded"), Some(bits(precision))], traits.as_slice()].concat()
        }
        Step::Fused { upon, with_depth, hidden } => {
            let traits = [word(with_depth, "with_depth"), word(upon, "upon"), word(hidden, "hidden")];
            [&[Some("fused"), Some(sums)], traits.as_slice()].concat()
        }
        Step::Visible { upon } => vec![Some("visible"), word(upon, "upon")],
        Step::Summed { beside, with_depth } => {
            vec![Some("summed"), Some(sums), word(with_depth, "with_depth"), word(beside, "beside")]
        }
    };
    let words = words.into_iter().chain([plan.invocations.word()]).flatten();
    let name: String = words.map(|word| format!("_{word}")).collect();
    // What differs between chunks is in their records.
    let mut constants = splat_constants(settings, false, false);
    constants.extend(part_length(plan));
    if let Step::Shaded { beside, lights, .. } = step {
        constants.extend(shown_constants(settings, beside, lights));
    }
    if let Step::Shaded { beside: true, .. } | Step::Summed { beside: true, .. } = step {
        constants.push((18, u32::from(settings.transition == Transition::Paper)));
    }
    Ok((find(&format!("tile_splat{name}.comp"))?, constants))
}

/// Declares visibility and accumulation in one pass. `before`: the depth of visible splats that the graphics pipeline has
/// drawn; `kind`, in front of the tiles, tells those of several bands apart; `with_depth`: depth is summed too; `start`: what the images hold.
pub(in super::super) fn fused<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    tiles: &mut Tiles<'a>,
    images: &mut TileImages,
    before: Option<&Handle<Image>>,
    (with_depth, start): (bool, TileStart),
) -> Result<()> {
    let step = Step::Fused { upon: before.is_some(), with_depth, hidden: tiles.plan.hidden };
    let mut shader_of_step = shader(inputs.settings, tiles.plan, step)?;
    if start != TileStart::Cleared {
        shader_of_step.1.push((KEEPS_DEPTH, 0));
    }
    let mut fused = TilePass::new(inputs, tiles.plan, shader_of_step, Vec::new())?;
    tiles.bind_lists(&mut fused, tiles.plan.hidden);
    fused.storage_images = vec![
        (COLOR_SUMS, images.sums.color.id()),
        (NORMAL_SUMS, images.sums.normal.id()),
        (VISIBLE_DEPTH, images.depth.id()),
    ];
    fused.sampled_images = before.map(|before| (DEPTH_BEFORE, before.id())).into_iter().collect();
    let arguments = tiles.arguments.id();
    let (access, content) = start.access();
    let pass = graph.pass(&format!("see and sum {kind}tiles"));
    let mut pass = if tiles.plan.hidden { tiles.shorten_lists(pass) } else { tiles.read_lists(pass) };
    for image in [&mut images.sums.color, &mut images.sums.normal, &mut images.depth] {
        pass = pass.write(image, access, content);
    }
    if let Some(before) = before {
        pass = pass.read(before, Access::SampledCompute);
    }
    pass.finish(Box::new(move |context| fused.dispatch_indirect(context, arguments, SEEN_ARGUMENTS)));
    if tiles.plan.may_be_overfull() {
        let seen = Step::Visible { upon: before.is_some() };
        let summed = Step::Summed { beside: false, with_depth };
        in_parts(graph, inputs, kind, tiles, images, before, (seen, None))?;
        in_parts(graph, inputs, kind, tiles, images, None, (summed, None))?;
    }
    Ok(())
}

/// Declares visibility alone.
pub(in super::super) fn visibility<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    tiles: &Tiles<'a>,
    images: &mut TileImages,
    before: Option<&Handle<Image>>,
) -> Result<()> {
    let step = Step::Visible { upon: before.is_some() };
    in_parts(graph, inputs, "", tiles, images, before, (step, Some(SEEN_ARGUMENTS)))
}

/// Declares accumulation alone. `polygons`: the larger one of visible depth and that of polygons, where there are any.
pub(in super::super) fn accumulate<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    tiles: &Tiles<'a>,
    images: &mut TileImages,
    polygons: Option<&Handle<Image>>,
    with_depth: bool,
) -> Result<()> {
    let step = Step::Summed { beside: polygons.is_some(), with_depth };
    in_parts(graph, inputs, "", tiles, images, polygons, (step, Some(SEEN_ARGUMENTS)))
}

/// Visibility or accumulation: of whole tiles, where there are arguments for them, then of the parts of overfull ones. `depth`: what
/// it reads beside the tiles' own.
pub(super) fn in_parts<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    tiles: &Tiles<'a>,
    images: &mut TileImages,
    depth: Option<&Handle<Image>>,
    (step, whole): (Step, Option<u64>),
) -> Result<()> {
    let mut shader = shader(inputs.settings, tiles.plan, step)?;
    let start = if images.in_slots { Start::Discard } else { Start::Load };
    if images.in_slots {
        shader.1.push((IN_SLOTS, 1));
    }
    let mut of_tiles = TilePass::new(inputs, tiles.plan, shader, Vec::new())?;
    tiles.bind_lists(&mut of_tiles, false);
    let TileImages { sums: Sums { color, normal }, depth: own_depth, .. } = images;
    of_tiles.storage_images = vec![(VISIBLE_DEPTH, own_depth.id())];
    let which = if whole.is_some() { "tiles" } else { "overfull tiles" };
    let sums = matches!(step, Step::Summed { .. });
    let name = format!("{} {kind}{which}", if sums { "sum" } else { "see" });
    let mut pass = tiles.read_lists(graph.pass(&name));
    let sampled = if sums {
        of_tiles.storage_images.extend([(COLOR_SUMS, color.id()), (NORMAL_SUMS, normal.id())]);
        pass = pass
            .read(own_depth, Access::StorageReadCompute)
            .write(color, Access::StorageReadWriteCompute, start)
            .write(normal, Access::StorageReadWriteCompute, start);
        POLYGON_DEPTH
    } else {
        pass = pass.write(own_depth, Access::StorageReadWriteCompute, start);
        DEPTH_BEFORE
    };
    if let Some(depth) = depth {
        of_tiles.sampled_images = vec![(sampled, depth.id())];
        pass = pass.read(depth, Access::SampledCompute);
    }
    let parts = Parts {
        arguments: tiles.arguments.id(),
        whole,
        overfull: OVERFULL_ARGUMENTS,
        parts: of_parts(tiles.plan),
    };
    pass.finish(Box::new(move |context| parts.record(context, &of_tiles)));
    Ok(())
}
