//! Rows that other readers stumble over.

use super::*;

#[test]
fn faces_may_stand_before_their_vertices_and_what_is_not_drawn_is_noted() {
    let text =
        format!("f 1 2 3\nf 1 2\nf 4\n{SQUARE}v NaN 0 inf\nf 1 2 5\nf 1 2 4\nl 1 2\np 1\nsurf 0 1 0 1 1 2\n");
    let found = mesh(&text);
    assert_eq!(found.triangles, [[0, 1, 2], [0, 1, 3]]);
    assert!(found.positions.iter().all(|position| position.is_finite()));
    assert_eq!(
        notes(&text),
        [
            "1 vertex without a face left out",
            "2 faces with fewer than 3 corners left out",
            "1 face with a coordinate that is not finite left out",
            "2 rows of lines and points ignored",
            "1 free-form shape (curve or surface) ignored",
        ]
    );
}

#[test]
fn a_backslash_continues_a_row() {
    let text = "v 0 \\\n 0 0\nv 1 0 0\\\r\n\nv 1 1\\ \n 0\nf 1 \\\n2 \\\n3\\\n\nf 3 2 1 \\";
    let mesh = mesh(text);
    assert_eq!((mesh.positions.len(), mesh.triangles), (3, vec![[0, 1, 2], [2, 1, 0]]));
    // Faults are where the row begins, and a row after it has its own number.
    let expected = "position parse error; expected v x y z, with nothing, w, or r g b after it";
    refuses("v 0 0 0\nv \\\n1 \\\nx 0\n", &format!("line 2: 'v 1  x 0': {expected}"));
    refuses("v 0 0 0\nv \\\n1 \\\n1 0\nv 2\n", &format!("line 5: 'v 2': {expected}"));
}

#[test]
fn faces_with_unusable_normals_go_without_them() {
    for normal in ["9", "0", "-9", "2", "3", "4294967297"] {
        let text = format!(
            "{SQUARE}vn 0 0 1\nvn 0 0 0\nvn nan 0 1\nvn 1 0 0\nf 1//1 2//1 3//1\nf 1//4 3//4 4//{normal}\n"
        );
        let normals = mesh(&text).normals.unwrap();
        assert_eq!(normals, [Vec3::Z, Vec3::Z, Vec3::Z, Vec3::ZERO], "{normal}");
        assert_eq!(notes(&text), ["1 face's normal that is zero, not finite or not there ignored"]);
    }
}

#[test]
fn colors_beyond_their_range_are_clamped_and_bytes_are_bytes() {
    let text = "v 0 0 0 255 0 51\nv 1 0 0\nv 0 1 0 0 0 0\nf 1 2 3\n";
    let Colors::Each(colors) = mesh(text).colors else { panic!("colors") };
    let gray = linear_from_srgb(0.8);
    let expected = [[1.0, 0.0, linear_from_srgb(0.2), 1.0], [gray, gray, gray, 1.0], [0.0, 0.0, 0.0, 1.0]];
    assert_eq!(colors, expected);
    assert_eq!(notes(&text.replace("255", "1.5").replace("51", "-1")), ["1 color beyond 0 to 1 clamped"]);
}

#[test]
fn limits_hold_at_the_limit_and_not_one_beyond() {
    let text = format!("{SQUARE}f 1 2 3 4 # quad\nf 1 2 3\n");
    let check = |limits: fn(usize) -> Limits, most: usize, expected: &str| {
        let within = |most| {
            let options = LoadOptions { limits: limits(most), ..LoadOptions::default() };
            load_with(Path::new("a.obj"), text.as_bytes(), &options)
        };
        within(most).unwrap();
        assert_eq!(within(most - 1).unwrap_err().to_string(), format!("a.obj: {expected}"));
    };
    check(
        |most| Limits { points: most as u64, ..Limits::DEFAULT },
        4,
        "line 4: more than 3 vertices; expected at most that many",
    );
    check(
        |most| Limits { faces: most as u64, ..Limits::DEFAULT },
        3,
        "line 6: more than 2 triangles; expected at most that many",
    );
    check(
        |most| Limits { list_items: most, ..Limits::DEFAULT },
        4,
        "line 5: more than 3 corners; expected at most that many",
    );
    check(
        |most| Limits { line_bytes: most, ..Limits::DEFAULT },
        16,
        "line 5: longer than 15 bytes; expected at most that many",
    );
}

#[test]
fn lines_of_any_length_and_endless_continuations_are_refused() {
    let expected = "line 5: longer than 1048576 bytes; expected at most that many";
    refuses(&format!("{SQUARE}f {}", "1 ".repeat(2 << 20)), expected);
    refuses(&format!("{SQUARE}f 1 2 3 {}", "1 \\\n".repeat(1 << 20)), expected);
}

#[test]
fn points_note_normals_that_are_not_theirs() {
    assert_eq!(
        notes(&format!("{SQUARE}vn 0 0 1\np 1 2 3 4\n")),
        ["1 normal, of which there is not one for each point, ignored", "1 row of lines and points ignored"]
    );
}
