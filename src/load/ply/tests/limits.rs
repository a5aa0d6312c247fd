use super::{
    Value::*,
    faults::{POINTS, TRIANGLE, triangle},
    *,
};

/// A file is read at a limit, and one beyond it is refused with these words.
#[track_caller]
fn limited(bytes: &[u8], limits: impl Fn(usize) -> Limits, most: usize, expected: &str) {
    load_within(bytes, limits(most)).unwrap();
    let error = load_within(bytes, limits(most - 1)).unwrap_err();
    assert_eq!((error.to_string(), error.exit_code()), (format!("a.ply: {expected}"), 1));
}

#[test]
fn points_and_faces_have_limits() {
    let points = |most: usize| Limits { points: most as u64, ..Limits::DEFAULT };
    let faces = |most: usize| Limits { faces: most as u64, ..Limits::DEFAULT };
    let items = |most: usize| Limits { list_items: most, ..Limits::DEFAULT };
    for file in triangle(vec![Char(5), Int(0), Int(1), Int(2), Int(0), Int(1)]) {
        limited(&file, points, 3, "3 points; expected at most 2");
        limited(&file, faces, 3, "face 0: more than 2 triangles; expected at most that many");
        limited(&file, items, 5, "face 0: 5 corners; expected at most 4");
    }
    let strip = vec![Char(4), Int(0), Int(1), Int(2), Int(0)];
    let elements = [vec![UChar(0); 3], vec![UChar(1); 3], vec![UChar(2); 3], strip];
    for file in encodings(&TRIANGLE.replace("face", "tristrips"), &elements) {
        limited(&file, faces, 2, "tristrips 0: more than 1 triangles; expected at most that many");
        // A strip is no polygon: one of a whole model is common.
        load_within(&file, items(3)).unwrap();
    }
}

#[test]
fn lines_and_headers_have_limits() {
    let lines = |most: usize| Limits { line_bytes: most, ..Limits::DEFAULT };
    let headers = |most: usize| Limits { header_bytes: most, ..Limits::DEFAULT };
    let row = "0 0 0 0 0 1 0.5     \n";
    let padded = POINTS.replace("ply\n", "ply\ncomment 4567890123456789\n");
    let file = format!("{padded}{row}{}", row.replace("     ", "             "));
    limited(file.as_bytes(), lines, 28, "line 14: longer than 27 bytes; expected at most that many");
    let file = format!("{padded}{row}{row}");
    limited(file.as_bytes(), lines, 25, "line 2: longer than 24 bytes; expected at most that many");
    let length = padded.len();
    let expected =
        format!("line 12: the header is longer than {} bytes; expected 'end_header' before", length - 1);
    limited(file.as_bytes(), headers, length, &expected);
}

#[test]
fn a_header_without_an_end_is_read_to_the_limit_only() {
    let mut file = b"ply\n".to_vec();
    file.resize(4 << 20, b'a');
    let error = load(&file).unwrap_err().to_string();
    assert_eq!(error, "a.ply: line 2: the header is longer than 1048576 bytes; expected 'end_header' before");
    let mut file = format!("{POINTS}0 0 0 0 0 1 ").into_bytes();
    file.resize(4 << 20, b'7');
    let error = load(&file).unwrap_err().to_string();
    assert_eq!(error, "a.ply: line 12: longer than 1048576 bytes; expected at most that many");
}

/// One byte of the file becomes a triangle of twelve.
#[test]
fn corners_of_one_byte_take_no_more_than_their_triangles() {
    for (element, count) in [("face", 200_000_usize), ("tristrips", 700_000)] {
        let mut file = format!(
            "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\n\
             property uchar z\nelement {element} 1\nproperty list uint uchar vertex_indices\nend_header\n"
        )
        .into_bytes();
        file.extend([0, 0, 0, 1, 0, 0, 0, 1, 0]);
        file.extend((count as u32).to_le_bytes());
        file.extend((0..count).map(|i| (i % 3) as u8));
        let mesh = mesh(&file);
        assert_eq!(mesh.triangles.len(), count - 2);
        assert!(mesh.triangles.capacity() * 12 <= 12 * file.len());
    }
}
