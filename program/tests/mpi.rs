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

/// A folder with a closed surface of some splats, `a.surfel`.
fn folder() -> temp_dir::TempDir {
    let folder = temp_dir::TempDir::new().unwrap();
    let octahedron = "v 1 0 0\nv 0 1 0\nv 0 0 1\nv -1 0 0\nv 0 -1 0\nv 0 0 -1\n\
        f 1 2 3\nf 2 4 3\nf 4 5 3\nf 5 1 3\nf 2 1 6\nf 4 2 6\nf 5 4 6\nf 1 5 6\n";
    std::fs::write(folder.path().join("a.obj"), octahedron).unwrap();
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

/// All of them end, and each fault is said where it is.
#[test]
fn what_fails_in_one_process_ends_all_and_what_is_not_done_is_refused() {
    let folder = folder();
    let folder = folder.path();
    let cases: [(&[&str], &str); 5] = [
        (&["a.obj"], "a.obj: expected a hierarchy (surfel convert MODEL FILE.surfel)"),
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
