//! Numbers that shaders and host share: each `#define NAME number // meaning` of `glsl/inc/config.glsl` becomes a constant of
//! `surfel::shaders::config`, so that they stand once.

use std::{fmt::Write as _, path::Path};

use super::compile::read_text;

/// Where the numbers stand, below the folder of shaders.
const FILE: &str = "inc/config.glsl";

/// A Rust module with all of them; empty where the folder has no such file.
///
/// # Errors
///
/// A definition that is not a number with its meaning behind it, as `path:line: error: …`.
pub fn module(glsl: &Path) -> Result<String, String> {
    let path = glsl.join(FILE);
    let text = if path.exists() { read_text(&path)? } else { String::new() };
    let mut constants = String::new();
    for (number, line) in (1..).zip(text.lines()) {
        let Some(definition) = line.strip_prefix("#define ") else { continue };
        let constant = constant(definition).ok_or_else(|| {
            format!("{}:{number}: error: expected `#define NAME number // meaning`", path.display())
        })?;
        // Writing to a `String` can't fail.
        let _ = writeln!(constants, "    {constant}");
    }
    Ok(format!("/// The numbers of `glsl/{FILE}`.\npub mod config {{\n{constants}}}\n"))
}

fn constant(definition: &str) -> Option<String> {
    let (code, meaning) = definition.split_once("//")?;
    let (name, value) = code.trim().split_once(' ')?;
    let value = value.trim();
    let kind = match (value.parse::<u32>(), value.parse::<f32>()) {
        (Ok(_), _) => "u32",
        (_, Ok(number)) if number.is_finite() => "f32",
        _ => return None,
    };
    Some(format!("/// {}\n    pub const {name}: {kind} = {value};", meaning.trim()))
}
