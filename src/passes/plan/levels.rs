//! Levels of detail as a camera sees them: which blocks have something to draw, and what shaders are told (`glsl/inc/levels.glsl`).

use glam::DVec3;

use crate::{
    prepare::{BallBounds, BlockLevels, ChunkLevels},
    scene::{Camera, Settings},
    shaders::config::LEVEL_WORDS,
};

/// What a device finds in f32 of a size may differ from this file's f64 by so much of it.
const RESERVE: f64 = 1e-5;

/// How a camera sees the levels of a chunk.
#[derive(Clone, Copy, Debug)]
pub struct LevelView {
    /// The eye, in the space of levels.
    eye: DVec3,
    /// τ over the focal length: what a size of τ is at distance 1; under parallel rays what it is.
    share: f64,
    /// Up to so many times τ nodes are drawn beside those below them; 1 where they do not blend.
    blended_size: f64,
    /// No size is larger than at this distance.
    near: f64,
    is_orthographic: bool,
    /// The chunk holds nodes.
    pub nodes: bool,
    /// What the image of a length does not exceed, in pixels, that would be 1 of τ in the middle of the picture.
    stretched_px: f64,
}

/// What of a block is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OfBlock {
    /// Nothing.
    None,
    /// Some splats, as far as is known.
    Some,
    /// All splats.
    All,
}

impl LevelView {
    /// That of a camera; `None` where the scene itself is drawn.
    pub fn new(levels: ChunkLevels, transparent: bool, camera: &Camera, settings: &Settings) -> Option<Self> {
        let tau_px = settings.tau_px();
        let blended_size = if transparent { 1.0 } else { settings.blended_size() };
        let space = levels.space;
        let focal_px = camera.focal_px(settings.size_px[1]);
        let is_orthographic = camera.is_orthographic();
        let unit = if is_orthographic { space.scale } else { 1.0 };
        // A node that spreads by τ at a distance d spreads by d τ / focal, and its ellipse is so many times as long. Its image is longest off
        // the axis, and where it is nearest to the eye plane.
        let middle_px = camera.middle_px(settings.size_px);
        let most_px =
            (0..2).map(|i| middle_px[i].abs().max((f64::from(settings.size_px[i]) - middle_px[i]).abs()));
        let x = most_px.fold(0.0, f64::max) / focal_px;
        let stretch = if is_orthographic { 1.0 } else { (1.0 + x) * (1.0 + 2.0 * x * x).sqrt() };
        (tau_px > 0.0).then_some(Self {
            eye: (camera.eye - space.origin) * space.scale,
            share: tau_px / focal_px * unit,
            blended_size,
            near: (camera.near() * space.scale).max(1e-30),
            is_orthographic,
            nodes: levels.nodes,
            stretched_px: tau_px * stretch,
        })
    }

    /// Whether nodes blend with those below them.
    pub fn blends(&self) -> bool {
        self.blended_size > 1.0
    }

    /// The same view, in which nodes take the place of those below them at once.
    pub fn with_hard_steps(self) -> Self {
        Self { blended_size: 1.0, ..self }
    }

    fn share_of_blended(&self) -> f64 {
        self.share * self.blended_size
    }

    /// The words of a shader's view.
    pub fn words(&self) -> [u32; LEVEL_WORDS as usize] {
        let [x, y, z] = self.eye.as_vec3().to_array();
        let [share, of_blended] = [self.share, self.share_of_blended()].map(|share| share as f32);
        let weight_of_share = if self.blends() { (of_blended - share).recip() } else { 0.0 };
        [x, y, z, share, self.near as f32, of_blended, weight_of_share, 0.0].map(f32::to_bits)
    }

    /// What no box of a node of a block exceeds that is drawn, in pixels, with this filter; infinite of the object's own splats.
    pub fn largest_box_px(&self, block: &BlockLevels, filter_px: f64) -> f64 {
        // Three pixels for rounding, as in `math/size.rs`.
        let px = 2.0 * block.longest * self.stretched_px * self.blended_size;
        if self.nodes { 1.01 * px.hypot(4.0 * filter_px) + 3.0 } else { f64::INFINITY }
    }

    /// What of a block is drawn.
    pub fn of(&self, block: &BlockLevels) -> OfBlock {
        let distance = self.eye.distance(block.center);
        // Between which the largest spreads lie that are small, of balls within bounds.
        let at = |distance: f64| if self.is_orthographic { 1.0 } else { distance.max(self.near) };
        let least = |balls: &BallBounds, share: f64| share * at(distance - balls.reach) * (1.0 - RESERVE);
        let most = |balls: &BallBounds, share: f64| share * at(distance + balls.far) * (1.0 + RESERVE);
        let (own, parent) = (&block.own, &block.parent);
        let no_parent_is_large = parent.spreads[1] <= least(parent, self.share);
        let no_own_is_small = self.nodes && own.spreads[0] > most(own, self.share_of_blended());
        if no_parent_is_large || no_own_is_small {
            return OfBlock::None;
        }
        let all_parents_are_large = parent.spreads[0] > most(parent, self.share);
        let all_own_are_small = !self.nodes || own.spreads[1] <= least(own, self.share_of_blended());
        if all_parents_are_large && all_own_are_small { OfBlock::All } else { OfBlock::Some }
    }
}
