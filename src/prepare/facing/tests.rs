use super::*;
use crate::math::random::SplitMix;

fn direction(random: &mut SplitMix) -> DVec3 {
    loop {
        let v = DVec3::new(random.unit(), random.unit(), random.unit()) * 2.0 - 1.0;
        if v.length_squared() > 0.01 && v.length_squared() <= 1.0 {
            return v.normalize();
        }
    }
}

/// Those that face an eye, or all but face it, as a device may find it: n · (e − p) above a thousandth of the distance less than 0.
fn facing(splats: &[(DVec3, DVec3)], eye: DVec3, is_far: bool) -> u32 {
    let faces = |(normal, center): &&(DVec3, DVec3)| {
        let ray = if is_far { eye.normalize() } else { (eye - *center).normalize() };
        normal.dot(ray) >= -1e-3
    };
    splats.iter().filter(faces).count() as u32
}

/// Balls, bowls, and normals that have nothing to do with where splats are; beside the local origin, too.
#[test]
fn no_more_splats_face_an_eye_than_is_known_and_of_a_ball_few_less() {
    let mut random = SplitMix(5);
    let (mut most, mut all) = ([0_u64; 4], [0_u64; 4]);
    for round in 0..48 {
        let kind = round % 4;
        let count = 300 + 97 * round;
        let splats: Vec<(DVec3, DVec3)> = (0..count)
            .map(|_| {
                let (at, other) = (direction(&mut random), direction(&mut random));
                let normal = [at, -at, other, (at + 0.3 * other).normalize()][kind];
                (normal, if kind == 3 { 0.5 * at + 0.4 * DVec3::X } else { at })
            })
            .collect();
        let mut normals = Normals::new();
        splats.iter().for_each(|(normal, center)| normals.add(*normal, *center));
        let found = Facing::new(&normals, 0.01);
        assert!(splats.iter().all(|(_, center)| center.length() <= found.farthest));
        assert_eq!(found.whole.counts[0], count as u32);
        for _ in 0..200 {
            let is_far = random.unit() < 0.1;
            let eye =
                found.farthest * (NEAREST + 0.01 + 20.0 * random.unit().powi(4)) * direction(&mut random);
            let known = found.most(eye, is_far).unwrap();
            let own = facing(&splats, eye, is_far);
            assert!(own <= known && known <= count as u32, "{round}: {own} of {known}");
            assert_eq!(found.most(eye, is_far), Some(known), "{round}");
            most[kind] += u64::from(known);
            all[kind] += u64::from(own);
        }
        let near = found.farthest * 3.99 * direction(&mut random);
        assert_eq!(found.most(near, false), None);
        assert!(found.most(near, true).is_some() && found.most(DVec3::ZERO, false).is_none());
    }
    let share = [0, 1, 2, 3].map(|kind| most[kind] as f64 / all[kind] as f64);
    println!("{share:.3?}");
    assert!(share[0] < 1.18 && share.iter().all(|share| *share < 1.5), "{share:.3?}");
}

/// However many places ask at once, and whatever is found where: what is kept is what is found anew.
#[test]
fn what_is_kept_is_of_its_own_cell() {
    let mut random = SplitMix(9);
    let mut normals = Normals::new();
    (0..2000).for_each(|_| normals.add(direction(&mut random), direction(&mut random)));
    let found = Facing::new(&normals, 0.01);
    let cells = 6 * EYES_SIDE * EYES_SIDE * STEPS;
    let asked: Vec<usize> = (0..3000).map(|_| (random.unit() * cells as f64) as usize).collect();
    for number in asked.iter().chain(&asked) {
        assert_eq!(found.kept_of(*number), found.count(*number), "{number}");
    }
}

#[test]
fn a_direction_is_within_its_cell() {
    let mut random = SplitMix(7);
    for side in [NORMALS_SIDE, EYES_SIDE] {
        let mut widest = 0_f64;
        for number in 0..6 * side * side {
            let (middle, away) = cell(side, number);
            assert_eq!(cell_of(side, 7.0 * middle), number);
            widest = widest.max(away);
        }
        let of_middle = cell(side, side / 2 * (side + 1)).1;
        assert!(widest <= of_middle * (1.0 + 1e-12), "{widest} {of_middle}");
        for _ in 0..100_000 {
            let of = direction(&mut random);
            let (middle, away) = cell(side, cell_of(side, of));
            assert!(middle.angle_between(of) <= away + 1e-9, "{of}");
        }
        for axis in [DVec3::X, DVec3::Y, DVec3::NEG_Z, DVec3::new(1.0, 1.0, 1.0), DVec3::new(-1.0, 0.0, 1.0)]
        {
            let (middle, away) = cell(side, cell_of(side, axis));
            assert!(middle.angle_between(axis) <= away + 1e-9, "{axis}");
        }
    }
}
