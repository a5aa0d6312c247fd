//! The faults that users meet first: each ends with its exit code and one clear line, and leaves nothing behind.

use std::fs;

use super::program::{Folder, Run, surfel, surfel_with};

/// A folder with files that are all right.
fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("good.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder
}

/// The program said one line with these words, ended with this code, and left the folder as it was.
fn assert_refused(folder: &Folder, run: &Run, code: i32, words: &[&str], before: &[String]) {
    let line = run.stderr.strip_suffix('\n').unwrap_or(&run.stderr);
    assert!(!line.contains('\n') && line.starts_with("surfel: "), "not one line:\n{}", run.stderr);
    for word in words {
        assert!(line.contains(word), "'{word}' is not in: {line}");
    }
    assert_eq!(run.code, code, "{line}");
    assert_eq!(run.stdout, "");
    assert_eq!(folder.names(), before, "{line}");
}

fn refused(folder: &Folder, arguments: &[&str], code: i32, words: &[&str]) {
    let before = folder.names();
    assert_refused(folder, &surfel(folder, arguments), code, words, &before);
}

#[test]
fn a_missing_file() {
    for subcommand in ["render", "reference"] {
        refused(&folder(), &[subcommand, "none.ply"], 1, &["none.ply: cannot read: No such file"]);
    }
}

#[test]
fn an_empty_file() {
    let folder = folder();
    folder.write("empty.ply", "");
    refused(
        &folder,
        &["render", "empty.ply"],
        1,
        &["empty.ply: the file is empty; expected a PLY, OBJ, STL"],
    );
}

#[test]
fn a_truncated_body() {
    let folder = folder();
    let header = "ply\nformat binary_little_endian 1.0\nelement vertex 100\nproperty float x\nproperty float y\n\
        property float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty float radius\nend_header\n";
    folder.write("cut.ply", [header.as_bytes(), &[0; 1000]].concat());
    refused(&folder, &["render", "cut.ply"], 1, &["cut.ply: ", "vertex", "100"]);
    folder.write("cut2.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n");
    refused(&folder, &["render", "cut2.ply"], 1, &["cut2.ply: "]);
}

#[test]
fn an_unknown_option_and_a_missing_one() {
    let folder = folder();
    let words =
        ["unexpected argument '--sise'", "similar argument exists: '--size'", "see surfel render --help"];
    refused(&folder, &["render", "--sise", "9x9"], 1, &words);
    // Options of the device have no meaning for the reference.
    for option in
        ["--device", "--frames", "--timings", "--validate", "--explain", "--order", "--splat-format"]
    {
        refused(&folder, &["reference", option, "1"], 1, &[&format!("unexpected argument '{option}'")]);
    }
    refused(&folder, &["paint"], 1, &["unrecognized subcommand 'paint'", "see surfel --help"]);
    refused(
        &folder,
        &["render", "--rasterizer", "voxels"],
        1,
        &["'voxels'", "possible values: auto, perspective"],
    );
    refused(&folder, &["render", "--output"], 1, &["a value is required for '--output <FILE>'"]);
    assert_eq!(surfel(&folder, &[]).code, 1);
}

#[test]
fn sizes_that_cannot_be() {
    let folder = folder();
    for subcommand in ["render", "reference"] {
        for size in ["0x0", "0x64", "64x0"] {
            refused(&folder, &[subcommand, "--size", size], 1, &["--size", size, "expected 1 to"]);
        }
    }
    refused(&folder, &["render", "--size", "100000x100000"], 1, &["--size", "100000x100000"]);
    // The device's own limit, one beyond it.
    let info: serde_json::Value = serde_json::from_str(&surfel(&folder, &["info", "--json"]).stdout).unwrap();
    let default =
        info["devices"].as_array().unwrap().iter().find(|device| device["default"] == true).unwrap();
    let side = default["max_image_side_px"].as_u64().unwrap();
    if side < 65_536 {
        let largest = format!("{side}x1");
        let run = surfel(&folder, &["render", "good.obj", "--size", &largest, "-o", "wide.png"]);
        assert_eq!(run.code, 0, "{}", run.stderr);
        let size = format!("{}x8", side + 1);
        let words = ["--size", &size, "draws at most", default["name"].as_str().unwrap()];
        refused(&folder, &["render", "--size", &size], 1, &words);
    }
    refused(&folder, &["render", "--size", "-5x5"], 1, &["-5"]);
}

#[test]
fn values_that_cannot_be() {
    let folder = folder();
    for (option, value, words) in [
        ("--kernel", "gaussian:0", ["--kernel", "above 0"]),
        ("--kernel", "gaussian:NaN", ["--kernel", "NaN"]),
        ("--epsilon", "-1r", ["--epsilon", "at least 0"]),
        ("--background", "0,0,2", ["--background", "0 to 1"]),
        ("--fov", "180", ["--fov", "above 1e-10 and below 180"]),
        ("--eye", "1,2", ["--eye", "three numbers"]),
        ("--frames", "0", ["--frames", "expected a whole number, 1 to 100000"]),
    ] {
        refused(&folder, &["render", "good.obj", option, value], 1, &words);
    }
}

#[test]
fn outputs_that_cannot_be_written() {
    let folder = folder();
    fs::create_dir(folder.path("is-folder.png")).unwrap();
    for subcommand in ["render", "reference"] {
        for (output, words) in [
            ("none/a.png", "none/a.png: cannot write: there is no folder none"),
            ("good.obj/a.png", "good.obj/a.png: cannot write: there is no folder good.obj"),
            ("is-folder.png", "is-folder.png: cannot write: is a directory"),
            ("a.jpg", "a.jpg: expected a name in .png or .exr"),
            ("a", "a: expected a name in .png or .exr"),
        ] {
            // Found before the work: an input that is not even there is not looked at.
            refused(&folder, &[subcommand, "none.ply", "-o", output], 1, &[words]);
        }
        refused(
            &folder,
            &[subcommand, "--dump", "good.obj"],
            1,
            &["good.obj: cannot write: Not a directory"],
        );
        refused(&folder, &[subcommand, "--dump", "good.obj/in"], 1, &["good.obj/in: cannot write"]);
    }
    refused(&folder, &["render", "--timings", "none/t.json"], 1, &["none/t.json: cannot write"]);
    #[cfg(unix)]
    refused(
        &folder,
        &["render", "--timings", "/dev/null"],
        1,
        &["/dev/null: cannot write: not a regular file"],
    );
}

#[test]
fn an_output_that_is_an_input() {
    let folder = folder();
    let before = fs::read(folder.path("good.obj")).unwrap();
    refused(&folder, &["render", "good.obj", "--timings", "./good.obj"], 1, &["./good.obj: is an input"]);
    refused(
        &folder,
        &["render", "-o", "a.png", "--timings", "a.png"],
        1,
        &["a.png: is an input, or written twice"],
    );
    assert_eq!(fs::read(folder.path("good.obj")).unwrap(), before);
}

#[test]
fn a_camera_file_with_an_unknown_key() {
    let folder = folder();
    folder.write("cam.json", "{\"eye\":[0,0,3],\n\"target\":[0,0,0], \"up\":[0,1,0], \"fov\":45}");
    let words = ["cam.json: line 2, column ", "unknown field `fov`", "`fov_deg`"];
    refused(&folder, &["render", "--camera", "cam.json"], 1, &words);
    refused(&folder, &["render", "--camera", "none.json"], 1, &["none.json: cannot read: No such file"]);
}

#[test]
fn no_vulkan_device() {
    let folder = folder();
    let before = folder.names();
    let nowhere = [("VK_DRIVER_FILES", "/nonexistent"), ("VK_ICD_FILENAMES", "/nonexistent")];
    for arguments in [&["render"][..], &["render", "good.obj"], &["info"], &["render", "--validate"]] {
        let run = surfel_with(&folder, arguments, &nowhere);
        assert_refused(&folder, &run, 2, &["no Vulkan device can be used", "VK_DRIVER_FILES"], &before);
    }
    // The reference needs none.
    let run = surfel_with(&folder, &["reference", "good.obj", "--size", "16x16"], &nowhere);
    assert_eq!(run.code, 0, "{}", run.stderr);
}

#[test]
fn a_device_of_another_name() {
    refused(
        &folder(),
        &["render", "--device", "no such device"],
        1,
        &["--device: 'no such device' is none of: 0 "],
    );
}

#[test]
fn a_dump_that_would_replace_the_picture_or_the_timings() {
    let folder = folder();
    let picture = ["render", "--size", "8x8", "--dump", "d", "-o", "d/final.exr"];
    std::fs::create_dir(folder.path("d")).unwrap();
    refused(&folder, &picture, 1, &["final.exr", "written twice"]);
    let timings = ["render", "--size", "8x8", "--dump", "d", "--timings", "d/weight.exr"];
    refused(&folder, &timings, 1, &["weight.exr", "written twice"]);
    std::fs::create_dir(folder.path("d/depth.exr")).unwrap();
    refused(&folder, &["render", "--size", "8x8", "--dump", "d"], 1, &["depth.exr"]);
}

#[test]
#[cfg(target_os = "linux")]
fn a_standard_output_that_is_full() {
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let run =
        std::process::Command::new(env!("CARGO_BIN_EXE_surfel")).arg("info").stdout(full).output().unwrap();
    assert_eq!(run.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&run.stderr).starts_with("surfel: standard output: cannot write"));
}
