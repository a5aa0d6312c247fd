//! Open surfaces, whose splats at the border reach further than their rims.

use glam::{DQuat, DVec3};
use surfel::{
    hard_scenes::{Hard, builder::Builder},
    scene::{Edges, Object, Rasterizer},
};

/// A square of so many splats along a side, which are `radius` large and two thirds of it apart, in the plane z = 0; with `ellipses` they are 1.4 times as long as wide.
pub fn sheet(along: i32, radius: f64, center: DVec3, ellipses: bool) -> Object {
    let mut builder = Builder::default();
    let middle = f64::from(along - 1) / 2.0;
    for (x, y) in (0..along).flat_map(|x| (0..along).map(move |y| (x, y))) {
        let from_middle = DVec3::new(f64::from(x) - middle, f64::from(y) - middle, 0.0);
        let place = center + 0.667 * radius * from_middle;
        let color = [0.5, 0.6, 0.2 + 0.1 * (x % 5) as f32, 1.0];
        match ellipses {
            true => {
                let turned = DQuat::from_rotation_z(0.4 * f64::from(x + y));
                builder.ellipse(
                    place,
                    radius * (turned * DVec3::X),
                    0.7 * radius * (turned * DVec3::Y),
                    color,
                );
            }
            false => builder.disk(place, DVec3::Z, radius, color),
        }
    }
    builder.object(false)
}

/// Sheets by tiles, with edges that cover in part, seen slanted.
pub fn covering(objects: Vec<Object>) -> Hard {
    let mut scene = Builder::default().scene(false);
    scene.objects = objects;
    let mut hard = Hard::seen_from([1.2, 0.8, 2.5], "sheets", scene);
    hard.settings.edges = Edges::Coverage;
    hard.settings.rasterizer = Rasterizer::Compute;
    hard.settings.background = None;
    hard
}
