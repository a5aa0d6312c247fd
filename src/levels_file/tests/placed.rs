//! Files that stand in a scene: moved, turned, scaled, mirrored, colored.

use glam::{DAffine3, DMat3, DQuat};

use super::*;
use crate::{
    levels_file::{PageView, Placed, load_together},
    scene::{Camera, ErrorBall, Opacity},
};

fn maps() -> Vec<DAffine3> {
    let turn = DQuat::from_axis_angle(DVec3::new(1.0, -2.0, 0.5).normalize(), 2.1);
    let place = DVec3::new(40.0, -3.0, 7.0);
    let of = |scale: DVec3| DAffine3::from_scale_rotation_translation(scale, turn, place);
    let sheared = DMat3::from_cols(DVec3::X, DVec3::new(0.8, 1.2, 0.0), DVec3::new(0.1, -0.4, 0.5));
    vec![
        of(DVec3::ONE),
        of(DVec3::splat(0.01)),
        of(DVec3::new(-3.0, 3.0, 3.0)),
        of(DVec3::new(0.5, 2.0, -1.0)),
        DAffine3::from_mat3(DMat3::from_quat(turn) * sheared),
    ]
}

fn placed(map: DAffine3) -> Placed {
    Placed { world_from_file: map, ..Placed::default() }
}

fn as_placed<'b>(bytes: &'b [u8], placed: &Placed) -> LevelsFile<Cursor<&'b [u8]>> {
    opened(bytes).unwrap().placed_as("there".to_owned(), placed).unwrap()
}

/// Its splats are those of the file under the map, and what tells whether they are drawn goes with them.
#[test]
fn what_stands_in_a_scene_is_the_file_under_the_map() {
    for object in [&objects()[..3], &objects()[3..4]].concat() {
        let bytes = written(&object);
        let whole = loaded(&bytes).unwrap().object;
        for map in maps() {
            let mut file = as_placed(&bytes, &placed(map));
            let found = file.load(None, u64::MAX, &()).unwrap().object;
            assert_eq!((found.name.as_str(), found.closed), ("there", whole.closed));
            assert_eq!(rows(&found.leaves), rows(&whole.leaves.clone().transformed(&map)));
            assert_eq!(rows(&found.nodes), rows(&whole.nodes.clone().transformed(&map)));
            assert_eq!((&found.weights, &found.leaf_parents), (&whole.weights, &whole.leaf_parents));
            // No ball is farther out than its parent's, but for rounding, and none has a larger spread.
            let ball = |number: u32| found.balls[number as usize];
            let rounding = 1e-6 * found.radius;
            for balls in &found.node_balls {
                let [own, parent] = [ball(balls.own), ball(balls.parent)];
                if parent != ErrorBall::ABOVE_ROOT {
                    let reach = f64::from(own.center.distance(parent.center) + own.radius);
                    assert!(
                        reach <= f64::from(parent.radius) + rounding && own.spread <= parent.spread,
                        "{map}"
                    );
                }
            }
            for (i, parent) in found.leaf_parents.iter().enumerate() {
                let (ball, position) = (ball(*parent), found.leaves.positions[i]);
                let reach = position.distance(found.origin + ball.center.as_dvec3());
                assert!(
                    reach + found.leaves.major_radius(i) <= f64::from(ball.radius) + 2.0 * rounding,
                    "{map}"
                );
                assert!(position.distance(file.ball().center) <= file.ball().radius * (1.0 + 1e-9));
            }
        }
    }
}

/// A view of what stands somewhere reads what it draws: the pages that it reads of the file as it was written, from where that is seen alike.
#[test]
fn a_view_reads_of_it_what_it_reads_of_the_file_as_it_was_written() {
    let bytes = written(&relief(100_000));
    let size_px = [256, 192];
    for (number, map) in maps().into_iter().enumerate() {
        let is_similarity = number < 3;
        for (eye, target) in [([0.0, 0.0, 4.0], [0.0; 3]), ([0.9, 0.7, 0.9], [0.3, 0.5, 0.0])] {
            let camera = Camera { eye: eye.into(), target: target.into(), ..Camera::default() };
            let there = Camera {
                eye: map.transform_point3(camera.eye),
                target: map.transform_point3(camera.target),
                up: map.transform_vector3(camera.up),
                near: Some(1e-3 * camera.eye.distance(camera.target)),
                ..camera
            };
            for tau_px in [0.0, 1.0, 8.0] {
                let [view, view_there] =
                    [camera, there].map(|camera| PageView::new(&camera, size_px, tau_px));
                let here = opened(&bytes).unwrap().load(Some(&view), u64::MAX, &()).unwrap();
                let found = as_placed(&bytes, &placed(map)).load(Some(&view_there), u64::MAX, &()).unwrap();
                // Mirrored, the picture has the other side's pages at its edges, of which there are as many.
                if is_similarity {
                    assert!(
                        found.pages.abs_diff(here.pages) <= 1,
                        "{number}: {} {}",
                        found.pages,
                        here.pages
                    );
                }
                assert!(found.object.leaves.len() + found.object.nodes.len() > 0);
            }
        }
    }
}

#[test]
fn colors_and_alphas_are_those_of_the_scene() {
    let objects = objects();
    let tinted = |object: &Object, color, alpha| {
        let placed = Placed { color, alpha, ..Placed::default() };
        let bytes = written(object);
        let mut file = as_placed(&bytes, &placed);
        let opacity = file.header().opacity();
        let loaded = file.load(None, u64::MAX, &()).unwrap().object;
        assert_eq!((loaded.opacity, loaded.leaves.colors.opacity()), (opacity, opacity));
        let mut expected = super::loaded(&bytes).unwrap().object;
        expected.leaves.colors.tint(color, alpha);
        expected.nodes.colors.tint(color, alpha);
        if alpha > 0.0 {
            assert_eq!(rows(&loaded.leaves), rows(&expected.leaves));
            assert_eq!(rows(&loaded.nodes), rows(&expected.nodes));
        }
        opacity
    };
    let red = Some([1.0, 0.0, 0.0]);
    // Colors of their own, one color, and alphas of their own.
    for object in &objects[..3] {
        let own = object.splats.colors.opacity();
        assert_eq!(tinted(object, None, 1.0), own);
        assert_eq!(tinted(object, red, 1.0), own);
        assert_eq!(tinted(object, red, 0.5), Opacity::Transparent);
        assert_eq!(tinted(object, None, 0.25), Opacity::Transparent);
        assert_eq!(tinted(object, None, 0.0), Opacity::Invisible);
    }
}

#[test]
fn places_beyond_what_numbers_are_for_are_refused() {
    let bytes = written(&relief(500));
    for (scale, words) in [
        (1e300, "placed farther out than 1e"),
        (1e-60, "can't be drawn where the object is placed: it is too small or too large"),
    ] {
        let map = placed(DAffine3::from_scale(DVec3::splat(scale)));
        let read = opened(&bytes).unwrap().placed_as("a".to_owned(), &map);
        let error = read.and_then(|mut file| file.load(None, u64::MAX, &())).unwrap_err().to_string();
        assert!(error.starts_with("a.surfel: ") && error.contains(words), "{error}");
    }
}

/// Each file has as much of one memory as it has in the view, and all are drawn alike.
#[test]
fn files_of_one_view_share_memory() {
    let bytes = written(&relief(100_000));
    let at = |x: f64| as_placed(&bytes, &placed(DAffine3::from_translation(DVec3::new(x, 0.0, 0.0))));
    let camera = Camera { eye: DVec3::new(0.0, 0.0, 4.0), ..Camera::default() };
    let view = PageView::new(&camera, [256, 192], 0.25);
    let bytes_of = |chosen: &Chosen| {
        let object = &chosen.object;
        // Twice in memory, on the way to a device.
        2 * (object.leaves.bytes() + object.nodes.bytes())
    };
    let most_bytes = 10_000_000;
    let alone = at(0.0).load(Some(&view), most_bytes, &()).unwrap();
    assert!(alone.tau_px > 0.25, "{}", alone.tau_px);
    // One that is out of sight takes nothing from it.
    let read = load_together(&mut [at(0.0), at(500.0)], &view, most_bytes, &()).unwrap();
    assert_eq!(read.iter().map(|chosen| chosen.tau_px).collect::<Vec<_>>(), [alone.tau_px; 2]);
    assert_eq!((read[0].pages, read[1].pages), (alone.pages, 0));
    // One beside it does.
    let read = load_together(&mut [at(0.0), at(0.5)], &view, most_bytes, &()).unwrap();
    assert!(read[0].tau_px > alone.tau_px && read[1].tau_px == read[0].tau_px, "{read:?}");
    let all: u64 = read.iter().map(bytes_of).sum();
    assert!(all <= most_bytes && all > most_bytes / 8, "{all}");
    assert!(read.iter().all(|chosen| chosen.wanted_bytes == read[0].wanted_bytes));
}
