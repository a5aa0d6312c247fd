//! The Rust source that `src/shaders/mod.rs` takes in.

use std::{collections::BTreeMap, fmt::Write as _};

use super::{HostStruct, StructLayout};

/// The alignment that no buffer layout of GLSL exceeds without 64-bit vectors: that of `vec4`.
const MAX_ALIGNMENT_BYTES: u32 = 16;

/// One `static` a shader, and `ALL`. Its SPIR-V is a file beside, taken in as bytes: the compiler would have to parse literals.
pub fn shaders(names: &[&str]) -> String {
    let mut rust = String::new();
    let mut all = String::new();
    for name in names {
        let identifier = name.replace('.', "_").to_uppercase();
        // Writing to a `String` can't fail.
        let _ = writeln!(
            rust,
            "/// The shader `{name}`.\npub static {identifier}: Shader = Shader {{ name: {name:?}, \
             bytes: &Aligned(*include_bytes!(\"{name}.spv\")) }};"
        );
        let _ = write!(all, "&{identifier}, ");
    }
    rust + "/// Every shader, sorted by name.\npub static ALL: &[&Shader] = &[" + &all + "];\n"
}

/// Assertions at compile time that each host struct has the layout the shaders have, member by member.
pub fn checks(host_structs: &[HostStruct], layouts: &BTreeMap<String, (String, StructLayout)>) -> String {
    let mut rust = String::new();
    for (glsl_name, path) in host_structs {
        let Some((shader, layout)) = layouts.get(*glsl_name) else { continue };
        for member in &layout.members {
            let (name, offset) = (&member.name, member.offset_bytes);
            let _ = writeln!(
                rust,
                "const _: () = assert!(::core::mem::offset_of!({path}, {name}) == {offset}, \
                 \"{glsl_name}.{name} is at byte {offset} in {shader}, elsewhere in {path}\");"
            );
        }
        if let Some(stride) = layout.stride_bytes {
            let _ = writeln!(
                rust,
                "const _: () = assert!(::core::mem::size_of::<{path}>() == {stride}, \
                 \"an array of {glsl_name} has {stride} bytes an element in {shader}, {path} another size\");"
            );
        } else if let Some(end) = layout.end_bytes {
            // Rust may round up to an alignment, no further: more would be members that the shader lacks.
            let limit = end.next_multiple_of(MAX_ALIGNMENT_BYTES);
            let _ = writeln!(
                rust,
                "const _: () = assert!(::core::mem::size_of::<{path}>() >= {end} \
                 && ::core::mem::size_of::<{path}>() <= {limit}, \
                 \"{glsl_name} has {end} bytes in {shader}, {path} another size\");"
            );
        }
    }
    rust
}
