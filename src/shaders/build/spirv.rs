//! A SPIR-V module as a list of instructions (SPIR-V specification 1.6, section 2.3).
//!
//! The dozen instructions that tell a struct's layout do not need a library, and the loader of rspirv 0.13 refuses the
//! `OpExecutionModeId` that compute shaders have in SPIR-V 1.6.

/// Opcodes (section 3.52).
pub mod op {
    pub const NAME: u32 = 5;
    pub const MEMBER_NAME: u32 = 6;
    pub const TYPE_INT: u32 = 21;
    pub const TYPE_FLOAT: u32 = 22;
    pub const TYPE_VECTOR: u32 = 23;
    pub const TYPE_MATRIX: u32 = 24;
    pub const TYPE_ARRAY: u32 = 28;
    pub const TYPE_RUNTIME_ARRAY: u32 = 29;
    pub const TYPE_STRUCT: u32 = 30;
    pub const TYPE_POINTER: u32 = 32;
    pub const CONSTANT: u32 = 43;
    pub const DECORATE: u32 = 71;
    pub const MEMBER_DECORATE: u32 = 72;
    pub const LOOP_MERGE: u32 = 246;
}

/// Decorations (section 3.20).
pub mod decoration {
    pub const ROW_MAJOR: u32 = 4;
    pub const ARRAY_STRIDE: u32 = 6;
    pub const MATRIX_STRIDE: u32 = 7;
    pub const OFFSET: u32 = 35;
}

const MAGIC: u32 = 0x0723_0203;
pub const HEADER_WORDS: usize = 5;

/// An instruction: the opcode and the words after it.
pub struct Instruction<'a> {
    pub opcode: u32,
    pub operands: &'a [u32],
}

/// The instructions of a module in order.
///
/// # Errors
///
/// A sentence, where the words are not a SPIR-V module of this machine's byte order.
pub fn instructions(words: &[u32]) -> Result<Vec<Instruction<'_>>, String> {
    if words.first() != Some(&MAGIC) {
        return Err("not SPIR-V: its first word is another".into());
    }
    let mut rest = words.get(HEADER_WORDS..).ok_or("SPIR-V without a whole header")?;
    let mut instructions = Vec::new();
    while let Some(first) = rest.first() {
        let word_count = (first >> 16) as usize;
        let (Some(operands), Some(next)) = (rest.get(1..word_count), rest.get(word_count..)) else {
            return Err(format!(
                "SPIR-V with an instruction of {word_count} words where {} are left",
                rest.len()
            ));
        };
        instructions.push(Instruction { opcode: first & 0xffff, operands });
        rest = next;
    }
    Ok(instructions)
}

/// A literal string (section 2.2.1): UTF-8, four bytes a word from the low end, up to a zero.
pub fn text(words: &[u32]) -> String {
    let bytes = words.iter().flat_map(|word| word.to_le_bytes());
    String::from_utf8_lossy(&bytes.take_while(|byte| *byte != 0).collect::<Vec<u8>>()).into_owned()
}
