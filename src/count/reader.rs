//! A module's instructions through rspirv. Its own loader refuses `OpExecutionModeId`, which compute shaders have in SPIR-V
//! 1.6; its parser does not.

use rspirv::{
    binary::{Consumer, ParseAction, parse_words},
    dr::{Instruction, ModuleHeader, Operand},
    spirv::{Decoration, Op},
};

use super::module::Id;

#[derive(Default)]
struct Collector(Vec<Instruction>);

impl Consumer for Collector {
    fn initialize(&mut self) -> ParseAction {
        ParseAction::Continue
    }

    fn finalize(&mut self) -> ParseAction {
        ParseAction::Continue
    }

    fn consume_header(&mut self, _: ModuleHeader) -> ParseAction {
        ParseAction::Continue
    }

    fn consume_instruction(&mut self, instruction: Instruction) -> ParseAction {
        self.0.push(instruction);
        ParseAction::Continue
    }
}

/// The numbers of a module's specialization constants.
pub fn constant_numbers(spirv: &[u32]) -> Result<Vec<u32>, String> {
    let numbers = instructions(spirv)?.into_iter().filter_map(|instruction| spec_id(&instruction));
    Ok(numbers.map(|(_, number)| number).collect())
}

/// The instructions of a module, in order.
pub fn instructions(spirv: &[u32]) -> Result<Vec<Instruction>, String> {
    let mut all = Collector::default();
    parse_words(spirv, &mut all).map_err(|state| format!("not SPIR-V: {state}"))?;
    Ok(all.0)
}

/// The constant that an instruction makes one of specialization, and its number.
pub fn spec_id(instruction: &Instruction) -> Option<(Id, u32)> {
    match (instruction.class.opcode, instruction.operands.as_slice()) {
        (
            Op::Decorate,
            [Operand::IdRef(id), Operand::Decoration(Decoration::SpecId), Operand::LiteralBit32(number)],
        ) => Some((*id, *number)),
        _ => None,
    }
}
