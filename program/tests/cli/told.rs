//! What the program tells of its inputs, and why it draws them as it does.

use super::{
    inputs::CUBE,
    program::{Folder, done, surfel},
};

const SIZE: [&str; 2] = ["--size", "64x64"];

/// Rows of numbers.
pub fn rows(points: impl IntoIterator<Item = [f64; 3]>) -> String {
    points.into_iter().map(|[x, y, z]| format!("{x} {y} {z}\n")).collect()
}

/// A grid of points, at this height.
pub fn grid(side: u32, z: f64) -> impl Iterator<Item = [f64; 3]> {
    (0..side).flat_map(move |y| (0..side).map(move |x| [f64::from(x), f64::from(y), z]))
}

#[test]
fn convert_reads_as_render_does() {
    let folder = Folder::new();
    folder.write("odd.xyz", "7 0 0 0\n8 1 0 0\n9 0 1 0\n7 1 1 0\n");
    let run = done(&folder, &["convert", "odd.xyz", "odd.ply", "--columns", "-,x,y,z"]);
    assert!(
        run.stdout.starts_with("odd.xyz: 4 points: ") && run.stdout.contains(": 4 disks, "),
        "{}",
        run.stdout
    );
    let told = done(&folder, &["info", "odd.ply"]).stdout;
    assert!(told.contains("within    0,0,0 to 1,1,0"), "{told}");

    std::fs::create_dir(folder.path("in")).unwrap();
    folder.write("out.mtl", "newmtl red\nKd 1 0 0\n");
    folder.write("in/a.obj", "mtllib ../out.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
    let strict = surfel(&folder, &["convert", "in/a.obj", "a.ply", "--strict"]);
    let expected = "1 material file outside of the model's folder (--allow-outside reads them) ignored";
    let inside = done(&folder, &["convert", "in/a.obj", "a.ply"]);
    assert!(strict.code == 1 && inside.stderr.contains(expected), "{}{}", strict.stderr, inside.stderr);
    let with = done(&folder, &["convert", "in/a.obj", "b.ply", "--allow-outside", "--strict"]);
    assert_eq!(with.stderr, "");
    folder.write(
        "in/a.gltf",
        r#"{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
        "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"../a.bin"}]}"#,
    );
    let run = surfel(&folder, &["convert", "in/a.gltf", "c.ply"]);
    assert!(run.code == 1 && run.stderr.ends_with(", or --allow-outside\n"), "{}", run.stderr);
    for (words, expected) in [
        (["convert", "--help"], "any file that `surfel info` reads"),
        (["render", "--help"], "any model or scan that `surfel info` reads"),
    ] {
        let help = surfel(&folder, &words).stdout;
        assert!(help.contains(expected) && !help.contains("PLY or OBJ"), "{help}");
    }
}

#[test]
fn info_tells_why_something_is_drawn_as_it_is() {
    let folder = Folder::new();
    folder.write("cube.obj", CUBE);
    folder.write("disk.ply", super::splats("0 0 0 0 0 1 1 255 0 0\n"));
    folder.write("scan.xyz", rows(grid(5, 0.0)));
    let json = done(&folder, &["info", "cube.obj", "disk.ply", "scan.xyz", "--json"]).stdout;
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    for (i, words) in [
        "too coarse for splats (disks at its vertices would stand ",
        "its file holds splats",
        "points become disks that close their surface",
    ]
    .iter()
    .enumerate()
    {
        let because = json["inputs"][i]["because"].as_str().unwrap();
        assert!(because.starts_with(words), "{because}");
    }
    let told = done(&folder, &["info", "cube.obj"]).stdout;
    assert!(told.contains("\n  drawn as  triangles\n  because   too coarse for splats ("), "{told}");
    let told = done(&folder, &["info", "cube.obj", "--representation", "mesh"]).stdout;
    assert!(told.contains("\n  drawn as  triangles\n  because   asked for\n"), "{told}");
    let told = done(&folder, &["info", "disk.ply"]).stdout;
    assert!(told.contains("holds     1 splat\n") && told.contains("drawn: 1 splat of disk.ply\n"), "{told}");
    folder.write("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let told = done(&folder, &["info", "one.obj"]).stdout;
    assert!(
        told.contains("3 vertices, 1 triangle\n") && told.contains("drawn: 1 triangle of one.obj\n"),
        "{told}"
    );
}

#[test]
fn sides_of_normals_and_a_moved_origin_are_told() {
    let folder = Folder::new();
    folder.write("here.xyz", rows(grid(20, 0.0)));
    folder.write("far.xyz", rows(grid(20, 300.0).map(|[x, y, z]| [x + 500_000.0, y + 4_600_000.0, z])));
    let json = |name: &str| -> serde_json::Value {
        serde_json::from_str(&done(&folder, &["info", name, "--json"]).stdout).unwrap()
    };
    let (here, far) = (json("here.xyz"), json("far.xyz"));
    let notes = here["inputs"][0]["notes"].as_array().unwrap();
    assert!(notes.iter().any(|note| note["deed"] == "turned" && note["count"] == 400), "{notes:?}");
    assert!(here["scene"]["origin_shift"].is_null());
    let shift = far["scene"]["origin_shift"].as_array().unwrap();
    assert!(
        shift
            .iter()
            .zip([500_010.0, 4_600_010.0, 300.0])
            .all(|(at, near)| (at.as_f64().unwrap() - near).abs() < 2.0)
    );
    let told = done(&folder, &["info", "far.xyz"]).stdout;
    assert!(told.contains("  note      400 normals, to one side, turned\n"), "{told}");
    assert!(told.contains("  origin    moved to 5000"), "{told}");
    // Nothing is lost by either.
    for (name, is_moved) in [("here.xyz", false), ("far.xyz", true)] {
        let run = done(&folder, &[&["render", name, "--strict"][..], &SIZE].concat());
        assert!(run.stderr.contains("from 12 neighbors each, turned to one side\n"), "{}", run.stderr);
        assert_eq!(run.stderr.contains("\nthe origin is moved to 5000"), is_moved, "{}", run.stderr);
    }
    // But for places that are no numbers of 32 bits, as a map's are not.
    let coarse: String = (0..400)
        .map(|i| format!("{} {} 3\n", 0.25 * f64::from(i % 20), 4_600_000.0 + 0.5 * f64::from(i / 20)))
        .collect();
    folder.write("coarse.xyz", coarse + "0 4600000 3\n");
    let run = done(&folder, &[&["render", "coarse.xyz"][..], &SIZE].concat());
    let words = "1 duplicate merged; numbers of 32 bits tell places to 0.5 here: export 64 bits, or from a nearer origin";
    assert!(run.stderr.contains(words), "{}", run.stderr);
    let seen = "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 400\nHEIGHT 1\n\
        VIEWPOINT 10 10 30 1 0 0 0\nPOINTS 400\nDATA ascii\n";
    folder.write("seen.pcd", seen.to_owned() + &rows(grid(20, 0.0)));
    let run = done(&folder, &[&["render", "seen.pcd"][..], &SIZE].concat());
    assert!(run.stderr.contains("each, turned toward the scanner\n"), "{}", run.stderr);
}

#[test]
fn an_empty_picture_names_what_cuts_the_scene_away() {
    let folder = Folder::new();
    folder.write("disk.ply", super::splats("0 0 0 0 0 1 1 255 0 0\n"));
    for (words, expected) in [
        (&["--near", "1e6"][..], "all of the scene is nearer than --near 1000000; try without --near"),
        (&["--clip-plane", "0,0,1,99999"], "--clip-plane may leave nothing of what the camera looks at"),
        (&["--clip-box", "8,8,8,9,9,9"], "--clip-box may leave nothing of what the camera looks at"),
        (&["--eye", "5,0,0"], "is seen edge-on"),
    ] {
        for subcommand in ["render", "reference"] {
            let run = done(&folder, &[&[subcommand, "disk.ply"][..], &SIZE, words].concat());
            assert!(run.stderr.contains(expected), "{subcommand} {words:?}: {}", run.stderr);
        }
    }
}

#[test]
fn options_that_a_scene_file_has_keys_for_are_not_ignored_in_silence() {
    let folder = Folder::new();
    folder.write("cube.obj", CUBE);
    folder.write("a.toml", "[[object]]\nfile = \"cube.obj\"\n");
    let run = done(&folder, &["info", "a.toml", "--representation", "splats", "--resample", "99"]);
    let expected = "a.toml: without --representation and --resample, as the keys of its objects say how they are drawn\n";
    assert!(run.stderr.starts_with(expected), "{}", run.stderr);
    for words in [&["info", "a.toml"][..], &["info", "cube.obj", "--resample", "99"]] {
        let run = done(&folder, words);
        assert!(!run.stderr.contains("without --"), "{}", run.stderr);
    }
}

#[test]
fn why_a_file_is_refused_is_the_only_line() {
    let folder = Folder::new();
    folder.write("good.xyz", rows(grid(5, 0.0)));
    folder.write("extra.obj", format!("{CUBE}v 9 9 9\n"));
    folder.write("bad.xyz", "0 0 0\n1 one 0\n");
    for (words, start) in [
        (&["render", "good.xyz", "bad.xyz", "-o", "a.png"][..], "surfel: bad.xyz: line 2: "),
        (&["info", "extra.obj", "bad.xyz"], "surfel: bad.xyz: line 2: "),
        (&["render", "extra.obj", "--strict", "-o", "a.png"], "surfel: extra.obj: 1 vertex without a face"),
        (&["convert", "extra.obj", "a.ply", "--strict"], "surfel: extra.obj: 1 vertex without a face"),
    ] {
        let run = surfel(&folder, words);
        assert!(run.code == 1 && run.stderr.starts_with(start), "{words:?}: {}", run.stderr);
        assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
    }
    let told = done(&folder, &["render", "extra.obj", "-o", "a.png", "--size", "32x32"]).stderr;
    assert!(told.contains("1 vertex without a face left out") && told.lines().count() > 1, "{told}");
}

#[test]
fn sizes_of_points_are_radii_or_are_told_to_be_ignored() {
    let folder = Folder::new();
    let file = |size: f64| {
        let body: String = grid(9, 0.0).map(|[x, y, z]| format!("{x} {y} {z} {size}\n")).collect();
        let names = ["x", "y", "z", "psize"].map(|name| format!("property float {name}\n")).concat();
        format!("ply\nformat ascii 1.0\nelement vertex 81\n{names}end_header\n{body}")
    };
    folder.write("lengths.ply", file(1.25));
    folder.write("pixels.ply", file(5.0));
    let lengths = done(&folder, &["convert", "lengths.ply", "a.ply"]).stdout;
    assert!(lengths.starts_with("lengths.ply: 81 points: normals found from "), "{lengths}");
    let pixels = done(&folder, &["convert", "pixels.ply", "b.ply"]).stdout;
    assert!(pixels.contains("normals and radii found") && pixels.contains("81 sizes ignored"), "{pixels}");
    assert!(
        surfel(&folder, &["convert", "pixels.ply", "b.ply", "--strict"]).stderr.contains("no lengths here")
    );
}
