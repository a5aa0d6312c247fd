//! What packing alone does to splats.

use glam::Vec3;

use super::{
    pack,
    packed::{unpacked_color, unpacked_disk},
    rebase::Rebase,
};
use crate::scene::{Colors, Shapes, Splats};

/// The splats of an object as a device has them under `--splat-format packed`, if they are one chunk: for comparing pictures with what
/// packing alone does. `None` where they stay exact: ellipses, and what has something far off.
pub fn as_packed(splats: &Splats) -> Option<Splats> {
    let all = || 0..splats.len();
    let survey = pack::survey(splats, all(), Rebase::of(splats, all())).packed()?;
    let packed = pack::pack(splats, all(), &survey, pack::Beside::default());
    let disks = || packed.shapes.iter().map(|words| unpacked_disk(*words));
    let world = |length: f64| length / survey.rebase.scale;
    let colors = match &splats.colors {
        Colors::Uniform(color) => Colors::Uniform(*color),
        Colors::Each(_) => Colors::Each(packed.colors.iter().map(|word| unpacked_color(*word)).collect()),
    };
    let normals: Vec<Vec3> = disks().map(|(_, normal, _)| normal.as_vec3()).collect();
    let radii = disks().map(|(.., radius)| world(radius) as f32).collect();
    let positions = disks().map(|(center, ..)| center / survey.rebase.scale + survey.rebase.origin).collect();
    Some(Splats::new(positions, Shapes::Disks { normals, radii }, colors))
}
