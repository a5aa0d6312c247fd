//! The format of a file, by its content.

use std::path::Path;

use crate::error::{Error, Result};

/// The formats that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    /// Starts with `ply` and a line end.
    Ply,
    /// No magic number: named `.obj` and text.
    Obj,
}

/// Other formats that people have, by their first bytes, so that the message can name them.
const KNOWN_OTHERS: [(&[u8], &str); 9] = [
    (b"version https://git-lfs", "a git-lfs pointer, not the file itself (run `git lfs pull`)"),
    (b"LASF", "a LAS or LAZ point cloud"),
    (b"glTF", "a binary glTF model"),
    (b"solid ", "an STL model"),
    (b"OFF", "an OFF model"),
    (b"# .PCD", "a PCD point cloud"),
    (b"PK\x03\x04", "a zip archive"),
    (b"\x1f\x8b", "a gzip archive"),
    (b"\x89PNG", "a PNG picture"),
];

/// How many bytes of an OBJ file must be text for it to be taken as one.
const TEXT_PROBE_BYTES: usize = 4096;

pub(super) fn format(path: &Path, bytes: &[u8]) -> Result<Format> {
    let refuse = |found: &str| Err(Error::input(path, "", format!("{found}; expected a PLY or OBJ file")));
    if bytes.is_empty() {
        return refuse("the file is empty");
    }
    if let [b'p', b'l', b'y', b'\r' | b'\n' | b' ' | b'\t', ..] = bytes {
        return Ok(Format::Ply);
    }
    for (magic, what) in KNOWN_OTHERS {
        if bytes.starts_with(magic) {
            return refuse(&format!("this is {what}"));
        }
    }
    let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
    match extension.as_str() {
        "obj" if !bytes[..bytes.len().min(TEXT_PROBE_BYTES)].contains(&0) => Ok(Format::Obj),
        "obj" => refuse("named .obj, but its content is binary"),
        "ply" => refuse("named .ply, but its first line is not 'ply'"),
        "toml" => refuse("this is a scene file"),
        _ => refuse("unknown format"),
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use crate::load::{LoadOptions, Model, load};

    fn load_bytes(name: &str, bytes: &[u8]) -> Result<Model, String> {
        let folder = temp_dir::TempDir::new().unwrap();
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        load(&path, &LoadOptions::default(), &()).map(|loaded| loaded.model).map_err(|e| {
            assert_eq!(e.exit_code(), 1);
            e.to_string().replace(&folder.path().display().to_string(), "")
        })
    }

    const TRIANGLE_OBJ: &[u8] = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const TRIANGLE_PLY: &[u8] = b"ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty float x\r\n\
        property float y\r\nproperty float z\r\nelement face 1\r\nproperty list uchar int vertex_index\r\n\
        end_header\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2\r\n";

    #[test]
    fn the_content_decides_then_the_name() {
        for (name, bytes) in [("a.ply", TRIANGLE_PLY), ("a.obj", TRIANGLE_PLY), ("b.OBJ", TRIANGLE_OBJ)] {
            let Ok(Model::Mesh(mesh)) = load_bytes(name, bytes) else { panic!("{name}") };
            assert_eq!((mesh.triangles, mesh.positions.len()), (vec![[0, 1, 2]], 3));
        }
    }

    #[test]
    fn what_is_no_model_is_named() {
        let cases: [(&str, &[u8], &str); 8] = [
            ("a.ply", b"", "the file is empty"),
            ("a.ply", TRIANGLE_OBJ, "named .ply, but its first line is not 'ply'"),
            ("a.ply", b"plywood", "named .ply, but its first line is not 'ply'"),
            (
                "a.ply",
                b"version https://git-lfs.github.com/spec/v1\noid sha256:0\n",
                "this is a git-lfs pointer, not the file itself (run `git lfs pull`)",
            ),
            ("a.obj", b"\x89PNG\r\n\x1a\n", "this is a PNG picture"),
            ("a.obj", b"v 0 0 0\0", "named .obj, but its content is binary"),
            ("a", TRIANGLE_OBJ, "unknown format"),
            ("a.toml", b"[[object]]\n", "this is a scene file"),
        ];
        for (name, bytes, found) in cases {
            let expected = format!("/{name}: {found}; expected a PLY or OBJ file");
            assert_eq!(load_bytes(name, bytes).unwrap_err(), expected);
        }
    }

    #[test]
    fn missing_files_and_folders_are_named() {
        let folder = temp_dir::TempDir::new().unwrap();
        let missing = load(&folder.path().join("no.ply"), &LoadOptions::default(), &()).unwrap_err();
        assert_eq!(missing.exit_code(), 1);
        let expected = format!("{}/no.ply: cannot read: No such file", folder.path().display());
        assert!(missing.to_string().starts_with(&expected), "{missing}");
        let is_folder = load(folder.path(), &LoadOptions::default(), &()).unwrap_err().to_string();
        assert!(is_folder.ends_with("not a file; expected a PLY or OBJ file"), "{is_folder}");
    }
}
