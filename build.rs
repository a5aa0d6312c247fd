//! Compiles `glsl/` and writes `$OUT_DIR/shaders.rs`, which `src/shaders/mod.rs` takes in.

#[path = "src/shaders/build/mod.rs"]
mod shader_build;

use std::{
    env, fs,
    path::{Path, PathBuf},
    process::Command,
};

/// The structs that host and shaders share: name in GLSL, path of the twin in Rust. The build checks every member's
/// offset, and the size; a listed struct that no shader has is an error.
const HOST_STRUCTS: &[shader_build::HostStruct] = &[
    ("FrameConstants", "crate::passes::FrameConstants"),
    ("PaperConstants", "crate::passes::PaperConstants"),
    ("FinalizeConstants", "crate::passes::FinalizeConstants"),
    ("TileConstants", "crate::passes::TileConstants"),
    ("ExportConstants", "crate::passes::ExportConstants"),
];

fn main() {
    let glsl = Path::new("glsl");
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=src/shaders/build");
    tell_the_commit();
    match shader_build::files_and_folders(glsl) {
        Ok(paths) => paths.iter().for_each(|p| println!("cargo::rerun-if-changed={}", p.display())),
        Err(e) => return println!("cargo::error=cannot list {}: {e}", glsl.display()),
    }
    // Cargo tells a build script its package's features through the environment.
    let macros =
        if env::var_os("CARGO_FEATURE_TEST_FORMULAS").is_some() { &["TEST_FORMULAS"][..] } else { &[] };
    match shader_build::build(glsl, HOST_STRUCTS, macros) {
        Ok(built) => {
            let folder = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
            let write = |name: &str, content: &[u8]| {
                let path = folder.join(name);
                if let Err(e) = fs::write(&path, content) {
                    println!("cargo::error=cannot write {}: {e}", path.display());
                }
            };
            for (name, words) in &built.modules {
                let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_ne_bytes()).collect();
                write(&format!("{name}.spv"), &bytes);
            }
            write("shaders.rs", built.rust.as_bytes());
        }
        // Cargo shows each such line as an error and then stops the build.
        Err(errors) => errors.iter().flat_map(|e| e.lines()).for_each(|line| println!("cargo::error={line}")),
    }
}

/// Reports name the commit they were made from, as `SURFEL_COMMIT`: in a checkout, not in a package.
fn tell_the_commit() {
    let git = |arguments: &[&str]| {
        let output = Command::new("git").args(arguments).output().ok().filter(|o| o.status.success())?;
        Some(String::from_utf8(output.stdout).ok()?.trim().to_owned())
    };
    // Not that of a repository which this folder happens to lie in.
    let is_ours = git(&["rev-parse", "--show-prefix"]).is_some_and(|prefix| prefix.is_empty());
    if let (true, Some(commit)) = (is_ours, git(&["rev-parse", "--short=12", "HEAD"])) {
        println!("cargo::rustc-env=SURFEL_COMMIT={commit}");
        // Written by each commit and each checkout.
        if let Some(log) =
            git(&["rev-parse", "--git-path", "logs/HEAD"]).filter(|log| Path::new(log).exists())
        {
            println!("cargo::rerun-if-changed={log}");
        }
    }
}
