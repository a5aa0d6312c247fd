//! Which lines of the source the instructions come from, for shaders that were compiled with debug information.

use std::collections::BTreeMap;

use rspirv::spirv::Op;

use super::{
    module::{Id, ids},
    specialize::Specialized,
    tally::Tally,
};

/// A file as the compiler names it, and a line from 1.
pub type SourceLine = (String, u32);

/// ARB instructions by line; `None` has those of which the compiler does not tell. What several lines compute is counted at
/// the first.
pub fn by_line(tally: &Tally<'_, '_>) -> BTreeMap<Option<SourceLine>, u32> {
    let mut all = BTreeMap::new();
    for counted in &tally.all {
        *all.entry(line_of(tally.specialized, counted.at)).or_insert(0) += 1;
    }
    all
}

/// A choice has no line of its own where a branch makes it, or the optimizer in place of one: it counts where the nearest of
/// what it chooses from is computed or, where these are constants, in the last block before it.
fn line_of(specialized: &Specialized<'_>, id: Id) -> Option<SourceLine> {
    let module = specialized.module;
    let named = |(file, line): &(Id, u32)| Some((module.strings.get(file)?.clone(), *line));
    let mut found = vec![id];
    let mut next = 0;
    while let Some(&id) = found.get(next) {
        next += 1;
        if let Some(line) = module.lines.get(&id) {
            return named(line);
        }
        let Some(instruction) = specialized.instruction(id) else { continue };
        let operands: Vec<Id> = match instruction.class.opcode {
            Op::Phi => specialized.incoming(instruction),
            _ => ids(instruction).collect(),
        };
        for operand in operands {
            if !found.contains(&operand) {
                found.push(operand);
            }
        }
    }
    let own = specialized.block_of(id);
    let before: Vec<_> = specialized.blocks().take_while(|block| Some(block.label) != own).collect();
    let results = before.iter().rev().flat_map(|block| block.body.iter().rev()).filter_map(|i| i.result_id);
    results.filter_map(|result| module.lines.get(&result)).find_map(named)
}
