//! Counts a shader's live instructions by the rule of [`super::arb`]: what stands around an operation decides what it takes.

use std::collections::{BTreeMap, HashMap, HashSet};

use rspirv::{
    dr::Instruction,
    spirv::{ExecutionModel, GlslStd450Op, Op},
};

use super::{
    Counts, Listed,
    arb::{self, extended_op, is_arithmetic, is_comparison, is_of_bits},
    live::Live,
    module::{Id, ids},
    numbering::Scalar,
    patterns::{self, Pattern},
    specialize::Specialized,
};

/// Counts by the rule. What the scalar rule counts is still 0.
///
/// # Errors
/// An instruction that the tables lack.
pub fn count(specialized: &Specialized<'_>, live: &Live<'_>) -> Result<Counts, String> {
    let tally = tally(specialized, live)?;
    let mut mnemonics = BTreeMap::new();
    for Counted { name, .. } in &tally.all {
        *mnemonics.entry(*name).or_insert(0) += 1;
    }
    let has_arb = specialized.module.stage != ExecutionModel::GLCompute;
    Ok(Counts {
        arb: has_arb.then_some(tally.all.len() as u32),
        arb_longest_path: has_arb.then(|| tally.longest_path()),
        mnemonics: if has_arb { mnemonics } else { BTreeMap::new() },
        scalar: 0,
        listed: tally.listed,
    })
}

/// Counts by the rule, each instruction by itself.
///
/// # Errors
/// An instruction that the tables lack.
pub(super) fn tally<'s, 'a>(
    specialized: &'s Specialized<'a>,
    live: &'s Live<'a>,
) -> Result<Tally<'s, 'a>, String> {
    let mut tally = Tally {
        specialized,
        live,
        patterns: patterns::find(specialized, live),
        taken: HashSet::new(),
        all: Vec::new(),
        at: 0,
        listed: Listed::default(),
    };
    for (label, instruction) in &live.instructions {
        tally.instruction(*label, instruction)?;
    }
    tally.list_control();
    Ok(tally)
}

/// An ARB instruction.
pub(super) struct Counted {
    /// The block that it is in.
    pub label: Id,
    pub name: &'static str,
    /// The result of SPIR-V for which it was counted.
    pub at: Id,
}

/// The instructions counted so far.
pub(super) struct Tally<'s, 'a> {
    pub specialized: &'s Specialized<'a>,
    live: &'s Live<'a>,
    patterns: HashMap<Id, Pattern>,
    /// Reciprocals and roots that were counted.
    taken: HashSet<(&'static str, Scalar)>,
    pub all: Vec<Counted>,
    /// The result that is looked at.
    at: Id,
    pub listed: Listed,
}

impl Tally<'_, '_> {
    fn add(&mut self, label: Id, names: impl IntoIterator<Item = &'static str>) {
        let at = self.at;
        self.all.extend(names.into_iter().map(|name| Counted { label, name, at }));
    }

    fn instruction(&mut self, label: Id, instruction: &Instruction) -> Result<(), String> {
        let op = instruction.class.opcode;
        self.list(instruction);
        let Some(id) = instruction.result_id else { return Ok(()) };
        self.at = id;
        match self.patterns.get(&id) {
            Some(Pattern::Part) => return Ok(()),
            Some(Pattern::Whole(name)) => {
                self.add(label, [*name]);
                return Ok(());
            }
            // The product is no instruction of its own; a quotient's reciprocal is.
            Some(Pattern::Factor) => {
                if op == Op::FDiv {
                    self.reciprocals(label, instruction);
                }
                return Ok(());
            }
            None => {}
        }
        if self.only_addresses(id) {
            self.listed.addresses += u32::from(is_arithmetic(op));
            return Ok(());
        }
        if is_comparison(op) && self.only_discards(id) {
            self.listed.alpha_tests += 1;
            return Ok(());
        }
        let width = self.specialized.module.width_of(id);
        let first = ids(instruction).nth(usize::from(op == Op::ExtInst));
        let source =
            first.and_then(|operand| self.specialized.instruction(self.specialized.resolve(operand)));
        let operand_width = first.map_or(1, |operand| self.specialized.module.width_of(operand));
        match op {
            Op::Phi => {
                let mut chosen: Vec<Vec<Scalar>> = Vec::new();
                for value in self.specialized.incoming(instruction) {
                    let scalars = self.specialized.scalars(value);
                    if !self.specialized.is_undefined(value) && !chosen.contains(&scalars) {
                        chosen.push(scalars);
                    }
                }
                // What a loop carries over is a move.
                let is_loop = self.specialized.blocks().any(|block| block.label == label && block.is_loop);
                let selections = if is_loop { 0 } else { chosen.len().saturating_sub(1) };
                self.add(label, std::iter::repeat_n("CMP", selections));
            }
            Op::FDiv => {
                self.reciprocals(label, instruction);
                let one = |scalar: &Scalar| *scalar == Scalar::Known(1.0_f32.to_bits());
                let numerator = first.map(|id| self.specialized.scalars(id)).unwrap_or_default();
                if !numerator.iter().all(one) {
                    self.add(label, ["MUL"]);
                }
            }
            Op::FMod | Op::FRem => {
                self.reciprocals(label, instruction);
                self.add(label, ["MUL", "FLR", "MAD"]);
            }
            Op::LogicalNot => {
                let turns = source.is_some_and(|source| is_comparison(source.class.opcode));
                if !turns && !self.only_discards(id) {
                    self.add(label, ["SUB"]);
                }
            }
            Op::ConvertFToS | Op::ConvertFToU => {
                let is_whole = source.and_then(extended_op).is_some_and(|op| {
                    matches!(
                        op,
                        GlslStd450Op::Floor
                            | GlslStd450Op::Ceil
                            | GlslStd450Op::Trunc
                            | GlslStd450Op::Round
                            | GlslStd450Op::RoundEven
                    )
                });
                if !is_whole {
                    self.add(label, ["FLR"]);
                }
            }
            Op::ExtInst => self.extended(label, id, instruction, width, operand_width)?,
            _ => {
                let names = arb::simple(op, width, operand_width).ok_or_else(|| {
                    format!("{}: not in the table of instructions", instruction.class.opname)
                })?;
                self.listed.bit_operations += u32::from(is_of_bits(op));
                self.add(label, names);
            }
        }
        Ok(())
    }

    fn extended(
        &mut self,
        label: Id,
        id: Id,
        instruction: &Instruction,
        width: u32,
        operand_width: u32,
    ) -> Result<(), String> {
        let op =
            extended_op(instruction).ok_or_else(|| "an extended instruction of an unknown set".to_owned())?;
        let in_fragment = self.specialized.module.stage == ExecutionModel::Fragment;
        let operands: Vec<Id> = ids(instruction).skip(1).collect();
        let is = |id: Id, value: f32| {
            self.specialized.scalars(id).iter().all(|scalar| *scalar == Scalar::Known(value.to_bits()))
        };
        match (op, operands.as_slice()) {
            (GlslStd450Op::Sqrt | GlslStd450Op::InverseSqrt, [operand]) => {
                for scalar in self.specialized.scalars(*operand) {
                    if self.taken.insert(("RSQ", scalar)) {
                        self.add(label, ["RSQ"]);
                    }
                    // Where it is more than a divisor.
                    if op == GlslStd450Op::Sqrt && self.is_used_beside_division(id) {
                        self.add(label, ["RCP"]);
                    }
                }
            }
            (GlslStd450Op::FClamp, [_, low, high]) if in_fragment && is(*low, 0.0) && is(*high, 1.0) => {}
            _ => {
                let names = arb::extended(op, width, operand_width, in_fragment)
                    .ok_or_else(|| format!("{op:?}: not in the table of instructions"))?;
                self.add(label, names);
            }
        }
        Ok(())
    }

    /// Counts the reciprocals that a quotient needs and that were not yet taken.
    fn reciprocals(&mut self, label: Id, quotient: &Instruction) {
        let divisor = ids(quotient).nth(1).unwrap_or_default();
        for scalar in self.specialized.scalars(divisor) {
            let is_root = match scalar {
                Scalar::Known(_) => continue,
                Scalar::Of(id, _) => {
                    let root = self.specialized.instruction(id).and_then(extended_op);
                    root == Some(GlslStd450Op::Sqrt)
                }
                Scalar::At(..) => false,
            };
            if !is_root && self.taken.insert(("RCP", scalar)) {
                self.add(label, ["RCP"]);
            }
        }
    }

    /// Whether anything but a quotient's divisor needs a root itself.
    fn is_used_beside_division(&self, root: Id) -> bool {
        let users = self.live.users.get(&root);
        users.is_some_and(|users| {
            users.iter().any(|user| {
                let Some(instruction) = self.specialized.instruction(*user) else { return true };
                if instruction.class.opcode != Op::FDiv {
                    return true;
                }
                let numerator = ids(instruction).next().unwrap_or_default();
                let of_root = |scalar: &Scalar| matches!(scalar, Scalar::Of(id, _) if *id == root);
                self.specialized.scalars(numerator).iter().any(of_root)
            })
        })
    }

    /// Whether a value is used for nothing but to find a place in memory.
    fn only_addresses(&self, id: Id) -> bool {
        let Some(users) = self.live.users.get(&id) else { return false };
        !users.is_empty()
            && users.iter().all(|user| match self.specialized.instruction(*user) {
                Some(user) => match user.class.opcode {
                    Op::AccessChain | Op::InBoundsAccessChain => true,
                    Op::ImageFetch => !matches!(
                        self.specialized.instruction(id).map(|i| i.class.opcode),
                        Some(Op::ImageFetch)
                    ),
                    Op::IAdd | Op::IMul | Op::ISub | Op::Bitcast | Op::UDiv | Op::ShiftRightLogical => {
                        user.result_id.is_some_and(|user| self.only_addresses(user))
                    }
                    _ => false,
                },
                None => false,
            })
    }

    /// Whether a truth value decides discards and nothing else.
    fn only_discards(&self, id: Id) -> bool {
        let Some(users) = self.live.users.get(&id) else { return false };
        !users.is_empty()
            && users.iter().all(|user| match self.specialized.instruction(*user) {
                Some(not) => {
                    not.class.opcode == Op::LogicalNot
                        && not.result_id.is_some_and(|not| self.only_discards(not))
                }
                None => self.specialized.blocks().any(|block| {
                    block.label == *user
                        && self.specialized.successors(block).iter().any(|target| self.discards(*target))
                }),
            })
    }

    fn discards(&self, label: Id) -> bool {
        self.specialized.blocks().any(|block| {
            block.label == label
                && matches!(block.terminator.class.opcode, Op::Kill | Op::TerminateInvocation)
        })
    }
}
