//! Scene files: several objects, each with its place and its looks, from one line of the command line.

use super::{
    files::png,
    program::{Folder, Run, done, surfel},
};

/// A red disk, and a triangle.
fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("disk.ply", super::splats("0 0 0 0 0 1 1 255 0 0\n"));
    folder.write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder
}

fn drawn(folder: &Folder, arguments: &[&str]) -> Run {
    done(folder, &[arguments, &["--size", "64x64", "-o", "a.png"]].concat())
}

#[test]
fn objects_are_placed_colored_and_seen_by_the_files_camera() {
    let folder = folder();
    // Two disks side by side, and a board in front of them that nothing hides.
    folder.write(
        "scene.toml",
        "[camera]\neye = [0, 0, 10]\ntarget = [0, 0, 0]\n\
         [[object]]\nfile = \"disk.ply\"\ntranslate = [-2, 0, 0]\n\
         [[object]]\nfile = \"disk.ply\"\nname = \"right\"\ntranslate = [2, 0, 0]\nscale = [1, -1.5, 1]\ncolor = [0, 0, 1]\n",
    );
    for subcommand in ["render", "reference"] {
        let run = drawn(&folder, &[subcommand, "scene.toml", "--shading", "albedo"]);
        let said: Vec<&str> = run.stderr.lines().take(2).collect();
        assert_eq!(said, ["disk.ply: 1 disk", "right: 1 ellipse"], "{subcommand}");
        let picture = png(&folder.path("a.png"));
        // 64 pixels are 2 · 10 · tan 22.5° = 8.28 units high.
        let at = |x: f64, y: f64| picture.at((32.0 + 7.73 * x) as u32, (32.0 - 7.73 * y) as u32);
        assert_eq!((at(-2.0, 0.0), at(2.0, 0.0), at(0.0, 0.0)), ([255, 0, 0], [0, 0, 255], [255; 3]));
        assert_eq!((at(-2.0, 1.25), at(2.0, 1.25)), ([255; 3], [0, 0, 255]));
    }
    // The command line's camera comes first, part by part: from the left, only the left one is in the middle.
    drawn(&folder, &["render", "scene.toml", "--shading", "albedo", "--target", "-2,0,0"]);
    assert_eq!(png(&folder.path("a.png")).at(32, 32), [255, 0, 0]);
    folder.write("cam.json", "{\"eye\":[2,0,9],\"target\":[2,0,0],\"up\":[0,1,0],\"fov_deg\":20}");
    drawn(&folder, &["render", "scene.toml", "--shading", "albedo", "--camera", "cam.json"]);
    assert_eq!(png(&folder.path("a.png")).at(32, 32), [0, 0, 255]);
}

#[test]
fn a_scene_file_stands_beside_other_inputs() {
    let folder = folder();
    folder.write("scene.toml", "[[object]]\nbuiltin = \"sphere\"\nsplats = 500\nalpha = 0.5\n");
    let run = drawn(&folder, &["reference", "triangle.obj", "scene.toml", "--representation", "splats"]);
    let said: Vec<&str> = run.stderr.lines().take(3).collect();
    let told = "scene.toml: without --representation, as the keys of its objects say how they are drawn";
    let triangle = "triangle.obj: 3 vertices, 1 triangle: open, 3 boundary edges; normals and radii computed";
    assert_eq!(said, [told, triangle, "built-in sphere: 500 disks, closed; transparent, alpha 0.5"]);
}

#[test]
fn meshes_are_drawn_as_triangles_where_that_is_asked_for() {
    let folder = folder();
    let run = drawn(&folder, &["reference", "triangle.obj", "--representation", "mesh"]);
    let expected =
        "triangle.obj: 3 vertices, 1 triangle: open, 3 boundary edges; normals computed; drawn as 1 triangle";
    assert_eq!(run.stderr.lines().next(), Some(expected));
    let refused = surfel(&folder, &["render", "disk.ply", "--representation", "mesh"]);
    assert_eq!(refused.code, 1);
    let expected = "surfel: disk.ply: the file holds splats; expected a mesh, to draw its triangles\n";
    assert_eq!(refused.stderr, expected);
    let refused = surfel(&folder, &["render", "--representation", "mesh"]);
    let expected =
        "surfel: --representation: mesh: the built-in model is made of splats; expected an input\n";
    assert_eq!((refused.code, refused.stderr.as_str()), (1, expected));
}

#[test]
fn the_examples_load() {
    let folder = Folder::new();
    let example = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/hybrid.toml");
    let run = drawn(&folder, &["render", example]);
    let said = run.stderr.lines().next().unwrap_or_default();
    assert!(said.starts_with("built-in sphere: ") && said.contains(" of the splats"), "{said}");
    let example = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/spheres.toml");
    let run = drawn(&folder, &["render", example]);
    let expected = "27 × built-in sphere: 20000 disks, closed; transparent, alpha 0.5";
    assert_eq!(run.stderr.lines().filter(|line| *line == expected).count(), 1, "{}", run.stderr);
}

/// By the option and by a scene file; polygons near the eye, splats afar; what is transparent is refused by name.
#[test]
fn a_mesh_is_polygons_or_splats_as_the_view_has_it() {
    let folder = folder();
    let ball = |alpha: f64| {
        format!(
            "[[object]]\nbuiltin = \"sphere\"\nrepresentation = \"hybrid\"\ntriangles = 5000\nalpha = {alpha}\n"
        )
    };
    folder.write("ball.toml", ball(1.0));
    folder.write("glass.toml", ball(0.5));
    let run = drawn(&folder, &["render", "ball.toml", "--lod", "0.1px", "--explain"]);
    let said = run.stderr.lines().next().unwrap_or_default();
    assert!(
        said.contains(" cells and ") && said.contains("triangles or splats, as the view has it"),
        "{said}"
    );
    let explained = |run: &Run| run.stdout.clone() + &run.stderr;
    assert!(explained(&run).contains("choose polygons"), "{}", explained(&run));
    // The mesh itself, and splats alone.
    for options in [["--lod", "0"], ["--eye", "0,0,400"]] {
        let run = drawn(
            &folder,
            &[&["render", "ball.toml", "--target", "0,0,0", "--explain"], &options[..]].concat(),
        );
        assert!(!explained(&run).contains("choose polygons"), "{options:?}: {}", explained(&run));
    }
    let glass = surfel(&folder, &["render", "glass.toml"]);
    assert!(
        glass.code == 1 && glass.stderr.contains("transparent; expected an opaque mesh"),
        "{}",
        glass.stderr
    );
    let disk = surfel(&folder, &["render", "disk.ply", "--representation", "hybrid"]);
    assert!(disk.stderr.contains("disk.ply: the file holds splats; expected a mesh"), "{}", disk.stderr);
}

#[test]
fn faults_are_told_in_one_line_with_their_place() {
    let folder = folder();
    folder.write("camera.toml", "[camera]\nfov_deg = 9\n[[object]]\nfile = \"disk.ply\"\n");
    folder.write("inside.toml", "[camera]\neye = [0, 0, 0]\n[[object]]\nfile = \"disk.ply\"\n");
    folder.write(
        "key.toml",
        "[[object]]\nfile = \"disk.ply\"\n\n[[object]]\nfile = \"disk.ply\"\nalpha = 1.5\n",
    );
    folder.write(
        "hybrid.toml",
        "[[object]]\nfile = \"disk.ply\"\nrepresentation = \"hybrid\"\npolygons.longer_than = 1\n",
    );
    folder.write("itself.toml", "[[object]]\nfile = \"itself.toml\"\n");
    folder.write("same.toml", "[[object]]\nfile = \"disk.ply\"\n");
    let before = folder.names();
    let cases: [(&[&str], &str); 8] = [
        (&["none.toml"], "none.toml: cannot read: No such file or directory (os error 2)"),
        (&["key.toml"], "key.toml: line 6, object 2, alpha: 1.5: expected a number from 0 to 1"),
        (
            &["camera.toml", "camera.toml"],
            "camera.toml: camera: camera.toml has one too; expected one camera",
        ),
        (&["inside.toml"], "inside.toml: camera: eye and target must be two different points"),
        (&["hybrid.toml"], "disk.ply: the file holds splats; expected a mesh, to draw its triangles"),
        (&["same.toml", "--timings", "disk.ply"], "disk.ply: is an input, or written twice"),
        (&["same.toml", "--timings", "./same.toml"], "./same.toml: is an input, or written twice"),
        (&["--representation", "points"], "[possible values: auto, splats, mesh, hybrid]"),
    ];
    for (arguments, expected) in cases {
        let run = surfel(&folder, &[&["render"], arguments].concat());
        assert_eq!((run.code, run.stdout.as_str()), (1, ""), "{}", run.stderr);
        let line = run.stderr.lines().last().unwrap_or_default();
        assert!(line.starts_with("surfel: ") && line.contains(expected), "{}", run.stderr);
        assert_eq!(folder.names(), before, "{arguments:?}");
    }
    let itself = surfel(&folder, &["render", "itself.toml"]);
    assert!(itself.stderr.contains("itself.toml: this is a scene file; expected a PLY, OBJ, STL"));
    let converted = surfel(&folder, &["convert", "same.toml", "b.ply"]);
    let expected = "surfel: same.toml: this is a scene file; expected a PLY, OBJ, STL";
    assert!(converted.stderr.starts_with(expected), "{}", converted.stderr);
}
