//! What all targets do with a file.

use std::{
    fs,
    io::Cursor,
    path::{Path, PathBuf},
};

use surfel::{
    Error, ErrorKind,
    levels_file::LevelsFile,
    load::{LoadOptions, PointOctree, load, load_bytes, load_scene_file},
};

/// Reads it as a file of this name. It may be refused, in one line that names it; the fuzzer sees panics, hangs and
/// memory.
pub fn read(name: &str, bytes: &[u8]) {
    if let Err(error) = load_bytes(Path::new(name), bytes.to_vec(), &LoadOptions::default(), &()) {
        check(&error, name);
    }
}

/// It is an error of the file's content, in one line that starts with the name.
fn check(error: &Error, name: &str) {
    let text = error.to_string();
    let is_input = matches!(error.kind(), ErrorKind::Input { .. });
    assert!(is_input && text.starts_with(name) && !text.contains('\n'), "{text}");
}

/// Writes files into a folder of this process, and tells it.
fn written(files: &[(&str, &[u8])]) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("surfel_fuzz_{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    for (name, bytes) in files {
        fs::write(folder.join(name), bytes).expect("a file");
    }
    folder
}

/// Reads it as a scene file, of objects that are not there.
pub fn read_scene(bytes: &[u8]) {
    let folder = written(&[("a.toml", bytes)]);
    if let Err(error) = load_scene_file(&folder.join("a.toml"), &LoadOptions::default()) {
        check(&error, &folder.to_string_lossy());
    }
}

/// Reads it as the materials of an OBJ file, which is read whatever they are.
pub fn read_materials(bytes: &[u8]) {
    let obj = b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 3 2 1\n";
    let folder = written(&[("a.obj", obj), ("a.mtl", bytes)]);
    load(&folder.join("a.obj"), &LoadOptions::default(), &()).expect("a mesh");
}

/// Reads it as COPC, or as the three files of Potree: the lengths of the first two, of two bytes each, stand before them.
pub fn read_octree(bytes: &[u8]) {
    let (folder, name) = match bytes.split_first_chunk::<4>() {
        Some((lengths, rest)) if lengths != b"LASF" => {
            let [a, b, c, d] = *lengths;
            let [metadata, hierarchy] = [[a, b], [c, d]].map(|length| usize::from(u16::from_le_bytes(length)));
            let (metadata, rest) = rest.split_at(metadata.min(rest.len()));
            let (hierarchy, nodes) = rest.split_at(hierarchy.min(rest.len()));
            let files = [("metadata.json", metadata), ("hierarchy.bin", hierarchy), ("octree.bin", nodes)];
            (written(&files), "metadata.json")
        }
        // What is not COPC is taken for Potree's, whose files are there then.
        _ => {
            let files = [("a.copc.laz", bytes), ("hierarchy.bin", b"".as_slice()), ("octree.bin", b"")];
            (written(&files), "a.copc.laz")
        }
    };
    let read = PointOctree::open(&folder.join(name), &LoadOptions::default()).and_then(|mut octree| {
        let all = octree.choose(&|_| true)?;
        octree.read(&all, &())
    });
    if let Err(error) = read {
        check(&error, &folder.to_string_lossy());
    }
}

/// Panics of other crates' decoders, which `load` makes errors, are no findings.
pub fn forgive_foreign_decoders() {
    let abort = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if !surfel::load::runs_foreign_decoder() {
            abort(panic);
        }
    }));
}

/// Bytes of a hierarchy's header and of an entry of its table (`docs/format.md`).
const HEADER_BYTES: usize = 256;
const ENTRY_BYTES: usize = 128;

/// Reads it as a hierarchy, with all checksums put right: what is behind them is to be looked at, too. What is refused is refused as in [`read`],
/// and what is read takes no more memory than its bytes account for.
pub fn read_levels(bytes: &[u8]) {
    let mut bytes = bytes.to_vec();
    sign(&mut bytes);
    let read = LevelsFile::new(Path::new("a.surfel"), Cursor::new(&bytes), bytes.len() as u64)
        .and_then(|mut file| file.load(None, u64::MAX, &()));
    match read {
        Ok(chosen) => {
            let held = chosen.object.leaves.bytes() + chosen.object.nodes.bytes();
            assert!(held <= 2 * bytes.len() as u64, "{held} of {}", bytes.len());
        }
        Err(error) => check(&error, "a.surfel"),
    }
}

fn sign(bytes: &mut [u8]) {
    if bytes.len() < HEADER_BYTES {
        return;
    }
    let number = |bytes: &[u8], at: usize| u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap_or_default());
    let table = usize::try_from(number(bytes, 32)).unwrap_or(usize::MAX).min(bytes.len());
    for entry in (0..(bytes.len() - table) / ENTRY_BYTES).map(|i| table + i * ENTRY_BYTES) {
        let (at, size) = (number(bytes, entry) as usize, number(bytes, entry + 8) as u32 as usize);
        if let Some(page) = at.checked_add(size).and_then(|end| bytes.get(at..end)) {
            let crc = crc32fast::hash(page);
            bytes[entry + 12..entry + 16].copy_from_slice(&crc.to_le_bytes());
        }
    }
    let crc = crc32fast::hash(&bytes[table..]);
    bytes[44..48].copy_from_slice(&crc.to_le_bytes());
    let crc = crc32fast::hash(&bytes[..HEADER_BYTES - 4]);
    bytes[HEADER_BYTES - 4..HEADER_BYTES].copy_from_slice(&crc.to_le_bytes());
}
