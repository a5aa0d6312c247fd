//! One scene in every format that can hold it, and it is the same whichever of them it comes from.

mod files;
mod limits;

use std::{fs, path::Path};

use glam::{DVec3, Vec3};

use super::{LoadOptions, Loaded, Model, load, load_bytes};
use crate::{math::srgb::linear_from_srgb, scene::Colors};
#[cfg(feature = "e57")]
use files::e57;
#[cfg(feature = "gltf")]
use files::gltf;
#[cfg(feature = "las")]
use files::las;
use files::{color, normal, off, pcd, place, ply, rows, stl};

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
        check("a.off", read("a.off", off(&corners).as_bytes()), &corners, &colored);
        let faces: String =
            CORNERS.iter().map(|t| format!("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1)).collect();
        let unit = |s: &Sample| s.srgb.map(|byte| (f64::from(byte) / 255.0).to_string()).join(" ");
        let obj = rows(&corners, |s| format!("v {} {}\n", place(s, " "), unit(s))) + &faces;
        check("a.obj", read("a.obj", obj.as_bytes()), &corners, &colored);
        // Corners of STL are f32.
        let step = if origin == FAR { 0.25 } else { 0.0 };
        check(
            "a.stl",
            read("a.stl", stl(&corners).as_bytes()),
            &corners,
            &Keeps { step, normals: false, colors: false },
        );
    }
}

#[cfg(feature = "gltf")]
#[test]
fn a_mesh_of_gltf_is_the_same_also_far_away() {
    for origin in [DVec3::ZERO, FAR] {
        let all = Keeps { step: 0.0, normals: true, colors: true };
        check("a.gltf", read("a.gltf", gltf(origin).as_bytes()), &tetrahedron(origin), &all);
    }
}

#[cfg(feature = "las")]
#[test]
fn points_of_las_and_laz_are_the_same() {
    for (origin, compressed) in [(DVec3::ZERO, false), (DVec3::ZERO, true), (FAR, false), (FAR, true)] {
        let keeps = Keeps { step: 0.0, normals: false, colors: true };
        let bytes = las(origin, compressed);
        // Either has the other's name, too.
        check("a.laz", read("a.laz", &bytes), &samples(origin), &keeps);
        check("a.las", read("a.las", &bytes), &samples(origin), &keeps);
    }
}

#[cfg(feature = "e57")]
#[test]
fn points_of_e57_are_the_same() {
    for origin in [DVec3::ZERO, FAR] {
        let keeps = Keeps { step: 0.0, normals: false, colors: true };
        check("a.e57", read("a.e57", &e57(origin)), &samples(origin), &keeps);
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

/// As some editors begin a file.
#[test]
fn marks_of_utf8_are_read_past_in_every_text() {
    let ply = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n";
    for (name, text) in [("a.ply", ply), ("a.obj", "v 1 2 3\n"), ("a.xyz", "1 2 3\n")] {
        let marked = format!("\u{feff}{text}").into_bytes();
        let loaded = load_bytes(Path::new(name), marked, &LoadOptions::default(), &()).unwrap();
        let Model::Points(points) = loaded.model else { panic!("{name}") };
        assert_eq!(points.positions, [DVec3::new(1.0, 2.0, 3.0)], "{name}");
    }
}

#[test]
fn a_choice_of_columns_is_told_where_there_are_none() {
    let options = LoadOptions { columns: Some("x,y,z".parse().unwrap()), ..LoadOptions::default() };
    for (name, text, told) in [("a.obj", "v 1 2 3\n", 1), ("a.xyz", "1 2 3\n", 0)] {
        let loaded = load_bytes(Path::new(name), text.into(), &options, &()).unwrap();
        assert_eq!(
            loaded.notes.iter().filter(|note| note.to_string().contains("--columns")).count(),
            told,
            "{name}"
        );
    }
}

/// A U, whose first corner does not see its other leg.
#[test]
fn concave_polygons_are_what_their_corners_enclose() {
    let corners = [[6, 4], [4, 4], [4, 1], [2, 1], [2, 4], [0, 4], [0, 0], [6, 0]];
    let rows = |before: &str| corners.map(|[x, y]| format!("{before}{x} {y} 0\n")).concat();
    let ply = format!(
        "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 8\nproperty float x\nproperty float y\n\
        property float z\nend_header\n8 0 1 2 3 4 5 6 7\n{}",
        rows("")
    );
    let obj = format!("f 1 2 3 4 5 6 7 8\n{}", rows("v "));
    let off = format!("OFF\n8 1 0\n{}8 0 1 2 3 4 5 6 7\n", rows(""));
    for (name, text) in [("a.ply", ply), ("a.obj", obj), ("a.off", off)] {
        let loaded = load_bytes(Path::new(name), text.into_bytes(), &LoadOptions::default(), &()).unwrap();
        let Model::Mesh(mesh) = loaded.model else { panic!("{name}") };
        let area = |i: usize| {
            let [a, b, c] = mesh.corners(i).unwrap();
            (b - a).cross(c - a).z / 2.0
        };
        assert_eq!(mesh.triangles.len(), 6, "{name}");
        assert!((0..6).all(|i| area(i) >= 0.0), "{name}: {:?}", mesh.triangles);
        assert_eq!((0..6).map(area).sum::<f64>(), 18.0, "{name}");
        assert!(loaded.notes.is_empty(), "{name}");
    }
}
