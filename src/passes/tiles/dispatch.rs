//! Passes of compute over tiles: their pipeline, and how it is dispatched.

use ash::vk;

use crate::passes::{
    inputs::Inputs,
    pass::Pass,
    pipeline::{
        constants::TileConstants,
        key::{ComputeKey, Layout},
        variant::Constants,
    },
    place::{Place, arguments},
    plan::tiles::TilePlan,
    recording::{Pipeline, Recording, rows_of},
};
use crate::{
    error::Result,
    scene::Epsilon,
    shaders::{Shader, config::*},
};

/// Of a pipeline that cuts splats, by curves or planes.
pub(crate) const CUTS: (u32, u32) = (SPEC_CUTS, 1);

/// Of one that cuts them by curves.
pub(crate) const CLIPS: (u32, u32) = (SPEC_CLIPS, 1);

/// The pipeline of a shader in the layout of tiles.
pub(crate) fn key(shader: &'static Shader, constants: Constants) -> ComputeKey {
    ComputeKey { shader, layout: Layout::Tile, constants }
}

/// Declares a pass over the tiles of a plan; `body` records its dispatches. Where the pipeline cuts splats there is one more,
/// which does not, for tiles of which no splat is cut.
pub(crate) fn finish<'a>(
    pass: Pass<'_, 'a>,
    inputs: Inputs<'a>,
    (plan, key): (&TilePlan, ComputeKey),
    body: impl Fn(&TileDispatch<'_, '_>) -> Result<()> + 'a,
) -> Result<()> {
    let uncut = match key.constants.contains(&CUTS) {
        true => {
            let mut key = key.clone();
            key.constants.retain(|constant| ![CUTS, CLIPS].contains(constant));
            Some(pass.compute(key)?)
        }
        false => None,
    };
    let (pipeline, constants) = (pass.compute(key)?, constants(inputs, plan));
    pass.finish(move |pass| {
        pass.bind(pipeline);
        pass.bind_sets(Layout::Tile, 0, &[pass.set(Place::Tiles(0))?])?;
        body(&TileDispatch { pass, constants, pipeline, uncut })
    });
    Ok(())
}

/// Declares a pass of one dispatch, of as many workgroups as the word of the lists' arguments and those after it say.
pub(crate) fn finish_indirect<'a>(
    pass: Pass<'_, 'a>,
    inputs: Inputs<'a>,
    pipeline: (&TilePlan, ComputeKey),
    first_word: u32,
) -> Result<()> {
    finish(pass, inputs, pipeline, move |pass| pass.indirect(pass.constants, first_word))
}

/// The same of one dispatch over whole tiles.
pub(crate) fn finish_whole<'a>(
    pass: Pass<'_, 'a>,
    inputs: Inputs<'a>,
    pipeline: (&TilePlan, ComputeKey),
) -> Result<()> {
    finish(pass, inputs, pipeline, |pass| pass.whole_tiles(pass.constants))
}

/// A pass over tiles while it is recorded, with all bound.
pub(crate) struct TileDispatch<'c, 'a> {
    pass: &'c Recording<'c, 'a>,
    pub constants: TileConstants,
    pipeline: Pipeline,
    uncut: Option<Pipeline>,
}

impl TileDispatch<'_, '_> {
    /// Records a dispatch of so many workgroups.
    pub fn groups(&self, constants: TileConstants, groups: u32) -> Result<()> {
        self.pass.push(Layout::Tile, &constants)?;
        self.pass.dispatch(rows_of(groups));
        Ok(())
    }

    /// Records a dispatch of as many as the lists' arguments say from a word on.
    pub fn indirect(&self, constants: TileConstants, first_word: u32) -> Result<()> {
        self.pass.push(Layout::Tile, &constants)?;
        self.pass.dispatch_indirect(arguments(0), 4 * u64::from(first_word))
    }

    /// Records a dispatch over all tiles with splats that are not too many; where some are cut, one over those without, and one over
    /// the others.
    pub fn whole_tiles(&self, constants: TileConstants) -> Result<()> {
        let Some(uncut) = self.uncut else {
            return self.indirect(constants, ARGUMENTS_TILES);
        };
        self.pass.bind(uncut);
        self.indirect(constants, ARGUMENTS_TILES)?;
        self.wait();
        self.pass.bind(self.pipeline);
        self.indirect(constants, ARGUMENTS_CLIPPED)
    }

    /// Records such dispatches, each behind the one before, which works on the same memory.
    pub fn indirect_in_turn(
        &self,
        dispatches: impl IntoIterator<Item = TileConstants>,
        first_word: u32,
    ) -> Result<()> {
        for (number, constants) in dispatches.into_iter().enumerate() {
            if number > 0 {
                self.wait();
            }
            self.indirect(constants, first_word)?;
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
        unsafe { self.pass.device().cmd_pipeline_barrier2(self.pass.commands(), &info) };
    }
}

fn constants(inputs: Inputs<'_>, plan: &TilePlan) -> TileConstants {
    let [width, height] = inputs.settings.size_px;
    TileConstants {
        half_size_px: [0.5 * width as f32, 0.5 * height as f32],
        middle_px: inputs.camera.middle_px(inputs.settings.size_px).map(|at| at as f32),
        tiles_x: plan.tiles_x,
        first_tile: plan.first_tile(),
        tile_count: plan.tile_count,
        bin_count: plan.bin_count(),
        count_bins: plan.count_bins(),
        record_count: plan.record_count,
        segments: plan.segments,
        segment_length: plan.segment_length,
        pieces: plan.pieces,
        round_first: 0,
        round_length: plan.round_length,
        part: WHOLE_TILES,
        focal_px: inputs.camera.focal_px(height) as f32,
        surfaces: 0,
        blends_rest: 0,
        step: 0,
        ends: 0,
        polygon_reach: polygon_reach(inputs),
    }
}

/// ε of a slanted splat is as if its surface bent away within the filter's reach, hundreds of radii where it is seen edge-on: toward a polygon
/// it is no more than the splat's own image is large, or what was behind would be seen through. What has a length is not lengthened. Where there is no polygon, nothing is.
fn polygon_reach(inputs: Inputs<'_>) -> f32 {
    if inputs.meshes.is_empty() {
        return 0.0;
    }
    let epsilons = inputs.draws.iter().map(|draw| draw.chunk.epsilon.unwrap_or(inputs.settings.epsilon));
    let radii = epsilons.map(|epsilon| match epsilon {
        Epsilon::Auto => 1.0,
        Epsilon::Radii(radii) => radii.max(1.0),
        Epsilon::Length(_) => f64::INFINITY,
    });
    let depth = if inputs.camera.is_orthographic() { inputs.range.end } else { 1.0 };
    let px = radii.fold(0.0, f64::max) / (inputs.camera.focal_px(inputs.settings.size_px[1]) * depth);
    px.min(f64::from(f32::MAX)) as f32
}
