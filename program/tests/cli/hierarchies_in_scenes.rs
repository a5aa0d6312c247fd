//! Files of levels of detail as objects of scene files, and several of them in one picture.

use super::{
    files::png,
    hierarchies::folder,
    program::{Folder, done, surfel},
};

/// The pixels of a scene file's picture, and what was told.
fn picture(folder: &Folder, arguments: &[&str]) -> (Vec<u8>, String) {
    let drawn = done(folder, &[&["render", "-o", "picture.png", "--size", "96x96"], arguments].concat());
    (png(&folder.path("picture.png")).pixels, drawn.stderr)
}

/// How many values differ by more than rounding.
fn others(a: &[u8], b: &[u8]) -> usize {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).filter(|(a, b)| a.abs_diff(**b) > 2).count()
}

/// A scene file with one object that has these keys, of a file of splats and of one of levels of detail.
fn written(folder: &Folder, keys: &str) {
    for (name, model) in [("splats.toml", "splats.ply"), ("levels.toml", "a.surfel")] {
        let camera = "[camera]\neye = [0.4, 0.8, 5]\ntarget = [0, 0, 0]\n";
        folder.write(name, format!("{camera}[[object]]\nfile = \"{model}\"\n{keys}\n"));
    }
}

/// With hard edges, of which no estimate of how splats overlap is a part: that of a file is of its splats as they were written.
#[test]
fn it_stands_in_a_scene_as_its_splats_do() {
    let folder = folder("60k");
    done(&folder, &["convert", "splats.ply", "a.surfel"]);
    let mut pictures = Vec::new();
    for keys in [
        "",
        "translate = [0.5, -0.3, -1]\nrotate_deg = [20, 50, -70]\nscale = 1.5",
        "scale = [-1, 1, 1]\nrotate_deg = [0, 40, 0]\ncolor = [0.9, 0.2, 0.1]",
        "scale = [1.5, 0.5, -0.8]\nrotate_deg = [30, 0, 0]",
        "matrix = [[1, 0.5, 0, 0], [0, 0.8, 0.2, 0.1], [0, 0, 1, -0.4]]",
        "alpha = 0.5\ncolor = [0.1, 0.5, 0.9]\ntranslate = [0, 0.4, 0]",
        "alpha = 0",
    ] {
        written(&folder, keys);
        let of = |file: &str| picture(&folder, &[file, "--lod", "0", "--edges", "hard", "--samples", "1"]);
        let ((splats, _), (levels, told)) = (of("splats.toml"), of("levels.toml"));
        // A pixel at a rim.
        assert!(others(&splats, &levels) <= 3, "{keys}: {}", others(&splats, &levels));
        assert!(told.contains("a.surfel: read "), "{told}");
        // By its nodes, too, much the same is seen.
        let (nodes, _) = picture(&folder, &["levels.toml", "--edges", "hard", "--samples", "1"]);
        let sum: u64 = nodes.iter().zip(&splats).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
        assert!(sum < 2 * splats.len() as u64, "{keys}: {sum}");
        pictures.push(levels);
    }
    let (first, rest) = pictures.split_first().unwrap();
    assert!(rest.iter().all(|picture| others(first, picture) > 1000));
    assert!(rest.last().unwrap().iter().all(|value| *value == 255), "what is invisible is seen");
}

/// Turned, twice as large and moved, and seen from where that looks alike, it is the same picture of the same pages.
#[test]
fn its_nodes_are_drawn_where_they_are_of_the_file_as_it_was_written() {
    let folder = folder("60k");
    done(&folder, &["convert", "splats.ply", "a.surfel"]);
    folder.write(
        "turned.toml",
        "[camera]\neye = [-0.6, 2.8, 13]\ntarget = [1, 2, 3]\nup = [-1, 0, 0]\n\
         [[object]]\nfile = \"a.surfel\"\nmatrix = [[0, -2, 0, 1], [2, 0, 0, 2], [0, 0, 2, 3]]\n",
    );
    let as_written = ["a.surfel", "--eye", "0.4,0.8,5", "--target", "0,0,0", "--up", "0,1,0"];
    for lod in ["0", "1px", "3px"] {
        let [(own, told), (turned, told_turned)] = [&as_written[..], &["turned.toml"]]
            .map(|words| picture(&folder, &[words, &["--lod", lod]].concat()));
        assert!(others(&own, &turned) <= 3, "{lod}: {}", others(&own, &turned));
        let read = |told: &str| told.lines().find(|line| line.contains(": read ")).map(str::to_owned);
        assert_eq!(read(&told), read(&told_turned));
    }
}

/// The default is a pixel, and pages are those that the view needs.
#[test]
fn a_view_reads_what_it_needs_of_each_object() {
    let folder = folder("60k");
    done(&folder, &["convert", "splats.ply", "a.surfel"]);
    let object = |name: &str, x: f64| {
        format!("[[object]]\nfile = \"a.surfel\"\nname = \"{name}\"\ntranslate = [{x}, 0, 0]\n")
    };
    let text = format!(
        "[camera]\ntarget = \"near\"\n{}{}[[object]]\nbuiltin = \"sphere\"\ntranslate = [0, 2, 0]\n",
        object("near", 0.0),
        object("far", 300.0)
    );
    folder.write("scene.toml", text);
    let (_, told) = picture(&folder, &["scene.toml"]);
    let read = |name: &str| {
        let line = told.lines().find(|line| line.starts_with(&format!("{name}: read "))).expect(&told);
        line.split(' ').nth(2).unwrap().parse::<u32>().unwrap()
    };
    assert!(read("near") > 0 && read("far") == 0, "{told}");
    assert!(told.contains("near: 60000 disks, closed; "), "{told}");
    // One of them may have all of the memory.
    folder.write("two.toml", object("near", 0.0) + &object("far", 300.0));
    let within = |files: &[&str]| {
        let rest = ["--budget-memory", "3MB", "--lod", "0.5px", "--eye", "0,0,4", "--target", "0,0,0"];
        picture(&folder, &[files, &rest[..]].concat()).1
    };
    let (alone, both) = (within(&["a.surfel"]), within(&["two.toml"]));
    let drawn_with = |told: &str| {
        let line = told.lines().find(|line| line.contains("does not suffice")).map(str::to_owned);
        line.unwrap_or_else(|| panic!("{told}"))
    };
    assert_eq!(drawn_with(&both), drawn_with(&alone));
    // Two at one place need twice as much for one size, and so are coarser.
    let size = |told: &str| {
        let line = drawn_with(told);
        line.split_once("drawn with --lod ").unwrap().1.split_once("px").unwrap().0.parse::<f64>().unwrap()
    };
    let twice = within(&["a.surfel", "a.surfel"]);
    assert!(size(&twice) > size(&alone), "{twice} {alone}");
    let info = done(&folder, &["info", "scene.toml"]).stdout;
    assert!(info.contains("60000 splats of near") && info.contains("60000 splats of far"), "{info}");
}

#[test]
fn what_it_can_not_be_is_refused_in_one_line() {
    let folder = folder("2k");
    done(&folder, &["convert", "splats.ply", "a.surfel"]);
    let bytes = std::fs::read(folder.path("a.surfel")).unwrap();
    folder.write("cut.surfel", &bytes[..bytes.len() / 2]);
    let mut damaged = bytes.clone();
    damaged[400] ^= 1;
    folder.write("damaged.surfel", damaged);
    let refused = |arguments: &[&str], words: &str| {
        let run = surfel(&folder, arguments);
        assert!(run.code == 1 && run.stderr.contains(words), "{words}: {}", run.stderr);
        let last = run.stderr.trim_end().lines().last().unwrap();
        assert!(last.starts_with("surfel: ") && last.contains(words), "{}", run.stderr);
    };
    for (object, words) in [
        ("file = \"none.surfel\"", "none.surfel: cannot read"),
        ("file = \"cut.surfel\"", "cut.surfel: header: "),
        ("file = \"damaged.surfel\"", "damaged.surfel: page "),
        (
            "file = \"a.surfel\"\nrepresentation = \"mesh\"",
            "a.surfel: the file holds splats; expected a mesh, to draw its triangles",
        ),
        (
            "file = \"a.surfel\"\nresample = 900",
            "a.surfel: the file holds splats; expected a mesh, to take samples of its triangles",
        ),
        (
            "file = \"a.surfel\"\nepsilon = 0.1",
            "a.surfel: epsilon: nodes of levels of detail have that of the picture; expected none",
        ),
        ("file = \"a.surfel\"\nscale = 1e300", "a.surfel: placed farther out than 1e"),
        ("file = \"a.surfel\"\nscale = 1e-60", "can't be drawn where the object is placed"),
    ] {
        folder.write("scene.toml", format!("[[object]]\n{object}\n"));
        refused(&["render", "scene.toml", "-o", "b.png", "--size", "32x32"], words);
    }
    folder.write(
        "scene.toml",
        "[camera]\ntarget = \"other\"\n[[object]]\nfile = \"a.surfel\"\nname = \"it\"\n",
    );
    refused(&["render", "scene.toml"], "no object is called 'other'");
    folder.write("it.toml", "[[object]]\nfile = \"a.surfel\"\nname = \"it\"\n");
    refused(
        &["render", "it.toml", "--target", "that"],
        "no object is called 'that'; expected a point, or 'it'",
    );
    // What compares methods of splats reads none.
    folder.write("scene.toml", "[[object]]\nfile = \"a.surfel\"\n");
    refused(
        &["compare", "scene.toml"],
        "a .surfel file, which render, view and info take on the command line and in scene files, and others do not",
    );
}
