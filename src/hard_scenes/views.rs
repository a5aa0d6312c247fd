//! Where the eye is: above a plane that passes under it, within splats, beside their centers.

use std::f64::consts::PI;

use glam::{DQuat, DVec3};

use super::{
    Hard,
    builder::{Builder, Random, camera, settings, unfiltered},
    shapes::sphere,
};

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
    let mut hard = Hard::seen_from([0.0, 0.0, 3.0], "disks cut by the near plane", builder.scene(false));
    hard.camera.near = Some(1.0);
    hard.settings = unfiltered();
    hard
}

/// Centers from just outside to far outside of each side and corner, the disks reaching in.
pub fn centers_off_screen() -> Hard {
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
    Hard::seen_from([0.0, 0.0, 3.0], "centers off-screen", builder.scene(false))
}

/// By parallel rays: a closed ball, ellipses any way round about it, and a plate that the near plane cuts.
pub fn parallel_rays() -> Hard {
    let mut builder = Builder::default();
    let mut random = Random(12);
    for _ in 0..250 {
        let rotation = DQuat::from_axis_angle(random.direction(), random.between(0.0, PI));
        let (aspect, radius) = (random.between(1.0, 20.0), random.between(0.02, 0.3));
        let position = random.point([1.3, 1.3, 1.2]);
        let [s, t] = [rotation * DVec3::X * radius, rotation * DVec3::Y * radius / aspect];
        builder.ellipse(position, s, t, random.color());
    }
    builder.ellipse(
        DVec3::new(-0.7, 0.7, 1.8),
        DVec3::new(0.3, 0.1, 0.4),
        DVec3::Y * 0.25,
        [0.8, 0.3, 0.2, 1.0],
    );
    let mut scene = builder.scene(false);
    scene.objects.push(sphere(1500, DVec3::ZERO));
    let mut hard = Hard::seen_from([0.4, -0.3, 2.0], "parallel rays", scene);
    (hard.camera.orthographic_height, hard.camera.near) = (Some(2.8), Some(0.2));
    hard
}
