//! Scenes that are hard in one known way each, with the camera that shows it: for the tests, and for the self-test that
//! is shipped.

pub mod builder;
mod clipped;
pub mod parts;
mod shapes;
mod sizes;
pub mod transparent;
mod views;

pub use clipped::clipped;
pub use shapes::{
    coincident, cut_by_a_box, degenerate, far_from_the_origin, random_ellipses, sphere, sphere_of_disks,
};
pub use sizes::{edge_on, larger_than_the_screen, subpixel_filtered, subpixel_unfiltered};
pub use views::{centers_off_screen, cut_by_the_near_plane, ground, parallel_rays};

use crate::scene::{Camera, Filter, Scene, Settings};

/// A scene, its camera, and how it is to be rendered.
#[derive(Clone)]
pub struct Hard {
    /// Its name: what is hard about it.
    pub name: &'static str,
    /// The splats.
    pub scene: Scene,
    /// From where.
    pub camera: Camera,
    /// How, before a method changes it.
    pub settings: Settings,
}

impl Hard {
    /// This scene seen from `eye` toward the origin, drawn as hard scenes are.
    pub fn seen_from(eye: [f64; 3], name: &'static str, scene: Scene) -> Self {
        Self { name, scene, camera: builder::camera(eye, [0.0; 3]), settings: builder::settings() }
    }
}

/// Every hard scene.
pub fn all() -> Vec<Hard> {
    vec![
        sphere_of_disks(),
        random_ellipses(Filter::Adjust),
        random_ellipses(Filter::None),
        edge_on(),
        ground(),
        cut_by_the_near_plane(),
        larger_than_the_screen(),
        centers_off_screen(),
        subpixel_unfiltered(),
        subpixel_filtered(),
        far_from_the_origin(),
        coincident(),
        degenerate(),
        parallel_rays(),
        clipped(),
        cut_by_a_box(),
    ]
}
