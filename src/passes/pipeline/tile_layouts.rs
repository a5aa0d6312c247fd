//! The layouts of drawing by tiles.

use std::sync::Arc;

use ash::vk;

use crate::passes::pipeline::constants::{FinalizeConstants, FrameConstants, TileConstants};
use crate::{
    error::Result,
    shaders::config::*,
    vk::{Binding, Device, PipelineLayout, SetLayout, StandIns},
};

/// Storage buffers in the layout of the pass that makes records.
pub const STORAGE_BUFFERS: u32 = 20;

/// A set, and the layouts that have it.
pub(crate) struct TileLayouts {
    /// Set 1 of the pass that makes records and of quads of tiles, set 0 of all else with tiles: `BIND_*` of
    /// `glsl/inc/config.glsl`.
    pub set: SetLayout,
    pub record: PipelineLayout,
    pub tile: PipelineLayout,
    pub quads: PipelineLayout,
}

/// The last binding of the set.
const LAST_BINDING: u32 = BIND_PLANES;

/// The type of a binding.
fn kind_of(binding: u32) -> vk::DescriptorType {
    match binding {
        BIND_COLORS | BIND_NORMALS | BIND_VISIBLE_DEPTH => vk::DescriptorType::STORAGE_IMAGE,
        BIND_DEPTH_BEFORE | BIND_POLYGON_DEPTH | BIND_COLORS_BEFORE | BIND_NORMALS_BEFORE
        | BIND_VISIBLE_BEFORE => vk::DescriptorType::SAMPLED_IMAGE,
        BIND_LIGHTS | BIND_PLANES => vk::DescriptorType::UNIFORM_BUFFER,
        BIND_RECORD_TEXELS..=BIND_RECT_TEXELS | BIND_CLIP_TEXELS => vk::DescriptorType::UNIFORM_TEXEL_BUFFER,
        _ => vk::DescriptorType::STORAGE_BUFFER,
    }
}

impl TileLayouts {
    pub fn new(
        device: &Device,
        splat_set: &SetLayout,
        sums_set: &SetLayout,
        stand_ins: &Arc<StandIns>,
    ) -> Result<Self> {
        let (vertex, fragment, compute) =
            (vk::ShaderStageFlags::VERTEX, vk::ShaderStageFlags::FRAGMENT, vk::ShaderStageFlags::COMPUTE);
        let binding = |number| Binding {
            kind: kind_of(number),
            stages: if number == BIND_RUNS { vertex | compute } else { compute },
        };
        let bindings: Vec<_> = (0..=LAST_BINDING).map(binding).collect();
        let integers = [BIND_RECORD_TEXELS + 3, BIND_ENTRY_TEXELS, BIND_RECT_TEXELS];
        let set = SetLayout::new(device, "tiles", &bindings)?.with_stand_ins(stand_ins, &integers);
        let record = PipelineLayout::new(
            device,
            "records",
            &[splat_set, &set],
            size_of::<FrameConstants>() as u32,
            compute,
        )?;
        let tile = PipelineLayout::new(device, "tiles", &[&set], size_of::<TileConstants>() as u32, compute)?;
        let quads = PipelineLayout::new(
            device,
            "quads of tiles",
            &[sums_set, &set],
            size_of::<FinalizeConstants>() as u32,
            vertex | fragment,
        )?;
        Ok(Self { set, record, tile, quads })
    }
}
