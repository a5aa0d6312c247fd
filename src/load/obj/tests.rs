mod materials;
mod mutations;
mod other_reader;
mod traps;

use std::path::Path;

use glam::{DVec3, Vec3};

use super::*;
use crate::{
    load::{Limits, LoadOptions, input::of_bytes},
    math::srgb::linear_from_srgb,
};

fn load_with(path: &Path, bytes: &[u8], options: &LoadOptions) -> Result<Loaded> {
    super::parse(&Input { path, folder: path.parent(), bytes, options, progress: &() })
}

fn load(text: &str) -> Result<Loaded> {
    load_with(Path::new("a.obj"), text.as_bytes(), &LoadOptions::default())
}

fn notes(text: &str) -> Vec<String> {
    load(text).unwrap().notes.iter().map(ToString::to_string).collect()
}

fn parse(bytes: &[u8]) -> Result<Model> {
    of_bytes("a.obj", bytes, super::parse).map(|loaded| loaded.model)
}

fn mesh(text: &str) -> Mesh {
    match parse(text.as_bytes()).unwrap() {
        Model::Mesh(mesh) => mesh,
        _ => panic!("no mesh"),
    }
}

#[track_caller]
fn refuses(text: &str, expected: &str) {
    let error = parse(text.as_bytes()).unwrap_err();
    assert_eq!((error.to_string(), error.exit_code()), (format!("a.obj: {expected}"), 1));
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn polygons_are_fans_and_positions_stay_f64() {
    let mesh = mesh(&format!(
        "# a comment\r\nmtllib ../secret.mtl\r\n{SQUARE}v 4600000.000123456 2 3\nf 1 2 3 4 # quad\nf 3 4 5\n"
    ));
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3], [2, 3, 4]]);
    assert_eq!(mesh.positions[4], DVec3::new(4_600_000.000_123_456, 2.0, 3.0));
    assert!(mesh.normals.is_none() && matches!(mesh.colors, Colors::Uniform(_)));
}

#[test]
fn groups_and_materials_do_not_split_the_vertices() {
    let mesh =
        mesh(&format!("o a\n{SQUARE}g one\nusemtl red\ns 1\nf 1 2 3\ng two\nusemtl blue\no b\nf -4 -2 -1\n"));
    assert_eq!((mesh.positions.len(), mesh.triangles), (4, vec![[0, 1, 2], [0, 2, 3]]));
}

#[test]
fn colors_stay_with_their_vertices_where_only_some_have_one_and_w_divides() {
    let mesh = mesh("v 0 0 0\nv 1 0 0 1 0 0.5\nv 2 4 6 2\nvt 0 0\nf 1/1 2/1 3/1\n");
    let gray = linear_from_srgb(0.8);
    let Colors::Each(colors) = mesh.colors else { panic!("colors") };
    let gray = [gray, gray, gray, 1.0];
    assert_eq!(colors, [gray, [1.0, 0.0, linear_from_srgb(0.5), 1.0], gray]);
    assert_eq!(mesh.positions[2], DVec3::new(1.0, 2.0, 3.0));
}

#[test]
fn normals_of_corners_are_averaged_a_vertex() {
    let text = format!("{SQUARE}vn 0 0 2\nvn 1 0 0\nf 1//1 2//1 3//1\nf 1//2 3/7/1 4/7/-1\n");
    let normals = mesh(&text).normals.unwrap();
    let tilted = Vec3::new(1.0, 0.0, 1.0).normalize();
    assert!(normals[0].distance(tilted) < 1e-6 && normals[3].distance(Vec3::X) < 1e-6);
    assert_eq!(normals[2], Vec3::Z);
    assert!(mesh(&format!("{SQUARE}vn 0 0 1\nf 1 2 4\n")).normals.is_none());
}

#[test]
fn faults_name_their_line() {
    let vertex = "expected v x y z, with nothing, w, or r g b after it";
    refuses("v 0 0\n", &format!("line 1: 'v 0 0': position parse error; {vertex}"));
    refuses("v 0 0 0 0\n", &format!("line 1: 'v 0 0 0 0': scaling (w) by zero; {vertex}"));
    refuses("v 1 0 0\nv 0 zero 0\n", &format!("line 2: 'v 0 zero 0': position parse error; {vertex}"));
    let color = "color parse error (too many or too few components)";
    refuses("v 0 0 0\nv 0 0 0 1 1\n", &format!("line 2: 'v 0 0 0 1 1': {color}; {vertex}"));
    let no_number = "face vertex color index out of bounds";
    refuses("v 0 0 0 1 1 1\nv 0 0 0 1 x 1\n", &format!("line 2: 'v 0 0 0 1 x 1': {no_number}; {vertex}"));
    refuses("\n\nvn 0 0\n", "line 3: 'vn 0 0': normal parse error; expected vn x y z");
    // What is wrong first is said first, whatever it is.
    let after = "v 0 0 0\nf 1 1 9\nf 1 1 x\nf\n";
    refuses(&format!("v x\n{after}"), &format!("line 1: 'v x': position parse error; {vertex}"));
    refuses(after, "line 2: vertex 9; expected 1 to 1, or -1 to -1");
    refuses(&after.replace(" 9", " 1"), "line 3: a corner with vertex 'x'; expected a whole number");
    refuses(&format!("{SQUARE}f 1 2 3\nf 1 2 9\n"), "line 6: vertex 9; expected 1 to 4, or -4 to -1");
    refuses(&format!("{SQUARE}f 1 2 -5\n"), "line 5: vertex -5; expected 1 to 4, or -4 to -1");
    refuses(&format!("f 1 2 -1\n{SQUARE}"), "line 1: vertex -1; expected 1 to 4, or -0 to -1");
    refuses(&format!("{SQUARE}f 1 2 0\n"), "line 5: vertex 0; expected 1 to 4, or -4 to -1");
    refuses("f 1 2 3\n", "line 1: vertex 1, but the file has none");
    refuses(&format!("{SQUARE}f 1 2 x\n"), "line 5: a corner with vertex 'x'; expected a whole number");
    refuses(&format!("{SQUARE}f 1//x 2 3\n"), "line 5: a corner with normal 'x'; expected a whole number");
    refuses(&format!("{SQUARE}f 1 2 1/2/3/4\n"), "line 5: a corner '1/2/3/4'; expected v/vt/vn");
    refuses(&format!("{SQUARE}f\n"), "line 5: a face without corners; expected 3 or more");
    for largest in [i64::MAX, i64::MIN, i64::from(u32::MAX) + 1] {
        let expected = format!("line 5: vertex {largest}; expected 1 to 4, or -4 to -1");
        refuses(&format!("{SQUARE}f {largest} 2 3\n"), &expected);
    }
    let bare = "neither a face nor a point; expected a mesh or points";
    refuses("p 1\nl 1 2\n", bare);
    refuses(&format!("{SQUARE}f 1 2\n"), bare);
    let error = parse(b"v 0 0 \xff\n").unwrap_err().to_string();
    assert_eq!(error, "a.obj: line 1: not text; expected UTF-8");
}

#[test]
fn a_file_without_faces_is_points() {
    let points = |text: &str| match parse(text.as_bytes()).unwrap() {
        Model::Points(points) => points,
        _ => panic!("no points"),
    };
    let bare = points(SQUARE);
    assert_eq!(bare.positions, mesh(&format!("{SQUARE}f 1 2 3 4")).positions);
    assert!(bare.normals.is_none() && matches!(bare.colors, Colors::Uniform(_)));
    let whole = points("vn 0 0 2\nv 4600000.000123456 2 3 1 0 1\nvn 0 1 0\nv 0 2 nan\np 1 2\n");
    assert_eq!(whole.positions[0].x, 4_600_000.000_123_456);
    assert_eq!(whole.normals, Some(vec![Vec3::new(0.0, 0.0, 2.0), Vec3::Y]));
    let Colors::Each(colors) = whole.colors else { panic!("colors") };
    assert_eq!(colors[0], [1.0, 0.0, 1.0, 1.0]);
    assert!(points(&format!("{SQUARE}vn 0 0 1\n")).normals.is_none());
}
