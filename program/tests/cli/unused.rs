//! Options that mean nothing for what is drawn are told, or refused.

use super::{
    hierarchies,
    inputs::CUBE,
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
    let splats = ["cube.obj", "--representation", "splats", "--layers", "3", "--epsilon", "0.1"];
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
