//! From `glsl/` to SPIR-V in Rust's hands. Part of `build.rs` and of the test `tests/shaders.rs`; not of the library.

mod compile;
mod exact;
mod layout;
mod permutations;
mod spirv;
mod table;

use std::{
    collections::BTreeMap,
    fs, io,
    path::{Path, PathBuf},
};

use compile::{Compiler, Optimize};
use layout::{StructLayout, struct_layouts};

/// A struct that host and shaders share: its name in GLSL, and the path of its twin in Rust.
pub type HostStruct<'a> = (&'a str, &'a str);

/// Compiles every `<pass>.<stage>.glsl` of the folder `glsl`, once for each of its permutations. Answers with Rust source: one `static` a shader, the table
/// `ALL` of all of them, and the checks of the host structs. `macros` are defined in every shader.
///
/// # Errors
///
/// All that is wrong with any shader, each as `path:line: error: …` where the compiler knows a line.
pub fn build(glsl: &Path, host_structs: &[HostStruct], macros: &[&str]) -> Result<String, Vec<String>> {
    let sources = find_shaders(glsl)?;
    let compiler = Compiler::new(glsl, macros).map_err(|message| vec![message])?;
    let shared: Vec<&str> = host_structs.iter().map(|(glsl_name, _)| *glsl_name).collect();
    let mut errors = Vec::new();
    let mut shaders = Vec::new();
    let mut layouts = BTreeMap::new();
    for (file, path) in sources {
        let source = match compile::read_text(&path) {
            Ok(source) => source,
            Err(problem) => {
                errors.push(format!("{}: error: {problem}", path.display()));
                continue;
            }
        };
        for (number, words) in permutations::permutations(&source).into_iter().enumerate() {
            let name = permutations::name(&file, &words);
            let result = compiler.spirv(&path, &words, Optimize::Performance).and_then(|optimized| {
                // Both splat passes must place a splat alike, to the last bit. Fragments say `precise` where they need it.
                let optimized = match name.ends_with(".frag") {
                    true => optimized,
                    false => {
                        exact::exact(&optimized).map_err(|e| format!("{}: error: {e}", path.display()))?
                    }
                };
                // What a file shares with the host is the same in all of its permutations.
                if number > 0 {
                    return Ok((optimized, Vec::new()));
                }
                // The optimizer strips names, so that the struct members are read from a second, unoptimized copy.
                let named = compiler.spirv(&path, &words, Optimize::Off)?;
                Ok((
                    optimized,
                    struct_layouts(&named, &shared).map_err(|e| format!("{}: error: {e}", path.display()))?,
                ))
            });
            match result {
                Ok((spirv, found)) => {
                    for layout in found {
                        errors.extend(layout::merge(&mut layouts, &name, layout).err());
                    }
                    shaders.push((name, spirv));
                }
                // The permutations of a file mostly fail alike: the first says it.
                Err(message) => {
                    errors.push(message);
                    break;
                }
            }
        }
    }
    shaders.sort();
    // A struct may be missing only because its shader failed; then that failure is the thing to read.
    if errors.is_empty() {
        for (glsl_name, _) in host_structs.iter().filter(|(name, _)| !layouts.contains_key(*name)) {
            let folder = glsl.display();
            errors.push(format!("{folder}: error: no shader has a struct `{glsl_name}` in a buffer"));
        }
    }
    if !errors.is_empty() {
        return Err(errors);
    }
    Ok(table::shaders(&shaders) + &table::checks(host_structs, &layouts))
}

/// Every file and folder below `folder`, itself included: what has to be compiled again when it changes.
pub fn files_and_folders(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut found = vec![folder.to_owned()];
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if entry.file_type()?.is_dir() {
            found.extend(files_and_folders(&entry.path())?);
        } else {
            found.push(entry.path());
        }
    }
    found.sort();
    Ok(found)
}

/// The shaders right in `glsl`: name without `.glsl`, and path; sorted by name. Its folders hold only includes.
fn find_shaders(glsl: &Path) -> Result<Vec<(String, PathBuf)>, Vec<String>> {
    let unreadable = |e: io::Error| vec![format!("{}: error: cannot list: {e}", glsl.display())];
    let mut shaders = Vec::new();
    let mut errors = Vec::new();
    for entry in fs::read_dir(glsl).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        let file_name = path.file_name().unwrap_or_default().to_string_lossy();
        // Hidden files are an editor's.
        if path.is_dir() || file_name.starts_with('.') {
            continue;
        }
        let name = file_name.strip_suffix(".glsl").unwrap_or_default();
        let pass = name.rsplit_once('.').map_or("", |(pass, _)| pass);
        // The name becomes an identifier of Rust.
        let well_named = pass.starts_with(|c: char| c.is_ascii_lowercase())
            && pass.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
        if well_named && compile::stage(name).is_some() {
            shaders.push((name.to_owned(), path));
        } else {
            errors.push(format!(
                "{}: error: a shader is named <pass>.<vert|frag|comp>.glsl, in small letters, digits and `_`; \
                 other files belong in a folder",
                path.display()
            ));
        }
    }
    shaders.sort();
    if errors.is_empty() { Ok(shaders) } else { Err(errors) }
}
