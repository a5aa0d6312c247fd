//! Cameras by words: sides, angles, objects, and the line that makes a camera again.

use std::fs;

use super::{
    files::png,
    program::{Folder, done, surfel},
};

/// Six disks that face away from the origin, one a side, each of a color of its own.
fn folder() -> Folder {
    let folder = Folder::new();
    let sides = "1 0 0 1 0 0 1 200 0 0\n-1 0 0 -1 0 0 1 0 200 0\n0 1 0 0 1 0 1 0 0 200\n0 -1 0 0 -1 0 1 200 200 0\n\
                 0 0 1 0 0 1 1 0 200 200\n0 0 -1 0 0 -1 1 200 0 200\n";
    folder.write("sides.ply", super::splats(sides));
    folder.write("alone.ply", super::splats("9 0 0 0 0 1 0.5 7 7 7\n"));
    folder
}

const SMALL: [&str; 5] = ["--size", "48x48", "--shading", "albedo", "-o"];

fn middle(folder: &Folder, words: &[&str]) -> [u8; 3] {
    done(folder, &[&["render"], words, &SMALL[..], &["a.png"]].concat());
    png(&folder.path("a.png")).at(24, 24)
}

#[test]
fn sides_are_seen_by_name_by_angles_and_by_scene_files() {
    let folder = folder();
    let cyan = [0, 200, 200];
    for (up, side, angles, color) in [
        ("y", "front", ["0", "0"], cyan),
        ("y", "back", ["180", "0"], [200, 0, 200]),
        ("y", "left", ["-90", "0"], [0, 200, 0]),
        ("y", "right", ["90", "0"], [200, 0, 0]),
        ("y", "top", ["0", "90"], [0, 0, 200]),
        ("y", "bottom", ["0", "-90"], [200, 200, 0]),
        ("z", "front", ["360", "0"], [200, 200, 0]),
        ("z", "top", ["0", "90"], cyan),
        ("-x", "top", ["0", "90"], [0, 200, 0]),
    ] {
        assert_eq!(middle(&folder, &["sides.ply", "--up", up, "--view", side]), color, "{side}");
        let [azimuth, elevation] = angles;
        let turned = ["sides.ply", "--up", up, "--azimuth", azimuth, "--elevation", elevation, "--ortho"];
        assert_eq!(middle(&folder, &turned), color, "{angles:?}");
        let text = format!("[camera]\nview = \"{side}\"\nup = \"{up}\"\n[[object]]\nfile = \"sides.ply\"\n");
        folder.write("scene.toml", text);
        assert_eq!(middle(&folder, &["scene.toml"]), color, "{side}");
    }
    // An eye that is given right above sees what the side from above does, and it is told what is up.
    for up in ["y", "z"] {
        let eye = if up == "y" { "0,9,0" } else { "0,0,9" };
        let words = ["render", "sides.ply", "--up", up, "--eye", eye, "--size", "48x48", "-o", "b.png"];
        let told = done(&folder, &words).stderr;
        let expected =
            format!("the view is along +{up}; up in the picture is {}", if up == "y" { "-z" } else { "+y" });
        assert!(told.contains(&expected), "{told}");
        assert_eq!(
            middle(&folder, &["sides.ply", "--up", up, "--eye", eye]),
            if up == "y" { [0, 0, 200] } else { cyan }
        );
    }
    // The command line comes first: an eye in place of a side.
    assert_eq!(middle(&folder, &["scene.toml", "--up", "y", "--eye", "0,0,9"]), cyan);
}

/// A box is seen from a corner where nobody says from where, and an open side of it from the front.
#[test]
fn what_has_a_flat_front_is_seen_from_a_corner() {
    let folder = Folder::new();
    let corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n";
    let side = "f 5 6 8 7\n";
    folder.write("side.obj", format!("{corners}{side}"));
    folder
        .write("box.obj", format!("{corners}{side}f 1 3 4 2\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n"));
    let said = "seen from a corner, because its front is one flat side; --view front if not\n";
    let render = |words: &[&str], out: &str| {
        let run = done(&folder, &[&["render"], words, &["--size", "48x48", "-o", out]].concat());
        run.stderr.matches(said).count()
    };
    assert_eq!(render(&["box.obj"], "corner.png"), 1);
    assert_eq!(render(&["box.obj", "--azimuth", "30", "--elevation", "20"], "same.png"), 0);
    assert_eq!(render(&["box.obj", "--view", "front"], "front.png"), 0);
    assert_eq!(render(&["side.obj"], "open.png"), 0);
    let read = |name: &str| fs::read(folder.path(name)).unwrap();
    assert!(read("corner.png") == read("same.png") && read("corner.png") != read("front.png"));
}

#[test]
fn the_printed_line_makes_the_same_bytes() {
    let folder = folder();
    folder.write(
        "scene.toml",
        "[camera]\nzoom = 1.5\nview = \"iso\"\nnear = 1e-3\n[[object]]\nfile = \"sides.ply\"\n",
    );
    folder.write("cam.json", r#"{"eye":[0.1,4.3,0], "target":[0.1,0,0], "up":[0,1,0], "fov_deg":33.3}"#);
    for words in [
        &["sides.ply", "--view", "iso", "--zoom", "1.7"][..],
        &[
            "sides.ply",
            "--azimuth",
            "-37",
            "--elevation",
            "12.5",
            "--up",
            "0.1,1,0.2",
            "--ortho",
            "--zoom",
            "0.9",
        ],
        &["sides.ply", "--view", "top", "--up", "z"],
        &["sides.ply", "alone.ply", "--target", "alone.ply"],
        &["sides.ply", "--camera", "cam.json"],
        &["scene.toml"],
    ] {
        let inputs: Vec<&str> = words.iter().copied().take_while(|word| !word.starts_with("--")).collect();
        let run =
            surfel(&folder, &[&["render"], words, &["--print-camera"], &SMALL[..], &["a.png"]].concat());
        let line = run.stdout;
        assert!(run.code == 0 && line.lines().count() == 1, "{line}");
        let given = line.split_whitespace().collect::<Vec<_>>();
        done(&folder, &[&["render"], &inputs[..], &given, &SMALL[..], &["b.png"]].concat());
        let [a, b] = ["a.png", "b.png"].map(|name| fs::read(folder.path(name)).unwrap());
        assert!(a == b, "{words:?}: {line}");
    }
}

#[test]
fn an_object_is_looked_at_and_shown_whole_and_what_says_two_things_is_refused() {
    let folder = folder();
    assert_eq!(middle(&folder, &["sides.ply", "alone.ply", "--target", "alone.ply"]), [7, 7, 7]);
    let scene = "[camera]\ntarget = \"alone\"\n[[object]]\nfile = \"sides.ply\"\n[[object]]\nfile = \"alone.ply\"\nname = \"alone\"\n";
    folder.write("scene.toml", scene);
    assert_eq!(middle(&folder, &["scene.toml"]), [7, 7, 7]);
    let picture = png(&folder.path("a.png"));
    assert!(picture.at(7, 24) == [7, 7, 7] && picture.at(24, 40) == [7, 7, 7], "it fits the picture");
    folder.write("nobody.toml", scene.replace("target = \"alone\"", "target = \"nobody\""));
    folder.write("cam.json", r#"{"eye":[0,0,5], "target":[0,0,0], "up":[0,1,0], "fov_deg":45}"#);
    for (words, expected) in [
        (
            &["sides.ply", "--target", "nobody"][..],
            "--target: no object is called 'nobody'; expected a point, or 'sides.ply'",
        ),
        (&["nobody.toml"], "nobody.toml: camera, target: no object is called 'nobody'"),
        (&["sides.ply", "--target", "1,2"], "or the name of an object"),
        (
            &["sides.ply", "--view", "top", "--eye", "0,0,1"],
            "'--view <SIDE>' cannot be used with '--eye <X,Y,Z>'",
        ),
        (
            &["sides.ply", "--view", "top", "--azimuth", "3"],
            "'--view <SIDE>' cannot be used with '--azimuth <DEG>'",
        ),
        (&["sides.ply", "--elevation", "3", "--eye", "0,0,1"], "cannot be used with"),
        (&["sides.ply", "--ortho", "--fov", "3"], "cannot be used with"),
        (
            &["sides.ply", "--camera", "cam.json", "--zoom", "3"],
            "'--camera <FILE.json>' cannot be used with '--zoom <TIMES>'",
        ),
        (&["sides.ply", "--elevation", "91"], "expected degrees, -90 to 90"),
        (&["sides.ply", "--zoom", "0"], "expected times, 0.000001 to 1000000"),
        (&["sides.ply", "--near", "0"], "near must be above zero"),
    ] {
        let run = surfel(&folder, &[&["render"], words].concat());
        assert!(run.code == 1 && run.stderr.contains(expected), "{words:?}: {}", run.stderr);
    }
}
