mod clumps;
mod few;
mod given;
mod lines;
mod rims;
mod surfaces;

use std::path::Path;

use glam::{DVec3, Vec3};

use super::{CloudReport, splats_from_points};
use crate::{
    geometry::neighbors::{Point, Tree},
    math::random::SplitMix,
    scene::{Points, Shapes, Splats, Viewpoint},
};
use surfaces::{Sample, Surfaces};

fn points(positions: impl IntoIterator<Item = DVec3>) -> Points {
    Points { positions: positions.into_iter().collect(), ..Points::default() }
}

fn of(samples: &[Sample]) -> (Splats, CloudReport) {
    splats_from_points(points(samples.iter().map(|s| s.0)), &())
}

fn disks(splats: &Splats) -> (&[Vec3], &[f32]) {
    match &splats.shapes {
        Shapes::Disks { normals, radii } => (normals, radii),
        Shapes::Ellipses { .. } => panic!("ellipses"),
    }
}

/// Angles between the normals of splats and the true ones, degrees, sorted; and how many are on the wrong side.
fn errors(splats: &Splats, samples: &[Sample]) -> (Vec<f64>, usize) {
    let (normals, _) = disks(splats);
    let dots = normals.iter().zip(samples).map(|(n, (_, truth))| n.as_dvec3().dot(*truth));
    let mut angles: Vec<f64> = dots.clone().map(|dot| dot.abs().min(1.0).acos().to_degrees()).collect();
    angles.sort_by(f64::total_cmp);
    // At an edge the normal may be that of the other face.
    (angles, dots.filter(|dot| *dot < -0.5).count())
}

/// How many of the places on the surface are in no disk, seen along the normal there. With `margin` 1 the disks as they are.
fn holes(splats: &Splats, places: &[Sample], margin: f64) -> usize {
    let (normals, radii) = disks(splats);
    let numbered = (0..).zip(&splats.positions).map(|(number, &position)| Point { position, number });
    let tree = Tree::new(numbered.collect());
    let covered = |(place, normal): &Sample| {
        let near: [u32; 40] = tree.nearest_places_to(*place);
        near.iter().filter_map(|at| tree.points().get(*at as usize)).any(|point| {
            let i = point.number as usize;
            let n = normals[i].as_dvec3();
            // Where the line along the normal meets the disk's plane.
            let slope = n.dot(*normal);
            let along = n.dot(splats.positions[i] - *place) / slope;
            let hit = *place + along * *normal;
            slope.abs() > 0.05 && (hit - splats.positions[i]).length() <= margin * f64::from(radii[i])
        })
    };
    places.iter().filter(|place| !covered(place)).count()
}

fn noisy(samples: &[Sample], sigma: f64, random: &mut SplitMix) -> Vec<Sample> {
    let mut normal = || (0..12).map(|_| random.unit()).sum::<f64>() - 6.0;
    samples.iter().map(|(p, n)| (*p + sigma * DVec3::new(normal(), normal(), normal()), *n)).collect()
}

struct Case {
    name: String,
    samples: Vec<Sample>,
    /// Other places on the same surface, without noise.
    places: Vec<Sample>,
    /// Mean and 99th hundredth of normals' errors, degrees.
    most: [f64; 2],
    flipped: usize,
}

/// The surfaces with `count` points each: clean, with noise of a hundredth of their size, and ten times as dense at one end as at the
/// other. A plate's sides are 2 radii of its disks apart.
fn cases(count: usize) -> Vec<Case> {
    type Surface = fn(&mut Surfaces, f64) -> Sample;
    let surfaces: [(&str, Surface, [f64; 2], [f64; 2]); 4] = [
        ("sphere", |s, _| s.sphere(), [1.0, 4.0], [2.0, 5.0]),
        ("torus", |s, _| s.torus(), [2.0, 8.0], [2.5, 7.0]),
        ("cube", |s, _| s.cube(), [3.0, 90.0], [9.0, 60.0]),
        ("plate", |s, apart| s.plate(apart), [0.5, 1.0], [2.5, 9.0]),
    ];
    let mut s = Surfaces(SplitMix(11));
    // A random point's share of a side's area is 8/count, and a disk's radius 1.5 times its root.
    let apart = 3.0 * (8.0 / count as f64).sqrt();
    let mut cases = Vec::new();
    for (name, surface, clean, noise) in surfaces {
        let even = s.many(count, |s| surface(s, apart));
        let places = s.many(2 * count, |s| surface(s, apart));
        let noisy = noisy(&even, 0.01, &mut s.0);
        let uneven = s.many(count, |s| s.uneven(|s| surface(s, apart)));
        let mut add = |of: &str, samples, most, flipped| {
            let places = places.clone();
            cases.push(Case { name: format!("{name}{of}"), samples, places, most, flipped });
        };
        add("", even, clean, 0);
        // Where its noise is wider than it is thick, a plate has no sides, and few patches tell them where these are half as wide.
        let of_noise = match name {
            "plate" if apart < 0.03 => count,
            "plate" => count / 20,
            _ => 0,
        };
        add(", 1% noise", noisy, noise, of_noise);
        add(", uneven", uneven, clean.map(|most| 1.5 * most), 0);
    }
    cases
}

/// The processor time of all threads so far, seconds; 0 where the system does not tell it.
fn cpu_secs() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields = stat.rsplit(')').next().unwrap_or_default().split_ascii_whitespace();
    fields.skip(11).take(2).filter_map(|ticks| ticks.parse::<f64>().ok()).sum::<f64>() / 100.0
}

/// `runs` of the same, as the clock has steps of a hundredth of a second.
fn check(case: &Case, runs: usize) {
    let start = cpu_secs();
    let (mut splats, mut report) = of(&case.samples);
    (1..runs).for_each(|_| (splats, report) = of(&case.samples));
    let secs = (cpu_secs() - start) / runs as f64;
    let mut places = splats.positions.iter().peekable();
    let is_kept = |(place, _): &&Sample| places.next_if(|kept| *kept == place).is_some();
    let kept: Vec<Sample> = case.samples.iter().filter(is_kept).copied().collect();
    // What noise throws farthest may be taken for a point of its own.
    let lost = case.samples.len() - kept.len();
    assert!(kept.len() == splats.len() && 100_000 * lost <= case.samples.len(), "{}: {report}", case.name);
    let (angles, flipped) = errors(&splats, &kept);
    let mean = angles.iter().sum::<f64>() / angles.len() as f64;
    let p99 = angles[angles.len() * 99 / 100];
    let [holes, bare] = [1.0, 1.0 / super::DEFAULT_OVERLAP].map(|m| holes(&splats, &case.places, m));
    let rate = case.samples.len() as f64 / secs;
    let told = format!(
        "{:17} mean {mean:6.3}° p99 {p99:6.2}° flipped {flipped} holes {holes} ({bare} without overlap) of {}, \
         {} disks limited, {rate:.0} points/s a core",
        case.name,
        case.places.len(),
        report.limited
    );
    println!("{told}");
    assert!(mean < case.most[0] && p99 < case.most[1], "{told}");
    assert!(flipped <= case.flipped && holes == 0, "{told}");
}

#[test]
fn surfaces_are_oriented_and_closed() {
    for case in cases(10_000) {
        check(&case, 1);
    }
}

/// The points and their true normals, six numbers a row, for other programs (benches/README.md).
fn write(folder: &Path, case: &Case, count: usize) {
    let rows = case.samples.iter().map(|(p, n)| format!("{} {} {} {} {} {}\n", p.x, p.y, p.z, n.x, n.y, n.z));
    let file = folder.join(format!("{} {count}.xyz", case.name));
    std::fs::write(file, rows.collect::<String>()).expect("a folder that can be written to");
}

#[test]
#[ignore = "minutes of work; prints figures"]
fn large_surfaces_are_oriented_and_closed() {
    let folder = std::env::var_os("SURFEL_CLOUDS");
    for count in [10_000, 100_000, 1_000_000] {
        println!("{count} points");
        let one = std::env::var("SURFEL_CASE").unwrap_or_default();
        for case in cases(count).into_iter().filter(|case| case.name.contains(&one)) {
            if let Some(folder) = &folder {
                write(Path::new(folder), &case, count);
            }
            check(&case, 1_000_000_usize.div_ceil(count));
        }
    }
}

#[test]
fn what_is_no_surface_becomes_disks_all_the_same() {
    let nan = DVec3::new(f64::NAN, 0.0, 0.0);
    let line = |i: i32| f64::from(i) * DVec3::new(1.0, 2.0, -0.5);
    let cases: Vec<(&str, Vec<DVec3>, usize)> = vec![
        ("none", vec![], 0),
        ("one", vec![DVec3::ONE], 1),
        ("two", vec![DVec3::ONE, DVec3::X], 2),
        ("three", vec![DVec3::ONE, DVec3::X, DVec3::Y], 3),
        ("all equal", vec![DVec3::ONE; 5000], 1),
        ("a line", (0..5000).map(line).collect(), 5000),
        ("along z", (0..100).map(|i| DVec3::Z * f64::from(i)).collect(), 100),
        (
            "a grid",
            (0..10_000).map(|i| DVec3::new(f64::from(i % 100), 0.0, f64::from(i / 100))).collect(),
            10_000,
        ),
        ("not finite", vec![nan, DVec3::INFINITY, DVec3::X], 1),
        ("nothing finite", vec![nan; 20], 0),
        ("all of f64", vec![DVec3::splat(f64::MAX), DVec3::splat(-f64::MAX), DVec3::splat(1e-310)], 3),
        (
            "near each other far away",
            (0..50).map(|i| DVec3::new(4e6 + 1e-9 * f64::from(i), 5e5, 1.0)).collect(),
            50,
        ),
    ];
    for (name, positions, expected) in cases {
        let (mut splats, report) = splats_from_points(points(positions), &());
        let (normals, radii) = disks(&splats);
        assert!(normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-5), "{name}: {normals:?}");
        assert!(radii.iter().all(|r| *r > 0.0), "{name}");
        // The radii of what f32 can't hold are left out later.
        assert_eq!(splats.len(), expected, "{name}: {report}");
        assert!(splats.drop_defective().total() == 0 || name == "all of f64", "{name}: {report}");
    }
}

#[test]
fn the_result_is_the_same_on_any_number_of_threads_and_far_from_the_origin() {
    let mut s = Surfaces(SplitMix(5));
    let samples = s.many(20_000, Surfaces::torus);
    let on = |threads: usize, offset: DVec3| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        // In steps that f64 holds at both places.
        let steps = samples.iter().map(|(p, _)| (p * 1e6).round() / 1048576.0 + offset);
        pool.install(|| splats_from_points(points(steps), &())).0
    };
    let (one, far) = (on(1, DVec3::ZERO), DVec3::new(500_000.0, 4_000_000.0, 128.0));
    for (name, other) in [("3 threads", on(3, DVec3::ZERO)), ("far away", on(2, far))] {
        assert!(disks(&one) == disks(&other), "{name}");
    }
}

#[test]
fn isolated_points_and_duplicates_are_left_out_and_told() {
    let mut s = Surfaces(SplitMix(6));
    let mut positions: Vec<DVec3> = s.many(5000, Surfaces::sphere).iter().map(|s| s.0).collect();
    positions.extend([positions[7], positions[9], positions[7]]);
    positions.extend([DVec3::splat(3.0), DVec3::new(-5.0, 0.0, 0.0), DVec3::NAN]);
    let (splats, report) = splats_from_points(points(positions.clone()), &());
    let expected = "5006 points: normals and radii found from 12 neighbors each, turned to one side; 3 duplicates merged, 2 \
        isolated points left out, 1 point not finite left out";
    assert_eq!(report.to_string(), expected);
    assert_eq!(splats.positions, positions[..5000]);
}

#[test]
fn given_normals_stay_and_keep_the_sides_of_a_plate_apart() {
    let mut s = Surfaces(SplitMix(7));
    // A tenth of the distance between neighbors.
    let apart = 0.1 * (8.0_f64 / 10_000.0).sqrt();
    let samples = s.many(10_000, |s| s.plate(apart));
    let mut given = points(samples.iter().map(|s| s.0));
    let mut normals: Vec<Vec3> = samples.iter().map(|s| s.1.as_vec3()).collect();
    given.normals = Some(normals.clone());
    let (splats, report) = splats_from_points(given.clone(), &());
    assert_eq!(disks(&splats).0, normals);
    assert_eq!(report.to_string(), "10000 points: radii found from 12 neighbors each");
    // Not by disks of the other side.
    let upper: Vec<bool> = samples.iter().map(|s| s.1.z > 0.0).collect();
    let mut half = splats.clone();
    half.keep(&upper);
    let places: Vec<Sample> =
        s.many(20_000, |s| s.plate(apart)).into_iter().filter(|s| s.1.z > 0.0).collect();
    // At the very corners and borders there may be no point beyond.
    let inner: Vec<Sample> =
        places.into_iter().filter(|s| s.0.truncate().abs().max_element() < 0.95).collect();
    assert_eq!(holes(&half, &inner, 1.0), 0);
    // Some without a direction get it from the others.
    normals[17] = Vec3::ZERO;
    normals[18] = Vec3::NAN;
    given.normals = Some(normals);
    let (splats, report) = splats_from_points(given, &());
    assert_eq!(report.normals_from_file, 9998);
    assert!((17..19).all(|i| disks(&splats).0[i].is_normalized()));
}

#[test]
fn normals_face_the_viewpoint_where_there_is_one() {
    let mut s = Surfaces(SplitMix(8));
    // From inside.
    let samples = s.many(3000, Surfaces::sphere);
    let viewpoints = Viewpoint::of_all(3000, Some(0.2 * DVec3::X));
    let inside = Points { viewpoints, ..points(samples.iter().map(|s| s.0)) };
    let (splats, report) = splats_from_points(inside, &());
    assert!(report.around_scanner);
    assert_eq!(errors(&splats, &samples).1, 3000);
    // A sheet, the first third of which is seen from above and the rest from below; some are there twice.
    let at = |i: usize| DVec3::new((i % 60) as f64, (i / 60 % 49) as f64, 0.0);
    let viewpoints = [(1000, 5.0), (3000, -5.0)]
        .map(|(end, z)| Viewpoint { end, place: DVec3::new(500_000.0, 4_000_000.0, z) });
    let sheet = points((0..3000).map(|i| at(i) + DVec3::new(500_000.0, 4_000_000.0, 0.0)));
    let (splats, report) = splats_from_points(Points { viewpoints: viewpoints.into(), ..sheet }, &());
    assert_eq!(report.duplicates, 60);
    assert!(disks(&splats).0.iter().enumerate().all(|(i, n)| (n.z > 0.0) == (i < 1000)));
}
