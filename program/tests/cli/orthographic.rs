//! Parallel rays on the command line: a picture that can be measured.

use super::{
    files::png,
    program::{Folder, done, surfel},
};

/// A disk of radius 1, three units in front of another of radius 1.5.
fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("disks.ply", super::splats("0 0 3 0 0 1 1 10 200 10\n0 0 0 0 0 1 1.5 200 10 10\n"));
    folder
}

const VIEW: [&str; 9] =
    ["disks.ply", "--size", "64x64", "--shading", "albedo", "--edges", "hard", "--filter", "none"];

/// In 64 pixels that are 4 units, the half widths of the near disk and of the one behind: 16 and 24 pixels, however near the eye is.
#[test]
fn widths_are_those_of_the_scene_wherever_the_eye_is() {
    let folder = folder();
    folder.write("cam.json", r#"{"eye":[0,0,5], "target":[0,0,0], "up":[0,1,0], "orthographic":4}"#);
    folder.write("scene.toml", "[camera]\northographic = 4\n[[object]]\nfile = \"disks.ply\"\n");
    let from_options = ["--orthographic", "4"];
    let cases: [(&str, &[&str]); 5] = [
        ("render", &from_options),
        ("reference", &from_options),
        ("render", &["--orthographic", "4", "--eye", "0,0,4000"]),
        ("render", &["--camera", "cam.json"]),
        ("render", &["--crop", "0,0,64,64", "--orthographic", "4"]),
    ];
    for (subcommand, camera) in cases {
        done(&folder, &[&[subcommand], &VIEW[..], camera, &["-o", "a.png"]].concat());
        let picture = png(&folder.path("a.png"));
        let row: Vec<[u8; 3]> = (0..64).map(|x| picture.at(x, 32)).collect();
        let of = |channel: usize| row.iter().filter(|pixel| pixel[channel] > 150 && pixel[2] < 100).count();
        assert_eq!((of(1), of(0)), (32, 16), "{subcommand} {camera:?}");
    }
    let of_scene = ["render", "scene.toml", "--size", "64x64", "--shading", "albedo", "-o", "b.png"];
    done(&folder, &of_scene);
    let picture = png(&folder.path("b.png"));
    assert_eq!([picture.at(32, 32)[1], picture.at(52, 32)[0]], [200, 200]);
}

#[test]
fn fit_shows_all_and_what_says_two_things_is_refused() {
    let folder = folder();
    done(&folder, &["render", "disks.ply", "--size", "64x32", "--orthographic", "fit", "-o", "a.png"]);
    let picture = png(&folder.path("a.png"));
    let border = (0..64).flat_map(|x| [(x, 0), (x, 31)]).chain((0..32).flat_map(|y| [(0, y), (63, y)]));
    assert!(border.clone().all(|(x, y)| picture.at(x, y) == [255; 3]) && picture.at(32, 16) != [255; 3]);
    let cases = [
        (vec!["--orthographic", "2", "--fov", "30"], "cannot be used with"),
        (vec!["--orthographic", "0"], "expected a height above 0"),
        (
            vec!["--orthographic", "2", "--rasterizer", "affine-center"],
            "affine-center: not for an orthographic camera",
        ),
    ];
    for (words, expected) in cases {
        let run = surfel(&folder, &[&["render", "disks.ply", "-o", "b.png"], &words[..]].concat());
        assert!(run.code == 1 && run.stderr.contains(expected), "{words:?}: {}", run.stderr);
    }
    assert!(!folder.path("b.png").exists());
}
