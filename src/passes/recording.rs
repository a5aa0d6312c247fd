//! What the body of a pass records with: the sets of what the pass named, its pipelines, draws and dispatches.

use std::cell::Cell;

use ash::vk;

use crate::passes::{
    pipeline::{cache::Shaders, key::Layout, last_sets::LastSets},
    place::{At, PLANES_BYTES, Place, Planes, Tints},
};
use crate::{
    error::{ErrorKind, Result},
    graph::{ResourceId, execute::PassContext},
    shaders::config::{
        BIND_LIST_PLANES, BIND_PLANES, BIND_READ_PLANES, BIND_READ_TINTS, BIND_TINTS, MOST_GROUPS_IN_ROW,
    },
    vk::{Descriptor, DescriptorPool},
};

/// A pipeline of a pass, with the layout that it was made for; a null handle in a frame that is only listed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pipeline {
    pub raw: ash::vk::Pipeline,
    pub layout: Layout,
}

/// A buffer of arguments that a pass has declared.
#[derive(Clone, Copy)]
pub(crate) struct Arguments(vk::Buffer);

/// A pass while it is recorded.
///
/// What records into its command buffer is called by bodies alone, which bind what their pipelines need before they draw or dispatch:
/// the contract of each `unsafe` block below. The graph's barriers order what the pass named, and nothing else can be reached.
pub(crate) struct Recording<'c, 'a> {
    pub context: &'c PassContext<'c>,
    pub shaders: &'a Shaders,
    pub descriptors: &'a DescriptorPool,
    /// In order.
    pub bound: &'c [(At, ResourceId)],
    /// The planes that cut what is seen.
    pub planes: Planes,
    /// The tints of chunks.
    pub tints: Option<Tints>,
    /// The pipeline that was bound last: chunks in a row often share one.
    pub pipeline: Cell<vk::Pipeline>,
    /// The sets that were bound last.
    pub sets: LastSets,
}

impl Recording<'_, '_> {
    /// The device.
    pub fn device(&self) -> &ash::Device {
        self.context.device()
    }

    /// The command buffer, recording.
    pub fn commands(&self) -> vk::CommandBuffer {
        self.context.commands()
    }

    /// A new set of all that the pass found in a place.
    pub fn set(&self, place: Place) -> Result<vk::DescriptorSet> {
        self.set_with(place, &[])
    }

    /// The same with descriptors of what is not the frame's own.
    pub fn set_with(&self, place: Place, others: &[(u32, Descriptor)]) -> Result<vk::DescriptorSet> {
        let first = self.bound.partition_point(|(at, _)| at.place < place);
        let own = self.bound[first..].iter().take_while(|(at, _)| at.place == place);
        let mut given = self.context.arena().growing();
        given.reserve(own.clone().count() + others.len() + 2);
        given.extend_from_slice_copy(others);
        if self.planes.count > 0 {
            let binding = match place {
                Place::Read => Some(BIND_READ_PLANES),
                Place::Tiles(_) => Some(BIND_PLANES),
                Place::Lists(_) | Place::NoLists => Some(BIND_LIST_PLANES),
                _ => None,
            };
            let buffer = Descriptor::Buffer(self.planes.buffer, PLANES_BYTES);
            given.extend(binding.map(|binding| (binding, buffer)));
        }
        if let Some(Tints { buffer, bytes }) = self.tints {
            let binding = match place {
                Place::Read => Some(BIND_READ_TINTS),
                // Where layers have what they go on from, records are made by no pass.
                Place::Tiles(_) if !own.clone().any(|(at, _)| at.binding == BIND_TINTS) => Some(BIND_TINTS),
                _ => None,
            };
            given.extend(binding.map(|binding| (binding, Descriptor::Buffer(buffer, bytes))));
        }
        for (at, id) in own {
            given.push((at.binding, self.context.descriptor(*id)?));
        }
        let layout = match place {
            Place::Read => &self.shaders.read_set,
            Place::Sums => &self.shaders.sums_set,
            Place::Cells => &self.shaders.cells_set,
            Place::Tiles(_) => &self.shaders.tiles()?.set,
            Place::Lists(_) | Place::NoLists => &self.shaders.list_set,
            _ => {
                let (pass, reason) = (self.context.name().to_owned(), "is no set of descriptors".to_owned());
                return Err(ErrorKind::Graph { pass, resource: format!("{place:?}"), reason }.into());
            }
        };
        // SAFETY: what the graph gives to the pass, as the pass has declared it; all of it lives as long as the frame.
        unsafe { self.descriptors.set(layout, &given) }
    }

    /// Whether the pass found anything there.
    pub fn has(&self, at: At) -> bool {
        self.find(at).is_some()
    }

    /// The buffer that the pass found there.
    pub fn buffer(&self, at: At) -> Result<vk::Buffer> {
        self.context.buffer(self.named(at)?)
    }

    /// The image that the pass found there, and its layout.
    pub fn image(&self, at: At) -> Result<(vk::Image, vk::ImageLayout)> {
        let id = self.named(at)?;
        Ok((self.context.image(id)?.0, self.context.layout(id)))
    }

    fn find(&self, at: At) -> Option<ResourceId> {
        self.bound.binary_search_by_key(&at, |(other, _)| *other).ok().map(|found| self.bound[found].1)
    }

    fn named(&self, at: At) -> Result<ResourceId> {
        self.find(at).ok_or_else(|| {
            let (pass, reason) =
                (self.context.name().to_owned(), "is used by the pass but not declared".to_owned());
            ErrorKind::Graph { pass, resource: format!("{at:?}"), reason }.into()
        })
    }

    /// Binds a pipeline, where it is not bound already.
    pub fn bind(&self, pipeline: Pipeline) {
        if self.pipeline.replace(pipeline.raw) == pipeline.raw {
            return;
        }
        self.context.runs(pipeline.raw);
        let point = pipeline.layout.bind_point();
        // SAFETY: the pipeline is alive as long as the shaders; its layout has this bind point.
        unsafe { self.device().cmd_bind_pipeline(self.commands(), point, pipeline.raw) };
    }

    /// Binds sets of a layout from the one with this number on, where they are not those that were bound last.
    pub fn bind_sets(&self, layout: Layout, first: u32, sets: &[vk::DescriptorSet]) -> Result<()> {
        if self.sets.have(layout, first, sets) {
            return Ok(());
        }
        let (point, layout) = (layout.bind_point(), self.shaders.layout(layout)?.raw());
        // SAFETY: the sets have the layouts that the pipeline layout has from `first` on.
        unsafe { self.device().cmd_bind_descriptor_sets(self.commands(), point, layout, first, sets, &[]) };
        Ok(())
    }

    /// Sets the push constants of a layout.
    pub fn push<T: bytemuck::Pod>(&self, layout: Layout, constants: &T) -> Result<()> {
        let layout = self.shaders.layout(layout)?;
        let (stages, bytes) = (layout.push_stages(), bytemuck::bytes_of(constants));
        // SAFETY: the layout's constants are these.
        unsafe { self.device().cmd_push_constants(self.commands(), layout.raw(), stages, 0, bytes) };
        Ok(())
    }

    /// Writes these bytes, a multiple of 4, to the begin of the buffer that the pass found there.
    pub fn update_buffer(&self, at: At, bytes: &[u8]) -> Result<()> {
        /// What one command takes at most.
        const MOST_BYTES: usize = 65_536;
        let buffer = self.buffer(at)?;
        for (piece, offset) in bytes.chunks(MOST_BYTES).zip((0..).step_by(MOST_BYTES)) {
            // SAFETY: outside of rendering; the buffer has room; a multiple of 4 and not above 65 536 bytes.
            unsafe { self.device().cmd_update_buffer(self.commands(), buffer, offset, piece) };
        }
        Ok(())
    }

    /// Dispatches so many workgroups in a row, and rows.
    pub fn dispatch(&self, [x, y]: [u32; 2]) {
        // SAFETY: a pass of compute with all bound that its pipeline needs.
        unsafe { self.device().cmd_dispatch(self.commands(), x, y, 1) };
    }

    /// Dispatches as many workgroups as the arguments say at an offset in bytes.
    pub fn dispatch_indirect(&self, arguments: At, offset: u64) -> Result<()> {
        self.dispatch_by(self.arguments(arguments)?, offset);
        Ok(())
    }

    /// The arguments that the pass found there: looked for once by whoever dispatches for each of many chunks.
    pub fn arguments(&self, at: At) -> Result<Arguments> {
        self.buffer(at).map(Arguments)
    }

    /// The same as [`Self::dispatch_indirect`], by arguments that were looked for.
    pub fn dispatch_by(&self, Arguments(buffer): Arguments, offset: u64) {
        // SAFETY: as in `dispatch`; the arguments were declared to be read, and are within the buffer.
        unsafe { self.device().cmd_dispatch_indirect(self.commands(), buffer, offset) };
    }

    /// Draws so many vertices, so often.
    pub fn draw(&self, [vertices, instances]: [u32; 2]) {
        // SAFETY: inside of rendering with all bound that the pipeline needs.
        unsafe { self.device().cmd_draw(self.commands(), vertices, instances, 0, 0) };
    }

    /// Draws what a `VkDrawIndirectCommand` says at an offset in bytes.
    pub fn draw_indirect(&self, arguments: At, offset: u64) -> Result<()> {
        let buffer = self.buffer(arguments)?;
        // SAFETY: as in `draw`; the arguments were declared to be read, and are within the buffer.
        unsafe { self.device().cmd_draw_indirect(self.commands(), buffer, offset, 1, 16) };
        Ok(())
    }
}

impl Layout {
    /// Whether pipelines of it draw or dispatch.
    fn bind_point(self) -> vk::PipelineBindPoint {
        match self {
            Self::Splat | Self::Finalize | Self::Host | Self::TileQuads => vk::PipelineBindPoint::GRAPHICS,
            Self::List | Self::DepthCells | Self::Record | Self::Tile => vk::PipelineBindPoint::COMPUTE,
        }
    }
}

/// Workgroups along a row, and rows, as in `glsl/inc/groups.glsl`.
pub(crate) fn rows_of(groups: u32) -> [u32; 2] {
    let rows = groups.div_ceil(MOST_GROUPS_IN_ROW);
    [groups.div_ceil(rows.max(1)), rows]
}

#[cfg(test)]
mod tests {
    use super::rows_of;

    #[test]
    fn rows_hold_all_workgroups_and_few_more() {
        for groups in [0, 1, 32_768, 32_769, 43_690, 65_536, 4_194_304, 1 << 30] {
            let [x, y] = rows_of(groups);
            assert!(x <= 32_768 && y <= 65_535, "{groups}: {x} {y}");
            assert!((groups..groups + y.max(1)).contains(&(x * y)), "{groups}: {x} {y}");
        }
    }
}
