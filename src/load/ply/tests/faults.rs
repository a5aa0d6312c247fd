use glam::{DVec3, Vec3};
use proptest::prelude::*;

use super::{Value::*, *};

const POINTS: &str = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n\
    property float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty float radius\nend_header\n";

fn message(bytes: &[u8]) -> String {
    let error = parse(bytes).unwrap_err();
    assert_eq!(error.exit_code(), 1);
    error.to_string()
}

#[track_caller]
fn refuses(text: &str, expected: &str) {
    assert_eq!(message(text.as_bytes()), format!("a.ply: {expected}"));
}

#[test]
fn faults_of_the_header() {
    let points = |from: &str, to: &str| POINTS.replace(from, to);
    refuses("ply\n", "header: the file ends before 'end_header'");
    refuses(&points("end_header\n", ""), "header: the file ends before 'end_header'");
    refuses(&points("format ascii 1.0\n", ""), "header: No format line found");
    refuses(&points("float x", "flaot x"), "line 4: Couldn't parse line: 'property flaot x'");
    refuses(&points("ascii", "asci"), "line 2: Couldn't parse line: 'format asci 1.0'");
    refuses(&points("vertex", "point"), "header: no element 'vertex'");
    refuses(&points("float y", "float x"), "line 5: a second property 'x'");
    refuses(&points("end_header", "element vertex 1\nend_header"), "line 11: a second element 'vertex'");
    refuses(&points("property float z\n", ""), "element vertex: 'z' is missing, its group is x y z");
    refuses(&points("property float ny\n", ""), "element vertex: 'ny' is missing, its group is nx ny nz");
    refuses(&points("float x", "list uchar float x"), "element vertex: 'x' is a list, expected one value");
    refuses(
        &points("float radius", "int red"),
        "element vertex: 'red' must be of type uchar, ushort, float or double",
    );
    refuses(&points("end_header", "element edge 3\nend_header"), "header: element 'edge' has no properties");
    refuses(
        &points("end_header", "element face 1\nproperty list uchar float vertex_indices\nend_header"),
        "element face: 'vertex_indices' must be a list of an integer type",
    );
    refuses(
        &points("end_header", "element face 1\nproperty list float int vertex_indices\nend_header"),
        "element face: list 'vertex_indices' has a length that is no integer type",
    );
    refuses(
        &points("end_header", "element face 1\nproperty int vertex\nend_header"),
        "element face: expected one list named vertex_indices or vertex_index",
    );
    assert_eq!(message(b"ply\n\xff\xfe\n"), "a.ply: header: not text before 'end_header'");
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
        "vertex 1: the file ends here, the header declares 2",
    );
    refuses(
        &with(row),
        "element vertex: the header declares 2 of at least 14 bytes each, the file has 16 bytes left for them",
    );
}

#[test]
fn counts_that_the_file_cannot_hold_are_refused_before_anything_is_allocated() {
    for count in ["4000000000", "18446744073709551615"] {
        for encoding in ["ascii", "binary_little_endian"] {
            let text = POINTS.replace("vertex 2", &format!("vertex {count}")).replace("ascii", encoding);
            let each = if encoding == "ascii" { 14 } else { 28 };
            refuses(
                &text,
                &format!(
                    "element vertex: the header declares {count} of at least {each} bytes each, \
                     the file has 0 bytes left for them"
                ),
            );
        }
    }
    refuses(
        &POINTS.replace("vertex 2", "vertex 18446744073709551616"),
        "line 3: Invalid element: 'element vertex 18446744073709551616'",
    );
}

const TRIANGLE: &str = "ply\nformat ENCODING 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\n\
    property uchar z\nelement face 1\nproperty list char int vertex_indices\nend_header\n";

fn triangle(face: Vec<Value>) -> [Vec<u8>; 3] {
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
        assert_eq!(message(&file), "a.ply: face 0: List length cannot be negative (i8)");
    }
    let [ascii, little, big] = triangle(vec![Char(100), Int(0), Int(1), Int(2)]);
    assert_eq!(message(&ascii), "a.ply: line 13: face 0: vertex_indices is missing");
    for file in [little, big] {
        assert_eq!(message(&file), "a.ply: face 0: the file ends here, the header declares 1");
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
            Ok(Model::Points(points)) => points.viewpoint,
            _ => panic!("no points"),
        }
    };
    assert_eq!(viewpoint("4 5 6"), Some(DVec3::new(4.0, 5.0, 6.0)));
    assert_eq!((viewpoint("0 0 0"), viewpoint("0 nan 1")), (None, None));
}

/// Small valid files of every kind.
fn seeds() -> Vec<Vec<u8>> {
    let mut seeds: Vec<Vec<u8>> = triangle(vec![Char(3), Int(0), Int(1), Int(2)]).into();
    let strip = vec![Char(4), Int(0), Int(1), Int(2), Int(-1)];
    let vertices = [vec![UChar(0); 3], vec![UChar(1); 3], vec![UChar(2); 3], strip];
    seeds.extend(encodings(&TRIANGLE.replace("face", "tristrips"), &vertices));
    let splats = [0.0, 1.0, 2.0, 0.0, 0.0, 1.0, 0.5].map(Float).to_vec();
    seeds.extend(encodings(&POINTS.replace("ascii", "ENCODING"), &[splats.clone(), splats]));
    seeds
}

#[test]
fn the_seeds_are_valid_and_no_cut_of_them_is() {
    for seed in seeds() {
        parse(&seed).unwrap();
        // The last byte of an ascii file may be missing: it ends a line. And a number cut short is a number.
        let last_word = seed.iter().rposition(|b| !b.is_ascii_whitespace()).unwrap();
        let is_ascii = seed.starts_with(b"ply\nformat ascii");
        let end = if is_ascii { last_word - 2 } else { seed.len() };
        for cut in 0..end {
            assert!(!message(&seed[..cut]).contains('\n'));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, ..ProptestConfig::default() })]

    /// Whatever the bytes: a model with indices in range, or an error of one line.
    #[test]
    fn no_bytes_panic(
        seed in 0..9_usize,
        edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..4_u8), 0..6),
    ) {
        let mut bytes = seeds().swap_remove(seed);
        for (place, value, kind) in edits {
            let at = place.index(bytes.len());
            match kind {
                0 => bytes[at] = value,
                1 => bytes.insert(at, value),
                2 => drop(bytes.remove(at)),
                _ => bytes[at] = b'0' + value % 10,
            }
        }
        match parse(&bytes) {
            Ok(Model::Mesh(mesh)) => {
                let count = mesh.positions.len();
                prop_assert!(mesh.triangles.iter().flatten().all(|&i| (i as usize) < count));
            }
            Ok(Model::Splats { splats, .. }) => {
                let _ = splats.bounds();
            }
            Ok(Model::Points(points)) => prop_assert!(!points.positions.is_empty() || points.radii.is_none()),
            Err(error) => prop_assert!(!error.to_string().contains('\n'), "{error}"),
        }
    }
}
