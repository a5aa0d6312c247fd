//! Scenes whose picture is known in closed form.

mod affine;
mod attributes;
mod borders;
mod chopped;
mod clip;
mod clipped_pictures;
mod coverage;
mod depth;
mod diagnostics;
mod edge_on;
mod edges;
mod epsilon;
mod ewa;
mod eye_dome;
mod facing;
mod ground_truth;
mod hostile;
mod hybrid;
mod hybrid_levels;
mod last_layer;
mod layers;
mod level_holes;
mod levels;
mod lights;
mod low_pass;
mod meshes;
mod mixed_layers;
mod near_plane;
mod order;
mod overlaps;
mod paper_filter;
mod sharp_edges;

use glam::{DVec3, Vec3};

use super::splat::{DrawnSplat, prepare};
use super::view::View;
use super::{Picture, Pixel, render};
use crate::scene::{
    Camera, Colors, Edges, Epsilon, Filter, FilterWeight, Kernel, Mesh, MeshObject, Object, Rasterizer,
    Scene, Settings, Shapes, Splats,
};

/// World space is view space; 90° in both directions for a square picture: the focal length is half its side.
pub(super) fn camera() -> Camera {
    Camera {
        eye: DVec3::ZERO,
        target: DVec3::Z,
        up: DVec3::NEG_Y,
        fov_y_rad: std::f64::consts::FRAC_PI_2,
        ..Camera::default()
    }
}

/// No filter, so that the splat is drawn as it is.
pub(super) fn settings(side_px: u32) -> Settings {
    let (filter, filter_weight) = (Filter::None, FilterWeight::Unit);
    let edges = Edges::Hard; // what covers in part has tests of its own
    Settings { size_px: [side_px; 2], filter, filter_weight, edges, ..Settings::default() }
}

pub(super) const GRAY: [f32; 4] = [0.25, 0.5, 0.75, 1.0];

/// One splat: center, s, t, color.
pub(super) type Ellipse = (DVec3, Vec3, Vec3, [f32; 4]);

pub(super) fn ellipses(list: &[Ellipse]) -> Scene {
    let splats = Splats::new(
        list.iter().map(|e| e.0).collect(),
        Shapes::Ellipses { s: list.iter().map(|e| e.1).collect(), t: list.iter().map(|e| e.2).collect() },
        Colors::Each(list.iter().map(|e| e.3).collect()),
    );
    Scene { objects: vec![Object { name: "test".into(), splats, closed: false }], ..Scene::default() }
}

/// An object each.
pub(super) fn objects(lists: &[&[Ellipse]]) -> Scene {
    Scene { objects: lists.iter().flat_map(|list| ellipses(list).objects).collect(), ..Scene::default() }
}

/// With one color and one normal a vertex.
pub(super) fn mesh(vertices: &[(DVec3, Vec3)], triangles: &[[u32; 3]], color: [f32; 4]) -> MeshObject {
    let mesh = Mesh {
        positions: vertices.iter().map(|vertex| vertex.0).collect(),
        normals: Some(vertices.iter().map(|vertex| vertex.1).collect()),
        colors: Colors::Uniform(color),
        triangles: triangles.to_vec(),
    };
    MeshObject { name: "test".into(), mesh, closed: false }
}

/// A square parallel to the screen, about the axis, that faces the eye; of two triangles.
pub(super) fn square(z: f64, half_side: f64, color: [f32; 4]) -> MeshObject {
    let corner = |x: f64, y: f64| (DVec3::new(x * half_side, y * half_side, z), Vec3::NEG_Z);
    let corners = [corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)];
    mesh(&corners, &[[0, 1, 2], [0, 2, 3]], color)
}

pub(super) fn meshes(list: Vec<MeshObject>) -> Scene {
    Scene { meshes: list, ..Scene::default() }
}

/// The pixel in the middle of an odd picture, through which the axis goes.
pub(super) fn middle(scene: &Scene, settings: &Settings) -> Pixel {
    let [width, height] = settings.size_px;
    *picture(scene, settings).pixel(width / 2, height / 2).unwrap()
}

#[track_caller]
pub(super) fn assert_color(pixel: &Pixel, expected: [f64; 4]) {
    let close = pixel.color.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-7);
    assert!(close, "{:?}, expected {expected:?}", pixel.color);
}

/// A disk parallel to the screen that faces the eye.
pub(super) fn facing_disk(center: DVec3, radius: f32, color: [f32; 4]) -> Ellipse {
    (center, Vec3::Y * radius, Vec3::X * radius, color)
}

pub(super) fn picture(scene: &Scene, settings: &Settings) -> Picture {
    render(scene, &camera(), settings, &|_, _| ()).unwrap()
}

/// The only splat of a scene as it is drawn, and the view.
pub(super) fn drawn(ellipse: Ellipse, settings: &Settings) -> (DrawnSplat, View) {
    let view = View::pinhole(&camera(), settings.size_px);
    let (splats, _) = prepare(&ellipses(&[ellipse]), &view, settings);
    (splats[0], view)
}

/// A splat before the eye, of a size of `ratio` times its distance, its axes not its tangent vectors; `aspect` is
/// that of the ellipse, in its plane.
pub(super) fn random_ellipse(random: &mut Random, ratio: f64, aspect: f64) -> Ellipse {
    let z = random.within(0.5, 8.0);
    let center = DVec3::new(random.within(-0.9, 0.9) * z, random.within(-0.9, 0.9) * z, z);
    let first = random.direction();
    let second = first.cross(random.direction()).normalize();
    let (major, minor) = (first * (z * ratio), second * (z * ratio / aspect));
    let (sin, cos) = random.within(0.0, 6.3).sin_cos();
    (center, (cos * major + sin * minor).as_vec3(), (cos * minor - sin * major).as_vec3(), GRAY)
}

pub(super) fn covered(picture: &Picture) -> usize {
    picture.pixels.iter().filter(|pixel| pixel.is_covered()).count()
}

/// Every pixel with its image-plane position, for the camera of these tests.
pub(super) fn pixels_at(picture: &Picture) -> impl Iterator<Item = (f64, f64, &Pixel)> {
    let [width, height] = picture.size_px;
    let focal_px = 0.5 * f64::from(height);
    picture.pixels.iter().enumerate().map(move |(i, pixel)| {
        let (column, row) = (i % width as usize, i / width as usize);
        let x = (column as f64 + 0.5 - 0.5 * f64::from(width)) / focal_px;
        let y = (row as f64 + 0.5 - 0.5 * f64::from(height)) / focal_px;
        (x, y, pixel)
    })
}

/// SplitMix64 (Steele, Lea, Flood 2014): the same numbers on every machine.
pub(super) struct Random(pub u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next() >> 11) as f64 * 0.5_f64.powi(53)
    }

    /// Uniform over the sphere.
    pub fn direction(&mut self) -> DVec3 {
        let z = self.within(-1.0, 1.0);
        let (sin, cos) = self.within(0.0, std::f64::consts::TAU).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        DVec3::new(radius * cos, radius * sin, z)
    }
}
