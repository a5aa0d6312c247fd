//! The clip tests against what the curve encloses: crossings of a line with the rim's arc and with the curve.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, Vec2};

use crate::{
    hard_scenes::builder::Random,
    reference::removes,
    scene::{Clip, ClipCurve, ClipTest},
};

/// Whether a place of the open disk lies in the part between the arc from start to end, counterclockwise, and the curve: a line to
/// the right of it crosses their loop an odd number of times.
fn enclosed(curve: &ClipCurve, q: DVec2) -> bool {
    let [from, to] = [curve.start_rad, curve.end_rad].map(f64::from);
    let angle = q.y.asin();
    let in_arc = (angle - from).rem_euclid(TAU) < (to - from).rem_euclid(TAU);
    let [p1, p2, p3] = control_points(curve);
    let (w, ys) = (f64::from(curve.weight), [p1.y - q.y, p2.y - q.y, p3.y - q.y]);
    // y(t) = 0, multiplied by the denominator: a t² + 2 b t + c.
    let (a, b, c) = (ys[0] - 2.0 * w * ys[1] + ys[2], w * ys[1] - ys[0], ys[0]);
    let larger = -(b + (b * b - a * c).max(0.0).sqrt().copysign(b));
    let real = b * b >= a * c;
    let crossed = |t: &f64| (0.0..1.0).contains(t) && point(curve, *t).x > q.x;
    let crossings = [larger / a, c / larger].iter().filter(|t| real && crossed(t)).count();
    (crossings + usize::from(in_arc)) % 2 == 1
}

fn control_points(curve: &ClipCurve) -> [DVec2; 3] {
    let rim = |rad: f32| DVec2::new(f64::from(rad).cos(), f64::from(rad).sin());
    [rim(curve.start_rad), curve.middle.as_dvec2(), rim(curve.end_rad)]
}

fn point(curve: &ClipCurve, t: f64) -> DVec2 {
    let [p1, p2, p3] = control_points(curve);
    let w = [(1.0 - t).powi(2), 2.0 * t * (1.0 - t) * f64::from(curve.weight), t * t];
    (w[0] * p1 + w[1] * p2 + w[2] * p3) / (w[0] + w[1] + w[2])
}

/// Whether the outcome within `distance` of a place is not the same all around.
fn is_near(curve: &ClipCurve, q: DVec2, distance: f64) -> bool {
    let around = (0..16).map(|i| q + distance * DVec2::from_angle(PI / 8.0 * f64::from(i)));
    around.filter(|q| q.length() < 1.0).any(|at| enclosed(curve, at) != enclosed(curve, q))
}

fn random_curve(random: &mut Random, farthest: f64) -> ClipCurve {
    let middle = random.between(0.0, farthest) * DVec2::from_angle(random.between(0.0, TAU));
    let angle = |random: &mut Random| random.between(-PI, PI) as f32;
    let weight = match random.between(0.0, 10.0) {
        x if x < 1.0 => 0.0,
        x if x < 5.0 => random.between(0.0, 3.0) as f32,
        _ => 10.0_f64.powf(random.between(-6.0, 6.0)) as f32,
    };
    ClipCurve { start_rad: angle(random), end_rad: angle(random), middle: middle.as_vec2(), weight }
}

fn random_place(random: &mut Random) -> DVec2 {
    random.between(0.0, 1.0).sqrt() * 0.9999 * DVec2::from_angle(random.between(0.0, TAU))
}

fn cut(curve: ClipCurve, q: DVec2, test: ClipTest) -> bool {
    removes(&Clip::One(curve), q, test)
}

/// Dense points of the curve and of the arc, and how often the angle from a place turns around them.
#[test]
fn crossings_enclose_what_a_dense_polygon_does() {
    const STEPS: u32 = 4000;
    let mut random = Random(11);
    let mut differ = 0;
    for _ in 0..200 {
        let curve = random_curve(&mut random, 1.0);
        let [from, to] = [curve.start_rad, curve.end_rad].map(f64::from);
        let arc = (to - from).rem_euclid(TAU);
        let steps = || (0..STEPS).map(|i| f64::from(i) / f64::from(STEPS));
        let ring = steps().map(|x| DVec2::from_angle(from + x * arc));
        // Evenly in the middle weight's own parameter: a heavy one draws the points together.
        let w = f64::from(curve.weight).max(1e-3);
        let back = steps().map(|x| {
            let x = 1.0 - x;
            let x = if w > 1.0 { x.powi(3) / (x.powi(3) + (1.0 - x).powi(3)) } else { x };
            point(&curve, x)
        });
        let polygon: Vec<DVec2> = ring.chain(back).collect();
        for _ in 0..10 {
            let q = random_place(&mut random);
            let turns: f64 = (0..polygon.len())
                .map(|i| (polygon[i] - q).angle_to(polygon[(i + 1) % polygon.len()] - q))
                .sum();
            let inside = turns.abs() > PI;
            if inside != enclosed(&curve, q) {
                differ += 1;
                assert!(is_near(&curve, q, 5e-3), "{curve:?} {q}");
            }
        }
    }
    assert!(differ < 10, "{differ} near the curve");
}

#[test]
fn the_conic_is_right_everywhere_and_the_papers_test_where_the_middle_is_in_the_disk() {
    let mut random = Random(12);
    let (mut removed, mut outside, mut paper_outside) = (0, 0, 0);
    for i in 0..1_000_000 {
        let is_in_disk = i % 4 > 0;
        let curve = random_curve(&mut random, if is_in_disk { 1.0 } else { 4.0 });
        let q = random_place(&mut random);
        let truth = enclosed(&curve, q);
        removed += u32::from(truth);
        if cut(curve, q, ClipTest::Conic) != truth {
            assert!(is_near(&curve, q, 1e-9), "conic: {curve:?} {q}");
        }
        let by_paper = cut(curve, q, ClipTest::Ivo) != truth;
        match curve.middle.length() < 1.0 {
            true if by_paper => {
                // Light weights are lines, heavy ones the polygon.
                let exact = (1e-4..=1e4).contains(&curve.weight);
                assert!(is_near(&curve, q, if exact { 1e-7 } else { 3e-4 }), "ivo: {curve:?} {q}");
            }
            true => {}
            false => {
                outside += 1;
                paper_outside += u32::from(by_paper);
            }
        }
    }
    println!(
        "{removed} of a million removed; by the paper wrong {paper_outside} of {outside} with the middle outside"
    );
    assert!((400_000..600_000).contains(&removed));
    assert!(paper_outside > outside / 100, "the lines through it are right outside, too: {paper_outside}");
}

#[test]
fn ends_of_all_ranges() {
    let places: Vec<DVec2> = (0..4000)
        .map(|i| 0.9999 * (f64::from(i) / 4000.0).sqrt() * DVec2::from_angle(f64::from(i) * 2.4))
        .collect();
    let base = ClipCurve { start_rad: 0.3, end_rad: 2.5, middle: Vec2::new(0.1, 0.2), weight: 0.8 };
    let chord_middle = 0.5 * (Vec2::from_angle(0.3) + Vec2::from_angle(2.5));
    let both = [ClipTest::Conic, ClipTest::Ivo];
    let same = |a: ClipCurve, b: ClipCurve, within: f64| {
        for (test, &q) in both.iter().flat_map(|test| places.iter().map(move |q| (*test, q))) {
            if cut(a, q, test) != enclosed(&b, q) {
                assert!(is_near(&b, q, within), "{test:?} {a:?} {b:?} {q}");
            }
        }
    };
    for bulge in [Vec2::new(0.1, 0.2), Vec2::new(0.3, 0.9), -0.5 * Vec2::Y] {
        let curve = ClipCurve { middle: bulge, ..base };
        let line = ClipCurve::line(0.3, 2.5);
        // Without weight, and with hardly any, a line.
        same(ClipCurve { weight: 0.0, ..curve }, line, 1e-12);
        same(ClipCurve { weight: f32::MIN_POSITIVE, ..curve }, line, 1e-12);
        same(ClipCurve { weight: 1e-5, ..curve }, line, 1e-4);
        // With all of it, the polygon.
        same(ClipCurve { weight: f32::MAX, ..curve }, ClipCurve { weight: 1e7, ..curve }, 1e-6);
        // Between angles a turn apart nothing is different.
        let turned = ClipCurve { start_rad: 0.3 + 2.0 * TAU as f32, end_rad: 2.5 - TAU as f32, ..curve };
        same(turned, curve, 1e-5);
        // Nothing lies between a place and itself.
        for (test, &q) in both.iter().flat_map(|test| places.iter().map(move |q| (*test, q))) {
            assert!(!cut(ClipCurve { end_rad: 0.3, ..curve }, q, test));
        }
    }
    // The middle on the chord, also beyond its ends, is the chord.
    for along in [0.0, 0.5, -1.5, 3.0] {
        let middle = chord_middle + along * (Vec2::from_angle(2.5) - Vec2::from_angle(0.3));
        let line = ClipCurve::line(0.3, 2.5);
        for &q in &places {
            let curve = ClipCurve { middle, ..base };
            assert!(cut(curve, q, ClipTest::Conic) == enclosed(&line, q) || is_near(&line, q, 1e-6));
        }
    }
    // A middle far off, at a weight that keeps the curve in the disk.
    let far = ClipCurve { middle: Vec2::new(300.0, 400.0), weight: 1e-3, ..base };
    for &q in &places {
        assert!(cut(far, q, ClipTest::Conic) == enclosed(&far, q) || is_near(&far, q, 1e-9));
    }
    // The way back removes the rest.
    for (test, &q) in both.iter().flat_map(|test| places.iter().map(move |q| (*test, q))) {
        let back = ClipCurve { start_rad: base.end_rad, end_rad: base.start_rad, ..base };
        assert!(cut(back, q, test) != cut(base, q, test) || is_near(&base, q, 1e-9));
    }
}

#[test]
fn two_curves_remove_what_either_does_or_both() {
    let (one, two) = (ClipCurve::line(0.0, 2.0), ClipCurve::line(1.0, 3.0));
    let mut seen = [0; 4];
    let mut random = Random(13);
    for _ in 0..2000 {
        let q = random_place(&mut random);
        let (a, b) = (cut(one, q, ClipTest::Conic), cut(two, q, ClipTest::Conic));
        seen[usize::from(a) + 2 * usize::from(b)] += 1;
        for test in [ClipTest::Conic, ClipTest::Ivo] {
            assert_eq!(removes(&Clip::Either(one, two), q, test), a || b);
            assert_eq!(removes(&Clip::Both(one, two), q, test), a && b);
            assert!(!removes(&Clip::None, q, test));
        }
    }
    assert!(seen.iter().all(|count| *count > 50), "{seen:?}");
}
