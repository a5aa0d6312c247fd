//! One ball of colored points, in every format that holds points.

use std::{fmt::Write as _, io::Cursor};

use glam::DVec3;

/// How many points there are.
pub const COUNT: usize = 600;

/// A point, as files have it.
pub struct Point {
    pub place: DVec3,
    pub srgb: [u8; 3],
}

/// Points of a ball around `origin`, at multiples of 1/1024: whatever the format, nothing is rounded.
pub fn ball(origin: DVec3) -> Vec<Point> {
    let point = |i: usize| {
        let (z, turn) = (1.0 - (2 * i + 1) as f64 / COUNT as f64, 2.4 * i as f64);
        let normal = DVec3::new(turn.cos(), turn.sin(), 0.0) * (1.0 - z * z).sqrt() + z * DVec3::Z;
        let srgb = (normal * 100.0 + 128.0).to_array().map(|channel| channel as u8);
        Point { place: origin + (normal * 1024.0).round() / 1024.0, srgb }
    };
    (0..COUNT).map(point).collect()
}

/// The files' names and contents. All have the colors, and none has normals.
pub fn files(points: &[Point]) -> Vec<(&'static str, Vec<u8>)> {
    let text = rows(points, " ", "");
    vec![
        ("ascii.ply", (ply_header(points, "ascii") + &text).into_bytes()),
        ("binary.ply", binary_ply(points)),
        ("a.xyz", text.into_bytes()),
        ("a.pts", format!("{}\n{}", points.len(), rows(points, " ", " 0")).into_bytes()),
        ("a.csv", format!("x,y,z,red,green,blue\n{}", rows(points, ",", "")).into_bytes()),
        ("a.obj", obj(points).into_bytes()),
        ("a.pcd", pcd(points)),
        ("a.las", las(points, false)),
        ("a.laz", las(points, true)),
        ("a.e57", e57(points)),
    ]
}

/// A line a point; `middle` stands between place and color.
fn rows(points: &[Point], between: &str, middle: &str) -> String {
    let row = |point: &Point| {
        let (place, color) =
            (point.place.to_array().map(|v| v.to_string()), point.srgb.map(|v| v.to_string()));
        format!("{}{middle}{between}{}\n", place.join(between), color.join(between))
    };
    points.iter().map(row).collect()
}

fn ply_header(points: &[Point], encoding: &str) -> String {
    let property = |kind: &'static str| move |name: &str| format!("property {kind} {name}\n");
    let places = ["x", "y", "z"].map(property("double")).concat();
    let colors = ["red", "green", "blue"].map(property("uchar")).concat();
    format!("ply\nformat {encoding} 1.0\nelement vertex {}\n{places}{colors}end_header\n", points.len())
}

fn binary_ply(points: &[Point]) -> Vec<u8> {
    let mut bytes = ply_header(points, "binary_big_endian").into_bytes();
    for point in points {
        bytes.extend(point.place.to_array().into_iter().flat_map(f64::to_be_bytes));
        bytes.extend(point.srgb);
    }
    bytes
}

/// Vertices with colors, none of which has a face.
fn obj(points: &[Point]) -> String {
    let mut text = String::new();
    for Point { place: DVec3 { x, y, z }, srgb } in points {
        let [r, g, b] = srgb.map(|byte| f64::from(byte) / 255.0);
        let _ = writeln!(text, "v {x} {y} {z} {r} {g} {b}");
    }
    text
}

fn pcd(points: &[Point]) -> Vec<u8> {
    let count = points.len();
    let header = format!(
        "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 8 8 8 4\nTYPE F F F F\n\
        COUNT 1 1 1 1\nWIDTH {count}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {count}\nDATA binary\n"
    );
    let mut bytes = header.into_bytes();
    for Point { place, srgb: [r, g, b] } in points {
        bytes.extend(place.to_array().into_iter().flat_map(f64::to_le_bytes));
        bytes.extend([*b, *g, *r, 0]);
    }
    bytes
}

fn las(points: &[Point], compressed: bool) -> Vec<u8> {
    let mut builder = las::Builder::from((1, 4));
    builder.point_format = las::point::Format::new(7).unwrap();
    builder.point_format.is_compressed = compressed;
    let axis = |offset| las::Transform { scale: 1.0 / 1024.0, offset };
    let DVec3 { x, y, z } = points[0].place.round();
    builder.transforms = las::Vector { x: axis(x), y: axis(y), z: axis(z) };
    let mut writer = las::Writer::new(Cursor::new(Vec::new()), builder.into_header().unwrap()).unwrap();
    for Point { place: DVec3 { x, y, z }, srgb } in points {
        let [r, g, b] = srgb.map(|byte| u16::from(byte) * 257);
        let color = Some(las::Color::new(r, g, b));
        let point = las::Point { x: *x, y: *y, z: *z, color, gps_time: Some(0.0), ..las::Point::default() };
        writer.write_point(point).unwrap();
    }
    writer.close().unwrap();
    writer.into_inner().unwrap().into_inner()
}

fn e57(points: &[Point]) -> Vec<u8> {
    use e57::{E57Writer, Record, RecordValue};

    let mut bytes = Cursor::new(Vec::new());
    let mut writer = E57Writer::new(&mut bytes, "file").unwrap();
    let places = [Record::CARTESIAN_X_F64, Record::CARTESIAN_Y_F64, Record::CARTESIAN_Z_F64];
    let colors = [Record::COLOR_RED_U8, Record::COLOR_GREEN_U8, Record::COLOR_BLUE_U8];
    let mut scan = writer.add_pointcloud("scan", [places, colors].concat()).unwrap();
    for point in points {
        let place = point.place.to_array().map(RecordValue::Double);
        let color = point.srgb.map(|byte| RecordValue::Integer(byte.into()));
        scan.add_point([place, color].concat()).unwrap();
    }
    scan.finalize().unwrap();
    writer.finalize().unwrap();
    drop(writer);
    bytes.into_inner()
}
