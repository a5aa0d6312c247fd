//! Pictures of real surfaces: closed, whole, the right way up and lit from the eye.

use std::path::Path;

use crate::common::shared;
use surfel::{
    geometry::{DEFAULT_OVERLAP, splats_from_mesh},
    load::{Model, builtin, load},
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

#[test]
fn igea_is_whole_upright_and_lit_from_the_eye() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/igea.ply");
    if !path.exists() {
        println!("SKIPPED: {} is not there", path.display());
        return;
    }
    let Model::Mesh(mesh) = load(&path, &()).unwrap() else { panic!("igea.ply is a mesh") };
    let (splats, report) = splats_from_mesh(&mesh, DEFAULT_OVERLAP, &());
    assert!(report.closed);
    let frame = draw(Object { name: "igea".to_owned(), splats, closed: report.closed }, [1024, 1024]);
    println!("igea: {} pixels covered, {} holes", covered(&frame), holes(&frame));
    assert_eq!(holes(&frame), 0);

    // The neck is narrower than the head, and below it: widths at a quarter and near the bottom of what is covered.
    let rows: Vec<usize> = (0..1024)
        .map(|y| frame.weight[y * 1024..(y + 1) * 1024].iter().filter(|weight| **weight > 0.0).count())
        .collect();
    let (first, last) =
        (rows.iter().position(|w| *w > 0).unwrap(), rows.iter().rposition(|w| *w > 0).unwrap());
    let at = |part: f64| rows[first + (part * (last - first) as f64) as usize];
    assert!(at(0.97) < at(0.4), "upside down: {} {}", at(0.97), at(0.4));

    // Light at the eye: pixels that face it are brighter than those at a slant.
    let mean = |facing: std::ops::Range<f32>| {
        let mut sum = (0.0_f64, 0_usize);
        for (normal, color) in frame.normal.iter().zip(&frame.srgb) {
            if normal[3] > 0.0 && facing.contains(&-normal[2]) {
                sum = (sum.0 + f64::from(color[1]), sum.1 + 1);
            }
        }
        sum.0 / sum.1 as f64
    };
    let (front, slant) = (mean(0.9..1.1), mean(0.2..0.4));
    println!("mean green of what faces the eye {front:.0}, at a slant {slant:.0}");
    assert!(front > slant + 40.0);
}
