use std::f64::consts::FRAC_1_SQRT_2;

use glam::Vec3;

use super::{Value::*, *};
use crate::{
    math::srgb::linear_from_srgb,
    scene::{Defect, Shapes},
};

const NAMES_3D: [&str; 15] = [
    "x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2", "f_rest_0", "opacity", "scale_0", "scale_1", "scale_2",
    "rot_0", "rot_1", "rot_2", "rot_3",
];

/// Axes of 1, 3 and 2 standard deviations, turned by 90° about z.
const GAUSSIAN: [f64; 15] = [
    5.0,
    6.0,
    7.0,
    0.0,
    10.0,
    -0.5,
    9.0,
    3.0,
    0.0,
    1.098_612_288_668_109_8,
    std::f64::consts::LN_2,
    7.0,
    0.0,
    0.0,
    7.0,
];

fn files(names: &[&str], gaussians: &[&[f64]]) -> [Vec<u8>; 3] {
    let properties: String = names.iter().map(|name| format!("property float {name}\n")).collect();
    let count = gaussians.len();
    let header = format!("ply\nformat ENCODING 1.0\nelement vertex {count}\n{properties}end_header\n");
    let rows: Vec<Vec<Value>> =
        gaussians.iter().map(|values| values.iter().map(|&v| Float(v as f32)).collect()).collect();
    encodings(&header, &rows)
}

pub(super) fn gaussian_files() -> [Vec<u8>; 3] {
    files(&NAMES_3D, &[&GAUSSIAN])
}

fn with(changes: &[(&str, f64)]) -> [f64; 15] {
    let mut values = GAUSSIAN;
    for (name, value) in changes {
        values[NAMES_3D.iter().position(|known| known == name).unwrap()] = *value;
    }
    values
}

fn axes(splats: &Splats) -> Vec<[Vec3; 2]> {
    let Shapes::Ellipses { s, t } = &splats.shapes else { panic!("ellipses") };
    s.iter().copied().zip(t.iter().copied()).map(|(s, t)| [s, t]).collect()
}

#[track_caller]
fn near(found: [Vec3; 2], expected: [Vec3; 2]) {
    assert!(found.iter().zip(expected).all(|(f, e)| f.distance(e) < 1e-5), "{found:?}");
}

#[test]
fn the_shortest_axis_is_the_normal_and_disks_have_two_standard_deviations() {
    // x becomes y and y becomes −x. Each axis in turn is the shortest.
    let ([x, y, z], ln) = ([Vec3::Y, Vec3::NEG_X, Vec3::Z], f64::ln);
    let second = with(&[("scale_0", ln(4.0)), ("scale_1", ln(0.5))]);
    let third = with(&[("scale_0", ln(4.0)), ("scale_2", ln(0.25))]);
    for file in files(&NAMES_3D, &[&GAUSSIAN, &second, &third]) {
        let loaded = load(&file).unwrap();
        assert!(loaded.format.ends_with(", 3D Gaussians"), "{}", loaded.format);
        let Model::Splats { splats, closed: false } = loaded.model else { panic!("splats") };
        let axes = axes(&splats);
        near(axes[0], [6.0 * y, 4.0 * z]);
        near(axes[1], [4.0 * z, 8.0 * x]);
        near(axes[2], [8.0 * x, 6.0 * y]);
        assert_eq!(splats.positions[0].to_array(), [5.0, 6.0, 7.0]);
    }
}

#[test]
fn flat_ones_have_the_rotations_third_axis_as_normal_and_a_normal_gives_the_side() {
    let names: Vec<&str> =
        NAMES_3D.iter().copied().filter(|name| *name != "scale_2").chain(["nx", "ny", "nz"]).collect();
    let mut values: Vec<f64> = with(&[]).to_vec();
    values.remove(10);
    let row = |nz: f64| [values.as_slice(), &[0.0, 0.0, nz]].concat();
    for file in files(&names, &[&row(0.0), &row(-1.0)]) {
        let loaded = load(&file).unwrap();
        assert!(loaded.format.ends_with(", 2D Gaussians"), "{}", loaded.format);
        let Model::Splats { splats, .. } = loaded.model else { panic!("splats") };
        near(axes(&splats)[0], [2.0 * Vec3::Y, 6.0 * Vec3::NEG_X]);
        near(axes(&splats)[1], [2.0 * Vec3::Y, 6.0 * Vec3::X]);
    }
}

#[test]
fn the_mean_color_is_srgb_and_what_is_clamped_or_left_out_is_noted() {
    let faint = with(&[("opacity", -0.01)]);
    let unknown = with(&[("opacity", f64::NAN)]);
    let half = with(&[("opacity", 0.0), ("f_dc_1", 1.0)]);
    for file in files(&NAMES_3D, &[&GAUSSIAN, &faint, &unknown, &half]) {
        let splats = splats(&file);
        // 1 / (2√π)
        let factor = 0.282_094_8_f32;
        let [r, g, b, alpha] = splats.color(0);
        assert!((r - linear_from_srgb(0.5)).abs() < 1e-6 && g == 1.0 && alpha == 1.0);
        assert!((b - linear_from_srgb(0.5 - 0.5 * factor)).abs() < 1e-6);
        assert!((splats.color(1)[1] - linear_from_srgb(0.5 + factor)).abs() < 1e-6);
        assert_eq!(
            notes(&file),
            [
                "2 Gaussians with an opacity below one half left out",
                "2 Gaussians (by opaque disks of two standard deviations) replaced",
                "3 colors beyond 0 to 1 clamped",
                "4 Gaussians' view-dependent colors, but for their means, ignored",
            ]
        );
    }
}

#[test]
fn a_rotation_that_is_none_or_a_scale_beyond_all_measure_is_a_defect() {
    let none = with(&[("rot_0", 0.0), ("rot_3", 0.0)]);
    let nan = with(&[("rot_1", f64::NAN)]);
    let huge = with(&[("scale_1", 1000.0)]);
    let tiny = with(&[("scale_1", -1000.0), ("scale_2", -1000.0)]);
    let turned = with(&[("rot_0", FRAC_1_SQRT_2), ("rot_3", FRAC_1_SQRT_2)]);
    for file in files(&NAMES_3D, &[&none, &nan, &huge, &tiny, &turned]) {
        let splats = splats(&file);
        let defects: Vec<Option<Defect>> = (0..5).map(|i| splats.defect(i)).collect();
        let tangents = Some(Defect::Tangents);
        assert_eq!(defects, [tangents, tangents, tangents, tangents, None]);
    }
}

#[test]
fn gaussians_may_have_colors_as_points_have_them_and_lack_an_opacity() {
    let header = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
        property float scale_0\nproperty float scale_1\nproperty float rot_0\nproperty float rot_1\n\
        property float rot_2\nproperty float rot_3\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n\
        end_header\n0 0 0 0 0 1 0 0 0 255 0 51\n";
    let splats = splats(header.as_bytes());
    assert_eq!(splats.color(0), [1.0, 0.0, linear_from_srgb(0.2), 1.0]);
}
