//! Small files of every format, from which the fuzzer of `fuzz/` starts.

use std::{collections::BTreeSet, fs, path::Path};

use glam::DVec3;

use super::{gzip, meshes, points, zstd};
use crate::{octree_files::Octree, program::Folder};

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

/// COPC, and the three files of Potree as the target has them: the lengths of the first two before all.
fn octrees() -> [Vec<u8>; 2] {
    let point = |i: i32| ([100 * i, 37 * i * i % 4096, 4 * i], [300 * i as u16; 3]);
    let octree = Octree::of(&(0..60).map(point).collect::<Vec<_>>(), [0; 3], 1 << 13, 4);
    let [metadata, hierarchy, nodes] = octree.potree(1);
    let lengths =
        [metadata.len(), hierarchy.len()].map(|length| u16::try_from(length).unwrap().to_le_bytes());
    [octree.copc(1).0, [lengths.concat(), metadata, hierarchy, nodes].concat()]
}

const MATERIALS: &[u8] = b"newmtl a\nKd 0.5 1 0\nd 0.5\nnewmtl b\nKd 1 0 0\nTr 0.25\nmap_Kd b.png\n";

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
    let [copc, potree] = octrees();
    let scene = include_bytes!("../../../../examples/spheres.toml").to_vec();
    seeds.extend([("a.toml", scene), ("a.mtl", MATERIALS.to_vec())]);
    seeds.extend([("copc.octree", copc), ("potree.octree", potree)]);
    for (name, bytes) in &seeds {
        let folder = corpus.join(target(name));
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join(name), bytes).unwrap();
    }
    if let Ok(targets) = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/fuzz_targets")) {
        let targets: BTreeSet<_> = targets.map(|entry| entry.unwrap().path()).collect();
        let names: BTreeSet<_> =
            targets.iter().map(|path| path.file_stem().unwrap().to_str().unwrap()).collect();
        assert_eq!(names, seeds.iter().map(|(name, _)| target(name)).collect());
    }
}
