//! Files as programs write them.

use glam::{DVec3, Vec3};

use super::{
    Value::*,
    faults::{POINTS, message},
    *,
};
use crate::math::srgb::linear_from_srgb;

/// A file of ascii points: further properties, and the rows.
fn cloud(properties: &str, rows: &str) -> Vec<u8> {
    let count = rows.lines().count();
    format!(
        "ply\nformat ascii 1.0\nelement vertex {count}\nproperty float x\nproperty float y\nproperty float z\n\
         {properties}end_header\n{rows}"
    )
    .into_bytes()
}

fn of_type(names: &str, kind: &str) -> String {
    names.split(' ').map(|name| format!("property {kind} {name}\n")).collect()
}

/// The colors of points whose color properties have these names and this type, as sRGB values.
#[track_caller]
fn colors(names: &str, kind: &str, rows: &str, expected: &[[f32; 3]]) {
    let points = points(&cloud(&of_type(names, kind), rows));
    for (found, expected) in each_color(&points.colors).iter().zip(expected) {
        let expected = expected.map(linear_from_srgb);
        let off = found.iter().zip(expected).map(|(f, e)| (f - e).abs()).fold(0.0, f32::max);
        let is_number = found.iter().all(|value| value.is_finite());
        assert!(off < 1e-6 && is_number, "{names} {kind}: {found:?}, expected {expected:?}");
    }
    assert_eq!(points.positions.len(), expected.len());
}

#[test]
fn colors_have_many_names() {
    let row = "0 0 0 51 102 255\n";
    let expected = [[0.2, 0.4, 1.0]];
    for names in ["red green blue", "diffuse_red diffuse_green diffuse_blue", "r g b"] {
        colors(names, "uchar", row, &expected);
        colors(names, "float", "0 0 0 0.2 0.4 1\n", &expected);
    }
    // The order is the file's.
    colors("blue red green", "uint8", "0 0 0 255 51 102\n", &expected);
}

#[test]
fn names_and_types_have_any_letters() {
    let text = |types: [&str; 3], names: &str| {
        let [position, normal, color] = types;
        let [x, y, z, nx, red] = <[&str; 5]>::try_from(names.split(' ').collect::<Vec<_>>()).unwrap();
        format!(
            "ply\nformat ascii 1.0\nelement {x} 3\nproperty {position} {y}\nproperty {position} Y\nproperty {position} {z}\n\
             property {normal} {nx}\nproperty {normal} Ny\nproperty {normal} NZ\nproperty {color} {red}\nproperty {color} Green\n\
             property {color} BLUE\nelement Face 1\nproperty list uchar int Vertex_Index\nend_header\n\
             0 0 0 0 0 1 255 0 0\n1 0 0 0 0 1 0 0 0\n0 1 0 0 0 1 0 0 0\n3 0 1 2\n"
        )
    };
    for (types, names) in [
        (["FLOAT", "Float32", "UCHAR"], "Vertex X Z NX Red"),
        (["DOUBLE", "float", "UInt8"], "VERTEX X z nx RED"),
    ] {
        let loaded = load(text(types, names).as_bytes()).unwrap();
        assert!(loaded.notes.is_empty(), "{:?}", loaded.notes);
        let Model::Mesh(mesh) = loaded.model else { panic!("no mesh") };
        assert_eq!((mesh.positions[1], mesh.normals.unwrap()[2]), (DVec3::X, Vec3::Z));
        assert_eq!((mesh.colors.get(0), mesh.triangles), (Some([1.0, 0.0, 0.0, 1.0]), vec![[0, 1, 2]]));
    }
    // The exact name comes first.
    let both = points(&cloud(&of_type("X", "float"), "1 2 3 9\n"));
    assert_eq!(both.positions, [DVec3::new(1.0, 2.0, 3.0)]);
}

#[test]
fn integers_of_64_bits_are_read_in_each_encoding() {
    let header = |encoding: &str| {
        let places = "property int64 x\nproperty uint64 y\nproperty long z\n";
        format!("ply\nformat {encoding} 1.0\nelement vertex 1\n{places}end_header\n").into_bytes()
    };
    let (x, y, z) = (-5_i64, 1_u64 << 40, 7_i64);
    let little = [x.to_le_bytes(), y.to_le_bytes(), z.to_le_bytes()].concat();
    let big = [x.to_be_bytes(), y.to_be_bytes(), z.to_be_bytes()].concat();
    for (encoding, body) in [
        ("ascii", b"-5 1099511627776 7\n".to_vec()),
        ("binary_little_endian", little),
        ("binary_big_endian", big),
    ] {
        let read = points(&[header(encoding), body].concat());
        assert_eq!(read.positions, [DVec3::new(-5.0, (1_u64 << 40) as f64, 7.0)], "{encoding}");
    }
}

#[test]
fn what_is_behind_the_last_element_is_told() {
    let told = |bytes: &[u8]| load(bytes).unwrap().notes.iter().map(ToString::to_string).collect::<Vec<_>>();
    let whole = cloud("", "0 0 0\n1 0 0\n");
    assert!(told(&whole).is_empty() && told(&[&whole[..], b" \n\n"].concat()).is_empty());
    let expected = ["6 bytes behind the last element of the header ignored"];
    assert_eq!(
        told(&[&whole[..], b"0 1 0\n9"].concat())[..],
        ["7 bytes behind the last element of the header ignored"]
    );
    assert_eq!(told(&[&whole[..], b"0 1  0\n"].concat())[..], expected);
}

#[test]
fn integer_colors_are_bytes_where_all_fit_them() {
    for kind in ["short", "ushort", "int", "uint", "int32", "uint16", "char", "float", "double"] {
        let least = if kind == "char" { "0 0 0 -1 0 -128\n" } else { "0 0 0 255 0 128\n" };
        let rows = format!("{least}0 0 0 51 102 0\n");
        colors("red green blue", kind, &rows, &[[1.0, 0.0, 128.0 / 255.0], [0.2, 0.4, 0.0]]);
    }
    colors("red green blue", "ushort", "0 0 0 4095 0 819\n", &[[1.0, 0.0, 0.2]]);
    let dark = 51.0 / 65_535.0;
    for kind in ["ushort", "uint", "int"] {
        colors(
            "red green blue",
            kind,
            "0 0 0 65535 0 13107\n0 0 0 51 0 0\n",
            &[[1.0, 0.0, 0.2], [dark, 0.0, 0.0]],
        );
    }
    colors("red green blue", "short", "0 0 0 32767 0 0\n", &[[1.0, 0.0, 0.0]]);
    colors("red green blue", "uint", "0 0 0 4294967295 0 2147483648\n", &[[1.0, 0.0, 0.5]]);
}

#[test]
fn floats_are_zero_to_one_and_beyond_is_clamped_and_noted() {
    let rows = "0 0 0 1.5 0.5 -0.25\n0 0 0 inf 0.5 0\n0 0 0 0 0 1\n";
    colors("red green blue", "float", rows, &[[1.0, 0.5, 0.0], [1.0, 0.5, 0.0], [0.0, 0.0, 1.0]]);
    let file = cloud(&of_type("red green blue", "float"), rows);
    assert_eq!(notes(&file), ["2 colors beyond 0 to 1 clamped"]);
    let not_a_number = points(&cloud(&of_type("red green blue", "float"), "0 0 0 nan 0.5 0\n"));
    assert!(each_color(&not_a_number.colors)[0][0].is_nan());
}

#[test]
fn intensities_are_grays_where_there_is_no_color() {
    for name in ["intensity", "scalar_Intensity", "scalar_intensity"] {
        let gray = |kind: &str, rows: &str, grays: [f32; 2]| {
            colors(name, kind, rows, &grays.map(|gray| [gray; 3]));
        };
        gray("float", "0 0 0 1\n0 0 0 0.5\n", [1.0, 0.5]);
        gray("float", "0 0 0 255\n0 0 0 51\n", [1.0, 0.2]);
        gray("float", "0 0 0 2048\n0 0 0 512\n", [1.0, 0.25]);
        gray("ushort", "0 0 0 65535\n0 0 0 13107\n", [1.0, 0.2]);
        gray("uchar", "0 0 0 102\n0 0 0 51\n", [0.4, 0.2]);
        // Where the scanner had none.
        gray("float", "0 0 0 nan\n0 0 0 1\n", [0.0, 1.0]);
        let properties = of_type(name, "float") + &of_type("red green blue", "uchar");
        let points = points(&cloud(&properties, "0 0 0 0.5 255 0 0\n"));
        assert_eq!(each_color(&points.colors), [[1.0, 0.0, 0.0, 1.0]]);
    }
}

#[test]
fn incomplete_groups_are_left_out_and_noted() {
    let file = cloud(&of_type("nx nz red su_x", "float"), "1 2 3 4 5 6 7\n");
    let points = points(&file);
    assert!(points.normals.is_none() && matches!(points.colors, Colors::Uniform(_)));
    assert_eq!(
        notes(&file),
        [
            "1 value of 'nx' without 'ny' ignored",
            "1 value of 'red' without 'green' ignored",
            "1 value of 'su_x' without 'su_y' ignored",
            "1 field of vertices (nz) ignored",
        ]
    );
    // One letter may mean anything.
    let others = notes(&cloud(&of_type("r confidence s t", "float"), "1 2 3 4 5 6 7\n"));
    assert_eq!(others, ["4 fields of vertices (r, confidence, s, t) ignored"]);
}

#[test]
fn a_radius_is_one_and_sizes_of_unknown_units_are_in_doubt() {
    let radius = points(&cloud(&of_type("radius", "float"), "1 2 3 0.5\n"));
    assert_eq!((radius.radii, radius.radii_in_doubt), (Some(vec![0.5]), false));
    for name in ["psize", "psz", "size"] {
        let sizes = points(&cloud(&of_type(name, "float"), "1 2 3 0.5\n"));
        assert_eq!((sizes.radii, sizes.radii_in_doubt), (Some(vec![0.5]), true));
        let both = points(&cloud(&of_type(&format!("{name} radius"), "float"), "1 2 3 0.5 0.25\n"));
        assert_eq!((both.radii, both.radii_in_doubt), (Some(vec![0.25]), false));
    }
}

#[test]
fn other_names_of_the_vertices_and_elements_that_are_read_past() {
    for name in ["vertices", "point", "points"] {
        let file = String::from_utf8(cloud("", "1 2 3\n")).unwrap().replace("vertex", name);
        assert_eq!(points(file.as_bytes()).positions, [DVec3::new(1.0, 2.0, 3.0)]);
        // `vertex` itself wins; two others are too many.
        let more = of_type("x y z", "float");
        let both = |other: &str| {
            let element = format!("element {other} 1\n{more}end_header");
            file.replace("end_header", &element) + "7 8 9\n"
        };
        assert_eq!(points(both("vertex").as_bytes()).positions, [DVec3::new(7.0, 8.0, 9.0)]);
        assert_eq!(notes(both("vertex").as_bytes()), [format!("1 element '{name}' ignored")]);
        let other = if name == "point" { "points" } else { "point" };
        let error = load(both(other).as_bytes()).unwrap_err().to_string();
        assert_eq!(error, "a.ply: header: no element 'vertex'; expected one with x y z");
    }
    let header = "ply\nformat ENCODING 1.0\nelement edge 2\nproperty int a\nproperty list uchar double b\n\
        element vertex 1\nproperty list ushort int near\nproperty int x\nproperty int y\nproperty list char char far\n\
        property int z\nelement material 1\nproperty uchar shine\nend_header\n";
    let elements = [
        vec![Int(1), UChar(2), Double(0.5), Double(1.5)],
        vec![Int(1), UChar(0)],
        vec![UShort(1), Int(9), Int(1), Int(2), Char(2), Char(1), Char(1), Int(3)],
        vec![UChar(1)],
    ];
    for file in encodings(header, &elements) {
        assert_eq!(points(&file).positions, [DVec3::new(1.0, 2.0, 3.0)]);
        let told = [
            "2 fields of vertices (near, far) ignored",
            "3 elements 'edge' and of other unknown names ignored",
        ];
        assert_eq!(notes(&file), told);
    }
}

#[test]
fn rows_of_faces_may_have_a_value_too_many() {
    let file = "ply\nformat ascii 1.0\nelement face 2\nproperty list uchar int vertex_indices\nelement vertex 3\n\
        property float x\nproperty float y\nproperty float z\nend_header\n3 0 1 2 \n3 2 1 0 0\n0 0 0\n1 0 0\n0 1 0\n";
    assert_eq!(mesh(file.as_bytes()).triangles, [[0, 1, 2], [2, 1, 0]]);
    assert_eq!(notes(file.as_bytes()), ["1 end of rows with more values than the header declares ignored"]);
}

#[test]
fn headers_have_comments_anywhere_in_any_encoding_and_names_of_any_letters() {
    let mut file =
        b"ply\r\ncomment before the format, cr\xe9\xe9\r\nformat ascii 1.0\r\nobj_info \xff\x00\r\n\r\n"
            .to_vec();
    file.extend(
        b"comment\r\nelement vertex 1\r\nproperty float32 x\r\nproperty float64 y\r\nproperty float z\r\n\
        property float scalar_Coord._Z[<0.5]\r\nend_header\r\n1 2 3 4\r\n",
    );
    assert_eq!(points(&file).positions, [DVec3::new(1.0, 2.0, 3.0)]);
    assert_eq!(notes(&file), ["1 field of vertices (scalar_Coord._Z[<0.5]) ignored"]);
}

#[test]
fn of_many_fields_the_first_are_told() {
    let file = cloud(&of_type("a b c d e f g h i", "float"), "1 2 3 0 0 0 0 0 0 0 0 0\n");
    assert_eq!(notes(&file), ["9 fields of vertices (a, b, c, d, e, f, g, h, …) ignored"]);
}

#[test]
fn integers_may_be_written_as_floats() {
    let file = cloud(&of_type("red green blue", "uchar"), "1 2 3 255.0 0. 51\n");
    assert_eq!(each_color(&points(&file).colors), [[1.0, 0.0, linear_from_srgb(0.2), 1.0]]);
    for word in ["256", "-1", "1.5", "256.0", "nan"] {
        let file = cloud(&of_type("red green blue", "uchar"), &format!("1 2 3 {word} 0 0\n"));
        let error = load(&file).unwrap_err().to_string();
        assert_eq!(error, format!("a.ply: line 11: vertex 0: red is '{word}', expected a uchar"));
    }
}

#[test]
fn what_meshes_do_not_use_is_noted() {
    let file = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        property float radius\nelement face 2\nproperty list uchar int vertex_indices\nproperty uchar red\nend_header\n\
        0 0 0 1\n1 0 0 1\n0 1 0 1\n3 0 1 2 9\n2 0 1 9\n";
    assert_eq!(
        notes(file.as_bytes()),
        [
            "1 face with fewer than 3 corners left out",
            "3 sizes of vertices that faces join ignored",
            "2 colors of faces ignored",
        ]
    );
    let normals = points(&cloud(&of_type("normal_x normal_y normal_z", "float"), "1 2 3 4 5 6\n")).normals;
    assert_eq!(normals, Some(vec![Vec3::new(4.0, 5.0, 6.0)]));
}

#[test]
fn lines_may_end_with_a_carriage_return_alone() {
    for file in encodings(&POINTS.replace("ascii", "ENCODING"), &[vec![Float(0.5); 7], vec![Float(1.5); 7]]) {
        let end = file.windows(10).position(|window| window == b"end_header").unwrap() + 11;
        let is_ascii = file.windows(5).any(|window| window == b"ascii");
        let mut old = file.clone();
        let lines = if is_ascii { file.len() } else { end };
        old[..lines].iter_mut().filter(|byte| **byte == b'\n').for_each(|byte| *byte = b'\r');
        assert_eq!(splats(&old).positions, [DVec3::splat(0.5), DVec3::splat(1.5)]);
    }
    let text = POINTS.replace('\n', "\r") + "0 0 0 0 0 1 1\r0 0 0 0 0 one 1\r";
    assert!(message(text.as_bytes()).starts_with("a.ply: line 13: "), "{}", message(text.as_bytes()));
}
