//! One compute pass over tiles: what is bound, its pipeline, and how it is dispatched.

use ash::vk;

use crate::passes::{
    inputs::Inputs,
    pipeline::{
        cache::{ComputeKey, Layout},
        constants::TileConstants,
        variant::Constants,
    },
    plan::tiles::TilePlan,
};
use crate::{
    error::Result,
    graph::{
        Access, Buffer, Graph, Handle, PassBuilder, ResourceId, Start,
        execute::{Body, PassContext},
    },
    shaders::{Shader, config::*},
    vk::{ComputePipeline, PipelineLayout},
};

/// A pass in the making. Each resource is named once, with its binding in the set of tiles and its access.
pub(crate) struct TilePass<'g, 'a> {
    declared: PassBuilder<'g, Body<'a>>,
    bound: Vec<(u32, ResourceId)>,
}

/// A pipeline, and the plan that its push constants are of.
pub(crate) type Pipeline<'p> = (&'p TilePlan, ComputeKey);

impl<'g, 'a> TilePass<'g, 'a> {
    pub fn new(graph: &'g mut Graph<Body<'a>>, name: &str) -> Self {
        Self { declared: graph.pass(name), bound: Vec::new() }
    }

    pub fn read<K>(self, binding: u32, handle: &Handle<K>, access: Access) -> Self {
        self.bind(binding, handle).declare(|pass| pass.read(handle, access))
    }

    /// Reads what there may be.
    pub fn read_if<K>(self, binding: u32, handle: Option<&Handle<K>>, access: Access) -> Self {
        match handle {
            Some(handle) => self.read(binding, handle, access),
            None => self,
        }
    }

    pub fn write<K>(self, binding: u32, handle: &mut Handle<K>, access: Access, start: Start) -> Self {
        self.bind(binding, handle).declare(|pass| pass.write(handle, access, start))
    }

    /// Binds what the pass declares elsewhere.
    pub fn bind<K>(mut self, binding: u32, handle: &Handle<K>) -> Self {
        self.bound.push((binding, handle.id()));
        self
    }

    /// Declares what has no binding.
    pub fn declare(
        self,
        declare: impl FnOnce(PassBuilder<'g, Body<'a>>) -> PassBuilder<'g, Body<'a>>,
    ) -> Self {
        Self { declared: declare(self.declared), ..self }
    }

    /// Declares the pass; `body` records it with a set of all that is bound.
    pub fn finish_with_set(
        self,
        inputs: Inputs<'a>,
        body: impl FnOnce(&PassContext<'_>, vk::DescriptorSet) -> Result<()> + 'a,
    ) {
        let bound = self.bound;
        self.declared.finish(Box::new(move |context| {
            let given = bound.iter().map(|(binding, id)| Ok((*binding, context.descriptor(*id)?)));
            let given = given.collect::<Result<Vec<_>>>()?;
            body(context, inputs.descriptors.set(&inputs.shaders.tiles()?.set, &given)?)
        }));
    }

    /// Declares the pass of one pipeline; `body` records its dispatches.
    pub fn finish(
        self,
        inputs: Inputs<'a>,
        (plan, key): Pipeline<'_>,
        body: impl FnOnce(&TileDispatch<'_, '_>) -> Result<()> + 'a,
    ) -> Result<()> {
        let pipeline = inputs.shaders.compute(key)?;
        let constants = crate::passes::tiles::constants(inputs, plan);
        self.finish_with_set(inputs, move |context, set| {
            let pass = TileDispatch { context, layout: &inputs.shaders.tiles()?.tile, constants };
            pass.bind(&pipeline, set);
            body(&pass)
        });
        Ok(())
    }

    /// The same of a pass with one dispatch, of as many workgroups as the word at `arguments` and those after it say.
    pub fn finish_indirect(
        self,
        inputs: Inputs<'a>,
        pipeline: Pipeline<'_>,
        (arguments, first_word): (&Handle<Buffer>, u32),
    ) -> Result<()> {
        let arguments = arguments.id();
        self.finish(inputs, pipeline, move |pass| pass.indirect(pass.constants, arguments, first_word))
    }
}

/// The pipeline of a shader in the layout of tiles.
pub(crate) fn key(shader: &'static Shader, constants: Constants) -> ComputeKey {
    ComputeKey { shader, layout: Layout::Tile, constants }
}

/// A pass over tiles while it is recorded, with all bound.
pub(crate) struct TileDispatch<'c, 'a> {
    context: &'c PassContext<'c>,
    layout: &'a PipelineLayout,
    pub constants: TileConstants,
}

impl TileDispatch<'_, '_> {
    fn bind(&self, pipeline: &ComputePipeline, set: vk::DescriptorSet) {
        let bind_point = vk::PipelineBindPoint::COMPUTE;
        let (device, commands) = (self.context.device(), self.context.commands());
        // SAFETY: pipeline and set have one layout; the graph's barriers order what is read and written.
        unsafe {
            device.cmd_bind_pipeline(commands, bind_point, pipeline.raw());
            device.cmd_bind_descriptor_sets(commands, bind_point, self.layout.raw(), 0, &[set], &[]);
        }
    }

    fn push(&self, constants: TileConstants) {
        let (commands, layout) = (self.context.commands(), self.layout);
        let bytes = bytemuck::bytes_of(&constants);
        // SAFETY: the layout's constants are these.
        unsafe {
            self.context.device().cmd_push_constants(commands, layout.raw(), layout.push_stages(), 0, bytes);
        }
    }

    /// Records a dispatch of so many workgroups.
    pub fn groups(&self, constants: TileConstants, groups: u32) {
        self.push(constants);
        let [x, y] = rows_of(groups);
        // SAFETY: all is bound that the pipeline needs.
        unsafe { self.context.device().cmd_dispatch(self.context.commands(), x, y, 1) };
    }

    /// Records a dispatch of as many as a buffer says from a word on.
    pub fn indirect(&self, constants: TileConstants, arguments: ResourceId, first_word: u32) -> Result<()> {
        self.push(constants);
        let (commands, arguments) = (self.context.commands(), self.context.buffer(arguments)?);
        // SAFETY: as in `groups`; the arguments were declared to be read, and are within the buffer.
        unsafe {
            self.context.device().cmd_dispatch_indirect(commands, arguments, 4 * u64::from(first_word));
        }
        Ok(())
    }

    /// Records such dispatches, each behind the one before, which works on the same memory.
    pub fn indirect_in_turn(
        &self,
        dispatches: impl IntoIterator<Item = TileConstants>,
        arguments: ResourceId,
        first_word: u32,
    ) -> Result<()> {
        for (number, constants) in dispatches.into_iter().enumerate() {
            if number > 0 {
                self.wait();
            }
            self.indirect(constants, arguments, first_word)?;
        }
        Ok(())
    }

    /// Orders dispatches behind those before them in the pass, which work on the same memory.
    pub fn wait(&self) {
        let reads = vk::AccessFlags2::SHADER_STORAGE_READ | vk::AccessFlags2::SHADER_SAMPLED_READ;
        let writes = vk::AccessFlags2::SHADER_STORAGE_WRITE;
        let compute = vk::PipelineStageFlags2::COMPUTE_SHADER;
        let barriers = [vk::MemoryBarrier2::default()
            .src_stage_mask(compute)
            .src_access_mask(writes)
            .dst_stage_mask(compute)
            .dst_access_mask(reads | writes)];
        let info = vk::DependencyInfo::default().memory_barriers(&barriers);
        // SAFETY: outside of rendering, in a compute pass.
        unsafe { self.context.device().cmd_pipeline_barrier2(self.context.commands(), &info) };
    }
}

/// Workgroups along a row, and rows, as in `glsl/inc/groups.glsl`.
pub(crate) fn rows_of(groups: u32) -> [u32; 2] {
    let rows = groups.div_ceil(MOST_GROUPS_IN_ROW);
    [groups.div_ceil(rows.max(1)), rows]
}

#[cfg(test)]
mod tests {
    use crate::passes::tiles::pass::rows_of;

    #[test]
    fn rows_hold_all_workgroups_and_few_more() {
        for groups in [0, 1, 32_768, 32_769, 43_690, 65_536, 4_194_304, 1 << 30] {
            let [x, y] = rows_of(groups);
            assert!(x <= 32_768 && y <= 65_535, "{groups}: {x} {y}");
            assert!((groups..groups + y.max(1)).contains(&(x * y)), "{groups}: {x} {y}");
        }
    }
}
