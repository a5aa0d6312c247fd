//! What is drawn of a node, against sums over places of the disks below it.

use std::f64::consts::TAU;

use glam::DVec3;

use super::models::models;
use crate::{
    geometry::hierarchy::{
        Hierarchy,
        disks::{Disk, Disks},
        ellipse::{DRAWN, wholeness},
    },
    scene::{ErrorBall, Object, Shapes, Splats},
};

/// Places along a radius and around it.
const RINGS: usize = 24;
const TURNS: usize = 12;

/// Of disks below a node so many, at most, are looked at place by place.
const MOST_DISKS: usize = 64;

/// The weight of a place at this radius, with as much of the disk as it stands for.
fn places() -> impl Iterator<Item = (f64, [f64; 2])> {
    (0..RINGS * TURNS).map(|i| {
        let radius = ((i / TURNS) as f64 + 0.5) / RINGS as f64;
        let (sin, cos) = (TAU * (i % TURNS) as f64 / TURNS as f64).sin_cos();
        (radius * (-2.0 * radius * radius).exp(), [radius * cos, radius * sin])
    })
}

/// The mean square along an axis of what `at` gives, by weights.
fn mean_square(of: impl Iterator<Item = (f64, f64)>) -> f64 {
    let (sum, weight) =
        of.fold((0.0, 0.0), |(sum, total), (weight, at)| (sum + weight * at * at, total + weight));
    sum / weight
}

fn axes(splats: &Splats, i: usize) -> [DVec3; 2] {
    let Shapes::Ellipses { s, t } = &splats.shapes else { panic!("nodes are ellipses") };
    [s[i].as_dvec3(), t[i].as_dvec3()]
}

#[test]
fn a_node_is_drawn_so_long_that_its_kernel_spreads_as_those_below_do() {
    // Of a kernel of half axis 1.
    let of_one = mean_square(places().map(|(weight, [u, _])| (weight, u)));
    let mut all_parts = [0; 2];
    for (name, splats) in models() {
        let hierarchy = Hierarchy::build(&splats, &()).unwrap();
        let disks = Disks::of(&splats, &hierarchy.order);
        let (mut parts, mut looked_at) = ([0; 2], 0);
        for (i, node) in hierarchy.tree.iter().enumerate() {
            let below = disks.run(&node.splats);
            if below.len() > MOST_DISKS {
                continue;
            }
            looked_at += 1;
            let center = hierarchy.nodes.positions[i];
            for (holds, part) in axes(&hierarchy.nodes, i).into_iter().zip(hierarchy.drawn[i]) {
                let (part, direction) = (f64::from(part), holds.normalize());
                let at = |disk: &Disk, [u, v]: [f64; 2]| {
                    let place = disk.center - center + u * disk.s.as_dvec3() + v * disk.t.as_dvec3();
                    direction.dot(place)
                };
                let all = below.iter().flat_map(|disk| {
                    let area = disk.area_normal().length();
                    places().map(move |(weight, uv)| (area * weight, at(disk, uv)))
                });
                let expected = DRAWN * (mean_square(all) / of_one).sqrt();
                let (drawn, whole) = (part * holds.length(), holds.length());
                let expected = expected.min(whole);
                let expected = expected + wholeness(below.len()) * (whole - expected);
                // Where one axis is next to nothing beside the other, f32 has turned it.
                let room = 2e-3 * expected + 1e-5 * hierarchy.nodes.major_radius(i);
                assert!(part <= 1.0, "{name}: node {i}: {part}");
                assert!((drawn - expected).abs() <= room, "{name}: node {i}: {drawn}, {expected}");
                parts[usize::from(part == 1.0)] += 1;
            }
        }
        println!("{name}: of {looked_at} nodes {parts:?} axes are shorter than what holds all, and not");
        all_parts = [0, 1].map(|i| all_parts[i] + parts[i]);
    }
    assert!(all_parts.iter().all(|parts| *parts > 1000), "{all_parts:?}");
}

/// A sum of weights is as large by a node as by those below, whatever part of its ellipse is drawn.
#[test]
fn weights_follow_what_is_drawn() {
    let splats = crate::load::builtin::relief(20_000).splats;
    let hierarchy = Hierarchy::build(&splats, &()).unwrap();
    let holds: Vec<[DVec3; 2]> = (0..hierarchy.tree.len()).map(|i| axes(&hierarchy.nodes, i)).collect();
    let (drawn, tree) = (hierarchy.drawn.clone(), hierarchy.tree.clone());
    let areas: Vec<f64> = {
        let overlaps = crate::geometry::Overlaps::of(&splats);
        let of = |place: u32| {
            let i = hierarchy.order[place as usize] as usize;
            let area = crate::geometry::overlaps::area_of(&splats, i);
            area * overlaps.mean * f64::from(overlaps.inverse[i])
        };
        tree.iter().map(|node| node.splats.clone().map(of).sum()).collect()
    };
    let object = Object { name: String::new(), splats, closed: true };
    let leveled = hierarchy.leveled(object, None);
    for (i, [s, t]) in holds.into_iter().enumerate() {
        let [of_s, of_t] = drawn[i].map(f64::from);
        let [drawn_s, drawn_t] = axes(&leveled.nodes, i);
        assert!((drawn_s - of_s * s).length() <= 1e-6 * s.length(), "node {i}");
        assert!((drawn_t - of_t * t).length() <= 1e-6 * t.length(), "node {i}");
        let sum = f64::from(leveled.weights[i]) * drawn_s.cross(drawn_t).length();
        assert!((sum / areas[i] - 1.0).abs() < 1e-5, "node {i}: {sum}, {}", areas[i]);
        // What decides where it is drawn is that of all it stands for.
        let ErrorBall { radius, .. } = leveled.balls[i];
        assert!(f64::from(radius) >= s.length(), "node {i}");
    }
}

#[test]
fn nodes_of_many_splats_are_drawn_as_a_whole() {
    let hierarchy = Hierarchy::build(&crate::load::builtin::relief(20_000).splats, &()).unwrap();
    let parts_of = |least: usize, most: usize| -> Vec<f32> {
        let of = hierarchy.tree.iter().zip(&hierarchy.drawn);
        let among = of.filter(|(node, _)| (least..=most).contains(&node.splats.len()));
        among.flat_map(|(_, parts)| *parts).collect()
    };
    assert!(parts_of(64, usize::MAX).iter().all(|part| *part == 1.0));
    let mean = |parts: Vec<f32>| parts.iter().sum::<f32>() / parts.len() as f32;
    let (few, some) = (mean(parts_of(2, 8)), mean(parts_of(24, 63)));
    assert!(few < some && some < 1.0 && few > 0.6, "{few} {some}");
}
