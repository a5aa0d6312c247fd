//! Arithmetic that no driver may contract: `a * b + c` in two roundings, the same bits wherever it is written.
//!
//! GLSL says `precise` for that, variable by variable. glslang follows the word backwards through functions that answer
//! with structs, and takes minutes and gigabytes where they call each other; so whole stages are made exact here instead.

use super::spirv::{HEADER_WORDS, instructions, op};

/// Section 3.20.
const NO_CONTRACTION: u32 = 42;

/// Types and constants: the first of them ends the section of decorations.
const TYPES_AND_CONSTANTS: std::ops::RangeInclusive<u32> = 19..=52;

/// Opcodes of floating-point arithmetic (section 3.52.13): negation, sum, difference, product, quotient, remainders,
/// products of vectors and matrices.
const ARITHMETIC: [u32; 14] = [127, 129, 131, 133, 136, 140, 141, 142, 143, 144, 145, 146, 147, 148];

/// The module with every arithmetic instruction decorated.
///
/// # Errors
///
/// A sentence, where the words are not a SPIR-V module.
pub fn exact(words: &[u32]) -> Result<Vec<u32>, String> {
    let mut end_of_decorations = None;
    let mut at = HEADER_WORDS;
    let mut decorations = Vec::new();
    let decorate = |id: u32| [3 << 16 | op::DECORATE, id, NO_CONTRACTION];
    for instruction in instructions(words)? {
        if TYPES_AND_CONSTANTS.contains(&instruction.opcode) {
            end_of_decorations.get_or_insert(at);
        }
        // Operands: the result's type, the result.
        if let (true, Some(id)) = (ARITHMETIC.contains(&instruction.opcode), instruction.operands.get(1)) {
            decorations.extend(decorate(*id));
        }
        at += 1 + instruction.operands.len();
    }
    let (head, tail) = words.split_at(end_of_decorations.unwrap_or(at));
    Ok([head, &decorations, tail].concat())
}
