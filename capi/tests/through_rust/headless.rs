//! The picture of `alone.c`, by the same device in Rust.

use surfel::{
    Camera, Headless, HeadlessOptions, Scene, Settings, Wanted,
    glam::{DVec3, Vec3},
    scene::{Colors, Object, Shading, Shapes, Splats},
};

/// RGBA of each pixel.
pub fn picture() -> Vec<[u8; 4]> {
    let positions = [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 0.0));
    let colors = vec![[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0], [1.0, 1.0, 0.0, 1.0]];
    let shapes = Shapes::Disks { normals: vec![Vec3::Z; 4], radii: vec![0.9; 4] };
    let splats = Splats::new(positions.to_vec(), shapes, Colors::Each(colors));
    let scene = Scene::from(Object { name: "splats".to_owned(), splats, closed: false });
    let size_px = [96; 2];
    let camera = Camera::fit(&scene.ball().unwrap(), size_px, Camera::DEFAULT_FOV_Y_RAD);
    let settings = Settings { size_px, shading: Shading::Albedo, ..Settings::default() };
    let mut headless = Headless::new(&HeadlessOptions::default()).unwrap();
    let prepared = headless.prepare(&scene, &|_, _| {}).unwrap();
    headless.render(&prepared, &camera, &settings, Wanted::PICTURE).unwrap().srgb
}
