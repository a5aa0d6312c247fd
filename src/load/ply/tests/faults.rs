use glam::{DVec3, Vec3};

use super::{Value::*, *};

pub(super) const POINTS: &str = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n\
    property float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty float radius\nend_header\n";

pub(super) fn message(bytes: &[u8]) -> String {
    let error = parse(bytes).unwrap_err();
    assert_eq!(error.exit_code(), 1);
    error.to_string()
}

#[track_caller]
pub(super) fn refuses(text: &str, expected: &str) {
    assert_eq!(message(text.as_bytes()), format!("a.ply: {expected}"));
}

#[test]
fn faults_of_the_header() {
    let points = |from: &str, to: &str| POINTS.replace(from, to);
    refuses("ply\n", "header: the file ends before 'end_header'");
    refuses("ply\r\nformat ascii 1.0\r\nend_head", "header: the file ends before 'end_header'");
    refuses(&points("end_header\n", ""), "header: the file ends before 'end_header'");
    refuses(&points("ply", "ply 2"), "line 1: 'ply 2'; expected 'ply'");
    refuses(&points("format ascii 1.0\n", ""), "header: no line 'format'; expected one");
    let kinds = "expected char, uchar, short, ushort, int, uint, int64, uint64, float or double";
    refuses(&points("float x", "flaot x"), &format!("line 4: type 'flaot'; {kinds}"));
    refuses(&points("float x", "list uchar flaot x"), &format!("line 4: type 'flaot'; {kinds}"));
    refuses(
        &points("property float x", "porperty float x"),
        "line 4: 'porperty float x'; expected format, comment, obj_info, element, property or end_header",
    );
    refuses(
        &points("float x", "float x y"),
        "line 4: 'property float x y'; expected 'property TYPE NAME' or 'property list TYPE TYPE NAME'",
    );
    refuses(
        &points("ascii", "asci"),
        "line 2: format 'asci'; expected ascii, binary_little_endian or binary_big_endian",
    );
    refuses(&points("1.0", "2.0"), "line 2: 'format ascii 2.0'; expected 'format ENCODING 1.0'");
    refuses(&points("element", "format ascii 1.0\nelement"), "line 3: a second line 'format'; expected one");
    refuses(&points("vertex", "node"), "header: no element 'vertex'; expected one with x y z");
    refuses(&points("vertex 2", "vertex"), "line 3: 'element vertex'; expected 'element NAME COUNT'");
    refuses(&points("float y", "float x"), "line 5: a second property 'x'; expected each once");
    refuses(
        &points("end_header", "element vertex 1\nend_header"),
        "line 11: a second element 'vertex'; expected each once",
    );
    refuses(
        &points("element vertex 2\n", ""),
        "line 3: a property before any element; expected it after its element",
    );
    refuses(&points("property float z\n", ""), "element vertex: 'z' is missing; expected x y z");
    refuses(&points("float x", "list uchar float x"), "element vertex: 'x' is a list; expected one value");
    refuses(
        &points("end_header", "element edge 3\nend_header"),
        "header: element 'edge' has no properties; expected one at least",
    );
    refuses(
        &points("end_header", "element face 1\nproperty list uchar float vertex_indices\nend_header"),
        "element face: 'vertex_indices' must be a list of an integer type",
    );
    refuses(
        &points("end_header", "element face 1\nproperty list float int vertex_indices\nend_header"),
        "line 12: list 'vertex_indices' has a length of type float; expected an integer type",
    );
    refuses(
        &points("end_header", "element face 1\nproperty int vertex\nend_header"),
        "element face: expected one list named vertex_indices or vertex_index",
    );
    refuses(
        &points("float x", "uint packed_position"),
        "element vertex: packed Gaussians, a compressed form; expected the properties x y z",
    );
    assert_eq!(message(b"ply\nformat \xff\xfe\n"), "a.ply: line 2: not text; expected a line of a header");
    assert_eq!(
        message(b"ply\n\0\n"),
        "a.ply: line 2: '\\0'; expected format, comment, obj_info, element, property or end_header"
    );
}

#[test]
fn faults_of_an_ascii_body() {
    let with = |body: &str| format!("{POINTS}{body}");
    let row = "0 0 0 0 0 1 0.5\n";
    refuses(&with(&format!("{row}1 2 x 4 5 6 7\n")), "line 13: vertex 1: z is 'x', expected a float");
    refuses(&with(&format!("1 2 3 4 5 6\n{row}")), "line 12: vertex 0: radius is missing");
    refuses(&with(&format!("0 {row}{row}")), "line 12: vertex 0: 1 value(s) more than the header declares");
    refuses(
        &with(&format!("0.000000 {row}\n \n")),
        "line 12: vertex 0: 1 value(s) more than the header declares",
    );
    refuses(
        &with(&format!("{}{}", row.trim_end(), " ".repeat(20))),
        "vertex 1: the file ends here; expected 2, as the header declares",
    );
    refuses(
        &with(row),
        "element vertex: the header declares 2 of at least 14 bytes each, the file has 16 bytes left for them; \
         expected as many as it holds",
    );
}

#[test]
fn counts_that_the_file_cannot_hold_are_refused_before_anything_is_allocated() {
    for count in ["3", "4000000000", "18446744073709551615"] {
        for encoding in ["ascii", "binary_little_endian"] {
            let text = POINTS.replace("vertex 2", &format!("vertex {count}")).replace("ascii", encoding);
            let each = if encoding == "ascii" { 14 } else { 28 };
            refuses(
                &text,
                &format!(
                    "element vertex: the header declares {count} of at least {each} bytes each, \
                     the file has 0 bytes left for them; expected as many as it holds"
                ),
            );
        }
    }
    for count in ["18446744073709551616", "-1", "1.5", "0x10"] {
        refuses(
            &POINTS.replace("vertex 2", &format!("vertex {count}")),
            &format!("line 3: a count of '{count}'; expected 0 to 18446744073709551615"),
        );
    }
}

pub(super) const TRIANGLE: &str = "ply\nformat ENCODING 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\n\
    property uchar z\nelement face 1\nproperty list char int vertex_indices\nend_header\n";

pub(super) fn triangle(face: Vec<Value>) -> [Vec<u8>; 3] {
    encodings(TRIANGLE, &[vec![UChar(0); 3], vec![UChar(1); 3], vec![UChar(2); 3], face])
}

#[test]
fn faults_of_faces_and_strips() {
    for index in [3, -1, i32::MIN, i32::MAX] {
        for file in triangle(vec![Char(3), Int(0), Int(index), Int(1)]) {
            assert_eq!(message(&file), format!("a.ply: face 0: corner {index}, expected 0 to 2"));
        }
    }
    let [ascii, little, big] = triangle(vec![Char(-3), Int(0), Int(1), Int(2)]);
    assert_eq!(message(&ascii), "a.ply: line 13: face 0: vertex_indices is '-3', expected a list length");
    for file in [little, big] {
        assert_eq!(message(&file), "a.ply: face 0: vertex_indices has -3 items; expected 0 or more");
    }
    let [ascii, little, big] = triangle(vec![Char(100), Int(0), Int(1), Int(2)]);
    assert_eq!(message(&ascii), "a.ply: line 13: face 0: vertex_indices is missing");
    for file in [little, big] {
        assert_eq!(message(&file), "a.ply: face 0: the file ends here; expected 1, as the header declares");
    }
    let header = TRIANGLE.replace("face", "tristrips");
    let strip = vec![Char(4), Int(0), Int(1), Int(-2), Int(2)];
    let vertices = [vec![UChar(0); 3], vec![UChar(1); 3], vec![UChar(2); 3], strip];
    for file in encodings(&header, &vertices) {
        let expected = "a.ply: tristrips 0: entry 2: corner -2, expected 0 to 2, or -1 for a new strip";
        assert_eq!(message(&file), expected);
    }
}

#[test]
fn points_that_lack_something_are_points_with_what_they_have() {
    let bare =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
    let check = |more: &str, body: &str, normals: Option<Vec<Vec3>>, radii: Option<Vec<f32>>| {
        let Ok(Model::Points(points)) = parse(format!("{bare}{more}end_header\n{body}\n").as_bytes()) else {
            panic!("no points: {more}")
        };
        assert_eq!(points.positions, [DVec3::new(1.0, 2.0, 3.0)]);
        assert_eq!((points.normals, points.radii), (normals, radii));
    };
    check("", "1 2 3", None, None);
    check("property float radius\n", "1 2 3 4", None, Some(vec![4.0]));
    let normals = "property float nx\nproperty float ny\nproperty float nz\n";
    check(normals, "1 2 3 4 5 6", Some(vec![Vec3::new(4.0, 5.0, 6.0)]), None);
    let viewpoint = |place: &str| {
        let camera = "element camera 1\nproperty float view_px\nproperty float view_py\nproperty float view_pz\n\
            property int viewportx\nend_header\n1 2 3\n";
        match parse(format!("{bare}{camera}{place} 640\n").as_bytes()) {
            Ok(Model::Points(points)) => points.viewpoints.first().map(|view| view.place),
            _ => panic!("no points"),
        }
    };
    assert_eq!(viewpoint("4 5 6"), Some(DVec3::new(4.0, 5.0, 6.0)));
    assert_eq!((viewpoint("0 0 0"), viewpoint("0 nan 1")), (None, None));
}
