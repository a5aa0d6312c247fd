//! Boxes and planes that cut a scene, on the command line and in scene files.

use std::fs;

use super::{
    files::png,
    program::{Folder, done, surfel},
};

/// A large disk that faces the eye, seen so that 10 pixels are a unit.
fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("disk.ply", super::splats("0 0 0 0 0 1 1.8 200 10 10\n"));
    folder
}

const VIEW: [&str; 13] = [
    "--eye",
    "0,0,9",
    "--target",
    "0,0,0",
    "--orthographic",
    "4",
    "--size",
    "40x40",
    "--shading",
    "albedo",
    "--edges",
    "hard",
    "-o",
];

fn red(folder: &Folder, words: &[&str], name: &str) -> Vec<(u32, u32)> {
    done(folder, &[&["render"], words, &VIEW[..], &[name]].concat());
    let picture = png(&folder.path(name));
    let all = (0..40).flat_map(|y| (0..40).map(move |x| (x, y)));
    all.filter(|(x, y)| picture.at(*x, *y)[1] < 100).collect()
}

#[test]
fn what_is_inside_is_left_and_scene_files_say_the_same() {
    let folder = folder();
    let all = red(&folder, &["disk.ply"], "all.png");
    let boxed = ["disk.ply", "--clip-box", "-0.5,-1,-1,1,0.5,1"];
    let inside = red(&folder, &boxed, "box.png");
    // x from -0.5 to 1 is 15 pixels from the 15th on; y, which is up, from -1 to 0.5.
    assert_eq!(
        inside,
        all.iter().copied().filter(|(x, y)| (15..30).contains(x) && (15..30).contains(y)).collect::<Vec<_>>()
    );
    let planes = [
        "disk.ply",
        "--clip-plane",
        "2,0,0,-1",
        "--clip-plane=-1,0,0,-1",
        "--clip-plane",
        "0,1,0,-1",
        "--clip-plane",
        "0,-1,0,-0.5",
    ];
    assert_eq!(red(&folder, &planes, "planes.png"), inside);
    folder.write("scene.toml", "clip_box = [-0.5, -1, -1, 1, 0.5, 1]\n[[object]]\nfile = \"disk.ply\"\n");
    assert_eq!(red(&folder, &["scene.toml"], "scene.png"), inside);
    assert!(fs::read(folder.path("scene.png")).unwrap() == fs::read(folder.path("box.png")).unwrap());
    folder.write("scene.toml", "clip_planes = [[2, 0, 0, -1], [-1, 0, 0, -1], [0, 1, 0, -1], [0, -1, 0, -0.5]]\n[[object]]\nfile = \"disk.ply\"\n");
    assert_eq!(red(&folder, &["scene.toml"], "scene.png"), inside);
    assert_eq!(red(&folder, &["scene.toml", "--clip-plane", "none"], "scene.png"), all);
    // The reference, too.
    done(&folder, &[&["reference"], &boxed[..], &VIEW[..], &["reference.png"]].concat());
    let (a, b) = (png(&folder.path("reference.png")), png(&folder.path("box.png")));
    assert!((0..40).all(|y| (0..40).all(|x| (0..3).all(|c| a.at(x, y)[c].abs_diff(b.at(x, y)[c]) <= 1))));
}

#[test]
fn what_is_no_plane_is_refused() {
    let folder = folder();
    folder.write("box.toml", "clip_box = [0, 0, 0, 0, 1, 1]\n[[object]]\nfile = \"disk.ply\"\n");
    folder.write("plane.toml", "clip_planes = [[0, 0, 0, 1]]\n[[object]]\nfile = \"disk.ply\"\n");
    folder.write(
        "many.toml",
        format!("clip_planes = [{}]\n[[object]]\nfile = \"disk.ply\"\n", "[1, 0, 0, 0],".repeat(7)),
    );
    let seven = ["disk.ply", "--clip-box", "0,0,0,1,1,1", "--clip-plane", "1,0,0,0"];
    for (words, expected) in [
        (&["disk.ply", "--clip-box", "0,0,0,1,1"][..], "expected the smallest x, y, z, then the largest"),
        (
            &["disk.ply", "--clip-box", "0,0,0,0,1,1"],
            "--clip-box: 0,0,0,0,1,1: expected smallest coordinates below the largest",
        ),
        (&["disk.ply", "--clip-plane", "0,0,0,1"], "--clip-plane: 0,0,0,1: expected finite numbers"),
        (&["disk.ply", "--clip-plane", "1,2,3"], "expected a,b,c,d"),
        (
            &["disk.ply", "--clip-plane", "none", "--clip-plane", "0,0,1,0"],
            "--clip-plane: none and 0,0,1,0 together: expected a,b,c,d",
        ),
        (&seven, "--clip-plane: 7 planes with those of --clip-box; expected at most 6"),
        (&["box.toml"], "box.toml: line 1, clip_box: [0, 0, 0, 0, 1, 1]: expected smallest"),
        (&["plane.toml"], "plane.toml: line 1, clip_planes: [[0, 0, 0, 1]]: expected a, b and c"),
        (&["many.toml"], "expected at most 6 planes"),
    ] {
        let run = surfel(&folder, &[&["render"], words].concat());
        assert!(run.code == 1 && run.stderr.contains(expected), "{words:?}: {}", run.stderr);
    }
}
