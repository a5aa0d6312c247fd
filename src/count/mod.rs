//! The cost of a shader in instructions, counted on its SPIR-V, so that the same text gives the same figure everywhere.
//!
//! Two rules. The **paper-comparable** count is that of the programs of 2006: vec4 operations of `ARB_vertex_program` and
//! `ARB_fragment_program`, one each (`arb.rs` is the table). The **scalar** count is what a scalar processor executes: each
//! operation times its components (`scalar.rs`). Both are taken of one pipeline's variant: constants are substituted, what
//! can't be reached and what nothing depends on is gone (`specialize.rs`, `live.rs`).
//!
//! Branches: ARB has none. Both sides of one that is left count, and each value that it decides is one selection more. The
//! longest path says what one invocation executes at most. A loop's body counts once.

mod arb;
mod fold;
mod lines;
mod listed;
mod live;
mod module;
mod numbering;
mod patterns;
mod reader;
mod scalar;
mod specialize;
mod tally;
#[cfg(test)]
mod tests;
mod types;

use std::collections::BTreeMap;

use serde::Serialize;

pub use lines::SourceLine;

use module::Module;

/// A shader's instructions. Of what the paper does not count, `listed` says how much there is.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Paper-comparable: instructions of an ARB program. `None` for compute shaders, which ARB has not.
    pub arb: Option<u32>,
    /// ARB instructions of the longest path.
    pub arb_longest_path: Option<u32>,
    /// The ARB instructions by name.
    pub mnemonics: BTreeMap<&'static str, u32>,
    /// Scalar arithmetic: operations times components.
    pub scalar: u32,
    /// The instructions that the paper-comparable count leaves out.
    pub listed: Listed,
}

/// The instructions that are listed beside the paper-comparable count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Listed {
    /// Registers loaded from storage buffers, attributes of a vertex there; and texels of buffers, which are fetches (TEX), too.
    pub loads: u32,
    /// Stores to outputs and buffers.
    pub stores: u32,
    /// Inputs and constants copied to outputs as they are.
    pub moves: u32,
    /// Discards: the alpha test of the time.
    pub kills: u32,
    /// Comparisons that only decide a discard: the alpha test's own.
    pub alpha_tests: u32,
    /// Integers that only address memory.
    pub addresses: u32,
    /// Counted operations on bits, which ARB has not.
    pub bit_operations: u32,
    /// Loops that are left.
    pub loops: u32,
}

/// The instructions of a pass's pipeline, stage by stage.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct PassCounts {
    /// The pass.
    pub pass: String,
    /// Counts of the vertex stage.
    pub vertex: Option<Counts>,
    /// Counts of the fragment stage.
    pub fragment: Option<Counts>,
    /// Counts of the compute stage.
    pub compute: Option<Counts>,
}

impl PassCounts {
    /// Paper-comparable: vertex and fragment program, as `46/3`.
    pub fn vertex_and_fragment(&self) -> String {
        self.of_stages(|counts| counts.arb)
    }

    /// A figure of each stage, as `1/2`; `-` where a stage has none.
    pub fn of_stages(&self, figure: impl Fn(&Counts) -> Option<u32>) -> String {
        let shown =
            |counts: &Counts| figure(counts).map_or_else(|| "-".to_owned(), |count| count.to_string());
        let stages = [&self.vertex, &self.fragment, &self.compute];
        stages.into_iter().flatten().map(shown).collect::<Vec<_>>().join("/")
    }
}

/// The numbers of a shader's specialization constants.
///
/// # Errors
/// A sentence, where the words are not SPIR-V.
pub fn constant_numbers(spirv: &[u32]) -> Result<Vec<u32>, String> {
    reader::constant_numbers(spirv)
}

/// The paper-comparable count by lines of the source, of a shader that was compiled with debug information. The sum is
/// [`Counts::arb`].
///
/// # Errors
/// As [`count`].
pub fn count_by_line(
    spirv: &[u32],
    constants: &[(u32, u32)],
) -> Result<BTreeMap<Option<SourceLine>, u32>, String> {
    let module = Module::parse(spirv, constants)?;
    let specialized = specialize::specialize(&module)?;
    let live = live::live(&specialized);
    Ok(lines::by_line(&tally::tally(&specialized, &live)?))
}

/// Counts a shader as a pipeline with these specialization constants (id, 32-bit pattern) has it.
///
/// # Errors
/// A sentence, where the words are not SPIR-V or hold what can't be counted: a call that was not inlined, an
/// instruction that the table lacks.
pub fn count(spirv: &[u32], constants: &[(u32, u32)]) -> Result<Counts, String> {
    let module = Module::parse(spirv, constants)?;
    let specialized = specialize::specialize(&module)?;
    let live = live::live(&specialized);
    let mut counts = tally::count(&specialized, &live)?;
    counts.scalar = scalar::count(&specialized, &live)?;
    Ok(counts)
}
