//! Splats with clip curves of every kind.

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec3, Vec2};

use super::{
    Hard,
    builder::{Builder, Random},
};
use crate::scene::{Clip, ClipCurve, Clips};

/// Ellipses from far below a pixel to half of the view, each cut by one or two curves: lines, arcs, parabolas, hyperbolas, control polygons,
/// wide and narrow, bent to either side, with middle control points within the disk and beyond, some collinear; and one in eight whole.
pub fn clipped() -> Hard {
    let mut random = Random(11);
    let mut builder = Builder::default();
    let mut clips = Vec::new();
    for i in 0..500 {
        let rotation = DQuat::from_axis_angle(random.direction(), random.between(0.0, PI));
        let radius = if i % 4 == 0 { random.between(0.001, 0.03) } else { random.between(0.05, 0.4) };
        let aspect = random.between(1.0, 5.0);
        let [s, t] = [rotation * DVec3::X * radius, rotation * DVec3::Y * radius / aspect];
        builder.ellipse(random.point([1.3, 1.3, 1.0]), s, t, random.color());
        let curves = [(); 2].map(|()| curve(&mut random));
        clips.push(match i % 8 {
            0..3 => Clip::One(curves[0]),
            3..5 => Clip::Either(curves[0], curves[1]),
            5..7 => Clip::Both(curves[0], curves[1]),
            _ => Clip::None,
        });
    }
    let mut scene = builder.scene(false);
    scene.objects[0].splats.clips = Clips::of(clips);
    Hard::seen_from([0.3, 0.2, 3.5], "clipped ellipses", scene)
}

fn curve(random: &mut Random) -> ClipCurve {
    let start_rad = random.between(-PI, PI);
    let end_rad = start_rad + random.between(0.02, TAU - 0.02);
    let [start, end] = [start_rad, end_rad].map(|rad| Vec2::from_angle(rad as f32));
    let middle = match (random.unit() * 6.0) as u32 {
        // On the chord.
        0 => start.lerp(end, random.unit() as f32),
        // Far beyond the disk.
        1 => random.between(2.0, 20.0) as f32 * Vec2::from_angle(random.between(0.0, TAU) as f32),
        _ => Vec2::new(random.between(-0.8, 0.8) as f32, random.between(-0.8, 0.8) as f32),
    };
    let weight = match (random.unit() * 6.0) as u32 {
        0 => 0.0,
        1 => 1.0,
        2 => 1e30,
        _ => 10.0_f64.powf(random.between(-2.0, 2.0)),
    };
    ClipCurve { start_rad: start_rad as f32, end_rad: end_rad as f32, middle, weight: weight as f32 }
}
