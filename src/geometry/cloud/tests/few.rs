//! Clouds of so few points that their surface turns from one to the next.

use super::*;

#[test]
fn a_ball_of_few_points_is_neither_noisy_nor_flat() {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    for (count, most) in [(50, 35.0), (100, 8.0), (300, 4.0)] {
        let point = |i: u32| {
            let z = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(count);
            (glam::DVec2::from_angle(golden * f64::from(i)) * (1.0 - z * z).sqrt()).extend(z)
        };
        let samples: Vec<Sample> = (0..count).map(|i| (point(i), point(i))).collect();
        let (splats, report) = of(&samples);
        let (angles, flipped) = errors(&splats, &samples);
        let far = angles[angles.len() / 2];
        assert!(!report.noisy && flipped == 0 && far < most, "{count}: {report}, {far}, {flipped}");
    }
}
