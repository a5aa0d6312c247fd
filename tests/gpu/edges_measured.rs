//! The figures of edges in `benches/README.md`: pictures with hard edges and with coverage against 256 samples a pixel, of ordinary things
//! and of thin ones, at three sizes; how little they flicker; what they take.
//!
//! `cargo test --release --test gpu edges_measured -- --ignored --nocapture` takes an hour; a name behind it, as `edges_measured::igea`, minutes.

use std::path::PathBuf;

use crate::common::{
    PICTURE, builder, passes,
    scenes::{self, Hard, transparent},
    shared,
};
use glam::{DQuat, DVec3};
use surfel::{
    compose::compose,
    geometry::{DEFAULT_OVERLAP, splats_from_mesh},
    load::{LoadOptions, Model, builtin::relief, load},
    prepare::PreparedScene,
    reference::{Edge, GroundTruth, TruePixel, ground_truth},
    renderer::{Headless, Wanted},
    report::picture::{PictureError, Region, picture_error, regions},
    scene::{Camera, Edges, Object, Rasterizer, Samples, Scene, Settings},
};

/// Along a picture's side.
const SIZES_PX: [u32; 3] = [64, 256, 1024];

/// Of the truth.
const SAMPLES: u32 = 256;

/// Of the pictures of a model that turns, so many degrees apart.
const TURNS: usize = 3;
const TURN_DEG: f64 = 0.1;

/// Frames timed of each, in turn.
const FRAMES: usize = 11;

fn named(name: &'static str, objects: Vec<Object>) -> Hard {
    let scene = Scene { objects, ..Scene::default() };
    Hard::seen_from([0.0, 0.0, 5.0], name, scene)
}

/// A tube of splats, thinner than two of its disks are wide.
fn wire() -> Object {
    let (around, radius) = (6, 0.004);
    let mut builder = builder::Builder::default();
    for along in 0..1500 {
        let t = f64::from(along) / 1500.0;
        let axis = DVec3::new(2.0 * t - 1.0, 0.6 * (7.0 * t).sin(), 0.5 * (11.0 * t).cos());
        for part in 0..around {
            let angle = std::f64::consts::TAU * f64::from(part) / f64::from(around);
            let out = DVec3::new(0.0, angle.cos(), angle.sin());
            builder.disk(axis + radius * out, out, 0.6 * radius.max(0.002), [0.2, 0.3, 0.5, 1.0]);
        }
    }
    builder.object(true)
}

/// A plate whose two sides are one and a half radii of their disks apart, seen slanted.
fn thin_plate() -> Object {
    let (side, radius) = (60, 0.025);
    let mut builder = builder::Builder::default();
    let turned = DQuat::from_rotation_y(0.7) * DQuat::from_rotation_x(0.4);
    for (x, y) in (-side..=side).flat_map(|x| (-side..=side).map(move |y| (x, y))) {
        let place = DVec3::new(f64::from(x), f64::from(y), 0.0) / f64::from(side);
        for sign in [1.0, -1.0] {
            let normal = sign * DVec3::Z;
            let color = if sign > 0.0 { [0.7, 0.3, 0.2, 1.0] } else { [0.2, 0.3, 0.7, 1.0] };
            builder.disk(turned * (place + 0.75 * radius * normal), turned * normal, radius, color);
        }
    }
    builder.object(false)
}

/// A file of `SURFEL_DATA`; none where it is not there.
fn real(name: &'static str) -> Option<Hard> {
    let folder = std::env::var_os("SURFEL_DATA")
        .map_or_else(|| PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data")), PathBuf::from);
    let path = folder.join(name);
    if !path.exists() {
        println!("SKIPPED: {name} is not there (set SURFEL_DATA to its folder)");
        return None;
    }
    let Model::Mesh(mesh) = load(&path, &LoadOptions::default(), &()).unwrap().model else {
        panic!("{name} is a mesh");
    };
    let (splats, report) = splats_from_mesh(&mesh, DEFAULT_OVERLAP, &());
    Some(named(name, vec![Object { name: name.to_owned(), splats, closed: report.closed }]))
}

fn example(name: &'static str) -> Hard {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("examples").join(name);
    let composed = compose(&path, &LoadOptions::default(), &()).unwrap();
    let camera = composed.camera.camera(&composed.scene.ball().unwrap(), [1024; 2]).unwrap();
    Hard { camera, scene: composed.scene, ..named(name, Vec::new()) }
}

/// A picture in linear light without a background.
fn draw(
    headless: &mut Headless,
    prepared: &PreparedScene,
    camera: &Camera,
    settings: &Settings,
) -> Vec<[f32; 4]> {
    headless.render(prepared, camera, settings, PICTURE).unwrap().linear
}

/// As the ground truth has it. Its edges are those of the oracle's splats, and where a picture's opacity crosses one half.
fn truth_of(hard: &Hard, settings: &Settings, picture: &[[f32; 4]]) -> GroundTruth {
    let [width, height] = settings.size_px.map(|size| size as usize);
    let opaque = Scene { meshes: Vec::new(), ..hard.scene.clone() };
    let mut truth = ground_truth(&opaque, &hard.camera, settings, 3, &|_, _| {}).unwrap();
    let covered = |x: usize, y: usize| picture[y * width + x][3] >= 0.5;
    for (i, pixel) in truth.pixels.iter_mut().enumerate() {
        let [red, green, blue, alpha] = picture[i].map(f64::from);
        let (x, y) = (i % width, i / width);
        let next = [(x + 1).min(width - 1), (y + 1).min(height - 1)];
        let crosses = covered(x, y) != covered(next[0], y) || covered(x, y) != covered(x, next[1]);
        // Splats end where polygons begin: no edge.
        let of_splats = if hard.scene.meshes.is_empty() { pixel.edge } else { Edge::None };
        let edge = if crosses { Edge::Outline } else { of_splats };
        *pixel = TruePixel { coverage: alpha, color: [red, green, blue], edge, ..*pixel };
    }
    truth
}

/// RMS of the change over white from each picture to the next, over the pixels in which the truth changes or this does.
fn flicker(pictures: &[Vec<[f32; 4]>], ends: &[bool]) -> f64 {
    let over_white = |pixel: &[f32; 4], i: usize| f64::from(pixel[3] * pixel[i] + 1.0 - pixel[3]);
    let mut sum = 0.0;
    for pair in pictures.windows(2) {
        for ((a, b), _) in pair[0].iter().zip(&pair[1]).zip(ends).filter(|(_, ends)| **ends) {
            sum += (0..3).map(|i| (over_white(a, i) - over_white(b, i)).powi(2)).sum::<f64>() / 3.0;
        }
    }
    let pixels = ends.iter().filter(|ends| **ends).count() * (pictures.len() - 1);
    (sum / pixels.max(1) as f64).sqrt()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn turned(camera: &Camera, degrees: f64) -> Camera {
    let turn = DQuat::from_axis_angle(camera.up.normalize(), degrees.to_radians());
    Camera { eye: camera.target + turn * (camera.eye - camera.target), ..*camera }
}

fn words(error: &PictureError) -> String {
    let number = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| format!("{value:.4}"));
    let (whole, ends) = (&error.whole, &error.silhouette);
    let figures = [whole.rms(), whole.flip(), error.inside.rms(), ends.rms(), ends.flip()].map(number);
    format!("{} | {:.0}", figures.join(" | "), error.dark_fringe)
}

/// Prints the rows of a scene, under a heading.
fn measure(hard: &Hard) {
    let mut headless = shared();
    println!(
        "| scene | px | edges | whole | FLIP | inside | edges | FLIP | darkest | flicker, x truth's | time, x hard |"
    );
    println!("|---|---:|---|---:|---:|---:|---:|---:|---:|---:|---:|");
    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    for size in SIZES_PX {
        let base = Settings {
            size_px: [size; 2],
            rasterizer: Rasterizer::Compute,
            background: None,
            edges: Edges::Hard,
            ..Settings::default()
        };
        let exact = Settings { samples: Samples(SAMPLES), ..base.clone() };
        let camera = match &hard.scene.meshes[..] {
            [] if hard.name.ends_with("toml") || hard.name.contains("27") => hard.camera,
            [] => Camera::fit(&hard.scene.ball().unwrap(), [size; 2], Camera::DEFAULT_FOV_Y_RAD),
            _ => hard.camera,
        };
        let hard = Hard { camera, ..hard.clone() };
        let views: Vec<Camera> = (0..TURNS).map(|i| turned(&hard.camera, TURN_DEG * i as f64)).collect();
        let few = if size > 256 { 1 } else { views.len() };
        let exact_pictures: Vec<_> =
            views[..few].iter().map(|view| draw(&mut headless, &prepared, view, &exact)).collect();
        let truth = truth_of(&hard, &base, &exact_pictures[0]);
        let ends: Vec<bool> =
            { regions(&truth).into_iter().map(|region| region == Region::Silhouette).collect() };
        let kinds = [Edges::Hard, Edges::Coverage].map(|edges| Settings { edges, ..base.clone() });
        let mut secs = [Vec::new(), Vec::new()];
        for i in 0..FRAMES {
            for (kind, secs) in kinds.iter().zip(&mut secs) {
                let wanted = Wanted { picture: true, ..Wanted::default() };
                let frame = headless.render(&prepared, &hard.camera, kind, wanted).unwrap();
                assert!(!passes(&frame).is_empty());
                if i > 0 {
                    secs.push(frame.wall_secs);
                }
            }
        }
        let ratios = secs[1].iter().zip(&secs[0]).map(|(own, hard)| own / hard).collect();
        let ratio = median(ratios);
        let own = flicker(&exact_pictures, &ends);
        for (i, settings) in kinds.iter().enumerate() {
            let pictures: Vec<_> =
                views[..few].iter().map(|view| draw(&mut headless, &prepared, view, settings)).collect();
            let error = picture_error(&pictures[0], &truth);
            let times =
                if few > 1 { format!("{:.2}", flicker(&pictures, &ends) / own) } else { "-".to_owned() };
            println!(
                "| {} | {size} | {} | {} | {times} | {:.2} |",
                hard.name,
                ["hard", "coverage"][i],
                words(&error),
                if i == 0 { 1.0 } else { ratio }
            );
        }
    }
}

#[test]
#[ignore = "figures: minutes"]
fn relief_of_100_thousand() {
    measure(&named("relief, 100k", vec![relief(100_000)]));
}

#[test]
#[ignore = "figures: minutes"]
fn ball_of_20_thousand() {
    measure(&named("ball, 20k", vec![scenes::sphere(20_000, DVec3::ZERO)]));
}

#[test]
#[ignore = "figures: minutes"]
fn plate() {
    measure(&named("thin plate", vec![thin_plate()]));
}

#[test]
#[ignore = "figures: minutes"]
fn thin_wire() {
    measure(&named("wire", vec![wire()]));
}

#[test]
#[ignore = "figures: minutes"]
fn transparent_balls() {
    measure(&transparent::spheres());
}

#[test]
#[ignore = "figures: minutes"]
fn example_of_balls() {
    measure(&example("spheres.toml"));
}

#[test]
#[ignore = "figures: minutes"]
fn example_of_a_hybrid() {
    measure(&example("hybrid.toml"));
}

#[test]
#[ignore = "figures: minutes"]
fn igea() {
    real("igea.ply").iter().for_each(measure);
}

#[test]
#[ignore = "figures: minutes"]
fn fandisk() {
    real("fandisk.obj").iter().for_each(measure);
}
