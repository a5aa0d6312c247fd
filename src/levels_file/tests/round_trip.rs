//! What is written is read again: splats, nodes, balls and all that is known of the whole.

use std::collections::BTreeMap;

use super::*;
use crate::{
    geometry::hierarchy::Hierarchy,
    scene::{ErrorBall, LeveledObject},
};

/// Each splat or node with its balls, by all of it but its position, which may be rounded.
fn by_rest(splats: &Splats, balls: impl Fn(usize) -> Vec<f32>) -> BTreeMap<Vec<u64>, Vec<DVec3>> {
    let mut found: BTreeMap<Vec<u64>, Vec<DVec3>> = BTreeMap::new();
    for (i, row) in rows(splats).into_iter().enumerate() {
        let key = [&row[3..], &balls(i).iter().map(|x| u64::from(x.to_bits())).collect::<Vec<_>>()].concat();
        found.entry(key).or_default().push(splats.positions[i]);
    }
    found
}

fn floats(ball: &ErrorBall) -> [f32; 5] {
    let [x, y, z] = ball.center.to_array();
    [x, y, z, ball.radius, ball.spread]
}

fn assert_same(found: &LeveledObject, truth: &LeveledObject) {
    let of = |object: &LeveledObject| {
        let ball = |number: u32| floats(&object.balls[number as usize]);
        let inverse = object.inverse_overlaps.as_ref().unwrap();
        // As a device has it.
        let steps = |i: usize| (16_384.0 * inverse[i]).round();
        let leaves = by_rest(&object.leaves, |i| [&ball(object.leaf_parents[i])[..], &[steps(i)]].concat());
        let nodes = by_rest(&object.nodes, |i| {
            let balls = object.node_balls[i];
            [&ball(balls.own)[..], &ball(balls.parent), &[object.weights[i]]].concat()
        });
        (leaves, nodes)
    };
    let ((leaves, nodes), (true_leaves, true_nodes)) = (of(found), of(truth));
    for (found, truth) in [(leaves, true_leaves), (nodes, true_nodes)] {
        assert!(found.keys().eq(truth.keys()));
        for ((key, mut places), mut true_places) in found.into_iter().zip(truth.into_values()) {
            let order = |a: &DVec3, b: &DVec3| {
                a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z))
            };
            places.sort_by(order);
            true_places.sort_by(order);
            assert_eq!(places.len(), true_places.len());
            // The first three of the key are a normal or an axis; a major radius is in it somewhere.
            let largest =
                key.iter().map(|bits| f64::from(f32::from_bits(*bits as u32)).abs()).fold(0.0, f64::max);
            for (place, truth) in places.iter().zip(&true_places) {
                assert!(place.distance(*truth) <= largest / f64::from(1 << 14), "{place} {truth}");
            }
        }
    }
    let facts = |object: &LeveledObject| {
        (object.closed, object.opacity, object.overlap.to_bits(), object.origin, object.radius.to_bits())
    };
    assert_eq!(facts(found), facts(truth));
}

#[test]
fn all_forms_are_read_as_they_were_written() {
    for (i, object) in objects().into_iter().enumerate() {
        let bytes = written(&object);
        let chosen = loaded(&bytes).unwrap_or_else(|e| panic!("{i}: {e}"));
        let file = opened(&bytes).unwrap();
        let header = file.header();
        assert_eq!((header.splats, header.up), (object.splats.len() as u64, Some(DVec3::Z)));
        assert_eq!(file.bounds(), object.splats.bounds().unwrap());
        assert_eq!(chosen.pages, header.pages as usize);
        let truth = Hierarchy::build(&object.splats, &()).unwrap().leveled(object, None);
        assert_same(&chosen.object, &truth);
    }
}

#[test]
fn the_same_object_gives_the_same_bytes_and_another_does_not() {
    let bytes = [4000, 4000, 4001].map(|count| written(&relief(count)));
    assert!(bytes[0] == bytes[1] && bytes[0] != bytes[2]);
}

/// Where splats are far from one another and small, 32 bits would move them.
#[test]
fn positions_have_the_bits_that_they_need() {
    let wide = |object: &Object| pages(&written(object)).iter().filter(|page| page.wide).count();
    let objects = objects();
    assert_eq!(wide(&objects[0]), 0);
    assert_eq!(wide(&objects[3]), 0);
    assert!(wide(&objects[4]) > 0);
}

/// A view needs a page for the largest parent in it: few splats of large parents do not make it read many of small ones.
#[test]
fn pages_hold_splats_whose_parents_have_about_one_size() {
    let bytes = written(&relief(120_000));
    let pages = pages(&bytes);
    // Those that end before a step of their own are few: half an octave is a factor of 1.41.
    let mixed = pages.iter().filter(|page| page.parent.spreads[1] > 1.42 * page.parent.spreads[0]);
    let (mixed, all) =
        (mixed.map(|page| page.count).sum::<u32>(), pages.iter().map(|page| page.count).sum::<u32>());
    assert!(pages.len() > 12 && 10 * mixed < all, "{mixed} of {all} in {} pages", pages.len());
}
