//! The memory layout of the structs in a SPIR-V module: where each member lies, and how long the whole is.

use std::collections::{BTreeMap, HashMap, HashSet};

use super::spirv::{Instruction, decoration, instructions, op, text};

/// The number that stands for a result, such as a type.
type Id = u32;

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

/// The structs of a module that have one of these names and a memory layout (members with offsets).
///
/// # Errors
///
/// A sentence, where the words are no SPIR-V module or use a type whose size is not known here.
pub fn struct_layouts(spirv: &[u32], names: &[&str]) -> Result<Vec<StructLayout>, String> {
    let module = instructions(spirv)?;
    let types = Types::new(&module);
    let structs = module.iter().filter(|i| i.opcode == op::TYPE_STRUCT);
    structs.filter_map(|i| types.layout(i.operands, names).transpose()).collect()
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
#[derive(Default)]
struct Types<'a> {
    /// Opcode, and the operands after the result; constants too, for they give arrays their lengths.
    by_id: BTreeMap<Id, (u32, &'a [u32])>,
    names: HashMap<Id, String>,
    member_names: HashMap<(Id, u32), String>,
    offsets: HashMap<(Id, u32), u32>,
    matrix_strides: HashMap<(Id, u32), u32>,
    row_major: HashSet<(Id, u32)>,
    array_strides: HashMap<Id, u32>,
}

impl<'a> Types<'a> {
    fn new(module: &[Instruction<'a>]) -> Self {
        let mut types = Self::default();
        for instruction in module {
            match (instruction.opcode, instruction.operands) {
                (op::NAME, &[id, ref name @ ..]) => {
                    types.names.insert(id, text(name));
                }
                (op::MEMBER_NAME, &[id, member, ref name @ ..]) => {
                    types.member_names.insert((id, member), text(name));
                }
                (op::DECORATE, &[id, decoration::ARRAY_STRIDE, bytes]) => {
                    types.array_strides.insert(id, bytes);
                }
                (op::MEMBER_DECORATE, &[id, member, decoration::OFFSET, bytes]) => {
                    types.offsets.insert((id, member), bytes);
                }
                (op::MEMBER_DECORATE, &[id, member, decoration::MATRIX_STRIDE, bytes]) => {
                    types.matrix_strides.insert((id, member), bytes);
                }
                (op::MEMBER_DECORATE, &[id, member, decoration::ROW_MAJOR]) => {
                    types.row_major.insert((id, member));
                }
                (opcode @ op::TYPE_INT..=op::TYPE_POINTER, &[id, ref operands @ ..]) => {
                    types.by_id.insert(id, (opcode, operands));
                }
                (op::CONSTANT, &[_type, id, ref value @ ..]) => {
                    types.by_id.insert(id, (op::CONSTANT, value));
                }
                _ => {}
            }
        }
        types
    }

    /// The layout of the struct with these words: its id and those of its members' types. `None` for a struct that
    /// has another name, or no offsets and so is in no buffer.
    fn layout(&self, words: &[u32], names: &[&str]) -> Result<Option<StructLayout>, String> {
        let &[id, ref member_types @ ..] = words else { return Ok(None) };
        let Some(name) = self.names.get(&id).filter(|name| names.contains(&name.as_str())) else {
            return Ok(None);
        };
        let mut members = Vec::new();
        for (member, _) in (0..).zip(member_types) {
            let Some(&offset_bytes) = self.offsets.get(&(id, member)) else { return Ok(None) };
            let name = self.member_names.get(&(id, member)).cloned().unwrap_or_default();
            members.push(Member { name, offset_bytes });
        }
        let end_bytes = self.struct_end(id, member_types)?;
        let stride_bytes = self.by_id.iter().find_map(|(array, (opcode, operands))| {
            let is_array = matches!(*opcode, op::TYPE_ARRAY | op::TYPE_RUNTIME_ARRAY);
            if is_array && operands.first() == Some(&id) {
                self.array_strides.get(array).copied()
            } else {
                None
            }
        });
        Ok(Some(StructLayout { name: name.clone(), members, end_bytes, stride_bytes }))
    }

    /// Bytes up to the end of the last member; `None` where that has no length.
    fn struct_end(&self, id: Id, member_types: &[Id]) -> Result<Option<u32>, String> {
        let mut end = 0;
        for (member, &type_) in (0..).zip(member_types) {
            let Some(size) = self.size(type_, (id, member))? else { return Ok(None) };
            end = end.max(self.offsets.get(&(id, member)).copied().unwrap_or_default() + size);
        }
        Ok(Some(end))
    }

    /// Bytes that a value of a type takes as that member of a struct; `None` for an array without a length.
    fn size(&self, type_: Id, member: (Id, u32)) -> Result<Option<u32>, String> {
        let unknown = || format!("member {} of a shared struct has a type of unknown size", member.1);
        let bytes = match self.by_id.get(&type_) {
            Some(&(op::TYPE_INT | op::TYPE_FLOAT, &[bits, ..])) => bits / 8,
            // A buffer's address (GL_EXT_buffer_reference).
            Some((op::TYPE_POINTER, _)) => 8,
            Some(&(op::TYPE_VECTOR, &[component, count])) => {
                count * self.size(component, member)?.ok_or_else(unknown)?
            }
            Some(&(op::TYPE_MATRIX, &[column, columns])) => {
                let stride = *self.matrix_strides.get(&member).ok_or_else(unknown)?;
                let Some(&(_, &[component, rows])) = self.by_id.get(&column) else { return Err(unknown()) };
                let component_bytes = self.size(component, member)?.ok_or_else(unknown)?;
                // The last column (or row) has no padding behind it.
                let (vectors, length) =
                    if self.row_major.contains(&member) { (rows, columns) } else { (columns, rows) };
                stride * vectors.saturating_sub(1) + component_bytes * length
            }
            Some(&(op::TYPE_ARRAY, &[_, length])) => {
                let stride = *self.array_strides.get(&type_).ok_or_else(unknown)?;
                // A length by specialization constant has no value here.
                let Some(&(op::CONSTANT, &[count])) = self.by_id.get(&length) else { return Err(unknown()) };
                stride * count
            }
            Some((op::TYPE_RUNTIME_ARRAY, _)) => return Ok(None),
            Some(&(op::TYPE_STRUCT, member_types)) => return self.struct_end(type_, member_types),
            _ => return Err(unknown()),
        };
        Ok(Some(bytes))
    }
}
