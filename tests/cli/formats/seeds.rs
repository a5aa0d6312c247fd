//! Small files of every format, from which the fuzzer of `fuzz/` starts.

use std::{collections::BTreeSet, fs, path::Path};

use glam::DVec3;

use super::{gzip, meshes, points, zstd};
use crate::program::Folder;

/// The target that reads files of this name.
fn target(name: &str) -> &str {
    match name.rsplit('.').next() {
        Some("csv" | "pts") => "xyz",
        Some("laz") => "las",
        Some("zst") => "gz",
        Some(extension) => extension,
        None => name,
    }
}

fn hierarchy(folder: &Folder) -> Vec<u8> {
    let path = folder.path("a.surfel");
    surfel::levels_file::write_object(&path, &surfel::load::builtin::relief(60), None, &()).unwrap();
    fs::read(path).unwrap()
}

/// Writes them to the folder that `SURFEL_CORPUS` names, a folder of seeds a target.
#[test]
fn every_target_of_the_fuzzer_has_seeds() {
    let nowhere = Folder::new();
    let corpus = std::env::var_os("SURFEL_CORPUS").map_or(nowhere.path("corpus"), Into::into);
    let mut seeds = points::files(&points::ball(DVec3::ZERO)[..8]);
    seeds.extend(meshes::files(DVec3::ZERO));
    let rows = super::content(&seeds, "a.xyz");
    let packed = [("a.gz", gzip(rows)), ("a.zst", zstd(rows)), ("a.surfel", hierarchy(&nowhere))];
    seeds.extend(packed);
    for (name, bytes) in &seeds {
        let folder = corpus.join(target(name));
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join(name), bytes).unwrap();
    }
    // The package is shipped without them.
    if let Ok(targets) = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/fuzz_targets")) {
        let targets: BTreeSet<_> = targets.map(|entry| entry.unwrap().path()).collect();
        let names: BTreeSet<_> =
            targets.iter().map(|path| path.file_stem().unwrap().to_str().unwrap()).collect();
        assert_eq!(names, seeds.iter().map(|(name, _)| target(name)).collect());
    }
}
