//! One mesh in every format that holds meshes.

use glam::DVec3;

/// Of each file.
pub const TRIANGLES: usize = 8;

/// An octahedron of half axes of its own, counterclockwise from outside.
const CORNERS: [[f64; 3]; 6] = [
    [1.0, 0.0, 0.0],
    [0.0, 0.75, 0.0],
    [0.0, 0.0, 0.5],
    [-1.0, 0.0, 0.0],
    [0.0, -0.75, 0.0],
    [0.0, 0.0, -0.5],
];
const FACES: [[usize; 3]; TRIANGLES] =
    [[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];

/// The files' names and contents, around `origin`. None has colors or normals. The corners of STL are f32, so that
/// it has the mesh only where these hold it.
pub fn files(origin: DVec3) -> Vec<(&'static str, Vec<u8>)> {
    let rows = |start: &str| -> String {
        let row = |corner: [f64; 3]| {
            let DVec3 { x, y, z } = origin + DVec3::from(corner);
            format!("{start}{x} {y} {z}\n")
        };
        CORNERS.map(row).concat()
    };
    let faces = |start: &str, first: usize| -> String {
        FACES.map(|[a, b, c]| format!("{start} {} {} {}\n", a + first, b + first, c + first)).concat()
    };
    let places = ["x", "y", "z"].map(|name| format!("property double {name}\n")).concat();
    let ply = format!(
        "ply\nformat ascii 1.0\nelement vertex 6\n{places}element face 8\n\
        property list uchar int vertex_indices\nend_header\n{}{}",
        rows(""),
        faces("3", 0)
    );
    let mut files = vec![
        ("mesh.ply", ply.into_bytes()),
        ("mesh.obj", (rows("v ") + &faces("f", 1)).into_bytes()),
        ("mesh.off", format!("OFF\n6 8 12\n{}{}", rows(""), faces("3", 0)).into_bytes()),
        ("mesh.glb", glb(origin)),
    ];
    if origin == DVec3::ZERO {
        files.push(("mesh.stl", stl()));
    }
    files
}

fn floats(values: impl IntoIterator<Item = f64>) -> Vec<u8> {
    values.into_iter().flat_map(|value| (value as f32).to_le_bytes()).collect()
}

fn stl() -> Vec<u8> {
    let mut bytes = [&[b' '; 80][..], &8_u32.to_le_bytes()].concat();
    for face in FACES {
        bytes.extend([0; 12]);
        bytes.extend(floats(face.iter().flat_map(|corner| CORNERS[*corner])));
        bytes.extend([0; 2]);
    }
    bytes
}

/// The origin is the place of a node, whose numbers are f64.
fn glb(origin: DVec3) -> Vec<u8> {
    let indices = FACES.concat().into_iter().map(|corner| corner as u8);
    let data: Vec<u8> = floats(CORNERS.concat()).into_iter().chain(indices).collect();
    let DVec3 { x, y, z } = origin;
    let mut json = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}],
        "nodes": [{{"mesh": 0, "translation": [{x}, {y}, {z}]}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1}}]}}],
        "buffers": [{{"byteLength": 96}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 72}}, {{"buffer": 0, "byteOffset": 72, "byteLength": 24}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3"}},
            {{"bufferView": 1, "componentType": 5121, "count": 24, "type": "SCALAR"}}]}}"#
    );
    while json.len() % 4 != 0 {
        json.push(' ');
    }
    let number = |value: usize| (value as u32).to_le_bytes();
    let header = [*b"glTF", number(2), number(28 + json.len() + data.len())].concat();
    let json = [&[number(json.len()), *b"JSON"].concat()[..], json.as_bytes()].concat();
    [header, json, number(data.len()).to_vec(), b"BIN\0".to_vec(), data].concat()
}
