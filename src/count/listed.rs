//! The instructions listed beside the count, and the longest path.

use std::collections::HashMap;

use rspirv::{
    dr::Instruction,
    spirv::{Op, StorageClass},
};

use super::{
    module::{Id, ids},
    numbering::Scalar,
    tally::Tally,
    types::Type,
};

impl Tally<'_, '_> {
    /// Lists loads and stores.
    pub fn list(&mut self, instruction: &Instruction) {
        let op = instruction.class.opcode;
        let pointer = ids(instruction).next().unwrap_or_default();
        match op {
            Op::Load => {
                let (variable, _) = self.specialized.place(pointer);
                let class = self.specialized.module.variables.get(&variable);
                self.listed.loads += u32::from(class == Some(&StorageClass::StorageBuffer));
            }
            Op::ImageFetch => {
                let module = self.specialized.module;
                let fetched = module.type_of.get(&pointer).and_then(|of| module.types.get(of));
                self.listed.loads += u32::from(fetched == Some(&Type::Texels));
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
    pub fn list_control(&mut self) {
        for block in self.specialized.blocks() {
            let kills = matches!(block.terminator.class.opcode, Op::Kill | Op::TerminateInvocation);
            self.listed.kills += u32::from(kills);
            self.listed.loops += u32::from(block.is_loop);
        }
    }

    /// Instructions along the longest way from the start to an end; loops once.
    pub fn longest_path(&self) -> u32 {
        let mut own: HashMap<Id, u32> = HashMap::new();
        for counted in &self.all {
            *own.entry(counted.label).or_default() += 1;
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
