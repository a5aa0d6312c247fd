//! What files bring that readers like these are known to fail on: each has a neighbor that is read and one that is refused, or
//! left out with a note. The numbers are those of `tests/gpu/hard_cases.rs`.
//!
//! | case | where it is tested |
//! |---|---|
//! | counts beyond the file, overflowing, negative; names twice; headers | here; `refusals.rs`; `src/load/ply/tests/faults.rs` |
//! | cut files | `refusals.rs`; at every byte: beside each reader |
//! | names of properties | `src/load/ply/tests/forms.rs` |
//! | what tobj gets wrong | `src/load/obj/tests/traps.rs` |
//! | files that name others | `inputs.rs`; `src/load/obj/tests/materials.rs`, `src/load/gltf/tests.rs`, `src/load/scene_file/tests.rs` |
//! | what expands | `refusals.rs`; `src/load/packed.rs`; LAZ: `src/load/las/tests.rs` |
//! | decimal commas | here |
//! | depth and doubles of TOML and JSON, 1e400 | `refusals.rs`; `src/load/scene_file/tests/faults.rs` |
//! | outputs | `outputs.rs`, `faults.rs` |
//! | NaN in reports | here |
//! | names that lie | `refusals.rs`; `src/load/sniff/tests.rs` |
//! | N9 far away | `formats/mod.rs` |
//! | N10 no extent, N11 normals, N12 not finite, N20 radii, N30 ends of ranges | here |

use serde_json::{Value, json};

use super::{
    files::png,
    program::{Folder, done, surfel},
};

/// A PLY of these properties and rows.
fn ply(properties: &[&str], rows: &[&str]) -> String {
    let properties: String = properties.iter().map(|name| format!("property {name}\n")).collect();
    let count = rows.len();
    format!("ply\nformat ascii 1.0\nelement vertex {count}\n{properties}end_header\n{}\n", rows.join("\n"))
}

const PLACES: [&str; 3] = ["float x", "float y", "float z"];
const DISKS: [&str; 7] =
    ["float x", "float y", "float z", "float nx", "float ny", "float nz", "float radius"];

/// What `info` says of the file.
#[track_caller]
fn read(name: &str, content: impl AsRef<[u8]>) -> Value {
    let folder = Folder::new();
    folder.write(name, content);
    let told = done(&folder, &["info", "--json", name]).stdout;
    let told: Value = serde_json::from_str(&told).unwrap();
    told["inputs"][0].clone()
}

#[track_caller]
fn refused(name: &str, content: impl AsRef<[u8]>, words: &str) {
    let folder = Folder::new();
    folder.write(name, content);
    let run = surfel(&folder, &["info", name]);
    assert_eq!((run.code, run.stderr.lines().count()), (1, 1), "{}", run.stderr);
    assert!(run.stderr.starts_with(&format!("surfel: {name}: ")), "{}", run.stderr);
    assert!(run.stderr.contains(words), "'{words}' is not in: {}", run.stderr);
}

/// How many were dropped, and why: of the first note.
fn dropped(input: &Value) -> (u64, &str) {
    let note = &input["notes"][0];
    assert_eq!(note["deed"], "dropped", "{input}");
    (note["count"].as_u64().unwrap(), note["what"].as_str().unwrap())
}

#[test]
fn headers_end_where_their_line_ends() {
    let header = "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty uchar x\nproperty uchar y\n\
        property uchar z\nend_header\n";
    for header in [header.to_owned(), header.replace('\n', "\r\n")] {
        let file = [header.as_bytes(), b"\n\r\n"].concat();
        assert_eq!(read("a.ply", file)["model"]["bounds"], json!([[10.0, 13.0, 10.0], [10.0, 13.0, 10.0]]));
        refused("a.ply", [header.as_bytes(), b"\n\r"].concat(), "expected");
    }
    let stray = ply(&PLACES, &["0 0 0"]).replace("end_header", "property of nobody\nend_header");
    refused("a.ply", stray, "line 7");
    let twice =
        ply(&PLACES, &["0 0 0"]).replace("end_header", "element vertex 1\nproperty int x\nend_header");
    refused("a.ply", twice, "a second element 'vertex'");
}

#[test]
fn lists_in_vertices_have_a_length() {
    let properties = [&PLACES[..], &["list char int of"]].concat();
    assert_eq!(read("a.ply", ply(&properties, &["0 0 0 2 7 8", "1 0 0 0"]))["splats"], 2);
    refused("a.ply", ply(&properties, &["0 0 0 2 7 8", "1 0 0 -1"]), "line 10: vertex 1");
}

#[test]
fn a_comma_is_a_decimal_point_only_in_rows_that_it_does_not_part() {
    let bounds = json!([[0.5, 1.5, 2.5], [1.5, 2.5, 3.5]]);
    assert_eq!(read("a.csv", "1,5;2,5;3,5\n0,5;1,5;2,5\n")["model"]["bounds"], bounds);
    assert_eq!(read("a.csv", "1.5,2.5,3.5\n0.5,1.5,2.5\n")["model"]["bounds"], bounds);
    refused("a.csv", "1,5;2,5;3,5\n0,5;1,5,5;2,5\n", "line 2");
    refused("a.ply", ply(&PLACES, &["1,5 2,5 3,5"]), "'1,5'");
    refused("a.obj", "v 1,5 2 3\n", "line 1");
}

#[test]
fn what_has_no_extent_has_a_picture() {
    for rows in [vec!["1 2 3"], vec!["1 2 3"; 5]] {
        let folder = Folder::new();
        folder.write("a.ply", ply(&PLACES, &rows));
        done(&folder, &["render", "a.ply", "--size", "32x32", "-o", "a.png"]);
        assert_ne!(png(&folder.path("a.png")).at(16, 16), [255; 3], "{} rows", rows.len());
    }
    refused("a.ply", ply(&PLACES, &[]), "expected");
}

#[test]
fn normals_are_of_any_length_above_zero() {
    let rows = |normals: &[&str]| normals.iter().map(|n| format!("0 0 0 {n} 1")).collect::<Vec<_>>();
    let file = |normals: &[&str]| {
        let rows = rows(normals);
        ply(&DISKS, &rows.iter().map(String::as_str).collect::<Vec<_>>())
    };
    assert_eq!(read("a.ply", file(&["1e-38 0 0", "0 -0 1e38", "-3 0 0", "1e-45 0 0"]))["splats"], 4);
    let some = read("a.ply", file(&["0 0 0", "nan 0 1", "0 inf 0", "0 -0 0", "0 0 1"]));
    assert_eq!(dropped(&some), (4, "splats whose normal is zero or not finite"));
    refused("a.ply", file(&["0 0 0", "nan 0 0"]), "no splat can be drawn");
}

#[test]
fn what_is_not_finite_is_left_out_and_numbers_of_reports_are_finite() {
    let disks = ply(&DISKS, &["nan 0 0 0 0 1 1", "0 inf 0 0 0 1 1", "0 0 -inf 0 0 1 1", "3 0 0 0 0 1 1"]);
    let input = read("a.ply", disks);
    assert_eq!(dropped(&input), (3, "splats whose position is not finite"));
    assert_eq!(input["model"]["bounds"], json!([[3.0, 0.0, 0.0], [3.0, 0.0, 0.0]]));
    let points = read("a.ply", ply(&PLACES, &["nan 0 0", "1 0 0", "2 0 0"]));
    assert_eq!(dropped(&points), (1, "points that are not finite"));
    refused("a.ply", ply(&PLACES, &["nan 0 0", "0 inf 0"]), "no splat can be drawn");
}

#[test]
fn radii_are_above_zero() {
    let rows = ["0 0 0 0 0 1 1e-30", "1 0 0 0 0 1 0.5"];
    assert_eq!(read("a.ply", ply(&DISKS, &rows))["splats"], 2);
    let rows = ["0 0 0 0 0 1 0", "1 0 0 0 0 1 -1", "1 0 0 0 0 1 inf", "1 0 0 0 0 1 nan", "1 0 0 0 0 1 1"];
    assert_eq!(
        dropped(&read("a.ply", ply(&DISKS, &rows))),
        (4, "splats whose radius is not above zero or not finite")
    );
    refused("a.ply", ply(&DISKS, &rows[..2]), "no splat can be drawn");
}

/// White is 255 of bytes, 65535 of 16 bits (255 where none is more), and 1 of floats; and it is white in the picture.
#[test]
fn white_is_white_at_the_end_of_each_range() {
    let colors = |kind: &str| ["red", "green", "blue"].map(|name| format!("{kind} {name}"));
    for (kind, white, other) in [
        ("uchar", "255 255 255", "0 0 0"),
        ("ushort", "65535 65535 65535", "0 0 0"),
        ("ushort", "255 255 255", "0 0 0"),
        ("float", "1 1 1", "0.5 0.5 0.5"),
    ] {
        let colors = colors(kind);
        let properties: Vec<&str> = DISKS.into_iter().chain(colors.iter().map(String::as_str)).collect();
        let rows = [format!("0 0 0 0 0 1 1 {white}"), format!("9 0 0 0 0 1 1 {other}")];
        let folder = Folder::new();
        folder.write("a.ply", ply(&properties, &[&rows[0], &rows[1]]));
        let view = ["--eye", "0,0,3", "--target", "0,0,0", "--size", "32x32", "--background", "0,0,0"];
        let how = ["render", "a.ply", "--shading", "albedo", "-o", "a.png"];
        done(&folder, &[&how[..], &view].concat());
        assert_eq!(png(&folder.path("a.png")).at(16, 16), [255; 3], "{kind} {white}");
    }
    let properties = [&DISKS[..], &["float red", "float green", "float blue"]].concat();
    let input = read("a.ply", ply(&properties, &["0 0 0 0 0 1 1 1.5 0 0", "1 0 0 0 0 1 1 1 0 0"]));
    assert_eq!((&input["notes"][0]["deed"], &input["notes"][0]["count"]), (&json!("clamped"), &json!(1)));
}
