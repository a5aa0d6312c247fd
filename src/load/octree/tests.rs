use std::io::Cursor;

use glam::DVec3;

use super::*;
use crate::{
    load::{Model, las},
    math::random::SplitMix,
    scene::{Colors, Points},
};

#[path = "../../../tests/common/octree_files.rs"]
mod files;
mod hostile;
mod limits;

use files::{CloudPoint, OFFSET, Octree, SCALE};

/// Points on a wave over a square of 60 m, the dense half of which has four times as many.
fn cloud(count: usize) -> Vec<CloudPoint> {
    let mut random = SplitMix(3);
    let mut unit = || random.bits() as f64 / u64::MAX as f64;
    let point = |_| {
        let (x, y) = (60.0 * unit() * if unit() < 0.6 { 0.5 } else { 1.0 }, 60.0 * unit());
        let z = 4.0 + 2.0 * (0.3 * x).sin() * (0.2 * y).cos();
        let color = [x / 60.0, y / 60.0, z / 8.0].map(|value| (65535.0 * value) as u16);
        ([x, y, z].map(|at| (at / SCALE) as i32), color)
    };
    (0..count).map(point).collect()
}

fn octree(count: usize) -> Octree {
    Octree::of(&cloud(count), [0; 3], 1 << 16, 16)
}

fn source(name: &str, bytes: Vec<u8>) -> Source<Cursor<Vec<u8>>> {
    Source { path: name.into(), bytes: bytes.len() as u64, reader: Cursor::new(bytes) }
}

type Opened = Result<PointOctree<Cursor<Vec<u8>>>>;

fn of_copc(bytes: Vec<u8>) -> Opened {
    PointOctree::of_copc(source("a.copc.laz", bytes), &small())
}

fn of_potree(files: [Vec<u8>; 3]) -> Opened {
    of_potree_within(files, &small().limits)
}

fn of_potree_within([metadata, hierarchy, nodes]: [Vec<u8>; 3], limits: &Limits) -> Opened {
    let path = Path::new("metadata.json");
    let opened = potree::read(path, &metadata, hierarchy.len() as u64)?;
    let files = [source("hierarchy.bin", hierarchy), source("octree.bin", nodes)];
    PointOctree::of_potree(path, opened, files, limits)
}

/// A few bytes may not be a million points here.
fn small() -> LoadOptions {
    let mut options = LoadOptions::default();
    options.limits.expanded_bytes = 1 << 14;
    options
}

fn points(loaded: Loaded) -> Points {
    match loaded.model {
        Model::Points(points) => points,
        _ => panic!("no points"),
    }
}

/// Places in steps, with colors in 255 steps, in an order that does not depend on the file's.
fn sorted(points: &Points) -> Vec<([i64; 3], [i64; 3])> {
    let of = |(i, at): (usize, &DVec3)| {
        let steps = ((*at - DVec3::from(OFFSET)) / SCALE).to_array().map(|step| step.round() as i64);
        let color = points.colors.get(i).unwrap();
        (steps, [0, 1, 2].map(|c| (1e4 * color[c]).round() as i64))
    };
    let mut all: Vec<_> = points.positions.iter().enumerate().map(of).collect();
    all.sort_unstable();
    all
}

#[test]
fn both_formats_have_all_points_of_the_cloud_where_they_are() {
    let octree = octree(30_000);
    let flat = las_points(&octree.copc(2).0);
    let mut copc = of_copc(octree.copc(2).0).unwrap();
    let mut potree = of_potree(octree.potree(2)).unwrap();
    let mut packed = of_potree(octree.packed_potree(2)).unwrap();
    assert_eq!(flat.positions.len(), 30_000);
    for octree in [&mut copc, &mut potree, &mut packed] {
        assert_eq!(octree.points(), 30_000);
        assert!((octree.spacing() - 4.096).abs() < 1e-9);
        let all = octree.choose(&|_| true).unwrap();
        assert_eq!(octree.size_of(&all).0, 30_000);
        let read = points(octree.read(&all, &()).unwrap());
        assert!(sorted(&read) == sorted(&flat), "other points");
        assert!(matches!(read.colors, Colors::Each(_)));
        let levels = octree.levels();
        assert!(levels.len() > 5 && levels[0].nodes == 1 && octree.pages() > 4, "{levels:?}");
        assert_eq!(levels.iter().map(|level| level.points).sum::<u64>(), 30_000);
        let bounds = octree.bounds();
        assert!(
            read.positions
                .iter()
                .all(|at| at.cmpge(bounds.min - 1e-6).all() && at.cmple(bounds.max + 1e-6).all())
        );
    }
    assert_eq!(copc.format(), "COPC, LAZ 1.4, format 7");
    // The same bytes as one that reads the file from its beginning to its end.
    let all = copc.choose(&|_| true).unwrap();
    assert_eq!(points(copc.read(&all, &()).unwrap()).positions, flat.positions);
}

fn las_points(bytes: &[u8]) -> Points {
    let options = LoadOptions::default();
    let input = Input { path: Path::new("a.laz"), folder: None, bytes, options: &options, progress: &() };
    points(las::parse(&input).unwrap())
}

#[test]
fn what_is_not_wanted_is_neither_read_nor_told_and_points_lie_in_their_nodes() {
    let octree = octree(30_000);
    for mut octree in [of_copc(octree.copc(2).0).unwrap(), of_potree(octree.potree(2)).unwrap()] {
        let corner = DVec3::from(OFFSET) + DVec3::new(3.0, 3.0, 4.0);
        let is_near = |node: &OctreeNode| (node.center - corner).abs().cmple(node.half + 1.0).all();
        let near = octree.choose(&is_near).unwrap();
        let pages = octree.pages();
        let (points, bytes) = octree.size_of(&near);
        assert!(points > 300 && points < 6000, "{points}");
        assert!(bytes < 200_000 && pages < 8);
        for key in near {
            let node = octree.tree.node(key);
            let read = self::points(octree.read(&[key], &()).unwrap());
            let is_in = |at: &DVec3| (*at - node.center).abs().cmple(node.half + 1e-6).all();
            assert!(read.positions.iter().all(is_in), "{key}: {node:?}");
            let spacing = octree.spacing() / f64::from(1 << key.level);
            assert_eq!(node.spacing, spacing);
        }
        octree.choose(&|_| true).unwrap();
        assert!(octree.pages() > pages);
    }
}

#[test]
fn what_numbers_of_colors_mean_is_the_same_in_every_view() {
    // The root has one bright point; all others are below 256.
    let mut cloud = cloud(5000);
    cloud.iter_mut().for_each(|(_, color)| *color = [200, 100, 0]);
    cloud[0].1 = [60_000, 0, 0];
    let mut octree = of_copc(Octree::of(&cloud, [0; 3], 1 << 16, 16).copc(3).0).unwrap();
    let all = octree.choose(&|_| true).unwrap();
    let part: Vec<NodeKey> = all.iter().copied().filter(|key| key.level < 2).collect();
    for nodes in [&all, &part] {
        let loaded = octree.read(nodes, &()).unwrap();
        assert!(loaded.format.ends_with(", 16-bit colors"), "{}", loaded.format);
    }
}

/// What is wrong, in one line.
#[track_caller]
fn refuses(octree: Result<PointOctree<Cursor<Vec<u8>>>>, expected: &str) {
    let read = octree.and_then(|mut octree| {
        let all = octree.choose(&|_| true)?;
        octree.read(&all, &())
    });
    let error = read.expect_err("it is read");
    assert_eq!((error.to_string().as_str(), error.exit_code()), (expected, 1));
}

#[test]
fn hierarchies_that_go_in_circles_or_beyond_the_file_are_refused_with_the_place() {
    let (whole, root) = octree(2000).copc(2);
    let entry = |number: usize, at: usize| root + 32 * number + at;
    let with = |changes: &[(usize, &[u8])]| {
        let mut bytes = whole.clone();
        changes.iter().for_each(|(at, new)| bytes[*at..at + new.len()].copy_from_slice(new));
        of_copc(bytes)
    };
    let of_root = format!("a.copc.laz: page of the hierarchy at byte {root}: ");
    let refuses_entry =
        |changes: &[(usize, &[u8])], expected: &str| refuses(with(changes), &format!("{of_root}{expected}"));
    let minus = &(-1_i32).to_le_bytes();
    let itself = (root as u64).to_le_bytes();
    refuses_entry(
        &[(entry(0, 28), minus)],
        "entry 0, node 0-0-0-0: named as a page again; expected its points",
    );
    // A page that names the page it is in: the last entry of the first page, which has nothing below it there.
    let last = u64::from_le_bytes(whole[429 + 48..][..8].try_into().unwrap()) as usize / 32 - 1;
    refuses_entry(
        &[(entry(last, 28), minus), (entry(last, 16), &itself), (entry(last, 24), &32_i32.to_le_bytes())],
        "named twice; expected each page once",
    );
    refuses_entry(&[(entry(0, 0), minus)], "entry 0: no octree has a node -1-0-0-0");
    refuses_entry(&[(entry(1, 4), &9_i32.to_le_bytes())], "entry 1: no octree has a node 1-9-0-0");
    refuses_entry(&[(entry(1, 0), &31_i32.to_le_bytes())], "entry 1: no octree has a node 31-0-0-0");
    refuses_entry(&[(entry(1, 0), &[0; 16])], "entry 1, node 0-0-0-0: named before; expected each node once");
    refuses_entry(
        &[(entry(0, 28), &(-2_i32).to_le_bytes())],
        "entry 0, node 0-0-0-0: -2 points; expected -1 for a page, or 0 or more",
    );
    refuses_entry(&[(entry(0, 24), minus)], "entry 0, node 0-0-0-0: -1 bytes; expected 0 or more");
    refuses_entry(
        &[(entry(0, 28), &2001_i32.to_le_bytes())],
        "entry 0, node 0-0-0-0: 2001 points with those before; expected 2000 in all",
    );
    let far = u64::MAX.to_le_bytes();
    let size = i32::from_le_bytes(whole[entry(0, 24)..][..4].try_into().unwrap());
    let count = i32::from_le_bytes(whole[entry(0, 28)..][..4].try_into().unwrap());
    refuses_entry(
        &[(entry(0, 16), &far)],
        &format!(
            "entry 0, node 0-0-0-0: {count} points in {size} bytes at byte {}; expected some within {}",
            u64::MAX,
            whole.len()
        ),
    );
    // A grandchild whose parent is not there.
    refuses_entry(
        &[(entry(1, 0), &[2, 0, 0, 0, 3, 0, 0, 0, 3, 0, 0, 0, 3, 0, 0, 0])],
        "node 2-3-3-3 without the node above it",
    );
    let size_at = 429 + 48;
    refuses(with(&[(size_at, &31_u64.to_le_bytes())]), &format!("{of_root}31 bytes; expected entries of 32"));
    refuses(
        with(&[(size_at, &far)]),
        &format!(
            "a.copc.laz: header: a hierarchy of {} bytes at byte {root}; expected some within {}",
            u64::MAX,
            whole.len()
        ),
    );
    let half = f64::NAN.to_le_bytes();
    let error = with(&[(429 + 24, &half)]).err().unwrap().to_string();
    assert!(error.starts_with("a.copc.laz: header: an octree around "), "{error}");
}

#[test]
fn potree_of_other_kinds_and_wrong_hierarchies_are_refused() {
    let whole = octree(2000).potree(2);
    let metadata = String::from_utf8(whole[0].clone()).unwrap();
    let [_, hierarchy, nodes] = whole.clone();
    let changed = |from: &str, to: &str| {
        assert!(metadata.contains(from));
        of_potree([metadata.replacen(from, to, 1).into_bytes(), hierarchy.clone(), nodes.clone()])
    };
    refuses(
        changed("DEFAULT", "ZIP"),
        "metadata.json: encoding: 'ZIP'; expected DEFAULT, UNCOMPRESSED or BROTLI",
    );
    refuses(changed("\"2.0\"", "\"1.8\""), "metadata.json: version: '1.8'; expected 2.0");
    refuses(changed("\"position\"", "\"place\""), "metadata.json: attributes: no position of three int32");
    refuses(
        changed("\"size\": 2,", "\"size\": 70000,"),
        "metadata.json: attributes: records of 70012 bytes; expected at most 65536",
    );
    refuses(
        changed("\"points\": 2000", "\"points\": 2001"),
        "metadata.json: points: 2001 of 21 bytes in 42000 bytes; expected at most 2000",
    );
    let error = changed("\"spacing\": 4.096", "\"spacing\": -1").err().unwrap().to_string();
    assert!(error.starts_with("metadata.json: metadata: scale ") && !error.contains('\n'), "{error}");
    let with = |at: usize, new: &[u8]| {
        let mut bytes = hierarchy.clone();
        bytes[at..at + new.len()].copy_from_slice(new);
        of_potree([whole[0].clone(), bytes, nodes.clone()])
    };
    let place = "hierarchy.bin: page of the hierarchy at byte 0: ";
    refuses(
        with(0, &[2]),
        &format!("{place}1 entries; its masks name 1 nodes").replace("1 entries", &entries_of(&metadata)),
    );
    let error = with(1, &[0]).unwrap().choose(&|_| true).unwrap_err().to_string();
    assert!(error.starts_with(place) && error.ends_with("its masks name 1 nodes"), "{error}");
    let error = with(2, &[0xff; 4]).unwrap().choose(&|_| true).unwrap_err().to_string();
    assert!(error.contains("entry 0, node 0-0-0-0: 4294967295 points in "), "{error}");
    let error = with(6, &[0xff; 8]).unwrap().choose(&|_| true).unwrap_err().to_string();
    assert!(error.contains("expected some within 42000"), "{error}");
}

/// How many entries the first page has, as the message says it.
fn entries_of(metadata: &str) -> String {
    let bytes = metadata.split("\"firstChunkSize\": ").nth(1).unwrap().split(',').next().unwrap();
    format!("{} entries", bytes.parse::<usize>().unwrap() / 22)
}
