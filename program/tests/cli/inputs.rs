//! How inputs are taken: as what they are drawn, what is up, what is told of them, and what is refused with `--strict`.

use super::{
    files::png,
    program::{Folder, done, surfel},
};

pub const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n\
    f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

const SIZE: [&str; 2] = ["--size", "64x64"];

/// Points of a PLY.
fn points(rows: impl Iterator<Item = [f64; 3]>) -> String {
    let rows: Vec<String> = rows.map(|[x, y, z]| format!("{x} {y} {z}\n")).collect();
    let property = |name: &str| format!("property float {name}\n");
    let properties = ["x", "y", "z"].map(property).concat();
    format!("ply\nformat ascii 1.0\nelement vertex {}\n{properties}end_header\n{}", rows.len(), rows.concat())
}

/// Hills, 10 high on a square of 195.
fn terrain() -> String {
    let places = (0..40).flat_map(|y| (0..40).map(move |x| (5.0 * f64::from(x), 5.0 * f64::from(y))));
    points(places.map(|(x, y)| [x, y, 5.0 * (0.06 * x).sin() * (0.04 * y).cos()]))
}

#[test]
fn a_coarse_mesh_is_drawn_as_its_triangles_unless_told_otherwise() {
    let folder = Folder::new();
    folder.write("cube.obj", CUBE);
    let picture = |name: &str, words: &[&str]| {
        let view = ["render", "cube.obj", "--eye", "2.5,2,3", "--shading", "albedo", "-o", name];
        let run = done(&folder, &[&view[..], &SIZE, words].concat());
        (run.stderr, png(&folder.path(name)).pixels)
    };
    let (said, auto) = picture("auto.png", &[]);
    assert!(said.contains("drawn as 12 triangles: too coarse for splats ("), "{said}");
    assert!(said.contains("); --representation splats draws disks\n"), "{said}");
    assert_eq!(auto, picture("mesh.png", &["--representation", "mesh"]).1);
    let (said, splats) = picture("splats.png", &["--representation", "splats"]);
    assert!(said.contains("normals and radii computed") && splats != auto, "{said}");
    let (said, sampled) = picture("sampled.png", &["--resample", "1k", "--seed", "3"]);
    assert!(said.contains("resampled with seed 3") && sampled != splats && sampled != auto, "{said}");
    // A scene file says the same with a key.
    for (key, expected) in
        [("", &auto), ("representation = \"auto\"\n", &auto), ("representation = \"splats\"\n", &splats)]
    {
        folder.write("scene.toml", format!("[[object]]\nfile = \"cube.obj\"\n{key}"));
        done(
            &folder,
            &[&["render", "scene.toml", "--eye", "2.5,2,3", "--shading", "albedo"][..], &SIZE].concat(),
        );
        assert_eq!(&png(&folder.path("surfel.png")).pixels, expected, "{key}");
    }
    for (words, expected) in [
        (&["--seed", "1"][..], "--resample <N>"),
        (
            &["--resample", "9", "--representation", "mesh"],
            "--resample: has no meaning for meshes that are drawn as triangles",
        ),
        (&["--resample", "1.5"], "expected a number of splats, 1 to 4294967295"),
    ] {
        let run = surfel(&folder, &[&["render", "cube.obj"], words].concat());
        assert!(run.code == 1 && run.stderr.contains(expected), "{}", run.stderr);
    }
    let run = surfel(&folder, &["render", "--resample", "9"]);
    assert!(run.stderr.contains("--resample: the built-in model is made of splats"), "{}", run.stderr);
}

#[test]
fn what_is_plainly_a_terrain_has_z_up_and_is_seen_from_above() {
    let folder = Folder::new();
    folder.write("terrain.ply", terrain());
    let said = |up: &[&str]| {
        let run = done(&folder, &[&["render", "terrain.ply"], up, &SIZE].concat());
        (run.stderr, png(&folder.path("surfel.png")).pixels)
    };
    let (auto, seen) = said(&[]);
    assert!(auto.contains("\nup is +z, because it lies flat as ground does; --up y if not\n"), "{auto}");
    assert_eq!(said(&["--up", "auto"]).1, seen);
    let (given, from_above) = said(&["--up", "z"]);
    assert!(!given.contains("up is") && given.contains("edge-on"), "{given}");
    assert_eq!((&said(&["--up", "0,0,1"]).1, &from_above), (&seen, &seen));
    assert!(said(&["--up", "z", "--view", "front"]).1 != seen);
    let (given, above) = said(&["--up", "y"]);
    assert!(!given.contains("up is") && above != seen, "{given}");
    let run = surfel(&folder, &["render", "terrain.ply", "--up", "w"]);
    assert!(run.code == 1 && run.stderr.contains("expected auto, x, y, z, -x, -y, -z"), "{}", run.stderr);
}

#[test]
fn strict_refuses_what_is_not_drawn_as_its_file_says() {
    let folder = Folder::new();
    folder.write("good.ply", super::splats("0 0 0 0 0 1 1 255 0 0\n"));
    folder.write(
        "bad.ply",
        super::splats("0 0 0 0 0 1 1 255 0 0\n0 0 1 0 0 0 1 0 0 0\n0 1 0 0 0 1 -1 0 0 0\n"),
    );
    folder.write("cube.obj", CUBE);
    for subcommand in ["render", "reference"] {
        // Normals and radii are computed, nothing is lost.
        done(&folder, &[&[subcommand, "good.ply", "cube.obj", "--strict"][..], &SIZE].concat());
        let before = folder.names();
        let run = surfel(
            &folder,
            &[&[subcommand, "good.ply", "bad.ply", "--strict", "-o", "b.png"][..], &SIZE].concat(),
        );
        let expected = "surfel: bad.ply: 1 splat whose normal is zero or not finite left out, and 1 more of that kind; expected \
            nothing of it with --strict\n";
        assert!(run.code == 1 && run.stderr.ends_with(expected), "{}", run.stderr);
        assert_eq!(folder.names(), before);
    }
    let run = surfel(&folder, &["convert", "bad.ply", "b.ply", "--strict"]);
    assert!(
        run.code == 1 && run.stderr.starts_with("surfel: bad.ply: 1 splat whose normal"),
        "{}",
        run.stderr
    );
    done(&folder, &["convert", "good.ply", "b.ply", "--strict"]);
    done(&folder, &[&["render", "bad.ply", "--timings", "t.json", "--frames", "1"][..], &SIZE].concat());
    let input = &folder.json("t.json")["scene"]["inputs"][0];
    assert_eq!((&input["drawn_as"], &input["notes"][0]["deed"]), (&"splats".into(), &"dropped".into()));
    assert_eq!((&input["notes"][1]["count"], &input["model"]["points"]), (&1.into(), &3.into()));
    assert_eq!(folder.json("t.json")["scene"]["origins"].as_array().map(Vec::len), Some(1));
}

#[test]
fn a_scene_file_names_files_outside_of_its_folder_only_where_it_may() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("scenes")).unwrap();
    folder.write("disk.ply", super::splats("0 0 0 0 0 1 1 255 0 0\n"));
    for file in ["../disk.ply".to_owned(), folder.path("disk.ply").display().to_string()] {
        folder.write("scenes/a.toml", format!("[[object]]\nfile = \"{file}\"\n"));
        let words = [&["render", "scenes/a.toml"][..], &SIZE].concat();
        let refused = surfel(&folder, &words);
        assert!(refused.code == 1 && refused.stderr.contains("--allow-outside"), "{}", refused.stderr);
        let run = done(&folder, &[&words[..], &["--allow-outside"]].concat());
        assert!(run.stderr.starts_with("disk.ply: 1 disk\n"), "{}", run.stderr);
        // An output is no input, wherever that is.
        let run = surfel(&folder, &[&words[..], &["--allow-outside", "--timings", "disk.ply"]].concat());
        assert!(run.stderr.contains("disk.ply: is an input, or written twice"), "{}", run.stderr);
    }
}

#[test]
fn info_tells_what_is_in_files_without_a_device() {
    let folder = Folder::new();
    folder.write("terrain.ply", terrain());
    folder.write("cube.obj", CUBE);
    let nowhere = [("VK_DRIVER_FILES", "/nonexistent"), ("VK_ICD_FILENAMES", "/nonexistent")];
    let info = |words: &[&str]| {
        let run = super::program::surfel_with(&folder, &[&["info"], words].concat(), &nowhere);
        assert_eq!(run.code, 0, "{}", run.stderr);
        run.stdout
    };
    let told = info(&["terrain.ply"]);
    for words in [
        "holds     1600 points",
        "with      nothing else",
        "drawn: 1600 splats of terrain.ply",
        "up        0,0,1, because it lies flat",
    ] {
        assert!(told.contains(words), "'{words}' is not in\n{told}");
    }
    let json: serde_json::Value =
        serde_json::from_str(&info(&["cube.obj", "terrain.ply", "--json"])).unwrap();
    let cube = &json["inputs"][0];
    assert_eq!((&cube["drawn_as"], &cube["model"]["triangles"]), (&"triangles".into(), &12.into()));
    assert_eq!(cube["model"]["bounds"], serde_json::json!([[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]]));
    let drawn = json["drawn"].as_array().unwrap();
    assert_eq!((&drawn[0]["kind"], &drawn[1]["kind"]), (&"splats".into(), &"triangles".into()));
    let spacing = drawn[0]["spacing"].as_f64().unwrap();
    assert!((5.0..5.2).contains(&spacing), "{spacing}");
    assert_eq!(json["scene"]["extent"][0].as_f64().map(|x| (195.0..225.0).contains(&x)), Some(true));
    let refused = surfel(&folder, &["info", "--up", "z"]);
    assert!(refused.code == 1 && refused.stderr.contains("but no file"), "{}", refused.stderr);
}

#[test]
fn what_f32_has_no_digits_for_is_told_without_being_asked() {
    let folder = Folder::new();
    let words =
        ["render", "plain.obj", "--eye", "0,0,0", "--target", "0,-0.2,-1", "--size", "32x32", "-o", "a.png"];
    let told = |scale: &str| {
        folder.write(
            "plain.obj",
            format!("v -{scale} -1 -{scale}\nv {scale} -1 -{scale}\nv 0 -1 {scale}\nf 1 2 3\n"),
        );
        let run = surfel(&folder, &words);
        assert_eq!(run.code, 0, "{}", run.stderr);
        run.stderr.contains("mesh 0: an edge of 2.")
    };
    assert!(told("1e7"));
    assert!(!told("1e3"));
}
