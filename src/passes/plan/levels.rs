//! Levels of detail as a camera sees them: which blocks have something to draw, and what shaders are told (`glsl/inc/levels.glsl`).

use std::ops::Range;

use glam::DVec3;

use crate::{
    prepare::{BallBounds, BlockLevels, BlockTree, CHILDREN, ChunkLevels, LevelBounds, LevelPart},
    scene::{Camera, Settings},
    shaders::config::{LEVEL_WORDS, LEVELS_LEAVES, LEVELS_NODES, LEVELS_OF_CELLS},
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
    /// What the chunk holds.
    pub part: LevelPart,
    /// What the image of a length does not exceed, in pixels, that would be 1 of τ in the middle of the picture.
    stretched_px: f64,
}

/// What of a block, or of several, is drawn.
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
            part: levels.part,
            stretched_px: tau_px * stretch,
        })
    }

    /// What a shader knows its splats as.
    pub fn constant(&self) -> u32 {
        match self.part {
            LevelPart::Own => LEVELS_LEAVES,
            LevelPart::Nodes => LEVELS_NODES,
            LevelPart::OfCells => LEVELS_OF_CELLS,
        }
    }

    /// Whether nodes blend with those below them.
    pub fn blends(&self) -> bool {
        self.blended_size > 1.0
    }

    /// The same view, in which nodes take the place of those below them at once.
    pub fn with_hard_steps(&self) -> Self {
        Self { blended_size: 1.0, ..*self }
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

    /// What no box of a node of some blocks, or a cell's splat, exceeds that is drawn, in pixels, with this filter; infinite of the object's own splats.
    pub fn largest_box_px(&self, bounds: &LevelBounds, filter_px: f64) -> f64 {
        if !self.part.stands_for_others() {
            return f64::INFINITY;
        }
        // Three pixels for rounding, as in `math/size.rs`. Not `hypot`, which is slow; what is too large for a square is infinite.
        let (px, filter_px) = (2.0 * bounds.longest * self.stretched_px * self.blended_size, 4.0 * filter_px);
        1.01 * (px * px + filter_px * filter_px).sqrt() + 3.0
    }

    /// What no box exceeds of the blocks below a tree of which something is drawn, as [`Self::largest_box_px`].
    pub fn largest_drawn_px(&self, tree: &BlockTree, filter_px: f64) -> f64 {
        match tree.of_detail.len().checked_sub(1) {
            Some(top) if self.part.stands_for_others() => {
                self.largest_below(tree, (top, 0..usize::MAX), filter_px, 0.0)
            }
            _ => f64::INFINITY,
        }
    }

    /// The same of some of a level, or `most` if that is more.
    fn largest_below(
        &self,
        tree: &BlockTree,
        (level, range): (usize, Range<usize>),
        filter_px: f64,
        mut most: f64,
    ) -> f64 {
        let all = &tree.of_detail[level];
        let range = range.start..range.end.min(all.len());
        for (place, bounds) in range.clone().zip(&all[range]) {
            let px = self.largest_box_px(bounds, filter_px);
            // Nothing below has a larger one.
            if px > most && self.of(bounds) != OfBlock::None {
                let below = |level| {
                    let children = place * CHILDREN..(place + 1) * CHILDREN;
                    self.largest_below(tree, (level, children), filter_px, most)
                };
                most = level.checked_sub(1).map_or(px, below);
            }
        }
        most
    }

    /// Between which the largest spreads lie that are small, of balls within bounds, for this share of the focal length.
    fn least(&self, distance: f64, balls: &BallBounds, share: f64) -> f64 {
        share * self.at(distance - balls.reach) * (1.0 - RESERVE)
    }

    fn most(&self, distance: f64, balls: &BallBounds, share: f64) -> f64 {
        share * self.at(distance + balls.far) * (1.0 + RESERVE)
    }

    fn at(&self, distance: f64) -> f64 {
        if self.is_orthographic { 1.0 } else { distance.max(self.near) }
    }

    /// The share up to which a splat's own balls are small: nodes blend with those below them, cells don't with polygons.
    fn share_of_own(&self) -> f64 {
        if self.part == LevelPart::Nodes { self.share_of_blended() } else { self.share }
    }

    /// How many of a block's splats, of which there are `count`, are drawn at most.
    pub fn most_drawn(&self, block: &BlockLevels, count: u32) -> u32 {
        let LevelBounds { center, own, parent, .. } = &block.bounds;
        let distance = self.eye.distance(*center);
        let own = self.most(distance, own, self.share_of_own());
        let parent = self.least(distance, parent, self.share);
        block.most_between(self.part.stands_for_others(), own, parent, count)
    }

    /// Whether none of some balls, around a place, is larger than τ.
    pub fn all_are_small(&self, (center, balls): &(DVec3, BallBounds)) -> bool {
        balls.spreads[1] <= self.least(self.eye.distance(*center), balls, self.share)
    }

    /// What of some blocks is drawn.
    pub fn of(&self, bounds: &LevelBounds) -> OfBlock {
        let distance = self.eye.distance(bounds.center);
        let (own, parent) = (&bounds.own, &bounds.parent);
        let [small_parent, large_parent] =
            [self.least(distance, parent, self.share), self.most(distance, parent, self.share)];
        let share = self.share_of_own();
        let [small_own, large_own] = [self.least(distance, own, share), self.most(distance, own, share)];
        if parent.spreads[1] <= small_parent || self.part.stands_for_others() && own.spreads[0] > large_own {
            return OfBlock::None;
        }
        let all_parents_are_large = parent.spreads[0] > large_parent;
        let all_own_are_small = !self.part.stands_for_others() || own.spreads[1] <= small_own;
        if all_parents_are_large && all_own_are_small { OfBlock::All } else { OfBlock::Some }
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::{
        math::random::SplitMix,
        prepare::LevelSpace,
        scene::{ErrorBall, Lod, LodSteps},
    };

    /// Random blocks seen from anywhere: never more are drawn than the bound says, and where spreads differ it says less than all.
    #[test]
    fn no_more_of_a_block_are_drawn_than_is_known() {
        let mut random = SplitMix(11);
        let (mut all, mut bound, mut drawn) = (0, 0, 0);
        for round in 0..2000 {
            let nodes = round % 2 == 0;
            let count = 1 + (random.unit() * 255.0) as usize;
            let mut ball = |least: f64, octaves: f64| ErrorBall {
                center: Vec3::from([(); 3].map(|()| 0.02 * random.unit() as f32)),
                radius: 0.01 * random.unit() as f32,
                spread: (least * (octaves * random.unit()).exp2()) as f32,
            };
            let own: Vec<ErrorBall> = (0..if nodes { count } else { 0 }).map(|_| ball(0.001, 1.0)).collect();
            let parents: Vec<ErrorBall> = (0..count).map(|_| ball(0.002, 0.5)).collect();
            let each: Vec<_> = parents.iter().map(|parent| (*parent, 1)).collect();
            let block = BlockLevels::around(&own, &each, 1.0);
            let space = LevelSpace { origin: DVec3::ZERO, scale: 1.0 };
            let eye = DVec3::new(0.2 + 3.0 * random.unit(), random.unit(), random.unit());
            let orthographic_height = (round % 5 == 4).then_some(1.0);
            let camera = Camera { eye, orthographic_height, ..Camera::default() };
            let settings = Settings { lod: Lod::Px(0.5 + 3.0 * random.unit()), ..Settings::default() };
            let part = if nodes { LevelPart::Nodes } else { LevelPart::Own };
            let view = LevelView::new(ChunkLevels { space, part }, false, &camera, &settings).unwrap();
            let size = |ball: &ErrorBall| {
                let distance = eye.distance(ball.center.as_dvec3()) - f64::from(ball.radius);
                f64::from(ball.spread) / view.at(distance)
            };
            let is_drawn = |i: &usize| {
                own.get(*i).is_none_or(|own| size(own) <= view.share) && size(&parents[*i]) > view.share
            };
            let found = (0..count).filter(is_drawn).count() as u32;
            let most = view.most_drawn(&block, count as u32);
            assert!(
                found <= most && most <= count as u32,
                "round {round}: {found} of {count}, {most} at most"
            );
            assert!(found == 0 || view.of(&block.bounds) != OfBlock::None, "round {round}");
            (all, bound, drawn) = (all + count as u32, bound + most, drawn + found);
        }
        println!("{drawn} drawn, {bound} at most, {all} in all");
        assert!(drawn > 10_000 && bound < all * 7 / 10, "{drawn} {bound} {all}");
    }

    /// Nodes blend with those below them, cells do not with polygons: a block is told to be drawn whole only where each cell's ball is below τ itself.
    #[test]
    fn a_block_of_cells_is_whole_only_where_no_cell_is_drawn_as_polygons() {
        let mut random = SplitMix(12);
        let (mut whole, mut between) = (0, 0);
        for round in 0..2000 {
            let eye = DVec3::new(2.0, random.unit(), random.unit());
            let camera = Camera { eye, ..Camera::default() };
            let settings = Settings { lod: Lod::Px(2.0), lod_steps: LodSteps::Blend, ..Settings::default() };
            let space = LevelSpace { origin: DVec3::ZERO, scale: 1.0 };
            let levels = ChunkLevels { space, part: LevelPart::OfCells };
            let view = LevelView::new(levels, false, &camera, &settings).unwrap();
            assert!(view.blends());
            let small = view.share * view.at(eye.length());
            let ball = |spread: f64| ErrorBall { center: Vec3::ZERO, radius: 0.0, spread: spread as f32 };
            let own: Vec<_> = (0..8).map(|_| ball(small * (0.5 + random.unit()))).collect();
            let parents = [(ball(1e3 * small), 8)];
            let block = BlockLevels::around(&own, &parents, 1.0);
            let all_small = own.iter().all(|own| f64::from(own.spread) <= small);
            let told = view.of(&block.bounds);
            assert!(all_small || told != OfBlock::All, "round {round}");
            whole += u32::from(told == OfBlock::All);
            between += u32::from(!all_small);
        }
        assert!(whole > 0 && between > 500, "{whole} {between}");
    }
}
