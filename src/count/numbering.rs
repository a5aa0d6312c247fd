//! Where each scalar of a value comes from, seen through whatever only moves scalars; and values that are computed twice.
//!
//! Programs without branches compute nothing twice, so that equal operations on equal scalars count once, wherever they
//! stand. Moves, swizzles and vectors put together cost nothing there: registers have write masks.

use std::collections::HashMap;

use rspirv::{
    dr::Instruction,
    spirv::{Op, StorageClass},
};

use super::{
    module::{Id, ids, literals},
    specialize::Specialized,
    types::Type,
};

/// A scalar.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Scalar {
    /// A constant.
    Known(u32),
    /// One of those that an instruction computes.
    Of(Id, u32),
    /// One of those of an input or a uniform: the variable, the first scalar of the vector that it is in, and which of
    /// that it is.
    At(Id, u32, u32),
}

impl Scalar {
    /// The owner of the whole vector: an instruction's result, or a place in a variable. `None` for a constant, which can be
    /// in any register.
    pub fn register(self) -> Option<(Id, u32)> {
        match self {
            Self::Known(_) => None,
            Self::Of(id, _) => Some((id, u32::MAX)),
            Self::At(variable, first, _) => Some((variable, first)),
        }
    }
}

impl Specialized<'_> {
    /// All scalars of a value.
    pub fn scalars(&self, id: Id) -> Vec<Scalar> {
        (0..self.module.width_of(self.resolve(id))).map(|i| self.scalar(id, i)).collect()
    }

    /// One scalar of a value.
    pub fn scalar(&self, id: Id, index: u32) -> Scalar {
        let id = self.resolve(id);
        if let Some(known) = self.known(id) {
            // A null constant of an unknown width has one scalar for all.
            return Scalar::Known(known.get(index as usize).or(known.first()).copied().unwrap_or_default());
        }
        self.moved_from(id, index).unwrap_or(Scalar::Of(id, index))
    }

    /// Where a scalar comes from, where it was only moved.
    fn moved_from(&self, id: Id, mut index: u32) -> Option<Scalar> {
        let instruction = self.instruction(id)?;
        let operands: Vec<Id> = ids(instruction).collect();
        match instruction.class.opcode {
            Op::Load => self.in_variable(*operands.first()?, index),
            Op::CompositeConstruct => {
                for part in operands {
                    let width = self.module.width_of(part);
                    if index < width {
                        return Some(self.scalar(part, index));
                    }
                    index -= width;
                }
                None
            }
            Op::CompositeExtract => {
                let composite = *operands.first()?;
                Some(self.scalar(composite, index + self.module.offset(composite, literals(instruction))?))
            }
            Op::CompositeInsert => {
                let [part, composite] = operands[..] else { return None };
                let first = self.module.offset(composite, literals(instruction))?;
                match index.checked_sub(first).filter(|i| *i < self.module.width_of(part)) {
                    Some(inside) => Some(self.scalar(part, inside)),
                    None => Some(self.scalar(composite, index)),
                }
            }
            Op::VectorShuffle => {
                let [a, b] = operands[..] else { return None };
                let width = self.module.width_of(a);
                match literals(instruction).nth(index as usize)? {
                    // Any will do.
                    u32::MAX => Some(Scalar::Known(0)),
                    from if from < width => Some(self.scalar(a, from)),
                    from => Some(self.scalar(b, from - width)),
                }
            }
            _ => None,
        }
    }

    /// A scalar behind a pointer to an input or a uniform, where its place is constant.
    fn in_variable(&self, pointer: Id, index: u32) -> Option<Scalar> {
        let (variable, path) = self.place(pointer);
        let class = self.module.variables.get(&variable)?;
        if !matches!(class, StorageClass::Input | StorageClass::PushConstant | StorageClass::Uniform) {
            return None;
        }
        let Type::Pointer { pointee: mut type_ } =
            *self.module.types.get(self.module.type_of.get(&variable)?)?
        else {
            return None;
        };
        let (mut vector, mut inside) = (0, index);
        for step in path {
            let Scalar::Known(step) = step else { return None };
            let is_vector = matches!(self.module.types.get(&type_), Some(Type::Vector { .. }));
            let (part, offset) = self.module.part(type_, step)?;
            match is_vector {
                true => inside = offset,
                false => vector += offset,
            }
            type_ = part;
        }
        Some(Scalar::At(variable, vector, inside))
    }

    /// The variable, and which of its parts, that a pointer points to.
    pub fn place(&self, pointer: Id) -> (Id, Vec<Scalar>) {
        let pointer = self.resolve(pointer);
        match self.instruction(pointer) {
            Some(chain) if matches!(chain.class.opcode, Op::AccessChain | Op::InBoundsAccessChain) => {
                let mut operands = ids(chain);
                let (variable, mut path) = self.place(operands.next().unwrap_or_default());
                path.extend(operands.map(|index| self.scalar(index, 0)));
                (variable, path)
            }
            _ => (pointer, Vec::new()),
        }
    }
}

/// Whether an instruction does something beside giving a result.
pub fn has_effect(op: Op) -> bool {
    matches!(op, Op::Store | Op::ImageWrite | Op::ControlBarrier | Op::MemoryBarrier)
        || format!("{op:?}").starts_with("Atomic")
}

/// Whether an instruction only computes: the same operands give the same result.
fn is_pure(specialized: &Specialized<'_>, instruction: &Instruction) -> bool {
    match instruction.class.opcode {
        Op::Phi | Op::Undef | Op::Variable => false,
        Op::Load => ids(instruction).next().is_some_and(|pointer| {
            let (variable, _) = specialized.place(pointer);
            match specialized.module.variables.get(&variable) {
                Some(StorageClass::StorageBuffer) => !specialized.module.written.contains(&variable),
                Some(class) => matches!(
                    class,
                    StorageClass::Input
                        | StorageClass::PushConstant
                        | StorageClass::Uniform
                        | StorageClass::UniformConstant
                ),
                None => false,
            }
        }),
        op => !has_effect(op) && op != Op::ImageRead,
    }
}

#[derive(PartialEq, Eq, Hash)]
enum Operand {
    Scalars(Vec<Scalar>),
    Place(Id, Vec<Scalar>),
    Opaque(Id),
}

/// A computation: the operation, its type, its literal numbers and its operands.
type Computation = (Op, Option<Id>, Vec<u32>, Vec<Operand>);

/// Makes each value that repeats an earlier one stand for it.
pub fn share_equal_values(specialized: &mut Specialized<'_>) {
    let mut seen: HashMap<Computation, Id> = HashMap::new();
    let blocks: Vec<_> = specialized.blocks().collect();
    for block in blocks {
        for instruction in &block.body {
            let Some(id) = instruction.result_id else { continue };
            if specialized.resolve(id) != id
                || specialized.known(id).is_some()
                || !is_pure(specialized, instruction)
            {
                continue;
            }
            let operand = |operand: Id| {
                let type_ = specialized.module.type_of.get(&operand);
                match type_.and_then(|type_| specialized.module.types.get(type_)) {
                    Some(Type::Pointer { .. }) => {
                        let (variable, path) = specialized.place(operand);
                        Operand::Place(variable, path)
                    }
                    Some(Type::Opaque | Type::Texels) | None => Operand::Opaque(specialized.resolve(operand)),
                    Some(_) => Operand::Scalars(specialized.scalars(operand)),
                }
            };
            let operands = ids(instruction).map(operand).collect();
            let key = (
                instruction.class.opcode,
                instruction.result_type,
                literals(instruction).collect(),
                operands,
            );
            match seen.get(&key) {
                Some(first) => specialized.set_same(id, *first),
                None => {
                    seen.insert(key, id);
                }
            }
        }
    }
}
