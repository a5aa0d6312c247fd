//! Neighbors beside those found by looking at all.

use super::*;
use crate::math::random::SplitMix;

fn distances(positions: &[DVec3]) -> Vec<[f64; NEIGHBORS]> {
    let points = (0..).zip(positions).map(|(number, &position)| Point { position, number }).collect();
    let mut all = vec![[f64::NAN; NEIGHBORS]; positions.len()];
    Tree::new(points).distances(|number, found| all[number as usize] = found, |_| {});
    all
}

fn brute_force(positions: &[DVec3], of: usize) -> [f64; NEIGHBORS] {
    let others = positions.iter().enumerate().filter(|(other, _)| *other != of);
    let mut all: Vec<f64> = others.map(|(_, p)| p.distance_squared(positions[of]).sqrt()).collect();
    all.sort_by(f64::total_cmp);
    all.resize(NEIGHBORS.max(all.len()), f64::INFINITY);
    std::array::from_fn(|i| all[i])
}

#[test]
fn distances_are_those_of_brute_force() {
    let mut random = SplitMix(5);
    let mut unit = move || random.unit();
    for count in [0, 1, 2, 6, 7, LEAF, LEAF + 1, 50, 2000] {
        // In space, on a plane, on a grid with many equal coordinates, and at one place with a few elsewhere.
        let space: Vec<_> = (0..count).map(|_| DVec3::new(unit(), unit(), unit())).collect();
        let plane: Vec<_> = space.iter().map(|p| DVec3::new(p.x, 3.0, 1e6 * p.z)).collect();
        let grid: Vec<_> = space.iter().map(|p| (*p * 4.0).floor()).collect();
        let heap: Vec<_> = space.iter().map(|p| if p.x < 0.9 { DVec3::ONE } else { *p }).collect();
        for positions in [space, plane, grid, heap] {
            for (i, found) in distances(&positions).into_iter().enumerate() {
                assert_eq!(found, brute_force(&positions, i), "{count} points, {i}");
            }
        }
    }
}

#[test]
fn the_nearest_to_a_place_is_that_of_brute_force_within_reach() {
    let mut random = SplitMix(6);
    let mut place = move || DVec3::new(random.unit(), random.unit(), random.unit());
    for count in [0, 1, LEAF, 50, 2000] {
        let points: Vec<_> = (0..count).map(|_| place()).collect();
        let numbered = (0..).zip(&points).map(|(number, &position)| Point { position, number });
        let tree = Tree::new(numbered.collect());
        for reach in [0.02, 0.2, f64::INFINITY] {
            for _ in 0..50 {
                let target = 1.2 * place();
                let near = points.iter().map(|p| p.distance_squared(target).sqrt()).fold(reach, f64::min);
                let found = tree.nearest_to(target, reach);
                assert_eq!(found.map(|n| n.distance), (near < reach).then_some(near), "{count} {reach}");
                assert!(found.is_none_or(|n| n.position.distance_squared(target).sqrt() == n.distance));
            }
        }
    }
}

#[test]
fn many_points_on_several_threads_and_all_at_one_place() {
    // Enough for threads when building and for two batches. Along a line every distance is known.
    let count = BATCH + 4 * POINTS_PER_THREAD;
    let line: Vec<_> = (0..count).map(|i| DVec3::X * ((i * 7919) % count) as f64).collect();
    for (i, found) in distances(&line).into_iter().enumerate() {
        let at = line[i].x;
        let from_end = at.min((count - 1) as f64 - at);
        if from_end >= 3.0 {
            assert_eq!(found, [1.0, 1.0, 2.0, 2.0, 3.0, 3.0], "{i}");
        }
    }
    // Would take hours if equal points were searched on both sides of every plane.
    let heap = vec![DVec3::splat(0.1); count];
    assert!(distances(&heap).into_iter().all(|found| found == [0.0; NEIGHBORS]));
}

/// Also where many are at one distance, far away, or not at all.
#[test]
fn the_nearest_places_are_those_of_brute_force_to_a_millionth() {
    let mut random = SplitMix(7);
    let mut place = move || DVec3::new(random.unit(), random.unit(), random.unit());
    let mut many = Many::default();
    for count in [1, 12, LEAF, 50, 2000] {
        let space: Vec<_> = (0..count).map(|_| place()).collect();
        let grid = space.iter().map(|p| (*p * 4.0).floor()).collect();
        let [tiny, huge] = [1e-140, 1e150].map(|scale| space.iter().map(|p| *p * scale).collect());
        for positions in [space, grid, tiny, huge] {
            let numbered =
                (0..).zip(&positions).map(|(number, &position): (u32, _)| Point { position, number });
            let tree = Tree::new(numbered.collect());
            for target in 0..count {
                let place = tree.points()[target].position;
                let mut all: Vec<f64> =
                    tree.points().iter().map(|p| p.position.distance_squared(place)).collect();
                all.sort_by(f64::total_cmp);
                let [others, any]: [[u32; 12]; 2] =
                    [tree.nearest_places(target), tree.nearest_places_to(place)];
                for (found, truth) in [(others, &all[1..]), (any, &all)] {
                    let mut distinct: Vec<u32> = found.into_iter().filter(|at| *at != u32::MAX).collect();
                    assert_eq!(distinct.len(), truth.len().min(12));
                    for (at, truth) in distinct.iter().zip(truth) {
                        let squared = tree.points()[*at as usize].position.distance_squared(place);
                        assert!((squared - truth).abs() <= 1e-6 * truth, "{squared} {truth}, {count}");
                    }
                    distinct.sort_unstable();
                    distinct.dedup();
                    assert_eq!(distinct.len(), truth.len().min(12), "each once");
                }
                assert!(!others.contains(&(target as u32)));
            }
            // Also where the last place was far away or nothing like this one.
            for target in (0..count).chain((0..count).rev().step_by(7)) {
                let place = tree.points()[target].position * if target % 3 == 0 { 1.001 } else { 1.0 };
                let mut all: Vec<f64> =
                    tree.points().iter().map(|p| p.position.distance_squared(place)).collect();
                all.sort_by(f64::total_cmp);
                all.truncate(12);
                many.nearest(&tree, place, 12);
                let found = many.sorted(&tree, place);
                assert_eq!(found.len(), all.len());
                for (offset, truth) in found.iter().zip(&all) {
                    assert!(
                        (offset.length_squared() - truth).abs() <= 1e-6 * truth,
                        "{offset} {truth}, {count}"
                    );
                }
            }
        }
    }
    let none = Tree::new(vec![Point { position: DVec3::NAN, number: 0 }; 3]);
    assert_eq!(none.nearest_places::<2>(0), [u32::MAX; 2]);
    assert!(many.nearest(&none, DVec3::ZERO, 2).is_empty());
}
