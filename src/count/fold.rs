//! Constant folding: an operation on constants, scalar by scalar, in f32 and 32-bit integers as SPIR-V defines it.

use rspirv::{
    dr::{Instruction, Operand},
    spirv::{GlslStd450Op, Op},
};

use super::module::{Id, Module, ids, literals};

/// The value of an `OpSpecConstantOp`.
pub fn constant_operation(module: &Module, instruction: &Instruction) -> Option<Vec<u32>> {
    let Some(Operand::LiteralSpecConstantOpInteger(op)) = instruction.operands.first() else { return None };
    let operands: Vec<&[u32]> =
        ids(instruction).map(|id| module.constants.get(&id).map(Vec::as_slice)).collect::<Option<_>>()?;
    let first_operand = ids(instruction).next()?;
    operation(module, *op, instruction, first_operand, &operands)
}

/// The value of an instruction all of whose operands are constants.
pub fn operation(
    module: &Module,
    op: Op,
    instruction: &Instruction,
    first_operand: Id,
    operands: &[&[u32]],
) -> Option<Vec<u32>> {
    let width = module.width(instruction.result_type?) as usize;
    match op {
        Op::CompositeConstruct => return Some(operands.concat()),
        Op::CompositeExtract => {
            let first = module.offset(first_operand, literals(instruction))? as usize;
            return operands.first()?.get(first..first + width).map(<[u32]>::to_vec);
        }
        Op::VectorShuffle => {
            let both = operands.concat();
            return literals(instruction).map(|index| both.get(index as usize).copied()).collect();
        }
        Op::Select => {
            let [condition, yes, no] = operands else { return None };
            let chosen = |i: usize| match condition.get(i).or(condition.first()) {
                Some(0) => no.get(i).copied(),
                _ => yes.get(i).copied(),
            };
            return (0..width).map(chosen).collect();
        }
        Op::Dot => {
            let [a, b] = operands else { return None };
            let products = a.iter().zip(*b).map(|(a, b)| f32::from_bits(*a) * f32::from_bits(*b));
            return Some(vec![products.sum::<f32>().to_bits()]);
        }
        Op::Any => return Some(vec![u32::from(operands.first()?.iter().any(|bit| *bit != 0))]),
        Op::All => return Some(vec![u32::from(operands.first()?.iter().all(|bit| *bit != 0))]),
        _ => {}
    }
    let scalar = |i: usize| -> Option<u32> {
        // A scalar beside a vector counts for each component.
        let operand = |n: usize| -> Option<u32> {
            let values = operands.get(n)?;
            values.get(i).or(values.first().filter(|_| values.len() == 1)).copied()
        };
        match op {
            Op::ExtInst => extended(literals(instruction).next()?, [operand(0), operand(1), operand(2)]),
            _ => scalar_operation(op, operand(0)?, operand(1)),
        }
    };
    (0..width).map(scalar).collect()
}

fn scalar_operation(op: Op, a: u32, b: Option<u32>) -> Option<u32> {
    let (x, y) = (f32::from_bits(a), b.map(f32::from_bits));
    let truth = |value: bool| Some(u32::from(value));
    match op {
        Op::FNegate => return Some((-x).to_bits()),
        Op::SNegate => return Some(a.wrapping_neg()),
        Op::Not => return Some(!a),
        Op::LogicalNot => return truth(a == 0),
        Op::ConvertFToS => return Some(x as i32 as u32),
        Op::ConvertFToU => return Some(x as u32),
        Op::ConvertSToF => return Some((a as i32 as f32).to_bits()),
        Op::ConvertUToF => return Some((a as f32).to_bits()),
        Op::Bitcast | Op::CopyObject => return Some(a),
        _ => {}
    }
    let (b, y) = (b?, y?);
    match op {
        Op::FAdd => Some((x + y).to_bits()),
        Op::FSub => Some((x - y).to_bits()),
        Op::FMul | Op::VectorTimesScalar => Some((x * y).to_bits()),
        Op::FDiv => Some((x / y).to_bits()),
        Op::IAdd => Some(a.wrapping_add(b)),
        Op::ISub => Some(a.wrapping_sub(b)),
        Op::IMul => Some(a.wrapping_mul(b)),
        Op::UDiv => a.checked_div(b),
        Op::UMod => a.checked_rem(b),
        Op::SDiv => (a as i32).checked_div(b as i32).map(|value| value as u32),
        Op::BitwiseAnd => Some(a & b),
        Op::BitwiseOr => Some(a | b),
        Op::BitwiseXor => Some(a ^ b),
        Op::ShiftLeftLogical => a.checked_shl(b),
        Op::ShiftRightLogical => a.checked_shr(b),
        Op::IEqual | Op::LogicalEqual => truth(a == b),
        Op::INotEqual | Op::LogicalNotEqual => truth(a != b),
        Op::LogicalAnd => truth(a != 0 && b != 0),
        Op::LogicalOr => truth(a != 0 || b != 0),
        Op::ULessThan => truth(a < b),
        Op::ULessThanEqual => truth(a <= b),
        Op::UGreaterThan => truth(a > b),
        Op::UGreaterThanEqual => truth(a >= b),
        Op::SLessThan => truth((a as i32) < b as i32),
        Op::SLessThanEqual => truth(a as i32 <= b as i32),
        Op::SGreaterThan => truth(a as i32 > b as i32),
        Op::SGreaterThanEqual => truth(a as i32 >= b as i32),
        Op::FOrdEqual => truth(x == y),
        Op::FOrdLessThan => truth(x < y),
        Op::FOrdLessThanEqual => truth(x <= y),
        Op::FOrdGreaterThan => truth(x > y),
        Op::FOrdGreaterThanEqual => truth(x >= y),
        Op::FUnordNotEqual => truth(x != y),
        _ => None,
    }
}

fn extended(number: u32, operands: [Option<u32>; 3]) -> Option<u32> {
    let [x, y, z] = operands.map(|bits| bits.map(f32::from_bits));
    let x = x?;
    let value = match GlslStd450Op::from_u32(number)? {
        GlslStd450Op::FAbs => x.abs(),
        GlslStd450Op::Floor => x.floor(),
        GlslStd450Op::Ceil => x.ceil(),
        GlslStd450Op::Sqrt => x.sqrt(),
        GlslStd450Op::InverseSqrt => 1.0 / x.sqrt(),
        GlslStd450Op::Exp2 => x.exp2(),
        GlslStd450Op::FMin => x.min(y?),
        GlslStd450Op::FMax => x.max(y?),
        GlslStd450Op::FClamp => x.max(y?).min(z?),
        _ => return None,
    };
    Some(value.to_bits())
}
