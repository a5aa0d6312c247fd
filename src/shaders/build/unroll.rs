//! Loops marked `[[unroll]]` are unrolled by the driver, not by the build: unrolled, the tile shaders were 30 of 37 MB of SPIR-V,
//! and took most of the build's time. The optimizer of SPIRV-Tools unrolls whatever asks for it, so that these loops ask not to
//! be unrolled while it works, and to be afterwards.
//!
//! Where an invocation draws one pixel they go without a hint: there are no rows to keep in registers, and SwiftShader, which
//! unrolls what asks for it by the same optimizer, then compiles a tile shader for minutes, in 10 GB and more.

use super::spirv::{HEADER_WORDS, instructions, op};

/// What stands in the source, and what the optimizer is shown instead.
pub const IN_SOURCE: [&str; 2] = ["[[unroll]]", "[[dont_unroll]]"];

/// Loop controls (section 3.23).
const UNROLL: u32 = 1;
const DONT_UNROLL: u32 = 2;

/// The word of those permutations in which an invocation draws one pixel begins with this.
const BY_PIXELS: &str = "pixel";

/// Has every loop of the module that asks not to be unrolled ask for it, or for nothing in such a permutation.
///
/// # Errors
///
/// A sentence, where the words are not a SPIR-V module.
pub fn ask_the_driver(words: &mut [u32], permutation: &[String]) -> Result<(), String> {
    let by_pixels = permutation.iter().any(|word| word.starts_with(BY_PIXELS));
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
        words[control] = if by_pixels { 0 } else { UNROLL };
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hint by which SwiftShader compiled the tiles of one pixel an invocation for minutes.
    #[test]
    fn loops_ask_for_what_the_source_says_unless_an_invocation_draws_one_pixel() {
        let of = |permutation: &str, control| {
            let mut words = vec![0x0723_0203, 0, 0, 0, 0, 4 << 16 | op::LOOP_MERGE, 1, 2, control];
            ask_the_driver(&mut words, &[permutation.to_owned(), "hidden".to_owned()]).unwrap();
            words[HEADER_WORDS + 3]
        };
        assert_eq!(
            [of("column", DONT_UNROLL), of("pixel", DONT_UNROLL), of("pixels", DONT_UNROLL)],
            [UNROLL, 0, 0]
        );
        assert_eq!([of("column", 0), of("pixel", 0)], [0, 0]);
    }
}
