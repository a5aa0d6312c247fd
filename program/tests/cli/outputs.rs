//! What becomes of outputs when something is in their place, and when the program is stopped while it writes.

#![cfg(unix)]

use std::{
    fs,
    os::unix::{
        fs::{PermissionsExt as _, symlink},
        process::ExitStatusExt as _,
    },
    process::{Child, Command, Stdio},
    thread,
    time::{Duration, Instant},
};

use super::program::{Folder, done, surfel};

const TINY: [&str; 3] = ["render", "--size", "8x8"];

#[test]
fn a_link_is_followed_and_permissions_stay() {
    let folder = Folder::new();
    fs::create_dir(folder.path("other")).unwrap();
    folder.write("other/a.png", "old");
    fs::set_permissions(folder.path("other/a.png"), fs::Permissions::from_mode(0o600)).unwrap();
    symlink("other/a.png", folder.path("a.png")).unwrap();
    done(&folder, &[&TINY[..], &["-o", "a.png"]].concat());
    assert!(fs::symlink_metadata(folder.path("a.png")).unwrap().is_symlink());
    let written = fs::metadata(folder.path("other/a.png")).unwrap();
    assert_eq!((written.permissions().mode() & 0o777, written.len() > 50), (0o600, true));
    symlink("nowhere", folder.path("lost.png")).unwrap();
    let refused = surfel(&folder, &[&TINY[..], &["-o", "lost.png"]].concat());
    assert_eq!(
        (refused.code, refused.stderr.as_str()),
        (1, "surfel: lost.png: cannot write: a link to what is not there\n")
    );
}

/// Splats of 112 MB: what takes a while to write again.
fn large(folder: &Folder) {
    let count = 4_000_000;
    let properties =
        ["x", "y", "z", "nx", "ny", "nz", "radius"].map(|name| format!("property float {name}\n"));
    let properties = properties.concat();
    let header =
        format!("ply\nformat binary_little_endian 1.0\nelement vertex {count}\n{properties}end_header\n");
    let splat: Vec<u8> =
        [1_f32, 2.0, 3.0, 0.0, 0.0, 1.0, 1.0].iter().flat_map(|value| value.to_le_bytes()).collect();
    folder.write("large.ply", [header.into_bytes(), splat.repeat(count)].concat());
}

/// The program, once it has begun to write a large file; `None` where it is done sooner than it is seen.
fn writing(folder: &Folder) -> Option<Child> {
    let mut child = Command::new(env!("CARGO_BIN_EXE_surfel"))
        .args(["convert", "large.ply", "out.ply"])
        .current_dir(folder.path("."))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let start = Instant::now();
    // The place is tried before the work, too: a file with something in it is the one.
    let begun = |folder: &Folder| {
        let hidden = folder.names().into_iter().find(|name| name.ends_with(".tmp"));
        hidden.is_some_and(|name| fs::metadata(folder.path(&name)).is_ok_and(|file| file.len() > 0))
    };
    while !begun(folder) {
        assert!(start.elapsed() < Duration::from_secs(120));
        if child.try_wait().unwrap().is_some() {
            return None;
        }
        thread::sleep(Duration::from_millis(1));
    }
    Some(child)
}

/// Whether whoever started the tests ignores a signal, as shells do with SIGINT for what they run in the background; the
/// program then ignores it, too.
fn is_ignored(signal: u32) -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok())
        .is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}

#[test]
fn signals_leave_nothing_half_written() {
    let folder = Folder::new();
    large(&folder);
    for (name, number) in [("INT", 2), ("TERM", 15), ("HUP", 1)] {
        if is_ignored(number as u32) {
            eprintln!("SIG{name} is ignored here: not tried");
            continue;
        }
        // On a machine that is fast, or busy with others, a run may end before the signal comes.
        let stopped = (0..20).any(|_| {
            let _ = fs::remove_file(folder.path("out.ply"));
            let Some(mut child) = writing(&folder) else { return false };
            let kill = Command::new("kill").args([&format!("-{name}"), &child.id().to_string()]).status();
            assert!(kill.unwrap().success());
            child.wait().unwrap().signal() == Some(number)
        });
        assert!(stopped, "SIG{name} never came while the program wrote");
        assert_eq!(folder.names(), ["large.ply"], "SIG{name}");
    }
}

#[test]
fn a_file_that_may_not_be_so_large_is_an_error() {
    let folder = Folder::new();
    let program = env!("CARGO_BIN_EXE_surfel");
    let command =
        format!("ulimit -f 20; exec '{program}' reference --size 300x300 -o a.exr --shading normals");
    let output = Command::new("sh").args(["-c", &command]).current_dir(folder.path(".")).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("a.exr: cannot write: File too large"), "{said}");
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}

#[test]
fn what_another_run_left_behind_stops_nobody() {
    let folder = Folder::new();
    for number in 1..2000 {
        folder.write(&format!(".surfel-{number}.tmp"), "");
    }
    done(&folder, &[&TINY[..], &["-o", "a.png"]].concat());
}
