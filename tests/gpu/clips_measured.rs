//! The figures of splats with sharp edges in `benches/README.md`: pictures of few clipped splats and of many that nothing cuts against the mesh's
//! own, near edges and elsewhere; how far outlines are off from near and far; walls that are thinner than epsilon.
//!
//! `cargo test --release --test gpu clips_measured -- --ignored --nocapture` takes minutes.

mod near_edges;

use std::path::PathBuf;

use crate::common::{PICTURE, builder, shared};
use glam::{DMat3, DVec3};
use near_edges::{Sums, band};
use surfel::{
    geometry::{
        creased_mesh, resample,
        sharp::{Clipping, SharpOptions, sharp_splats},
    },
    hard_scenes::parts::bored_block,
    load::{LoadOptions, Model, load},
    prepare::PreparedScene,
    renderer::Headless,
    scene::{
        Backfaces, Camera, Colors, Edges, Epsilon, Mesh, MeshObject, Object, Rasterizer, Samples, Scene,
        Settings, Shading, Shapes, Splats,
    },
};

const VIEWS: usize = 50;
const SIDE: usize = 256;

/// Of the truth.
const SAMPLES: u32 = 64;

fn settings(side: usize) -> Settings {
    Settings {
        size_px: [side as u32; 2],
        rasterizer: Rasterizer::Compute,
        background: None,
        ..builder::settings()
    }
}

/// By default.
fn ours(side: usize) -> Settings {
    Settings { edges: Settings::default().edges, filter: Settings::default().filter, ..settings(side) }
}

fn draw(headless: &mut Headless, of: &PreparedScene, camera: &Camera, settings: &Settings) -> Vec<[f32; 4]> {
    headless.render(of, camera, settings, PICTURE).unwrap().linear
}

fn object(splats: Splats, closed: bool) -> Scene {
    Scene { objects: vec![Object { name: "splats".to_owned(), splats, closed }], ..Scene::default() }
}

fn polygons(mesh: &Mesh) -> Scene {
    let (mesh, report) = creased_mesh(mesh.clone());
    let mesh = MeshObject { name: "mesh".to_owned(), mesh, closed: report.closed };
    Scene { meshes: vec![mesh], ..Scene::default() }
}

/// The same with normals for colors.
fn with_normals(mesh: &Mesh) -> Scene {
    let mut scene = polygons(mesh);
    let mesh = &mut scene.meshes[0].mesh;
    let color = |normal: &glam::Vec3| {
        let [x, y, z] = (0.5 + 0.5 * *normal).to_array();
        [x, y, z, 1.0]
    };
    mesh.colors = Colors::Each(mesh.normals.as_ref().unwrap().iter().map(color).collect());
    scene
}

fn views(ball: &surfel::scene::Ball) -> Vec<Camera> {
    let fit = Camera::fit(ball, [SIDE as u32; 2], Camera::DEFAULT_FOV_Y_RAD);
    let distance = fit.eye.distance(fit.target);
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let toward = |i: usize| {
        let z = 1.0 - (2.0 * i as f64 + 1.0) / VIEWS as f64;
        let (sin, cos) = (golden * i as f64).sin_cos();
        (1.0 - z * z).sqrt() * DVec3::new(cos, sin, 0.0) + DVec3::new(0.0, 0.0, z)
    };
    (0..VIEWS).map(|i| Camera { eye: fit.target + distance * toward(i), up: DVec3::Z, ..fit }).collect()
}

fn real(name: &str) -> Option<Mesh> {
    let folder = std::env::var_os("SURFEL_DATA")
        .map_or_else(|| PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data")), PathBuf::from);
    let path = folder.join(name);
    match path.exists().then(|| load(&path, &LoadOptions::default(), &()).unwrap().model) {
        Some(Model::Mesh(mesh)) => Some(mesh),
        _ => {
            println!("SKIPPED: {name} is not there (set SURFEL_DATA to its folder)");
            None
        }
    }
}

fn sharp(mesh: &Mesh, count: Option<u64>, clipping: Clipping) -> Scene {
    let options = SharpOptions { splats: count, clipping, ..SharpOptions::default() };
    let (splats, report) = sharp_splats(mesh, &options, &()).unwrap();
    object(splats, report.closed)
}

fn pictures(name: &str, mesh: &Mesh) {
    let mut headless = shared();
    let mut scenes = Vec::new();
    for count in [Some(2_500), Some(5_000), None] {
        for (way, clipping) in
            [("curves", Clipping::Shared), ("lines", Clipping::Lines), ("not cut", Clipping::None)]
        {
            scenes.push((way, sharp(mesh, count, clipping)));
        }
    }
    for count in [5_000, 50_000, 200_000] {
        let (splats, report) = resample(mesh, count, 1, &()).unwrap();
        scenes.push(("resampled", object(splats, report.closed)));
    }
    let truth = headless.prepare(&polygons(mesh), &|_, _| {}).unwrap();
    let normals = headless.prepare(&with_normals(mesh), &|_, _| {}).unwrap();
    let prepared: Vec<_> =
        scenes.iter().map(|(_, scene)| headless.prepare(scene, &|_, _| {}).unwrap()).collect();
    let mut sums: Vec<Sums> = scenes.iter().map(|_| Sums::default()).collect();
    let exact = Settings { samples: Samples(SAMPLES), ..settings(SIDE) };
    for camera in views(&polygons(mesh).ball().unwrap()) {
        let true_picture = draw(&mut headless, &truth, &camera, &exact);
        let flat = Settings { shading: Shading::Albedo, ..settings(SIDE) };
        let near = band(&draw(&mut headless, &normals, &camera, &flat));
        for (of, sums) in prepared.iter().zip(&mut sums) {
            sums.add(&draw(&mut headless, of, &camera, &ours(SIDE)), &true_picture, &near);
        }
    }
    println!("| {name}: splats | KB | | within 2 px of an edge | elsewhere |\n|---:|---:|---|---|---|");
    for ((way, scene), sums) in scenes.iter().zip(&sums) {
        let splats = &scene.objects[0].splats;
        let [near, far] = sums.rms();
        println!("| {} | {} | {way} | {near:.4} | {far:.4} |", splats.len(), splats.bytes() / 1000);
    }
}

#[test]
#[ignore = "figures: minutes"]
fn pictures_of_a_part() {
    pictures("block with a bore", &bored_block(96, 6));
    if let Some(mesh) = real("fandisk.obj") {
        pictures("fandisk", &mesh);
    }
}

/// The flat side of the block around its bore, seen from above: how far its outline is off, in pixels along it.
#[test]
#[ignore = "figures"]
fn outlines_from_three_distances() {
    const SPLATS: u64 = 300;
    let mut headless = shared();
    let side = 400;
    let mesh = bored_block(1024, 16);
    let only = |scene: Scene| {
        let splats = &scene.objects[0].splats;
        let Shapes::Ellipses { s, t } = &splats.shapes else { panic!("ellipses") };
        let keep: Vec<bool> = s.iter().zip(t).map(|(s, t)| s.cross(*t).normalize().z > 0.99).collect();
        let mut splats = splats.clone();
        splats.keep(&keep);
        object(splats, false)
    };
    let flat = Mesh {
        triangles: (0..mesh.triangles.len())
            .filter(|i| mesh.corners(*i).unwrap().iter().all(|p| (p.z - 0.6).abs() < 1e-9))
            .map(|i| mesh.triangles[i])
            .collect(),
        ..mesh.clone()
    };
    let truth = headless.prepare(&polygons(&flat), &|_, _| {}).unwrap();
    let ways = [("curves", Clipping::Shared), ("lines", Clipping::Lines), ("not cut", Clipping::None)];
    let scenes = ways.map(|(name, clipping)| {
        (name, headless.prepare(&only(sharp(&mesh, Some(SPLATS), clipping)), &|_, _| {}).unwrap())
    });
    println!("| | pixels of the bore's radius | off by, in pixels along the outline |\n|---|---:|---:|");
    for zoom in [1.0, 4.0, 16.0] {
        let height = 1.4 / zoom;
        let middle = 0.5 * DMat3::from_rotation_z(0.7) * DVec3::X + 0.6 * DVec3::Z;
        let middle = if zoom > 1.0 { middle } else { 0.6 * DVec3::Z };
        let camera = Camera {
            eye: middle + DVec3::Z,
            target: middle,
            up: DVec3::Y,
            fov_y_rad: 1.0,
            orthographic_height: Some(height),
            near: None,
            ..builder::camera([0.0, 0.0, 1.0], [0.0; 3])
        };
        let exact = Settings { samples: Samples(SAMPLES), backfaces: Backfaces::Flip, ..settings(side) };
        let true_picture = draw(&mut headless, &truth, &camera, &exact);
        let edge = true_picture.iter().filter(|pixel| pixel[3] > 0.02 && pixel[3] < 0.98).count().max(1);
        for (name, scene) in &scenes {
            let settings = Settings { backfaces: Backfaces::Flip, ..ours(side) };
            let picture = draw(&mut headless, scene, &camera, &settings);
            let off: f64 = picture
                .iter()
                .zip(&true_picture)
                .map(|(own, truth)| f64::from((own[3] - truth[3]).abs()))
                .sum();
            println!("| {name} | {:.0} | {:.3} |", 0.5 * side as f64 / height, off / edge as f64);
        }
    }
}

/// A plate of two colors that is thinner than its splats are wide: pixels that show neither.
#[test]
#[ignore = "figures"]
fn thin_walls() {
    let mut headless = shared();
    println!(
        "| thickness over side of a triangle | epsilon | mixed pixels, hard edges | coverage |\n|---:|---|---:|---:|"
    );
    for thin in [0.5, 0.2, 0.05] {
        let plate = plate(24, thin / 24.0);
        let scene = sharp(&plate, None, Clipping::Shared);
        let prepared = headless.prepare(&scene, &|_, _| {}).unwrap();
        for (name, epsilon) in [("1r", Epsilon::Radii(1.0)), ("auto", Epsilon::Auto)] {
            let shares = [Edges::Hard, Edges::Coverage].map(|edges| {
                let (mut mixed, mut all) = (0_u32, 0_u32);
                for camera in views(&scene.ball().unwrap()) {
                    let settings = Settings { epsilon, edges, shading: Shading::Albedo, ..ours(SIDE) };
                    for [red, _, blue, alpha] in draw(&mut headless, &prepared, &camera, &settings) {
                        all += u32::from(alpha > 0.99);
                        mixed += u32::from(alpha > 0.99 && red.min(blue) > 0.02);
                    }
                }
                100.0 * f64::from(mixed) / f64::from(all)
            });
            println!("| {thin} | {name} | {:.2}% | {:.2}% |", shares[0], shares[1]);
        }
    }
}

/// Sides of so many squares, red above and blue below.
fn plate(squares: u32, thickness: f64) -> Mesh {
    let mut mesh = Mesh::default();
    let mut colors = Vec::new();
    let across = squares + 1;
    for side in [1.0, -1.0] {
        for (x, y) in (0..across).flat_map(|x| (0..across).map(move |y| (x, y))) {
            let at = |i: u32| f64::from(i) / f64::from(squares) - 0.5;
            mesh.positions.push(DVec3::new(at(x), at(y), 0.5 * side * thickness));
            colors.push(if side > 0.0 { [1.0, 0.0, 0.0, 1.0] } else { [0.0, 0.0, 1.0, 1.0] });
        }
    }
    let at = |side: u32, x: u32, y: u32| side * across * across + x * across + y;
    for (x, y) in (0..squares).flat_map(|x| (0..squares).map(move |y| (x, y))) {
        let [a, b, c, d] = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)].map(|(x, y)| at(0, x, y));
        mesh.triangles.extend([[a, b, c], [a, c, d]]);
        let [a, b, c, d] = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)].map(|(x, y)| at(1, x, y));
        mesh.triangles.extend([[a, c, b], [a, d, c]]);
    }
    mesh.colors = Colors::Each(colors);
    mesh
}
