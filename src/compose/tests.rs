use std::{fs, path::PathBuf};

use glam::{DAffine3, DVec3};

use super::*;
use crate::{
    load::{BuiltIn, ObjectDescription, Polygons, Representation, Samples, Source},
    math::srgb::linear_from_srgb,
    scene::{Colors, Shapes},
};

const OCTAHEDRON: &str = "v 1 0 0\nv 0 1 0\nv 0 0 1\nv -1 0 0\nv 0 -1 0\nv 0 0 -1\n\
    f 1 2 3\nf 2 4 3\nf 4 5 3\nf 5 1 3\nf 2 1 6\nf 4 2 6\nf 5 4 6\nf 1 5 6\n";

const SPLATS: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty \
    float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty float radius\nend_header\n\
    0 0 0 0 0 1 1\n1 0 0 0 1 0 1\n2 0 0 0 0 0 1\n";

/// A folder with a mesh and splats.
fn folder() -> temp_dir::TempDir {
    let folder = temp_dir::TempDir::new().unwrap();
    fs::write(folder.path().join("mesh.obj"), OCTAHEDRON).unwrap();
    fs::write(folder.path().join("splats.ply"), SPLATS).unwrap();
    folder
}

fn of_file(folder: &temp_dir::TempDir, name: &str) -> ObjectDescription {
    ObjectDescription::of_file(folder.path().join(name))
}

/// Made as its file says it.
fn make_one(object: &ObjectDescription, progress: &dyn Progress) -> Result<BuiltObject> {
    make(object, &LoadOptions::default(), progress)
}

fn stretched() -> DAffine3 {
    DAffine3 { matrix3: glam::DMat3::from_diagonal(DVec3::new(2.0, -1.0, 1.0)), translation: DVec3::X }
}

#[test]
fn a_scene_file_becomes_a_scene() {
    let folder = folder();
    let path = folder.path().join("scene.toml");
    let text = "[camera]\nfov_deg = 30\n[[light]]\nkind = \"eye\"\nintensity = 0.5\n\
        [[object]]\nfile = \"splats.ply\"\nname = \"two\"\ncolor = [1, 0, 0]\nscale = [1, 1, 0.01]\n\
        [[object]]\nfile = \"mesh.obj\"\nrepresentation = \"mesh\"\nalpha = 0.5\ntranslate = [0, 0, 5]\n\
        [[object]]\nbuiltin = \"sphere\"\nsplats = 500\n";
    fs::write(&path, text).unwrap();
    let Composed { scene, camera, reports, .. } = compose(&path, &LoadOptions::default(), &()).unwrap();
    assert_eq!(camera, CameraParts { fov_y_rad: Some(30_f64.to_radians()), ..CameraParts::default() });
    assert_eq!(scene.lights[0].color, [0.5; 3]);
    assert_eq!((scene.objects.len(), scene.meshes.len(), scene.splat_count()), (2, 1, 502));
    assert!(matches!(scene.objects[0].splats.shapes, Shapes::Ellipses { .. }));
    assert!(matches!(scene.objects[0].splats.colors, Colors::Uniform([1.0, 0.0, 0.0, 1.0])));
    assert_eq!(scene.meshes[0].mesh.bounds().unwrap().max.z, 6.0);
    let summaries: Vec<&str> = reports.iter().map(|report| report.summary.as_str()).collect();
    let expected = [
        "two: 2 ellipses; 1 splat left out: 1 normal zero or not finite",
        "mesh.obj: 6 vertices, 8 triangles: closed; normals computed; drawn as 8 triangles; transparent, alpha 0.5",
        "built-in sphere: 500 disks, closed",
    ];
    assert_eq!(summaries, expected);
    assert_eq!((reports[0].splats, reports[0].dropped, reports[1].splats), (2, 1, 0));
    assert_eq!((reports[1].vertices, reports[1].triangles), (Some(6), Some(8)));
}

#[test]
fn a_mesh_is_placed_before_it_becomes_splats() {
    let folder = folder();
    let representation = Representation::Splats;
    let world_from_object = stretched();
    let object = ObjectDescription { world_from_object, representation, ..of_file(&folder, "mesh.obj") };
    let made = make_one(&object, &()).unwrap();
    let splats = made.splats.unwrap();
    assert!(splats.closed && made.triangles.is_none());
    // It is sharp: each of its corners is ellipses, one to a side, that end where it turns.
    let Shapes::Ellipses { s, t } = &splats.splats.shapes else { panic!("disks") };
    let farthest = splats.splats.positions.iter().map(|position| position.x).fold(0.0, f64::max);
    assert!(farthest > 2.0 && farthest <= 3.0, "{farthest}");
    for ((position, s), t) in splats.splats.positions.iter().zip(s).zip(t) {
        let normal = s.cross(*t).as_dvec3();
        assert!(normal.dot(*position - DVec3::X) > 0.0, "mirrored, and still facing outward");
    }
    let samples = Some(Samples { count: 300, seed: 1 });
    let sampled = make_one(&ObjectDescription { samples, ..object.clone() }, &()).unwrap();
    assert_eq!(sampled.report.splats, 300);
    assert!(sampled.report.summary.ends_with(": closed; resampled with seed 1"));
    let representation = Representation::Mesh;
    let drawn = make_one(&ObjectDescription { representation, ..object }, &()).unwrap();
    let triangles = drawn.triangles.unwrap();
    assert!(triangles.closed && drawn.splats.is_none());
    let steps: Vec<&str> = drawn.steps.iter().map(|step| step.name.as_str()).collect();
    assert_eq!(steps, ["read mesh.obj", "normals of mesh.obj"]);
    for i in 0..8 {
        let [a, b, c] = triangles.mesh.corners(i).unwrap();
        assert!((b - a).cross(c - a).dot(a - DVec3::X) > 0.0);
    }
}

#[test]
fn what_shows_a_mesh_best_is_chosen_and_told() {
    let folder = folder();
    let coarse = make_one(&of_file(&folder, "mesh.obj"), &()).unwrap();
    assert!(coarse.splats.is_none() && coarse.triangles.is_some());
    let expected = "mesh.obj: 6 vertices, 8 triangles: closed; normals computed; drawn as 8 triangles: too coarse \
        for splats (disks at its vertices would stand 50.0% of its size off 100% of its surface); --representation splats \
        draws disks";
    assert_eq!(coarse.report.summary, expected);
    assert_eq!(coarse.report.drawn_as, "triangles");
    // Samples are asked for: whatever the mesh is.
    let samples = Some(Samples { count: 300, seed: 1 });
    let sampled = make_one(&ObjectDescription { samples, ..of_file(&folder, "mesh.obj") }, &()).unwrap();
    assert_eq!((sampled.report.splats, sampled.report.drawn_as), (300, "splats"));
    // A fine ball, as it is where splats are asked for.
    let ball = crate::load::builtin::sphere_mesh(20_480);
    let vertices = ball.positions.iter().map(|p| format!("v {} {} {}\n", p.x, p.y, p.z));
    let faces = ball.triangles.iter().map(|[a, b, c]| format!("f {} {} {}\n", a + 1, b + 1, c + 1));
    fs::write(folder.path().join("ball.obj"), vertices.chain(faces).collect::<String>()).unwrap();
    let auto = of_file(&folder, "ball.obj");
    let asked = ObjectDescription { representation: Representation::Splats, ..auto.clone() };
    let [chosen, asked] = [auto, asked].map(|object| make_one(&object, &()).unwrap());
    assert_eq!(
        chosen.report.because,
        "dense enough for a disk at each vertex (none would stand visibly off its surface); --representation mesh draws \
         triangles"
    );
    assert_eq!(asked.report.because, "asked for");
    assert_eq!(InputReport { because: asked.report.because.clone(), ..chosen.report.clone() }, asked.report);
    let expected = "ball.obj: 10242 vertices, 20480 triangles: closed; normals and radii computed";
    assert_eq!(chosen.report.summary, expected);
}

#[test]
fn what_was_done_and_what_the_file_holds_is_in_the_report() {
    let folder = folder();
    let faulty = format!("{OCTAHEDRON}v 5 5 5\nv 6 6 6\nf 1 2 2\nf 1 1 1\nf 3 3 3\n");
    fs::write(folder.path().join("faulty.obj"), faulty).unwrap();
    let told = |name: &str| {
        let report = make_one(&of_file(&folder, name), &()).unwrap().report;
        let notes: Vec<String> = report.notes.iter().map(|note| note.to_string()).collect();
        (notes, report.model.unwrap())
    };
    let (notes, model) = told("splats.ply");
    assert_eq!(notes, ["1 splat whose normal is zero or not finite left out"]);
    assert_eq!((model.holds, model.points, model.triangles), ("splats", 3, None));
    assert_eq!(model.bounds, Some([[0.0; 3], [2.0, 0.0, 0.0]]));
    assert_eq!([model.normals, model.colors, model.sizes], [true, false, true]);
    let (notes, model) = told("faulty.obj");
    assert!(notes.iter().any(|note| note == "3 triangles without area left out"), "{notes:?}");
    assert!(notes.contains(&"6 normals computed".to_owned()), "{notes:?}");
    assert_eq!((model.holds, model.triangles), ("triangles", Some(11)));
    let points = SPLATS.replace("property float radius\n", "").replace(" 1\n", "\n");
    fs::write(folder.path().join("points.ply"), points.replace("2 0 0 0 0 0", "1 0 0 0 0 1")).unwrap();
    let (notes, model) = told("points.ply");
    assert_eq!(notes, ["1 point at the place of another merged", "2 radii computed"]);
    assert_eq!([model.normals, model.sizes], [true, false]);
}

#[test]
fn what_stands_around_its_scanner_is_not_drawn_from_behind() {
    let folder = folder();
    let at = |i: u32| {
        let z = f64::from(i) / 300.0 - 1.0;
        let ([x, y], r) = ((2.4 * f64::from(i)).sin_cos().into(), (1.0 - z * z).sqrt());
        format!("{} {} {z}\n", r * x, r * y)
    };
    let points: String = (0..600).map(at).collect();
    for (place, around) in [("0.2 0 0", true), ("3 0 0", false)] {
        let fields = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 600\nHEIGHT 1";
        let text = format!("{fields}\nVIEWPOINT {place} 1 0 0 0\nPOINTS 600\nDATA ascii\n{points}");
        fs::write(folder.path().join("scan.pcd"), text).unwrap();
        let made = make_one(&of_file(&folder, "scan.pcd"), &()).unwrap();
        assert_eq!(made.splats.unwrap().closed, around);
        assert_eq!(made.report.summary.contains("not drawn from behind"), around);
    }
}

#[test]
fn the_built_in_ball_is_drawn_as_either() {
    let ball = ObjectDescription {
        alpha: 0.0,
        color: Some([linear_from_srgb(0.5), 0.0, 1.0]),
        ..ObjectDescription::of_built_in(BuiltIn::Sphere)
    };
    let splats = make_one(&ball, &()).unwrap();
    assert_eq!(splats.report.summary, "built-in sphere: 20000 disks, closed; invisible, alpha 0");
    let mesh = make_one(&ObjectDescription { representation: Representation::Mesh, ..ball }, &()).unwrap();
    let expected = "built-in sphere: 10242 vertices, 20480 triangles: closed; normals given; drawn as 20480 \
        triangles; invisible, alpha 0";
    assert_eq!(mesh.report.summary, expected);
    let Colors::Uniform(color) = mesh.triangles.unwrap().mesh.colors else { panic!("one color") };
    assert_eq!(color, [linear_from_srgb(0.5), 0.0, 1.0, 0.0]);
    let board = make_one(&ObjectDescription::of_built_in(BuiltIn::Checkerboard), &()).unwrap();
    assert_eq!(board.report.summary, "built-in checkerboard: 10000 disks");
}

#[test]
fn a_hybrid_is_splats_and_triangles_of_one_name() {
    let folder = folder();
    let x_above = |d| Polygons::Plane { normal: DVec3::X, d };
    let of_mesh = |polygons, sample_edges| ObjectDescription {
        representation: Representation::Hybrid { polygons: Some(polygons), sample_edges },
        world_from_object: stretched(),
        alpha: 0.5,
        ..of_file(&folder, "mesh.obj")
    };
    let made = make_one(&of_mesh(x_above(0.0), true), &()).unwrap();
    let expected = "mesh.obj: 6 vertices, 8 triangles: closed; 133 splats and 8 triangles, which meet at 4 edges with 35 \
        of the splats; transparent, alpha 0.5";
    assert_eq!(made.report.summary, expected);
    let (splats, triangles) = (made.splats.unwrap(), made.triangles.unwrap());
    assert_eq!((splats.name.as_str(), triangles.name.as_str()), ("mesh.obj", "mesh.obj"));
    assert!(splats.closed && triangles.closed, "as the whole mesh is");
    // The object's plane x = 0 is at 1 in the world, and half of the octahedron on either side.
    assert!(splats.splats.positions.iter().all(|position| position.x < 1.0 + 1e-9));
    // Below splats that are small because faces bend, the other half is drawn, too.
    assert_eq!(triangles.mesh.triangles.len(), 8);
    assert!(matches!(splats.splats.colors, Colors::Uniform([.., 0.5])));
    assert!(matches!(triangles.mesh.colors, Colors::Uniform([.., 0.5])));

    // As many as vertices where nothing says how many, all of them where none is moved to an edge.
    let plain = make_one(&of_mesh(x_above(0.0), false), &()).unwrap();
    assert_eq!(plain.report.splats, 5);
    let samples = Some(Samples { count: 300, seed: 1 });
    let many = make_one(&ObjectDescription { samples, ..of_mesh(x_above(0.0), false) }, &()).unwrap();
    assert_eq!(many.report.splats, 300);

    // One part may have everything.
    let all_splats = make_one(&of_mesh(x_above(9.0), true), &()).unwrap();
    assert!(all_splats.triangles.is_none() && all_splats.report.splats == 6);
    let all_triangles = make_one(&of_mesh(x_above(-9.0), true), &()).unwrap();
    assert!(all_triangles.splats.is_none() && all_triangles.report.splats == 0);
    assert!(all_triangles.report.summary.contains("; 0 splats and 8 triangles"));

    let ball = ObjectDescription {
        representation: of_mesh(x_above(0.0), false).representation,
        ..ObjectDescription::of_built_in(BuiltIn::Sphere)
    };
    let half = make_one(&ball, &()).unwrap().report;
    assert!(half.splats.abs_diff(10_000) < 300, "half as many as the whole has: {}", half.splats);
}

#[test]
fn what_cannot_be_made_is_refused_in_the_name_of_its_file() {
    let folder = folder();
    fs::write(folder.path().join("flat.obj"), "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n").unwrap();
    let refused = |object: ObjectDescription| {
        let error = make_one(&object, &()).unwrap_err();
        assert_eq!(error.exit_code(), 1);
        error.to_string().replace(&format!("{}/", folder.path().display()), "")
    };
    let samples = Some(Samples { count: 9, seed: 0 });
    let splats = || of_file(&folder, "splats.ply");
    let flat = || of_file(&folder, "flat.obj");
    let mesh = Representation::Mesh;
    let hybrid = Representation::Hybrid { polygons: Some(Polygons::LongerThan(1.0)), sample_edges: true };
    let cases = [
        (
            ObjectDescription { samples, ..splats() },
            "splats.ply: the file holds splats; expected a mesh, to take samples of its triangles",
        ),
        (
            ObjectDescription { representation: mesh, ..splats() },
            "splats.ply: the file holds splats; expected a mesh, to draw its triangles",
        ),
        (flat(), "flat.obj: no splat can be drawn (flat.obj: 3 vertices, 1 triangle: "),
        (
            ObjectDescription { representation: mesh, ..flat() },
            "flat.obj: no triangle can be drawn (flat.obj: 3 vertices, 1 triangle: ",
        ),
        (ObjectDescription { samples, ..flat() }, "flat.obj: no area to take samples of in 1 triangle"),
        (
            ObjectDescription { representation: hybrid, ..splats() },
            "splats.ply: the file holds splats; expected a mesh, to draw its triangles",
        ),
        (
            ObjectDescription { representation: hybrid, ..flat() },
            "flat.obj: no area to take samples of in 1 triangle",
        ),
        (of_file(&folder, "none.ply"), "none.ply: cannot read: No such file"),
        (of_file(&folder, "scene.toml"), "scene.toml: this is a scene file; expected a PLY, OBJ, STL"),
    ];
    fs::write(folder.path().join("scene.toml"), "[[object]]\n").unwrap();
    for (object, expected) in cases {
        let error = refused(object);
        assert!(error.starts_with(expected), "{error}");
    }
}

#[test]
fn more_than_there_is_memory_for_is_refused_before_anything_is_made() {
    let splats = u64::from(u32::MAX);
    let source = Source::BuiltIn { model: BuiltIn::Sphere, splats, triangles: 1 };
    let large = ObjectDescription { source, ..ObjectDescription::of_built_in(BuiltIn::Sphere) };
    let error = check_memory(&vec![large; 1024]).unwrap_err();
    assert_eq!(error.exit_code(), 1);
    assert_eq!(error.to_string(), "objects: no memory for the 1024 described (527765581209600 bytes)");
    check_memory(&[ObjectDescription::of_file(PathBuf::from("none"))]).unwrap();
}
