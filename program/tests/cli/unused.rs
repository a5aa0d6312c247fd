//! Options that mean nothing for what is drawn are told, or refused.

use super::{
    hierarchies,
    inputs::CUBE,
    octrees,
    program::{Folder, done, surfel},
};

const SIZE: [&str; 2] = ["--size", "32x32"];

#[test]
fn what_changes_splats_alone_is_told_where_triangles_are_drawn() {
    let folder = Folder::new();
    folder.write("cube.obj", CUBE);
    folder.write("a.toml", "[[object]]\nfile = \"cube.obj\"\n");
    let told =
        |words: &[&str]| done(&folder, &[&["render", "-o", "a.png"][..], &SIZE, words].concat()).stderr;
    let all = [
        "--lod",
        "2px",
        "--budget",
        "1000",
        "--outlines",
        "splats",
        "--epsilon",
        "0.1",
        "--rasterizer",
        "compute",
        "--filter",
        "adjust",
        "--splat-format",
        "packed",
        "--layers",
        "3",
        "--budget-memory",
        "9MB",
    ];
    let names = "--rasterizer, --filter, --lod, --budget, --epsilon, --layers, --outlines, --splat-format and --budget-memory";
    let because = "no effect: this scene is drawn as triangles";
    let line = format!("{names} have {because}; --representation splats draws it as splats\n");
    let said = told(&[&["cube.obj"], &all[..]].concat());
    assert!(said.contains(&line), "{said}");
    let said = told(&["a.toml", "--lod", "2px"]);
    let line =
        format!("--lod has {because}; representation = \"splats\" of its objects draws it as splats\n");
    assert!(said.contains(&line), "{said}");
    // Where they do something, or nobody gave them, nothing is said.
    let splats = ["cube.obj", "--representation", "splats", "--epsilon", "0.1"];
    for words in
        [&splats[..], &["cube.obj", "--shading", "normals", "--samples", "2", "--edges", "hard"], &["a.toml"]]
    {
        let said = told(words);
        assert!(!said.contains("no effect"), "{words:?}: {said}");
    }
    // Glass is drawn in layers, of triangles, too.
    folder.write("glass.toml", "[[object]]\nfile = \"cube.obj\"\nrepresentation = \"mesh\"\nalpha = 0.5\n");
    let said = told(&["glass.toml", "--layers", "3", "--outlines", "splats"]);
    assert!(said.contains("--outlines has no effect") && !said.contains("--layers"), "{said}");
}

/// Options, and why they have no effect on opaque disks.
const OF_OPAQUE_DISKS: [(&[&str], &str); 15] = [
    (&["--budget-memory", "9MB"], "--budget-memory has no effect: it is for .surfel files, COPC and Potree"),
    (
        &["--lod-steps", "blend"],
        "--lod-steps has no effect: this scene has no levels of detail; --lod 1px makes them",
    ),
    (
        &["--lod-steps", "blend", "--lod", "1px", "--edges", "hard"],
        "--lod-steps has no effect: levels blend by tiles alone, with --edges coverage",
    ),
    (
        &["--layers", "3", "--last-layer", "drop"],
        "--layers and --last-layer have no effect: nothing of this scene is transparent",
    ),
    (&["--transition", "none"], "--transition has no effect: this scene has no triangles"),
    (&["--filter", "none", "--filter-weight", "unit"], "--filter-weight has no effect: only --filter adjust"),
    (
        &["--rasterizer", "quad", "--tile-memory", "9", "--tile-invocations", "pixel"],
        "--tile-invocations and --tile-memory have no effect: --rasterizer quad draws no tiles",
    ),
    (&["--filter", "max", "--tile-memory", "9"], "--tile-memory has no effect: --filter rules out tiles"),
    (&["--rasterizer", "triangle", "--cull", "list"], "--cull has no effect: lists are for points and tiles"),
    (&["--shading", "albedo", "--light", "eye"], "--light has no effect: --shading albedo takes no light"),
    (&["--shading", "edl", "--accumulate", "f16"], "sums have 32 bits: 16 (--accumulate f16) are for points"),
    (
        &["--rasterizer", "compute", "--accumulate", "f16"],
        "sums have 32 bits: 16 (--accumulate f16) are for points",
    ),
    (
        &["--pick", "9,9", "--tonemap", "agx", "--shading", "normals"],
        "--shading and --tonemap have no effect: no picture is drawn beside --pick; --output draws one",
    ),
    (
        &["--pick", "9,9", "--frames", "1", "--explain"],
        "--explain has no effect: no picture is written beside --pick",
    ),
    (&["--columns", "x,y,z"], "1 choice of columns (--columns, of a file without rows of numbers) ignored"),
];

#[test]
fn what_does_nothing_for_a_picture_is_told_with_the_reason() {
    let folder = Folder::new();
    folder.write("cube.obj", CUBE);
    let inputs = ["cube.obj", "--representation", "splats"];
    let told = |words: &[&str]| done(&folder, &[&["render"][..], &inputs, &SIZE, words].concat()).stderr;
    for (words, expected) in OF_OPAQUE_DISKS {
        let output: &[&str] = if words.contains(&"--pick") { &[] } else { &["-o", "a.png"] };
        let said = told(&[words, output].concat());
        assert!(said.contains(expected), "{words:?}: {said}");
    }
    // What is given as it is by default anyway is what happens, and what does something is not told.
    for words in [
        &["--layers", "4", "--lod-steps", "hard", "--transition", "color", "--accumulate", "auto"][..],
        &["--lod", "1px", "--lod-steps", "blend", "--rasterizer", "compute", "--tile-memory", "9"],
        &["--rasterizer", "perspective", "--accumulate", "f16", "--cull", "list", "--light", "eye"],
        &["--pick", "9,9", "--shading", "normals"],
    ] {
        let said = told(&[words, &["-o", "a.png"]].concat());
        assert!(!said.contains("no effect") && !said.contains("sums have"), "{words:?}: {said}");
    }
    let hierarchy = hierarchies::folder("60k");
    done(&hierarchy, &["convert", "splats.ply", "a.surfel"]);
    let words = ["render", "a.surfel", "--size", "64x64", "--budget-memory", "9MB", "--lod-steps", "blend"];
    let said = done(&hierarchy, &words).stderr;
    assert!(!said.contains("no effect"), "{said}");
    let said = done(&hierarchy, &[&words[..], &["--lod", "0"]].concat()).stderr;
    assert!(said.contains("--lod-steps has no effect: --lod 0 draws the scene itself"), "{said}");
    let reference = ["reference", "cube.obj", "--representation", "splats", "--size", "8x8"];
    let said = done(&folder, &[&reference[..], &["--lod", "2px", "--cull", "list"]].concat()).stderr;
    let expected = "--cull and --lod have no effect: the reference draws each splat by itself";
    assert!(said.contains(expected), "{said}");
}

#[test]
fn columns_without_rows_of_numbers_are_told() {
    let folder = Folder::new();
    let columns = ["--columns", "x,y,z"];
    for command in ["render", "reference", "compare"] {
        let run = surfel(&folder, &[&[command][..], &columns].concat());
        let expected = "surfel: --columns: the built-in model is made of splats; expected an input\n";
        assert_eq!((run.code, run.stderr.as_str()), (1, expected), "{command}");
    }
    folder.write("a.toml", "[[object]]\nbuiltin = \"sphere\"\n");
    let said = done(&folder, &[&["render", "a.toml", "-o", "a.png"], &SIZE[..], &columns].concat()).stderr;
    assert!(said.contains("without --columns, as no object is of a file"), "{said}");
    let octree = octrees::folder(2000);
    for words in [
        &["render", "a.copc.laz", "--size", "32x32"][..],
        &["render", "metadata.json", "--size", "32x32"],
        &["info", "a.copc.laz"],
        &["info", "metadata.json"],
    ] {
        let said = done(&octree, &[words, &columns].concat()).stderr;
        assert!(said.contains("1 choice of columns") && said.contains("ignored"), "{words:?}: {said}");
    }
}

#[test]
fn eye_dome_lighting_of_triangles_is_refused_with_the_way_out() {
    let folder = Folder::new();
    folder.write("cube.obj", CUBE);
    let words = ["render", "cube.obj", "-o", "a.png", "--shading", "edl"];
    let run = surfel(&folder, &[&words[..], &SIZE].concat());
    let expected =
        "cube.obj is drawn as triangles, it holds for opaque splats; expected --representation splats";
    assert!(run.code == 1 && run.stderr.contains(expected), "{}", run.stderr);
    done(&folder, &[&words[..], &SIZE, &["--representation", "splats"]].concat());
}

#[test]
fn what_a_table_or_a_checkerboard_makes_nothing_of_is_told_or_refused() {
    let folder = Folder::new();
    let bench = |words: &[&str]| done(&folder, &[&["bench"], words].concat()).stderr;
    let said =
        bench(&["p1", "--splats", "500", "--size", "9x9", "--filter", "none", "--frames", "3", "--validate"]);
    let expected = "--size, --filter, --frames and --validate have no effect: bench p1 draws nothing\n";
    assert!(said.contains(expected), "{said}");
    let small = ["--frames", "1", "--size", "32x32", "--splats", "500"];
    let said = bench(&[&["slides", "--filter", "none"], &small[..]].concat());
    assert!(said.contains("--filter has no effect: bench slides has each method's own"), "{said}");
    let said = bench(&[&["table1", "--lod-steps", "blend"], &small[..]].concat());
    assert!(said.contains("--lod-steps has no effect: bench table1 draws no levels of detail"), "{said}");
    for option in [["--near", "3"], ["--view", "top"], ["--azimuth", "9"], ["--camera-zoom", "2"]] {
        let run = surfel(&folder, &[&["compare", "--zoom"], &option[..]].concat());
        assert!(run.code == 1 && run.stderr.contains("cannot be used with"), "{option:?}: {}", run.stderr);
    }
    for (words, expected) in [
        (&["selftest", "--list", "--verbose"][..], "cannot be used with"),
        (
            &["render", "--turntable", "1", "--frames", "2", "--fps", "9", "-o", "a%02d.exr"],
            "--fps: has no meaning for .exr, of which --frames says how many there are",
        ),
    ] {
        let run = surfel(&folder, words);
        assert!(run.code == 1 && run.stderr.contains(expected), "{words:?}: {}", run.stderr);
    }
}

#[test]
fn a_file_of_levels_has_no_triangles_and_no_columns() {
    let folder = hierarchies::folder("60k");
    done(&folder, &["convert", "splats.ply", "a.surfel"]);
    for (option, value, purpose) in [
        ("--representation", "mesh", "to draw its triangles"),
        ("--representation", "hybrid", "to draw its triangles"),
        ("--resample", "99", "to take samples of its triangles"),
    ] {
        let run = surfel(&folder, &["render", "a.surfel", option, value]);
        let expected = format!("surfel: a.surfel: the file holds splats; expected a mesh, {purpose}\n");
        assert_eq!((run.code, run.stderr), (1, expected));
    }
    let note = "a.surfel: 1 choice of columns (--columns, of a file without rows of numbers) ignored";
    let words = ["info", "a.surfel", "--columns", "x,y,z"];
    let told = done(&folder, &words);
    assert!(told.stderr.contains(note), "{}", told.stderr);
    let strict = surfel(&folder, &[&words[..], &["--strict"]].concat());
    assert!(strict.code == 1 && strict.stderr.contains("1 choice of columns"), "{}", strict.stderr);
    let in_parts = ["convert", "splats.ply", "b.surfel", "--memory", "17MB", "--columns", "x,y,z"];
    let told = done(&folder, &in_parts);
    assert!(
        told.stdout.contains(" parts within ") && told.stderr.contains("1 choice of columns"),
        "{}{}",
        told.stdout,
        told.stderr
    );
    let refused = surfel(&folder, &[&in_parts[..5], &["--splats", "9"]].concat());
    assert!(refused.code == 1, "{}", refused.stdout);
}

#[test]
fn memory_that_does_not_suffice_is_told_with_what_does() {
    let folder = hierarchies::folder("60k");
    done(&folder, &["convert", "splats.ply", "a.surfel"]);
    let told = |memory: &str| {
        done(&folder, &["render", "a.surfel", "--size", "96x96", "--lod", "0.5px", "--budget-memory", memory])
            .stderr
    };
    let said = told("2MB");
    let (_, wanted) = said.split_once("; --lod 0.500px takes ").unwrap_or_else(|| panic!("{said}"));
    let (wanted, rest) = wanted.split_once(", ").unwrap();
    assert!(
        rest.starts_with("220 bytes for each splat on its way to the device and 290 for each node\n"),
        "{said}"
    );
    let said = told(wanted);
    assert!(!said.contains("does not suffice"), "{said}");
}

#[test]
fn a_path_that_is_no_json_is_refused_before_anything_is_read() {
    let folder = Folder::new();
    folder.write("cube.obj", CUBE);
    folder.write("path.json", "{\"version\": 1,\n\"cameras\": [,]}");
    let run = surfel(&folder, &["render", "cube.obj", "--path", "path.json", "-o", "a%02d.png"]);
    let expected = "surfel: path.json: line 2, column 13: expected value, which is no JSON; expected a path of cameras (see surfel render \
        --help)\n";
    assert_eq!((run.code, run.stderr.as_str()), (1, expected));
    folder.write("camera.json", "eye 1 2 3");
    let run = surfel(&folder, &["render", "cube.obj", "--camera", "camera.json"]);
    let expected = "surfel: camera.json: line 1, column 1: expected value, which is no JSON; expected a camera file (see surfel render --help)\n";
    assert_eq!((run.code, run.stderr.as_str()), (1, expected));
}
