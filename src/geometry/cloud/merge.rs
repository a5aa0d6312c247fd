//! Points at the same place become one, and those that are nowhere are left out.

use std::{cmp::Ordering, iter};

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use crate::scene::{Colors, Points, Viewpoint};

/// What was left of the points.
pub(super) struct Merged {
    /// In the order of the first of each.
    pub points: Points,
    /// Points that were at the place of another.
    pub duplicates: usize,
    /// Points with a coordinate that is NaN or infinite.
    pub not_finite: usize,
}

/// Merges points whose coordinates are equal as numbers: color and radius become the mean, normals their sum.
pub(super) fn merge(points: Points) -> Merged {
    if all_apart(&points.positions) {
        return Merged { points, duplicates: 0, not_finite: 0 };
    }
    let position = |i: &u32| points.positions[*i as usize];
    let count = u32::try_from(points.positions.len()).unwrap_or(u32::MAX);
    let finite = (0..count).filter(|i| position(i).is_finite());
    // Equal places have equal keys, and others hardly ever.
    let mut sorted: Vec<u64> = finite.map(|i| key(position(&i)) & UPPER | u64::from(i)).collect();
    let not_finite = points.positions.len() - sorted.len();
    sorted.par_sort_unstable();
    sorted.chunk_by_mut(|a, b| a >> 32 == b >> 32).filter(|one_key| one_key.len() > 1).for_each(|one_key| {
        one_key
            .sort_unstable_by(|a, b| compare(position(&(*a as u32)), position(&(*b as u32))).then(a.cmp(b)))
    });
    let order: Vec<u32> = sorted.into_iter().map(|key| key as u32).collect();
    let same = |a: &u32, b: &u32| position(a) == position(b);
    let groups = order.chunk_by(same).count();
    let duplicates = order.len() - groups;
    if duplicates == 0 && not_finite == 0 {
        return Merged { points, duplicates, not_finite };
    }
    let mut groups: Vec<&[u32]> = order.chunk_by(same).collect();
    groups.par_sort_unstable_by_key(|group| group[0]);
    let mean = |colors: &[[f32; 4]], group: &[u32]| -> [f32; 4] {
        let sum = |c: usize| group.iter().map(|&i| f64::from(colors[i as usize][c])).sum::<f64>();
        std::array::from_fn(|c| (sum(c) / group.len() as f64) as f32)
    };
    let radius = |radii: &[f32], group: &[u32]| -> f32 {
        let sum: f64 = group.iter().map(|&i| f64::from(radii[i as usize])).sum();
        (sum / group.len() as f64) as f32
    };
    // Groups are in the order of their first points.
    let ends =
        points.viewpoints.iter().map(|view| groups.partition_point(|group| (group[0] as usize) < view.end));
    let viewpoints =
        points.viewpoints.iter().zip(ends).map(|(view, end)| Viewpoint { end, ..*view }).collect();
    let merged = Points {
        positions: groups.iter().map(|group| position(&group[0])).collect(),
        normals: points.normals.as_ref().map(|n| groups.iter().map(|group| sum_normal(n, group)).collect()),
        radii: points.radii.as_ref().map(|r| groups.iter().map(|group| radius(r, group)).collect()),
        radii_in_doubt: points.radii_in_doubt,
        colors: match &points.colors {
            Colors::Uniform(color) => Colors::Uniform(*color),
            Colors::Each(colors) => Colors::Each(groups.iter().map(|group| mean(colors, group)).collect()),
        },
        viewpoints,
    };
    Merged { points: merged, duplicates, not_finite }
}

fn along(a: f64, b: f64) -> Ordering {
    a.partial_cmp(&b).unwrap_or(Ordering::Equal)
}

/// Whether all places are finite and no two have one key. Keys of which the upper bits are equal, eight or so, are compared with each other, so that none
/// need be sorted.
fn all_apart(places: &[DVec3]) -> bool {
    if !places.par_iter().all(|place| place.is_finite()) {
        return false;
    }
    let bits = (places.len() / 8).max(1).ilog2() + 1;
    let bucket = |key: u64| (key >> (u64::BITS - bits)) as usize;
    let keys: Vec<u64> = places.par_iter().map(|place| key(*place)).collect();
    let mut ends = vec![0_usize; 1 << bits];
    keys.iter().for_each(|key| ends[bucket(*key)] += 1);
    // Where each bucket begins, which becomes where it ends.
    let mut begin = 0;
    for end in &mut ends {
        begin += std::mem::replace(end, begin);
    }
    let mut sorted = vec![0; keys.len()];
    for key in keys {
        let next = &mut ends[bucket(key)];
        sorted[*next] = key;
        *next += 1;
    }
    let begins = iter::once(0).chain(ends.iter().copied());
    begins.zip(&ends).all(|(begin, end)| {
        let keys = &sorted[begin..*end];
        keys.len() <= MOST_ALIKE && keys.iter().enumerate().all(|(i, key)| !keys[..i].contains(key))
    })
}

/// More keys with the same upper bits are no chance: they are not compared with each other.
const MOST_ALIKE: usize = 64;

/// The half of a key by which equal places are found.
const UPPER: u64 = 0xffff_ffff_0000_0000;

/// The same of places that are equal as numbers.
fn key(place: DVec3) -> u64 {
    // −0 + 0 is 0. Products carry what differs into the upper half (Knuth, "The Art of Computer Programming" 3, section 6.4).
    let bits = (place + DVec3::ZERO).to_array().map(f64::to_bits);
    bits.into_iter().fold(0_u64, |key, bits| (key.rotate_left(23) ^ bits).wrapping_mul(0x9e37_79b9_7f4a_7c15))
}

fn compare(a: DVec3, b: DVec3) -> Ordering {
    along(a.x, b.x).then_with(|| along(a.y, b.y)).then_with(|| along(a.z, b.z))
}

/// Each normal counts as much, whatever its length; a single one stays as it is.
fn sum_normal(normals: &[Vec3], group: &[u32]) -> Vec3 {
    match group {
        [only] => normals[*only as usize],
        _ => {
            group.iter().map(|&i| normals[i as usize].as_dvec3().normalize_or_zero()).sum::<DVec3>().as_vec3()
        }
    }
}

/// The step between numbers of 32 bits at half of the points, which all have such coordinates, if their neighbors are no farther than a few steps: points
/// were moved to places that are such numbers then, some to one. Maps' coordinates in a format of 32 bits do that.
pub(super) fn coarse_step(positions: &[DVec3], spreads: &[f64], duplicates: usize) -> Option<f64> {
    if duplicates == 0 {
        return None;
    }
    let largest = median(positions.iter().map(|place| place.abs().max_element()).collect());
    let spread = median(spreads.to_vec());
    let step = f64::from((largest as f32).next_up()) - f64::from(largest as f32);
    let is_coarse = spread > 0.0 && spread <= FEW_STEPS * step;
    (is_coarse && positions.par_iter().all(|place| place.as_vec3().as_dvec3() == *place)).then_some(step)
}

fn median(mut values: Vec<f64>) -> f64 {
    let middle = values.len() / 2;
    if values.is_empty() { 0.0 } else { *values.select_nth_unstable_by(middle, f64::total_cmp).1 }
}

/// Places on a grid of so many steps are still seen to be on it.
const FEW_STEPS: f64 = 4.0;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::SplitMix;

    /// Of 400,000 places some 19 pairs have one key.
    #[test]
    fn places_of_one_key_stay_apart_and_those_that_are_one_merge() {
        let mut random = SplitMix(6);
        let mut positions: Vec<DVec3> =
            (0..400_000).map(|_| DVec3::from_array([0; 3].map(|_| random.unit()))).collect();
        let mut keys: Vec<u64> = positions.iter().map(|place| key(*place) & UPPER).collect();
        keys.sort_unstable();
        let equal = keys.windows(2).filter(|pair| pair[0] == pair[1]).count();
        assert!((5..40).contains(&equal), "{equal}");
        assert!(all_apart(&positions) && all_apart(&[]) && all_apart(&positions[..1]));
        assert!(!all_apart(&[&positions[..9], &[DVec3::X, positions[3]]].concat()));
        assert!(!all_apart(&[DVec3::ZERO, DVec3::X, -DVec3::ZERO]) && !all_apart(&[DVec3::INFINITY]));
        positions.extend_from_within(1000..1010);
        assert!(!all_apart(&positions));
        let expected = positions[..400_000].to_vec();
        let merged = merge(Points { positions, ..Points::default() });
        assert_eq!(merged.duplicates, 10);
        assert!(merged.points.positions == expected, "another order");
    }

    /// Steps are 0.5 from 2²² = 4 194 304 on.
    #[test]
    fn coordinates_of_32_bits_far_away_are_found_coarse() {
        let grid = |apart: f64| -> Vec<DVec3> {
            (0..100).map(|i| DVec3::new(f64::from(i) * apart, 4_600_000.0 + f64::from(i), 3.0)).collect()
        };
        assert_eq!(coarse_step(&grid(0.125), &[1.0; 100], 1), Some(0.5));
        assert_eq!(coarse_step(&grid(0.125), &[3.0; 100], 1), None, "far enough apart");
        assert_eq!(coarse_step(&grid(0.1), &[1.0; 100], 1), None, "of 64 bits");
        let near: Vec<DVec3> = grid(0.125).iter().map(|place| *place - 4_600_000.0 * DVec3::Y).collect();
        assert_eq!(
            coarse_step(&[near, grid(0.125)[..9].to_vec()].concat(), &[1.0; 109], 1),
            None,
            "but for a few"
        );
        assert_eq!((coarse_step(&[], &[], 1), coarse_step(&[DVec3::ONE], &[0.0], 1)), (None, None));
    }

    #[test]
    fn equal_places_merge_whatever_the_sign_of_zero() {
        let nan = DVec3::new(0.0, f64::NAN, 0.0);
        let points = Points {
            positions: vec![DVec3::X, DVec3::ZERO, nan, DVec3::X, DVec3::new(-0.0, 0.0, -0.0), DVec3::Y],
            normals: Some(vec![Vec3::X, Vec3::Z, Vec3::Z, 3.0 * Vec3::Y, Vec3::Z, Vec3::Z]),
            radii: None,
            radii_in_doubt: false,
            colors: Colors::Each([0.0, 1.0, 0.5, 0.5, 1.0, 0.25].map(|v| [v; 4]).into()),
            viewpoints: vec![Viewpoint { end: 4, place: DVec3::X }, Viewpoint { end: 6, place: DVec3::Y }],
        };
        let merged = merge(points);
        assert_eq!((merged.duplicates, merged.not_finite), (2, 1));
        assert_eq!(merged.points.positions, [DVec3::X, DVec3::ZERO, DVec3::Y]);
        let ends: Vec<usize> = merged.points.viewpoints.iter().map(|view| view.end).collect();
        assert_eq!(ends, [2, 3]);
        assert_eq!(merged.points.normals.unwrap()[0], Vec3::new(1.0, 1.0, 0.0));
        let Colors::Each(colors) = merged.points.colors else { panic!("one color") };
        assert_eq!(colors, [[0.25; 4], [1.0; 4], [0.25; 4]]);
    }
}
