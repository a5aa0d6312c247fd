use glam::{Vec2, Vec3};

use super::{Value::*, faults::message, *};
use crate::scene::{Clip, ClipCurve, Defect, Shapes};

const HEADER: &str = "ply\nformat ENCODING 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
    property float nz\nproperty float su_x\nproperty float su_y\nproperty float su_z\nproperty float sv_x\n\
    property float sv_y\nproperty float sv_z\nproperty float clip_a1\nproperty float clip_a3\nproperty float clip_u\n\
    property float clip_v\nproperty double clip_w\nproperty float clip2_a1\nproperty float clip2_a3\n\
    property float clip2_u\nproperty float clip2_v\nproperty float clip2_w\nproperty uchar clip_mode\nend_header\n";

const ONE: [f32; 5] = [0.5, 2.0, 0.25, 0.75, 0.5];
const TWO: [f32; 5] = [-1.0, 3.0, -0.25, 0.5, 2.0];
const NONE: [f32; 5] = [f32::NAN; 5];

fn curve([start_rad, end_rad, u, v, weight]: [f32; 5]) -> ClipCurve {
    ClipCurve { start_rad, end_rad, middle: Vec2::new(u, v), weight }
}

fn vertex(first: [f32; 5], second: [f32; 5], mode: u8) -> Vec<Value> {
    let mut values: Vec<_> =
        [0.0, 0.0, 0.0, -1.0, 2.0, 0.0, 0.0, 0.0, 1.0, 0.0].into_iter().map(Float).collect();
    values.extend(first[..4].iter().copied().map(Float));
    values.push(Double(first[4].into()));
    values.extend(second.map(Float));
    values.push(UChar(mode));
    values
}

/// The clip of the one splat, and its defect.
fn clip(file: &[u8]) -> (Clip, Option<Defect>) {
    let splats = splats(file);
    (splats.clips.get(0), splats.defect(0))
}

#[test]
fn a_vertex_has_no_curve_one_or_two_in_every_encoding() {
    let cases = [
        (NONE, NONE, 0, Clip::None),
        (NONE, NONE, 1, Clip::None),
        (ONE, NONE, 0, Clip::One(curve(ONE))),
        (ONE, NONE, 1, Clip::One(curve(ONE))),
        (NONE, TWO, 1, Clip::One(curve(TWO))),
        (ONE, TWO, 0, Clip::Either(curve(ONE), curve(TWO))),
        (ONE, TWO, 1, Clip::Both(curve(ONE), curve(TWO))),
    ];
    for (first, second, mode, expected) in cases {
        for file in encodings(HEADER, &[vertex(first, second, mode)]) {
            assert_eq!(clip(&file), (expected, None));
        }
    }
    // Without the mode and the second curve.
    let [header, _] = HEADER.split("property float clip2_a1").collect::<Vec<_>>().try_into().unwrap();
    let mut short = vertex(ONE, NONE, 0);
    short.truncate(15);
    for file in encodings(&format!("{header}end_header\n"), &[short]) {
        assert_eq!(clip(&file), (Clip::One(curve(ONE)), None));
    }
}

#[test]
fn a_normal_that_turns_the_splat_around_turns_its_curve() {
    let header =
        HEADER.replace("property float nz", "property float nx\nproperty float ny\nproperty float nz");
    let mut values = vertex(ONE, TWO, 1);
    values.splice(3..3, [Float(0.0), Float(0.0)]);
    for file in encodings(&header, &[values]) {
        let splats = splats(&file);
        assert!(matches!(&splats.shapes, Shapes::Ellipses { t, .. } if t[0] == -Vec3::Y));
        let turned = |[start, end, u, v, weight]: [f32; 5]| curve([-end, -start, u, -v, weight]);
        assert_eq!(splats.clips.get(0), Clip::Both(turned(ONE), turned(TWO)));
    }
}

#[test]
fn curves_that_are_broken_are_defects_and_neighbors_are_not() {
    let with = |at: usize, value: f32| {
        let mut values = ONE;
        values[at] = value;
        clip(&encodings(HEADER, &[vertex(values, NONE, 0)])[1])
    };
    for at in 0..5 {
        assert_eq!(with(at, f32::NAN).1, Some(Defect::Clip), "{at}");
        assert_eq!(with(at, f32::INFINITY).1, Some(Defect::Clip), "{at}");
        assert_eq!(with(at, 1e4).1, None, "{at}");
        assert_eq!(with(at, -1.0).1.is_some(), at == 4, "{at}");
    }
    assert_eq!(with(4, 0.0).1, None);
}

#[test]
fn modes_of_no_meaning_are_refused_and_what_is_not_whole_is_told() {
    for mode in [2, 255] {
        let header = HEADER.replace("vertex 1", "vertex 2");
        for file in encodings(&header, &[vertex(ONE, TWO, 0), vertex(ONE, TWO, mode)]) {
            assert_eq!(message(&file), format!("a.ply: vertex 1: 'clip_mode' is {mode}; expected 0 or 1"));
        }
    }
    let [file, ..] = encodings(&HEADER.replace("clip2_w", "other"), &[vertex(ONE, TWO, 1)]);
    assert_eq!(clip(&file), (Clip::One(curve(ONE)), None));
    assert!(notes(&file).contains(&"1 value of 'clip2_a1' without 'clip2_w' ignored".to_owned()));
    let [file, ..] = encodings(&HEADER.replace("sv_z", "radius"), &[vertex(ONE, TWO, 1)]);
    assert!(notes(&file).iter().any(|note| note.contains("clip curve without tangent vectors")));
}
