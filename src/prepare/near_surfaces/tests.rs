//! Plates, clouds that nobody oriented, and what is hostile.

use super::{sharp::Sharp, *};
use crate::{
    math::random::SplitMix,
    scene::{Clip, ClipCurve, Clips, Colors},
};

/// Two sides of a plate so thick, spaced 0.8 radii of 1, with normals that look outward, or to both sides at random.
fn plate(thick: f64, noise: f64, oriented: bool) -> Splats {
    let mut random = SplitMix(11);
    let mut splats = Splats::new(
        Vec::new(),
        Shapes::Disks { normals: Vec::new(), radii: Vec::new() },
        Colors::Uniform([1.0; 4]),
    );
    for side in [1.0, -1.0] {
        for i in 0..900 {
            let mut jitter = || 0.2 * (random.unit() - 0.5);
            let [x, y] = [f64::from(i % 30), f64::from(i / 30)].map(|at| 0.8 * at + jitter());
            let z = side * 0.5 * thick + 2.0 * noise * (random.unit() - 0.5);
            splats.positions.push(DVec3::new(x, y, z));
            let Shapes::Disks { normals, radii } = &mut splats.shapes else { unreachable!() };
            let sign = if oriented || random.unit() < 0.5 { side } else { -side };
            normals.push(Vec3::Z * sign as f32);
            radii.push(1.0);
        }
    }
    splats
}

#[test]
fn epsilon_is_half_of_what_is_between_two_sides() {
    for radii in [1.0, 2.0] {
        for thick in [0.1, 0.5, 1.0, 1.9 * radii] {
            let shares = shares(&plate(thick, 0.0, true), radii).unwrap();
            let expected = (0.5 * thick / radii) as f32;
            assert!(shares.iter().all(|share| (share - expected).abs() < 1e-6), "{thick}: {shares:?}");
        }
        assert_eq!(shares(&plate(2.1 * radii, 0.0, true), radii), None);
    }
}

#[test]
fn one_surface_is_no_plate_whatever_way_its_normals_look() {
    for noise in [0.0, 0.01, 0.1] {
        let mut one = plate(0.0, noise, false);
        one.keep(&[vec![true; 900], vec![false; 900]].concat());
        let cut = shares(&one, 1.0).map_or(0, |all| all.iter().filter(|share| **share < 1.0).count());
        assert!(cut <= 2, "{noise}: {cut} of 900");
    }
    assert_eq!(shares(&crate::load::builtin::sphere(20_000).splats, 2.0), None);
}

/// Of a face with clip curves what is 0.4 radii behind it, and faces the same way, is none of its surface; what bends away is.
#[test]
fn surfaces_with_sharp_edges_have_the_epsilon_of_what_their_planes_meet() {
    let sharp = |of: Splats| {
        let count = of.len();
        let mut clips = vec![Clip::None; count];
        clips[0] = Clip::One(ClipCurve::line(0.0, 1.0)); // which a disk can't have: it is not drawn
        Splats { clips: Clips::of(clips), ..of }
    };
    let mut behind = plate(0.4, 0.0, true);
    if let Shapes::Disks { normals, .. } = &mut behind.shapes {
        normals.fill(Vec3::Z);
    }
    assert_eq!(shares(&behind, 1.0), None, "as a surface with noise");
    let flat = Sharp::of(&sharp(behind), 1.0);
    assert!(flat.shares[1..].iter().all(|share| (*share - 0.05).abs() < 1e-6), "{:?}", &flat.shares[..9]);
    assert!(turns(&flat).iter().all(|turn| *turn == 0.0), "{:?}", &flat.bends[..9]);
    let mut bent = plate(0.0, 0.0, true);
    bent.keep(&[vec![true; 900], vec![false; 900]].concat());
    if let Shapes::Disks { normals, .. } = &mut bent.shapes {
        for (at, normal) in bent.positions.iter_mut().zip(normals) {
            let x = (0.1 * at.x).sin_cos();
            (at.x, at.z, *normal) = (10.0 * x.0, 10.0 * x.1, Vec3::new(x.0 as f32, 0.0, x.1 as f32));
        }
    }
    // 1.5 radii away of a cylinder of 10.
    let hollow = turned(bent.clone());
    let around = Sharp::of(&sharp(bent), 1.0);
    let (turns, bent) = (turns(&around), around.shares);
    let of_few = bent[1..].iter().filter(|share| !(0.05..0.226).contains(*share)).count();
    assert!(
        of_few == 0 && bent.iter().filter(|share| **share > 0.06).count() > 800,
        "{of_few} {:?}",
        &bent[..9]
    );
    // A splat's radius is a tenth of the cylinder's: a chord's sine over its length.
    let unlike = turns[1..].iter().filter(|turn| !(0.05..0.101).contains(*turn)).count();
    assert!(unlike == 0, "{unlike} of {:?}", &turns[..9]);
    let from_inside = self::turns(&Sharp::of(&sharp(hollow), 1.0));
    assert!(from_inside.iter().all(|turn| *turn == 0.0), "{:?}", &from_inside[..9]);
}

fn turns(sharp: &Sharp) -> Vec<f32> {
    sharp.bends.iter().map(|bend| f32::from_bits(bend & !0xffff)).collect()
}

/// Slivers side by side are a strip eleven of them wide; what lies beyond a step is none of it. They turn away across themselves, where they are narrow.
#[test]
fn slivers_know_how_wide_their_surface_is_and_turn_as_far_as_they_reach() {
    let strip = |bend: f64| {
        let angles = (0..11).map(|i| bend * 0.2 * f64::from(i));
        let at = |angle: f64| match bend == 0.0 {
            true => DVec3::ZERO,
            false => DVec3::new(angle.sin(), 0.0, angle.cos() - 1.0) / bend,
        };
        let flat = |i: usize| if bend == 0.0 { DVec3::new(0.2 * i as f64, 0.0, 0.0) } else { DVec3::ZERO };
        let mut positions: Vec<_> =
            angles.clone().enumerate().map(|(i, angle)| at(angle) + flat(i)).collect();
        let t = angles.map(|angle| 0.1 * Vec3::new(angle.cos() as f32, 0.0, -angle.sin() as f32));
        let mut t: Vec<Vec3> = t.map(|t| -t).collect();
        positions.push(DVec3::new(-0.2, 0.0, -0.3));
        t.push(-0.1 * Vec3::X);
        let shapes = Shapes::Ellipses { s: vec![2.0 * Vec3::Y; 12], t };
        let clips = Clips::of(vec![Clip::One(ClipCurve::line(0.0, 1.0)); 12]);
        Splats { clips, ..Splats::new(positions, shapes, Colors::unknown()) }
    };
    let flat = Sharp::of(&strip(0.0), 1.0);
    let eighths: Vec<u32> = flat.bends.iter().map(|bend| bend & 0xff).collect();
    assert_eq!([0, 5, 10, 11].map(|i| eighths[i]), [168, 88, 168, 8]);
    // Of a cylinder of radius 4, of which they reach over a fortieth.
    let bent = turns(&Sharp::of(&strip(0.25), 1.0));
    assert!(bent[..11].iter().all(|turn| (0.02..0.0251).contains(turn)), "{bent:?}");
    // Across themselves, so that it is the minor axis that reaches there.
    let reaches = |sharp: &Sharp| sharp.bends[..11].iter().map(|bend| bend >> 8 & 0xff).collect::<Vec<u32>>();
    assert_eq!(reaches(&Sharp::of(&strip(0.25), 1.0)), [255; 11]);
    // Turned by a quarter, they lie along what bends: of how far they reach the minor axis is a twentieth.
    let mut along = strip(0.25);
    if let Shapes::Ellipses { s, t } = &mut along.shapes {
        for (s, t) in s.iter_mut().zip(t.iter_mut()) {
            (*s, *t) = (20.0 * *t, -0.05 * *s); // so that the normal stays
        }
    }
    let reached = reaches(&Sharp::of(&along, 1.0));
    assert!(reached.iter().all(|part| *part == 13), "{reached:?}");
}

/// With normals the other way.
fn turned(mut splats: Splats) -> Splats {
    if let Shapes::Disks { normals, .. } = &mut splats.shapes {
        normals.iter_mut().for_each(|normal| *normal = -*normal);
    }
    splats
}

#[test]
fn noise_is_not_cut_off() {
    let noisy = shares(&plate(0.8, 0.05, true), 1.0).unwrap();
    // Spreads are up to 0.1, the gap is 0.7 to 0.9.
    assert!(noisy.iter().all(|share| (0.34..=0.45).contains(share)), "{noisy:?}");
}

#[test]
fn strays_heaps_and_giants_end() {
    let mut heap = plate(0.5, 0.0, true);
    heap.positions[..450].fill(DVec3::splat(1e9));
    heap.positions[1400] = DVec3::splat(1e300);
    heap.positions[1401] = DVec3::splat(-1e300);
    heap.positions[1402] = DVec3::splat(f64::NAN);
    if let Shapes::Disks { radii, .. } = &mut heap.shapes {
        radii[1403] = 1e30;
    }
    let found = shares(&heap, 1.0).unwrap();
    assert!(found.iter().all(|share| *share > 0.0 && *share <= 1.0));
    let many = plate(0.5, 0.0, true);
    let at_one_place = Splats { positions: vec![DVec3::ONE; many.len()], ..many };
    assert_eq!(shares(&at_one_place, 1.0), None);
}

/// In a plane that has gaps, on a line, and at random.
#[test]
fn cells_of_a_box_are_all_that_are_in_it_in_their_order() {
    let mut random = SplitMix(12);
    for case in 0..3 {
        let mut at = |axis: usize| match (case, axis) {
            (0, 2) | (1, 1 | 2) => 0.5,
            _ => (12.0 * random.unit()).floor() - 6.0 + 0.5,
        };
        let positions: Vec<DVec3> = (0..200).map(|_| DVec3::new(at(0), at(1), at(2))).collect();
        let count = positions.len();
        let shapes = Shapes::Disks { normals: vec![Vec3::Z; count], radii: vec![1.0; count] };
        let splats = Splats::new(positions, shapes, Colors::Uniform([1.0; 4]));
        let grid = Grid::new(&splats, (0..count as u32).collect(), 1.0);
        for _ in 0..300 {
            let mut corner = |most: f64| [0; 3].map(|_| (most * (random.unit() - 0.5)) as i32);
            let (a, size) = (corner(20.0), corner(16.0));
            let b: [i32; 3] = std::array::from_fn(|axis| a[axis] + size[axis].abs());
            let found: Vec<_> = grid.within([a, b]).map(|cell| grid.at(cell)).collect();
            let is_inside = |cell: &[i32; 3]| (0..3).all(|axis| (a[axis]..=b[axis]).contains(&cell[axis]));
            let all: Vec<_> = grid.cells.iter().map(|cell| grid.at(cell)).filter(is_inside).collect();
            assert_eq!(found, all, "{a:?} to {b:?}");
        }
    }
}
