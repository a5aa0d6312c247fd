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
    let cases = [
        ("a.ply", TRIANGLE_PLY),
        ("a.obj", TRIANGLE_PLY),
        ("b.OBJ", TRIANGLE_OBJ),
        ("a.ply", TRIANGLE_OBJ),
        ("a", TRIANGLE_OBJ),
        ("a.stl", b"\xef\xbb\xbf# by hand\r\n\r\nOFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
    ];
    for (name, bytes) in cases {
        let Ok(Model::Mesh(mesh)) = load_bytes(name, bytes) else { panic!("{name}") };
        assert_eq!((mesh.triangles, mesh.positions.len()), (vec![[0, 1, 2]], 3));
    }
    for name in ["a", "a.ply", "a.xyz", "a.las"] {
        let Ok(Model::Points(points)) = load_bytes(name, b"0 0 0\n1 2 3\n") else { panic!("{name}") };
        assert_eq!(points.positions.len(), 2);
    }
}

#[test]
fn a_header_of_pcd_tells_also_a_body_that_is_binary() {
    for comment in ["", "# .PCD v0.7 - Point Cloud Data file format\n", "# by a program of its own\n"] {
        let header = format!(
            "{comment}VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nHEIGHT 1\nDATA binary\n"
        );
        let bytes = [header.as_bytes(), &[0; 24]].concat();
        for name in ["a", "a.pcd", "a.stl"] {
            let Ok(Model::Points(points)) = load_bytes(name, &bytes) else { panic!("{name}") };
            assert_eq!(points.positions.len(), 2);
        }
    }
}

#[test]
fn what_is_no_model_is_named() {
    let cases: [(&str, &[u8], &str); 17] = [
        ("a.ply", b"", "the file is empty"),
        ("a.ply", b"plywood", "named .ply, but its first line is not 'ply'"),
        (
            "a.ply",
            b"version https://git-lfs.github.com/spec/v1\noid sha256:0\n",
            "this is a git-lfs pointer, not the file itself (run `git lfs pull`)",
        ),
        ("a.obj", b"\x89PNG\r\n\x1a\n", "this is a PNG picture"),
        ("a.las", b"\xff\xd8\xff\xe0", "this is a JPEG picture"),
        ("a.ply", b"PK\x03\x04", "this is a zip archive (unpack it first)"),
        (
            "a.laz",
            b"\n<!DOCTYPE html>\n<title>404</title>",
            "this is an HTML page, perhaps of a download that failed",
        ),
        ("a.obj", b"<Html>", "this is an HTML page, perhaps of a download that failed"),
        ("a.json", b"{\"camera\": 1}", "this is JSON, but neither glTF nor the metadata of Potree 2"),
        ("a.json", b" [1, 2]", "this is JSON, but neither glTF nor the metadata of Potree 2"),
        ("a.obj", b"v 0 0 0\0", "named .obj, but its content is binary of another format"),
        ("a", b"\x01\0\0\0", "binary, of an unknown format"),
        ("a", b"Once upon a time", "text of an unknown format"),
        ("a.txt.bak", b"\xff\xfe1\0", "this is text in UTF-16 (save it as UTF-8)"),
        ("a.toml", b"[[object]]\n", "this is a scene file"),
        ("a.ply", b"\r\n \n", "named .ply, but its first line is not 'ply'"),
        ("a.pcd", &[0; 60], "named .pcd, but its content is binary of another format"),
    ];
    for (name, bytes, found) in cases {
        let expected = format!("/{name}: {found}; expected {}", super::expected());
        assert_eq!(load_bytes(name, bytes).unwrap_err(), expected);
    }
}

#[test]
fn models_and_archives_of_others_say_what_to_do() {
    let step = "this is a STEP model (save it as STL or OBJ)";
    let iges = "this is an IGES model (save it as STL or OBJ)";
    let dxf = "this is a DXF drawing (save it as STL or OBJ)";
    let usd = "this is a USD scene (save it as glTF or OBJ)";
    let tar = "this is a tar archive (unpack it first)";
    let zip = "this is a zip archive (unpack it first)";
    let grid = "this is an ESRI grid of heights without places (save it as XYZ or LAS)";
    let gaussians = "this is a viewer's own format of Gaussians (save them as PLY)";
    let mut of_tar = vec![0_u8; 1024];
    of_tar[..5].copy_from_slice(b"a.ply");
    let old_tar = of_tar.clone();
    of_tar[257..262].copy_from_slice(b"ustar");
    let of_iges = format!("{:72}S{:>7}\r\n{:72}G{:>7}\r\n", "A part", 1, "1H,,1H;", 1);
    let of_step = b"ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('a'),'2;1');\n";
    let marked_step = [b"\xef\xbb\xbf\r\n", &of_step[..]].concat();
    let cases: [(&str, &[u8], &str); 24] = [
        ("a", of_step, step),
        ("a.obj", &marked_step, step),
        ("a.step", b"something that was cut off", step),
        ("a.STP", b"\0\x01", step),
        ("a", of_iges.as_bytes(), iges),
        ("a.igs", b"a part", iges),
        ("a.txt", b"  0\r\nSECTION\r\n  2\r\nHEADER\r\n", dxf),
        ("a.xyz", b"999\nby a program\n999\n1 2 3\n0\nSECTION\n2\nENTITIES\n", dxf),
        ("a", b"AutoCAD Binary DXF\r\n\x1a\0", dxf),
        ("a.dxf", b"cut off", dxf),
        ("a.ply", b"#usda 1.0\n(\n)\n", usd),
        ("a", b"PXR-USDC\0\0", usd),
        ("a.usdz", b"PK\x03\x04", usd),
        ("a.usd", b"\0\0", usd),
        ("a.las", &of_tar, tar),
        ("a.tar", &old_tar, tar),
        ("a.ply", b"PK\x03\x04", zip),
        ("a.3mf", b"PK\x03\x04", "this is a 3MF model (save it as STL or OBJ)"),
        ("a.dae", b"<?xml version=\"1.0\"?>\n<COLLADA/>", "this is a COLLADA scene (save it as glTF or OBJ)"),
        ("a.svg", b"<?xml version=\"1.0\"?>\n<svg/>", "this is an XML file"),
        ("a.splat", &[1; 64], gaussians),
        ("a.asc", b"ncols 4\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\n1 2 3 4\n5 6 7 8\n", grid),
        (
            "a",
            b"NROWS  2\r\nNCOLS  3\r\nXLLCENTER 0\r\nYLLCENTER 0\r\nCELLSIZE 1\r\n1 2 3\r\n5 6 7\r\n",
            grid,
        ),
        ("a.rcp", &[0; 9], "this is a scanner program's own file (export E57 or LAS of it)"),
    ];
    for (name, bytes, found) in cases {
        let error = load_bytes(name, bytes).err();
        let expected = format!("/{name}: {found}; expected {}", super::expected());
        assert_eq!(error.as_deref(), Some(&*expected), "{name}");
    }
    // Other words above rows of places are titles.
    let titles = b"ncols\nnrows 2\ncellsized 1\n1 2 3\n5 6 7\n";
    assert!(matches!(load_bytes("a.asc", titles), Ok(Model::Points(_))));
    // What can be read is, whatever it is called.
    for name in ["a.dxf", "a.step", "a.tar"] {
        assert!(matches!(load_bytes(name, TRIANGLE_OBJ), Ok(Model::Mesh(_))), "{name}");
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
    assert!(is_folder.ends_with(&format!(": a folder; expected {}", super::expected())), "{is_folder}");
    let device = load(std::path::Path::new("/dev/null"), &LoadOptions::default(), &()).unwrap_err();
    assert!(device.to_string().starts_with("/dev/null: neither a file nor `-`"), "{device}");
}

#[cfg(all(feature = "gzip", feature = "zstd"))]
#[test]
fn compressed_files_are_told_by_what_is_in_them() {
    use std::io::Write as _;

    use ruzstd::encoding::{CompressionLevel, compress_to_vec};

    let gzip = |bytes: &[u8]| {
        let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
        encoder.write_all(bytes).unwrap();
        encoder.finish().unwrap()
    };
    let zstd = |bytes: &[u8]| compress_to_vec(bytes, CompressionLevel::Fastest);
    // Nothing but the name says that this is OBJ.
    let odd_obj = b"curv 1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for (name, bytes) in
        [("a.obj.gz", gzip(odd_obj)), ("b.obj.zst", zstd(odd_obj)), ("c", gzip(TRIANGLE_PLY))]
    {
        assert!(matches!(load_bytes(name, &bytes), Ok(Model::Mesh(_))), "{name}");
    }
    let twice = load_bytes("a.gz", &gzip(&zstd(b"0 0 0\n"))).unwrap_err();
    assert_eq!(twice, "/a.gz: compressed twice, by gzip and zstd; expected once");
    let empty = load_bytes("a.ply.gz", &gzip(b"")).unwrap_err();
    assert!(empty.starts_with("/a.ply.gz: the file is empty; expected "), "{empty}");
}

#[test]
fn a_file_of_nothing_is_refused_and_says_why() {
    let of = |count: usize, row: &str| {
        format!(
            "ply\nformat ascii 1.0\nelement vertex {count}\nproperty float x\nproperty float y\nproperty float z\n\
            {row}end_header\n"
        )
    };
    let cases = [
        ("a.ply", of(0, ""), "without points; expected some"),
        ("a.off", "OFF\n0 0 0\n".to_owned(), "without points; expected some"),
        ("a.stl", "solid a\nendsolid a\n".to_owned(), "without triangles; expected some"),
    ];
    for (name, text, words) in cases {
        let error = load_bytes(name, text.as_bytes()).unwrap_err();
        assert!(error.starts_with(&format!("/{name}: a ")) && error.ends_with(words), "{error}");
    }
}
