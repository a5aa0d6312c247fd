//! Files of levels of detail: written in memory and in parts, drawn, told of, refused.

use std::{fs, process::Stdio, thread, time::Duration};

use super::{
    files::png,
    program::{Folder, command, done, run, surfel},
};

const SMALL: [&str; 4] = ["--size", "96x96", "--representation", "splats"];

/// The least memory that there can be.
const LITTLE: [&str; 2] = ["--memory", "17MB"];

/// A folder with a closed surface of that many splats, `splats.ply`.
pub fn folder(splats: &str) -> Folder {
    let folder = Folder::new();
    let octahedron = "v 1 0 0\nv 0 1 0\nv 0 0 1\nv -1 0 0\nv 0 -1 0\nv 0 0 -1\n\
        f 1 2 3\nf 2 4 3\nf 4 5 3\nf 5 1 3\nf 2 1 6\nf 4 2 6\nf 5 4 6\nf 1 5 6\n";
    folder.write("octahedron.obj", octahedron);
    done(&folder, &["convert", "octahedron.obj", "splats.ply", "--resample", splats]);
    folder
}

fn picture(folder: &Folder, arguments: &[&str]) -> (Vec<u8>, String) {
    let drawn = done(folder, &[&["render", "-o", "picture.png"], &SMALL[..], arguments].concat());
    (png(&folder.path("picture.png")).pixels, drawn.stderr + &drawn.stdout)
}

fn farthest(a: &[u8], b: &[u8]) -> Option<u8> {
    a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max()
}

#[test]
fn what_is_drawn_of_a_file_is_what_is_drawn_of_its_splats() {
    let folder = folder("60k");
    let said = done(&folder, &["convert", "splats.ply", "a.surfel"]).stdout;
    assert!(said.starts_with("splats.ply: 60000 disks, closed -> a.surfel: 60000 disks below "), "{said}");
    for lod in ["0", "0.5px", "3px"] {
        let (from_splats, _) = picture(&folder, &["splats.ply", "--lod", lod]);
        let (from_file, told) = picture(&folder, &["a.surfel", "--lod", lod]);
        let far = farthest(&from_splats, &from_file);
        assert!(from_splats.len() == from_file.len() && far <= Some(1), "{lod}: {far:?}");
        assert!(told.contains("a.surfel: read ") && told.contains(" pages, "), "{told}");
    }
    // With another object, in one scene.
    let (both, _) = picture(&folder, &["a.surfel", "octahedron.obj", "--lod", "1px"]);
    assert!(farthest(&both, &picture(&folder, &["octahedron.obj"]).0) < Some(60));
    let info = done(&folder, &["info", "a.surfel"]).stdout;
    for words in
        ["60000 splats of a.surfel", "surface   closed", "nodes; ", "all of them sound", "--eye -0.003"]
    {
        assert!(info.contains(words), "{words}: {info}");
    }
}

/// With levels a pixel is the default, and leaves where it is 0; without levels the splats themselves. What draws no levels draws all splats.
#[test]
fn a_pixel_is_the_default_where_there_are_levels() {
    let folder = folder("200k");
    done(&folder, &["convert", "splats.ply", "a.surfel"]);
    let explained = |arguments: &[&str]| {
        let (bytes, told) = picture(&folder, &[arguments, &["--explain", "--edges", "hard"]].concat());
        let splats =
            told.rsplit_once(" pages, ").and_then(|(_, rest)| rest.split_once(": ")?.1.split_once(' '));
        (bytes, told.clone(), splats.and_then(|(number, _)| number.parse::<u32>().ok()))
    };
    let said = "splats that spread by up to 1.000 px on the screen are drawn as one";
    let because = "the default of what has levels of detail (--lod)";
    let (default, told, _) = explained(&["a.surfel"]);
    assert!(told.contains(&format!("{said}: {because}")), "{told}");
    let (asked, told, _) = explained(&["a.surfel", "--lod", "1px"]);
    assert!(told.contains(said) && !told.contains(because), "{told}");
    assert_eq!(default, asked);
    let (leaves, told, read) = explained(&["a.surfel", "--lod", "0"]);
    assert!(!told.contains("drawn as one") && read == Some(200_000), "{told}");
    assert_ne!(default, leaves);
    let (splats, told, _) = explained(&["splats.ply"]);
    assert!(!told.contains("drawn as one"), "{told}");
    assert!(farthest(&splats, &leaves) <= Some(1));
    let (quads, told, read) = explained(&["a.surfel", "--rasterizer", "quad"]);
    assert!(!told.contains("drawn as one") && read == Some(200_000), "{told}");
    assert_eq!(quads, explained(&["a.surfel", "--rasterizer", "quad", "--lod", "0"]).0);
}

/// Filled from memory and from a file, and told; what is no number is refused in one line, by `bench`, too.
#[test]
fn a_budget_is_filled_and_what_is_none_is_refused() {
    let folder = folder("60k");
    done(&folder, &["convert", "splats.ply", "a.surfel"]);
    let whole: &[&str] = &[];
    // Of what a plane cuts open the inside is seen, and what it cuts off is not drawn.
    let cut: &[&str] = &["--clip-plane", "1,0,0,0"];
    for (file, most, plane) in [
        ("splats.ply", 500_u64, whole),
        ("splats.ply", 3000, whole),
        ("a.surfel", 3000, whole),
        ("splats.ply", 3000, cut),
        ("a.surfel", 3000, cut),
    ] {
        let budget = most.to_string();
        let (_, told) = picture(&folder, &[&[file, "--budget", &budget, "--explain"], plane].concat());
        let words = format!("px on the screen are drawn as one, for --budget {most}");
        assert!(told.contains(&words), "{told}");
        let drawn = told.split_once("; ").and_then(|(_, rest)| rest.split_once(" splats are set up"));
        let drawn: u64 = drawn.and_then(|(drawn, _)| drawn.rsplit(' ').next()?.parse().ok()).unwrap();
        assert!(drawn <= most && 100 * drawn >= 97 * most, "{file}: {drawn} of {most}");
    }
    let refused = |arguments: &[&str], words: &str| {
        let run = surfel(&folder, arguments);
        assert!(run.code == 1 && run.stderr.contains(words), "{}", run.stderr);
        assert_eq!(run.stderr.trim_end().lines().count(), 1, "{}", run.stderr);
    };
    for word in ["0", "-5", "many", "1.2.3", "5e20", "NaN", ""] {
        refused(
            &["render", "splats.ply", "--budget", word],
            "expected none, or a number of splats from 1 on",
        );
    }
    for word in ["-1", "inf", "wide", "1pixel"] {
        refused(&["render", "splats.ply", "--lod", word], "expected");
    }
    // Named by what was given.
    let unread = "--budget: 3000: these settings draw no levels of detail";
    let quads = surfel(
        &folder,
        &["render", "a.surfel", "--size", "96x96", "--rasterizer", "quad", "--budget", "3000"],
    );
    assert!(quads.code == 1 && quads.stderr.contains(unread), "{}", quads.stderr);
    refused(&["bench", "growth", "--budget", "0"], "expected none, or a number of splats from 1 on");
    refused(&["bench", "table1", "--budget", "5k"], "only growth draws levels of detail");
}

#[test]
fn where_memory_ends_the_picture_is_coarser_and_a_line_says_so() {
    let folder = folder("60k");
    done(&folder, &["convert", "splats.ply", "a.surfel"]);
    let (fine, told) = picture(&folder, &["a.surfel", "--lod", "0.5px", "--budget-memory", "1GB"]);
    assert!(!told.contains("does not suffice"), "{told}");
    let (coarse, told) = picture(&folder, &["a.surfel", "--lod", "0.5px", "--budget-memory", "2MB"]);
    assert!(told.contains("--budget-memory does not suffice for --lod 0.500px: drawn with --lod "), "{told}");
    let sum: u64 = fine.iter().zip(&coarse).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
    // Another picture, but of the same thing.
    assert!(sum > 0 && sum < 4 * fine.len() as u64, "{sum}");
    let quads = ["render", "a.surfel", "--size", "96x96", "--lod", "3px", "--rasterizer", "quad"];
    let refused = surfel(&folder, &quads);
    assert!(
        refused.code == 1 && refused.stderr.contains("expected --rasterizer auto or compute"),
        "{}",
        refused.stderr
    );
    let refused = surfel(&folder, &["compare", "a.surfel"]);
    assert!(
        refused.code == 1
            && refused
                .stderr
                .contains("a .surfel file, which render, view and info take on the command line"),
        "{}",
        refused.stderr
    );
}

/// How many bytes of memory a conversion says that it took.
fn peak_bytes(said: &str) -> u64 {
    let words: Vec<&str> = said.split(' ').collect();
    let at = words
        .windows(3)
        .position(|words| words == ["bytes", "of", "memory"] || words == ["bytes", "of", "memory,"]);
    words[at.unwrap_or_else(|| panic!("{said}")) - 1].parse().unwrap()
}

#[test]
fn a_file_is_built_in_parts_within_the_memory_given() {
    let folder = folder("600k");
    for (memory, most) in [("17MB", 17_000_000), ("50MB", 50_000_000)] {
        let said = done(&folder, &["convert", "splats.ply", "parts.surfel", "--memory", memory]).stdout;
        assert!(said.contains(", built in "), "{said}");
        let peak = peak_bytes(&said);
        assert!(peak as f64 <= 1.05 * f64::from(most), "{memory}: {said}");
        // And makes use of it: parts are as large as cuts of space leave them.
        assert!(peak as f64 >= 0.15 * f64::from(most), "{memory}: {said}");
        assert_eq!(folder.names(), ["octahedron.obj", "parts.surfel", "splats.ply"]);
    }
    done(&folder, &["convert", "splats.ply", "whole.surfel"]);
    // Without levels the same splats, which edges would tell by how much they overlap, found at other samples; with them other nodes, which look
    // alike.
    for (options, most) in
        [(["--lod", "0", "--edges", "hard"], 0.01), (["--lod", "1px", "--edges", "coverage"], 0.5)]
    {
        let draw = |file: &str| picture(&folder, &[&[file], &options[..]].concat()).0;
        let (parts, whole) = (draw("parts.surfel"), draw("whole.surfel"));
        let sum: u64 = parts.iter().zip(&whole).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
        assert!(sum as f64 <= most * parts.len() as f64, "{options:?}: {sum} of {}", parts.len());
    }
}

#[test]
fn what_does_not_fit_and_can_not_be_read_in_parts_is_refused() {
    let folder = folder("1k");
    let refused = |arguments: &[&str], words: &str| {
        let run = surfel(&folder, arguments);
        assert!(
            run.code == 1 && run.stderr.contains(words) && run.stderr.lines().count() == 1,
            "{}",
            run.stderr
        );
    };
    let header = "ply\nformat binary_little_endian 1.0\nelement vertex 100000000\nproperty float x\nproperty float y\nproperty float z\n\
        property float nx\nproperty float ny\nproperty float nz\nproperty float radius\nend_header\n";
    folder.write("cut.ply", header);
    refused(&["convert", "cut.ply", "a.surfel"], "cut.ply: element vertex: 100000000 rows of 28 bytes");
    folder.write("large.obj", "# ".repeat(2 << 20));
    refused(
        &[&["convert", "large.obj", "a.surfel"], &LITTLE[..]].concat(),
        "expected a binary PLY file of splats",
    );
    refused(
        &[&["convert", "splats.ply", "a.ply"], &LITTLE[..]].concat(),
        "--memory: only for an OUTPUT that is named .surfel",
    );
    refused(&["convert", "splats.ply", "a.surfel", "--memory", "1MB"], "16777216 at least");
    folder.write("half.surfel", [&b"\x89SURFEL\n"[..], &[0; 400]].concat());
    refused(&["info", "half.surfel"], "half.surfel: header: version 0; expected 2");
    refused(&["render", "half.surfel"], "half.surfel: header: version 0; expected 2");
}

/// A process that ends at any moment leaves the file whole or not at all; one that is asked to end leaves nothing else either.
#[test]
fn a_build_that_is_killed_leaves_nothing_that_opens() {
    let folder = folder("300k");
    let arguments = [&["convert", "splats.ply", "a.surfel"], &LITTLE[..]].concat();
    let before = folder.names();
    let (mut killed, mut done_before) = (0, 0);
    for (round, wait_ms) in (0..24).map(|round| (round, 40 * round)) {
        let mut child =
            command(&folder, &arguments).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        thread::sleep(Duration::from_millis(wait_ms));
        // By turns asked, and not asked.
        let asked = round % 2 == 0;
        if asked {
            run(std::process::Command::new("kill")
                .args(["-TERM", &child.id().to_string()])
                .output()
                .unwrap());
        } else {
            child.kill().unwrap();
        }
        let finished = child.wait().unwrap().success();
        match finished {
            true => done_before += 1,
            false => killed += 1,
        }
        let there = folder.path("a.surfel").exists();
        if there {
            // It was whole before the end came.
            done(&folder, &["info", "a.surfel"]);
            fs::remove_file(folder.path("a.surfel")).unwrap();
        }
        assert!(there || !finished);
        if asked {
            assert_eq!(folder.names(), before, "after {wait_ms} ms");
        }
        for name in folder.names().into_iter().filter(|name| !before.contains(name)) {
            assert!(name.starts_with(".a.surfel.") && name.ends_with(".tmp"), "{name}");
            // Whoever takes it for a file is told that it is none.
            fs::rename(folder.path(&name), folder.path("taken.surfel")).unwrap();
            // Unless only its name was missing.
            let info = surfel(&folder, &["info", "taken.surfel"]);
            assert!(info.code == 1 || info.stdout.contains("all of them sound"), "{}", info.stdout);
            fs::remove_file(folder.path("taken.surfel")).unwrap();
        }
    }
    assert!(killed > 3, "{killed} killed, {done_before} done before");
}
