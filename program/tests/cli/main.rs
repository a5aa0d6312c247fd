//! The program as its users meet it: what it writes, what it says, how it ends. Needs a Vulkan device, and fails
//! without one.

mod bench;
mod camera_words;
mod clip_planes;
mod compare;
mod convert;
mod counts;
mod dumps;
mod examples;
mod faults;
mod figure;
mod files;
mod film;
mod formats;
mod growth;
mod hard_files;
mod hierarchies;
mod hierarchies_in_scenes;
mod inputs;
#[path = "../../../tests/common/octree_files.rs"]
mod octree_files;
mod octrees;
mod orthographic;
mod outputs;
mod parts;
mod pick;
mod program;
mod refusals;
mod report;
mod scene_file;
mod seen;
mod selftest;
mod shown;
mod told;
mod unused;

use files::png;
use program::{Folder, counts_all_fragments, done, surfel};
use serde_json::Value;

const SMALL: [&str; 2] = ["--size", "64x64"];

#[test]
fn the_built_in_model_becomes_a_picture() {
    let folder = Folder::new();
    done(&folder, &["render", "--size", "64x48"]);
    assert_eq!(folder.names(), ["surfel.png"]);
    let picture = png(&folder.path("surfel.png"));
    assert_eq!((picture.size, picture.channels), ([64, 48], 3));
    // The corners are background, the middle is not.
    assert_eq!(picture.at(0, 0), [255, 255, 255]);
    assert_ne!(picture.at(32, 24), [255, 255, 255]);
}

#[test]
fn x_is_to_the_right_and_y_is_up() {
    let folder = Folder::new();
    // A large disk, and two small ones in front of it: one above its middle, one to the right of it.
    folder.write(
        "a.ply",
        splats("0 0 0 0 0 1 1 0 0 255\n0 0.5 0.1 0 0 1 0.2 255 0 0\n0.5 0 0.1 0 0 1 0.2 0 255 0\n"),
    );
    done(
        &folder,
        &["render", "a.ply", "-o", "a.png", "--shading", "albedo", "--epsilon", "0.01", SMALL[0], SMALL[1]],
    );
    let picture = png(&folder.path("a.png"));
    let ball = 1.05 * 32.0;
    let (half, quarter) = (32, (32.0 * 0.5 * 32.0 / ball) as u32);
    assert_eq!(picture.at(half, half), [0, 0, 255]);
    assert_eq!(picture.at(half, half - quarter), [255, 0, 0], "+y is up");
    assert_eq!(picture.at(half + quarter, half), [0, 255, 0], "+x is to the right");
}

#[test]
fn several_inputs_are_one_scene() {
    let folder = Folder::new();
    folder.write("left.ply", splats("-1 0 0 0 0 1 0.5 255 0 0\n"));
    folder.write("right.obj", "v 0.5 -0.5 0\nv 1.5 -0.5 0\nv 1 0.5 0\nf 1 2 3\n");
    let words =
        ["render", "left.ply", "right.obj", "-o", "a.png", "--shading", "albedo", "--background", "none"];
    let run = done(&folder, &[&words[..], &SMALL].concat());
    assert!(run.stderr.contains("left.ply: 1 disk\n"), "{}", run.stderr);
    assert!(run.stderr.contains("right.obj: 3 vertices, 1 triangle: open"), "{}", run.stderr);
    let picture = png(&folder.path("a.png"));
    assert_eq!(picture.channels, 4);
    let has = |color: [u8; 4]| picture.pixels.chunks_exact(4).filter(|pixel| **pixel == color).count();
    assert!(has([255, 0, 0, 255]) > 20 && has([204, 204, 204, 255]) > 20);
    // Without a background, what is empty is transparent.
    assert!(has([0, 0, 0, 0]) > 500);
}

#[test]
fn a_camera_file_says_the_same_as_the_options() {
    let folder = Folder::new();
    folder.write("cam.json", r#"{"eye":[1,2,3], "target":[0,0.25,0], "up":[0,0,1], "fov_deg":50}"#);
    let options = ["--eye", "1,2,3", "--target", "0,0.25,0", "--up", "0,0,1", "--fov", "50"];
    for (output, words) in [("a.png", &["--camera", "cam.json"][..]), ("b.png", &options)] {
        done(&folder, &[&["render", "-o", output, SMALL[0], SMALL[1]], words].concat());
    }
    let (a, b) = (png(&folder.path("a.png")), png(&folder.path("b.png")));
    assert_eq!(a.pixels, b.pixels);
    surfel(&folder, &["render", "-o", "c.png", SMALL[0], SMALL[1]]);
    assert_ne!(png(&folder.path("c.png")).pixels, a.pixels);
}

#[test]
fn timings_hold_all_that_explains_a_measurement() {
    let folder = Folder::new();
    let words =
        ["render", SMALL[0], SMALL[1], "--rasterizer", "perspective", "--frames", "3", "--timings", "t.json"];
    let run = done(&folder, &[&words[..], &["--explain"]].concat());
    let json = folder.json("t.json");
    assert_eq!(json["surfel"], env!("CARGO_PKG_VERSION"));
    for field in ["name", "driver", "api_version"] {
        assert!(json["device"][field].as_str().is_some_and(|text| !text.is_empty()), "{field}");
    }
    assert!(
        json["device"]["timestamp_period_ns"].is_f64() && json["device"]["timestamp_valid_bits"].is_u64()
    );
    assert_eq!(json["settings"]["size"], "64x64");
    assert_eq!(json["settings"]["kernel"], "gaussian:0.5");
    assert_eq!(json["camera"]["fov_deg"], 45.0);
    assert!(json["camera"]["near"].as_f64().unwrap() > 0.0);
    assert_eq!((&json["scene"]["splats"], &json["scene"]["dropped"]), (&150_000.into(), &0.into()));
    assert!(
        json["scene"]["splat_bytes"].as_u64() > Some(150_000) && json["scene"]["transient_bytes"].is_u64()
    );
    let steps = json["steps"].as_array().unwrap();
    assert!(steps.len() >= 4 && steps.iter().all(|step| step["secs"].as_f64().unwrap() >= 0.0), "{steps:?}");

    let frames = &json["frames"];
    assert_eq!((&frames["warm_up_frames"], &frames["timed_frames"]), (&2.into(), &3.into()));
    let passes = frames["passes"].as_array().unwrap();
    let names: Vec<_> = passes.iter().map(|pass| pass["name"].as_str().unwrap()).collect();
    // Nothing is read back in frames that are timed.
    assert_eq!(names, ["visibility", "accumulate", "finalize"]);
    let ordered = |spread: &Value| {
        let [min, median, max] = ["min", "median", "max"].map(|figure| spread[figure].as_f64().unwrap());
        assert!(0.0 <= min && min <= median && median <= max, "{spread}");
        median
    };
    if json["device"]["timestamp_valid_bits"] != 0 {
        let sum: f64 = passes.iter().map(|pass| ordered(&pass["ms"])).sum();
        assert!(sum > 0.0);
        assert!(ordered(&frames["frame_ms"]) > 0.0);
        assert!(ordered(&frames["sum_of_passes_ms"]) > 0.0);
    }
    assert!(ordered(&frames["submit_to_wait_ms"]) > 0.0);
    if passes[0]["vertices"].is_u64() {
        assert_eq!((&passes[0]["vertices"], &passes[1]["vertices"]), (&150_000.into(), &150_000.into()));
        // Where nothing is seen, an early depth test fails.
        let least = if counts_all_fragments(&json) { 64 * 64 } else { 1 };
        assert!(passes[2]["fragments"].as_u64() >= Some(least));
    }
    assert!(frames["flags"].is_array());
    // People see the same, and why.
    for text in ["median ms", "accumulate", "submission to end of wait", "pipelines: 3", "every scene"] {
        assert!(run.stdout.contains(text), "'{text}' is not in\n{}", run.stdout);
    }
}

#[test]
fn info_names_the_device_that_renders() {
    let folder = Folder::new();
    let run = done(&folder, &["info"]);
    let json: Value = serde_json::from_str(&surfel(&folder, &["info", "--json"]).stdout).unwrap();
    let device = json["devices"].as_array().unwrap().iter().find(|device| device["default"] == true).unwrap();
    let name = device["name"].as_str().unwrap();
    println!("device: {name} ({})", device["driver"]);
    assert!(run.stdout.contains(&format!("{name} (the default)")), "{}", run.stdout);
    assert!(
        device["refused"].as_array().unwrap().is_empty() && device["max_image_side_px"].as_u64() > Some(4000)
    );
    let timed = surfel(&folder, &["render", SMALL[0], SMALL[1], "--frames", "1", "--device", name]);
    assert!(timed.code == 0 && timed.stdout.starts_with(name), "{}", timed.stdout);
}

#[test]
fn a_run_under_validation_is_silent() {
    let folder = Folder::new();
    let words =
        ["render", SMALL[0], SMALL[1], "--validate", "--timings", "t.json", "--dump", "d", "--explain"];
    let run = done(&folder, &words);
    assert!(run.stderr.contains("validation: no message"), "{}", run.stderr);
}

#[test]
fn the_manual_is_complete_and_plain() {
    let folder = Folder::new();
    let subcommands = [
        "view",
        "render",
        "reference",
        "compare",
        "convert",
        "figure",
        "bench",
        "report",
        "selftest",
        "info",
    ];
    let helps = subcommands.map(|subcommand| vec![subcommand, "--help"]);
    for words in [vec!["--help"]].iter().chain(&helps) {
        let run = surfel(&folder, words);
        assert!(run.code == 0 && run.stderr.is_empty(), "{}", run.stderr);
        assert!(run.stdout.contains("Usage: surfel") && !run.stdout.contains('\u{1b}'), "{}", run.stdout);
    }
    let render = surfel(&folder, &["render", "--help"]).stdout;
    for text in
        ["pixels", "degrees", "[default: 1024x1024]", "Examples:", "surfel render igea.ply", "fov_deg"]
    {
        assert!(render.contains(text), "'{text}' is not in\n{render}");
    }
    let version = surfel(&folder, &["--version"]);
    assert_eq!((version.code, version.stdout.trim()), (0, concat!("surfel ", env!("CARGO_PKG_VERSION"))));
}

/// A PLY of disks: position, normal, radius, red, green, blue a line.
fn splats(lines: &str) -> String {
    let count = lines.lines().count();
    let property = |name: &str| format!("property float {name}\n");
    let floats: String = ["x", "y", "z", "nx", "ny", "nz", "radius"].map(property).concat();
    let colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    format!("ply\nformat ascii 1.0\nelement vertex {count}\n{floats}{colors}end_header\n{lines}")
}

#[test]
fn passes_without_draws_are_no_reason_for_a_flag() {
    let folder = Folder::new();
    // So near that large splats are listed in compute passes.
    let view = ["--eye", "0,0,0.2", "--target", "0,0,3", "--rasterizer", "perspective"];
    let timed = ["--timings", "t.json", "--frames", "2"];
    let words = [&["render"], &SMALL[..], &view, &timed].concat();
    done(&folder, &words);
    let report = folder.json("t.json");
    let passes = report["frames"]["passes"].as_array().unwrap();
    assert!(passes.iter().any(|pass| pass["name"] == "mark large splats" && pass["fragments"].is_null()));
    assert!(!report["frames"]["flags"].to_string().contains("not counted"), "{}", report["frames"]["flags"]);
}
