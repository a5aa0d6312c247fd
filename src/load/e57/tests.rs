use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

use e57::{E57Writer, Quaternion, Record, RecordDataType, RecordValue, Transform, Translation};

use super::*;
use crate::{
    load::{hostile::attack, input::of_bytes},
    math::srgb::linear_from_srgb,
};

fn double(value: f64) -> RecordValue {
    RecordValue::Double(value)
}

fn of(name: RecordName, data_type: RecordDataType) -> Record {
    Record { name, data_type }
}

/// A quarter turn about z, then far away.
fn pose() -> Transform {
    Transform {
        rotation: Quaternion { w: FRAC_1_SQRT_2, x: 0.0, y: 0.0, z: FRAC_1_SQRT_2 },
        translation: Translation { x: 500_000.0, y: 4_600_000.0, z: 300.0 },
    }
}

/// Two scans: colored points with a pose, every second of which is invalid, and spherical points with intensities.
fn file(scans: usize, second_pose: Option<Transform>) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let mut writer = E57Writer::new(&mut bytes, "file").unwrap();
    let prototype = vec![
        Record::CARTESIAN_X_F64,
        Record::CARTESIAN_Y_F64,
        Record::CARTESIAN_Z_F64,
        Record::CARTESIAN_INVALID_STATE,
        Record::COLOR_RED_U8,
        Record::COLOR_GREEN_U8,
        Record::COLOR_BLUE_U8,
    ];
    let mut scan = writer.add_pointcloud("one", prototype).unwrap();
    scan.set_transform(Some(pose()));
    // The crate wants a whole byte of every field in the first packet, and a state has two bits.
    for i in 0..4 {
        let color = [255, 0, 51].map(RecordValue::Integer);
        let place = [i as f64, 0.125, 0.0].map(double);
        let state = RecordValue::Integer(if i % 2 == 1 { 2 } else { 0 });
        scan.add_point(place.into_iter().chain([state]).chain(color).collect()).unwrap();
    }
    scan.finalize().unwrap();
    if scans > 1 {
        let scaled = RecordDataType::ScaledInteger { min: -32768, max: 32767, scale: 0.001, offset: 0.0 };
        let prototype = vec![
            of(RecordName::SphericalRange, RecordDataType::F64),
            of(RecordName::SphericalAzimuth, RecordDataType::F64),
            of(RecordName::SphericalElevation, scaled),
            Record::INTENSITY_U16,
        ];
        let mut scan = writer.add_pointcloud("two", prototype).unwrap();
        scan.set_transform(second_pose);
        scan.add_point(vec![
            double(2.0),
            double(FRAC_PI_2),
            RecordValue::ScaledInteger(0),
            RecordValue::Integer(65535),
        ])
        .unwrap();
        scan.finalize().unwrap();
    }
    writer.finalize().unwrap();
    drop(writer);
    bytes.into_inner()
}

fn points(loaded: &Loaded) -> &Points {
    match &loaded.model {
        Model::Points(points) => points,
        _ => panic!("no points"),
    }
}

#[test]
fn scans_are_joined_in_their_poses() {
    let loaded = of_bytes("a.e57", &file(2, None), parse).unwrap();
    assert_eq!(
        (loaded.format.as_str(), loaded.up, loaded.metres_per_unit),
        ("E57, 2 scans", Some(DVec3::Z), Some(1.0))
    );
    assert_eq!(
        loaded.notes.iter().map(ToString::to_string).collect::<Vec<_>>(),
        ["2 points that are marked as invalid left out"]
    );
    let points = points(&loaded);
    let expected = [
        DVec3::new(499_999.875, 4_600_000.0, 300.0),
        DVec3::new(499_999.875, 4_600_002.0, 300.0),
        DVec3::new(0.0, 2.0, 0.0),
    ];
    assert_eq!(points.positions.len(), 3);
    for (position, expected) in points.positions.iter().zip(expected) {
        assert!(position.distance(expected) < 1e-8, "{position}");
    }
    let color = points.colors.get(0).unwrap();
    assert!(color.iter().zip([1.0, 0.0, linear_from_srgb(0.2), 1.0]).all(|(a, b)| (a - b).abs() < 1e-6));
    assert_eq!(points.colors.get(2), Some([1.0; 4]));
    let places = [DVec3::new(500_000.0, 4_600_000.0, 300.0), DVec3::ZERO];
    let [first, second] = [(2, places[0]), (3, places[1])].map(|(end, place)| Viewpoint { end, place });
    assert_eq!(
        points.viewpoints,
        [first, second],
        "the second scan is the one that the first was put beside"
    );
}

#[test]
fn the_scanner_stood_at_the_origin_of_its_scans() {
    let first = Viewpoint { end: 2, place: DVec3::new(500_000.0, 4_600_000.0, 300.0) };
    let other = Transform { translation: Translation { x: 1.0, y: 2.0, z: 3.0 }, ..pose() };
    let second = Viewpoint { end: 3, place: DVec3::new(1.0, 2.0, 3.0) };
    for (bytes, places) in [(file(1, None), vec![first]), (file(2, Some(other)), vec![first, second])] {
        assert_eq!(points(&of_bytes("a.e57", &bytes, parse).unwrap()).viewpoints, places);
    }
}

/// A scan of one point, with the pose and one field more.
fn scan(pose: Option<Transform>, field: Record) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let mut writer = E57Writer::new(&mut bytes, "file").unwrap();
    let places = [Record::CARTESIAN_X_F64, Record::CARTESIAN_Y_F64, Record::CARTESIAN_Z_F64];
    let mut scan = writer.add_pointcloud("one", [&places[..], &[field]].concat()).unwrap();
    scan.set_transform(pose);
    scan.add_point([1.0, 2.0, 3.0].map(double).into_iter().chain([RecordValue::Integer(0)]).collect())
        .unwrap();
    scan.finalize().unwrap();
    writer.finalize().unwrap();
    drop(writer);
    bytes.into_inner()
}

/// Programs that write any cloud give it one.
#[test]
fn a_pose_that_moves_nothing_tells_a_scanner_only_of_a_scan_in_rows() {
    let nothing = Some(Transform::default());
    let row = || of(RecordName::RowIndex, RecordDataType::Integer { min: 0, max: 255 });
    for (pose, field, is_told) in [
        (nothing.clone(), Record::INTENSITY_U16, false),
        (nothing, row(), true),
        (Some(pose()), Record::INTENSITY_U16, true),
        (None, row(), false),
    ] {
        let told = of_bytes("a.e57", &scan(pose.clone(), field.clone()), parse).unwrap();
        assert_eq!(!points(&told).viewpoints.is_empty(), is_told, "{pose:?} {field:?}");
    }
}

/// Pages of 1024 bytes end with a checksum (CRC-32C), which this makes right again.
fn repaired(mut bytes: Vec<u8>) -> Vec<u8> {
    for page in bytes.chunks_exact_mut(1024) {
        let (data, checksum) = page.split_at_mut(1020);
        let crc = data.iter().fold(u32::MAX, |crc, byte| {
            (0..8)
                .fold(crc ^ u32::from(*byte), |crc, _| (crc >> 1) ^ (0x82f6_3b78 & (crc & 1).wrapping_neg()))
        });
        checksum.copy_from_slice(&(!crc).to_be_bytes());
    }
    bytes
}

fn replaced(bytes: &[u8], from: &str, to: &str) -> Vec<u8> {
    let at = bytes.windows(from.len()).position(|window| window == from.as_bytes()).expect(from);
    assert_eq!(from.len(), to.len());
    let mut bytes = bytes.to_vec();
    bytes[at..at + to.len()].copy_from_slice(to.as_bytes());
    repaired(bytes)
}

#[track_caller]
fn refuses(bytes: &[u8], expected: &str) {
    let error = of_bytes("a.e57", bytes, parse).unwrap_err();
    assert!(error.to_string().starts_with(&format!("a.e57: {expected}")), "{error}");
}

#[test]
fn counts_beyond_the_file_are_refused_before_memory_is_taken() {
    let whole = file(1, None);
    assert_eq!(repaired(whole.clone()), whole);
    refuses(&replaced(&whole, r#"recordCount="4""#, r#"recordCount="9""#), "scan 0: ");
    let mut long = whole.clone();
    long[32..40].fill(0xff);
    refuses(&repaired(long), "header: XML of 18446744073709551615 bytes; expected at most ");
    refuses(&whole[..30], "header: the file ends within it; expected 48 bytes");
    // Its cause is told once.
    let odd = [&whole[..], &[0; 100]].concat();
    let cause = format!("file size {} is not a multiple of the page size 1024", odd.len());
    let said = of_bytes("a.e57", &odd, parse).unwrap_err().to_string();
    assert!(said.starts_with("a.e57: Failed to read E57: ") && said.matches(&cause).count() == 1, "{said}");
    let mut wrong = whole.clone();
    wrong[60] ^= 1;
    refuses(&wrong, "");
    let cloud = |records, prototype| {
        let mut cloud = PointCloud::default();
        (cloud.records, cloud.prototype) = (records, prototype);
        cloud
    };
    let try_sizes = |clouds: &[PointCloud]| {
        of_bytes("a.e57", &[0; 100], |input| {
            check::sizes(input, clouds).map(|()| Loaded::new(Model::Points(Points::default()), ""))
        })
        .map_err(|e| e.to_string())
    };
    let no_bits = of(RecordName::CartesianX, RecordDataType::Integer { min: 5, max: 5 });
    let refused = try_sizes(&[cloud(u64::MAX, vec![no_bits])]).unwrap_err();
    assert_eq!(refused, "a.e57: scan 0: points that take no bytes; expected coordinates");
    let doubles = || vec![Record::CARTESIAN_X_F64];
    assert!(try_sizes(&[cloud(6, doubles()), cloud(6, doubles())]).is_ok());
    let refused = try_sizes(&[cloud(7, doubles()), cloud(6, doubles())]).unwrap_err();
    assert_eq!(refused, "a.e57: 13 points of 104 bytes together, but the file has 100");
    assert!(try_sizes(&[cloud(u64::MAX, doubles()), cloud(1, doubles())]).is_err());
}

#[test]
fn hostile_bytes_are_refused_or_read() {
    let files = [file(1, None), file(2, Some(pose()))];
    // Each case reads a whole tree of XML, and the checksums would hide what is behind them.
    attack(&files, 20_000, parse);
    attack(&files, 20_000, |input| {
        let bytes = repaired(input.bytes.to_vec());
        parse(&Input { bytes: &bytes, ..*input })
    });
}
