use glam::Vec3;

use super::*;
use crate::{
    load::{hostile::attack, input::of_bytes},
    math::srgb::linear_from_srgb,
};

const FIELDS: &str = "FIELDS x _ y z rgb normal_x normal_y normal_z curvature\n";

fn header(encoding: &str, points: usize) -> String {
    format!(
        "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n{FIELDS}SIZE 8 1 4 4 4 4 4 4 4\n\
        TYPE F U F F F F F F F\nCOUNT 1 3 1 1 1 1 1 1 1\nWIDTH {points}\nHEIGHT 1\n\
        VIEWPOINT 1 2 3 1 0 0 0\nPOINTS {points}\nDATA {encoding}\n"
    )
}

/// The fields of two points: field by field or point by point.
fn fields() -> [[Vec<u8>; 2]; 9] {
    let f = |values: [f32; 2]| values.map(|v| v.to_le_bytes().to_vec());
    let x = [4_600_000.000_123_456_f64, -1.0].map(|v| v.to_le_bytes().to_vec());
    let rgb = [0x00ff_0033_u32, 0xff00_ff00].map(|v| v.to_le_bytes().to_vec());
    let padding = [vec![9; 3], vec![9; 3]];
    [
        x,
        padding,
        f([2.0, 5.0]),
        f([3.0, 6.0]),
        rgb,
        f([0.0, 1.0]),
        f([0.0, 0.0]),
        f([2.0, 0.0]),
        f([7.0, 7.0]),
    ]
}

fn binary() -> Vec<u8> {
    let point = |i: usize| fields().iter().flat_map(|field| field[i].clone()).collect::<Vec<_>>();
    [header("binary", 2).into_bytes(), point(0), point(1)].concat()
}

fn compressed() -> Vec<u8> {
    let data = fields().concat().concat();
    let packed = lzf::compress(&data).unwrap_or_else(|_| {
        // Too short to become smaller: runs of bytes as they are.
        data.chunks(32).flat_map(|run| [&[run.len() as u8 - 1], run].concat()).collect()
    });
    let sizes = [packed.len(), data.len()].map(|size| (size as u32).to_le_bytes()).concat();
    [header("binary_compressed", 2).into_bytes(), sizes, packed].concat()
}

fn ascii() -> Vec<u8> {
    let float = f32::from_bits(0xff00_ff00);
    let rows = format!("4600000.000123456 9 9 9 2 3 16711731 0 0 2 7\n-1 9 9 9 5 6 {float:e} 1 0 0 7\n");
    [header("ascii", 2), rows].concat().into_bytes()
}

#[test]
fn all_encodings_are_the_same_points() {
    for (bytes, words) in
        [(ascii(), "PCD, ascii"), (binary(), "PCD, binary"), (compressed(), "PCD, binary, compressed")]
    {
        let loaded = of_bytes("a.pcd", &bytes, parse).unwrap();
        assert_eq!(loaded.format, words);
        assert_eq!(
            loaded.notes.iter().map(ToString::to_string).collect::<Vec<_>>(),
            ["1 field (curvature) ignored"]
        );
        let Model::Points(points) = loaded.model else { panic!("no points") };
        assert_eq!(points.positions[0], DVec3::new(4_600_000.000_123_456, 2.0, 3.0), "{words}");
        assert_eq!(points.positions[1], DVec3::new(-1.0, 5.0, 6.0), "{words}");
        assert_eq!(points.normals, Some(vec![2.0 * Vec3::Z, Vec3::X]));
        let Colors::Each(colors) = points.colors else { panic!("colors") };
        assert_eq!(colors, [[1.0, 0.0, linear_from_srgb(0.2), 1.0], [0.0, 1.0, 0.0, 1.0]], "{words}");
        let place = DVec3::new(1.0, 2.0, 3.0);
        assert_eq!(points.viewpoints, Viewpoint::of_all(points.positions.len(), Some(place)));
    }
}

#[test]
fn channels_intensities_and_whole_numbers_are_read() {
    let text = "VERSION .7\nFIELDS x y z r g b\nSIZE 2 2 2 1 1 1\nTYPE I I I U U U\nWIDTH 1\nHEIGHT 1\nDATA ";
    let binary = [format!("{text}binary\n").as_bytes(), &[0xff, 0xff, 2, 0, 3, 0, 255, 0, 51]].concat();
    for bytes in [binary, format!("{text}ascii\n-1 2 3 255 0 51\n").into_bytes()] {
        let Model::Points(points) = of_bytes("a.pcd", &bytes, parse).unwrap().model else {
            panic!("no points")
        };
        assert_eq!(points.positions, [DVec3::new(-1.0, 2.0, 3.0)]);
        assert_eq!(points.colors.get(0), Some([1.0, 0.0, linear_from_srgb(0.2), 1.0]));
        assert!(points.viewpoints.is_empty() && points.normals.is_none());
    }
    let gray =
        "FIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nPOINTS 2\nDATA ascii\nnan 0 0 1\n0 0 0 2\n";
    let loaded = of_bytes("a.pcd", gray.as_bytes(), parse).unwrap();
    assert_eq!(loaded.format, "PCD, ascii, intensity as gray");
}

#[track_caller]
fn refuses(bytes: &[u8], expected: &str) {
    let error = of_bytes("a.pcd", bytes, parse).unwrap_err();
    assert_eq!(error.to_string(), format!("a.pcd: {expected}"));
}

#[test]
fn faults_are_named() {
    let whole = binary();
    refuses(&whole[..whole.len() - 1], "77 bytes of points; expected 2 points of 39 bytes");
    let packed = compressed();
    let short = &packed[..packed.len() - 1];
    assert!(
        of_bytes("a.pcd", short, parse).unwrap_err().to_string().contains(" compressed bytes; expected ")
    );
    let rows = ascii();
    refuses(&rows[..rows.len() - 3], "line 13: 10 numbers; expected 11");
    refuses(&[&rows[..], b"1"].concat(), "line 14: a line more than the 2 points of the header");
    let with = |from: &str, to: &str| header("ascii", 1).replace(from, to);
    refuses(
        with("DATA ascii\n", "").as_bytes(),
        "line 11: the file ends; expected a header that ends with DATA",
    );
    refuses(with("TYPE F U", "TYPE F X").as_bytes(), "line 5: TYPE 'X'; expected I, U or F");
    refuses(with("SIZE 8", "SIZE 3").as_bytes(), "line 11: field 'x' of SIZE 3; expected one of [4, 8]");
    refuses(
        with("COUNT 1", "COUNT 18446744073709551615").as_bytes(),
        "line 11: field 'x' of COUNT 18446744073709551615",
    );
    refuses(with("SIZE 8 1", "SIZE 8").as_bytes(), "line 11: 9 FIELDS and 8 of SIZE; expected as many");
    refuses(
        with("WIDTH 1", "WIDTH 3").as_bytes(),
        "line 11: WIDTH 3, HEIGHT 1 and POINTS 1; expected the product",
    );
    refuses(with("WIDTH 1", "WIDTH -1").as_bytes(), "line 7: '-1'; expected a whole number");
    refuses(with(" y ", " w ").as_bytes(), "header: not all of the fields x, y and z");
    refuses(
        with("DATA ascii", "DATA zip").as_bytes(),
        "line 11: DATA 'zip'; expected ascii, binary or binary_compressed",
    );
    refuses(header("ascii", 4_000_000_000).as_bytes(), "0 bytes of points; expected 4000000000 points");
    let huge = header("binary_compressed", 1 << 40);
    refuses(
        &[huge.as_bytes(), &[1, 0, 0, 0, 0, 0, 0, 0, 0]].concat(),
        "1099511627776 points; expected at most 4294967295",
    );
    let bomb = header("binary_compressed", 100_000_000);
    let problem = "3900000000 bytes of points";
    let sizes = [1_u32.to_le_bytes(), 3_900_000_000_u32.to_le_bytes(), [0; 4]].concat();
    let error = of_bytes("a.pcd", &[bomb.as_bytes(), &sizes].concat(), parse).unwrap_err().to_string();
    assert!(
        error.contains("4 compressed bytes are said to expand to 3900000000; expected at most"),
        "{problem}: {error}"
    );
}

#[test]
fn hostile_bytes_are_refused_or_read() {
    attack(&[ascii(), binary(), compressed()], 20_000, parse);
}
