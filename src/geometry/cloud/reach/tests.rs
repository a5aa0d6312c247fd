use std::f64::consts::PI;

use glam::DVec2;

use super::*;
use crate::{geometry::cloud::plane::MOST_NEIGHBORS, math::random::SplitMix};

fn reach(normal: DVec3, offsets: &[DVec3]) -> Reach {
    Cells::default().reach(normal, offsets)
}

fn grid(spacing: DVec2, part: impl Fn(DVec3) -> bool) -> Vec<DVec3> {
    let one = |i: i32| spacing * DVec2::new(f64::from(i % 7 - 3), f64::from(i / 7 - 3));
    let mut all: Vec<DVec3> =
        (0..49).map(|i| one(i).extend(0.0)).filter(|o| o.length() > 0.0 && part(*o)).collect();
    all.sort_by(|a, b| a.length().total_cmp(&b.length()));
    all
}

#[test]
fn on_a_grid_a_disk_reaches_the_middle_of_its_squares() {
    let found = reach(DVec3::Z, &grid(DVec2::ONE, |_| true));
    assert!(!found.open && (found.distance - 0.5_f64.sqrt()).abs() < 1e-6, "{found:?}");
    let oblong = reach(-DVec3::Z, &grid(DVec2::new(1.0, 2.0), |_| true));
    assert!(!oblong.open && (oblong.distance - 1.25_f64.sqrt()).abs() < 1e-6, "{oblong:?}");
}

#[test]
fn at_a_border_it_reaches_no_farther_than_its_neighbors() {
    let found = reach(DVec3::Z, &grid(DVec2::ONE, |o| o.x <= 0.0));
    assert!(found.open && (found.distance - 1.0).abs() < 1e-6, "{found:?}");
    assert_eq!(reach(DVec3::Z, &[]), Reach { distance: 0.0, within: 0.0, open: true, outside: false });
    let one = reach(DVec3::Z, &[DVec3::new(0.0, 2.0, 0.0)]);
    assert!(one.open && one.distance == 2.0, "{one:?}");
}

#[test]
fn a_far_corner_with_nothing_behind_it_is_outside() {
    // A border that is not straight: the corner between the last two is far above.
    let mut ragged = grid(DVec2::ONE, |o| o.y < 0.0);
    ragged.extend([DVec3::new(-1.0, 0.2, 0.0), DVec3::new(1.0, 0.2, 0.0)]);
    ragged.sort_by(|a, b| a.length().total_cmp(&b.length()));
    let found = reach(DVec3::Z, &ragged);
    assert!(!found.open && found.outside && found.distance <= 1.1, "{found:?}");
    // With points on the other side it is a gap, which closes, whatever their face.
    let mut cells = Cells::default();
    cells.cut(DVec3::Z, -DVec3::Z, DVec3::new(0.3, 6.0, -1.0));
    assert!(!cells.reach(DVec3::Z, &ragged).outside);
    cells.uncut();
    assert!(cells.reach(DVec3::Z, &ragged).outside);
    ragged.extend((-3..4).map(|x| DVec3::new(f64::from(x), 6.0, 0.0)));
    let found = reach(DVec3::Z, &ragged);
    assert!(!found.open && !found.outside && found.distance > 2.5, "{found:?}");
}

#[test]
fn the_edge_to_another_face_ends_the_cell() {
    let face = grid(DVec2::ONE, |o| o.x < 0.5);
    let edge = |angle: f64, beside: f64| {
        let mut cells = Cells::default();
        let normal = DVec3::new(angle.sin(), 0.0, angle.cos());
        cells.cut(DVec3::Z, normal, DVec3::new(beside, 1.5, -0.5));
        cells.reach(DVec3::Z, &face)
    };
    for angle in [PI / 2.0, -PI / 2.0] {
        let found = edge(angle, 0.2);
        assert!(!found.open && !found.outside, "{found:?}");
        assert!((found.distance - 0.5_f64.sqrt()).abs() < 1e-6, "{found:?}");
        let far = edge(angle, 0.8);
        assert!((far.distance - 0.5_f64.hypot(0.8)).abs() < 1e-6, "{far:?}");
    }
    // Of a plate's other side nothing is told.
    assert!(edge(PI, 0.2).open);
}

#[test]
fn lines_far_apart_join() {
    for (apart, joins) in [(5.0, true), (17.0, true), (41.0, true), (43.0, false)] {
        // Of its own line the 8 nearest, of those beside it two each.
        let own = (-4..5).map(|i| DVec3::X * f64::from(i)).filter(|offset| offset.length() > 0.0);
        let beside =
            [-1.0, 1.0].into_iter().flat_map(|side| [0.0, 1.0].map(|x| DVec3::new(x, side * apart, 0.0)));
        let mut offsets: Vec<DVec3> = own.chain(beside).collect();
        offsets.sort_by(|a, b| a.length().total_cmp(&b.length()));
        let found = reach(DVec3::Z, &offsets);
        assert_eq!(found.distance > 0.5 * apart, joins, "{apart}: {found:?}");
    }
}

#[test]
fn a_point_right_below_cuts_nothing() {
    let mut offsets = grid(DVec2::ONE, |_| true);
    offsets.insert(0, DVec3::new(0.0, 0.0, -0.1));
    assert!((reach(DVec3::Z, &offsets).distance - 0.5_f64.sqrt()).abs() < 1e-6);
}
/// Of all crossings of two lines those that no line cuts off, and whether one is the octagon's.
fn corners(lines: &[(DVec2, f64)]) -> (f64, bool) {
    let (mut farthest, mut open) = (0.0_f64, false);
    for (i, (a, at_a)) in lines.iter().enumerate() {
        for (j, (b, at_b)) in lines.iter().enumerate().take(i) {
            let across = a.perp_dot(*b);
            if across.abs() < 1e-9 * a.length() * b.length() {
                continue;
            }
            let corner = DVec2::new(at_a * b.y - at_b * a.y, at_b * a.x - at_a * b.x) / across;
            if lines.iter().all(|(line, limit)| corner.dot(*line) <= limit + 1e-9 * limit.max(1.0)) {
                farthest = farthest.max(corner.length());
                open |= j.min(i) < SIDES;
            }
        }
    }
    (farthest, open)
}

#[test]
fn the_way_around_finds_the_corners_that_all_pairs_of_lines_have() {
    let mut random = SplitMix(12);
    let (mut open, mut closed) = (0, 0);
    for case in 0..3000 {
        let scale = 10.0_f64.powi(case % 201 - 100);
        let mut unit = || 2.0 * random.unit() - 1.0;
        let mut offsets: Vec<DVec3> = (0..[2, 6, 12, 24, 48][case as usize % 5])
            .map(|_| scale * DVec3::new(unit(), unit(), 0.2 * unit()))
            .collect();
        match case % 7 {
            0 => offsets.extend_from_within(..2),
            1 => offsets.iter_mut().for_each(|offset| *offset = (*offset / scale * 2.0).round() * scale),
            2 => offsets.push(DVec3::splat(1e60 * scale)),
            3 => (0..offsets.len()).for_each(|i| {
                let beside = scale * DVec3::new(unit(), unit(), unit());
                offsets.push(offsets[i] + 10.0_f64.powi(-3 - case % 5) * beside);
            }),
            _ => {}
        }
        offsets.retain(|offset| offset.length() > 1e-3 * scale);
        offsets.sort_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
        offsets.truncate(MOST_NEIGHBORS);
        if offsets.is_empty() {
            continue;
        }
        let radius = widest_gap(&offsets);
        let octagon = (0..SIDES).map(|i| (DVec2::from_angle(i as f64 * PI / 4.0), 1.0));
        let (u, v) = DVec3::Z.any_orthonormal_pair();
        let line = |offset: &DVec3| {
            let offset = *offset / radius;
            (DVec2::new(offset.dot(u), offset.dot(v)), 0.5 * offset.length_squared())
        };
        let near = offsets.iter().filter(|offset| offset.length() < 3.0 * radius);
        let (farthest, is_open) = corners(&octagon.chain(near.map(line)).collect::<Vec<_>>());
        let found = reach(DVec3::Z, &offsets);
        let third = offsets.get(2).or(offsets.last()).unwrap().length();
        // Where it is open, closed corners decide, or the third neighbor.
        if !is_open && !found.open {
            closed += 1;
            let to_farthest = found.distance / radius - farthest;
            assert!(
                if found.outside { to_farthest < 1e-5 } else { to_farthest.abs() < 1e-5 },
                "{case}: {found:?} {farthest}"
            );
            assert!(found.outside || found.within == found.distance, "{case}: {found:?}");
        } else if is_open && found.open {
            open += 1;
            let least = third.min(farthest * radius);
            assert!((0.99999 * least..=1.00001 * farthest * radius).contains(&found.distance));
        } else {
            // A corner of the octagon that rounding cuts off.
            assert!((farthest - 1.0).abs() < 0.09, "{case}: {found:?} {farthest} {is_open}");
        }
    }
    assert!(open > 500 && closed > 500, "{open} {closed}");
}
