//! The real models of tests.

use std::{io::Write as _, path::Path};

use super::{LoadOptions, Model, load};
use crate::scene::Mesh;

/// A mesh of `SURFEL_DATA`, or of the folder `shared/data` beside the repository; says so where it is not there.
///
/// # Panics
/// If the file is there and is no mesh that can be read.
pub fn real_mesh(name: &str) -> Option<Mesh> {
    let folder = std::env::var_os("SURFEL_DATA");
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    let path = folder.map_or_else(beside, Into::into).join(name);
    if !path.exists() {
        // Written past the harness, which shows no output of tests that pass.
        let mut stderr = std::io::stderr();
        let _ = writeln!(stderr, "SKIPPED: {} is not there (set SURFEL_DATA to its folder)", path.display());
        return None;
    }
    match load(&path, &LoadOptions::default(), &()).unwrap().model {
        Model::Mesh(mesh) => Some(mesh),
        Model::Splats { .. } | Model::Points(_) => panic!("{name} is a mesh"),
    }
}
