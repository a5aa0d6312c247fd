//! One GLSL file to SPIR-V, through shaderc.

use std::{
    fs,
    path::{Component, Path, PathBuf},
};

use shaderc::{
    CompileOptions, EnvVersion, IncludeCallbackResult, OptimizationLevel, ResolvedInclude, ShaderKind,
    SpirvVersion, TargetEnv,
};

/// How deep `#include` may nest. Deeper is a file that includes itself: shaderc alone would recurse forever.
const MAX_INCLUDE_DEPTH: usize = 16;

/// What the SPIR-V is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Optimize {
    /// To run; has no names.
    Performance,
    /// To read; the names of structs and members are kept.
    Off,
}

/// The stage that a shader's name such as `visibility.frag` ends in.
pub fn stage(name: &str) -> Option<ShaderKind> {
    match name.rsplit_once('.')?.1 {
        "vert" => Some(ShaderKind::Vertex),
        "frag" => Some(ShaderKind::Fragment),
        "comp" => Some(ShaderKind::Compute),
        _ => None,
    }
}

/// Compiles the shaders of one folder.
pub struct Compiler {
    compiler: shaderc::Compiler,
    glsl: PathBuf,
    macros: Vec<String>,
}

impl Compiler {
    /// `glsl` is where `#include "inc/…"` starts from, in whatever file it stands; `macros` are defined everywhere.
    pub fn new(glsl: &Path, macros: &[&str]) -> Result<Self, String> {
        let compiler = shaderc::Compiler::new().map_err(|e| format!("shaderc does not start: {e}"))?;
        Ok(Self {
            compiler,
            glsl: glsl.to_owned(),
            macros: macros.iter().map(|name| (*name).to_owned()).collect(),
        })
    }

    /// The SPIR-V 1.6 for Vulkan 1.3 of the file at `path`, with these words, in capitals, as macros.
    ///
    /// # Errors
    ///
    /// Every error and warning of this file, a line each.
    pub fn spirv(&self, path: &Path, words: &[String], optimize: Optimize) -> Result<Vec<u32>, String> {
        let shown = path.display().to_string();
        let failed = |problem: String| format!("{shown}: error: {problem}");
        let source = read_text(path).map_err(failed)?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let kind = stage(&name).ok_or_else(|| failed("no known stage in its name".into()))?;
        let options = self.options(words, optimize).map_err(|e| failed(e.to_string()))?;
        let compiled = self.compiler.compile_into_spirv(&source, kind, &shown, "main", Some(&options));
        match compiled {
            Ok(artifact) => Ok(artifact.as_binary().to_vec()),
            // The text alone: it is already made of lines `path:line: error: …`.
            Err(shaderc::Error::CompilationError(_, text)) if text.contains(':') => {
                Err(text.trim_end().to_owned())
            }
            Err(other) => Err(failed(other.to_string())),
        }
    }

    fn options(&self, words: &[String], optimize: Optimize) -> shaderc::Result<CompileOptions<'_>> {
        let mut options = CompileOptions::new()?;
        options.set_target_env(TargetEnv::Vulkan, EnvVersion::Vulkan1_3 as u32);
        options.set_target_spirv(SpirvVersion::V1_6);
        options.set_optimization_level(match optimize {
            Optimize::Performance => OptimizationLevel::Performance,
            Optimize::Off => OptimizationLevel::Zero,
        });
        options.set_warnings_as_errors();
        for name in &self.macros {
            options.add_macro_definition(name, None);
        }
        for word in words {
            options.add_macro_definition(&word.to_uppercase(), None);
        }
        options.set_include_callback(|requested, _, _, depth| self.include(requested, depth));
        Ok(options)
    }

    fn include(&self, requested: &str, depth: usize) -> IncludeCallbackResult {
        if depth > MAX_INCLUDE_DEPTH {
            return Err(format!("`{requested}`: includes nest deeper than {MAX_INCLUDE_DEPTH}: a circle?"));
        }
        let relative = Path::new(requested);
        // What lies elsewhere would not be watched for changes.
        if !relative.components().all(|part| matches!(part, Component::Normal(_))) {
            return Err(format!("`{requested}`: includes are named from the shader folder, without `..`"));
        }
        let path = self.glsl.join(relative);
        let content = read_text(&path).map_err(|problem| format!("{}: {problem}", path.display()))?;
        Ok(ResolvedInclude { resolved_name: path.display().to_string(), content })
    }
}

pub fn read_text(path: &Path) -> Result<String, String> {
    let text = fs::read_to_string(path).map_err(|e| format!("cannot read: {e}"))?;
    // shaderc panics on one.
    if text.contains('\0') {
        return Err("has a NUL character".into());
    }
    let [unroll, dont_unroll] = super::unroll::IN_SOURCE;
    Ok(text.replace(unroll, dont_unroll))
}
