//! The scene as bytes of each format.

use std::fmt::Write as _;

use glam::DVec3;

use super::{CORNERS, Sample};
#[cfg(feature = "gltf")]
use super::{linear, tetrahedron};

pub fn rows(samples: &[Sample], row: impl Fn(&Sample) -> String) -> String {
    samples.iter().map(row).collect()
}

pub fn place(sample: &Sample, between: &str) -> String {
    let DVec3 { x, y, z } = sample.position;
    format!("{x}{between}{y}{between}{z}")
}

pub fn color(sample: &Sample) -> String {
    sample.srgb.map(|byte| byte.to_string()).join(" ")
}

pub fn normal(sample: &Sample) -> String {
    sample.normal.to_array().map(|v| v.to_string()).join(" ")
}

pub fn ply(samples: &[Sample], faces: &[[u32; 3]]) -> String {
    let mut text = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
        property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\nproperty uchar green\n\
        property uchar blue\n",
        samples.len()
    );
    if !faces.is_empty() {
        let _ = writeln!(text, "element face {}\nproperty list uchar int vertex_indices", faces.len());
    }
    text.push_str("end_header\n");
    text.push_str(&rows(samples, |s| format!("{} {} {}\n", place(s, " "), normal(s), color(s))));
    text + &faces.iter().map(|[a, b, c]| format!("3 {a} {b} {c}\n")).collect::<String>()
}

pub fn pcd(samples: &[Sample]) -> String {
    let header = format!(
        "VERSION 0.7\nFIELDS x y z normal_x normal_y normal_z rgb\nSIZE 8 8 8 4 4 4 4\nTYPE F F F F F F U\n\
        WIDTH {}\nHEIGHT 1\nDATA ascii\n",
        samples.len()
    );
    let packed = |[r, g, b]: [u8; 3]| u32::from_be_bytes([0, r, g, b]);
    header + &rows(samples, |s| format!("{} {} {}\n", place(s, " "), normal(s), packed(s.srgb)))
}

pub fn off(corners: &[Sample]) -> String {
    let faces: String = CORNERS.iter().map(|[a, b, c]| format!("3 {a} {b} {c}\n")).collect();
    format!("COFF\n4 4 6\n{}{faces}", rows(corners, |s| format!("{} {}\n", place(s, " "), color(s))))
}

pub fn stl(corners: &[Sample]) -> String {
    let vertex = |i: u32| format!("vertex {}\n", place(&corners[i as usize], " "));
    let facet = |t: &[u32; 3]| {
        format!("facet normal 0 0 0\nouter loop\n{}endloop\nendfacet\n", t.map(vertex).concat())
    };
    format!("solid\n{}endsolid\n", CORNERS.iter().map(facet).collect::<String>())
}

#[cfg(feature = "gltf")]
pub fn gltf(origin: DVec3) -> String {
    use base64::{Engine as _, engine::general_purpose::STANDARD};

    let local = tetrahedron(DVec3::ZERO);
    let floats = |values: Vec<f32>| values.into_iter().flat_map(f32::to_le_bytes).collect::<Vec<u8>>();
    let positions = floats(local.iter().flat_map(|s| s.position.as_vec3().to_array()).collect());
    let normals = floats(local.iter().flat_map(|s| s.normal.to_array()).collect());
    let colors = floats(local.iter().flat_map(|s| linear(s.srgb)).collect());
    let data = [positions, normals, colors, CORNERS.concat().into_iter().map(|i| i as u8).collect()].concat();
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [0]}}],
        "nodes": [{{"mesh": 0, "translation": [{}]}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0, "NORMAL": 1, "COLOR_0": 2}}, "indices": 3}}]}}],
        "buffers": [{{"byteLength": {}, "uri": "data:;base64,{}"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 48}}, {{"buffer": 0, "byteOffset": 48, "byteLength": 48}},
            {{"buffer": 0, "byteOffset": 96, "byteLength": 64}}, {{"buffer": 0, "byteOffset": 160, "byteLength": 12}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"}},
            {{"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"}},
            {{"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC4"}},
            {{"bufferView": 3, "componentType": 5121, "count": 12, "type": "SCALAR"}}]}}"#,
        origin.to_array().map(|v| v.to_string()).join(","),
        data.len(),
        STANDARD.encode(&data),
    )
}

#[cfg(feature = "las")]
pub fn las(origin: DVec3, compressed: bool) -> Vec<u8> {
    let mut builder = las::Builder::from((1, 4));
    builder.point_format = las::point::Format::new(7).unwrap();
    builder.point_format.is_compressed = compressed;
    let transform = |offset| las::Transform { scale: 1.0 / 1024.0, offset };
    builder.transforms =
        las::Vector { x: transform(origin.x), y: transform(origin.y), z: transform(origin.z) };
    let mut writer =
        las::Writer::new(std::io::Cursor::new(Vec::new()), builder.into_header().unwrap()).unwrap();
    for Sample { position, srgb, .. } in super::samples(origin) {
        let [r, g, b] = srgb.map(|byte| u16::from(byte) * 257);
        let DVec3 { x, y, z } = position;
        let color = Some(las::Color::new(r, g, b));
        writer
            .write_point(las::Point { x, y, z, color, gps_time: Some(0.0), ..las::Point::default() })
            .unwrap();
    }
    writer.close().unwrap();
    writer.into_inner().unwrap().into_inner()
}

#[cfg(feature = "e57")]
pub fn e57(origin: DVec3) -> Vec<u8> {
    use e57::{E57Writer, Record, RecordValue};

    let mut bytes = std::io::Cursor::new(Vec::new());
    let mut writer = E57Writer::new(&mut bytes, "file").unwrap();
    let places = [Record::CARTESIAN_X_F64, Record::CARTESIAN_Y_F64, Record::CARTESIAN_Z_F64];
    let colors = [Record::COLOR_RED_U8, Record::COLOR_GREEN_U8, Record::COLOR_BLUE_U8];
    let mut scan = writer.add_pointcloud("scan", [places, colors].concat()).unwrap();
    for sample in super::samples(origin) {
        let place = sample.position.to_array().map(RecordValue::Double);
        let color = sample.srgb.map(|byte| RecordValue::Integer(byte.into()));
        scan.add_point([place, color].concat()).unwrap();
    }
    scan.finalize().unwrap();
    writer.finalize().unwrap();
    drop(writer);
    bytes.into_inner()
}
