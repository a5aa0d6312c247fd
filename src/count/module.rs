//! A module as rspirv parses it, arranged for counting: constants with their values, the blocks of its one function.
//!
//! Its parts (`reader`, `types`, `fold`, `specialize`, `numbering`) work on the module and are called by it, and so name each other.

use std::collections::{HashMap, HashSet};

use rspirv::{
    dr::{Instruction, Operand},
    spirv::{ExecutionModel, Op, StorageClass},
};

use super::{
    fold,
    numbering::has_effect,
    reader::{instructions, spec_id},
    types::Type,
};

/// An id of SPIR-V.
pub type Id = u32;

/// A basic block.
#[derive(Debug)]
pub struct Block {
    pub label: Id,
    /// All but label, merge instruction and terminator.
    pub body: Vec<Instruction>,
    /// Where a selection or loop that starts here ends.
    pub merge: Option<Id>,
    pub is_loop: bool,
    pub terminator: Instruction,
}

/// A whole shader.
pub struct Module {
    pub stage: ExecutionModel,
    pub types: HashMap<Id, Type>,
    /// Constants: their scalars in order, as 32-bit patterns.
    pub constants: HashMap<Id, Vec<u32>>,
    /// Variables and their storage classes.
    pub variables: HashMap<Id, StorageClass>,
    /// The variables that are stored to, or to a part of which a pointer was made that is.
    pub written: HashSet<Id>,
    /// The type of each result.
    pub type_of: HashMap<Id, Id>,
    pub blocks: Vec<Block>,
    /// File (a string's id) and line of each result, where the compiler kept them.
    pub lines: HashMap<Id, (Id, u32)>,
    /// Strings: names of files.
    pub strings: HashMap<Id, String>,
}

/// The ids among the operands, in order.
pub fn ids(instruction: &Instruction) -> impl Iterator<Item = Id> {
    instruction.operands.iter().filter_map(|operand| match operand {
        Operand::IdRef(id) => Some(*id),
        _ => None,
    })
}

/// The literal numbers among the operands, in order.
pub fn literals(instruction: &Instruction) -> impl Iterator<Item = u32> {
    instruction.operands.iter().filter_map(|operand| match operand {
        Operand::LiteralBit32(number) | Operand::LiteralExtInstInteger(number) => Some(*number),
        _ => None,
    })
}

impl Module {
    /// Parses a module and gives its specialization constants these values.
    pub fn parse(spirv: &[u32], specialization: &[(u32, u32)]) -> Result<Self, String> {
        let mut module = Self {
            stage: ExecutionModel::GLCompute,
            types: HashMap::new(),
            constants: HashMap::new(),
            variables: HashMap::new(),
            written: HashSet::new(),
            type_of: HashMap::new(),
            blocks: Vec::new(),
            lines: HashMap::new(),
            strings: HashMap::new(),
        };
        let mut spec_ids = HashMap::new();
        let mut rest = instructions(spirv)?.into_iter();
        for instruction in rest.by_ref() {
            match (instruction.class.opcode, instruction.operands.as_slice()) {
                (Op::Function, _) => break,
                (Op::EntryPoint, [Operand::ExecutionModel(stage), ..]) => module.stage = *stage,
                (Op::String, [Operand::LiteralString(text)]) => {
                    module.strings.extend(instruction.result_id.map(|id| (id, text.clone())));
                }
                (Op::Decorate, _) => spec_ids.extend(spec_id(&instruction)),
                _ => module.global(&instruction, &spec_ids, specialization)?,
            }
        }
        module.function(rest)?;
        module.find_written();
        Ok(module)
    }

    fn global(
        &mut self,
        instruction: &Instruction,
        spec_ids: &HashMap<Id, u32>,
        specialization: &[(u32, u32)],
    ) -> Result<(), String> {
        let Some(id) = instruction.result_id else { return Ok(()) };
        if let Some(type_) = instruction.result_type {
            self.type_of.insert(id, type_);
        }
        let given = || {
            let number = spec_ids.get(&id)?;
            specialization.iter().find(|(constant, _)| constant == number).map(|(_, value)| *value)
        };
        if let Some(type_) = self.declared_type(instruction) {
            self.types.insert(id, type_);
            return Ok(());
        }
        let mut literal = literals(instruction);
        let value = match instruction.class.opcode {
            Op::Variable => {
                if let Some(Operand::StorageClass(class)) = instruction.operands.first() {
                    self.variables.insert(id, *class);
                }
                return Ok(());
            }
            Op::Constant => vec![literal.next().unwrap_or_default()],
            Op::ConstantTrue => vec![1],
            Op::ConstantFalse => vec![0],
            Op::SpecConstant => vec![given().or(literal.next()).unwrap_or_default()],
            Op::SpecConstantTrue => vec![given().unwrap_or(1)],
            Op::SpecConstantFalse => vec![given().unwrap_or(0)],
            Op::ConstantNull => vec![0; self.width(instruction.result_type.unwrap_or_default()) as usize],
            Op::ConstantComposite | Op::SpecConstantComposite => {
                ids(instruction).filter_map(|id| self.constants.get(&id)).flatten().copied().collect()
            }
            Op::SpecConstantOp => {
                let folded = fold::constant_operation(self, instruction);
                folded.ok_or_else(|| format!("%{id}: a constant expression that can't be evaluated"))?
            }
            // Names, imports and constants without a value, which stay unknown.
            _ => return Ok(()),
        };
        self.constants.insert(id, value);
        Ok(())
    }

    fn function(&mut self, instructions: impl Iterator<Item = Instruction>) -> Result<(), String> {
        let mut open: Option<Block> = None;
        let mut line: Option<(Id, u32)> = None;
        for instruction in instructions {
            self.lines.extend(instruction.result_id.zip(line));
            if let (Some(id), Some(type_)) = (instruction.result_id, instruction.result_type) {
                self.type_of.insert(id, type_);
            }
            match instruction.class.opcode {
                Op::Label => {
                    line = None; // holds to the end of a block
                    let label = instruction.result_id.unwrap_or_default();
                    let terminator = instruction;
                    open = Some(Block { label, body: Vec::new(), merge: None, is_loop: false, terminator });
                }
                Op::SelectionMerge | Op::LoopMerge => {
                    if let Some(block) = &mut open {
                        block.merge = ids(&instruction).next();
                        block.is_loop = instruction.class.opcode == Op::LoopMerge;
                    }
                }
                Op::Branch
                | Op::BranchConditional
                | Op::Switch
                | Op::Return
                | Op::Kill
                | Op::TerminateInvocation
                | Op::Unreachable => {
                    if let Some(mut block) = open.take() {
                        block.terminator = instruction;
                        self.blocks.push(block);
                    }
                }
                Op::Function | Op::FunctionCall => {
                    return Err("a call was not inlined: only one function can be counted".to_owned());
                }
                Op::Line => line = ids(&instruction).next().zip(literals(&instruction).next()),
                Op::NoLine => line = None,
                Op::FunctionEnd | Op::Nop => {}
                _ => {
                    if let Some(block) = &mut open {
                        block.body.push(instruction);
                    }
                }
            }
        }
        match self.blocks.is_empty() {
            true => Err("no function".to_owned()),
            false => Ok(()),
        }
    }

    fn find_written(&mut self) {
        let all = || self.blocks.iter().flat_map(|block| &block.body);
        let base = |pointer: Id| {
            let chain = all().find(|instruction| instruction.result_id == Some(pointer));
            chain.and_then(|chain| ids(chain).next()).unwrap_or(pointer)
        };
        let writes = all().filter(|instruction| has_effect(instruction.class.opcode));
        self.written = writes.filter_map(|write| ids(write).next()).map(base).collect();
    }
}
