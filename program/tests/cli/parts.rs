//! Parts of CAD, coarse and with the faults that exports have, as who has them meets the program.

use std::fmt::Write as _;

use super::{
    files::png,
    program::{Folder, done, surfel},
};

/// A disk of metal of 32 sides, closed; every triangle by its vertices, from 1 on.
fn disk() -> (String, Vec<[u32; 3]>) {
    let mut vertices = String::new();
    let mut triangles = Vec::new();
    for i in 0..32 {
        let (y, x) = (f64::from(i) * std::f64::consts::TAU / 32.0).sin_cos();
        let _ = writeln!(vertices, "v {x:.6} {y:.6} 0\nv {x:.6} {y:.6} 0.6");
        let [a, b] = [2 * i + 1, 2 * ((i + 1) % 32) + 1];
        triangles.extend([[a, b, b + 1], [a, b + 1, a + 1], [65, b, a], [66, a + 1, b + 1]]);
    }
    vertices += "v 0 0 0\nv 0 0 0.6\n";
    (vertices, triangles)
}

fn obj((vertices, triangles): &(String, Vec<[u32; 3]>)) -> String {
    triangles.iter().fold(vertices.clone(), |text, [a, b, c]| text + &format!("f {a} {b} {c}\n"))
}

const SIZE: [&str; 2] = ["--size", "64x64"];

#[test]
fn splats_that_stick_out_are_told_with_what_to_type() {
    let folder = Folder::new();
    folder.write("part.obj", obj(&disk()));
    for (output, hint) in [
        ("a.ply", "): --splats 128 makes sharp ones\n"),
        // Levels of detail have no clip curves.
        ("a.surfel", " makes small ones\n"),
    ] {
        let said = done(&folder, &["convert", "part.obj", output]).stdout;
        assert!(said.contains("; they stick out at its edges (disks at its vertices would stand "), "{said}");
        assert!(said.ends_with(hint), "{said}");
        let (_, option) = said.rsplit_once("): ").unwrap();
        let [option, count] = [0, 1].map(|i| option.split(' ').nth(i).unwrap());
        let better = done(&folder, &["convert", "part.obj", output, option, count]).stdout;
        assert!(!better.contains("stick out"), "{better}");
    }
    // A ball is as well shown by disks, and what is uneven by disks that are spread.
    folder.write("ball.obj", ball(60));
    let said = done(&folder, &["convert", "ball.obj", "c.ply"]).stdout;
    assert!(said.ends_with(" bytes\n"), "{said}");
}

/// A ball of so many bands.
fn ball(bands: u32) -> String {
    let mut text = String::new();
    for band in 0..=bands {
        let (r, z) = (std::f64::consts::PI * f64::from(band) / f64::from(bands)).sin_cos();
        for i in 0..2 * bands {
            let (y, x) = (std::f64::consts::PI * f64::from(i) / f64::from(bands)).sin_cos();
            let _ = writeln!(text, "v {} {} {z}", r * x, r * y);
        }
    }
    for band in 0..bands {
        for i in 0..2 * bands {
            let [a, b] = [i, (i + 1) % (2 * bands)].map(|i| 2 * bands * band + i + 1);
            let _ = writeln!(text, "f {a} {} {} {b}", a + 2 * bands, b + 2 * bands);
        }
    }
    text
}

#[test]
fn a_triangle_that_is_turned_around_is_turned_back() {
    let folder = Folder::new();
    let (vertices, mut triangles) = disk();
    folder.write("good.obj", obj(&(vertices.clone(), triangles.clone())));
    triangles[5].swap(1, 2);
    triangles[70].swap(1, 2);
    folder.write("turned.obj", obj(&(vertices, triangles)));
    let told = done(&folder, &["convert", "turned.obj", "turned.ply", "--splats", "128"]).stdout;
    let expected = "closed, 2 triangles whose direction is not their neighbors' replaced; 2 ridges in 64 pieces, 128 splats clipped";
    assert!(told.contains(expected), "{told}");
    done(&folder, &["convert", "good.obj", "good.ply", "--splats", "128"]);
    let [good, turned] = ["good.ply", "turned.ply"].map(|name| {
        done(&folder, &[&["render", name, "-o", "a.png"][..], &SIZE].concat());
        std::fs::read(folder.path("a.png")).unwrap()
    });
    assert!(good == turned);
    let strict = surfel(&folder, &["convert", "turned.obj", "a.ply", "--splats", "128", "--strict"]);
    assert!(strict.code == 1 && strict.stderr.contains("2 triangles whose direction"), "{}", strict.stderr);
    // What no turning mends is cut apart, and nothing of it is lost.
    folder.write(
        "strip.obj",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 1\nf 1 2 3\nf 2 4 3\nf 3 4 5\nf 4 1 5\nf 5 1 2\n",
    );
    let told = done(&folder, &["convert", "strip.obj", "a.ply", "--splats", "20", "--strict"]).stdout;
    let expected =
        "open, 1 edge at which a surface of one side meets its back cut apart; 10 ridges in 10 pieces";
    assert!(told.contains(expected), "{told}");
    done(&folder, &["convert", "strip.obj", "a.ply", "--resample", "900"]);
}

#[test]
fn triangles_that_are_there_twice_are_told_by_every_way() {
    let folder = Folder::new();
    let (vertices, mut triangles) = disk();
    triangles.extend_from_within(..3);
    folder.write("twice.obj", obj(&(vertices, triangles)));
    let note = "3 triangles of the same vertices as another left out";
    for words in [
        &["render", "twice.obj", "-o", "a.png", "--size", "64x64"][..],
        &["render", "twice.obj", "-o", "a.png", "--size", "64x64", "--resample", "900"],
        &["convert", "twice.obj", "a.ply"],
        &["convert", "twice.obj", "a.ply", "--resample", "900"],
        &["convert", "twice.obj", "a.ply", "--splats", "128"],
        &["info", "twice.obj"],
    ] {
        let run = done(&folder, words);
        let all = run.stderr + &run.stdout;
        assert!(all.contains(note) && all.contains(": closed"), "{words:?}: {all}");
        let strict = surfel(&folder, &[words, &["--strict"]].concat());
        assert!(strict.code == 1 && strict.stderr.contains(note), "{words:?}: {}", strict.stderr);
    }
}

/// From above, the light at an eye that is far away: all of the flat side is as bright.
#[test]
fn a_flat_side_that_is_sampled_is_no_cushion() {
    let folder = Folder::new();
    folder.write("part.obj", obj(&disk()));
    let view = ["--resample", "20k", "--view", "front", "--ortho", "-o", "a.png"];
    done(&folder, &[&["render", "part.obj"][..], &SIZE, &view].concat());
    let picture = png(&folder.path("a.png"));
    let [middle, off] = [picture.at(32, 32)[0], picture.at(32, 14)[0]];
    assert!(middle.abs_diff(off) <= 2, "{middle} {off}");
}

/// One number that is wrong is no reason to draw nothing.
#[test]
fn places_beyond_what_a_device_has_are_left_out_and_told() {
    let folder = Folder::new();
    let names =
        ["x", "y", "z", "nx", "ny", "nz", "radius"].map(|name| format!("property double {name}\n")).concat();
    let rows: String = (0..100).map(|i| format!("{} {} 0 0 0 1 0.8\n", i % 10, i / 10)).collect();
    let header = format!("ply\nformat ascii 1.0\nelement vertex 101\n{names}end_header\n");
    folder.write("splats.ply", header + &rows + "5 5 1e40 0 0 1 0.8\n");
    let rows: String = (0..400).map(|i| format!("{} {} 0\n", i % 20, i / 20)).collect();
    folder.write("rows.xyz", rows + "0 -1e300 0\n");
    for (name, left_out) in [
        ("splats.ply", "1 splat left out: 1 position not finite"),
        ("rows.xyz", "1 point not finite left out"),
    ] {
        let words = ["render", name, "-o", "a.png", "--size", "64x64"];
        let told = done(&folder, &words).stderr;
        let note = format!("{name}: 1 place beyond numbers of 32 bits (3.4e38), by infinities, replaced\n");
        assert!(told.starts_with(&note) && told.contains(left_out), "{told}");
        let strict = surfel(&folder, &[&words[..], &["--strict"]].concat());
        assert!(strict.code == 1 && strict.stderr.contains("1 place beyond"), "{}", strict.stderr);
    }
}

#[test]
fn up_that_is_told_by_shape_is_kept() {
    let folder = Folder::new();
    let height = |x: u32, y: u32| 2.0 * ((f64::from(x) * 0.2).sin() + (f64::from(y) * 0.3).cos());
    let rows: String =
        (0..60 * 60).map(|i| format!("{} {} {:.4}\n", i % 60, i / 60, height(i % 60, i / 60))).collect();
    folder.write("land.xyz", rows);
    done(&folder, &["convert", "land.xyz", "land.ply"]);
    let told = done(&folder, &[&["render", "land.ply", "-o", "a.png"][..], &SIZE].concat()).stderr;
    assert!(told.contains("up is +z, because land.ply says so; "), "{told}");
}

/// In one sample the ridges of what curves cut have dots; a single picture is not worth them, a frame that is timed is what it is.
#[test]
fn what_curves_cut_has_several_samples_unless_that_is_asked_for() {
    let folder = Folder::new();
    folder.write("disk.obj", obj(&disk()));
    done(&folder, &["convert", "disk.obj", "cut.ply", "--splats", "128"]);
    done(&folder, &["convert", "disk.obj", "uncut.ply", "--resample", "900"]);
    let drawn = |model: &str, words: &[&str]| {
        done(&folder, &[&["render", model, "-o", "a.png"][..], &SIZE, words].concat());
        std::fs::read(folder.path("a.png")).unwrap()
    };
    let [one, several] = ["1", "8"].map(|samples| drawn("cut.ply", &["--samples", samples]));
    assert!(drawn("cut.ply", &[]) == several && one != several);
    let hard = drawn("cut.ply", &["--edges", "hard"]);
    assert!(hard == drawn("cut.ply", &["--edges", "hard", "--samples", "1"]));
    assert!(drawn("uncut.ply", &[]) == drawn("uncut.ply", &["--samples", "1"]));
    let told = |model: &str, words: &[&str]| {
        let all = [&["render", model, "--explain"][..], &SIZE, words].concat();
        done(&folder, &all)
            .stdout
            .contains("8 samples a pixel: in one, splats that curves cut leave dots at ridges")
    };
    let asked_for = [&["--samples", "1"][..], &["--edges", "hard"], &["--frames", "1"]];
    assert!(told("cut.ply", &[]) && !told("uncut.ply", &[]));
    assert!(asked_for.iter().all(|words| !told("cut.ply", words)));
}
