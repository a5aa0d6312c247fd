mod tables;

use glam::{DVec3, Vec3};

use super::*;
use crate::{
    load::{LoadOptions, hostile::attack, input::of_bytes},
    math::srgb::linear_from_srgb,
};

fn points(text: &str) -> (Points, Loaded) {
    let loaded = of_bytes("a.xyz", text.as_bytes(), parse).unwrap();
    match &loaded.model {
        Model::Points(points) => (points.clone(), loaded),
        _ => panic!("no points"),
    }
}

fn with_columns(columns: &str, text: &str) -> Result<Loaded> {
    let options = LoadOptions { columns: Some(columns.parse().unwrap()), ..LoadOptions::default() };
    let path = std::path::Path::new("a.xyz");
    parse(&Input { path, folder: None, bytes: text.as_bytes(), options: &options, progress: &() })
}

#[track_caller]
fn refuses(text: &str, expected: &str) {
    let error = of_bytes("a.xyz", text.as_bytes(), parse).unwrap_err();
    assert_eq!((error.to_string(), error.exit_code()), (format!("a.xyz: {expected}"), 1));
}

fn notes(loaded: &Loaded) -> Vec<String> {
    loaded.notes.iter().map(ToString::to_string).collect()
}

#[test]
fn columns_are_told_by_their_number() {
    let cases = [
        ("4600000.000123456 2 3", "rows of x y z"),
        ("1 2 3 0.5", "rows of x y z i, intensity as gray"),
        ("1 2 3 255 0 7", "rows of x y z r g b, colors 0–255"),
        ("1 2 3 0.5 0.25 1", "rows of x y z r g b, colors 0–1"),
        ("1 2 3 512 0 65535", "rows of x y z r g b, colors 0–65535"),
        ("1 2 3 0 0 -2", "rows of x y z nx ny nz"),
        ("1 2 3 0.6 0.8 0", "rows of x y z nx ny nz"),
        ("1 2 3 -5 255 0 7", "rows of x y z i r g b, colors 0–255"),
        ("1 2 3 255 0 7 0 0 1", "rows of x y z r g b nx ny nz, colors 0–255"),
        ("1 2 3 0 0 1 255 0 7", "rows of x y z nx ny nz r g b, colors 0–255"),
        ("1 2 3 9 255 0 7 0 0 1", "rows of x y z i r g b nx ny nz, colors 0–255"),
    ];
    for (row, format) in cases {
        let (points, loaded) = points(&format!("# a comment\n\n{row}\r\n{row} \n\n \n"));
        assert_eq!(loaded.format, format, "{row}");
        assert_eq!((points.positions.len(), loaded.notes.len()), (2, 0), "{row}");
    }
    assert_eq!(points("4600000.000123456 2 3").0.positions[0].x, 4_600_000.000_123_456);
    let (five, loaded) = points("1 2 3 4 5\n");
    assert_eq!((five.positions.len(), loaded.format.as_str()), (1, "rows of x y z - -"));
    assert_eq!(notes(&loaded), ["2 columns (column 4, column 5) ignored"]);
}

#[test]
fn titles_names_and_units_stand_above_rows() {
    let (_, loaded) = points("Survey of a church\nx y z\n[m] [m] [m]\n1 2 3\n4 5 6\n");
    assert_eq!(loaded.format, "rows of x y z");
    assert_eq!(notes(&loaded), ["2 lines of words above the rows ignored"]);
    let (two, loaded) = points("Survey\n1 2 3 0.5\n4 5 6 1\n");
    assert_eq!((two.positions.len(), loaded.format.as_str()), (2, "rows of x y z i, intensity as gray"));
    assert_eq!(notes(&loaded), ["1 line of words above the rows ignored"]);
    refuses(
        "east north up\n1 2 3\n",
        "line 1: header: no columns x, y and z; expected them, or --columns to name them",
    );
    refuses(&"a title\n".repeat(9), "line 9: 'a'; expected a number");
}

#[test]
fn a_label_behind_a_color_is_none_and_12_bits_have_their_white() {
    let rows = |of: fn(i32) -> String| (0..200).map(of).collect::<Vec<_>>().join("\n");
    let color = |i: i32| format!("{i}.5 2 3 {} {} {}", i % 90, i % 70, i % 80);
    let label = rows(|i| format!("{i}.5 2 3 {} {} {} {}", i % 90, i % 70, i % 80, i % 5));
    assert_eq!(points(&label).1.format, "rows of x y z r g b -, colors 0–255");
    let two = rows(|i| format!("{i}.5 2 3 {} {} {} {} {}", i % 90, i % 70, i % 80, i % 5, i / 9));
    assert_eq!(points(&two).1.format, "rows of x y z r g b - -, colors 0–255");
    let intensity = rows(|i| format!("{i}.5 2 3 {} {} {} {}", i % 90, i % 70, i % 80, i % 85));
    assert_eq!(points(&intensity).1.format, "rows of x y z i r g b, colors 0–255");
    let of_12_bits = format!("{}\n1 2 3 4095 0 0\n", color(3));
    assert_eq!(points(&of_12_bits).1.format, "rows of x y z r g b, colors 0–4095");
}

#[test]
fn a_first_column_that_counts_rows_is_none_of_the_place() {
    let rows = |first: &dyn Fn(u32) -> u32, count: u32| -> String {
        (0..count).map(|i| format!("{} {}.5 2 3\n", first(i), i % 7)).collect()
    };
    for (text, format) in [
        (rows(&|i| i, 2000), "rows of - x y z"),
        (rows(&|i| i + 17, 10), "rows of - x y z"),
        (rows(&|i| i, 9), "rows of x y z i, intensity as gray"),
        (rows(&|i| i % 600, 2000), "rows of x y z i, intensity as gray"),
        (rows(&|i| 2 * i, 2000), "rows of x y z i, intensity as gray"),
    ] {
        let (points, loaded) = points(&text);
        assert_eq!(loaded.format, format);
        let x = points.positions[3].x;
        assert!(if format.contains("- x") { x == 3.5 } else { x != 3.5 }, "{format}");
    }
    let colored: String = (1..20).map(|i| format!("{i},0,0,{i},255,0,7\n")).collect();
    assert_eq!(points(&colored).1.format, "rows of - x y z r g b, colors 0–255");
}

#[test]
fn numbers_of_points_and_words_beside_places_are_not_read() {
    let rows = |row: &dyn Fn(u32) -> String| -> String { (0..30).map(|i| row(i) + "\n").collect() };
    for (row, format) in [
        (
            &(|i: u32| format!("{},{i}.25,2.5,3.125,GATE", 100 + 3 * i)) as &dyn Fn(u32) -> String,
            "rows of - x y z -",
        ),
        (&|i| format!("P{i} {i}.25 2.5 3.125"), "rows of - x y z"),
        (&|i| format!("{i}.25 2.5 3.125 wall"), "rows of x y z -"),
        (&|i| format!("{} {i}.25 2.5 3.125", 7 * i % 30), "rows of - x y z"),
        (&|i| format!("{} {} {i}.25 2.5 3.125", i / 6, i % 6), "rows of - - x y z"),
        (&|i| format!("{i}.25 2 3 {i} 0 9 255"), "rows of x y z r g b -, colors 0–255"),
        (&|i| format!("{i}.25 2 3 {i} 0 9 25"), "rows of x y z i r g b, colors 0–255"),
        (&|i| format!("{i}.25 2 3 0 -0.6 0.8 4"), "rows of x y z nx ny nz -"),
    ] {
        let (points, loaded) = points(&rows(row));
        assert_eq!((loaded.format.as_str(), points.positions[3].x), (format, 3.25));
    }
    let colmap = "# 3D point list\n#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n# Number of points: 2\n\
        63390 1.67 0.29 3.3 115 121 122 1.34 16 6542 15 7345\n63376 2.01 0.4 3.5 102 209 250 1.73 16 6519\n";
    let (found, loaded) = points(colmap);
    assert_eq!((found.positions[1].x, loaded.format.as_str()), (2.01, "rows of - x y z r g b, colors 0–255"));
    assert_eq!(notes(&loaded), ["1 column (errors and tracks) ignored"]);
}

#[test]
fn what_tables_have_beside_numbers_is_read_past() {
    let (found, loaded) =
        points("sep=;\nRechtswert;Hochwert;H\u{f6}he;i\n1,5;2;3;4\n% a note\nNA;2;3;4\n2;2;3;\n");
    assert_eq!((found.positions.len(), found.positions[0].x), (3, 1.5));
    assert_eq!(
        (loaded.format.as_str(), found.positions[1].x.is_nan()),
        ("rows of x y z i, intensity as gray", true)
    );
}

#[test]
fn degrees_become_metres() {
    let (found, loaded) = points("id,Latitude,Longitude,alt\n1,48.10,11.5,520\n2,48.11,11.5,530\n");
    let way = found.positions[1] - found.positions[0];
    assert!((way.y / 1111.97 - 1.0).abs() < 1e-3 && way.x == 0.0 && way.z == 10.0, "{way}");
    assert_eq!((loaded.up, loaded.metres_per_unit), (Some(DVec3::Z), Some(1.0)));
    let told = "2 longitudes and latitudes, by metres east and north of 11.5,48.105, replaced";
    assert!(notes(&loaded).contains(&told.to_owned()), "{:?}", notes(&loaded));
    let (both, loaded) = points("lat lon x y z\n48.1 11.5 1 2 3\n");
    assert_eq!((both.positions[0], loaded.format.as_str()), (DVec3::new(1.0, 2.0, 3.0), "rows of - - x y z"));
    assert_eq!(
        points("lat lon z\n95 11.5 3\n").0.positions[0],
        DVec3::new(11.5, 95.0, 3.0),
        "no place on earth"
    );
}

#[test]
fn normals_that_start_like_colors_are_told_by_later_rows() {
    let mut text = "1 2 3 0.6 0.7 0.1\n".repeat(3000);
    text.push_str(&"1 2 3 0 0 -1\n".repeat(3000));
    assert!(points(&text).0.normals.is_some());
}

#[test]
fn values_go_where_the_header_says() {
    let text = "Time;B;G;R;\"X [m]\";y;Z;nx;ny;nz;Radius\n9;0;51;255;1,5;2;3;0;0;2;0,5\n";
    let (points, loaded) = points(text);
    assert_eq!(points.positions, [DVec3::new(1.5, 2.0, 3.0)]);
    assert_eq!((points.normals, points.radii), (Some(vec![2.0 * Vec3::Z]), Some(vec![0.5])));
    assert_eq!(points.colors.get(0), Some([1.0, linear_from_srgb(0.2), 0.0, 1.0]));
    assert_eq!(notes(&loaded), ["1 column (column 'Time') ignored"]);
    let commented = self::points("//X Y Z Intensity\n1 2 3 7\n").1;
    assert_eq!(commented.format, "rows of x y z i, intensity as gray");
    assert_eq!(self::points("\u{feff}x,y,z\n1,2,3\n").0.positions.len(), 1);
}

#[test]
fn the_user_may_name_the_columns() {
    let loaded = with_columns("-,z,y,x", "1 2 3 4\n5 6 7 8 9\n").unwrap();
    let Model::Points(points) = &loaded.model else { panic!("no points") };
    assert_eq!(points.positions[1], DVec3::new(8.0, 7.0, 6.0));
    assert_eq!(notes(&loaded), ["1 row with more numbers than columns, whose rest is ignored"]);
    let rest = with_columns("x,y,z", "1 2 3 4\n").unwrap();
    assert_eq!(notes(&rest), ["1 column (column 4) ignored"]);
    let short = with_columns("x,y,z,i", "a b c d\n1 2 3\n").unwrap_err();
    assert_eq!(short.to_string(), "a.xyz: line 2: 3 numbers in a row; expected 4");
}

/// Times and names of classes, before the numbers and between them.
#[test]
fn columns_that_are_not_read_may_be_words() {
    let times = "time,x,y,class,z\n2024-01-01T00:00:00,1,2,tree,3\n,4,5,,6\n";
    let (points, loaded) = points(times);
    assert_eq!(points.positions, [DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, 5.0, 6.0)]);
    assert_eq!(notes(&loaded), ["2 columns (column 'time', column 'class') ignored"]);
    for text in [
        "p1 1 2 3\np2 4 5 6\n",
        "p1 1,0 2,0 3\np2 4,0 5,0 6,0\n",
        "name east north up\np1 1 2 3\np2 4 5 6\n",
        "2\np1 1 2 3\np2 4 5 6\n",
    ] {
        let named = with_columns("-,x,y,z", text).unwrap();
        let Model::Points(named) = &named.model else { panic!("no points") };
        assert_eq!(named.positions, points.positions);
    }
    let commented = self::points("# time x y z\n2024-01-01T00:00:00 1 2 3\n2024-01-01T00:00:01 4 5 6\n").0;
    assert_eq!(commented.positions, points.positions);
    let nameless = self::points(",x,y,z\n0,1,2,3\n1,4,5,6\n").0;
    assert_eq!(nameless.positions, points.positions);
    assert_eq!(self::points("2,\n1,2,3\n4,5,6\n").0.positions, points.positions);
    refuses("name,time,x,y,z\na,b\n", "line 2: 'a'; expected a number");
    refuses("t,x,y,z\na,b,2,3\n", "line 2: 'b'; expected a number");
    refuses("x,y,z,t\n1,2,3,a\n4,5,c,d\n", "line 3: 'c' in column 3; expected a number");
}

#[test]
fn pts_files_count_their_rows_a_scan() {
    for other in ["2\n1 2 3\n4 5 6\n", "1 2 3 9\n4 5 6 8\n"] {
        assert_eq!(points(other).1.up, None, "{other}");
    }
    let (points, loaded) = points("2\n1 2 3 -2048 255 0 0\n4 5 6 2047 0 0 0\n1\n7 8 9 0 0 0 0\n");
    assert_eq!((points.positions.len(), loaded.format.as_str()), (3, "rows of x y z i r g b, colors 0–255"));
    assert_eq!(loaded.up, Some(DVec3::Z), "as scanners have it");
    refuses("3\n1 2 3\n4 5 6\n", "line 1: 3 rows are said to follow, but 2 do");
    refuses("1\n1 2 3\n2\n4 5 6\n", "line 3: 2 rows are said to follow, but 1 do");
    refuses("-1\n1 2 3\n", "line 1: -1 rows are said to follow, but 1 do");
    refuses(
        "18446744073709551616\n1 2 3\n",
        "line 1: 18446744073709552000 rows are said to follow, but 1 do",
    );
    refuses("2\n3\n1 2\n", "line 2: a second line of one number; expected rows of x y z");
}

#[test]
fn wrong_rows_are_told_by_their_line() {
    refuses("1 2 3\n\n4 5\n", "line 3: 2 numbers in a row; expected 3");
    refuses("1 2 3\n4\n", "line 2: 1 number in a row; expected 3");
    refuses("1 2 3\r4 5 6x\r", "line 2: '6x' in column 3; expected a number");
    refuses("1,2,3\n1,x,3\n", "line 2: 'x' in column 2; expected a number");
    refuses("1 2\n3 4\n", "line 1: 2 numbers in a row; expected at least 3");
    refuses(
        "a b c\n1 2 3\n",
        "line 1: header: no columns x, y and z; expected them, or --columns to name them",
    );
    refuses("x y z\na b c\n", "line 2: 'a'; expected a number");
    refuses("# only\n\n", "line 1: no rows of numbers; expected x y z");
    refuses("x y z\n", "line 1: 'x y z'; expected rows of numbers");
    refuses("5\n", "line 1: '5' and no rows; expected x y z");
    refuses(
        &format!("1 2 3\n{}\n", "1 ".repeat(1 << 20)),
        "line 2: a line of more than 1048576 bytes; expected a row of numbers",
    );
    refuses(
        &format!("1 2 3\n4 5 6{}\n", " ".repeat(1 << 20)),
        "line 2: a line of more than 1048576 bytes; expected a row of numbers",
    );
    refuses(&"1".repeat(3 << 20), "line 1: a line of more than 1048576 bytes; expected a row of numbers");
}

#[test]
fn many_blocks_are_one_file_and_faults_know_their_line() {
    let row = |i: usize| format!("{i} {} {}\n", 2 * i, i % 7);
    let text: String = (0..300_000).map(row).collect();
    assert!(text.len() > 4 * 1024 * 1024);
    let (points, _) = points(&text);
    assert!(points.positions.iter().enumerate().all(|(i, p)| (p.x, p.y) == (i as f64, 2.0 * i as f64)));
    refuses(&format!("{text}1 2 bad\n"), "line 300001: 'bad' in column 3; expected a number");
}

const TEXTS: [&str; 4] = [
    "2\n1 2 3 -5 255 0 7\n# 1\n4 5 6 7 0 0 1\n1\n-1 2e3 3 0 0 1 0\n",
    "X;\"y [m]\";z;nx;ny;nz;r;g;b\n1,5;2;3;0;0;1;0;1;0,5\n",
    "//X Y Z Intensity\r\n1 2 3 7\r\n4 5 6 8\r\n",
    "1, 2, 3, 0, 0, 1,\n4, 5, 6, 1, 0, 0,\n",
];

#[test]
fn hostile_bytes_are_refused_or_read() {
    attack(&TEXTS.map(|text| text.as_bytes().to_vec()), 20_000, parse);
}
