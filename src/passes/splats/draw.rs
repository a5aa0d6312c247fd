//! What the passes of splats are made of, and how they are recorded: their pipelines, draws and dispatches.

use ash::vk;

use crate::passes::{
    cull::visible::{VISIBLE_ARGUMENTS, VisibleDraws},
    inputs::Inputs,
    pass::Pass,
    pipeline::{
        constants::FrameConstants,
        key::{ColorFormats, GraphicsKey, Layout},
        splat_shaders::{Drawn, Primitive, Stages, clipped},
        variant::Constants,
    },
    place::{Place, arguments},
    plan::draws::{Draw, by_variant},
    predicate::{self, is_predicated},
    recording::{Pipeline, Recording},
};
use crate::{error::Result, scene::Settings, shaders::config::*, vk::Blend};

/// What a splat pass is made of: its shaders, and what it writes.
pub(crate) struct SplatPass {
    pub primitive: Primitive,
    pub stages: Stages,
    pub stages_of_quads: Stages,
    pub color_formats: ColorFormats,
    pub blend: Blend,
    /// The depth test and whether it writes, where there is one.
    pub depth: Option<(vk::CompareOp, bool)>,
    /// Specialization constants beside those of the splats.
    pub constants: Constants,
}

/// Which splats of a chunk a draw is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Portion {
    /// All, as the rasterizer's own primitive.
    All,
    /// Those that are not listed as large, as the same.
    Small,
    /// Those that are, as quads.
    Large,
}

/// The pipelines for one draw: of the rasterizer's own primitive, and quads where there may be large splats.
#[derive(Clone, Copy)]
pub(crate) struct DrawPipelines {
    own: Pipeline,
    quads: Option<Pipeline>,
}

impl SplatPass {
    /// A pass with the shaders of what these settings draw, without color, depth and constants of its own: to be completed.
    pub fn new(settings: &Settings, stages: impl Fn(Drawn) -> Stages) -> Self {
        let primitive = Primitive::of(settings.rasterizer);
        Self {
            primitive,
            stages: stages(Drawn::of(primitive, settings)),
            stages_of_quads: stages(Drawn::of(Primitive::Quad, settings)),
            color_formats: [].into(),
            blend: Blend::Add,
            depth: None,
            constants: [].into(),
        }
    }

    /// What the pipeline is that draws a portion of the splats of a chunk.
    fn key(&self, portion: Portion, draw: &Draw<'_>) -> GraphicsKey {
        let (primitive, stages) = match portion {
            Portion::Large => (Primitive::Quad, self.stages_of_quads),
            Portion::All | Portion::Small => (self.primitive, self.stages),
        };
        let stages = if draw.chunk.clipped { clipped(stages) } else { stages };
        let some_large = (SPEC_SOME_LARGE, u32::from(portion != Portion::All));
        let half_sums = (SPEC_HALF_SUMS, u32::from(draw.half_sums && !self.color_formats.is_empty()));
        let constants = draw.variant.with(self.constants).with([some_large, half_sums]);
        GraphicsKey {
            color_formats: self.color_formats,
            blend: self.blend,
            depth: self.depth,
            ..GraphicsKey::new(stages, Layout::Splat, primitive.topology(), constants)
        }
    }

    /// The pipelines that draw listed splats as quads, one a draw.
    pub fn quad_pipelines<'a>(&self, pass: &Pass<'_, 'a>, inputs: Inputs<'_>) -> Result<&'a [Pipeline]> {
        let key = |draw: &Draw<'_>| self.key(Portion::Large, draw);
        by_variant(pass.arena(), inputs.draws, |draw| pass.graphics(key(draw)))
    }

    /// The pipelines of every draw, in their order.
    pub fn pipelines<'a>(&self, pass: &Pass<'_, 'a>, inputs: Inputs<'_>) -> Result<&'a [DrawPipelines]> {
        let both = |draw: &Draw<'_>| {
            let make = |portion| pass.graphics(self.key(portion, draw));
            let own = if draw.may_be_large { Portion::Small } else { Portion::All };
            let own = make(own)?;
            Ok(DrawPipelines { own, quads: draw.may_be_large.then(|| make(Portion::Large)).transpose()? })
        };
        by_variant(pass.arena(), inputs.draws, both)
    }
}

/// Binds what the fragments of splats or polygons read, and lights: set 2 of their layout, which stays bound while the sets below
/// it change.
pub(crate) fn bind_read(pass: &Recording<'_, '_>) -> Result<()> {
    pass.bind_sets(Layout::Splat, 2, &[pass.set(Place::Read)?])
}

/// Records the draws of all chunks: of a layer, where the layer before is not empty; of visible splats, where those are listed.
pub(crate) fn draw_splats(
    pass: &Recording<'_, '_>,
    inputs: Inputs<'_>,
    pipelines: &[DrawPipelines],
) -> Result<()> {
    let primitive = Primitive::of(inputs.settings.rasterizer);
    let predicated = is_predicated(pass);
    let listed = pass.has(VISIBLE_ARGUMENTS).then(|| VisibleDraws::of(pass)).transpose()?;
    // Chunks without lists share a set of stand-ins.
    let mut unlisted = None;
    for (number, (draw, pipelines)) in inputs.draws.iter().zip(pipelines).enumerate() {
        let large = arguments(number as u32);
        let lists = match (draw.may_be_large && pass.has(large), unlisted) {
            (true, _) => pass.set(Place::Lists(number as u32))?,
            (false, Some(unlisted)) => unlisted,
            (false, None) => *unlisted.insert(pass.set(Place::NoLists)?),
        };
        pass.bind_sets(Layout::Splat, 0, &[draw.chunk.set(), lists])?;
        // Lists of large splats have numbers within their chunks.
        pass.push(Layout::Splat, &FrameConstants { first_record: 0, ..draw.told() })?;
        pass.bind(pipelines.own);
        match listed {
            Some(visible) => visible.draw(pass, number)?,
            None if predicated => predicate::draw_splats(pass, number)?,
            None => pass.draw(primitive.counts(draw.chunk.count)),
        }
        if let Some(quads) = pipelines.quads {
            pass.bind(quads);
            match predicated {
                true => predicate::draw_listed(pass, large)?,
                false => pass.draw_indirect(large, 0)?,
            }
        }
    }
    Ok(())
}
