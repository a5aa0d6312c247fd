use std::fs;

use base64::{Engine as _, engine::general_purpose::STANDARD};
use glam::Vec3;

use super::*;
use crate::{
    load::{LoadOptions, Model, hostile::attack, input::of_bytes, load},
    scene::{Colors, Mesh, Points},
};

/// Four positions, a normal each, colors of bytes, and indices of two triangles.
fn data() -> Vec<u8> {
    let positions = [[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    let mut data: Vec<u8> = positions.concat().into_iter().flat_map(f32::to_le_bytes).collect();
    data.extend([[0.0_f32, 0.0, 1.0]; 4].concat().into_iter().flat_map(f32::to_le_bytes));
    data.extend([[255, 0, 51, 255], [0, 255, 0, 128], [0, 0, 255, 255], [255; 4]].concat());
    data.extend([0_u16, 1, 2, 1, 3, 2].into_iter().flat_map(u16::to_le_bytes));
    data
}

const ACCESSORS: &str = r#"
"bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 48},
    {"buffer": 0, "byteOffset": 96, "byteLength": 16}, {"buffer": 0, "byteOffset": 112, "byteLength": 12}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
    {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"},
    {"bufferView": 2, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC4"},
    {"bufferView": 3, "componentType": 5123, "count": 6, "type": "SCALAR"}]"#;

/// A file of one mesh of this primitive in these nodes.
fn json(nodes: &str, primitive: &str, buffer: &str) -> String {
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [0]}}], "nodes": [{nodes}],
        "meshes": [{{"primitives": [{primitive}]}}],
        "materials": [{{"pbrMetallicRoughness": {{"baseColorFactor": [0.5, 1, 1, 0.5]}}}},
            {{"alphaMode": "BLEND", "pbrMetallicRoughness": {{"baseColorFactor": [1, 1, 1, 0.5],
            "baseColorTexture": {{"index": 0}}}}}}],
        "buffers": [{{{buffer}"byteLength": 124}}], {ACCESSORS}}}"#
    )
}

fn with_data(nodes: &str, primitive: &str) -> String {
    let uri = format!(r#""uri": "data:application/octet-stream;base64,{}", "#, STANDARD.encode(data()));
    json(nodes, primitive, &uri)
}

fn glb(nodes: &str, primitive: &str) -> Vec<u8> {
    let mut json = json(nodes, primitive, "").into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let chunk = |kind: &[u8; 4], data: &[u8]| [&(data.len() as u32).to_le_bytes(), &kind[..], data].concat();
    let chunks = [chunk(b"JSON", &json), chunk(b"BIN\0", &data())].concat();
    [&b"glTF"[..], &2_u32.to_le_bytes(), &(chunks.len() as u32 + 12).to_le_bytes(), &chunks].concat()
}

const ALL: &str =
    r#"{"attributes": {"POSITION": 0, "NORMAL": 1, "COLOR_0": 2}, "indices": 3, "material": 0}"#;

fn loaded(text: &str) -> Loaded {
    of_bytes("a.gltf", text.as_bytes(), parse).unwrap()
}

fn mesh(loaded: Loaded) -> Mesh {
    match loaded.model {
        Model::Mesh(mesh) => mesh,
        _ => panic!("no mesh"),
    }
}

fn notes(loaded: &Loaded) -> Vec<String> {
    loaded.notes.iter().map(ToString::to_string).collect()
}

#[test]
fn text_and_glb_are_the_same_mesh_in_place_with_linear_colors() {
    let nodes = r#"{"children": [1], "translation": [4600000.000123456, 0, 300]},
        {"mesh": 0, "rotation": [0, 0, 0.70710678118654752, 0.70710678118654752], "scale": [2, 1, 1]}"#;
    for (bytes, format) in [(with_data(nodes, ALL).into_bytes(), "glTF"), (glb(nodes, ALL), "GLB")] {
        let loaded = of_bytes("a", &bytes, parse).unwrap();
        assert_eq!(
            (loaded.format.as_str(), loaded.up, loaded.metres_per_unit),
            (format, Some(DVec3::Y), Some(1.0))
        );
        assert_eq!(notes(&loaded), ["1 material's texture, which is not supported, ignored"]);
        let mesh = mesh(loaded);
        assert_eq!(mesh.triangles, [[0, 1, 2], [1, 3, 2]]);
        assert_eq!(mesh.positions[0], DVec3::new(4_600_000.000_123_456, 0.0, 300.0));
        assert!(mesh.positions[1].distance(DVec3::new(4_600_000.000_123_456, 2.0, 300.0)) < 1e-8);
        assert_eq!(mesh.normals, Some(vec![Vec3::Z; 4]));
        let Colors::Each(colors) = mesh.colors else { panic!("colors") };
        // Bytes are linear here, and the material is opaque.
        assert_eq!(colors[0], [0.5, 0.0, 0.2, 1.0]);
        assert_eq!(colors[1], [0.0, 1.0, 0.0, 1.0]);
    }
}

#[test]
fn mirrors_turn_triangles_and_normals_stay_on_their_side() {
    let mirrored = mesh(loaded(&with_data(r#"{"mesh": 0, "scale": [1, 1, -1]}"#, ALL)));
    assert_eq!(mirrored.triangles[0], [0, 2, 1]);
    assert_eq!(mirrored.normals, Some(vec![-Vec3::Z; 4]));
    let matrix = r#"{"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1]}"#;
    assert_eq!(mesh(loaded(&with_data(matrix, ALL))).positions[1], DVec3::new(6.0, 6.0, 7.0));
}

#[test]
fn all_modes_are_triangles_or_points() {
    let node = r#"{"mesh": 0}"#;
    let of_mode = |mode: u32| {
        loaded(&with_data(node, &format!(r#"{{"attributes": {{"POSITION": 0}}, "mode": {mode}}}"#)))
    };
    assert_eq!(mesh(of_mode(5)).triangles, [[0, 1, 2], [2, 1, 3]]);
    assert_eq!(mesh(of_mode(6)).triangles, [[0, 1, 2], [0, 2, 3]]);
    let list = of_mode(4);
    assert_eq!(notes(&list)[0], "1 corner that is no whole triangle left out");
    assert!(matches!(mesh(list).colors, Colors::Uniform(_)));
    let points =
        loaded(&with_data(node, &ALL.replace("}", r#", "mode": 0}"#).replacen(r#", "mode": 0}"#, "}", 1)));
    let Model::Points(Points { positions, normals, colors, .. }) = points.model else { panic!("no points") };
    assert_eq!((positions.len(), normals.map(|n| n.len())), (6, Some(6)));
    assert_eq!(colors.get(3), Some([0.0, 1.0, 0.0, 1.0]));
    let lines = of_mode(3);
    assert_eq!(notes(&lines)[0], "1 primitive of lines left out");
    let blended = ALL.replace(r#""material": 0"#, r#""material": 1"#);
    assert_eq!(mesh(loaded(&with_data(node, &blended))).colors.get(0), Some([1.0, 0.0, 0.2, 0.5]));
    let bare = format!(r#"{ALL}, {{"attributes": {{"POSITION": 0}}, "indices": 3}}"#);
    let both = loaded(&with_data(node, &bare));
    assert_eq!(notes(&both)[0], "1 primitive without normals, so that those of all are replaced");
    assert!(mesh(both).normals.is_none());
    let alone = loaded(&with_data(node, r#"{"attributes": {"POSITION": 0}, "indices": 3}"#));
    assert!(notes(&alone).iter().all(|note| !note.contains("normals")), "{:?}", notes(&alone));
    let twice = mesh(loaded(&with_data(node, &format!("{ALL}, {ALL}"))));
    assert_eq!((twice.positions.len(), twice.triangles.len()), (4, 4));
}

#[track_caller]
fn refuses(text: &str, expected: &str) {
    let error = of_bytes("a.gltf", text.as_bytes(), parse).unwrap_err();
    assert_eq!((error.to_string(), error.exit_code()), (format!("a.gltf: {expected}"), 1));
}

#[test]
fn faults_are_named() {
    let node = r#"{"mesh": 0}"#;
    let whole = with_data(node, ALL);
    let change = |from: &str, to: &str| {
        assert!(whole.contains(from), "{from}");
        whole.replace(from, to)
    };
    refuses(
        &change(r#"{"mesh": 0}"#, r#"{"mesh": 0, "children": [0]}"#),
        "node 0: within itself or in two places; expected a tree",
    );
    refuses(&change(r#"{"mesh": 0}"#, r#"{"children": [9]}"#), "node 9: not there; the file has 1");
    refuses(&change(r#"{"mesh": 0}"#, r#"{"mesh": 1}"#), "node 0: of mesh 1; the file has 1");
    refuses(&change(r#""material": 0"#, r#""material": 7"#), "material 7: not there; the file has 2");
    refuses(&change(r#""POSITION": 0"#, r#""POSITION": 9"#), "accessor 9: not there; the file has 4");
    refuses(
        &change(r#""POSITION": 0"#, r#""POSITION": 3"#),
        "accessor 3: numbers of another shape or kind than positions have",
    );
    refuses(
        &change(r#""count": 6"#, r#""count": 7"#),
        "accessor 3: 7 elements of 2 bytes do not fit its buffer view of 12",
    );
    refuses(
        &change(r#""count": 6"#, r#""count": 0"#),
        "accessor 3: 0 elements of 2 bytes do not fit its buffer view of 12",
    );
    let huge = change(r#""count": 4, "type": "VEC3""#, r#""count": 18446744073709551615, "type": "VEC3""#);
    refuses(&huge, "18446744073709551615 points; expected at most 4294967295");
    refuses(&change(r#""byteLength": 124"#, r#""byteLength": 125"#), "buffer 0: 124 bytes; expected 125");
    refuses(&change(";base64,", ";base64,*"), "buffer 0: data that is not base64");
    refuses(&change(r#""version": "2.0""#, r#""version": "1.0""#), "asset: version '1.0'; expected 2.0");
    let draco = change(r#""scenes""#, r#""extensionsRequired": ["KHR_draco_mesh_compression"], "scenes""#);
    refuses(&draco, "needs the extension 'KHR_draco_mesh_compression'; expected a file without it");
    let mut indices = data();
    *indices.last_mut().unwrap() = 1;
    let far = whole.replace(&STANDARD.encode(data()), &STANDARD.encode(&indices));
    refuses(&far, "accessor 3: vertex 258, but the primitive has 4, from 0");
    for deep in ["[", "{\"a\":"].map(|open| open.repeat(100_000)) {
        for name in ["asset", "nodes", "extras"] {
            let text = format!(r#"{{"{name}": {deep}"#);
            let error = of_bytes("a", text.as_bytes(), parse).unwrap_err().to_string();
            assert!(error.starts_with("a: JSON: ") && error.len() < 200, "{error}");
        }
    }
    // A chain of nodes needs no deep calls, and instances of instances are counted before they are made.
    let chain: String = (1..100_000).map(|i| format!(r#"{{"children": [{i}]}}, "#)).collect();
    assert_eq!(mesh(loaded(&with_data(&format!(r#"{chain}{{"mesh": 0}}"#), ALL))).positions.len(), 4);
}

#[test]
fn many_instances_are_counted_before_memory_is_taken() {
    let children: Vec<String> = (1..400_000).map(|i| i.to_string()).collect();
    let leaves = r#", {"mesh": 0}"#.repeat(399_999);
    let nodes = format!(r#"{{"children": [{}]}}{leaves}"#, children.join(","));
    // They share their vertices, but each has corners of its own.
    let primitives = vec![ALL; 40].join(",");
    let error = of_bytes("a", with_data(&nodes, &primitives).as_bytes(), parse).unwrap_err().to_string();
    assert!(error.starts_with("a: 1599996 vertices in all nodes together, about "), "{error}");
}

#[test]
fn other_files_are_read_from_the_folder_and_not_from_outside() {
    let outer = temp_dir::TempDir::new().unwrap();
    let folder = outer.path().join("in");
    fs::create_dir_all(folder.join("a b")).unwrap();
    fs::write(folder.join("a b/data.bin"), data()).unwrap();
    fs::write(outer.path().join("data.bin"), data()).unwrap();
    let path = folder.join("a.gltf");
    let try_uri = |uri: &str, allow_outside: bool| {
        fs::write(&path, json(r#"{"mesh": 0}"#, ALL, &format!(r#""uri": "{uri}", "#))).unwrap();
        load(&path, &LoadOptions { allow_outside, ..LoadOptions::default() }, &())
            .map(mesh)
            .map_err(|e| e.to_string().replace(&format!("{}: ", path.display()), ""))
    };
    assert_eq!(try_uri("a%20b/data.bin", false).unwrap().positions.len(), 4);
    let outside = "buffer 0: '../data.bin' is outside of the file's folder; expected it there or below, or \
        --allow-outside";
    assert_eq!(try_uri("../data.bin", false).unwrap_err(), outside);
    assert_eq!(try_uri("../data.bin", true).unwrap().positions.len(), 4);
    assert!(try_uri("/dev/zero", true).unwrap_err().contains("is not a file"));
    assert!(try_uri("none.bin", false).unwrap_err().starts_with("buffer 0: 'none.bin': cannot read: "));
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(outer.path().join("data.bin"), folder.join("link.bin")).unwrap();
        assert_eq!(try_uri("link.bin", false).unwrap_err(), outside.replace("../data", "link"));
    }
    let piped = json(r#"{"mesh": 0}"#, ALL, r#""uri": "data.bin", "#);
    refuses(&piped, "buffer 0: 'data.bin' is another file, and standard input has no folder for it");
}

#[test]
fn hostile_bytes_are_refused_or_read() {
    let nodes = r#"{"children": [1], "translation": [1, 2, 3]}, {"mesh": 0}"#;
    attack(&[with_data(nodes, ALL).into_bytes(), glb(nodes, ALL)], 20_000, parse);
}
