use super::*;
use crate::{
    load::{hostile::attack, input::of_bytes},
    math::srgb::linear_from_srgb,
};

fn load(text: &str) -> Loaded {
    of_bytes("a.off", text.as_bytes(), parse).unwrap()
}

fn mesh(text: &str) -> Mesh {
    match load(text).model {
        Model::Mesh(mesh) => mesh,
        _ => panic!("no mesh"),
    }
}

#[track_caller]
fn refuses(text: &str, expected: &str) {
    let error = of_bytes("a.off", text.as_bytes(), parse).unwrap_err();
    assert_eq!((error.to_string(), error.exit_code()), (format!("a.off: {expected}"), 1));
}

const SQUARE: &str = "OFF # a square\n4 1 0\n0 0 0\n1 0 0\n\n1 1 0\n0 1 4600000.000123456\n4 0 1 2 3\n";

#[test]
fn polygons_are_fans_and_positions_stay_f64() {
    let mesh = mesh(SQUARE);
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(mesh.positions[3].z, 4_600_000.000_123_456);
    assert!(mesh.normals.is_none() && matches!(mesh.colors, Colors::Uniform(_)));
    assert!(load(SQUARE).notes.is_empty());
}

#[test]
fn the_word_may_be_small_or_left_out() {
    for word in ["off", "OFF", ""] {
        let text = SQUARE.replacen("OFF", word, 1);
        assert_eq!(mesh(&text).triangles.len(), 2, "{word}");
    }
    assert_eq!(load("3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").format, "OFF (without its word)");
}

#[test]
fn the_first_count_may_be_glued_to_the_word() {
    let glued = SQUARE.replacen("OFF # a square\n4 1 0", "OFF4 1 0", 1);
    assert_eq!((mesh(&glued).triangles.len(), load(&glued).format), (2, "OFF (OFF)".to_owned()));
    refuses("OFF4\n1 0\n", "line 1: 'OFF4'; expected OFF");
}

#[test]
fn vertices_have_what_the_letters_say() {
    let text = "STCN4OFF 3 1 0\n2 4 6 2 0 0 1 255 0 51 0 .5 .5\n1 0 0 1 0 0 1 255 0 51 51 0 0\n0 1 0 1 0 0 1 0 0 0 255 1 1\n\
        3 0 1 2\n";
    let colored = mesh(text);
    assert_eq!(colored.positions[0], DVec3::new(1.0, 2.0, 3.0));
    assert_eq!(colored.normals, Some(vec![Vec3::Z; 3]));
    assert_eq!(colored.colors.get(1), Some([1.0, 0.0, linear_from_srgb(0.2), 0.2]));
    assert_eq!(load(text).notes[0].to_string(), "3 texture coordinates ignored");
    let floats = mesh("COFF\n3 1 0\n0 0 0 1 0 .2\n1 0 0 1 0 0\n0 1 0 0 0 0\n3 0 1 2 0.5 0.5 0.5\n");
    assert_eq!(floats.colors.get(0), Some([1.0, 0.0, linear_from_srgb(0.2), 1.0]));
}

#[test]
fn what_is_not_drawn_is_told() {
    let loaded = load("OFF\n3 2 0\n0 0 0 9\n1 0 0\n0 1 0\n2 0 1\n3 0 1 2 255 0 0\nmore\n");
    let notes: Vec<String> = loaded.notes.iter().map(ToString::to_string).collect();
    assert_eq!(notes[0], "1 face with fewer than 3 corners left out");
    assert_eq!(notes[1], "1 vertex with more numbers than their kind has, whose rest is ignored");
    assert_eq!(notes[2..], ["1 color of faces ignored", "1 text behind the last face ignored"]);
    assert!(matches!(load("OFF\n1 0 0\n1 2 3\n").model, Model::Points(_)));
}

#[test]
fn faults_name_their_line() {
    refuses("nOFF\n3\n", "line 1: 'nOFF'; expected OFF, with ST, C, N and 4 before it or not");
    refuses("OFF BINARY\n", "line 1: a binary OFF file; expected one of text");
    refuses("OFF", "line 1: the file ends; expected the numbers of vertices and faces");
    refuses("OFF\n3\n", "line 2: the line ends; expected the number of faces");
    refuses("OFF\n-3 1 0\n", "line 2: '-3'; expected the number of vertices");
    let counts = "6 bytes follow; expected 353535235358 vertices and 0 faces";
    refuses("OFF\n353535235358 0 0\n0 0 0\n", &format!("line 2: {counts}"));
    refuses("OFF\n1 0 0\n0 x 0\n", "line 3: 'x'; expected a coordinate");
    refuses("COFF\n1 0 0\n0 0 0 1\n", "line 3: a color of 1 numbers; expected 3 or 4");
    refuses("OFF\n2 0 0\n0 0 0 00000\n", "line 4: the file ends; expected vertex 1 of 2");
    refuses("OFF\n1 1 0\n0 0 0\n3 0 0 1\n", "line 4: vertex 1, but the file has 1, from 0");
    refuses("OFF\n1 1 0\n0 0 0\n9999 0\n", "line 4: the line ends; expected the number of a vertex");
    refuses("OFF\n1 1 0\n0 0 0\n9999999999 0\n", "line 4: 9999999999 corners; expected at most 1048576");
}

#[test]
fn hostile_bytes_are_refused_or_read() {
    let text = b"CNOFF\n3 2 0\n0 0 0 0 0 1 255 0 0\n1 0 0 0 0 1 9 9 9 9\n0 1 0 0 0 1 0 0 0\n3 0 1 2\n2 0 1\n";
    attack(&[text.to_vec(), SQUARE.as_bytes().to_vec()], 20_000, parse);
}
