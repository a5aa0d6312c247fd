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

/// Disks in a plane, of which each lies off it by up to so many radii.
fn rough(off: f64) -> Splats {
    let mut random = Random(13);
    let mut within = |end: f64| random.within(0.0, end);
    let place = |_| DVec3::new(within(30.0), within(30.0), 1.7 * off * (within(2.0) - 1.0));
    let positions: Vec<_> = (0..900).map(place).collect();
    let (normals, radii) = (vec![Vec3::Z; 900], vec![1.7; 900]);
    Splats::new(positions, Shapes::Disks { normals, radii }, Colors::Uniform([1.0; 4]))
}

/// Between two places that are evenly spread within ±a the square mean of the distance is a √(2/3), of which those of a place on one disk to that disk itself are none.
#[test]
fn what_is_rough_overlaps_less() {
    let mut times = Vec::new();
    for off in [0.0, 0.1, 0.2, 0.3] {
        let (own, flat) = (Overlaps::of(&rough(off)).inverse, Overlaps::of(&rough(0.0)).inverse);
        let exact = overlaps(&rough(off), Kernel::default());
        for (i, (own, exact)) in own.iter().zip(exact).enumerate() {
            assert!((f64::from(*own) * exact - 1.0).abs() < 1e-5, "{off}, {i}: {own} {exact}");
        }
        times.push(own[0] / flat[0]);
    }
    let [flat, smooth, between, rough] = times[..] else { panic!("four") };
    // A few disks are so far off that a ball about their centers does not hold a place, and so crowds are smaller, too.
    assert!(flat == 1.0 && (smooth - 1.0).abs() < 0.01 && (rough - 1.5).abs() < 0.1, "{times:?}");
    assert!((1.1..1.4).contains(&between), "{times:?}");
}
