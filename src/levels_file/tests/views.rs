//! What a view reads of a file: all that it draws, and no more than memory allows.

use super::*;
use crate::{
    geometry::hierarchy::{Hierarchy, Levels, Projection},
    levels_file::PageView,
    scene::{Camera, ErrorBall, LeveledObject},
};

const SIZE_PX: [u32; 2] = [256, 192];

fn cameras() -> Vec<Camera> {
    let of = |eye: [f64; 3], target: [f64; 3], orthographic_height: Option<f64>| Camera {
        eye: eye.into(),
        target: target.into(),
        orthographic_height,
        ..Camera::default()
    };
    vec![
        of([0.0, 0.0, 4.0], [0.0; 3], None),
        of([0.0, 0.0, 40.0], [0.0; 3], None),
        of([0.9, 0.7, 0.9], [0.3, 0.5, 0.0], None),
        of([1.1, 0.0, 0.0], [1.1, 1.0, 0.3], None),
        of([0.2, 0.1, 0.0], [1.0, 0.0, 0.0], None),
        of([5.0, 0.0, 0.0], [9.0, 0.0, 0.0], None),
        of([0.0, 0.0, 4.0], [0.4, 0.3, 0.0], Some(0.5)),
        of([0.0, 3.0, 4.0], [0.0; 3], Some(3.0)),
    ]
}

/// The centers, by their bits, of all splats and nodes that the rule draws, with what they have of a ball.
fn drawn(object: &LeveledObject, projection: &Projection, tau_px: f64) -> Vec<(bool, DVec3, f64)> {
    let ball = |number: u32| object.balls[number as usize];
    let leaves = (0..object.leaves.len()).map(|i| {
        let levels = Levels { own: ErrorBall::LEAF, parent: ball(object.leaf_parents[i]) };
        (false, levels, object.leaves.positions[i], object.leaves.major_radius(i))
    });
    let nodes = (0..object.nodes.len()).map(|i| {
        let balls = object.node_balls[i];
        let levels = Levels { own: ball(balls.own), parent: ball(balls.parent) };
        (true, levels, object.nodes.positions[i], object.nodes.major_radius(i))
    });
    let is_drawn = |levels: &Levels| projection.draws(levels, tau_px);
    let mut drawn: Vec<_> = leaves
        .chain(nodes)
        .filter(|(_, levels, ..)| is_drawn(levels))
        .map(|(node, _, position, radius)| (node, position, radius))
        .collect();
    drawn.sort_by(|a, b| {
        let key = |of: &(bool, DVec3, f64)| (of.0, of.1.to_array().map(f64::to_bits));
        key(a).cmp(&key(b))
    });
    drawn
}

/// Whether any of a ball may be in the picture: by its projection, not by planes as pages are tested.
fn is_in_picture(camera: &Camera, center: DVec3, radius: f64) -> bool {
    let view = camera.view_from_world().point(center);
    let focal_px = camera.focal_px(SIZE_PX[1]);
    // Points of the ball, and whether one of them is seen.
    let directions = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z, DVec3::ZERO];
    directions.into_iter().map(|direction| view + radius * direction).any(|DVec3 { x, y, z }| {
        let scale = if camera.is_orthographic() { 1.0 } else { z };
        let [px, py] = [x, y].map(|at| at / scale * focal_px);
        z > 1e-3 && px.abs() <= f64::from(SIZE_PX[0]) / 2.0 && py.abs() <= f64::from(SIZE_PX[1]) / 2.0
    })
}

#[test]
fn a_view_reads_all_that_it_draws_and_leaves_out_much() {
    let object = relief(300_000);
    let bytes = written(&object);
    let whole = loaded(&bytes).unwrap().object;
    let hierarchy = Hierarchy::build(&object.splats, &()).unwrap();
    let pages = pages(&bytes).len();
    let mut read = Vec::new();
    for camera in cameras() {
        for tau_px in [0.0, 0.5, 1.0, 8.0, 100.0] {
            let view = PageView::new(&camera, SIZE_PX, tau_px);
            let chosen = opened(&bytes).unwrap().load(Some(&view), u64::MAX, &()).unwrap();
            assert_eq!(chosen.tau_px, tau_px);
            let projection = Projection::of_camera(&camera, SIZE_PX[1], &hierarchy);
            let needed: Vec<_> = drawn(&whole, &projection, tau_px)
                .into_iter()
                .filter(|(_, center, radius)| is_in_picture(&camera, *center, *radius))
                .collect();
            let found = drawn(&chosen.object, &projection, tau_px);
            let missing = needed.iter().filter(|splat| {
                let key = |of: &(bool, DVec3, f64)| (of.0, of.1.to_array().map(f64::to_bits));
                found.binary_search_by(|other| key(other).cmp(&key(splat))).is_err()
            });
            assert_eq!(missing.count(), 0, "{camera:?} {tau_px}");
            read.push((chosen.pages, tau_px));
        }
    }
    // From afar a few pages of nodes, along the surface not all splats, away from it nothing.
    let of = |camera: usize, tau: usize| read[5 * camera + tau].0;
    assert!(of(1, 2) <= pages / 4 && of(3, 0) < of(0, 0) && of(5, 2) == 0, "{read:?} of {pages}");
}

/// Next to the surface few pages hold what is in the picture, of all sizes below it: pages are together in space, not only in size.
#[test]
fn a_view_next_to_the_surface_reads_little() {
    let bytes = written(&relief(300_000));
    let camera =
        Camera { eye: [0.0, 0.0, 1.2].into(), fov_y_rad: 0.05, near: Some(0.01), ..Camera::default() };
    let view = PageView::new(&camera, SIZE_PX, 0.0);
    let near = opened(&bytes).unwrap().load(Some(&view), u64::MAX, &()).unwrap().object;
    // Of both sides that the view's axis meets.
    println!("{} of 300000 splats", near.leaves.len());
    assert!((1000..75_000).contains(&near.leaves.len()), "{}", near.leaves.len());
    // And pages are not so small that what is told of them costs much.
    let file = opened(&bytes).unwrap();
    let header = file.header();
    assert!(u64::from(header.pages) * 512 < header.splats + header.nodes, "{} pages", header.pages);
}

#[test]
fn what_memory_does_not_suffice_for_is_drawn_coarser() {
    let bytes = written(&relief(150_000));
    let camera = cameras()[0];
    let view = PageView::new(&camera, SIZE_PX, 0.25);
    let mut file = opened(&bytes).unwrap();
    let all = file.load(Some(&view), u64::MAX, &()).unwrap();
    let mut before_px = 0.25;
    for most_bytes in [40_000_000, 10_000_000, 2_000_000, 300_000] {
        let chosen = file.load(Some(&view), most_bytes, &()).unwrap();
        let held = |chosen: &Chosen| {
            // Twice in memory, on the way to a device.
            2 * (chosen.object.leaves.bytes() + chosen.object.nodes.bytes())
        };
        assert!(held(&chosen) <= most_bytes, "{} of {most_bytes}", held(&chosen));
        assert!(chosen.tau_px >= before_px && chosen.pages <= all.pages, "{chosen:?}");
        before_px = chosen.tau_px;
        assert!(chosen.object.nodes.len() + chosen.object.leaves.len() > 0);
    }
    assert!(before_px > 1.0, "{before_px}");
    let error = file.load(Some(&view), 10, &()).unwrap_err().to_string();
    assert!(error.starts_with("--budget-memory: 10 bytes; expected 290 at least"), "{error}");
}

/// Each page goes to one of several readers, in even shares, and what one reader of all has memory for each of more has for its share.
#[test]
fn several_readers_read_each_page_once() {
    let bytes = written(&relief(300_000));
    let camera = cameras().remove(2);
    let view = PageView::new(&camera, SIZE_PX, 0.5);
    let read = |view: PageView, most_bytes: u64| {
        let chosen = opened(&bytes).unwrap().load(Some(&view), most_bytes, &()).unwrap();
        let splats =
            |splats: &Splats| splats.positions.iter().map(|at| at.to_array().map(f64::to_bits)).collect();
        let found: [Vec<[u64; 3]>; 2] = [splats(&chosen.object.leaves), splats(&chosen.object.nodes)];
        (found.concat(), chosen.tau_px)
    };
    let (mut all, tau_px) = read(view, u64::MAX);
    all.sort_unstable();
    for readers in [1, 2, 4, 7] {
        let parts: Vec<_> = (0..readers).map(|i| read(view.with_readers(i, readers), u64::MAX)).collect();
        let counts: Vec<usize> = parts.iter().map(|(part, _)| part.len()).collect();
        let mut found: Vec<_> = parts.iter().flat_map(|(part, _)| part.iter().copied()).collect();
        found.sort_unstable();
        assert!(found == all && parts.iter().all(|(_, of)| *of == tau_px), "{readers}: {counts:?}");
        // A page more or less.
        let (least, most) = (counts.iter().min().unwrap(), counts.iter().max().unwrap());
        assert!(most - least <= 2 * (1 << 14), "{readers}: {counts:?}");
    }
    // Four have room for finer ones than one.
    let budget = 16 << 20;
    let (one, four) = (read(view, budget), [0, 1, 2, 3].map(|i| read(view.with_readers(i, 4), budget)));
    assert!(one.1 > four[0].1 && four.iter().all(|(_, of)| *of == four[0].1), "{} {}", one.1, four[0].1);
}
