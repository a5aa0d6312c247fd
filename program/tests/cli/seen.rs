//! From where a picture is taken, and of what of a scene.

use super::{
    files::png,
    inputs::CUBE,
    program::{Folder, done},
    told::{grid, rows},
};

const SIZE: [&str; 2] = ["--size", "64x64"];

#[test]
fn what_may_lie_on_its_back_is_doubted() {
    let folder = Folder::new();
    let walls = grid(41, 0.0)
        .filter(|[_, z, _]| *z > 0.0 && *z < 12.0)
        .flat_map(|[along, z, _]| [[along, 0.0, z], [along, 40.0, z], [0.0, along, z], [40.0, along, z]]);
    let room: Vec<[f64; 3]> = grid(41, 0.0).chain(grid(41, 12.0)).chain(walls).collect();
    folder.write("room.xyz", rows(room.iter().copied()));
    folder.write("cube.obj", CUBE);
    folder.write("eye.toml", "[[object]]\nfile = \"cube.obj\"\n[camera]\neye = [3, 2, 5]\n");
    let doubt = "up is +y, since nothing says otherwise; --up z if it lies on its back\n";
    for (words, doubted) in [
        (&["room.xyz"][..], 1),
        (&["room.xyz", "--up", "z"], 0),
        (&["room.xyz", "--up", "y"], 0),
        (&["cube.obj"], 1),
        (&["eye.toml"], 0),
        (&[], 0),
    ] {
        let run = done(&folder, &[&["render"], words, &SIZE].concat());
        assert_eq!(run.stderr.matches(doubt).count(), doubted, "{words:?}: {}", run.stderr);
    }
}

#[test]
fn what_is_edge_on_from_the_front_is_seen_from_beside() {
    let folder = Folder::new();
    for (name, place, from) in [
        ("ground", (|[x, y, _]| [x, 0.0, y]) as fn([f64; 3]) -> [f64; 3], "above"),
        ("wall", |[x, y, _]| [0.0, x, y], "the right"),
        ("slanted", |[x, y, _]| [x, y, -x], "above"),
        ("front", |place| place, ""),
    ] {
        let file = format!("{name}.xyz");
        folder.write(&file, rows(grid(41, 0.0).map(place)));
        let run = done(&folder, &[&["render", &file], &SIZE[..]].concat());
        let told = format!("seen from {from}, because from the front it is edge-on; --view front if not\n");
        let is_told = name != "front" && name != "slanted";
        assert_eq!(run.stderr.contains(&told), is_told, "{name}: {}", run.stderr);
        assert!(!run.stderr.contains("nothing is seen"), "{name}: {}", run.stderr);
        let front = done(&folder, &[&["render", &file, "--view", "front"], &SIZE[..]].concat());
        assert!(!front.stderr.contains("seen from"), "{name}: {}", front.stderr);
    }
}

#[test]
fn inputs_that_are_far_apart_are_told() {
    let folder = Folder::new();
    let at = |x: f64| rows(grid(5, 0.0).map(move |[a, y, z]| [a + x, y, z]));
    folder.write("here.xyz", at(0.0));
    folder.write("there.xyz", at(4.6e6));
    folder.write("near.xyz", at(900.0));
    let told = "the inputs are so far apart that not all are seen";
    let far = done(&folder, &["render", "here.xyz", "there.xyz", "--size", "64x64"]).stderr;
    assert!(far.contains(told) && far.contains("there.xyz is at 4600002,2,0"), "{far}");
    for words in [&["here.xyz", "near.xyz"][..], &["there.xyz"]] {
        let run = done(&folder, &[&["render"], words, &SIZE].concat());
        assert!(!run.stderr.contains(told), "{words:?}: {}", run.stderr);
    }
    let info = done(&folder, &["info", "here.xyz", "--up", "z"]).stdout;
    assert!(info.contains("up        0,0,1, because --up says so"), "{info}");
}

#[test]
fn what_is_far_from_most_is_not_what_the_picture_shows() {
    let folder = Folder::new();
    let scan = || grid(30, 0.0).map(|[x, y, z]| [x + 5e5, y + 4e6, z]);
    folder.write("zeros.xyz", rows(scan().chain(grid(5, 0.0))));
    folder.write("scan.xyz", rows(scan()));
    let with = done(&folder, &["render", "zeros.xyz", "--up", "y", "-o", "a.png", "--size", "64x64"]).stderr;
    assert!(with.contains("the view is of 97.3% of the scene: the rest is up to "), "{with}");
    let without =
        done(&folder, &["render", "scan.xyz", "--up", "y", "-o", "b.png", "--size", "64x64"]).stderr;
    assert!(!without.contains("the view is of"), "{without}");
    let seen = |name: &str| {
        let picture = png(&folder.path(name));
        picture.pixels.iter().filter(|byte| **byte < 250).count()
    };
    let [a, b] = ["a.png", "b.png"].map(seen);
    assert!(a > 500 && a.abs_diff(b) < a / 4, "{a} {b}");
}

#[test]
fn what_nothing_would_be_seen_of_is_told_or_mended() {
    let folder = Folder::new();
    let place = |[x, y, _]: [f64; 3]| [8.5 + 1e-4 * x, 47.1 + 1e-4 * y, 400.0 + x];
    folder.write("degrees.xyz", rows(grid(20, 0.0).map(place)));
    let told = done(&folder, &[&["render", "degrees.xyz"], &SIZE[..]].concat()).stderr;
    assert!(told.contains("x and y may be longitude and latitude in degrees"), "{told}");
    let points: String = grid(20, 0.0).map(|[x, y, z]| format!("{x} {y} {z} 255 0 0 0\n")).collect();
    let header = "ply\nformat ascii 1.0\nelement vertex 400\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n\
        property uchar green\nproperty uchar blue\nproperty uchar alpha\nend_header\n";
    folder.write("clear.ply", format!("{header}{points}"));
    let told = done(&folder, &[&["render", "clear.ply"], &SIZE[..]].concat()).stderr;
    assert!(
        told.contains("400 alphas that are all 0, by 1, replaced") && !told.contains("nothing is seen"),
        "{told}"
    );
    let small = |radius: &str| {
        let rows: String = grid(20, 0.0).map(|[x, y, z]| format!("{x} {y} {z} {radius}\n")).collect();
        let header = "ply\nformat ascii 1.0\nelement vertex 400\nproperty float x\nproperty float y\nproperty float z\nproperty float radius\nend_header\n";
        folder.write("small.ply", format!("{header}{rows}"));
        done(&folder, &[&["render", "small.ply"], &SIZE[..]].concat()).stderr
    };
    let [told, silent] = ["1e-5", "0.8"].map(small);
    assert!(told.contains("splats are too small for a surface: their radii are 0.00001"), "{told}");
    assert!(!silent.contains("too small"), "{silent}");
    folder.write("part.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid a\n");
    let told = done(&folder, &[&["render", "part.stl"], &SIZE[..]].concat()).stderr;
    assert!(told.contains("up is +z, because part.stl has it, as most STL files; --up y if not"), "{told}");
}
