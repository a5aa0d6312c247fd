//! COPC and Potree 2: a view reads the nodes that it needs, `--lod 0` all of them, and what is drawn is what is drawn of all points.

use std::fs;

use surfel::math::random::SplitMix;

use super::{
    files::png,
    octree_files::{CloudPoint, OFFSET, Octree, SCALE},
    program::{Folder, done, surfel},
};

const FILES: [&str; 2] = ["a.copc.laz", "metadata.json"];

/// Points evenly over a wave of 60 m by 60 m, in soft colors.
fn cloud(count: usize) -> Vec<CloudPoint> {
    let mut random = SplitMix(5);
    let point = |_| {
        let (x, y) = (60.0 * random.unit(), 60.0 * random.unit());
        let z = 4.0 + 2.0 * (0.3 * x).sin() * (0.2 * y).cos();
        let color = [0.4 + 0.3 * (0.4 * x).sin(), 0.5, 0.4 + 0.3 * (0.5 * y).sin()];
        ([x, y, z].map(|at| (at / SCALE) as i32), color.map(|value| (65535.0 * value) as u16))
    };
    (0..count).map(point).collect()
}

/// A folder with both files of a cloud.
pub fn folder(count: usize) -> Folder {
    let folder = Folder::new();
    write(&folder, &Octree::of(&cloud(count), [0; 3], 1 << 16, 32), 3);
    folder
}

/// Writes both files of an octree, with what lies beside.
fn write(folder: &Folder, octree: &Octree, page_levels: i32) {
    folder.write(FILES[0], octree.copc(page_levels).0);
    let [metadata, hierarchy, nodes] = octree.potree(page_levels);
    folder.write(FILES[1], metadata);
    folder.write("hierarchy.bin", hierarchy);
    folder.write("octree.bin", nodes);
}

/// A camera this far from a place, which looks down and a little north.
fn camera(x: f64, y: f64, distance: f64) -> [String; 6] {
    let at = |[x, y, z]: [f64; 3]| format!("{},{},{}", OFFSET[0] + x, OFFSET[1] + y, OFFSET[2] + z);
    let eye = at([x, y - 0.4 * distance, 4.0 + 0.9 * distance]);
    ["--eye", &eye, "--target", &at([x, y, 4.0]), "--up", "z"].map(str::to_owned)
}

fn picture(folder: &Folder, camera: &[String; 6], arguments: &[&str]) -> (Vec<u8>, String) {
    let camera = camera.iter().map(String::as_str).collect::<Vec<_>>();
    let size = ["render", "-o", "picture.png", "--size", "160x120"];
    let drawn = done(folder, &[&size[..], &camera, arguments].concat());
    (png(&folder.path("picture.png")).pixels, drawn.stderr + &drawn.stdout)
}

/// Root of the mean squared difference, in 255 steps.
fn rms(a: &[u8], b: &[u8]) -> f64 {
    assert_eq!(a.len(), b.len());
    let squares = a.iter().zip(b).map(|(a, b)| f64::from(a.abs_diff(*b)).powi(2));
    (squares.sum::<f64>() / a.len() as f64).sqrt()
}

/// The same, but for what is within so many pixels of the surface's outline in the first: disks of a coarser level reach as much farther beyond the last points.
fn rms_off_edges(a: &[u8], b: &[u8], away: usize) -> f64 {
    let (width, height) = (160, 120);
    let is_covered = |x: usize, y: usize| a[3 * (y * width + x)..][..3] != [255; 3];
    let is_off = |x: usize, y: usize| {
        let near = || (y - away..=y + away).flat_map(|y| (x - away..=x + away).map(move |x| (x, y)));
        near().all(|(x, y)| is_covered(x, y)) || near().all(|(x, y)| !is_covered(x, y))
    };
    let (mut of_a, mut of_b) = (Vec::new(), Vec::new());
    for y in away..height - away {
        for x in (away..width - away).filter(|x| is_off(*x, y)) {
            let at = 3 * (y * width + x);
            of_a.extend(&a[at..at + 3]);
            of_b.extend(&b[at..at + 3]);
        }
    }
    assert!(of_a.len() > 3 * 5000);
    rms(&of_a, &of_b)
}

/// How many points of how many were read.
fn points_read(told: &str) -> (u64, u64) {
    let words = told.split_once(" nodes, ").unwrap().1.split_once(" points, ").unwrap().0;
    let (read, all) = words.split_once(" of ").unwrap();
    (read.parse().unwrap(), all.parse().unwrap())
}

#[test]
fn a_view_reads_a_share_of_the_file_and_shows_what_all_points_show() {
    let folder = folder(200_000);
    done(&folder, &["convert", "a.copc.laz", "flat.ply"]);
    for (name, camera, coarse) in
        [("near", camera(12.0, 14.0, 4.0), "40px"), ("far", camera(30.0, 30.0, 120.0), "6px")]
    {
        let (whole, _) = picture(&folder, &camera, &["flat.ply"]);
        for file in FILES {
            let (all, told) = picture(&folder, &camera, &[file, "--lod", "0"]);
            assert_eq!(points_read(&told), (200_000, 200_000), "{told}");
            let exact = rms(&all, &whole);
            let (default, told) = picture(&folder, &camera, &[file]);
            let (read, all) = points_read(&told);
            let error = rms_off_edges(&whole, &default, 4);
            println!(
                "{name}, {file}: {read} of {all} points, {error:.2} of 255 from all, those {exact:.3} from the flat file"
            );
            assert!(5 * read < all, "{name}, {file}: {told}");
            assert!(exact < 0.1 && error < 2.0, "{name}, {file}: {exact}, {error}");
            let (coarse, told) = picture(&folder, &camera, &[file, "--lod", coarse]);
            assert!(points_read(&told).0 * 3 < read * 2, "{told}");
            assert!(rms(&coarse, &whole) > rms(&default, &whole), "{name}, {file}");
        }
    }
}

#[test]
fn memory_budgets_films_and_refusals_of_octrees() {
    let folder = folder(60_000);
    let camera = camera(30.0, 30.0, 60.0);
    let (_, told) = picture(&folder, &camera, &["a.copc.laz", "--lod", "0.1px"]);
    let (of_all, _) = points_read(&told);
    let (_, told) = picture(&folder, &camera, &["a.copc.laz", "--lod", "0.1px", "--budget-memory", "3MB"]);
    let (within, _) = points_read(&told);
    assert!(within <= 10_000 && within < of_all && within > 2000, "{told}");
    assert!(
        told.contains("a.copc.laz: --budget-memory does not suffice for --lod 0.100px: read for --lod "),
        "{told}"
    );
    // Two files share it.
    let both = ["a.copc.laz", "metadata.json", "--lod", "0.1px", "--budget-memory", "3MB"];
    let (_, told) = picture(&folder, &camera, &both);
    let reads = told.lines().filter(|line| line.contains(" nodes, ")).map(|line| points_read(line).0);
    assert!(reads.clone().count() == 2 && reads.sum::<u64>() <= 10_000, "{told}");
    // A budget of splats has enough to choose from.
    let (_, told) = picture(&folder, &camera, &["metadata.json", "--budget", "30k"]);
    assert!(points_read(&told).0 >= 30_000, "{told}");
    // Compressed nodes are the same points.
    fs::create_dir(folder.path("packed")).unwrap();
    let packed = Octree::of(&cloud(60_000), [0; 3], 1 << 16, 32).packed_potree(3);
    for (name, bytes) in ["metadata.json", "hierarchy.bin", "octree.bin"].iter().zip(packed) {
        folder.write(&format!("packed/{name}"), bytes);
    }
    let drawn = |file| picture(&folder, &camera, &[file, "--lod", "0.5px"]).0;
    assert!(drawn("packed/metadata.json") == drawn("metadata.json"));
    let film = ["metadata.json", "--turntable", "1", "--frames", "3", "--size", "40x40", "-o", "f%d.png"];
    let said = done(&folder, &[&["render"], &film[..]].concat()).stderr;
    assert_eq!(said.matches(" nodes, ").count(), 3, "{said}");
    assert!(png(&folder.path("f0.png")).pixels != png(&folder.path("f1.png")).pixels);
    let refused = |arguments: &[&str], words: &str| {
        let run = surfel(&folder, arguments);
        assert!(run.code == 1 && run.stderr.contains(words), "{}", run.stderr);
    };
    refused(&["render", "a.copc.laz", "--representation", "mesh"], "the file holds points; expected a mesh");
    let metadata = fs::read_to_string(folder.path("metadata.json")).unwrap();
    folder.write("metadata.json", metadata.replace("DEFAULT", "ZIP"));
    let words = "metadata.json: encoding: 'ZIP'; expected DEFAULT, UNCOMPRESSED or BROTLI";
    refused(&["render", "metadata.json"], words);
    refused(&["convert", "metadata.json", "b.ply"], words);
}

#[test]
fn what_octrees_hold_is_told_and_all_of_it_converted() {
    let folder = folder(20_000);
    for file in FILES {
        let told = done(&folder, &["info", file]).stdout;
        for words in ["20000 points", "level     0: ", " nodes, by ", "up        0,0,1", "2.048 apart"] {
            assert!(told.contains(words), "{file}: {words}: {told}");
        }
        let json = done(&folder, &["info", file, "--json"]).stdout;
        let info: serde_json::Value = serde_json::from_str(&json).unwrap();
        let levels = &info["drawn"][0]["octree"]["levels"];
        let points = levels.as_array().unwrap().iter().map(|level| level["points"].as_u64().unwrap());
        assert_eq!(points.sum::<u64>(), 20_000, "{levels}");
        done(&folder, &["convert", file, "a.surfel"]);
        let told = done(&folder, &["info", "a.surfel"]).stdout;
        assert!(told.contains(" splats of a.surfel"), "{told}");
    }
}

/// Well-known text of a coordinate system: degrees, or feet.
const DEGREES: &str =
    r#"GEOGCS["WGS 84",DATUM["d",SPHEROID["s",6378137,298.2]],UNIT["degree",0.0174532925]]"#;
const FEET: &str = r#"PROJCS["p",GEOGCS["g",UNIT["degree",0.0174532925]],UNIT["foot",0.3048]]"#;

#[test]
fn copc_of_degrees_becomes_lengths_and_others_tell_their_unit() {
    let folder = Folder::new();
    let feet = Octree { text: FEET, ..Octree::of(&cloud(5000), [0; 3], 1 << 16, 32) };
    folder.write("feet.copc.laz", feet.copc(3).0);
    let told = done(&folder, &["info", "feet.copc.laz"]).stdout;
    assert!(told.contains("unit      0.3048 m") && told.contains("nodes, by "), "{told}");
    // Steps of a hundred-thousandth of a degree, some 0.8 m and 1.1 m, and of a metre: a wave on a square of 47 km by 67 km.
    let mut degrees = Octree { text: DEGREES, ..feet }.copc(3).0;
    for (axis, (scale, offset)) in [(1e-5, 11.0), (1e-5, 46.7), (1.0, 0.0)].into_iter().enumerate() {
        for (at, number) in [(131, scale), (155, offset)] {
            degrees[at + 8 * axis..][..8].copy_from_slice(&f64::to_le_bytes(number));
        }
    }
    folder.write("degrees.copc.laz", degrees);
    let told = done(&folder, &["info", "degrees.copc.laz", "--json"]).stdout;
    let info: serde_json::Value = serde_json::from_str(&told).unwrap();
    let bounds = &info["inputs"][0]["model"]["bounds"];
    let extent = [0, 1].map(|axis| bounds[1][axis].as_f64().unwrap() - bounds[0][axis].as_f64().unwrap());
    let expected = [0.6 * 76_000.0, 0.6 * 111_170.0];
    assert!(extent.iter().zip(expected).all(|(a, b)| (a / b - 1.0).abs() < 0.01), "{bounds}");
    assert_eq!(
        (&info["inputs"][0]["model"]["metres_per_unit"], &info["up"][0][2]),
        (&1.0.into(), &1.0.into())
    );
    let told = done(&folder, &["render", "degrees.copc.laz", "-o", "a.png", "--size", "160x120"]).stderr;
    assert!(told.contains("5000 longitudes and latitudes, by metres east and north of 11.29"), "{told}");
    let covered = png(&folder.path("a.png")).pixels.chunks_exact(3).filter(|p| *p != [255; 3]).count();
    assert!(covered > 2000, "{covered}");
}

/// `cargo test --release --test cli octrees::figures -- --ignored --nocapture`
#[test]
#[ignore = "figures: minutes"]
fn figures_of_one_view_of_ever_more_points() {
    for squares in [1, 2, 3] {
        // Squares of 60 m by 60 m beside each other: the same view, ever more around it.
        let square = cloud(1_000_000);
        let mut points = Vec::new();
        for i in 0..squares * squares {
            let step = |at: i32| at * (60.0 / SCALE) as i32;
            let moved = |([x, y, z], color): &CloudPoint| {
                ([x + step(i % squares), y + step(i / squares), *z], *color)
            };
            points.extend(square.iter().map(moved));
        }
        let folder = Folder::new();
        write(&folder, &Octree::of(&points, [0; 3], (1 << 16) * squares, 64), 4);
        drop(points);
        for file in FILES {
            let camera = camera(25.0, 25.0, 6.0);
            let begun = std::time::Instant::now();
            let (_, told) = picture(&folder, &camera, &[file]);
            let secs = begun.elapsed().as_secs_f64();
            let bytes = fs::metadata(folder.path(file)).unwrap().len();
            let (read, all) = points_read(&told);
            println!("{file} of {bytes} bytes: {secs:.2} s for {read} of {all} points");
        }
    }
}
