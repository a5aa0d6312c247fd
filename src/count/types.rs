//! The types of a module, and where their parts are.

use rspirv::{
    dr::{Instruction, Operand},
    spirv::{Dim, Op},
};

use super::module::{Id, Module, ids, literals};

/// The types that matter here.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Type {
    Bool,
    Int,
    Float,
    Vector {
        component: Id,
        count: u32,
    },
    Matrix {
        column: Id,
        count: u32,
    },
    Array {
        element: Id,
        count: u32,
    },
    Struct(Vec<Id>),
    Pointer {
        pointee: Id,
    },
    /// Texels of a buffer.
    Texels,
    /// Images, samplers and the like.
    Opaque,
}

impl Module {
    /// The type that an instruction declares, if it declares one.
    pub(super) fn declared_type(&self, instruction: &Instruction) -> Option<Type> {
        let mut operands = ids(instruction);
        let mut operand = || operands.next().unwrap_or_default();
        let count = literals(instruction).next().unwrap_or(1);
        Some(match instruction.class.opcode {
            Op::TypeBool => Type::Bool,
            Op::TypeInt => Type::Int,
            Op::TypeFloat => Type::Float,
            Op::TypeVector => Type::Vector { component: operand(), count },
            Op::TypeMatrix => Type::Matrix { column: operand(), count },
            Op::TypeArray => {
                let (element, length) = (operand(), operand());
                let length = self.constants.get(&length).and_then(|length| length.first().copied());
                Type::Array { element, count: length.unwrap_or(1) }
            }
            Op::TypeRuntimeArray => Type::Array { element: operand(), count: 1 },
            Op::TypeStruct => Type::Struct(ids(instruction).collect()),
            Op::TypePointer => Type::Pointer { pointee: operand() },
            Op::TypeImage if instruction.operands.contains(&Operand::Dim(Dim::DimBuffer)) => Type::Texels,
            Op::TypeVoid | Op::TypeFunction | Op::TypeImage | Op::TypeSampler | Op::TypeSampledImage => {
                Type::Opaque
            }
            _ => return None,
        })
    }

    /// Scalars of a type; 1 for what has none.
    pub fn width(&self, type_: Id) -> u32 {
        match self.types.get(&type_) {
            Some(Type::Vector { count, .. }) => *count,
            Some(Type::Matrix { column, count }) => count * self.width(*column),
            Some(Type::Array { element, count }) => count * self.width(*element),
            Some(Type::Struct(members)) => members.iter().map(|member| self.width(*member)).sum(),
            _ => 1,
        }
    }

    /// Scalars of a value.
    pub fn width_of(&self, id: Id) -> u32 {
        self.type_of.get(&id).map_or(1, |type_| self.width(*type_))
    }

    /// The first scalar of the part of a composite that these indices name.
    pub fn offset(&self, composite: Id, indices: impl Iterator<Item = u32>) -> Option<u32> {
        let mut type_ = *self.type_of.get(&composite)?;
        let mut first = 0;
        for index in indices {
            let (part, offset) = self.part(type_, index)?;
            (type_, first) = (part, first + offset);
        }
        Some(first)
    }

    /// The type of a part of a composite, and its first scalar.
    pub fn part(&self, type_: Id, index: u32) -> Option<(Id, u32)> {
        match self.types.get(&type_)? {
            Type::Vector { component, .. } => Some((*component, index)),
            Type::Matrix { column: part, .. } | Type::Array { element: part, .. } => {
                Some((*part, index * self.width(*part)))
            }
            Type::Struct(members) => {
                let before = members.iter().take(index as usize).map(|member| self.width(*member)).sum();
                Some((*members.get(index as usize)?, before))
            }
            _ => None,
        }
    }
}
