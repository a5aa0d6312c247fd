use glam::Vec3;

use super::{Value::*, *};
use crate::{math::srgb::linear_from_srgb, scene::Colors};

fn vertices(count: usize) -> Vec<Vec<Value>> {
    (0..count).map(|i| vec![Float(i as f32), Float(0.5), Float(0.0)]).collect()
}

fn header(vertices: usize, rest: &str) -> String {
    format!(
        "ply\nformat ENCODING 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\n\
         property float z\n{rest}end_header\n"
    )
}

#[test]
fn polygons_are_fans_and_indices_may_have_any_integer_type() {
    type Make = fn(u8) -> Value;
    let types: [(&str, Make); 6] = [
        ("char", |i| Char(i as i8)),
        ("uint8", UChar),
        ("short", |i| Short(i.into())),
        ("uint16", |i| UShort(i.into())),
        ("int", |i| Int(i.into())),
        ("uint", |i| UInt(i.into())),
    ];
    for (length_name, length) in types {
        for (item_name, item) in types {
            for list in ["vertex_indices", "vertex_index"] {
                let rest = format!(
                    "element face 3\nproperty uchar flags\nproperty list {length_name} {item_name} {list}\n"
                );
                let polygons: [&[u8]; 3] = [&[0, 1, 2], &[4, 3, 2, 1, 0], &[1, 2]];
                let faces = polygons.iter().map(|polygon| {
                    let mut values = vec![UChar(1), length(polygon.len() as u8)];
                    values.extend(polygon.iter().map(|&i| item(i)));
                    values
                });
                let elements: Vec<_> = vertices(5).into_iter().chain(faces).collect();
                for file in encodings(&header(5, &rest), &elements) {
                    let mesh = mesh(&file);
                    assert_eq!(mesh.triangles, [[0, 1, 2], [4, 3, 2], [4, 2, 1], [4, 1, 0]]);
                    assert_eq!((mesh.positions.len(), mesh.positions[4].x), (5, 4.0));
                }
            }
        }
    }
}

#[test]
fn strips_alternate_restart_and_skip_repeated_corners() {
    let rest = "element tristrips 1\nproperty list int int vertex_indices\n";
    let strip = [0, 1, 2, 3, -1, 3, 4, 4, 1, 0, 2, -1, -1, 5, 4, 3];
    let strip = [strip.len() as i32].into_iter().chain(strip).map(Int).collect();
    let elements: Vec<_> = vertices(6).into_iter().chain([strip]).collect();
    for file in encodings(&header(6, rest), &elements) {
        // 3 4 4 and 4 4 1 are no triangles but count for the turn: 4 1 0 is the third.
        assert_eq!(mesh(&file).triangles, [[0, 1, 2], [2, 1, 3], [4, 1, 0], [0, 1, 2], [5, 4, 3]]);
    }
}

#[test]
fn faces_before_vertices_other_elements_normals_and_colors() {
    let header = "ply\nformat ENCODING 1.0\nelement material 1\nproperty float shine\nelement face 1\n\
        property list uchar int vertex_indices\nelement vertex 3\nproperty float x\nproperty float y\n\
        property float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty uchar red\n\
        property uchar green\nproperty uchar blue\nelement edge 1\nproperty list int short ends\nend_header\n";
    let vertex = |x: f32| {
        let mut values: Vec<Value> = [x, 0.0, 0.0, 0.0, x, 1.0].into_iter().map(Float).collect();
        values.extend([UChar(255), UChar(0), UChar(128)]);
        values
    };
    let elements = [
        vec![Float(1.0)],
        vec![UChar(3), Int(2), Int(1), Int(0)],
        vertex(0.0),
        vertex(1.0),
        vertex(2.0),
        vec![Int(2), Short(0), Short(1)],
    ];
    for file in encodings(header, &elements) {
        let mesh = mesh(&file);
        assert_eq!(mesh.triangles, [[2, 1, 0]]);
        assert_eq!(mesh.normals.unwrap()[1], Vec3::new(0.0, 1.0, 1.0));
        let Colors::Each(colors) = mesh.colors else { panic!("colors") };
        assert_eq!(colors, [[1.0, 0.0, linear_from_srgb(128.0 / 255.0), 1.0]; 3]);
    }
}
