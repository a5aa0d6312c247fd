//! The instructions that a shader's outputs depend on: all else counts nothing.

use std::collections::{HashMap, HashSet};

use rspirv::{dr::Instruction, spirv::Op};

use super::{
    module::{Block, Id, ids},
    numbering::{Scalar, has_effect},
    specialize::Specialized,
};

/// The instructions that are needed.
pub struct Live<'a> {
    /// In order, each with its block's label; those with an effect among them.
    pub instructions: Vec<(Id, &'a Instruction)>,
    /// Which live instructions use the result of one; a branch does as the label of its block, a store as some number.
    pub users: HashMap<Id, HashSet<Id>>,
}

/// Finds what is needed.
pub fn live<'a>(specialized: &Specialized<'a>) -> Live<'a> {
    let mut marks = Marks { specialized, results: HashSet::new(), users: HashMap::new() };
    let blocks: Vec<&Block> = specialized.blocks().collect();
    // Stores have no result to name them by: they get numbers that no id has.
    let effects = blocks.iter().flat_map(|block| &block.body).filter(|i| has_effect(i.class.opcode));
    for (instruction, number) in effects.zip(0..) {
        marks.use_operands(instruction, instruction.result_id.unwrap_or(Id::MAX - number));
    }
    let mut conditions: Vec<(Id, Id)> = Vec::new();
    loop {
        let needed: Vec<(Id, Id)> = blocks
            .iter()
            .filter(|block| !conditions.iter().any(|(label, _)| *label == block.label))
            .filter(|block| {
                specialized.successors(block).len() > 1 && marks.decides_something(block, &blocks)
            })
            .filter_map(|block| Some((block.label, ids(&block.terminator).next()?)))
            .collect();
        if needed.is_empty() {
            break;
        }
        for (label, condition) in &needed {
            marks.use_value(*condition, *label);
        }
        conditions.extend(needed);
    }
    let is_live = |instruction: &Instruction| {
        has_effect(instruction.class.opcode)
            || instruction.result_id.is_some_and(|id| marks.results.contains(&id))
    };
    let instructions = blocks
        .iter()
        .flat_map(|block| block.body.iter().map(|instruction| (block.label, instruction)))
        .filter(|(_, instruction)| is_live(instruction))
        .collect();
    Live { instructions, users: marks.users }
}

struct Marks<'s, 'a> {
    specialized: &'s Specialized<'a>,
    results: HashSet<Id>,
    users: HashMap<Id, HashSet<Id>>,
}

impl Marks<'_, '_> {
    fn use_operands(&mut self, instruction: &Instruction, user: Id) {
        let operands: Vec<Id> = match instruction.class.opcode {
            Op::Phi => self.specialized.incoming(instruction),
            _ => ids(instruction).collect(),
        };
        for operand in operands {
            self.use_value(operand, user);
        }
    }

    /// Marks what gives the scalars of a value. Moves on the way are not marked: they cost nothing.
    fn use_value(&mut self, id: Id, user: Id) {
        let mut open = vec![(id, user)];
        while let Some((id, user)) = open.pop() {
            let id = self.specialized.resolve(id);
            if self.specialized.known(id).is_some() || self.specialized.is_undefined(id) {
                continue;
            }
            let mut sources: Vec<Id> = Vec::new();
            for scalar in self.specialized.scalars(id) {
                match scalar {
                    Scalar::Of(source, _) if !sources.contains(&source) => sources.push(source),
                    _ => {}
                }
            }
            for source in sources {
                self.users.entry(source).or_default().insert(user);
                if !self.results.insert(source) {
                    continue;
                }
                if let Some(instruction) = self.specialized.instruction(source) {
                    let operands: Vec<Id> = match instruction.class.opcode {
                        Op::Phi => self.specialized.incoming(instruction),
                        _ => ids(instruction).collect(),
                    };
                    open.extend(operands.into_iter().map(|operand| (operand, source)));
                }
            }
        }
    }

    /// Whether it matters where a block's branch leads: an effect, an end or a leap out lies on one of the ways to where
    /// they meet again, or a needed value is chosen there.
    fn decides_something(&self, block: &Block, blocks: &[&Block]) -> bool {
        let Some(merge) = block.merge else { return true };
        let mut inside = HashSet::new();
        let mut open: Vec<Id> = self.specialized.successors(block);
        while let Some(label) = open.pop() {
            if label == merge || !inside.insert(label) {
                continue;
            }
            let Some(inner) = blocks.iter().find(|inner| inner.label == label) else { continue };
            let ends = self.specialized.successors(inner).is_empty();
            let acts = inner.body.iter().any(|instruction| has_effect(instruction.class.opcode));
            if ends || acts {
                return true;
            }
            open.extend(self.specialized.successors(inner));
        }
        let chooses = |label: Id| {
            let target = blocks.iter().find(|other| other.label == label);
            target.is_some_and(|target| {
                target.body.iter().any(|instruction| {
                    instruction.class.opcode == Op::Phi
                        && instruction.result_id.is_some_and(|id| self.results.contains(&id))
                })
            })
        };
        if block.is_loop {
            return inside.iter().chain([&merge, &block.label]).any(|label| chooses(*label));
        }
        // What leaves the selection by another door than its end leaves to an end of something around it: that shows as
        // blocks inside that are beyond the end too, and counts as a choice if one is made there.
        chooses(merge) || inside.iter().any(|label| chooses(*label) && self.is_beyond(*label, merge, blocks))
    }

    /// Whether a block can be reached from the end of a selection.
    fn is_beyond(&self, label: Id, merge: Id, blocks: &[&Block]) -> bool {
        let mut seen = HashSet::new();
        let mut open = vec![merge];
        while let Some(next) = open.pop() {
            if !seen.insert(next) {
                continue;
            }
            if next == label {
                return true;
            }
            if let Some(block) = blocks.iter().find(|block| block.label == next) {
                open.extend(self.specialized.successors(block));
            }
        }
        false
    }
}
