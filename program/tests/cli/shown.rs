//! From linear light to what a picture shows: exposure, curves, lights and shadings of the command line.

use super::{
    files::png,
    program::{Folder, done, surfel},
};

/// A gray disk, and one with a light of its own beside it.
fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("disk.ply", super::splats("0 0 0 0 0 1 1 128 128 128\n"));
    folder
}

/// The middle of a picture of the disk, and its corner.
fn shown(folder: &Folder, subcommand: &str, words: &[&str]) -> [[u8; 3]; 2] {
    let view =
        [subcommand, "disk.ply", "--size", "32x32", "--eye", "0,0,4", "--target", "0,0,0", "-o", "a.png"];
    done(folder, &[&view[..], words].concat());
    let picture = png(&folder.path("a.png"));
    [picture.at(16, 16), picture.at(0, 0)]
}

#[test]
fn exposure_and_curves_are_of_what_is_drawn_and_leave_the_background() {
    let folder = folder();
    // sRGB 128 is 0.2158 of light: a stop more is 0.4316, in sRGB 175. The curves' values by hand.
    let cases: [(&[&str], u8); 6] = [
        (&[], 128),
        (&["--exposure", "0", "--tonemap", "none"], 128),
        (&["--exposure", "1"], 175),
        (&["--exposure=-1"], 92),
        (&["--tonemap", "aces"], 104),
        (&["--tonemap", "agx"], 136),
    ];
    for subcommand in ["render", "reference"] {
        for (words, expected) in cases {
            let words = [&["--shading", "albedo", "--background", "1,0.2,0"][..], words].concat();
            let [middle, corner] = shown(&folder, subcommand, &words);
            assert!(
                middle.iter().all(|byte| byte.abs_diff(expected) <= 2),
                "{words:?}: {middle:?} {expected}"
            );
            assert_eq!(corner, [255, 51, 0], "{words:?}");
        }
    }
    // Without a background its pixels stay empty.
    done(
        &folder,
        &[
            "render",
            "disk.ply",
            "--size",
            "32x32",
            "--eye",
            "0,0,4",
            "--tonemap",
            "agx",
            "--background",
            "none",
            "-o",
            "b.png",
        ],
    );
    let picture = png(&folder.path("b.png"));
    assert_eq!((picture.channels, picture.pixels[3], picture.at(0, 0)), (4, 0, [0; 3]));
}

#[test]
fn a_linear_picture_stays_as_it_is_drawn() {
    let folder = folder();
    let refused = |words: &[&str]| {
        let run = surfel(&folder, &[&["render", "disk.ply", "--size", "8x8", "-o", "a.exr"], words].concat());
        assert_eq!((run.code, run.stderr.lines().count()), (1, 1), "{}", run.stderr);
        run.stderr
    };
    assert!(
        refused(&["--tonemap", "aces"])
            .starts_with("surfel: --tonemap: aces: a.exr stays linear; expected a picture in .png")
    );
    assert!(refused(&["--exposure", "2"]).starts_with("surfel: --exposure: 2: a.exr stays linear"));
    let run = surfel(&folder, &["render", "disk.ply", "--exposure", "65"]);
    assert_eq!(run.code, 1);
    assert!(run.stderr.contains("--exposure: 65: expected -64 to 64 stops"), "{}", run.stderr);
    done(
        &folder,
        &["render", "disk.ply", "--size", "8x8", "-o", "a.exr", "--exposure", "0", "--tonemap", "none"],
    );
}

#[test]
fn lights_of_the_command_line_are_those_of_scene_files_and_take_their_place() {
    let folder = folder();
    let object = "[[object]]\nfile = \"disk.ply\"\n";
    let light =
        "[[light]]\nkind = \"directional\"\ndirection = [1, 0, -1]\ncolor = [1, 0.5, 0]\nintensity = 2\n";
    folder.write("lit.toml", format!("{light}{object}"));
    folder.write("green.toml", format!("[[light]]\nkind = \"eye\"\ncolor = [0, 1, 0]\n{object}"));
    let of = |words: &[&str]| {
        let view = ["--size", "32x32", "--eye", "0,0,4", "--target", "0,0,0", "-o", "a.png"];
        done(&folder, &[words, &view[..]].concat());
        std::fs::read(folder.path("a.png")).unwrap()
    };
    let words = "direction=1,0,-1,color=1,0.5,0,intensity=2";
    for subcommand in ["render", "reference"] {
        let expected = of(&[subcommand, "lit.toml"]);
        assert_eq!(of(&[subcommand, "disk.ply", "--light", words]), expected);
        assert_eq!(of(&[subcommand, "green.toml", "--light", words]), expected);
        assert_ne!(of(&[subcommand, "disk.ply", "--light", words, "--light", "eye"]), expected);
        assert_eq!(of(&[subcommand, "disk.ply", "--light", "eye"]), of(&[subcommand, "disk.ply"]));
    }
    let run = surfel(&folder, &["render", "disk.ply", "--light", "direction=0,0"]);
    assert_eq!(run.code, 1);
    assert!(
        run.stderr.contains("direction=0,0: expected three numbers with commas between"),
        "{}",
        run.stderr
    );
}

#[test]
fn eye_dome_lighting_is_for_opaque_splats_and_says_so_of_others() {
    let folder = folder();
    let disk = "[[object]]\nfile = \"disk.ply\"\n";
    folder.write("clear.toml", format!("{disk}name = \"glass\"\nalpha = 0.5\n"));
    folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    for subcommand in ["render", "reference"] {
        assert_eq!(shown(&folder, subcommand, &["--shading", "edl"]), [[128; 3], [255; 3]]);
        let cases: [(&[&str], &str); 2] = [
            (&["clear.toml"], "--shading: edl: glass is transparent, it holds for opaque splats"),
            (&["mesh.obj", "--representation", "mesh"], "--shading: edl: mesh.obj is drawn as triangles"),
        ];
        for (words, expected) in cases {
            let run = surfel(&folder, &[&[subcommand, "--shading", "edl", "--size", "8x8"], words].concat());
            assert_eq!(run.code, 1);
            assert!(run.stderr.contains(expected), "{}", run.stderr);
        }
    }
}

#[test]
fn outlines_of_polygons_are_no_stairs_unless_that_is_asked_for() {
    let folder = folder();
    folder.write("slanted.obj", "v -1 -1 0\nv 1 -0.6 0\nv 0.1 1 0\nf 1 2 3\n");
    let drawn = |model: &str, words: &[&str]| {
        let first = ["render", model, "--size", "64x64", "--shading", "albedo", "-o", "a.png"];
        done(&folder, &[&first[..], words].concat());
        png(&folder.path("a.png")).pixels
    };
    // What is neither the triangle's gray nor the white behind it.
    let between = |pixels: &[u8]| {
        let inside = *pixels.iter().min().unwrap();
        pixels.iter().filter(|byte| **byte != inside && **byte != 255).count() / 3
    };
    let plain = drawn("slanted.obj", &[]);
    assert_eq!(plain, drawn("slanted.obj", &["--samples", "8"]));
    // Its sides are some 170 pixels long; a sample is a Gaussian's, and most are less than a pixel off.
    assert!((150..350).contains(&between(&plain)), "{}", between(&plain));
    for hard in [["--samples", "1"], ["--edges", "hard"]] {
        assert_eq!(between(&drawn("slanted.obj", &hard)), 0, "{hard:?}");
    }
    // Splats cover pixels in part in one by tiles; by points, and without a filter that widens them, they take as many samples.
    assert_eq!(drawn("disk.ply", &[]), drawn("disk.ply", &["--samples", "1"]));
    for method in [["--rasterizer", "affine-center"], ["--filter", "none"]] {
        let with = |words: &[&str]| drawn("disk.ply", &[&method[..], words].concat());
        let plain = with(&[]);
        assert_eq!(plain, with(&["--samples", "8", "--edges", "hard"]), "{method:?}");
        assert!(between(&plain) > 50, "{}", between(&plain));
        for hard in [["--samples", "1"], ["--edges", "hard"]] {
            assert_eq!(between(&with(&hard)), 0, "{method:?} {hard:?}");
        }
        let told = |words: &[&str]| {
            let first = ["render", "disk.ply", "--size", "9x9", "--explain"];
            let all = [&first[..], &method, words].concat();
            surfel(&folder, &all).stdout.contains("8 samples a pixel, with hard edges")
        };
        assert_eq!([told(&[]), told(&["--edges", "hard"]), told(&["--samples", "1"])], [true, false, false]);
    }
}
