use super::*;
use crate::load::{hostile::attack, input::of_bytes};

const CORNERS: [[[f32; 3]; 3]; 3] = [
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
    [[1.0, 0.0, -0.0], [1.0, 1.0, 0.0], [-0.0, 1.0, 0.0]],
    [[2.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]],
];

fn binary_bytes(header: &[u8]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend((CORNERS.len() as u32).to_le_bytes());
    for triangle in CORNERS {
        bytes.extend([0_f32; 3].map(f32::to_le_bytes).concat());
        bytes.extend(triangle.concat().into_iter().flat_map(f32::to_le_bytes));
        bytes.extend([0, 0]);
    }
    bytes
}

fn text() -> String {
    let vertex = |v: &[f32; 3]| format!("      vertex {} {:e} {}\r\n", v[0], v[1], v[2]);
    let facet = |corners: &[[f32; 3]; 3]| {
        let corners: String = corners.iter().map(vertex).collect();
        format!("  facet normal 0 0 0\r\n    OUTER loop\r\n{corners}    endloop\r\n  endfacet\r\n")
    };
    let facets: String = CORNERS.iter().map(facet).collect();
    format!("solid a vertex\r\n{facets}endsolid a\r\n")
}

#[track_caller]
fn check(bytes: &[u8], format: &str, notes: &[&str]) {
    let loaded = of_bytes("a.stl", bytes, parse).unwrap();
    let Model::Mesh(mesh) = loaded.model else { panic!("no mesh") };
    assert_eq!(mesh.triangles, [[0, 1, 2], [1, 3, 2]]);
    assert_eq!(mesh.positions[3], DVec3::new(1.0, 1.0, 0.0));
    assert_eq!(loaded.format, format);
    assert_eq!(loaded.notes.iter().map(ToString::to_string).collect::<Vec<_>>(), notes);
}

const DEGENERATE: &str = "1 triangle with two corners at one place left out";

#[test]
fn binary_and_text_are_the_same_mesh_with_shared_vertices() {
    check(&binary_bytes(b"made by hand"), "STL, binary", &[DEGENERATE]);
    check(&binary_bytes(b"solid but binary"), "STL, binary", &[DEGENERATE]);
    check(text().as_bytes(), "STL, text", &[DEGENERATE]);
    let mut colored = binary_bytes(b"COLOR=\xff\x33\x00\xff");
    colored[84 + 48] = 1;
    colored.extend([7; 3]);
    let notes = [
        DEGENERATE,
        "1 attribute of triangles, which may be colors, ignored",
        "3 bytes behind the last triangle ignored",
    ];
    check(&colored, "STL, binary, its header's color", &notes);
    let Model::Mesh(mesh) = of_bytes("a.stl", &colored, parse).unwrap().model else { panic!("no mesh") };
    let Colors::Uniform([red, green, blue, alpha]) = mesh.colors else { panic!("no color") };
    assert!((red, blue, alpha) == (1.0, 0.0, 1.0) && (0.03..0.04).contains(&green));
}

#[test]
fn words_may_have_any_letters() {
    check(text().to_ascii_uppercase().as_bytes(), "STL, text", &[DEGENERATE]);
}

#[track_caller]
fn refuses(bytes: &[u8], expected: &str) {
    let error = of_bytes("a.stl", bytes, parse).unwrap_err();
    assert_eq!(error.to_string(), format!("a.stl: {expected}"));
}

#[test]
fn faults_name_their_line() {
    let whole = text();
    refuses(&whole.as_bytes()[..whole.len() - 12], "line 23: the file ends; expected endsolid");
    refuses(b"solid\nfacet\nvertex 0 0\n", "line 3: the line ends; expected a coordinate");
    refuses(b"solid\nvertex 0 0 0\nvertex 0 0 x\n", "line 3: 'x'; expected a coordinate");
    refuses(b"solid\nvertex 0 0 0\nendloop\n", "line 3: a loop of 1 corners; expected 3");
    refuses(b"solid\nouter loop\nendloop\n", "line 3: a loop of 0 corners; expected 3");
    refuses(b"solid\nvertex 0 0 0\nfacet\n", "line 3: 'facet' within a loop; expected endloop");
    refuses(b"solid\nfacets\n", "line 2: 'facets'; expected a word of STL, such as facet or vertex");
    let mut huge = binary_bytes(b"huge");
    huge[80..84].fill(0xff);
    let expected = "; expected 84 bytes and 50 a triangle, or text that starts with solid";
    let count = "4294967295 triangles are said to be here, but the file ends before them";
    refuses(&huge, &format!("{count}{expected}"));
    let mut cut = binary_bytes(b"solid but binary");
    cut.truncate(200);
    refuses(&cut, &format!("3 triangles are said to be here, but the file ends before them{expected}"));
    refuses(&huge[..83], &format!("the file ends within its header{expected}"));
}

#[test]
fn hostile_bytes_are_refused_or_read() {
    attack(&[binary_bytes(b"a"), text().into_bytes()], 20_000, parse);
}
