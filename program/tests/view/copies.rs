//! What leaves the window: texts by the clipboard, pictures by files.

use serde_json::Value;

use super::{
    CAMERA, clipboard,
    screen::Screen,
    window::{Folder, View, render, surfel},
};

#[test]
fn cameras_and_places_are_in_the_clipboard_with_their_distance() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 400);
    let words = [&["a.ply", "--size", "320x240"], &CAMERA[..]].concat();
    let mut view = View::open(&screen, &folder, &words);
    view.wait_for(&render(&folder, &words));
    assert_eq!(clipboard::text(screen.name()), None);
    let camera = view.camera().join(" ");
    assert!(camera.starts_with("--eye 0.7,0.9,3 "), "{camera}");
    assert_eq!(clipboard::text(screen.name()).as_deref(), Some(&*camera));

    // Both places are those of `surfel render`, and so is what is between them.
    let picks = ["--pick", "150,110", "--pick", "190,140"];
    let run = surfel(&folder, &[&["render"], &words[..], &picks].concat(), &[]);
    let told: Value = serde_json::from_str(&run.stdout).unwrap();
    let number = |value: &Value| value.as_f64().unwrap().to_string();
    let mut copied = String::new();
    for (pixel, pick) in [["150", "110"], ["190", "140"]].iter().zip(told["picks"].as_array().unwrap()) {
        screen.drive(&["mousemove", pixel[0], pixel[1]]);
        screen.key("j");
        let seen = &pick["seen"];
        let place = seen["position"].as_array().unwrap().iter().map(number).collect::<Vec<_>>().join(",");
        let place = format!("a.ply, splat {} at {place}, normal ", seen["number"]);
        view.wait("the place is copied", |_| {
            copied = clipboard::text(screen.name()).unwrap_or_default();
            copied.starts_with(&place)
        });
    }
    let distance = number(&told["distances"][0]);
    assert!(copied.ends_with(&format!("; {distance} from the point before")), "{copied}, {distance}");
    view.end();
}

#[test]
fn a_picture_may_be_larger_than_the_window_and_transparent() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 400);
    let picture = ["--samples", "4", "--background", "none"];
    let words =
        [&["a.ply", "--size", "200x150", "--picture-size", "1300x1100"], &picture[..], &CAMERA].concat();
    let mut view = View::open(&screen, &folder, &words);
    view.wait_until("something is shown", |shot| shot.colors() > 20);
    screen.key("i");
    view.wait_for_file("surfel-001.png");
    let words = [&["render", "a.ply", "--size", "1300x1100", "-o", "b.png"], &picture[..], &CAMERA].concat();
    assert_eq!(surfel(&folder, &words, &[]).code, 0);
    let [shown, drawn] =
        ["surfel-001.png", "b.png"].map(|name| image::open(folder.path(name)).unwrap().into_rgba8());
    assert!(shown == drawn, "its bytes are not those of surfel render");
    assert!(shown.pixels().any(|pixel| pixel.0[3] == 0) && shown.pixels().any(|pixel| pixel.0[3] == 255));
    view.end();
}
