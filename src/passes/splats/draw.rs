//! What the passes of splats are made of, and how they are recorded: their pipelines, draws and dispatches.

use std::sync::Arc;

use ash::vk;

use crate::passes::{
    cull::gate::Gate,
    cull::lists::ListIds,
    inputs::Inputs,
    pipeline::{
        cache::{GraphicsKey, Layout},
        constants::FrameConstants,
        splat_shaders::{Drawn, Primitive, Stages},
        variant::Constants,
    },
    plan::draws::Draw,
};
use crate::{
    error::Result,
    graph::execute::PassContext,
    scene::Settings,
    shaders::config::*,
    vk::{Blend, GraphicsPipeline},
};

/// What a splat pass is made of: its shaders, and what it writes.
pub(crate) struct SplatPass {
    pub primitive: Primitive,
    pub stages: Stages,
    pub stages_of_quads: Stages,
    pub color_formats: Vec<vk::Format>,
    /// The depth test and whether it writes, where there is one.
    pub depth: Option<(vk::CompareOp, bool)>,
    /// Specialization constants beside those of the splats.
    pub constants: Constants,
}

/// Which splats of a chunk a draw is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Portion {
    /// All, as the rasterizer's own primitive.
    All,
    /// Those that are not listed as large, as the same.
    Small,
    /// Those that are, as quads.
    Large,
}

/// The pipelines for one draw: of the rasterizer's own primitive, and quads where there may be large splats.
pub(crate) struct DrawPipelines {
    own: Arc<GraphicsPipeline>,
    quads: Option<Arc<GraphicsPipeline>>,
}

impl SplatPass {
    /// A pass with the shaders of what these settings draw, without color, depth and constants of its own: to be completed.
    pub fn new(settings: &Settings, stages: impl Fn(Drawn) -> Stages) -> Self {
        let primitive = Primitive::of(settings.rasterizer);
        Self {
            primitive,
            stages: stages(Drawn::of(primitive, settings)),
            stages_of_quads: stages(Drawn::of(Primitive::Quad, settings)),
            color_formats: Vec::new(),
            depth: None,
            constants: Vec::new(),
        }
    }

    /// What the pipeline is that draws a portion of the splats of a variant.
    pub fn key(&self, portion: Portion, variant: &Constants) -> GraphicsKey {
        let (primitive, stages) = match portion {
            Portion::Large => (Primitive::Quad, self.stages_of_quads),
            Portion::All | Portion::Small => (self.primitive, self.stages),
        };
        let some_large = (SPEC_SOME_LARGE, u32::from(portion != Portion::All));
        let constants = [variant.as_slice(), &self.constants, &[some_large]].concat();
        GraphicsKey {
            color_formats: self.color_formats.clone(),
            blend: Blend::Add,
            depth: self.depth,
            ..GraphicsKey::new(stages, Layout::Splat, primitive.topology(), constants)
        }
    }

    /// The pipelines that draw listed splats as quads, one a draw.
    pub fn quad_pipelines(&self, inputs: Inputs<'_>) -> Result<Vec<Arc<GraphicsPipeline>>> {
        let key = |draw: &Draw<'_>| self.key(Portion::Large, &draw.variant);
        inputs.draws.iter().map(|draw| inputs.shaders.graphics(key(draw))).collect()
    }

    /// The pipelines of every draw, in their order.
    pub fn pipelines(&self, inputs: Inputs<'_>) -> Result<Vec<DrawPipelines>> {
        let both = |draw: &Draw<'_>| {
            let make = |portion| inputs.shaders.graphics(self.key(portion, &draw.variant));
            let own = if draw.may_be_large { Portion::Small } else { Portion::All };
            let quads = draw.may_be_large.then(|| make(Portion::Large)).transpose()?;
            Ok(DrawPipelines { own: make(own)?, quads })
        };
        inputs.draws.iter().map(both).collect()
    }
}

/// Records the draws of all chunks; where there is a gate, the device leaves them out while it is closed.
pub(crate) fn draw_splats(
    context: &PassContext<'_>,
    inputs: Inputs<'_>,
    pipelines: &[DrawPipelines],
    lists: &ListIds,
    gate: Option<Gate>,
) -> Result<()> {
    let (device, commands) = (context.device(), context.commands());
    let layout = &inputs.shaders.splat_layout;
    let bind_point = vk::PipelineBindPoint::GRAPHICS;
    let primitive = Primitive::of(inputs.settings.rasterizer);
    // Chunks without lists share a set of stand-ins.
    let unlisted = inputs.descriptors.set(&inputs.shaders.list_set, &[])?;
    for ((number, draw), pipelines) in inputs.draws.iter().enumerate().zip(pipelines) {
        let list = match lists.descriptors(context, number)? {
            given if given.is_empty() => unlisted,
            given => inputs.descriptors.set(&inputs.shaders.list_set, &given)?,
        };
        let sets = [draw.chunk.set(), list];
        let arguments = lists.large(number).map(|large| context.buffer(large.arguments)).transpose()?;
        // SAFETY: inside of rendering, with pipelines, sets and push constants of one layout; the graph's barriers
        // order what the draws read.
        unsafe {
            device.cmd_bind_descriptor_sets(commands, bind_point, layout.raw(), 0, &sets, &[]);
            // Lists of large splats have numbers within their chunks.
            let constants = FrameConstants { first_record: 0, ..draw.constants };
            let constants = bytemuck::bytes_of(&constants);
            device.cmd_push_constants(commands, layout.raw(), layout.push_stages(), 0, constants);
            device.cmd_bind_pipeline(commands, bind_point, pipelines.own.raw());
            match (gate, &lists.visible) {
                (Some(gate), _) => gate.draw_splats(context, number)?,
                (None, Some(visible)) => visible.draw_points(context, number)?,
                (None, None) => {
                    let [vertices, instances] = primitive.counts(draw.chunk.count);
                    device.cmd_draw(commands, vertices, instances, 0, 0);
                }
            }
            if let (Some(quads), Some(arguments)) = (&pipelines.quads, arguments) {
                device.cmd_bind_pipeline(commands, bind_point, quads.raw());
                match gate {
                    Some(gate) => gate.draw_listed(context, arguments)?,
                    None => device.cmd_draw_indirect(commands, arguments, 0, 1, 16),
                }
            }
        }
    }
    Ok(())
}
