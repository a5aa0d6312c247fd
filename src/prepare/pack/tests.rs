//! What is packed, word by word.

use glam::Vec3;

use super::*;

fn vector(words: [u32; 4]) -> Vec3 {
    Vec3::from_slice(&words.map(f32::from_bits)[..3])
}

#[test]
fn tangents_that_a_device_would_flush_to_zero_keep_their_direction() {
    let splats = Splats::new(
        vec![DVec3::ZERO; 2],
        Shapes::Ellipses {
            s: vec![Vec3::X, Vec3::new(3e-39, 4e-39, 0.0)],
            t: vec![Vec3::Y * 1e-44, Vec3::Z * 1e-38],
        },
        Colors::Uniform([1.0; 4]),
    );
    let rebase = Rebase { origin: DVec3::ZERO, scale: 1e-3 };
    let packed = pack(&splats, 0..2, &survey(&splats, 0..2, rebase), Beside::default());
    let unit = SHORTEST_TANGENT as f32;
    let expected = [[1e-3, 0.0, 0.0], [0.0, unit, 0.0], [0.6 * unit, 0.8 * unit, 0.0], [0.0, 0.0, unit]];
    for (i, expected) in [1, 2, 4, 5].into_iter().zip(expected) {
        let got = vector(packed.shapes[i]);
        let expected = Vec3::from(expected);
        assert!((got - expected).length() <= 1e-6 * expected.length(), "{got}, expected {expected}");
    }
}

#[test]
fn what_is_beyond_f32_from_the_others_is_left_out_and_counted() {
    let mut positions = vec![DVec3::ZERO; 9];
    positions.push(DVec3::splat(1e60));
    let shapes = Shapes::Disks { normals: vec![Vec3::Z; 10], radii: vec![1.0; 10] };
    let splats = Splats::new(positions, shapes, Colors::Uniform([0.5; 4]));
    let rebase = Rebase::of(&splats, 0..10);
    let survey = survey(&splats, 0..10, rebase);
    assert_eq!((survey.count, survey.defects.of(Defect::Position)), (9, 1));
    assert!(survey.bounds.iter().all(|corner| corner.as_vec3().is_finite()));
    assert_eq!(pack(&splats, 0..10, &survey, Beside::default()).shapes.len(), 2 * 9);
}

#[test]
fn defective_splats_leave_no_trace_and_normals_of_any_length_become_unit() {
    let lengths = [1.0_f32, 1e-38, 1e38, 0.0, 3.0];
    let splats = Splats::new(
        vec![DVec3::ZERO; 5],
        Shapes::Disks {
            normals: lengths.iter().map(|l| Vec3::new(0.0, 0.6, 0.8) * *l).collect(),
            radii: vec![1.0, 2.0, 3.0, 9.0, f32::NAN],
        },
        Colors::Uniform([0.0, 0.5, 1.0, 1.0]),
    );
    let rebase = Rebase { origin: DVec3::ZERO, scale: 0.5 };
    let survey = survey(&splats, 0..5, rebase);
    let packed = pack(&splats, 0..5, &survey, Beside::default());
    assert_eq!((survey.count, survey.defects.total(), survey.largest_radius), (3, 2, 1.5));
    assert_eq!((packed.count, packed.shapes.len()), (3, 2 * 3));
    assert_eq!(bytemuck::cast_slice::<_, u16>(&packed.colors), [0, 32768, 65535, 65535]);
    for (i, radius) in [0.5, 1.0, 1.5].into_iter().enumerate() {
        assert_eq!(packed.shapes[2 * i].map(f32::from_bits), [0.0, 0.0, 0.0, radius]);
        let normal = vector(packed.shapes[2 * i + 1]);
        assert!((normal.length() - 1.0).abs() < 1e-6, "{i}: {normal}");
    }
}
