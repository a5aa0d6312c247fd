//! The rule of the scalar count: each operation times its components, as a scalar processor without fused operations has it.
//!
//! - sums, products, quotients, comparisons, logic, selections, conversions, operations on bits: one a component
//! - a dot product of n components: n products and n - 1 sums
//! - a matrix with r rows and c columns times a vector: r (2c - 1)
//! - a cross product: 9. A length: 2n. A normalized vector: 3n. A mix: 3n. A clamp: 2n. A fused product and sum: 2n
//! - every other function: one a component
//! - what a branch chooses: one a component for each alternative more
//!
//! Moves, loads, stores and texture fetches are no arithmetic; a negated operand is free.

use rspirv::spirv::{GlslStd450Op, Op};

use super::{
    arb::extended_op,
    live::Live,
    module::{Id, ids},
    specialize::Specialized,
};

/// Counts by the rule.
///
/// # Errors
/// An extended instruction of an unknown set.
pub fn count(specialized: &Specialized<'_>, live: &Live<'_>) -> Result<u32, String> {
    let mut total = 0;
    for (_, instruction) in &live.instructions {
        let Some(id) = instruction.result_id else { continue };
        let op = instruction.class.opcode;
        let width = specialized.module.width_of(id);
        let first: Option<Id> = ids(instruction).nth(usize::from(op == Op::ExtInst));
        let operand_width = first.map_or(1, |operand| specialized.module.width_of(operand));
        total += match op {
            Op::Load
            | Op::Variable
            | Op::AccessChain
            | Op::InBoundsAccessChain
            | Op::Undef
            | Op::SampledImage
            | Op::ArrayLength
            | Op::ImageQuerySizeLod
            | Op::Image
            | Op::Bitcast
            | Op::FNegate
            | Op::SNegate
            | Op::CopyObject
            | Op::CopyLogical
            | Op::CompositeConstruct
            | Op::CompositeExtract
            | Op::CompositeInsert
            | Op::VectorShuffle
            | Op::ImageFetch
            | Op::ImageRead
            | Op::ImageSampleImplicitLod
            | Op::ImageSampleExplicitLod
            | Op::ImageSampleProjImplicitLod
            | Op::ImageSampleProjExplicitLod => 0,
            Op::Dot => 2 * operand_width - 1,
            Op::MatrixTimesVector => 2 * operand_width - width,
            Op::VectorTimesMatrix => width * (2 * operand_width - 1),
            Op::All | Op::Any => operand_width - 1,
            Op::Phi => {
                let mut chosen = specialized.incoming(instruction);
                chosen.sort_unstable();
                chosen.dedup();
                width * (chosen.len() as u32).saturating_sub(1)
            }
            Op::ExtInst => {
                let op = extended_op(instruction)
                    .ok_or_else(|| "an extended instruction of an unknown set".to_owned())?;
                match op {
                    GlslStd450Op::Cross => 9,
                    GlslStd450Op::Length => 2 * operand_width,
                    GlslStd450Op::Distance => 3 * operand_width,
                    GlslStd450Op::Normalize | GlslStd450Op::FMix => 3 * width,
                    GlslStd450Op::FClamp
                    | GlslStd450Op::NClamp
                    | GlslStd450Op::SClamp
                    | GlslStd450Op::UClamp
                    | GlslStd450Op::Fma => 2 * width,
                    _ => width,
                }
            }
            _ => width,
        };
    }
    Ok(total)
}
