//! How much surfaces overlap themselves, as it is found when a scene is prepared.

use glam::{DVec3, Vec3};

use super::{super::overlap::overlaps, Random};
use crate::{
    geometry::Overlaps,
    scene::{Colors, Kernel, Shapes, Splats},
};

#[test]
fn overlaps_are_what_is_found_of_each_pair() {
    let mut random = Random(11);
    let mut unit = || random.within(0.0, 1.0);
    let count = 600;
    let positions = (0..count).map(|_| DVec3::new(unit(), unit(), 0.1 * unit())).collect::<Vec<_>>();
    let mut direction =
        || Vec3::new(unit() as f32 - 0.5, unit() as f32 - 0.5, unit() as f32 - 0.3).normalize();
    let s: Vec<Vec3> = (0..count).map(|_| direction()).collect();
    let t: Vec<Vec3> = s.iter().map(|s| s.cross(direction()).normalize()).collect();
    let mut random = Random(12);
    let mut length = || (0.02 * 8.0_f64.powf(random.within(0.0, 1.0))) as f32;
    let s = s.into_iter().map(|s| s * length()).collect::<Vec<_>>();
    let t = t.into_iter().map(|t| t * length()).collect::<Vec<_>>();
    let splats = Splats::new(positions, Shapes::Ellipses { s, t }, Colors::Uniform([1.0; 4]));
    let own = Overlaps::of(&splats).inverse;
    let exact = overlaps(&splats, Kernel::default());
    for (i, (own, exact)) in own.iter().zip(exact).enumerate() {
        assert!((f64::from(*own) * exact - 1.0).abs() < 1e-5, "{i}: {own} {exact}");
    }
}
