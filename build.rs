//! Makes the shaders that `src/shaders/mod.rs` takes in: `$OUT_DIR/shaders/`, with `shaders.rs` and a file of SPIR-V for each. They
//! are compiled from `glsl/`, or, with the feature `prebuilt-spirv`, taken from `spirv/`, which packages ship, so that neither shaderc
//! nor C++ is needed.

#[cfg(all(feature = "compile-shaders", not(feature = "prebuilt-spirv")))]
#[path = "src/shaders/build/mod.rs"]
mod shader_build;

use std::{
    env, fs, io,
    path::{Path, PathBuf},
};

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default()).join("shaders");
    // Cargo shows each such line as an error and then stops the build.
    if let Err(errors) = empty(&out).and_then(|()| make_shaders(&out)) {
        errors.iter().flat_map(|error| error.lines()).for_each(|line| println!("cargo::error={line}"));
    }
}

/// Makes an empty folder, without the files of shaders that are no more.
fn empty(folder: &Path) -> Result<(), Vec<String>> {
    let made = || -> io::Result<()> {
        if folder.exists() {
            fs::remove_dir_all(folder)?;
        }
        fs::create_dir_all(folder)
    };
    made().map_err(|e| vec![format!("cannot make {}: {e}", folder.display())])
}

/// Takes the shaders that came with the package.
#[cfg(feature = "prebuilt-spirv")]
fn make_shaders(out: &Path) -> Result<(), Vec<String>> {
    let shipped = Path::new("spirv");
    println!("cargo::rerun-if-changed={}", shipped.display());
    if cfg!(feature = "test-formulas") {
        return Err(vec!["test-formulas needs shaders of its own: build without prebuilt-spirv".to_owned()]);
    }
    let copy = || -> io::Result<()> {
        for file in fs::read_dir(shipped)? {
            let file = file?;
            fs::copy(file.path(), out.join(file.file_name()))?;
        }
        Ok(())
    };
    let which = "only packages that third_party/prebuilt made have it; the feature compile-shaders makes it";
    copy().map_err(|e| vec![format!("cannot copy {} (prebuilt-spirv): {e}; {which}", shipped.display())])
}

/// Compiles `glsl/`.
#[cfg(all(feature = "compile-shaders", not(feature = "prebuilt-spirv")))]
fn make_shaders(out: &Path) -> Result<(), Vec<String>> {
    let one = |problem: String| vec![problem];
    let glsl = Path::new("glsl");
    println!("cargo::rerun-if-changed=src/shaders/build");
    let watched = shader_build::files_and_folders(glsl)
        .map_err(|e| one(format!("cannot list {}: {e}", glsl.display())))?;
    watched.iter().for_each(|path| println!("cargo::rerun-if-changed={}", path.display()));
    let macros = if cfg!(feature = "test-formulas") { &["TEST_FORMULAS"][..] } else { &[] };
    let built = shader_build::build(glsl, shader_build::HOST_STRUCTS, macros)?;
    let write = || -> io::Result<()> {
        for (name, words) in &built.modules {
            let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
            fs::write(out.join(format!("{name}.spv")), bytes)?;
        }
        fs::write(out.join("shaders.rs"), &built.rust)
    };
    write().map_err(|e| one(format!("cannot write to {}: {e}", out.display())))
}

#[cfg(not(any(feature = "compile-shaders", feature = "prebuilt-spirv")))]
fn make_shaders(_: &Path) -> Result<(), Vec<String>> {
    Err(vec!["expected one of the features compile-shaders (needs shaderc) and prebuilt-spirv".to_owned()])
}
