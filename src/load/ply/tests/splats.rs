use glam::{DVec3, Vec3};

use super::{Value::*, *};
use crate::{
    math::srgb::linear_from_srgb,
    scene::{Colors, Defect, Shapes},
};

const DISKS: &str = "ply\nformat ENCODING 1.0\ncomment made by hand\nobj_info none\nelement vertex 2\n\
    property double x\nproperty double y\nproperty double z\nproperty float nx\nproperty float ny\n\
    property float nz\nproperty float radius\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n\
    property uchar alpha\nend_header\n";

fn disk(x: f64, normal: [f32; 3], radius: f32, rgba: [u8; 4]) -> Vec<Value> {
    let mut values = vec![Double(x), Double(-0.25), Double(1e-300)];
    values.extend(normal.map(Float));
    values.push(Float(radius));
    values.extend(rgba.map(UChar));
    values
}

#[test]
fn disks_are_the_same_in_all_encodings_and_positions_stay_f64() {
    let (utm, normal) = (4_600_000.000_123_456, [0.1, -0.2, 0.3]);
    let vertices = [disk(utm, normal, 0.5, [0, 128, 255, 51]), disk(2.0, [0.0, 0.0, 1.0], 0.1, [10; 4])];
    for file in encodings(DISKS, &vertices) {
        let splats = splats(&file);
        assert_eq!(splats.positions, [DVec3::new(utm, -0.25, 1e-300), DVec3::new(2.0, -0.25, 1e-300)]);
        let Shapes::Disks { normals, radii } = &splats.shapes else { panic!("disks") };
        assert_eq!(
            (normals.as_slice(), radii.as_slice()),
            (&[Vec3::from(normal), Vec3::Z][..], &[0.5, 0.1][..])
        );
        let green = linear_from_srgb(128.0 / 255.0);
        let ten = linear_from_srgb(10.0 / 255.0);
        assert_eq!(
            (splats.color(0), splats.color(1)),
            ([0.0, green, 1.0, 0.2], [ten, ten, ten, 10.0 / 255.0])
        );
    }
}

#[test]
fn tangent_vectors_win_over_radius_and_the_normal_gives_the_side() {
    let header = "ply\nformat ENCODING 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n\
        property float nx\nproperty float ny\nproperty float nz\nproperty float radius\nproperty float su_x\n\
        property float su_y\nproperty float su_z\nproperty float sv_x\nproperty float sv_y\nproperty float sv_z\n\
        end_header\n";
    let vertex = |nz: f32| {
        [0.0, 0.0, 0.0, 0.0, 0.0, nz, 9.0, 2.0, 0.0, 0.0, 0.5, 1.0, 0.0].into_iter().map(Float).collect()
    };
    for file in encodings(header, &[vertex(1.0), vertex(-1.0)]) {
        let splats = splats(&file);
        let Shapes::Ellipses { s, t } = &splats.shapes else { panic!("ellipses") };
        assert_eq!(s[..], [Vec3::new(2.0, 0.0, 0.0); 2]);
        assert_eq!(t[..], [Vec3::new(0.5, 1.0, 0.0), Vec3::new(-0.5, -1.0, 0.0)]);
        assert!(s[1].cross(t[1]).z < 0.0);
        let gray = linear_from_srgb(0.8);
        assert!(matches!(splats.colors, Colors::Uniform(c) if c == [gray, gray, gray, 1.0]));
    }
}

#[test]
fn every_number_type_is_read() {
    let header = "ply\nformat ENCODING 1.0\nelement vertex 1\nproperty char x\nproperty int16 y\nproperty uint z\n\
        property short nx\nproperty int32 ny\nproperty uint8 nz\nproperty ushort radius\nproperty ushort red\n\
        property float green\nproperty double blue\nproperty list uchar float extra\nproperty float64 unknown\n\
        end_header\n";
    let vertex = vec![
        Char(-7),
        Short(-300),
        UInt(4_000_000_000),
        Short(-1),
        Int(2),
        UChar(3),
        UShort(40_000),
        UShort(65_535),
        Float(0.5),
        Double(0.25),
        UChar(2),
        Float(1.0),
        Float(2.0),
        Double(3.0),
    ];
    for file in encodings(header, &[vertex]) {
        let splats = splats(&file);
        assert_eq!(splats.positions, [DVec3::new(-7.0, -300.0, 4e9)]);
        let Shapes::Disks { normals, radii } = &splats.shapes else { panic!("disks") };
        assert_eq!((normals[0], radii[0]), (Vec3::new(-1.0, 2.0, 3.0), 40_000.0));
        assert_eq!(splats.color(0), [1.0, linear_from_srgb(0.5), linear_from_srgb(0.25), 1.0]);
    }
}

#[test]
fn alpha_alone_goes_with_the_default_color_and_floats_are_clamped() {
    let header = "ply\nformat ENCODING 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
        property float nx\nproperty float ny\nproperty float nz\nproperty float radius\nproperty float alpha\n\
        end_header\n";
    for file in
        encodings(header, &[[0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.5].into_iter().map(Float).collect()])
    {
        let gray = linear_from_srgb(0.8);
        assert_eq!(splats(&file).color(0), [gray, gray, gray, 1.0]);
    }
}

#[test]
fn values_that_are_not_finite_are_read_and_found_defective_in_every_encoding() {
    let vertices =
        [disk(f64::NAN, [0.0, 0.0, 1.0], 1.0, [0; 4]), disk(0.0, [f32::NEG_INFINITY, 0.0, 1.0], 1.0, [0; 4])];
    for file in encodings(DISKS, &vertices) {
        let mut splats = splats(&file);
        assert_eq!((splats.defect(0), splats.defect(1)), (Some(Defect::Position), Some(Defect::Normal)));
        assert_eq!(splats.drop_defective().total(), 2);
    }
}

#[test]
fn numbers_as_c_programs_write_them_blank_lines_and_a_crlf_header() {
    let header = DISKS.replace("ENCODING", "ascii").replace('\n', "\r\n");
    let body = "\n+1. .5 -nan 0 0 1 1e-2 1 2 3 4\r\n\n  inf\t0 0 0 0 1 1 1 2 3 4";
    let splats = splats(&[header.as_bytes(), body.as_bytes()].concat());
    assert_eq!((splats.positions[0].x, splats.positions[0].y), (1.0, 0.5));
    assert!(splats.positions[0].z.is_nan() && splats.positions[1].x == f64::INFINITY);
    // A binary body may start with the byte of a line end.
    let vertices = [disk(1.0, [0.0, 0.0, 1.0], 1.0, [0; 4]), disk(2.0, [0.0, 0.0, 1.0], 1.0, [0; 4])];
    let x = f64::from_le_bytes([0x0A, 0x0D, 0x0A, 0, 0, 0, 0xF0, 0x3F]);
    let mut file = encodings(&DISKS.replace('\n', "\r\n"), &vertices)[1].clone();
    let body = file.len() - 2 * (24 + 16 + 4);
    file[body..body + 8].copy_from_slice(&x.to_le_bytes());
    assert_eq!(super::splats(&file).positions[0].x, x);
}

#[test]
fn dark_colors_of_our_own_files_are_no_bytes() {
    let header = "ply\nformat ENCODING 1.0\ncomment splats: disks with radius, or tangent vectors\nelement vertex 1\n\
        property float x\nproperty float y\nproperty float z\nproperty ushort red\nproperty float green\n\
        property float blue\nproperty ushort alpha\nend_header\n";
    let vertex = vec![Float(0.0), Float(0.0), Float(0.0), UShort(255), Float(1.0), Float(3.0), UShort(51)];
    for file in encodings(header, &[vertex]) {
        let [red, green, blue, alpha] = each_color(&points(&file).colors)[0];
        assert_eq!(
            [red, green, blue, alpha],
            [linear_from_srgb(255.0 / 65_535.0), 1.0, 1.0, 51.0 / 65_535.0]
        );
    }
}
