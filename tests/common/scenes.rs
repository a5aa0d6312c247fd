//! Scenes that are hard in one known way each, with the camera that shows it.

use std::f64::consts::PI;

use glam::{DQuat, DVec3};
use surfel::scene::{Camera, Filter, Object, Scene, Settings};

use super::builder::{Builder, Random, camera, settings, unfiltered};

/// A scene, its camera, and how it is to be rendered.
#[derive(Clone)]
pub struct Hard {
    /// What is hard about it.
    pub name: &'static str,
    pub scene: Scene,
    pub camera: Camera,
    pub settings: Settings,
}

/// A closed sphere of `count` disks around `center` (golden-angle spiral), colored by position.
pub fn sphere(count: usize, center: DVec3) -> Object {
    let mut builder = Builder::default();
    let golden = PI * (3.0 - 5.0_f64.sqrt());
    for i in 0..count {
        let z = 1.0 - (2 * i + 1) as f64 / count as f64;
        let (sin, cos) = (golden * i as f64).sin_cos();
        let r = (1.0 - z * z).sqrt();
        let n = DVec3::new(r * cos, r * sin, z);
        let color = (0.5 * n + 0.5).as_vec3();
        let radius = 2.2 / (count as f64).sqrt() * 1.3;
        // On a grid of f32, so that the oracle and the GPU have the same input.
        let position = center + n.as_vec3().as_dvec3();
        builder.disk(position, n, radius, [color.x, color.y, color.z, 1.0]);
    }
    builder.object(true)
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
    ]
}

pub fn sphere_of_disks() -> Hard {
    let scene = Scene { objects: vec![sphere(3000, DVec3::ZERO)] };
    Hard { name: "sphere of disks", scene, camera: camera([0.0, 0.0, 3.2], [0.0; 3]), settings: settings() }
}

fn far_from_the_origin() -> Hard {
    let offset = DVec3::new(500_000.0, 4_600_000.0, 300.0);
    let scene = Scene { objects: vec![sphere(3000, offset)] };
    let mut camera = camera([0.0, 0.0, 3.2], [0.0; 3]);
    camera.eye += offset;
    camera.target += offset;
    Hard { name: "sphere far from the origin", scene, camera, settings: settings() }
}

pub fn random_ellipses(filter: Filter) -> Hard {
    let mut random = Random(1);
    let mut builder = Builder::default();
    for _ in 0..600 {
        let rotation = DQuat::from_axis_angle(random.direction(), random.between(0.0, PI));
        let aspect = random.between(1.0, 20.0);
        let radius = random.between(0.02, 0.3);
        let position =
            DVec3::new(random.between(-1.3, 1.3), random.between(-1.3, 1.3), random.between(-1.0, 1.0));
        let color = random.color();
        builder.ellipse(
            position.as_vec3().as_dvec3(),
            rotation * DVec3::X * radius,
            rotation * DVec3::Y * radius / aspect,
            color,
        );
    }
    let name = match filter {
        Filter::Adjust => "random ellipses of aspect up to 20",
        _ => "random ellipses, unfiltered",
    };
    Hard {
        name,
        scene: builder.scene(false),
        camera: camera([0.3, 0.2, 3.5], [0.0; 3]),
        settings: Settings { filter, ..settings() },
    }
}

/// Disks seen within 1° of grazing.
pub fn edge_on() -> Hard {
    let mut random = Random(2);
    let mut builder = Builder::default();
    let eye = DVec3::new(0.0, 0.0, 3.0);
    for _ in 0..1500 {
        let position =
            DVec3::new(random.between(-1.2, 1.2), random.between(-1.2, 1.2), random.between(-0.5, 0.5));
        let position = position.as_vec3().as_dvec3();
        let to_eye = (eye - position).normalize();
        let side = to_eye.cross(random.direction()).normalize();
        let grazing = random.between(0.05, 1.0).to_radians();
        let normal = side * grazing.cos() + to_eye * grazing.sin();
        let color = random.color();
        builder.disk(position, normal, random.between(0.1, 0.5), color);
    }
    Hard {
        name: "edge-on disks",
        scene: builder.scene(false),
        camera: camera(eye.into(), [0.0; 3]),
        settings: settings(),
    }
}

/// A disk that passes under and behind the eye, and a second that cuts through the eye's own height further on.
pub fn ground() -> Hard {
    let mut builder = Builder::default();
    builder.disk(DVec3::new(0.0, 0.0, -2.0), DVec3::Y, 40.0, [0.2, 0.6, 0.3, 1.0]);
    builder.disk(
        DVec3::new(1.0, 0.5, -6.0),
        DVec3::new(0.3, 0.2, 1.0).normalize(),
        1.5,
        [0.9, 0.3, 0.1, 1.0],
    );
    let mut camera = camera([0.0, 1.0, 0.0], [0.0, 0.6, -5.0]);
    camera.near = Some(0.01);
    Hard {
        name: "ground under and behind the eye",
        scene: builder.scene(false),
        camera,
        settings: settings(),
    }
}

fn larger_than_the_screen() -> Hard {
    let mut builder = Builder::default();
    let mut random = Random(3);
    for i in 0..12 {
        let normal = (DVec3::Z + 0.6 * random.direction()).normalize();
        let color = random.color();
        builder.disk(DVec3::new(0.0, 0.0, -0.5 * f64::from(i)), normal, 300.0, color);
    }
    Hard {
        name: "disks larger than the screen",
        scene: builder.scene(false),
        camera: camera([0.1, -0.2, 3.0], [0.0; 3]),
        settings: settings(),
    }
}

/// Centers from just outside to far outside of each side and corner, the disks reaching in.
fn centers_off_screen() -> Hard {
    let mut builder = Builder::default();
    let mut random = Random(4);
    let half = (45.0_f64 / 2.0).to_radians().tan() * 3.0;
    for i in 0..80 {
        let side = i % 8;
        let angle = f64::from(side) * PI / 4.0;
        let (x, y) = (angle.cos(), angle.sin());
        let to_border = half / f64::max(x.abs(), y.abs());
        let beyond = half / 128.0 * [1.0, 3.0, 10.0, 60.0, 200.0][(i / 8 % 5) as usize];
        let position = DVec3::new(x, y, 0.0) * (to_border + beyond);
        let normal = (DVec3::Z + 0.4 * random.direction()).normalize();
        let color = random.color();
        builder.disk(position.as_vec3().as_dvec3(), normal, beyond + random.between(0.2, 0.8), color);
    }
    Hard {
        name: "centers off-screen",
        scene: builder.scene(false),
        camera: camera([0.0, 0.0, 3.0], [0.0; 3]),
        settings: settings(),
    }
}

/// Disks that the near plane cuts, within the view: some face it, some are nearly edge-on to it, most centers are
/// before it. The plane is far out, so that the cuts' places matter.
pub fn cut_by_the_near_plane() -> Hard {
    let mut builder = Builder::default();
    let mut random = Random(8);
    for _ in 0..40 {
        let position =
            DVec3::new(random.between(-0.4, 0.4), random.between(-0.4, 0.4), random.between(1.8, 2.3));
        let color = random.color();
        builder.disk(position.as_vec3().as_dvec3(), random.direction(), random.between(0.1, 0.6), color);
    }
    let mut camera = camera([0.0, 0.0, 3.0], [0.0; 3]);
    camera.near = Some(1.0);
    Hard { name: "disks cut by the near plane", scene: builder.scene(false), camera, settings: unfiltered() }
}

/// Disks of 0.25 to 0.7 pixels: a pixel sees one only if its center is hit.
fn subpixel_unfiltered() -> Hard {
    Hard { settings: unfiltered(), ..subpixel("subpixel disks, unfiltered", 0.25, 0.7) }
}

/// Disks of 1e-6 to 1 pixel: each must be seen.
pub fn subpixel_filtered() -> Hard {
    subpixel("subpixel disks", 1e-6, 1.0)
}

fn subpixel(name: &'static str, from_px: f64, to_px: f64) -> Hard {
    let mut builder = Builder::default();
    let mut random = Random(5);
    let pixel = (45.0_f64 / 2.0).to_radians().tan() * 3.0 / 128.0;
    for _ in 0..8000 {
        let position =
            DVec3::new(random.between(-1.2, 1.2), random.between(-1.2, 1.2), random.between(-0.2, 0.2));
        let normal = (DVec3::Z + 0.7 * random.direction()).normalize();
        let radius = pixel * from_px * (to_px / from_px).powf(random.unit());
        let color = random.color();
        builder.disk(position.as_vec3().as_dvec3(), normal, radius, color);
    }
    Hard {
        name,
        scene: builder.scene(false),
        camera: camera([0.0, 0.0, 3.0], [0.0; 3]),
        settings: settings(),
    }
}

pub fn coincident() -> Hard {
    let mut builder = Builder::default();
    let mut random = Random(6);
    for _ in 0..3000 {
        let color = random.color();
        builder.disk(DVec3::new(0.1, -0.05, 0.0), DVec3::new(0.2, 0.1, 1.0).normalize(), 0.5, color);
    }
    Hard {
        name: "3000 coincident disks",
        scene: builder.scene(false),
        camera: camera([0.0, 0.0, 3.0], [0.0; 3]),
        settings: settings(),
    }
}

/// Every defect among good disks and good ellipses.
fn degenerate() -> Hard {
    let mut builder = Builder::default();
    let mut random = Random(7);
    let nan = f64::NAN;
    for i in 0..400 {
        let p = DVec3::new(random.between(-0.8, 0.8), random.between(-0.8, 0.8), random.between(-0.2, 0.2));
        let p = p.as_vec3().as_dvec3();
        let n = (DVec3::Z + 0.5 * random.direction()).normalize();
        let color = random.color();
        match i % 8 {
            0 => builder.disk(p, n, 0.0, color),
            1 => builder.disk(p, DVec3::ZERO, 0.1, color),
            2 => builder.disk(p, DVec3::new(nan, 0.0, 1.0), 0.1, color),
            3 => builder.disk(DVec3::new(f64::INFINITY, 0.0, 0.0), n, 0.1, color),
            4 => builder.disk(p, n, nan, color),
            _ => builder.disk(p, n, 0.1, color),
        }
    }
    let mut ellipses = Builder::default();
    for i in 0..200 {
        let p = DVec3::new(random.between(-0.8, 0.8), random.between(-0.8, 0.8), random.between(-0.2, 0.2));
        let p = p.as_vec3().as_dvec3();
        let s = 0.1 * random.direction();
        let t = 0.5 * s.cross(random.direction());
        let color = random.color();
        match i % 8 {
            0 => ellipses.ellipse(p, s, 2.0 * s, color),
            1 => ellipses.ellipse(p, s, DVec3::ZERO, color),
            2 => ellipses.ellipse(p, s, DVec3::new(0.0, nan, 0.1), color),
            3 => ellipses.ellipse(p, DVec3::new(0.0, f64::INFINITY, 0.1), t, color),
            4 => ellipses.ellipse(p, s, t, [0.5, f32::NAN, 0.5, 1.0]),
            _ => ellipses.ellipse(p, s, t, color),
        }
    }
    Hard {
        name: "degenerate splats among good ones",
        scene: Scene { objects: vec![builder.object(false), ellipses.object(false)] },
        camera: camera([0.0, 0.0, 3.0], [0.0; 3]),
        settings: settings(),
    }
}
