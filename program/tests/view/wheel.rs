//! The wheel: it goes to what is under the cursor.

use super::{
    CAMERA,
    screen::Screen,
    window::{Folder, View, render},
};

/// Where the camera is.
fn eye(view: &mut View<'_>) -> [f64; 3] {
    let words = view.camera();
    let at = words.iter().position(|word| word == "--eye").unwrap();
    let numbers: Vec<f64> = words[at + 1].split(',').map(|number| number.parse().unwrap()).collect();
    numbers.try_into().unwrap()
}

#[test]
fn the_wheel_goes_to_the_surface_under_the_cursor_and_never_through_it() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 4000);
    let words = [&["a.ply", "--size", "320x240"], &CAMERA[..]].concat();
    let mut view = View::open(&screen, &folder, &words);
    view.wait_for(&render(&folder, &words));
    // The camera turns about the middle of the ball, behind the surface.
    screen.drive(&["mousemove", "170", "110"]);
    screen.drive(&["click", "--repeat", "30", "--delay", "20", "4"]);
    let near = eye(&mut view);
    let from_middle = near.iter().map(|part| part * part).sum::<f64>().sqrt();
    assert!(from_middle > 0.99 && from_middle < 1.1, "{near:?}");
    // It stays the same place of the surface, so that as many steps back end where they began.
    screen.drive(&["click", "--repeat", "30", "--delay", "20", "5"]);
    let (far, began) = (eye(&mut view), [0.7, 0.9, 3.0]);
    assert!((0..3).all(|i| (far[i] - began[i]).abs() < 1e-6), "{far:?}");
    // Beside the ball there is nothing, and it goes past it.
    screen.drive(&["mousemove", "5", "5"]);
    screen.drive(&["click", "--repeat", "10", "--delay", "20", "4"]);
    let past = eye(&mut view);
    let to = |at: [f64; 3]| (0..3).map(|i| (at[i] - began[i]).powi(2)).sum::<f64>().sqrt();
    assert!(to(past) > 2.0, "{past:?}");
    view.end();
}
