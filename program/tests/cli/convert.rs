//! `surfel convert`: what it writes, and that it is drawn as its source is.

use std::fs;

use super::{
    files::png,
    program::{Folder, done, surfel},
};

/// A closed octahedron; coordinates that 32 bits have.
const OCTAHEDRON: &str = "v 1 0 0\nv 0 1 0\nv 0 0 1\nv -1 0 0\nv 0 -1 0\nv 0 0 -1\n\
    f 1 2 3\nf 2 4 3\nf 4 5 3\nf 5 1 3\nf 2 1 6\nf 4 2 6\nf 5 4 6\nf 1 5 6\n";

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("octahedron.obj", OCTAHEDRON);
    folder
}

/// Runs a conversion that has to work, and gives its one line.
fn convert(folder: &Folder, arguments: &[&str]) -> String {
    let run = surfel(folder, &[&["convert"], arguments].concat());
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{}", run.stdout);
    assert_eq!(run.stdout.lines().count(), 1, "{}", run.stdout);
    run.stdout.trim_end().to_owned()
}

fn picture(folder: &Folder, model: &str, options: &[&str]) -> Vec<u8> {
    let splats = ["--representation", "splats"];
    done(
        folder,
        &[&["render", model, "-o", "picture.png", "--size", "64x64"], &splats[..], options].concat(),
    );
    fs::read(folder.path("picture.png")).unwrap()
}

#[test]
fn a_converted_mesh_is_drawn_as_the_mesh_itself() {
    let folder = folder();
    let said = convert(&folder, &["octahedron.obj", "splats.ply"]);
    let expected = "octahedron.obj: 6 vertices, 8 triangles: closed; normals and radii computed -> splats.ply: 24 \
        ellipses, marked as closed, ";
    assert!(said.starts_with(expected), "{said}");
    // From inside, where culling shows: the far side faces away.
    let inside = ["--eye", "0,0,0.2", "--target", "0,0,-1"];
    let culled = picture(&folder, "octahedron.obj", &inside);
    assert_ne!(culled, picture(&folder, "octahedron.obj", &[&inside[..], &["--backfaces", "flip"]].concat()));
    assert_eq!(picture(&folder, "splats.ply", &inside), culled);
    assert_eq!(picture(&folder, "splats.ply", &[]), picture(&folder, "octahedron.obj", &[]));
    // Splats again: the same file.
    convert(&folder, &["splats.ply", "again.ply"]);
    assert_eq!(fs::read(folder.path("again.ply")).unwrap(), fs::read(folder.path("splats.ply")).unwrap());
}

#[test]
fn resampling_repeats_for_a_seed() {
    let folder = folder();
    let run = |output: &str, seed: &[&str]| {
        let said = convert(&folder, &[&["octahedron.obj", output, "--resample", "20k"], seed].concat());
        (said, fs::read(folder.path(output)).unwrap())
    };
    let (said, first) = run("a.ply", &[]);
    let bytes = first.len();
    let expected = "octahedron.obj: 6 vertices, 8 triangles: closed; resampled with seed 0 -> a.ply: 20000 disks, \
        marked as closed, ";
    assert_eq!(said, format!("{expected}{bytes} bytes"));
    assert!(first == run("b.ply", &["--seed", "0"]).1 && first != run("c.ply", &["--seed", "1"]).1);
    assert!(folder.names().iter().all(|name| !name.ends_with(".tmp")), "{:?}", folder.names());
    // The corner of an octahedron that faces the eye covers the middle of the picture.
    let drawn = surfel(&folder, &["render", "a.ply", "--size", "64x64", "--shading", "albedo"]);
    assert_eq!((drawn.code, drawn.stderr.lines().next()), (0, Some("a.ply: 20000 disks, closed")));
    assert_eq!(super::files::png(&folder.path("surfel.png")).at(32, 32), [204; 3]);
}

#[test]
fn an_old_file_is_replaced_and_a_failure_keeps_it() {
    let folder = folder();
    folder.write("out.ply", "old");
    folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    let run = surfel(&folder, &["convert", "flat.obj", "out.ply", "--resample", "10"]);
    assert_eq!(run.code, 1);
    let expected = "surfel: flat.obj: no area to take samples of in 1 triangle (none has an area within the range of 64-bit numbers)\n";
    assert_eq!(run.stderr, expected);
    assert_eq!(fs::read(folder.path("out.ply")).unwrap(), b"old");
    convert(&folder, &["octahedron.obj", "out.ply"]);
    assert!(fs::read(folder.path("out.ply")).unwrap().starts_with(b"ply\n"));
}

#[test]
fn what_cannot_be_converted_is_refused_in_one_line() {
    let folder = folder();
    convert(&folder, &["octahedron.obj", "splats.ply"]);
    let before = folder.names();
    let cases: [(&[&str], &str); 11] = [
        (&["none.obj", "a.ply"], "none.obj: cannot read: No such file"),
        (&["octahedron.obj", "a.obj"], "a.obj: expected a name in .ply"),
        // Found before the work: an input that is not even there is not looked at.
        (&["none.obj", "none/a.ply"], "none/a.ply: cannot write: there is no folder none"),
        (&["splats.ply", "./splats.ply"], "./splats.ply: is the input; expected another name"),
        (
            &["splats.ply", "a.ply", "--resample", "9"],
            "splats.ply: the file holds splats; expected a mesh, to take samples of its triangles",
        ),
        (
            &["splats.ply", "a.ply", "--max-error", "9"],
            "splats.ply: the file holds splats; expected a mesh, to simplify its triangles",
        ),
        (&["a.xyz", "a.ply", "--columns", "x,y"], "'x,y' for '--columns <LIST>': no columns x, y and z"),
        (
            &["octahedron.obj", "a.ply", "--resample", "0"],
            "'0' for '--resample <N>': expected a number of splats, 1 to 4294967295",
        ),
        (
            &["octahedron.obj", "a.ply", "--resample", "4294967296"],
            "'4294967296' for '--resample <N>': expected a number of splats",
        ),
        (
            &["octahedron.obj", "a.ply", "--resample", "-1"],
            "'-1' for '--resample <N>': expected a number of splats",
        ),
        (&["octahedron.obj", "a.ply", "--seed", "1"], "--resample <N>"),
    ];
    for (arguments, words) in cases {
        let run = surfel(&folder, &[&["convert"], arguments].concat());
        assert_eq!((run.code, run.stdout.as_str()), (1, ""), "{arguments:?}");
        assert!(run.stderr.contains(words) && run.stderr.lines().count() == 1, "{}", run.stderr);
        assert_eq!(folder.names(), before, "{arguments:?}");
    }
}

/// Twelve triangles of a box, each an ellipse that is cut at two ridges.
#[test]
fn a_part_becomes_few_splats_with_sharp_edges() {
    let folder = folder();
    let box_ = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 0 0 3\nv 2 0 3\nv 2 1 3\nv 0 1 3\nf 4 3 2 1\nf 5 6 7 8\n\
        f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    folder.write("box.obj", box_);
    let expected = "box.obj: 8 vertices, 12 triangles: closed; 12 ridges in 12 pieces, 12 splats clipped";
    for arguments in
        [&["--splats", "2500"][..], &["--max-error", "0.01"], &["--splats", "1", "--max-error", "1e-6"]]
    {
        let said = convert(&folder, &[&["box.obj", "a.ply"], arguments].concat());
        let rest = said.strip_prefix(expected).unwrap_or_else(|| panic!("{said}"));
        assert!(rest.contains(" -> a.ply: 12 ellipses, marked as closed, "), "{said}");
        let is_more =
            rest.starts_with(", more splats than the 1 asked for, because no other edge can be left out");
        assert_eq!(is_more, arguments.contains(&"1"), "{said}");
        let header = String::from_utf8_lossy(&fs::read(folder.path("a.ply")).unwrap()[..700]).into_owned();
        assert!(header.contains("property float clip2_w\n") && !header.contains("clip_mode"), "{header}");
    }
    let again = convert(&folder, &["a.ply", "b.ply"]);
    assert!(again.starts_with("a.ply: 12 ellipses, closed -> b.ply"), "{again}");
    assert_eq!(fs::read(folder.path("a.ply")).unwrap(), fs::read(folder.path("b.ply")).unwrap());

    // Where colors vary there are more splats than triangles; what they are off by is told.
    folder.write("square.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 0 1\nv 1 1 0 0 0 1\nv 0 1 0 1 0 0\nf 1 2 3 4\n");
    let few = convert(&folder, &["square.obj", "few.ply", "--splats", "2"]);
    assert!(few.contains("colors off as a distance of up to 2.357e-1 -> few.ply: 2 ellipses"), "{few}");
    let many = convert(&folder, &["square.obj", "many.ply", "--splats", "100"]);
    assert!(
        many.contains("colors off as a distance of") && many.contains("many.ply: 100 ellipses"),
        "{many}"
    );

    // A third triangle at an edge ends there. Its sides are three ridges: one splat has two clips, so that it is several.
    folder.write("fin.obj", &(box_.to_owned() + "v 5 5 5\nf 1 2 9\n"));
    let said = convert(&folder, &["fin.obj", "fin.ply", "--splats", "2500", "--strict"]);
    let expected = "fin.obj: 9 vertices, 13 triangles: open, 1 edge of more than two triangles cut apart; 14 ridges in 14 pieces, 20 splats clipped";
    assert!(said.starts_with(expected) && said.contains("fin.ply: 20 ellipses, "), "{said}");

    let refusals: [(&[&str], &str); 3] = [
        (&["convert", "a.ply", "c.ply", "--splats", "9"], "a.ply: the file holds splats; expected a mesh"),
        (
            &["convert", "box.obj", "c.ply", "--max-error", "0"],
            "'0' for '--max-error <E>': expected a length above 0",
        ),
        (&["convert", "box.obj", "c.ply", "--splats", "9", "--resample", "9"], "cannot be used with"),
    ];
    for (arguments, words) in refusals {
        let run = surfel(&folder, arguments);
        assert_eq!((run.code, run.stdout.as_str()), (1, ""), "{arguments:?}");
        assert!(run.stderr.lines().last().is_some_and(|line| line.contains(words)), "{}", run.stderr);
    }
    // From the front a rectangle, but for some pixels at corners, where faces are seen edge-on; ellipses that nothing cuts have more than twice
    // its area.
    let drawn = surfel(
        &folder,
        &[
            "render", "a.ply", "-o", "c.png", "--size", "64x64", "--edges", "hard", "--ortho", "--view",
            "front", "--zoom", "0.6",
        ],
    );
    assert_eq!(drawn.code, 0, "{}", drawn.stderr);
    let picture = image::open(folder.path("c.png")).unwrap().to_rgb8();
    let inside = |x, y| picture.get_pixel(x, y).0 != [255; 3];
    let rows: Vec<_> =
        (0..64).map(|y| (0..64).filter(|x| inside(*x, y)).count()).filter(|count| *count > 0).collect();
    let wide = rows[rows.len() / 2];
    let (high, all) = (rows.iter().filter(|row| **row >= wide).count(), rows.iter().sum::<usize>());
    assert!(high > 6 && 10 * all < 11 * wide * high, "{rows:?}");
    // Splats as large as the picture have edges that cover pixels in part. In a huge one they are the graphics pipeline's, whose edges are hard, which is told.
    for (size, is_hard) in [("64x64", false), ("900x900", false), ("2200x2200", true)] {
        let words =
            ["render", "a.ply", "-o", "c.png", "--size", size, "--ortho", "--samples", "1", "--explain"];
        let told = surfel(&folder, &words);
        assert_eq!(
            (told.code, told.stdout.contains("(edges are hard, since")),
            (0, is_hard),
            "{}",
            told.stderr
        );
    }
}

/// With 2 GB of address space: the machine that runs this may have room for all of them.
#[test]
#[cfg(target_os = "linux")]
fn more_samples_than_there_is_memory_for() {
    let folder = folder();
    let program = env!("CARGO_BIN_EXE_surfel");
    let command =
        format!("ulimit -v 2000000; exec '{program}' convert octahedron.obj a.ply --resample 4294967295");
    let shell =
        std::process::Command::new("sh").args(["-c", &command]).current_dir(folder.path(".")).output();
    let output = shell.unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(
        said.starts_with("surfel: --resample: no memory for 4294967295 samples (")
            && said.lines().count() == 1
    );
    assert_eq!(folder.names(), ["octahedron.obj"]);
}

#[test]
fn points_are_drawn_without_normals_and_radii() {
    let folder = folder();
    let header = "ply\nformat ascii 1.0\nelement vertex COUNT\nproperty float x\nproperty float y\nproperty float z\n\
        property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
    // A sphere by Fibonacci's spiral, red; its last point twice, and one far away.
    let mut rows: Vec<String> = (0..2000)
        .map(|i| {
            let z = (f64::from(i) + 0.5) / 1000.0 - 1.0;
            let (sin, cos) = (f64::from(i) * 2.399_963_229_728_653).sin_cos();
            let r = (1.0 - z * z).sqrt();
            format!("{} {} {z} 255 0 0\n", r * cos, r * sin)
        })
        .collect();
    rows.extend([rows[1999].clone(), "3 3 3 255 0 0\n".to_owned()]);
    folder.write("points.ply", &(header.replace("COUNT", &rows.len().to_string()) + &rows.concat()));
    let run = done(&folder, &["render", "points.ply", "-o", "points.png", "--size", "64x64"]);
    let told = "points.ply: 2002 points: normals and radii found from 12 neighbors each, turned to one side; 1 duplicate \
        merged, 1 isolated point left out\n";
    assert!(run.stdout.contains(told) || run.stderr.contains(told), "{}{}", run.stdout, run.stderr);
    let png = png(&folder.path("points.png"));
    let is_red = |x: u32, y: u32| png.at(x, y)[0] > 100 && png.at(x, y)[1] < 200;
    // No hole within the disk that the sphere is seen as, which fills most of the picture.
    assert!((0..64).flat_map(|y| (0..64).map(move |x| (x, y))).all(|(x, y)| {
        let (dx, dy) = (f64::from(x) - 31.5, f64::from(y) - 31.5);
        dx.hypot(dy) > 20.0 || is_red(x, y)
    }));
    let refused = surfel(&folder, &["convert", "points.ply", "a.ply", "--resample", "9"]);
    assert!(
        refused.stderr.contains("points.ply: the file holds points; expected a mesh"),
        "{}",
        refused.stderr
    );
    let said = convert(&folder, &["points.ply", "splats.ply"]);
    assert!(said.contains("-> splats.ply: 2000 disks"), "{said}");
}
