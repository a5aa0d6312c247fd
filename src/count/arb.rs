//! The rule of the paper-comparable count: what an operation takes in `ARB_vertex_program` and `ARB_fragment_program`.
//!
//! The instructions are ABS ADD CMP COS DP3 DP4 DPH DST EX2 FLR FRC KIL LG2 LIT LRP MAD MAX MIN MOV MUL POW RCP RSQ SCS SGE
//! SIN SLT SUB SWZ TEX TXB TXP XPD; each takes up to four components and counts 1. Swizzles, negated operands, write masks
//! and (in fragment programs) saturation are free. Guennebaud et al. 2006, section 7, do not count the moves that copy
//! attributes; section 3.2 leaves fragments to the alpha test and their sums to blending. So moves, loads, stores and the
//! discards that stand for the alpha test are listed beside the count.
//!
//! Differences in how SPIR-V says the same:
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

use rspirv::{
    dr::Instruction,
    spirv::{GlslStd450Op, Op},
};

use super::{module::literals, numbering::has_effect};

/// The instructions of operations that need no look around. `width` is that of the result, `operand_width` that of the operand.
pub fn simple(op: Op, width: u32, operand_width: u32) -> Option<Vec<&'static str>> {
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
        Op::ImageSampleImplicitLod | Op::ImageSampleExplicitLod | Op::ImageFetch | Op::ImageRead => {
            vec!["TEX"]
        }
        Op::ImageSampleProjImplicitLod | Op::ImageSampleProjExplicitLod => vec!["TXP"],
        Op::ConvertSToF | Op::ConvertUToF | Op::Bitcast | Op::UConvert => vec![],
        Op::CopyObject | Op::CopyLogical => vec![],
        Op::CompositeConstruct | Op::CompositeExtract | Op::CompositeInsert | Op::VectorShuffle => vec![],
        // What a descriptor tells is there.
        Op::ArrayLength | Op::ImageQuerySizeLod => vec![],
        Op::Variable
        | Op::Load
        | Op::AccessChain
        | Op::InBoundsAccessChain
        | Op::SampledImage
        | Op::Image
        | Op::Undef => {
            vec![]
        }
        _ if is_of_bits(op) => vec!["BIT"],
        _ if has_effect(op) => vec![],
        _ => return None,
    })
}

/// The extended instructions, but roots and the like.
pub fn extended(
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
        GlslStd450Op::FindILsb => vec!["BIT"],
        GlslStd450Op::UnpackUnorm4x8 | GlslStd450Op::UnpackSnorm4x8 => vec![],
        _ => return None,
    })
}

/// Whether it works on bits or hands values from one invocation to another, which ARB has not.
pub fn is_of_bits(op: Op) -> bool {
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
            | Op::GroupNonUniformBallot
            | Op::GroupNonUniformShuffle
            | Op::GroupNonUniformAny
    )
}

/// The extended instruction of an `OpExtInst`.
pub fn extended_op(instruction: &Instruction) -> Option<GlslStd450Op> {
    (instruction.class.opcode == Op::ExtInst)
        .then(|| literals(instruction).next().and_then(GlslStd450Op::from_u32))?
}

/// Whether it computes, so that it is worth listing among addresses.
pub fn is_arithmetic(op: Op) -> bool {
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
pub fn is_comparison(op: Op) -> bool {
    matches!(simple(op, 1, 1).as_deref(), Some(["SLT" | "SGE", ..]))
}
