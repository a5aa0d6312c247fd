//! What a file may hold: each reader takes as much as a limit says, and refuses one more in a line that tells the limit.

use super::{files::*, *};
use crate::load::Limits;

#[track_caller]
fn limited(name: &str, bytes: &[u8], limits: impl Fn(u64) -> Limits, most: u64) {
    let within = |most: u64| {
        let options = LoadOptions { limits: limits(most), ..LoadOptions::default() };
        load_bytes(Path::new(name), bytes.to_vec(), &options, &())
    };
    within(most).unwrap_or_else(|e| panic!("at the limit: {e}"));
    let error =
        within(most - 1).err().unwrap_or_else(|| panic!("{name} of {most} is read within {}", most - 1));
    let (said, limit) = (error.to_string(), (most - 1).to_string());
    assert!(error.exit_code() == 1 && !said.contains('\n'), "{said}");
    assert!(said.starts_with(&format!("{name}: ")) && said.contains(&limit), "{limit}: {said}");
}

fn csv(samples: &[Sample]) -> String {
    format!("x,y,z\n{}", rows(samples, |sample| format!("{}\n", place(sample, ","))))
}

fn points(most: u64) -> Limits {
    Limits { points: most, ..Limits::DEFAULT }
}

#[test]
fn points_have_a_limit_in_every_format() {
    let (cloud, corners) = (samples(DVec3::ZERO), tetrahedron(DVec3::ZERO));
    limited("a.ply", ply(&cloud, &[]).as_bytes(), points, 100);
    limited("a.pcd", pcd(&cloud).as_bytes(), points, 100);
    limited("a.csv", csv(&cloud).as_bytes(), points, 100);
    limited("a.off", off(&corners).as_bytes(), points, 4);
    // Corners, before those at one place become one.
    limited("a.stl", stl(&corners).as_bytes(), points, 12);
    let numbers: Vec<u8> = (0..12_u8).flat_map(|i| f32::from(i * i).to_le_bytes()).collect();
    let binary = [&[0; 80][..], &1_u32.to_le_bytes(), &numbers, &[0; 2]].concat();
    limited("a.stl", &binary, points, 3);
    #[cfg(feature = "gltf")]
    limited("a.gltf", gltf(DVec3::ZERO).as_bytes(), points, 4);
    #[cfg(feature = "las")]
    for compressed in [false, true] {
        limited("a.las", &las(DVec3::ZERO, compressed), points, 100);
    }
    #[cfg(feature = "e57")]
    limited("a.e57", &e57(DVec3::ZERO), points, 100);
}

#[test]
fn lines_have_a_limit_in_every_format_of_text() {
    let (cloud, corners) = (samples(DVec3::ZERO), tetrahedron(DVec3::ZERO));
    for (name, text) in [
        ("a.ply", ply(&cloud, &CORNERS)),
        ("a.pcd", pcd(&cloud)),
        ("a.csv", csv(&cloud)),
        ("a.off", off(&corners)),
        ("a.stl", stl(&corners)),
    ] {
        let longest = text.lines().map(str::len).max().unwrap();
        let lines = |most: u64| Limits { line_bytes: most as usize, ..Limits::DEFAULT };
        limited(name, text.as_bytes(), lines, longest as u64);
    }
}

#[test]
fn corners_and_faces_have_limits_where_they_are_lists() {
    let items = |most: u64| Limits { list_items: most as usize, ..Limits::DEFAULT };
    let faces = |most: u64| Limits { faces: most, ..Limits::DEFAULT };
    let off = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
    limited("a.off", off.as_bytes(), items, 4);
    limited("a.off", off.as_bytes(), faces, 2);
    let vertices = "vertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\n";
    let stl = format!("solid\nfacet normal 0 0 1\nouter loop\n{vertices}endloop\nendfacet\nendsolid\n");
    limited("a.stl", stl.as_bytes(), items, 4);
}

#[cfg(feature = "las")]
#[test]
fn compressed_records_have_a_limit() {
    let laz = las(DVec3::ZERO, true);
    let expanded = |most: u64| Limits { expanded_bytes: 36 * most, laz_expansion: 0, ..Limits::DEFAULT };
    limited("a.laz", &laz, expanded, 100);
}
