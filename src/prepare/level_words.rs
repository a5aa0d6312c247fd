//! What a device has of a chunk's levels of detail, for each word of its bits of splats (`glsl/inc/levels.glsl`): the balls of its splats' parents, each
//! once with a bit for each of its children; and of nodes their own balls.
//!
//! Balls are told from the hierarchy's own origin and scaled by a power of two. They are the same bits wherever they lie, so that of a parent and its
//! child exactly one is drawn, whatever chunks they are in.

use super::levels::{BlockLevels, ChunkLevels, Leveled};
use crate::{scene::ErrorBall, shaders::config::BLOCK_SPLATS};

/// The levels of a chunk.
pub(super) struct LevelWords {
    /// As the device has them.
    pub words: Vec<u32>,
    /// Of each block.
    pub blocks: Vec<BlockLevels>,
}

/// Splats of a word.
const WORD: usize = u32::BITS as usize;

/// Words of a ball.
const BALL_WORDS: usize = 5;

impl LevelWords {
    /// Of some leaves or nodes of an object, in their order.
    pub fn of(leveled: &Leveled, levels: ChunkLevels, numbers: &[usize]) -> Self {
        let own: Vec<ErrorBall> = match levels.nodes {
            true => numbers.iter().map(|number| leveled.own_ball(*number)).collect(),
            false => Vec::new(),
        };
        let parents: Vec<_> = numbers.chunks(WORD).map(|word| parents(leveled, levels, word)).collect();
        let mut words = Vec::new();
        let mut next = parents.len() + 1 + BALL_WORDS * own.len();
        words.push(next as u32);
        for parents in &parents {
            next += (BALL_WORDS + 1) * parents.len();
            words.push(next as u32);
        }
        own.iter().for_each(|ball| push_ball(&mut words, ball));
        for (ball, children) in parents.iter().flatten() {
            push_ball(&mut words, ball);
            words.push(*children);
        }
        let of_block = parents.chunks(BLOCK_SPLATS as usize / WORD);
        let blocks = of_block.zip(numbers.chunks(BLOCK_SPLATS as usize)).enumerate();
        let blocks = blocks.map(|(block, (parents, numbers))| {
            let parents = parents.iter().flatten().map(|(ball, children)| (*ball, children.count_ones()));
            let parents: Vec<(ErrorBall, u32)> = parents.collect();
            let own = own.iter().skip(block * BLOCK_SPLATS as usize).take(numbers.len());
            let own: Vec<ErrorBall> = own.copied().collect();
            let half_axes = numbers.iter().map(|number| leveled.nodes.splats.major_radius(*number));
            let longest = half_axes
                .zip(&own)
                .map(|(half_axis, ball)| half_axis * levels.space.scale / f64::from(ball.spread));
            BlockLevels::around(&own, &parents, longest.fold(0.0, f64::max))
        });
        Self { words, blocks: blocks.collect() }
    }
}

/// The parents of the splats of a word, each with the bits of its children.
fn parents(leveled: &Leveled, levels: ChunkLevels, numbers: &[usize]) -> Vec<(ErrorBall, u32)> {
    let mut parents: Vec<(u32, u32)> = Vec::new();
    for (bit, number) in numbers.iter().enumerate() {
        let parent = leveled.parent(levels, *number);
        match parents.iter_mut().find(|(other, _)| *other == parent) {
            Some((_, children)) => *children |= 1 << bit,
            None => parents.push((parent, 1 << bit)),
        }
    }
    parents.into_iter().map(|(parent, children)| (leveled.ball(parent), children)).collect()
}

fn push_ball(words: &mut Vec<u32>, ball: &ErrorBall) {
    words.extend(ball.center.to_array().map(f32::to_bits));
    words.extend([ball.radius, ball.spread].map(f32::to_bits));
}
