//! The memory layout of the structs in a SPIR-V module: where each member lies, and how long the whole is.

use std::collections::{BTreeMap, HashMap, HashSet};

use rspirv::{
    binary::{Consumer, ParseAction, parse_words},
    dr::{Instruction, ModuleHeader, Operand},
    spirv::{Decoration, Op, Word},
};

/// A member of a struct that lies in a buffer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Member {
    /// Its name in GLSL.
    pub name: String,
    /// Bytes from the start of the struct.
    pub offset_bytes: u32,
}

/// Where a struct's members lie.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StructLayout {
    /// Its name in GLSL: of a `struct`, or of a block (not that of the block's instance).
    pub name: String,
    /// In order of declaration.
    pub members: Vec<Member>,
    /// Bytes up to the end of the last member; `None` where that is an array without a length.
    pub end_bytes: Option<u32>,
    /// Bytes from one element to the next, where arrays of it exist.
    pub stride_bytes: Option<u32>,
}

/// The structs of a module that have a memory layout (members with offsets) and a name.
///
/// # Errors
///
/// A sentence, where the words are no SPIR-V module or use a type whose size is not known here.
pub fn struct_layouts(spirv: &[u32]) -> Result<Vec<StructLayout>, String> {
    let mut module = Instructions(Vec::new());
    parse_words(spirv, &mut module).map_err(|e| format!("cannot read the SPIR-V: {e}"))?;
    let types = Types::new(&module.0);
    let structs = module.0.iter().filter(|i| i.class.opcode == Op::TypeStruct);
    structs.filter_map(|i| types.layout(i).transpose()).collect()
}

/// A module's instructions in order. rspirv's own loader does not take `OpExecutionModeId`, which every compute
/// shader in SPIR-V 1.6 has.
struct Instructions(Vec<Instruction>);

impl Consumer for Instructions {
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

/// Adds the layout that `shader` has of a struct to what the shaders before it said.
///
/// # Errors
///
/// A sentence, where they disagree.
pub fn merge(
    known: &mut BTreeMap<String, (String, StructLayout)>,
    shader: &str,
    new: StructLayout,
) -> Result<(), String> {
    let Some((first_shader, old)) = known.get_mut(&new.name) else {
        known.insert(new.name.clone(), (shader.to_owned(), new));
        return Ok(());
    };
    let strides_agree =
        old.stride_bytes.is_none() || new.stride_bytes.is_none() || old.stride_bytes == new.stride_bytes;
    if old.members != new.members || old.end_bytes != new.end_bytes || !strides_agree {
        return Err(format!(
            "error: struct `{}` differs between {first_shader} and {shader}:\n  {old:?}\n  {new:?}",
            new.name
        ));
    }
    old.stride_bytes = old.stride_bytes.or(new.stride_bytes);
    Ok(())
}

/// The types of a module and what is said about them, by id.
struct Types<'a> {
    by_id: HashMap<Word, &'a Instruction>,
    names: HashMap<Word, &'a str>,
    member_names: HashMap<(Word, Word), &'a str>,
    offsets: HashMap<(Word, Word), u32>,
    matrix_strides: HashMap<(Word, Word), u32>,
    row_major: HashSet<(Word, Word)>,
    array_strides: HashMap<Word, u32>,
}

impl<'a> Types<'a> {
    fn new(module: &'a [Instruction]) -> Self {
        let mut types = Self {
            by_id: module.iter().filter_map(|i| Some((i.result_id?, i))).collect(),
            names: HashMap::new(),
            member_names: HashMap::new(),
            offsets: HashMap::new(),
            matrix_strides: HashMap::new(),
            row_major: HashSet::new(),
            array_strides: HashMap::new(),
        };
        for instruction in module {
            match (instruction.class.opcode, instruction.operands.as_slice()) {
                (Op::Name, [Operand::IdRef(id), Operand::LiteralString(text)]) => {
                    types.names.insert(*id, text);
                }
                (
                    Op::MemberName,
                    [Operand::IdRef(id), Operand::LiteralBit32(member), Operand::LiteralString(text)],
                ) => {
                    types.member_names.insert((*id, *member), text);
                }
                (Op::Decorate | Op::MemberDecorate, operands) => types.add_annotation(operands),
                _ => {}
            }
        }
        types
    }

    fn add_annotation(&mut self, operands: &[Operand]) {
        use Operand::{Decoration as Is, IdRef, LiteralBit32 as Number};
        match *operands {
            [IdRef(id), Number(member), Is(Decoration::Offset), Number(bytes)] => {
                self.offsets.insert((id, member), bytes);
            }
            [IdRef(id), Number(member), Is(Decoration::MatrixStride), Number(bytes)] => {
                self.matrix_strides.insert((id, member), bytes);
            }
            [IdRef(id), Number(member), Is(Decoration::RowMajor)] => {
                self.row_major.insert((id, member));
            }
            [IdRef(id), Is(Decoration::ArrayStride), Number(bytes)] => {
                self.array_strides.insert(id, bytes);
            }
            _ => {}
        }
    }

    /// `None` for a struct without a name or without offsets: one that is in no buffer.
    fn layout(&self, instruction: &Instruction) -> Result<Option<StructLayout>, String> {
        let Some(id) = instruction.result_id else { return Ok(None) };
        let Some(name) = self.names.get(&id) else { return Ok(None) };
        let mut members = Vec::new();
        for member in 0..instruction.operands.len() as u32 {
            let Some(&offset_bytes) = self.offsets.get(&(id, member)) else { return Ok(None) };
            let name = self.member_names.get(&(id, member)).copied().unwrap_or_default().to_owned();
            members.push(Member { name, offset_bytes });
        }
        let end_bytes = self.struct_end(id, instruction)?;
        let stride_bytes = self.by_id.iter().find_map(|(array, i)| {
            let is_array = matches!(i.class.opcode, Op::TypeArray | Op::TypeRuntimeArray);
            (is_array && i.operands.first() == Some(&Operand::IdRef(id)))
                .then(|| self.array_strides.get(array).copied())
                .flatten()
        });
        Ok(Some(StructLayout { name: (*name).to_owned(), members, end_bytes, stride_bytes }))
    }

    /// Bytes up to the end of the last member; `None` where that has no length.
    fn struct_end(&self, id: Word, instruction: &Instruction) -> Result<Option<u32>, String> {
        let mut end = 0;
        for (member, operand) in (0..).zip(&instruction.operands) {
            let Some(size) = self.size(operand, (id, member))? else { return Ok(None) };
            end = end.max(self.offsets.get(&(id, member)).copied().unwrap_or_default() + size);
        }
        Ok(Some(end))
    }

    /// Bytes that a value of a type takes as that member of a struct; `None` for an array without a length.
    fn size(&self, type_: &Operand, member: (Word, Word)) -> Result<Option<u32>, String> {
        let unknown = || format!("a buffer holds a type of unknown size: {type_:?}");
        let Operand::IdRef(id) = type_ else { return Err(unknown()) };
        let instruction = self.by_id.get(id).ok_or_else(unknown)?;
        let bytes = match (instruction.class.opcode, instruction.operands.as_slice()) {
            (Op::TypeInt | Op::TypeFloat, [Operand::LiteralBit32(bits), ..]) => bits / 8,
            // A buffer's address (GL_EXT_buffer_reference).
            (Op::TypePointer, _) => 8,
            (Op::TypeVector, [component, Operand::LiteralBit32(count)]) => {
                count * self.size(component, member)?.ok_or_else(unknown)?
            }
            (Op::TypeMatrix, [column @ Operand::IdRef(column_id), Operand::LiteralBit32(columns)]) => {
                let stride = *self.matrix_strides.get(&member).ok_or_else(unknown)?;
                let rows = match self.by_id.get(column_id).map(|i| i.operands.as_slice()) {
                    Some([_, Operand::LiteralBit32(rows)]) => *rows,
                    _ => return Err(unknown()),
                };
                let column_bytes = self.size(column, member)?.ok_or_else(unknown)?;
                // The last column (or row) is not padded.
                if self.row_major.contains(&member) {
                    stride * (rows - 1) + column_bytes / rows * columns
                } else {
                    stride * (columns - 1) + column_bytes
                }
            }
            (Op::TypeArray, [_, Operand::IdRef(length)]) => {
                let stride = *self.array_strides.get(id).ok_or_else(unknown)?;
                match self.by_id.get(length).map(|i| (i.class.opcode, i.operands.as_slice())) {
                    Some((Op::Constant, [Operand::LiteralBit32(count)])) => stride * count,
                    _ => return Err(unknown()),
                }
            }
            (Op::TypeRuntimeArray, _) => return Ok(None),
            (Op::TypeStruct, _) => return self.struct_end(*id, instruction),
            _ => return Err(unknown()),
        };
        Ok(Some(bytes))
    }
}
