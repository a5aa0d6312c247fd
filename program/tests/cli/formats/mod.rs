//! Every format through the program: the same scene has the same counts and the same picture, wherever it comes
//! from.

mod meshes;
mod points;
mod seeds;

use std::io::Write as _;

use glam::DVec3;
use serde_json::{Value, json};

use super::{
    files::png,
    program::{Folder, done, surfel_reading},
};

/// Where scans lie that come in metres of a map.
const FAR: DVec3 = DVec3::new(500_000.0, 4_600_000.0, 300.0);

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

fn zstd(bytes: &[u8]) -> Vec<u8> {
    ruzstd::encoding::compress_to_vec(bytes, ruzstd::encoding::CompressionLevel::Fastest)
}

fn content<'a>(files: &'a [(&str, Vec<u8>)], name: &str) -> &'a [u8] {
    &files.iter().find(|(other, _)| *other == name).unwrap().1
}

/// Writes them, some of them compressed as well, and gives all names.
fn write(folder: &Folder, mut files: Vec<(&'static str, Vec<u8>)>) -> Vec<&'static str> {
    for (packed, name) in [("a.xyz.gz", "a.xyz"), ("mesh.obj.gz", "mesh.obj")] {
        if files.iter().any(|(other, _)| *other == name) {
            files.push((packed, gzip(content(&files, name))));
        }
    }
    for (packed, name) in [("binary.ply.zst", "binary.ply"), ("mesh.off.zst", "mesh.off")] {
        if files.iter().any(|(other, _)| *other == name) {
            files.push((packed, zstd(content(&files, name))));
        }
    }
    files.iter().for_each(|(name, bytes)| folder.write(name, bytes));
    files.into_iter().map(|(name, _)| name).collect()
}

/// What `info` says of each file.
fn info(folder: &Folder, names: &[&str]) -> Vec<Value> {
    let told = done(folder, &[&["info", "--json"], names].concat()).stdout;
    let told: Value = serde_json::from_str(&told).unwrap();
    told["inputs"].as_array().unwrap().clone()
}

#[test]
fn points_of_every_format_are_counted_and_bounded_alike() {
    for origin in [DVec3::ZERO, FAR] {
        let folder = Folder::new();
        let ball = points::ball(origin);
        let names = write(&folder, points::files(&ball));
        let first = ball.iter().fold(DVec3::INFINITY, |least, point| least.min(point.place));
        let last = ball.iter().fold(DVec3::NEG_INFINITY, |most, point| most.max(point.place));
        for (name, input) in names.iter().zip(info(&folder, &names)) {
            assert_eq!((&input["name"], &input["model"]["points"]), (&json!(name), &json!(600)), "{input}");
            assert_eq!(input["model"]["bounds"], json!([first.to_array(), last.to_array()]), "{input}");
            assert_eq!((&input["drawn_as"], &input["splats"]), (&json!("splats"), &json!(600)), "{input}");
        }
    }
}

#[test]
fn meshes_of_every_format_are_counted_and_bounded_alike() {
    for origin in [DVec3::ZERO, FAR] {
        let folder = Folder::new();
        let names = write(&folder, meshes::files(origin));
        let half = DVec3::new(1.0, 0.75, 0.5);
        for (name, input) in names.iter().zip(info(&folder, &names)) {
            assert_eq!((&input["name"], &input["drawn_as"]), (&json!(name), &json!("triangles")));
            let count = &input["model"]["triangles"];
            assert_eq!((count, &input["model"]["points"]), (&json!(meshes::TRIANGLES), &json!(6)), "{input}");
            let bounds = json!([(origin - half).to_array(), (origin + half).to_array()]);
            assert_eq!(input["model"]["bounds"], bounds, "{input}");
        }
    }
}

#[test]
fn one_scene_is_one_picture_from_any_format_and_anywhere() {
    let mut clouds = Vec::new();
    let mut polygons = Vec::new();
    for origin in [DVec3::ZERO, FAR] {
        let folder = Folder::new();
        let of_points = write(&folder, points::files(&points::ball(origin)));
        let of_meshes = write(&folder, meshes::files(origin));
        // Formats of scans have z up, the others leave it open.
        let picture = |name: &str| {
            done(&folder, &["render", name, "--up", "z", "--size", "64x48", "-o", "a.png"]);
            (format!("{name} at {origin}"), png(&folder.path("a.png")).pixels)
        };
        clouds.extend(of_points.into_iter().map(picture));
        polygons.extend(of_meshes.into_iter().map(picture));
    }
    for pictures in [clouds, polygons] {
        let [(_, first), others @ ..] = &pictures[..] else { panic!("no picture") };
        assert!(first.chunks_exact(3).filter(|pixel| **pixel != [255; 3]).count() > 300);
        for (name, other) in others {
            let most = first.iter().zip(other).map(|(a, b)| a.abs_diff(*b)).max();
            assert!(most <= Some(1), "{name}: {most:?}");
        }
    }
}

#[test]
fn standard_input_is_read_whatever_it_holds() {
    let folder = Folder::new();
    let files = points::files(&points::ball(FAR));
    for (name, bytes) in [("a.laz", None), ("a.e57", None), ("a.pts", Some(gzip(content(&files, "a.pts"))))] {
        let bytes = bytes.as_deref().unwrap_or(content(&files, name));
        let run = surfel_reading(&folder, &["info", "-", "--json"], bytes);
        assert_eq!(run.code, 0, "{}", run.stderr);
        let told: Value = serde_json::from_str(&run.stdout).unwrap();
        assert_eq!(told["inputs"][0]["model"]["points"], 600, "{told}");
    }
}

/// A ball of points far from the origin, in every format.
pub fn points_far_away() -> Vec<(&'static str, Vec<u8>)> {
    points::files(&points::ball(FAR))
}

/// An octahedron far from the origin, in every format.
pub fn meshes_far_away() -> Vec<(&'static str, Vec<u8>)> {
    meshes::files(FAR)
}

/// A file of points that says that z is up, with heights scaled.
#[test]
fn what_lies_is_seen_from_above_and_what_stands_from_the_front() {
    let folder = Folder::new();
    for (height, degrees) in [(0.1, 38.0), (0.4, 30.0), (0.75, 15.0), (1.5, 0.0)] {
        let scaled = |point: points::Point| points::Point {
            place: point.place * DVec3::new(1.0, 1.0, height),
            ..point
        };
        let points: Vec<_> = points::ball(DVec3::ZERO).into_iter().map(scaled).collect();
        folder.write("a.las", content(&points::files(&points), "a.las"));
        let line = done(&folder, &["render", "a.las", "--size", "9x9", "--print-camera"]).stdout;
        let [eye, target] = ["--eye", "--target"].map(|name| {
            let word = line.split_whitespace().skip_while(|word| *word != name).nth(1).unwrap();
            DVec3::from_slice(&word.split(',').map(|v| v.parse().unwrap()).collect::<Vec<f64>>())
        });
        let [right, back, up] = (eye - target).normalize().to_array();
        let elevation = up.asin().to_degrees();
        // Disks at the rim reach beyond the points.
        assert!(
            (elevation - degrees).abs() < 5.0 && right.abs() < 1e-9 && back < 0.0,
            "{height}: {elevation}"
        );
    }
}
