use std::io::Cursor;

use las::{Builder, Color, Point, Writer, point::Classification};

use super::*;
use crate::{
    load::{LoadOptions, hostile::attack, input::of_bytes},
    math::srgb::linear_from_srgb,
};

/// A file of format `format` with points on a line far from the origin.
fn file(format: u8, compressed: bool, points: usize, change: impl Fn(usize, &mut Point)) -> Vec<u8> {
    let mut builder = Builder::from((1, 4));
    builder.point_format = las::point::Format::new(format).unwrap();
    builder.point_format.is_compressed = compressed;
    builder.transforms.x = las::Transform { scale: 0.001, offset: 500_000.0 };
    builder.transforms.y = las::Transform { scale: 0.001, offset: 4_600_000.0 };
    let mut writer = Writer::new(Cursor::new(Vec::new()), builder.into_header().unwrap()).unwrap();
    for i in 0..points {
        let mut point = Point { x: 500_000.0 + i as f64, y: 4_600_000.125, z: 300.0, ..Point::default() };
        point.intensity = i as u16;
        point.color = writer.header().point_format().has_color.then(|| Color::new(65535, 0, 13107));
        point.gps_time = writer.header().point_format().has_gps_time.then_some(i as f64);
        change(i, &mut point);
        writer.write_point(point).unwrap();
    }
    writer.close().unwrap();
    writer.into_inner().unwrap().into_inner()
}

fn points(loaded: &Loaded) -> &Points {
    match &loaded.model {
        Model::Points(points) => points,
        _ => panic!("no points"),
    }
}

fn notes(loaded: &Loaded) -> Vec<String> {
    loaded.notes.iter().map(ToString::to_string).collect()
}

/// The same with a record of user `LASF_Projection` that holds this text.
fn with_text(text: &str) -> Vec<u8> {
    let mut builder = Builder::from((1, 4));
    builder.transforms = las::Vector::default();
    builder.transforms.x.scale = 1e-7;
    builder.transforms.y.scale = 1e-7;
    let mut header = builder.into_header().unwrap();
    header.set_wkt_crs(text.as_bytes().to_vec()).unwrap();
    let mut writer = Writer::new(Cursor::new(Vec::new()), header).unwrap();
    for i in 0..3 {
        writer
            .write_point(Point { x: 11.5, y: 48.0 + 0.01 * f64::from(i), z: 5.0, ..Point::default() })
            .unwrap();
    }
    writer.close().unwrap();
    writer.into_inner().unwrap().into_inner()
}

#[test]
fn the_unit_is_told_and_degrees_become_metres() {
    let feet = of_bytes("a.las", &with_text("PROJCS[\"p\",UNIT[\"foot\",0.3048]]"), parse).unwrap();
    assert_eq!((feet.metres_per_unit, points(&feet).positions[0].x), (Some(0.3048), 11.5));
    let degrees = of_bytes("a.las", &with_text("GEOGCS[\"g\",UNIT[\"degree\",0.0174]]"), parse).unwrap();
    let way = points(&degrees).positions[2] - points(&degrees).positions[0];
    assert!((way.y / 2223.9 - 1.0).abs() < 1e-3 && way.x.abs() < 1e-6, "{way}");
    assert_eq!(degrees.metres_per_unit, Some(1.0));
    assert!(notes(&degrees)[0].starts_with("3 longitudes and latitudes, by metres"), "{:?}", notes(&degrees));
}

#[test]
fn bytes_behind_the_last_point_are_told() {
    let whole = file(3, false, 3, |_, _| {});
    let more = [&whole[..], &[0; 34]].concat();
    assert_eq!(notes(&of_bytes("a.las", &more, parse).unwrap()), ["34 bytes behind the last point ignored"]);
}

#[test]
fn las_and_laz_of_all_common_formats_are_the_same_points() {
    for format in [0, 1, 2, 3, 6, 7] {
        for compressed in [false, true] {
            let bytes = file(format, compressed, 120_000, |_, _| {});
            let loaded = of_bytes("a.las", &bytes, parse).unwrap();
            let has_color = [2, 3, 7].contains(&format);
            let what = if has_color { "16-bit colors" } else { "intensity as gray" };
            let name = if compressed { "LAZ" } else { "LAS" };
            assert_eq!(loaded.format, format!("{name} 1.4, format {format}, {what}"));
            assert_eq!((loaded.up, loaded.notes.len()), (Some(DVec3::Z), 0));
            let points = points(&loaded);
            assert_eq!(points.positions.len(), 120_000);
            for (i, position) in points.positions.iter().enumerate() {
                assert!(position.distance(DVec3::new(500_000.0 + i as f64, 4_600_000.125, 300.0)) < 1e-9);
            }
            let expected =
                if has_color { [1.0, 0.0, linear_from_srgb(0.2), 1.0] } else { [0.0, 0.0, 0.0, 1.0] };
            assert_eq!(points.colors.get(0), Some(expected));
        }
    }
}

#[test]
fn eight_bits_in_sixteen_are_told_and_zeros_are_no_colors() {
    let eight = file(2, false, 2, |_, point| point.color = Some(Color::new(255, 0, 51)));
    let loaded = of_bytes("a.las", &eight, parse).unwrap();
    assert_eq!(points(&loaded).colors.get(1), Some([1.0, 0.0, linear_from_srgb(0.2), 1.0]));
    assert_eq!(loaded.format, "LAS 1.4, format 2, 8-bit colors");
    let black = file(2, false, 2, |_, point| point.color = Some(Color::new(0, 0, 0)));
    let loaded = of_bytes("a.las", &black, parse).unwrap();
    assert_eq!(loaded.format, "LAS 1.4, format 2, intensity as gray");
    assert_eq!(points(&loaded).colors.get(1), Some([1.0; 4]));
}

#[test]
fn noise_and_withheld_points_are_left_out_with_a_note() {
    for format in [0, 6] {
        let bytes = file(format, true, 10, |i, point| match i {
            2 => point.classification = Classification::LowPoint,
            3 | 4 => point.is_withheld = true,
            5 if format == 6 => point.classification = Classification::HighNoise,
            _ => {}
        });
        let loaded = of_bytes("a.laz", &bytes, parse).unwrap();
        let noise = if format == 6 { 2 } else { 1 };
        assert_eq!(points(&loaded).positions.len(), 8 - noise);
        let noise = format!(
            "{noise} point{} of the classes for noise (7 and 18) left out",
            if noise == 1 { "" } else { "s" }
        );
        assert_eq!(notes(&loaded), [noise, "2 points that are marked as withheld left out".to_owned()]);
    }
}

#[track_caller]
fn refuses(bytes: &[u8], expected: &str) {
    let error = of_bytes("a.laz", bytes, parse).unwrap_err();
    assert_eq!((error.to_string(), error.exit_code()), (format!("a.laz: {expected}"), 1));
}

/// Where a header has the number of its points: the old field and that of version 1.4.
const COUNTS: [std::ops::Range<usize>; 2] = [107..111, 247..255];

#[test]
fn counts_beyond_the_file_are_refused_before_memory_is_taken() {
    refuses(&file(0, false, 0, |_, _| {}), "header: 0 points; expected at least one");
    let mut many = file(0, false, 3, |_, _| {});
    many[COUNTS[0].clone()].fill(0);
    many[COUNTS[1].clone()].fill(0xff);
    refuses(&many, "18446744073709551615 points; expected at most 4294967295");
    many[COUNTS[0].clone()].fill(0xff);
    refuses(&many, "60 bytes follow the header; expected 4294967295 points of 20 bytes");
    let mut packed = file(6, true, 3, |_, _| {});
    packed[COUNTS[0].clone()].fill(0xff);
    let error = of_bytes("a.laz", &packed, parse).unwrap_err().to_string();
    assert!(error.contains(" bytes are said to hold 4294967295 points; expected at most 11"), "{error}");
    let mut table = file(0, true, 3, |_, _| {});
    let data = u32::from_le_bytes(table[96..100].try_into().unwrap()) as usize;
    let at = u64::from_le_bytes(table[data..data + 8].try_into().unwrap()) as usize;
    table[at + 4..at + 8].fill(0xff);
    let error = of_bytes("a.laz", &table, parse).unwrap_err().to_string();
    assert!(error.starts_with("a.laz: chunks: 4294967295 of them in "), "{error}");
    table[data..data + 8].fill(0xff);
    refuses(&table, "chunks: no table of them within the file");
}

#[test]
fn wrong_headers_are_refused() {
    let whole = file(3, true, 3, |_, _| {});
    let changed = |at: usize, bytes: &[u8]| {
        let mut changed = whole.clone();
        changed[at..at + bytes.len()].copy_from_slice(bytes);
        changed
    };
    refuses(&changed(104, &[0x80]), "header: compressed as another format than 0 with 14 extra bytes");
    refuses(&changed(105, &[3, 0]), "header: records of 3 bytes; expected 34 for format 3");
    refuses(&changed(131, &0_f64.to_le_bytes()), "header: a scale of 0; expected a number other than 0");
    refuses(&changed(155, &f64::NAN.to_le_bytes()), "header: an offset of NaN; expected a finite number");
    let error = of_bytes("a.laz", &changed(96, &[0xff; 4]), parse).unwrap_err().to_string();
    assert!(error.starts_with("a.laz: header: points from byte 4294967295 of "), "{error}");
    refuses(&changed(377, b"other"), "header: compressed, but without the record that says how");
}

#[test]
fn files_cut_anywhere_are_refused() {
    for (format, compressed) in [(0, false), (3, true), (7, true)] {
        let whole = file(format, compressed, 20, |_, _| {});
        for end in 0..whole.len() {
            let cut = of_bytes("a.las", &whole[..end], parse);
            assert!(cut.is_err(), "format {format} cut at {end} of {}", whole.len());
            let told = cut.err().map(|e| e.to_string()).unwrap_or_default();
            assert!(told.contains("expected") || told.contains(" of ") || end > 227, "{told}, cut at {end}");
        }
    }
}

#[test]
fn hostile_bytes_are_refused_or_read() {
    let files = [(0, false), (3, true), (6, true), (7, true)].map(|(f, c)| file(f, c, 8, |_, _| {}));
    // A few bytes may be a thousand points: so many that a case takes a second are of no use here.
    let mut options = LoadOptions::default();
    options.limits.expanded_bytes = 1 << 14;
    attack(&files, 20_000, |input| parse(&Input { options: &options, ..*input }));
}

/// Found by fuzzing: the crate's arithmetic decoder would read beyond a table.
#[test]
fn compressed_bytes_that_a_decoder_panics_at_are_refused() {
    let error = of_bytes("a.laz", include_bytes!("damaged.laz"), parse).err().unwrap().to_string();
    assert!(error.contains("its compressed bytes are damaged") && !error.contains('\n'), "{error}");
    assert!(!crate::load::runs_foreign_decoder());
}
