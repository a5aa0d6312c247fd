//! How large splats are in the picture: seen edge-on, below a pixel, above the screen.

use glam::DVec3;

use super::{
    Hard,
    builder::{Builder, Random, unfiltered},
};

/// Disks seen within 1° of grazing.
pub fn edge_on() -> Hard {
    let mut random = Random(2);
    let mut builder = Builder::default();
    let eye = DVec3::new(0.0, 0.0, 3.0);
    for _ in 0..1500 {
        let position = random.point([1.2, 1.2, 0.5]);
        let to_eye = (eye - position).normalize();
        let side = to_eye.cross(random.direction()).normalize();
        let grazing = random.between(0.05, 1.0).to_radians();
        let normal = side * grazing.cos() + to_eye * grazing.sin();
        let color = random.color();
        builder.disk(position, normal, random.between(0.1, 0.5), color);
    }
    Hard::seen_from(eye.into(), "edge-on disks", builder.scene(false))
}

/// Disks of 0.25 to 0.7 pixels: a pixel sees one only if its center is hit.
pub fn subpixel_unfiltered() -> Hard {
    Hard { settings: unfiltered(), ..subpixel("subpixel disks, unfiltered", 0.25, 0.7) }
}

/// Disks of 1e-6 to 1 pixel: each must be seen.
pub fn subpixel_filtered() -> Hard {
    subpixel("subpixel disks", 1e-6, 1.0)
}

/// Disks of these radii in pixels, on a logarithmic scale.
fn subpixel(name: &'static str, from_px: f64, to_px: f64) -> Hard {
    let mut builder = Builder::default();
    let mut random = Random(5);
    let pixel = (45.0_f64 / 2.0).to_radians().tan() * 3.0 / 128.0;
    for _ in 0..8000 {
        let position = random.point([1.2, 1.2, 0.2]);
        let normal = (DVec3::Z + 0.7 * random.direction()).normalize();
        let radius = pixel * from_px * (to_px / from_px).powf(random.unit());
        builder.disk(position, normal, radius, random.color());
    }
    Hard::seen_from([0.0, 0.0, 3.0], name, builder.scene(false))
}

/// Disks a hundred times as large as what the camera sees of them.
pub fn larger_than_the_screen() -> Hard {
    let mut builder = Builder::default();
    let mut random = Random(3);
    for i in 0..12 {
        let normal = (DVec3::Z + 0.6 * random.direction()).normalize();
        builder.disk(DVec3::new(0.0, 0.0, -0.5 * f64::from(i)), normal, 300.0, random.color());
    }
    Hard::seen_from([0.1, -0.2, 3.0], "disks larger than the screen", builder.scene(false))
}
