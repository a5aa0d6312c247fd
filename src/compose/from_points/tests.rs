//! Scans, from their file to splats.

use std::{f64::consts::FRAC_1_SQRT_2, io::Cursor, path::Path};

use e57::{E57Writer, Quaternion, Record, RecordValue, Transform, Translation};
use glam::DVec3;

use crate::{
    geometry::{CloudReport, Sides, splats_from_points},
    load::{LoadOptions, Model, load_bytes},
    scene::{Shapes, Splats},
};

/// Scans of a square of a wall, 5 m before the scanner.
fn walls(poses: &[Option<Transform>]) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let mut writer = E57Writer::new(&mut bytes, "file").unwrap();
    for pose in poses {
        let prototype = vec![Record::CARTESIAN_X_F64, Record::CARTESIAN_Y_F64, Record::CARTESIAN_Z_F64];
        let mut scan = writer.add_pointcloud("wall", prototype).unwrap();
        scan.set_transform(pose.clone());
        for i in 0..400 {
            let [y, z] = [i % 20, i / 20].map(|at| 0.05 * f64::from(at));
            scan.add_point([5.0, y, z].map(RecordValue::Double).into()).unwrap();
        }
        scan.finalize().unwrap();
    }
    writer.finalize().unwrap();
    drop(writer);
    bytes.into_inner()
}

fn splats(poses: &[Option<Transform>]) -> (Splats, CloudReport) {
    let loaded = load_bytes(Path::new("a.e57"), walls(poses), &LoadOptions::default(), &()).unwrap();
    match loaded.model {
        Model::Points(points) => splats_from_points(points, &()),
        _ => panic!("no points"),
    }
}

#[test]
fn each_scan_lies_in_its_pose_and_faces_its_scanner() {
    let pose = |[w, z]: [f64; 2], [x, y]: [f64; 2]| Transform {
        rotation: Quaternion { w, x: 0.0, y: 0.0, z },
        translation: Translation { x, y, z: 0.0 },
    };
    // One wall in x = 5, seen from the origin, from behind after half a turn, and one to its left after a quarter of a turn.
    let poses = [None, Some(pose([0.0, 1.0], [10.0, 3.0])), Some(pose([FRAC_1_SQRT_2; 2], [0.0, 0.0]))];
    let (splats, report) = splats(&poses);
    assert_eq!(report.sides, Sides::TowardScanner);
    let Shapes::Disks { normals, .. } = &splats.shapes else { panic!("no disks") };
    let expected = [
        (DVec3::new(5.0, 0.5, 0.5), DVec3::NEG_X),
        (DVec3::new(5.0, 2.5, 0.5), DVec3::X),
        (DVec3::new(-0.5, 5.0, 0.5), DVec3::NEG_Y),
    ];
    for (scan, (middle, normal)) in expected.into_iter().enumerate() {
        let of_scan = splats.positions.iter().zip(normals).skip(400 * scan).take(400);
        for (place, its_normal) in of_scan {
            assert!(place.distance(middle) < 0.8, "scan {scan}: {place}");
            assert!(its_normal.as_dvec3().distance(normal) < 1e-3, "scan {scan}: {its_normal}");
        }
    }
    assert_eq!(self::splats(&[None, None]).1.sides, Sides::One, "no scan tells where its scanner stood");
}
