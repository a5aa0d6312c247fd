//! One scene in every format that can hold it, and it is the same whichever of them it comes from.

use std::{fmt::Write as _, fs, io::Cursor, path::Path};

use glam::{DVec3, Vec3};

use super::{LoadOptions, Loaded, Model, load, load_bytes};
use crate::{math::srgb::linear_from_srgb, scene::Colors};

/// Where scans lie that come in metres of a map.
const FAR: DVec3 = DVec3::new(500_000.0, 4_600_000.0, 300.0);

/// A point, as files have it.
#[derive(Clone, Copy)]
struct Sample {
    position: DVec3,
    normal: Vec3,
    srgb: [u8; 3],
}

/// 100 points of a sphere, at places that all formats can hold exactly, and whose sum with [`FAR`] is exact.
fn samples(origin: DVec3) -> Vec<Sample> {
    let sample = |i: usize| {
        let (z, turn) = (0.99 - 0.02 * i as f64, 2.4 * i as f64);
        let normal = DVec3::new(turn.cos(), turn.sin(), 0.0) * (1.0 - z * z).sqrt() + z * DVec3::Z;
        let position = origin + (normal * 1024.0).round() / 1024.0;
        Sample { position, normal: normal.as_vec3(), srgb: [2 * i as u8, 255 - i as u8, 51] }
    };
    (0..100).map(sample).collect()
}

const CORNERS: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

fn tetrahedron(origin: DVec3) -> Vec<Sample> {
    let corner = |i: usize| Sample {
        position: origin + [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z].map(|p| 1.5 * p)[i],
        normal: Vec3::Z,
        srgb: [[255, 0, 51], [0, 255, 0], [0, 0, 255], [255, 255, 255]][i],
    };
    (0..4).map(corner).collect()
}

/// What a format keeps, and how exactly.
struct Keeps {
    step: f64,
    normals: bool,
    colors: bool,
}

fn read(name: &str, bytes: &[u8]) -> Loaded {
    let folder = temp_dir::TempDir::new().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, bytes).unwrap();
    load(&path, &LoadOptions::default(), &()).unwrap_or_else(|e| panic!("{name}: {e}"))
}

fn linear(srgb: [u8; 3]) -> [f32; 4] {
    let [r, g, b] = srgb.map(|byte| linear_from_srgb(f32::from(byte) / 255.0));
    [r, g, b, 1.0]
}

#[track_caller]
fn check(name: &str, loaded: Loaded, expected: &[Sample], keeps: &Keeps) {
    let (positions, normals, colors) = match loaded.model {
        Model::Points(points) => (points.positions, points.normals, points.colors),
        Model::Mesh(mesh) => {
            // Formats without shared vertices have them in another order.
            let places = |triangle: [u32; 3]| triangle.map(|i| mesh.positions[i as usize]);
            let found: Vec<_> = mesh.triangles.iter().map(|triangle| places(*triangle)).collect();
            let wanted = CORNERS.map(|triangle| triangle.map(|i| expected[i as usize].position));
            for (found, wanted) in found.iter().flatten().zip(wanted.iter().flatten()) {
                assert!(found.distance(*wanted) <= keeps.step, "{name}");
            }
            assert_eq!(found.len(), CORNERS.len(), "{name}");
            (mesh.positions, mesh.normals, mesh.colors)
        }
        Model::Splats { .. } => panic!("{name}: splats"),
    };
    assert_eq!(positions.len(), expected.len(), "{name}");
    let nearest = |sample: &Sample| {
        let distance = |i: &usize| positions[*i].distance(sample.position);
        (0..positions.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap()
    };
    assert_eq!(normals.is_some(), keeps.normals, "{name}");
    assert_eq!(matches!(colors, Colors::Each(_)), keeps.colors, "{name}");
    for sample in expected {
        let i = nearest(sample);
        assert!(
            positions[i].distance(sample.position) <= keeps.step,
            "{name}: {} {}",
            positions[i],
            sample.position
        );
        if let Some(normals) = &normals {
            assert!(normals[i].distance(sample.normal) < 1e-6, "{name}");
        }
        if keeps.colors {
            let color = colors.get(i).unwrap();
            assert!(
                color.iter().zip(linear(sample.srgb)).all(|(a, b)| (a - b).abs() < 1e-5),
                "{name}: {color:?}"
            );
        }
    }
}

fn rows(samples: &[Sample], row: impl Fn(&Sample) -> String) -> String {
    samples.iter().map(row).collect()
}

fn place(sample: &Sample, between: &str) -> String {
    let DVec3 { x, y, z } = sample.position;
    format!("{x}{between}{y}{between}{z}")
}

fn color(sample: &Sample) -> String {
    sample.srgb.map(|byte| byte.to_string()).join(" ")
}

fn normal(sample: &Sample) -> String {
    sample.normal.to_array().map(|v| v.to_string()).join(" ")
}

fn ply(samples: &[Sample], faces: &[[u32; 3]]) -> String {
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

fn pcd(samples: &[Sample]) -> String {
    let header = format!(
        "VERSION 0.7\nFIELDS x y z normal_x normal_y normal_z rgb\nSIZE 8 8 8 4 4 4 4\nTYPE F F F F F F U\n\
        WIDTH {}\nHEIGHT 1\nDATA ascii\n",
        samples.len()
    );
    let packed = |[r, g, b]: [u8; 3]| u32::from_be_bytes([0, r, g, b]);
    header + &rows(samples, |s| format!("{} {} {}\n", place(s, " "), normal(s), packed(s.srgb)))
}

#[test]
fn points_are_the_same_from_every_text_format() {
    for origin in [DVec3::ZERO, FAR] {
        let samples = samples(origin);
        let all = Keeps { step: 0.0, normals: true, colors: true };
        check("a.ply", read("a.ply", ply(&samples, &[]).as_bytes()), &samples, &all);
        check("a.pcd", read("a.pcd", pcd(&samples).as_bytes()), &samples, &all);
        let nine = rows(&samples, |s| format!("{} {} {}\n", place(s, " "), color(s), normal(s)));
        check("a.xyz", read("a.xyz", nine.as_bytes()), &samples, &all);
        let named =
            rows(&samples, |s| format!("{},{},{}\n", normal(s), color(s), place(s, ",")).replace(' ', ","));
        let named = format!("nx,ny,nz,red,green,blue,x,y,z\n{named}");
        check("a.csv", read("a.csv", named.as_bytes()), &samples, &all);
        let bare = Keeps { normals: false, ..all };
        let pts = format!("100\n{}", rows(&samples, |s| format!("{} 0 {}\n", place(s, " "), color(s))));
        check("a.pts", read("a.pts", pts.as_bytes()), &samples, &bare);
    }
}

#[test]
fn meshes_are_the_same_from_every_format() {
    for origin in [DVec3::ZERO, FAR] {
        let corners = tetrahedron(origin);
        let colored = Keeps { step: 0.0, normals: false, colors: true };
        let all = Keeps { normals: true, ..colored };
        check("a.ply", read("a.ply", ply(&corners, &CORNERS).as_bytes()), &corners, &all);
        let faces: String = CORNERS.iter().map(|[a, b, c]| format!("3 {a} {b} {c}\n")).collect();
        let off = format!(
            "COFF\n4 4 6\n{}{faces}",
            rows(&corners, |s| format!("{} {}\n", place(s, " "), color(s)))
        );
        check("a.off", read("a.off", off.as_bytes()), &corners, &colored);
        let faces: String =
            CORNERS.iter().map(|t| format!("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1)).collect();
        let unit = |s: &Sample| s.srgb.map(|byte| (f64::from(byte) / 255.0).to_string()).join(" ");
        let obj = rows(&corners, |s| format!("v {} {}\n", place(s, " "), unit(s))) + &faces;
        check("a.obj", read("a.obj", obj.as_bytes()), &corners, &colored);
        // Corners of STL are f32.
        let step = if origin == FAR { 0.25 } else { 0.0 };
        let vertex = |i: u32| format!("vertex {}\n", place(&corners[i as usize], " "));
        let facet = |t: &[u32; 3]| {
            format!("facet normal 0 0 0\nouter loop\n{}endloop\nendfacet\n", t.map(vertex).concat())
        };
        let stl = format!("solid\n{}endsolid\n", CORNERS.iter().map(facet).collect::<String>());
        check(
            "a.stl",
            read("a.stl", stl.as_bytes()),
            &corners,
            &Keeps { step, normals: false, colors: false },
        );
    }
}

#[cfg(feature = "gltf")]
#[test]
fn a_mesh_of_gltf_is_the_same_also_far_away() {
    use base64::{Engine as _, engine::general_purpose::STANDARD};

    for origin in [DVec3::ZERO, FAR] {
        let local = tetrahedron(DVec3::ZERO);
        let floats = |values: Vec<f32>| values.into_iter().flat_map(f32::to_le_bytes).collect::<Vec<u8>>();
        let positions = floats(local.iter().flat_map(|s| s.position.as_vec3().to_array()).collect());
        let normals = floats(local.iter().flat_map(|s| s.normal.to_array()).collect());
        let colors = floats(local.iter().flat_map(|s| linear(s.srgb)).collect());
        let data =
            [positions, normals, colors, CORNERS.concat().into_iter().map(|i| i as u8).collect()].concat();
        let json = format!(
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
        );
        let all = Keeps { step: 0.0, normals: true, colors: true };
        check("a.gltf", read("a.gltf", json.as_bytes()), &tetrahedron(origin), &all);
    }
}

#[cfg(feature = "las")]
#[test]
fn points_of_las_and_laz_are_the_same() {
    for (origin, compressed) in [(DVec3::ZERO, false), (DVec3::ZERO, true), (FAR, false), (FAR, true)] {
        let mut builder = las::Builder::from((1, 4));
        builder.point_format = las::point::Format::new(7).unwrap();
        builder.point_format.is_compressed = compressed;
        let transform = |offset| las::Transform { scale: 1.0 / 1024.0, offset };
        builder.transforms =
            las::Vector { x: transform(origin.x), y: transform(origin.y), z: transform(origin.z) };
        let mut writer = las::Writer::new(Cursor::new(Vec::new()), builder.into_header().unwrap()).unwrap();
        for Sample { position, srgb, .. } in samples(origin) {
            let [r, g, b] = srgb.map(|byte| u16::from(byte) * 257);
            let DVec3 { x, y, z } = position;
            let color = Some(las::Color::new(r, g, b));
            writer
                .write_point(las::Point { x, y, z, color, gps_time: Some(0.0), ..las::Point::default() })
                .unwrap();
        }
        writer.close().unwrap();
        let keeps = Keeps { step: 0.0, normals: false, colors: true };
        let bytes = writer.into_inner().unwrap().into_inner();
        // Either has the other's name, too.
        check("a.laz", read("a.laz", &bytes), &samples(origin), &keeps);
        check("a.las", read("a.las", &bytes), &samples(origin), &keeps);
    }
}

#[cfg(feature = "e57")]
#[test]
fn points_of_e57_are_the_same() {
    use e57::{E57Writer, Record, RecordValue};

    for origin in [DVec3::ZERO, FAR] {
        let mut bytes = Cursor::new(Vec::new());
        let mut writer = E57Writer::new(&mut bytes, "file").unwrap();
        let places = [Record::CARTESIAN_X_F64, Record::CARTESIAN_Y_F64, Record::CARTESIAN_Z_F64];
        let colors = [Record::COLOR_RED_U8, Record::COLOR_GREEN_U8, Record::COLOR_BLUE_U8];
        let mut scan = writer.add_pointcloud("scan", [places, colors].concat()).unwrap();
        for sample in samples(origin) {
            let place = sample.position.to_array().map(RecordValue::Double);
            let color = sample.srgb.map(|byte| RecordValue::Integer(byte.into()));
            scan.add_point([place, color].concat()).unwrap();
        }
        scan.finalize().unwrap();
        writer.finalize().unwrap();
        drop(writer);
        let keeps = Keeps { step: 0.0, normals: false, colors: true };
        check("a.e57", read("a.e57", &bytes.into_inner()), &samples(origin), &keeps);
    }
}

#[test]
fn a_file_in_memory_is_read_as_one_on_disk() {
    let rows = b"0 0 0\n1 0 0\n0 1 0\n".to_vec();
    let of = |name: &str, bytes: Vec<u8>| load_bytes(Path::new(name), bytes, &LoadOptions::default(), &());
    let loaded = of("a.xyz", rows.clone()).unwrap();
    assert_eq!(loaded.format, read("a.xyz", &rows).format);
    let Model::Points(points) = loaded.model else { panic!("no points") };
    assert_eq!(points.positions, [DVec3::ZERO, DVec3::X, DVec3::Y]);
    let refused = of("a.ply", b"plywood".to_vec()).unwrap_err().to_string();
    assert!(refused.starts_with("a.ply: named .ply"), "{refused}");
}
