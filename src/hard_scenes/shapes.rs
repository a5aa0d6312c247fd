//! Scenes that are hard by their splats: an ordinary surface, ellipses any way round, many in one place, broken ones.

use std::f64::consts::PI;

use glam::{DQuat, DVec3};

use super::{
    Hard,
    builder::{Builder, Random},
};
use crate::scene::{Backfaces, ClipBox, Filter, Object, Scene};

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

/// A closed surface of disks that overlap: the ordinary case.
pub fn sphere_of_disks() -> Hard {
    let scene = Scene::from(sphere(3000, DVec3::ZERO));
    Hard::seen_from([0.0, 0.0, 3.2], "sphere of disks", scene)
}

/// The sphere cut by all sides of a box. Without backs, which planes have drawn: where a back and a front are one surface within ε, next to nothing is left of their
/// normals' sum.
pub fn cut_by_a_box() -> Hard {
    let mut hard = sphere_of_disks();
    hard.name = "sphere cut by a box";
    hard.settings.clip_box = ClipBox(Some([[-0.7, -0.6, -0.8], [0.65, 0.55, 0.75]]));
    hard.settings.backfaces = Backfaces::Cull;
    hard
}

/// The sphere where a step of f32 is half a unit.
pub fn far_from_the_origin() -> Hard {
    let offset = DVec3::new(500_000.0, 4_600_000.0, 300.0);
    let scene = Scene::from(sphere(3000, offset));
    let mut hard = Hard::seen_from([0.0, 0.0, 3.2], "sphere far from the origin", scene);
    hard.camera.eye += offset;
    hard.camera.target += offset;
    hard
}

/// Ellipses of aspect up to 20, any way round; unfiltered ones get as thin as 0.1 px.
pub fn random_ellipses(filter: Filter) -> Hard {
    let mut random = Random(1);
    let mut builder = Builder::default();
    for _ in 0..600 {
        let rotation = DQuat::from_axis_angle(random.direction(), random.between(0.0, PI));
        let aspect = random.between(1.0, 20.0);
        let radius = random.between(0.02, 0.3);
        let position = random.point([1.3, 1.3, 1.0]);
        let [s, t] = [rotation * DVec3::X * radius, rotation * DVec3::Y * radius / aspect];
        builder.ellipse(position, s, t, random.color());
    }
    let name = match filter {
        Filter::Adjust => "random ellipses of aspect up to 20",
        _ => "random ellipses, unfiltered",
    };
    let mut hard = Hard::seen_from([0.3, 0.2, 3.5], name, builder.scene(false));
    hard.settings.filter = filter;
    hard
}

/// Thousands of disks of different colors in one place.
pub fn coincident() -> Hard {
    let mut builder = Builder::default();
    let mut random = Random(6);
    for _ in 0..3000 {
        let normal = DVec3::new(0.2, 0.1, 1.0).normalize();
        builder.disk(DVec3::new(0.1, -0.05, 0.0), normal, 0.5, random.color());
    }
    Hard::seen_from([0.0, 0.0, 3.0], "3000 coincident disks", builder.scene(false))
}

/// Every defect among good disks and good ellipses.
pub fn degenerate() -> Hard {
    let mut builder = Builder::default();
    let mut random = Random(7);
    let nan = f64::NAN;
    for i in 0..400 {
        let p = random.point([0.8, 0.8, 0.2]);
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
        let p = random.point([0.8, 0.8, 0.2]);
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
    let scene = Scene { objects: vec![builder.object(false), ellipses.object(false)], ..Scene::default() };
    Hard::seen_from([0.0, 0.0, 3.0], "degenerate splats among good ones", scene)
}
