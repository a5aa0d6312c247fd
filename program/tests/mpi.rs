//! `mpirun -n N surfel render a.surfel`: the picture of one process, whatever the number of processes. Needs the feature `mpi`, Open MPI's `mpirun` and
//! a Vulkan device, and fails without them.

use std::{
    path::Path,
    process::{Command, Output},
};

/// So many processes, on any machine, whoever the user is.
fn ranks(count: u32, folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new("mpirun");
    command.args(["--oversubscribe", "-n", &count.to_string(), env!("CARGO_BIN_EXE_surfel")]);
    command.args(arguments).current_dir(folder).env("XDG_CACHE_HOME", folder);
    command.env("OMPI_ALLOW_RUN_AS_ROOT", "1").env("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
    command.output().expect("mpirun, as third_party/with-deps --mpi installs it")
}

fn alone(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_surfel"));
    command.args(arguments).current_dir(folder).env("XDG_CACHE_HOME", folder).output().unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned() + &String::from_utf8_lossy(&output.stdout)
}

fn pixels(folder: &Path, name: &str) -> Vec<u8> {
    image::open(folder.join(name)).unwrap().to_rgb8().into_raw()
}

const CORNERS: [[i32; 3]; 6] = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, 0, 0], [0, -1, 0], [0, 0, -1]];
const SIDES: [[u32; 3]; 8] =
    [[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];

/// A closed surface.
fn octahedron() -> String {
    let corners: String = CORNERS.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n")).collect();
    let sides = SIDES.map(|side| side.map(|corner| corner + 1));
    corners + &sides.map(|[a, b, c]| format!("f {a} {b} {c}\n")).concat()
}

/// A larger one, through which one sees.
fn glass() -> String {
    let axes = ["x", "y", "z"].map(|axis| format!("property float {axis}\n")).concat();
    let channels = ["red", "green", "blue", "alpha"].map(|of| format!("property uchar {of}\n")).concat();
    let corners = CORNERS.map(|at| at.map(|at| 1.3 * f64::from(at)));
    let corners = corners.map(|[x, y, z]| format!("{x} {y} {z} 230 128 51 102\n")).concat();
    let sides = SIDES.map(|[a, b, c]| format!("3 {a} {b} {c}\n")).concat();
    format!(
        "ply\nformat ascii 1.0\nelement vertex 6\n{axes}{channels}element face 8\n\
         property list uchar int vertex_indices\nend_header\n{corners}{sides}"
    )
}

/// A folder with a closed surface of some splats, `a.surfel`.
fn folder() -> temp_dir::TempDir {
    let folder = temp_dir::TempDir::new().unwrap();
    std::fs::write(folder.path().join("a.obj"), octahedron()).unwrap();
    let done = alone(folder.path(), &["convert", "a.obj", "a.surfel", "--resample", "120k"]);
    assert!(done.status.success(), "{}", said(&done));
    folder
}

#[test]
fn one_two_and_four_processes_make_one_picture() {
    let folder = folder();
    let folder = folder.path();
    let options =
        |file| ["render", "a.surfel", "--size", "160x120", "--edges", "hard", "--lod", "1px", "-o", file];
    assert!(alone(folder, &options("one.png")).status.success());
    let truth = pixels(folder, "one.png");
    for count in [1, 2, 4] {
        let done = ranks(count, folder, &[&options("some.png")[..], &["--frames", "2"]].concat());
        let text = said(&done);
        assert!(done.status.success(), "{count}: {text}");
        // One of them speaks, and tells what was moved: 4 and 32 bytes a pixel.
        assert_eq!(text.matches("wrote some.png").count(), 1, "{text}");
        for words in ["see: ", "Allreduce of depth: ", ", 76800 bytes", "Reduce of sums: ", ", 614400 bytes"]
        {
            assert!(text.contains(words), "{words}: {text}");
        }
        let found = pixels(folder, "some.png");
        let differ = found.iter().zip(&truth).filter(|(a, b)| a.abs_diff(**b) > 1).count();
        println!("{count}: {differ} of {} bytes differ by more than 1", truth.len());
        // A splat more or less at a rim or at ε, by rounding.
        assert!(differ * 1000 <= truth.len(), "{count}: {differ}");
    }
}

/// Transparent splats of a file, some of which each process has, before and behind opaque ones of another file: layer by layer.
#[test]
fn several_processes_peel_layers_together() {
    let folder = folder();
    let folder = folder.path();
    std::fs::write(folder.join("glass.ply"), glass()).unwrap();
    let done = alone(folder, &["convert", "glass.ply", "glass.surfel", "--resample", "60k"]);
    assert!(done.status.success(), "{}", said(&done));
    let options = |layers, file| {
        let always = ["render", "a.surfel", "glass.surfel", "--size", "160x120", "--edges", "hard"];
        [&always[..], &["--lod", "1px", "--layers", layers, "-o", file]].concat()
    };
    // One file twice, larger and transparent the second time, as objects of a scene file.
    let scene =
        "[[object]]\nfile = \"a.surfel\"\n[[object]]\nfile = \"a.surfel\"\nscale = 1.3\nalpha = 0.4\n";
    std::fs::write(folder.join("both.toml"), scene).unwrap();
    let of_scene =
        |file| ["render", "both.toml", "--size", "160x120", "--edges", "hard", "--lod", "1px", "-o", file];
    assert!(alone(folder, &of_scene("one.png")).status.success());
    let done = ranks(2, folder, &of_scene("some.png"));
    assert!(done.status.success(), "{}", said(&done));
    let (found, truth) = (pixels(folder, "some.png"), pixels(folder, "one.png"));
    let differ = found.iter().zip(&truth).filter(|(a, b)| a.abs_diff(**b) > 1).count();
    println!("scene file: {differ}");
    assert!(differ * 1000 <= truth.len(), "{differ}");
    for (layers, count) in [("auto:8", 1), ("auto:8", 3), ("2", 2)] {
        assert!(alone(folder, &options(layers, "one.png")).status.success());
        let truth = pixels(folder, "one.png");
        let done = ranks(count, folder, &[&options(layers, "some.png")[..], &["--frames", "1"]].concat());
        let text = said(&done);
        assert!(done.status.success() && text.contains("compose layers: "), "{layers}, {count}: {text}");
        let found = pixels(folder, "some.png");
        let differ = found.iter().zip(&truth).filter(|(a, b)| a.abs_diff(**b) > 1).count();
        println!("{layers}, {count}: {differ} of {} bytes differ by more than 1", truth.len());
        // As of opaque splats: a splat more or less at a rim or at ε, by rounding.
        assert!(differ * 1000 <= truth.len(), "{layers}, {count}: {differ}");
        // Without either of the files it is another picture.
        for file in ["a.surfel", "glass.surfel"] {
            let all = options(layers, "less.png");
            let less: Vec<_> = all.into_iter().filter(|word| *word != file).collect();
            assert!(alone(folder, &less).status.success());
            let other = pixels(folder, "less.png");
            let differ = other.iter().zip(&truth).filter(|(a, b)| a.abs_diff(**b) > 16).count();
            assert!(differ * 20 > truth.len(), "{layers}, without {file}: {differ}");
        }
    }
}

/// All of them end, and each fault is said where it is.
#[test]
fn what_fails_in_one_process_ends_all_and_what_is_not_done_is_refused() {
    let folder = folder();
    let folder = folder.path();
    let mixed = "object = [{ file = \"a.surfel\" }, { builtin = \"sphere\", name = \"ball\" }]\n";
    std::fs::write(folder.join("mixed.toml"), mixed).unwrap();
    let cases: [(&[&str], &str); 6] = [
        (&["a.obj"], "a.obj: expected a hierarchy (surfel convert MODEL FILE.surfel)"),
        (&["mixed.toml"], "ball: expected a hierarchy (surfel convert MODEL FILE.surfel)"),
        (&["a.surfel", "--orthographic", "2"], "--orthographic: not with several processes"),
        (&["a.surfel", "--budget", "1000"], "--budget: not with several processes"),
        (&["a.surfel", "--samples", "4"], "--samples: not with several processes"),
        (&["a.surfel", "-o", "missing/a.png"], "missing"),
    ];
    for (arguments, expected) in cases {
        let done = ranks(2, folder, &[&["render", "--size", "64x64"], arguments].concat());
        let text = said(&done);
        assert!(!done.status.success() && text.contains(expected), "{arguments:?}: {text}");
    }
    // A page that only one of them reads is damaged: the last one of splats, behind which the root has its own.
    let mut bytes = std::fs::read(folder.join("a.surfel")).unwrap();
    let table = u64::from_le_bytes(bytes[32..40].try_into().unwrap()) as usize;
    bytes[table - 400] ^= 1;
    std::fs::write(folder.join("damaged.surfel"), bytes).unwrap();
    let done = ranks(3, folder, &["render", "damaged.surfel", "--lod", "0", "--size", "64x64"]);
    let text = said(&done);
    assert!(!done.status.success() && text.contains("its checksum is wrong"), "{text}");
    assert!(text.contains("another process has failed") && !folder.join("surfel.png").exists(), "{text}");
}
