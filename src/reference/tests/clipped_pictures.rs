//! A clipped splat is the splat without what the curve removes, whatever draws it and whatever filters it.

use glam::{DMat3, DVec2, DVec3, Vec2, Vec3};

use super::{camera, settings};
use crate::{
    reference::{Picture, ground_truth, removes, render},
    scene::{
        Clip, ClipCurve, ClipTest, Clips, Colors, Edges, Filter, Object, Rasterizer, Scene, Settings, Shapes,
        Splats,
    },
};

const SIDE: u32 = 96;

const CENTER: DVec3 = DVec3::new(0.2, -0.1, 2.0);
const S: Vec3 = Vec3::new(1.0, 0.2, 0.5);
const T: Vec3 = Vec3::new(-0.1, 0.7, -0.3);

fn clips() -> [Clip; 4] {
    let arc = ClipCurve { start_rad: 0.4, end_rad: 2.2, middle: Vec2::new(0.1, 0.1), weight: 0.6 };
    let corner = ClipCurve { start_rad: -2.5, end_rad: 0.9, middle: Vec2::new(0.0, -0.2), weight: 2.0 };
    [Clip::One(arc), Clip::One(ClipCurve::line(3.0, 5.0)), Clip::Either(arc, corner), Clip::Both(arc, corner)]
}

fn scene(clip: Clip, alpha: f32) -> Scene {
    let shapes = Shapes::Ellipses { s: vec![S], t: vec![T] };
    let splats = Splats {
        clips: Clips::of(vec![clip]),
        ..Splats::new(vec![CENTER], shapes, Colors::Uniform([0.5, 0.25, 0.75, alpha]))
    };
    Scene { objects: vec![Object { name: String::new(), splats, closed: false }], ..Scene::default() }
}

/// (u, v) where the ray of a pixel meets the splat.
fn place(pixel: usize) -> DVec2 {
    let half = f64::from(SIDE) / 2.0;
    let [x, y] = [pixel as u32 % SIDE, pixel as u32 / SIDE].map(|at| (f64::from(at) + 0.5 - half) / half);
    let solved = DMat3::from_cols(S.as_dvec3(), T.as_dvec3(), -DVec3::new(x, y, 1.0)).inverse() * -CENTER;
    solved.truncate()
}

fn drawn(clip: Clip, alpha: f32, settings: &Settings) -> Picture {
    render(&scene(clip, alpha), &camera(), settings, &|_, _| {}).unwrap()
}

#[test]
fn what_is_removed_is_not_drawn_by_any_method() {
    let plain = settings(SIDE);
    let mut methods = vec![
        Settings { edges: Edges::Coverage, ..plain.clone() },
        Settings { rasterizer: Rasterizer::AffineContour, ..plain.clone() },
        Settings { rasterizer: Rasterizer::RaycastApproximate, ..plain.clone() },
    ];
    let filters = [Filter::None, Filter::Adjust, Filter::Max, Filter::Ewa];
    methods.extend(filters.map(|filter| Settings { filter, ..plain.clone() }));
    for method in &methods {
        for (clip, alpha) in clips().into_iter().flat_map(|clip| [(clip, 1.0), (clip, 0.5)]) {
            let (whole, clipped) = (drawn(Clip::None, alpha, method), drawn(clip, alpha, method));
            let (mut counts, nothing) = ([0; 2], whole.pixels[0].color);
            for (i, (whole, clipped)) in whole.pixels.iter().zip(&clipped.pixels).enumerate() {
                let removed = removes(&clip, place(i), ClipTest::Conic);
                let expected = if removed { nothing } else { whole.color };
                assert_eq!(clipped.color, expected, "{method:?} {clip:?} pixel {i}");
                counts[usize::from(removed)] += u32::from(whole.color != nothing);
            }
            assert!(counts.iter().all(|count| *count > 20), "{counts:?}");
        }
    }
}

/// Where rounding decides, the picture says so: also along the curve, and not along the rim that is cut off.
#[test]
fn the_curve_is_a_rim_and_what_it_removes_has_none() {
    for clip in clips() {
        let (whole, clipped) = (drawn(Clip::None, 1.0, &settings(SIDE)), drawn(clip, 1.0, &settings(SIDE)));
        let mut gone = 0;
        for (i, (whole, clipped)) in whole.pixels.iter().zip(&clipped.pixels).enumerate() {
            let near = |distance: f64| {
                let around = [DVec2::X, DVec2::Y, -DVec2::X, -DVec2::Y].map(|way| place(i) + distance * way);
                let removed = around.map(|at| removes(&clip, at, ClipTest::Conic));
                removed.iter().any(|at| *at != removed[0])
            };
            if near(5e-4) && place(i).length() < 0.99 {
                assert!(clipped.rim, "pixel {i}");
            }
            if !near(5e-3) {
                let removed = removes(&clip, place(i), ClipTest::Conic);
                assert_eq!(clipped.rim, whole.rim && !removed, "pixel {i}");
                gone += u32::from(whole.rim && removed);
            }
        }
        println!("{gone} pixels of the rim removed");
    }
}

/// What filters aim at is half covered along the curve.
#[test]
fn the_true_picture_is_low_passed_along_the_curve() {
    let clip = Clip::One(ClipCurve::line(0.0, std::f32::consts::PI));
    let whole = ground_truth(&scene(Clip::None, 1.0), &camera(), &settings(SIDE), 8, &|_, _| {}).unwrap();
    let clipped = ground_truth(&scene(clip, 1.0), &camera(), &settings(SIDE), 8, &|_, _| {}).unwrap();
    let mut on_the_line = 0;
    for (i, (whole, clipped)) in whole.pixels.iter().zip(&clipped.pixels).enumerate() {
        let at = place(i);
        if at.length() < 0.8 {
            let share = clipped.coverage / whole.coverage;
            match at.y {
                y if y.abs() < 1e-3 => {
                    assert!((share - 0.5).abs() < 0.1, "{share}");
                    on_the_line += 1;
                }
                y if y > 0.2 => assert!(share < 0.01, "{share}"),
                y if y < -0.2 => assert!(share > 0.99, "{share}"),
                _ => assert!((0.0..=1.0 + 1e-12).contains(&share)),
            }
        }
    }
    assert!(on_the_line > 0);
}
