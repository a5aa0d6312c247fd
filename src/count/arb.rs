//! The rule of the paper-comparable count: what an operation takes in `ARB_vertex_program` and `ARB_fragment_program`.
//!
//! The instructions are ABS ADD CMP COS DP3 DP4 DPH DST EX2 FLR FRC KIL LG2 LIT LRP MAD MAX MIN MOV MUL POW RCP RSQ SCS SGE
//! SIN SLT SUB SWZ TEX TXB TXP XPD; each takes up to four components and counts 1. Swizzles, negated operands, write masks
//! and (in fragment programs) saturation are free. Guennebaud et al. 2006, section 7, do not count the moves that copy
//! attributes; section 3.2 leaves fragments to the alpha test and their sums to blending. So moves, loads, stores and the
//! discards that stand for the alpha test are listed beside the count.
//!
//! What SPIR-V says in another way:
//! - a product that only one sum uses is its MAD, whatever may be contracted; a quotient's product too
//! - a sum of products of components of two registers is DP3 or DP4, products crossed over as XPD wants them are XPD: the
//!   renderer spells these out, because no compiler marks its own functions as exact
//! - x / y is RCP and MUL, the reciprocal of each scalar taken once; 1 / y is RCP; a constant's reciprocal is a constant
//! - sqrt(x) is RSQ and RCP, x / sqrt(y) RSQ and MUL, the root of each scalar taken once
//! - RCP, RSQ, EX2, LG2, POW, SIN and COS are scalar: one for each component
//! - a comparison is SLT or SGE, equality SGE, SGE, MUL, and MUL, or MAX; not is free where it turns a comparison around,
//!   else SUB
//! - a selection is CMP, also where a branch selects; vertex programs had it as a conditional move (NV_vertex_program2)
//! - integers count as the floats in place of which they stand, to float and back is free, but FLR where something is cut off;
//!   those that only address memory are listed, not counted
//! - operations on bits count 1 and are listed, because ARB has none; unpacking a color is the attribute fetch's own
//!
//! Scalars that could share an instruction are not packed together: the count is an upper bound.

use std::collections::{BTreeMap, HashMap, HashSet};

use rspirv::{
    dr::Instruction,
    spirv::{ExecutionModel, GlslStd450Op, Op, StorageClass},
};

use super::{
    Counts, Listed,
    live::Live,
    module::{Id, ids, literals},
    numbering::{Scalar, has_effect},
    patterns::{self, Pattern},
    specialize::Specialized,
};

/// What the operations take that need no look around. `width` is that of the result, `operand_width` that of the operand.
fn simple(op: Op, width: u32, operand_width: u32) -> Option<Vec<&'static str>> {
    let each = |name: &'static str| vec![name; width as usize];
    Some(match op {
        Op::FMul | Op::VectorTimesScalar | Op::IMul => vec!["MUL"],
        Op::FAdd | Op::IAdd => vec!["ADD"],
        Op::FSub | Op::ISub => vec!["SUB"],
        Op::FNegate | Op::SNegate => vec![],
        // With two components the third of a register is 0.
        Op::Dot if operand_width <= 3 => vec!["DP3"],
        Op::Dot => vec!["DP4"],
        // A column a step.
        Op::MatrixTimesVector => {
            [vec!["MUL"], vec!["MAD"; operand_width as usize / width as usize - 1]].concat()
        }
        // A column a component.
        Op::VectorTimesMatrix => each(if operand_width <= 3 { "DP3" } else { "DP4" }),
        Op::FMod | Op::FRem => vec!["MUL", "FLR", "MAD"],
        Op::SDiv | Op::UDiv => vec!["RCP", "MUL", "FLR"],
        Op::UMod | Op::SMod | Op::SRem => vec!["RCP", "MUL", "FLR", "MAD"],
        Op::FOrdLessThan | Op::FUnordLessThan | Op::FOrdGreaterThan | Op::FUnordGreaterThan => vec!["SLT"],
        Op::SLessThan | Op::ULessThan | Op::SGreaterThan | Op::UGreaterThan => vec!["SLT"],
        Op::FOrdLessThanEqual | Op::FUnordLessThanEqual => vec!["SGE"],
        Op::FOrdGreaterThanEqual | Op::FUnordGreaterThanEqual => vec!["SGE"],
        Op::SLessThanEqual | Op::ULessThanEqual | Op::SGreaterThanEqual | Op::UGreaterThanEqual => {
            vec!["SGE"]
        }
        Op::FOrdEqual | Op::FUnordEqual | Op::IEqual | Op::LogicalEqual => vec!["SGE", "SGE", "MUL"],
        Op::FOrdNotEqual | Op::FUnordNotEqual | Op::INotEqual | Op::LogicalNotEqual => {
            vec!["SLT", "SLT", "MAX"]
        }
        Op::IsNan | Op::IsInf => vec!["SGE"],
        Op::LogicalAnd => vec!["MUL"],
        Op::LogicalOr => vec!["MAX"],
        Op::All => vec!["MUL"; operand_width as usize - 1],
        Op::Any => vec!["MAX"; operand_width as usize - 1],
        Op::Select => vec!["CMP"],
        Op::ImageSampleImplicitLod | Op::ImageSampleExplicitLod | Op::ImageFetch => vec!["TEX"],
        Op::ImageSampleProjImplicitLod | Op::ImageSampleProjExplicitLod => vec!["TXP"],
        Op::ConvertSToF | Op::ConvertUToF | Op::Bitcast | Op::CopyObject | Op::UConvert => vec![],
        Op::CompositeConstruct | Op::CompositeExtract | Op::CompositeInsert | Op::VectorShuffle => vec![],
        Op::Load | Op::AccessChain | Op::InBoundsAccessChain | Op::SampledImage | Op::Image | Op::Undef => {
            vec![]
        }
        _ if is_of_bits(op) => vec!["BIT"],
        _ if has_effect(op) => vec![],
        _ => return None,
    })
}

/// The extended instructions, but roots and the like.
fn extended(
    op: GlslStd450Op,
    width: u32,
    operand_width: u32,
    in_fragment: bool,
) -> Option<Vec<&'static str>> {
    let each = |name: &'static str| vec![name; width as usize];
    Some(match op {
        GlslStd450Op::FAbs | GlslStd450Op::SAbs => vec!["ABS"],
        GlslStd450Op::Floor | GlslStd450Op::Ceil => vec!["FLR"],
        GlslStd450Op::Fract => vec!["FRC"],
        GlslStd450Op::Trunc => vec!["ABS", "FLR", "CMP"],
        GlslStd450Op::Round | GlslStd450Op::RoundEven => vec!["ADD", "FLR"],
        GlslStd450Op::FSign => vec!["SLT", "SLT", "SUB"],
        GlslStd450Op::FMin | GlslStd450Op::NMin | GlslStd450Op::SMin | GlslStd450Op::UMin => vec!["MIN"],
        GlslStd450Op::FMax | GlslStd450Op::NMax | GlslStd450Op::SMax | GlslStd450Op::UMax => vec!["MAX"],
        GlslStd450Op::FClamp | GlslStd450Op::NClamp | GlslStd450Op::SClamp | GlslStd450Op::UClamp => {
            vec!["MAX", "MIN"]
        }
        GlslStd450Op::FMix if in_fragment => vec!["LRP"],
        GlslStd450Op::FMix => vec!["SUB", "MAD"],
        GlslStd450Op::Step => vec!["SGE"],
        GlslStd450Op::Fma => vec!["MAD"],
        GlslStd450Op::Cross => vec!["XPD"],
        GlslStd450Op::Reflect => vec!["DP3", "MUL", "MAD"],
        GlslStd450Op::Exp2 => each("EX2"),
        GlslStd450Op::Log2 => each("LG2"),
        GlslStd450Op::Pow => each("POW"),
        GlslStd450Op::Sin => each("SIN"),
        GlslStd450Op::Cos => each("COS"),
        GlslStd450Op::Exp => [vec!["MUL"], each("EX2")].concat(),
        GlslStd450Op::Log => [each("LG2"), vec!["MUL"]].concat(),
        // Of a difference: SUB more.
        GlslStd450Op::Distance => vec!["SUB", if operand_width <= 3 { "DP3" } else { "DP4" }, "RSQ", "RCP"],
        GlslStd450Op::Length => vec![if operand_width <= 3 { "DP3" } else { "DP4" }, "RSQ", "RCP"],
        GlslStd450Op::Normalize => vec![if operand_width <= 3 { "DP3" } else { "DP4" }, "RSQ", "MUL"],
        // The attribute fetch does it.
        GlslStd450Op::UnpackUnorm2x16 | GlslStd450Op::UnpackSnorm2x16 | GlslStd450Op::UnpackHalf2x16 => {
            vec![]
        }
        GlslStd450Op::UnpackUnorm4x8 | GlslStd450Op::UnpackSnorm4x8 => vec![],
        _ => return None,
    })
}

fn is_of_bits(op: Op) -> bool {
    matches!(
        op,
        Op::BitwiseAnd
            | Op::BitwiseOr
            | Op::BitwiseXor
            | Op::Not
            | Op::ShiftLeftLogical
            | Op::ShiftRightLogical
            | Op::ShiftRightArithmetic
            | Op::BitCount
            | Op::BitFieldInsert
            | Op::BitFieldSExtract
            | Op::BitFieldUExtract
    )
}

/// The extended instruction of an `OpExtInst`.
pub fn extended_op(instruction: &Instruction) -> Option<GlslStd450Op> {
    (instruction.class.opcode == Op::ExtInst)
        .then(|| literals(instruction).next().and_then(GlslStd450Op::from_u32))?
}

/// Counts by the rule. What the scalar rule counts is still 0.
///
/// # Errors
/// An instruction that the tables lack.
pub fn count(specialized: &Specialized<'_>, live: &Live<'_>) -> Result<Counts, String> {
    let mut tally = Tally {
        specialized,
        live,
        patterns: patterns::find(specialized, live),
        taken: HashSet::new(),
        all: Vec::new(),
        listed: Listed::default(),
    };
    for (label, instruction) in &live.instructions {
        tally.instruction(*label, instruction)?;
    }
    tally.list_control();
    let mut mnemonics = BTreeMap::new();
    for (_, name) in &tally.all {
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

struct Tally<'s, 'a> {
    specialized: &'s Specialized<'a>,
    live: &'s Live<'a>,
    patterns: HashMap<Id, Pattern>,
    /// Reciprocals and roots that were counted.
    taken: HashSet<(&'static str, Scalar)>,
    /// Every ARB instruction with the block that it is in.
    all: Vec<(Id, &'static str)>,
    listed: Listed,
}

impl Tally<'_, '_> {
    fn add(&mut self, label: Id, names: impl IntoIterator<Item = &'static str>) {
        self.all.extend(names.into_iter().map(|name| (label, name)));
    }

    fn instruction(&mut self, label: Id, instruction: &Instruction) -> Result<(), String> {
        let op = instruction.class.opcode;
        self.list(instruction);
        let Some(id) = instruction.result_id else { return Ok(()) };
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
            Op::LogicalNot => {
                let turned =
                    first.and_then(|operand| self.specialized.instruction(self.specialized.resolve(operand)));
                if !turned.is_some_and(|turned| is_comparison(turned.class.opcode)) && !self.only_discards(id)
                {
                    self.add(label, ["SUB"]);
                }
            }
            Op::ConvertFToS | Op::ConvertFToU => {
                let source =
                    first.and_then(|operand| self.specialized.instruction(self.specialized.resolve(operand)));
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
                let names = simple(op, width, operand_width).ok_or_else(|| {
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
                let names = extended(op, width, operand_width, in_fragment)
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

    /// Lists loads and stores.
    fn list(&mut self, instruction: &Instruction) {
        let op = instruction.class.opcode;
        let pointer = ids(instruction).next().unwrap_or_default();
        match op {
            Op::Load => {
                let (variable, _) = self.specialized.place(pointer);
                let class = self.specialized.module.variables.get(&variable);
                self.listed.loads += u32::from(class == Some(&StorageClass::StorageBuffer));
            }
            Op::Store => {
                self.listed.stores += 1;
                let stored = ids(instruction).nth(1).unwrap_or_default();
                let mut copied: Vec<Option<(Id, u32)>> = Vec::new();
                for scalar in self.specialized.scalars(stored) {
                    let source = match scalar {
                        Scalar::Known(_) => None,
                        Scalar::At(variable, vector, _) => Some((variable, vector)),
                        Scalar::Of(id, _) => match self.specialized.instruction(id).map(|i| i.class.opcode) {
                            Some(Op::Load) => Some((id, u32::MAX)),
                            _ => continue,
                        },
                    };
                    if !copied.contains(&source) {
                        copied.push(source);
                    }
                }
                self.listed.moves += copied.len() as u32;
            }
            _ => {}
        }
    }

    /// Lists discards and loops.
    fn list_control(&mut self) {
        for block in self.specialized.blocks() {
            let kills = matches!(block.terminator.class.opcode, Op::Kill | Op::TerminateInvocation);
            self.listed.kills += u32::from(kills);
            self.listed.loops += u32::from(block.is_loop);
        }
    }

    /// Instructions along the longest way from the start to an end; loops once.
    fn longest_path(&self) -> u32 {
        let mut own: HashMap<Id, u32> = HashMap::new();
        for (label, _) in &self.all {
            *own.entry(*label).or_default() += 1;
        }
        let blocks: Vec<_> = self.specialized.blocks().collect();
        let mut to_start: HashMap<Id, u32> = HashMap::new();
        let mut longest = 0;
        // In order: a block comes after all that lead to it, but for the edges that lead back.
        for block in blocks {
            let before = to_start.get(&block.label).copied().unwrap_or_default();
            let here = before + own.get(&block.label).copied().unwrap_or_default();
            longest = longest.max(here);
            for next in self.specialized.successors(block) {
                let known = to_start.entry(next).or_default();
                *known = (*known).max(here);
            }
        }
        longest
    }
}

/// Whether it computes, so that it is worth listing among addresses.
fn is_arithmetic(op: Op) -> bool {
    matches!(
        op,
        Op::IAdd
            | Op::ISub
            | Op::IMul
            | Op::UDiv
            | Op::UMod
            | Op::Select
            | Op::ShiftRightLogical
            | Op::ShiftLeftLogical
            | Op::ConvertFToS
            | Op::ConvertFToU
    )
}

/// Whether it answers with a truth value of a comparison.
fn is_comparison(op: Op) -> bool {
    matches!(simple(op, 1, 1).as_deref(), Some(["SLT" | "SGE", ..]))
}
