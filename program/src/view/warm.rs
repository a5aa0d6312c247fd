//! A picture that nobody sees, drawn while the first files are read: of many small disks of a closed surface, so that a driver that compiles pipelines when they first run has done so by the
//! time that there is something to show. Other splats take other pipelines in part.

use glam::DVec3;
use surfel::{
    Headless,
    load::builtin::relief,
    prepare::PreparedScene,
    scene::{Camera, Scene},
};

/// Few, and seen so far away that each is some pixels large, as those of a scan are.
const SPLATS: usize = 3000;
const DISTANCE: f64 = 17.0;

/// The scene of that picture.
pub fn scene(headless: &Headless) -> Option<PreparedScene> {
    let scene = Scene { objects: vec![relief(SPLATS)], without_auto_epsilon: true, ..Scene::default() };
    // It is of no use but to be fast: what is wrong with the device the first files tell.
    headless.prepare(&scene, &|_, _| {}).ok()
}

/// From where it is seen.
pub fn camera() -> Camera {
    Camera { eye: DVec3::new(0.0, 0.0, DISTANCE), target: DVec3::ZERO, ..Camera::default() }
}
