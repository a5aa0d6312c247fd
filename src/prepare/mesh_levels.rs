//! The cells of a piece of a mesh, as a device has them that decides which of them are drawn as polygons (`glsl/choose_polygons.comp.glsl`): of each its first index
//! and how many there are; a ball around it in the piece's local space, by which it is known to be outside of the view; and where the balls begin, and end, that it
//! is drawn for: its own, and its neighbors'. These, behind all cells, are the same bits as splats have (`level_words.rs`).

use glam::DVec3;

use super::{
    level_bounds::BallBounds,
    levels::{LevelSpace, Leveled},
    rebase::Rebase,
};
use crate::{
    scene::{ErrorBall, HybridLevels},
    shaders::config::CELL_WORDS,
};

/// By how much a ball in local space is larger, for what f32 loses.
const ROOM: f64 = 1.00001;

/// What a piece of a mesh with cells is drawn by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshLevels {
    /// Where balls are told.
    pub space: LevelSpace,
    /// How many cells have triangles in it.
    pub cells: u32,
    /// Of the balls that these are drawn for, around a place in that space.
    pub balls: (DVec3, BallBounds),
}

/// The cells of a piece.
pub(super) struct CellWords {
    pub levels: MeshLevels,
    /// As the device has them.
    pub words: Vec<u32>,
}

/// The cells of a mesh with levels of detail.
pub(super) struct Cells<'a> {
    hybrid: &'a HybridLevels,
    space: LevelSpace,
}

impl<'a> Cells<'a> {
    pub fn of(hybrid: &'a HybridLevels) -> Self {
        Self { hybrid, space: Leveled::space(&hybrid.splats) }
    }

    /// Of the balls of all cells of the mesh.
    fn bounds(&self) -> (DVec3, BallBounds) {
        let balls = || self.hybrid.cells.iter().map(|cell| self.hybrid.splats.balls[cell.ball as usize]);
        let balls: Vec<ErrorBall> = balls().map(|ball| self.space.ball(&ball)).collect();
        let sum: DVec3 = balls.iter().map(|ball| ball.center.as_dvec3()).sum();
        let center = sum / balls.len().max(1) as f64;
        (center, BallBounds::of(center, balls.iter()))
    }

    /// Those of a piece that has these triangles of the mesh, rising, and this local space.
    pub fn words(&self, triangles: &[u32], local: &Rebase) -> CellWords {
        let (mut words, mut balls): (Vec<u32>, Vec<u32>) = Default::default();
        let (mut cells, mut first) = (0, 0);
        for cell in &self.hybrid.cells {
            let count = triangles[first..].partition_point(|triangle| *triangle < cell.triangles.end);
            if count > 0 {
                let own = &self.hybrid.splats.balls[cell.ball as usize];
                words.extend([3 * first as u32, 3 * count as u32]);
                let middle = local.point(self.space.origin + own.center.as_dvec3());
                let reach =
                    ROOM * (f64::from(own.radius) * local.scale + middle.length() * f64::from(f32::EPSILON));
                words.extend(middle.as_vec3().extend(reach as f32).to_array().map(f32::to_bits));
                words.push(balls.len() as u32);
                let neighbors = cell.neighbors.iter().map(|cell| self.hybrid.ball_of_cell(*cell));
                for ball in std::iter::once(cell.ball).chain(neighbors) {
                    let ErrorBall { center, radius, spread } =
                        self.space.ball(&self.hybrid.splats.balls[ball as usize]);
                    balls.extend([center.x, center.y, center.z, radius, spread].map(f32::to_bits));
                }
                words.push(balls.len() as u32);
                cells += 1;
                first += count;
            }
        }
        for cell in words.chunks_exact_mut(CELL_WORDS as usize) {
            // They lie behind the cells.
            cell[6] += CELL_WORDS * cells;
            cell[7] += CELL_WORDS * cells;
        }
        words.append(&mut balls);
        CellWords { levels: MeshLevels { space: self.space, cells, balls: self.bounds() }, words }
    }
}
