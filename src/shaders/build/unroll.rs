//! Loops marked `[[unroll]]` are unrolled by the driver, not by the build: unrolled, the tile shaders were 30 of 37 MB of SPIR-V,
//! and took most of the build's time. The optimizer of SPIRV-Tools unrolls whatever asks for it, so that these loops ask not to
//! be unrolled while it works, and to be afterwards.

use super::spirv::{HEADER_WORDS, instructions, op};

/// What stands in the source, and what the optimizer is shown instead.
pub const IN_SOURCE: [&str; 2] = ["[[unroll]]", "[[dont_unroll]]"];

/// Loop controls (section 3.23).
const UNROLL: u32 = 1;
const DONT_UNROLL: u32 = 2;

/// Has every loop of the module that asks not to be unrolled ask for it.
///
/// # Errors
///
/// A sentence, where the words are not a SPIR-V module.
pub fn ask_the_driver(words: &mut [u32]) -> Result<(), String> {
    let mut at = HEADER_WORDS;
    let mut controls = Vec::new();
    for instruction in instructions(words)? {
        // Operands: the block behind the loop, the block that goes on with it, the control.
        if instruction.opcode == op::LOOP_MERGE && instruction.operands.get(2) == Some(&DONT_UNROLL) {
            controls.push(at + 3);
        }
        at += 1 + instruction.operands.len();
    }
    for control in controls {
        words[control] = UNROLL;
    }
    Ok(())
}
