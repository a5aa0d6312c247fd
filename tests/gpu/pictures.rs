//! Pictures of a real surface: whole, without a hole.

use crate::common::shared;
use surfel::{
    load::builtin,
    renderer::{Frame, Wanted},
    scene::{Camera, Object, Scene, Settings},
};

const BOTH: Wanted = Wanted { picture: true, linear: false, surface: true, profile: None };

/// Draws an object as the program does when it is given nothing else.
fn draw(object: Object, size_px: [u32; 2]) -> Frame {
    let mut headless = shared();
    let scene = Scene { objects: vec![object], ..Scene::default() };
    let prepared = headless.prepare(&scene, &|_, _| {}).unwrap();
    let settings = Settings { size_px, ..Settings::default() };
    let camera = Camera::fit(&scene.ball().unwrap(), size_px, Camera::DEFAULT_FOV_Y_RAD);
    headless.render(&prepared, &camera, &settings, BOTH).unwrap()
}

/// Empty pixels that can't be reached from the image's border through empty pixels: holes in the silhouette.
fn holes(frame: &Frame) -> usize {
    let [width, height] = frame.size_px.map(|side| side as usize);
    let mut outside = vec![false; width * height];
    let mut open: Vec<usize> = (0..width * height)
        .filter(|i| i % width == 0 || i % width == width - 1 || i / width == 0 || i / width == height - 1)
        .filter(|&i| frame.weight[i] == 0.0)
        .collect();
    while let Some(i) = open.pop() {
        if std::mem::replace(&mut outside[i], true) {
            continue;
        }
        let (x, y) = (i % width, i / width);
        let neighbors = [
            (x > 0).then(|| i - 1),
            (x + 1 < width).then(|| i + 1),
            (y > 0).then(|| i - width),
            (y + 1 < height).then(|| i + width),
        ];
        open.extend(neighbors.into_iter().flatten().filter(|&j| frame.weight[j] == 0.0 && !outside[j]));
    }
    (0..width * height).filter(|&i| frame.weight[i] == 0.0 && !outside[i]).count()
}

fn covered(frame: &Frame) -> usize {
    frame.weight.iter().filter(|weight| **weight > 0.0).count()
}

#[test]
fn the_built_in_model_is_whole_and_colorful() {
    let frame = draw(builtin::relief(builtin::DEFAULT_RELIEF_SPLATS), [512, 512]);
    // The fitted ball fills the image's height but for 5%: a disk of that size, less the relief.
    let share = covered(&frame) as f64 / (512.0 * 512.0);
    println!("built-in: {:.1}% covered, {} holes", 100.0 * share, holes(&frame));
    assert!((0.6..0.75).contains(&share), "{share}");
    assert_eq!(holes(&frame), 0);
    let colors: std::collections::HashSet<[u8; 3]> =
        frame.srgb.iter().map(|[r, g, b, _]| [r / 16, g / 16, b / 16]).collect();
    assert!(colors.len() > 50, "{} colors of 16³", colors.len());
}

#[test]
fn a_hole_would_be_found() {
    let mut frame = draw(builtin::relief(20_000), [128, 128]);
    assert_eq!(holes(&frame), 0);
    frame.weight[64 * 128 + 64] = 0.0;
    assert_eq!(holes(&frame), 1);
}
