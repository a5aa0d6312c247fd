//! The layouts of drawing by tiles.

use std::sync::Arc;

use ash::vk;

use super::{
    super::constants::{FinalizeConstants, FrameConstants, TileConstants},
    ENTRY_TEXELS, RECORD_TEXELS, SPAN_TEXELS,
};
use crate::{
    error::Result,
    vk::{Binding, Device, PipelineLayout, SetLayout, StandIns},
};

/// A set, and the layouts that have it.
pub(in super::super) struct TileLayouts {
    /// Set 1 of the pass that makes records and of quads of tiles, set 0 of all else with tiles: see `passes/tiles/mod.rs`.
    pub set: SetLayout,
    pub record: PipelineLayout,
    pub tile: PipelineLayout,
    pub quads: PipelineLayout,
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
        let of = |kind, stages| Binding { kind, stages };
        let words = of(vk::DescriptorType::STORAGE_BUFFER, compute);
        let sums = of(vk::DescriptorType::STORAGE_IMAGE, compute);
        let fetched = of(vk::DescriptorType::SAMPLED_IMAGE, compute);
        let lights = of(vk::DescriptorType::UNIFORM_BUFFER, compute);
        let mut in_tiles = vec![words; 11];
        in_tiles.extend([sums, sums, sums, fetched, fetched, lights, sums, words]);
        in_tiles.push(of(vk::DescriptorType::STORAGE_BUFFER, vertex | compute));
        in_tiles.extend([words, words, words]);
        in_tiles.extend([of(vk::DescriptorType::UNIFORM_TEXEL_BUFFER, compute); 6]);
        debug_assert_eq!(in_tiles.len() - 1, SPAN_TEXELS as usize);
        let integers = [RECORD_TEXELS + 3, ENTRY_TEXELS, SPAN_TEXELS];
        let set = SetLayout::new(device, "tiles", &in_tiles)?.with_stand_ins(stand_ins, &integers);
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
