//! What is seen in a pixel, told by the program.

use serde_json::Value;

use super::program::{Folder, done, surfel};

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write(
        "disks.ply",
        super::splats("5 5 5 0 0 1 0.1 9 9 9\n0 0 0 0 0 1 1 200 10 10\n0.5 0 2 0 0 1 0.25 10 200 10\n"),
    );
    folder.write("square.obj", "v -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nf 1 2 3\nf 1 3 4\n");
    folder
}

/// Straight from above the origin, 10 pixels a unit.
const VIEW: [&str; 8] = ["--eye", "0,0,9", "--target", "0,0,0", "--orthographic", "4", "--size", "40x40"];

fn picked(folder: &Folder, words: &[&str]) -> Value {
    let run = done(folder, &[&["render"], words, &VIEW].concat());
    serde_json::from_str(&run.stdout).unwrap()
}

#[test]
fn places_objects_and_distances_are_told_and_no_picture_is_written() {
    let folder = folder();
    let pixels = ["--pick", "17,19", "--pick", "24,19", "--pick", "0,0", "--pick", "24,19"];
    let report = picked(&folder, &[&["disks.ply"], &pixels[..]].concat());
    let seen = |i: usize| &report["picks"][i]["seen"];
    let near = |value: &Value, expected: f64| (value.as_f64().unwrap() - expected).abs() < 1e-5;
    // The centers of pixels: (17.5 - 20) / 10 and so on; y is up.
    let place = &seen(0)["position"];
    assert!(near(&place[0], -0.25) && near(&place[1], 0.05) && near(&place[2], 0.0), "{place}");
    assert!(near(&seen(0)["depth"], 9.0) && near(&seen(0)["normal"][2], 1.0));
    assert_eq!(
        (&seen(0)["object"], &seen(0)["part"], &seen(0)["number"]),
        (&"disks.ply".into(), &"splat".into(), &1.into())
    );
    assert_eq!(seen(1)["number"], 2);
    assert!(near(&seen(1)["position"][2], 2.0));
    assert!(seen(2).is_null() && report["picks"][2]["pixel"] == serde_json::json!([0, 0]));
    let distance = (0.7_f64.powi(2) + 4.0).sqrt();
    assert!(near(&report["distances"][0], distance), "{report}");
    assert!(report["distances"][1].is_null() && report["distances"][2].is_null());
    assert!(!folder.names().contains(&"surfel.png".to_owned()));
    // Of a part of the picture, its own pixels.
    let part = picked(&folder, &["disks.ply", "--pick", "4,3", "--crop", "20,16,9,9", "-o", "a.png"]);
    assert_eq!(part["picks"][0]["seen"]["number"], 2);
    assert!(folder.names().contains(&"a.png".to_owned()));
}

#[test]
fn triangles_have_their_numbers_and_pixels_elsewhere_are_refused() {
    let folder = folder();
    let mesh = ["square.obj", "disks.ply"];
    let report =
        picked(&folder, &[&mesh[..], &["--pick", "22,22", "--pick", "17,17", "--pick", "24,19"]].concat());
    let seen = |i: usize| &report["picks"][i]["seen"];
    for (i, number) in [(0, 0), (1, 1)] {
        assert_eq!((&seen(i)["part"], &seen(i)["number"]), (&"triangle".into(), &number.into()), "{report}");
        assert_eq!(seen(i)["object"], "square.obj");
        assert!((seen(i)["position"][2].as_f64().unwrap() - 1.0).abs() < 1e-5);
    }
    assert_eq!((&seen(2)["part"], &seen(2)["object"]), (&"splat".into(), &"disks.ply".into()));
    let run = surfel(&folder, &[&["render", "disks.ply", "--pick", "40,0"], &VIEW[..]].concat());
    assert_eq!(run.code, 1);
    assert!(run.stderr.contains("--pick: 40,0: expected a pixel of 40x40"), "{}", run.stderr);
    let run = surfel(&folder, &["render", "--pick", "1.5,2"]);
    assert!(
        run.code == 1 && run.stderr.contains("expected a pixel from the picture's top left corner"),
        "{}",
        run.stderr
    );
}
