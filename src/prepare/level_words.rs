//! What a device has of a chunk's levels of detail, for each word of its bits of splats (`glsl/inc/levels.glsl`): the balls of its splats' parents, each
//! once with a bit for each of its children; of nodes their own balls; of splats of cells the balls of these, as parents' are.
//!
//! Balls are told from the hierarchy's own origin and scaled by a power of two. They are the same bits wherever they lie, so that of a parent and its
//! child exactly one is drawn, whatever chunks they are in.

use super::levels::{BlockLevels, ChunkLevels, LevelPart, Leveled};
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

/// A ball with the bits of the splats of a word that it is of.
type Shared = (ErrorBall, u32);

impl LevelWords {
    /// Of some leaves or nodes of an object, in their order.
    pub fn of<'a>(leveled: &'a Leveled, levels: ChunkLevels, numbers: &[usize]) -> Self {
        let shared = |of: &dyn Fn(usize) -> &'a [u32]| -> Vec<Vec<Shared>> {
            numbers.chunks(WORD).map(|word| shared_balls(leveled, word, of)).collect()
        };
        let parents = shared(&|number| std::slice::from_ref(leveled.parent(levels, number)));
        let own_balls =
            |number: &usize| leveled.own_balls(levels, *number).iter().map(|ball| leveled.ball(*ball));
        let mut words = Vec::new();
        match levels.part {
            LevelPart::Own => push_lists(&mut words, &[&parents], &[]),
            LevelPart::Nodes => {
                let own: Vec<ErrorBall> = numbers.iter().flat_map(own_balls).collect();
                push_lists(&mut words, &[&parents], &own);
            }
            LevelPart::OfCells => {
                let cells = shared(&|number| leveled.own_balls(levels, number));
                push_lists(&mut words, &[&parents, &cells], &[]);
            }
        }
        let of_block = parents.chunks(BLOCK_SPLATS as usize / WORD);
        let blocks = of_block.zip(numbers.chunks(BLOCK_SPLATS as usize)).map(|(parents, numbers)| {
            let parents = parents.iter().flatten().map(|(ball, children)| (*ball, children.count_ones()));
            let parents: Vec<(ErrorBall, u32)> = parents.collect();
            let own: Vec<ErrorBall> = numbers.iter().flat_map(own_balls).collect();
            let longest = numbers.iter().flat_map(|number| {
                let half_axis = leveled.half_axis(levels, *number);
                own_balls(number).map(move |ball| half_axis / f64::from(ball.spread))
            });
            BlockLevels::around(&own, &parents, longest.fold(0.0, f64::max))
        });
        let blocks = blocks.collect();
        Self { words, blocks }
    }
}

/// Of each kind of lists where that of each word begins, and where the last one ends; then single balls; then the lists.
fn push_lists(words: &mut Vec<u32>, kinds: &[&[Vec<Shared>]], single: &[ErrorBall]) {
    let starts: usize = kinds.iter().map(|lists| lists.len() + 1).sum();
    let mut next = starts + BALL_WORDS * single.len();
    for lists in kinds {
        words.push(next as u32);
        for list in *lists {
            next += (BALL_WORDS + 1) * list.len();
            words.push(next as u32);
        }
    }
    single.iter().for_each(|ball| push_ball(words, ball));
    for (ball, splats) in kinds.iter().copied().flatten().flatten() {
        push_ball(words, ball);
        words.push(*splats);
    }
}

/// The balls of the splats of a word, each once.
fn shared_balls<'a>(leveled: &'a Leveled, word: &[usize], of: &dyn Fn(usize) -> &'a [u32]) -> Vec<Shared> {
    let mut shared: Vec<(u32, u32)> = Vec::new();
    for (bit, number) in word.iter().enumerate() {
        for &ball in of(*number) {
            match shared.iter_mut().find(|(other, _)| *other == ball) {
                Some((_, splats)) => *splats |= 1 << bit,
                None => shared.push((ball, 1 << bit)),
            }
        }
    }
    shared.into_iter().map(|(ball, splats)| (leveled.ball(ball), splats)).collect()
}

fn push_ball(words: &mut Vec<u32>, ball: &ErrorBall) {
    words.extend(ball.center.to_array().map(f32::to_bits));
    words.extend([ball.radius, ball.spread].map(f32::to_bits));
}
