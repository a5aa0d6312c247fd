//! A module as one variant has it: which blocks can be reached, and which values are constants or equal to others.
//!
//! Conditional constant propagation (Wegman and Zadeck, "Constant propagation with conditional branches", TOPLAS 13(2),
//! 1991), by passes over the blocks until nothing changes. A block counts once an edge leads to it; a phi takes what
//! comes over the edges that exist, so that what a dead branch would give is forgotten.

use std::collections::{HashMap, HashSet};

use rspirv::{
    dr::{Instruction, Operand},
    spirv::Op,
};

use super::{
    fold,
    module::{Block, Id, Module, ids},
    numbering,
};

/// The knowledge of a value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Value {
    /// Any will do.
    Undefined,
    /// These scalars, as 32-bit patterns.
    Known(Vec<u32>),
    /// That of another id.
    Same(Id),
    /// Computed.
    Varying,
}

/// A module with what is known of it.
pub struct Specialized<'a> {
    pub module: &'a Module,
    values: HashMap<Id, Value>,
    edges: HashSet<(Id, Id)>,
    /// The blocks to which an edge leads, and the first.
    reached: HashSet<Id>,
    /// The block of an instruction and its place there.
    places: HashMap<Id, (usize, usize)>,
}

/// Passes after which something is wrong; each adds an edge or settles a value.
const MOST_PASSES: usize = 10_000;

/// Finds what can be reached and what is known.
///
/// # Errors
/// Where the passes don't end.
pub fn specialize(module: &Module) -> Result<Specialized<'_>, String> {
    let mut places = HashMap::new();
    for (block, number) in module.blocks.iter().zip(0..) {
        for (instruction, place) in block.body.iter().zip(0..) {
            places.extend(instruction.result_id.map(|id| (id, (number, place))));
        }
    }
    let reached = module.blocks.first().map(|entry| entry.label).into_iter().collect();
    let mut specialized =
        Specialized { module, values: HashMap::new(), edges: HashSet::new(), reached, places };
    for _ in 0..MOST_PASSES {
        if !specialized.pass() {
            numbering::share_equal_values(&mut specialized);
            return Ok(specialized);
        }
    }
    Err("the values of a shader don't settle".to_owned())
}

impl<'a> Specialized<'a> {
    /// The blocks that can be reached, in order.
    pub fn blocks(&self) -> impl Iterator<Item = &'a Block> + '_ {
        self.module.blocks.iter().filter(|block| self.reached.contains(&block.label))
    }

    /// Where control goes from a block, each block once.
    pub fn successors(&self, block: &Block) -> Vec<Id> {
        let mut all = Vec::new();
        for id in ids(&block.terminator) {
            if self.edges.contains(&(block.label, id)) && !all.contains(&id) {
                all.push(id);
            }
        }
        all
    }

    /// The id whose value an id has.
    pub fn resolve(&self, mut id: Id) -> Id {
        while let Some(Value::Same(other)) = self.values.get(&id) {
            id = *other;
        }
        id
    }

    /// The scalars of a constant.
    pub fn known(&self, id: Id) -> Option<&[u32]> {
        let id = self.resolve(id);
        match self.values.get(&id) {
            Some(Value::Known(scalars)) => Some(scalars),
            _ => self.module.constants.get(&id).map(Vec::as_slice),
        }
    }

    /// The instruction that computes a value.
    pub fn instruction(&self, id: Id) -> Option<&'a Instruction> {
        let (block, place) = *self.places.get(&id)?;
        self.module.blocks.get(block)?.body.get(place)
    }

    /// The label of the block of an instruction.
    pub fn block_of(&self, id: Id) -> Option<Id> {
        self.places.get(&id).map(|(block, _)| self.module.blocks[*block].label)
    }

    /// The values that a phi takes over the edges that exist.
    pub fn incoming(&self, phi: &Instruction) -> Vec<Id> {
        let Some(label) = phi.result_id.and_then(|id| self.block_of(id)) else { return Vec::new() };
        let pairs: Vec<Id> = ids(phi).collect();
        let taken = pairs.chunks_exact(2).filter(|pair| self.edges.contains(&(pair[1], label)));
        taken.map(|pair| self.resolve(pair[0])).collect()
    }

    /// Whether any value will do.
    pub fn is_undefined(&self, id: Id) -> bool {
        self.values.get(&self.resolve(id)) == Some(&Value::Undefined)
    }

    /// Makes one id stand for another.
    pub(super) fn set_same(&mut self, id: Id, other: Id) {
        self.values.insert(id, Value::Same(other));
    }

    /// One pass over all blocks; whether anything changed.
    fn pass(&mut self) -> bool {
        let mut changed = false;
        let blocks: Vec<&Block> = self.blocks().collect();
        for block in blocks {
            for instruction in &block.body {
                let Some(id) = instruction.result_id else { continue };
                if let Some(value) = self.evaluate(instruction)
                    && self.values.get(&id) != Some(&value)
                {
                    self.values.insert(id, value);
                    changed = true;
                }
            }
            for target in self.targets(&block.terminator) {
                changed |= self.edges.insert((block.label, target));
                self.reached.insert(target);
            }
        }
        changed
    }

    /// Where a terminator may lead, as far as its condition is known.
    fn targets(&self, terminator: &Instruction) -> Vec<Id> {
        let all: Vec<Id> = ids(terminator).collect();
        match (terminator.class.opcode, all.as_slice()) {
            (Op::Branch, targets) => targets.to_vec(),
            (Op::BranchConditional, [condition, yes, no]) => match self.known(*condition) {
                Some(scalars) => vec![if scalars.first() == Some(&0) { *no } else { *yes }],
                None => vec![*yes, *no],
            },
            (Op::Switch, [selector, default, targets @ ..]) => match self.known(*selector) {
                Some(scalars) => {
                    let cases = terminator.operands.iter().filter_map(|operand| match operand {
                        Operand::LiteralBit32(number) => Some(*number),
                        _ => None,
                    });
                    let case = cases.zip(targets).find(|(number, _)| scalars.first() == Some(number));
                    vec![case.map_or(*default, |(_, target)| *target)]
                }
                None => all[1..].to_vec(),
            },
            _ => Vec::new(),
        }
    }

    /// The knowledge of an instruction's value; `None` where nothing is yet.
    fn evaluate(&self, instruction: &Instruction) -> Option<Value> {
        let operands: Vec<Id> = ids(instruction).map(|id| self.resolve(id)).collect();
        match instruction.class.opcode {
            Op::Undef => return Some(Value::Undefined),
            Op::CopyObject => return operands.first().map(|id| Value::Same(*id)),
            Op::Phi => return self.evaluate_phi(instruction),
            _ => {}
        }
        if let Some(value) = self.simplified(instruction, &operands) {
            return Some(value);
        }
        // The first operand of an extended instruction is the set.
        let skipped = usize::from(instruction.class.opcode == Op::ExtInst);
        let operands = operands.get(skipped..)?;
        let known: Option<Vec<&[u32]>> = operands.iter().map(|id| self.known(*id)).collect();
        let folded = match (known, operands.first()) {
            (Some(known), Some(first)) => {
                fold::operation(self.module, instruction.class.opcode, instruction, *first, &known)
            }
            _ => None,
        };
        Some(folded.map_or(Value::Varying, Value::Known))
    }

    fn evaluate_phi(&self, phi: &Instruction) -> Option<Value> {
        let id = phi.result_id?;
        let mut only: Option<Id> = None;
        let mut undefined = false;
        for value in self.incoming(phi) {
            match self.values.get(&value) {
                _ if value == id => {}
                Some(Value::Undefined) => undefined = true,
                // Not computed yet, over an edge that leads back.
                None if self.places.contains_key(&value) => {}
                _ if only.is_some_and(|only| !self.is_equal(only, value)) => return Some(Value::Varying),
                _ => only = Some(value),
            }
        }
        match only {
            Some(only) => Some(Value::Same(only)),
            None => undefined.then_some(Value::Undefined),
        }
    }

    fn is_equal(&self, a: Id, b: Id) -> bool {
        a == b || self.known(a).is_some_and(|known| self.known(b) == Some(known))
    }

    /// Identities that hold for all values: selections that are decided, logic with a constant, a factor of 1, a term of 0.
    fn simplified(&self, instruction: &Instruction, operands: &[Id]) -> Option<Value> {
        let all = |id: Id, pattern: u32| {
            self.known(id).is_some_and(|scalars| scalars.iter().all(|scalar| *scalar == pattern))
        };
        let one = 1.0_f32.to_bits();
        let width = self.module.width(instruction.result_type.unwrap_or_default()) as usize;
        let constant = |value: u32| Value::Known(vec![value; width]);
        match (instruction.class.opcode, operands) {
            (Op::Select, [condition, yes, _]) if all(*condition, 1) => Some(Value::Same(*yes)),
            (Op::Select, [condition, _, no]) if all(*condition, 0) => Some(Value::Same(*no)),
            (Op::Select, [_, yes, no]) if self.is_equal(*yes, *no) => Some(Value::Same(*yes)),
            (Op::LogicalAnd, [a, b]) if all(*a, 0) || all(*b, 0) => Some(constant(0)),
            (Op::LogicalOr, [a, b]) if all(*a, 1) || all(*b, 1) => Some(constant(1)),
            (Op::LogicalAnd, [a, b]) if all(*a, 1) => Some(Value::Same(*b)),
            (Op::LogicalAnd, [a, b]) if all(*b, 1) => Some(Value::Same(*a)),
            (Op::LogicalOr, [a, b]) if all(*a, 0) => Some(Value::Same(*b)),
            (Op::LogicalOr, [a, b]) if all(*b, 0) => Some(Value::Same(*a)),
            (Op::FMul, [a, b]) if all(*a, one) => Some(Value::Same(*b)),
            (Op::FMul | Op::VectorTimesScalar | Op::FDiv, [a, b]) if all(*b, one) => Some(Value::Same(*a)),
            (Op::FAdd, [a, b]) if all(*a, 0) => Some(Value::Same(*b)),
            (Op::FAdd | Op::FSub, [a, b]) if all(*b, 0) => Some(Value::Same(*a)),
            _ => None,
        }
    }
}
