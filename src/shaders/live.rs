//! Shaders that are compiled again while the program runs, for those who write them (feature `live-shaders`).

#[allow(dead_code, reason = "of the build's own module, a part")]
#[path = "build/mod.rs"]
mod build;

use std::{
    collections::HashMap,
    path::{Path, PathBuf},
    sync::{PoisonError, RwLock},
};

use super::ALL;

/// What takes the place of what was built, by the shader's name. What it was before stays in memory: pipelines may be made of it now.
static NEWER: RwLock<Option<HashMap<&'static str, &'static [u32]>>> = RwLock::new(None);

/// The folder that the crate was built from.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("glsl")
}

/// Compiles a folder of shaders, and takes them in the place of those there are; how many have changed. Pipelines that are there stay as they
/// are: [`crate::passes::Shaders::keep_newest`] gives them up.
///
/// # Errors
/// All that is wrong with any shader, in lines, and then nothing has changed; what host and shaders share and has changed, which wants a new build.
pub fn reload(glsl: &Path) -> Result<usize, String> {
    let built = build::build(glsl, build::HOST_STRUCTS, &[]).map_err(|errors| errors.join("\n"))?;
    if built.rust != include_str!(concat!(env!("OUT_DIR"), "/shaders/shaders.rs")) {
        let what =
            "what the host knows of shaders has changed, too (their names, inc/config.glsl, or a struct)";
        return Err(format!("{}: {what}: build the program again", glsl.display()));
    }
    let modules: HashMap<String, Vec<u32>> = built.modules.into_iter().collect();
    let mut newer = NEWER.write().unwrap_or_else(PoisonError::into_inner);
    let newer = newer.get_or_insert_default();
    let mut changed = 0;
    for shader in ALL {
        let Some(spirv) = modules.get(shader.name) else { continue };
        if newer.get(shader.name).copied().unwrap_or(shader.built()) != spirv {
            newer.insert(shader.name, spirv.clone().leak());
            changed += 1;
        }
    }
    Ok(changed)
}

pub(super) fn spirv(name: &str) -> Option<&'static [u32]> {
    NEWER.read().unwrap_or_else(PoisonError::into_inner).as_ref()?.get(name).copied()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    /// Copies `glsl/`, with a change to one file.
    fn changed(folder: &Path, file: &str, from: &str, to: &str) {
        for path in build::files_and_folders(&super::folder()).unwrap() {
            let target = folder.join(path.strip_prefix(super::folder()).unwrap());
            match path.is_dir() {
                true => fs::create_dir_all(target).unwrap(),
                false => drop(fs::copy(path, target).unwrap()),
            }
        }
        let text = fs::read_to_string(folder.join(file)).unwrap();
        assert!(text.contains(from), "{file}");
        fs::write(folder.join(file), text.replacen(from, to, 1)).unwrap();
    }

    #[test]
    fn what_compiles_takes_the_place_of_what_was_and_what_does_not_changes_nothing() {
        let folder = temp_dir::TempDir::new().unwrap();
        let overlay = &crate::shaders::VIEW_OVERLAY_FRAG;
        let before = overlay.spirv();
        changed(folder.path(), "view_overlay.frag.glsl", "void main()", "void main() oops");
        let error = reload(folder.path()).unwrap_err();
        assert!(error.contains("view_overlay.frag.glsl:") && overlay.spirv() == before, "{error}");
        changed(
            folder.path(),
            "view_overlay.frag.glsl",
            "void main()\n{",
            "void main()\n{ if (gl_FragCoord.x < -1.0) discard;",
        );
        assert_eq!(reload(folder.path()), Ok(1));
        assert!(overlay.spirv() != before);
        changed(folder.path(), "inc/config.glsl", "#define SPEC_ELLIPSES 0", "#define SPEC_ELLIPSES 99");
        assert!(reload(folder.path()).unwrap_err().ends_with("build the program again"));
        assert_eq!((reload(&super::folder()), reload(&super::folder())), (Ok(1), Ok(0)));
        assert!(overlay.spirv() == before);
    }
}
