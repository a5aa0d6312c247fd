//! Files that are built part by part.

use super::*;
use crate::{
    levels_file::{LEAST_MEMORY, convert_splats, fits},
    load::{LoadOptions, SplatRows},
    save,
    scene::{ErrorBall, LeveledObject},
};

/// The file of an object, built from a PLY file in as little memory as there can be; how many parts that took; and the splats of the PLY file.
fn in_parts(object: &Object) -> (Vec<u8>, usize, Splats) {
    let folder = temp_dir::TempDir::new().unwrap();
    let [ply, path] = ["a.ply", "a.surfel"].map(|name| folder.path().join(name));
    save::splats(&ply, &object.splats, object.closed, None, &()).unwrap();
    let mut rows = SplatRows::open(&ply, &LoadOptions::default()).unwrap().unwrap();
    assert_eq!(rows.count(), object.splats.len() as u64);
    let mut bytes = Vec::new();
    rows.read(0, object.splats.len(), &mut bytes).unwrap();
    let splats = rows.splats(&bytes);
    let (written, defects) = convert_splats(rows, &path, LEAST_MEMORY, true, &()).unwrap();
    assert_eq!(defects.total(), 0);
    // The rows that were sorted are gone.
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    (fs::read(path).unwrap(), written.parts, splats)
}

/// Each ball is within its parent's, which there is; exactly one node has none.
fn check_tree(object: &LeveledObject) {
    let bits = |ball: &ErrorBall| {
        let [x, y, z] = ball.center.to_array();
        [x, y, z, ball.radius, ball.spread].map(f32::to_bits)
    };
    let ball = |number: u32| &object.balls[number as usize];
    let own: std::collections::BTreeSet<_> =
        object.node_balls.iter().map(|balls| bits(ball(balls.own))).collect();
    let parents = object.node_balls.iter().map(|balls| balls.parent);
    let roots = parents.clone().filter(|parent| *ball(*parent) == ErrorBall::ABOVE_ROOT).count();
    assert_eq!(roots, 1);
    let all = parents.chain(object.leaf_parents.iter().copied());
    assert!(all.map(ball).all(|parent| *parent == ErrorBall::ABOVE_ROOT || own.contains(&bits(parent))));
}

#[test]
fn parts_have_all_splats_below_one_root_and_the_same_bytes_each_time() {
    let object = relief(150_000);
    assert!(!fits(150_000, LEAST_MEMORY));
    let (bytes, parts, input) = in_parts(&object);
    assert!(parts > 4, "{parts}");
    let found = loaded(&bytes).unwrap().object;
    check_tree(&found);
    let key = |rows: Vec<Vec<u64>>| {
        let mut rows: Vec<_> = rows.into_iter().map(|row| row[3..].to_vec()).collect();
        rows.sort_unstable();
        rows
    };
    assert!(key(rows(&found.leaves)) == key(rows(&input)));
    assert!(in_parts(&object).0 == bytes);
    // As many nodes as in one go, but for those above parts.
    let of_whole = written(&Object { splats: input, ..object });
    let whole = loaded(&of_whole).unwrap().object;
    let (nodes, whole_nodes) = (found.nodes.len() as f64, whole.nodes.len() as f64);
    assert!((nodes / whole_nodes - 1.0).abs() < 0.02, "{nodes} {whole_nodes}");
    assert!((found.overlap / whole.overlap - 1.0).abs() < 0.1, "{} {}", found.overlap, whole.overlap);
    assert!((found.radius / whole.radius - 1.0).abs() < 0.1, "{} {}", found.radius, whole.radius);
    assert_eq!(opened(&bytes).unwrap().ball(), opened(&of_whole).unwrap().ball());
}

/// The farthest that a disk of the object reaches in the root's ellipse, in units of it, as a line of sight across it would meet it.
fn farthest_in_root(object: &Object) -> f64 {
    let found = loaded(&in_parts(object).0).unwrap().object;
    let root =
        found.node_balls.iter().position(|balls| found.balls[balls.parent as usize] == ErrorBall::ABOVE_ROOT);
    let root = root.unwrap();
    let Shapes::Ellipses { s, t } = &found.nodes.shapes else { unreachable!("nodes are ellipses") };
    let (s, t, center) = (s[root].as_dvec3(), t[root].as_dvec3(), found.nodes.positions[root]);
    let reaches = (0..found.leaves.len()).map(|i| {
        let offset = found.leaves.positions[i] - center;
        let in_plane = (offset.dot(s) / s.length_squared()).hypot(offset.dot(t) / t.length_squared());
        in_plane + found.leaves.major_radius(i) / s.length().max(t.length())
    });
    reaches.fold(0.0, f64::max)
}

#[test]
fn nodes_above_parts_hide_every_splat_below() {
    let mut object = relief(150_000);
    let farthest = farthest_in_root(&object);
    // No looser than its 45° ask for.
    assert!((0.4..=1.0).contains(&farthest), "{farthest}");
    // One far off, in the first of the parts.
    object.splats.positions[7] = DVec3::splat(-3.0);
    let farthest = farthest_in_root(&object);
    assert!(farthest <= 1.0, "{farthest}");
}

/// Where all splats lie at one place no cut of space makes parts: they are cut by their order.
#[test]
fn splats_at_one_place_are_cut_by_their_order() {
    let mut object = relief(150_000);
    object.splats.positions.iter_mut().for_each(|position| *position = DVec3::new(1.0, 2.0, 3.0));
    let (bytes, parts, _) = in_parts(&object);
    assert!(parts > 3, "{parts}");
    let found = loaded(&bytes).unwrap().object;
    check_tree(&found);
    assert_eq!(found.leaves.len(), 150_000);
}

#[test]
fn defects_are_left_out_or_refused() {
    let folder = temp_dir::TempDir::new().unwrap();
    let [ply, path] = ["a.ply", "a.surfel"].map(|name| folder.path().join(name));
    let mut object = relief(1000);
    object.splats.positions[17] = DVec3::NAN;
    save::splats(&ply, &object.splats, false, None, &()).unwrap();
    let open = || SplatRows::open(&ply, &LoadOptions::default()).unwrap().unwrap();
    let refused = convert_splats(open(), &path, LEAST_MEMORY, true, &()).unwrap_err().to_string();
    assert!(refused.contains("1 splat left out: 1 position not finite; expected none"), "{refused}");
    let (written, defects) = convert_splats(open(), &path, LEAST_MEMORY, false, &()).unwrap();
    assert_eq!((written.header.splats, defects.total(), written.parts), (999, 1, 1));
    assert_eq!(loaded(&fs::read(&path).unwrap()).unwrap().object.leaves.len(), 999);
}

#[test]
fn the_direction_that_the_file_says_is_up_is_kept() {
    let folder = temp_dir::TempDir::new().unwrap();
    let [ply, path] = ["a.ply", "a.surfel"].map(|name| folder.path().join(name));
    let object = relief(150_000);
    for up in [DVec3::new(0.6, 0.0, 0.8), DVec3::NEG_Z] {
        save::splats(&ply, &object.splats, object.closed, Some(up), &()).unwrap();
        let rows = SplatRows::open(&ply, &LoadOptions::default()).unwrap().unwrap();
        let (written, _) = convert_splats(rows, &path, LEAST_MEMORY, true, &()).unwrap();
        assert!(written.parts > 1);
        assert_eq!(LevelsFile::open(&path).unwrap().header().up, Some(up));
    }
}
