//! The basis of the paper's tangent adjustment (Guennebaud, Barthe, Paulin 2006, section 4.1): s = p × n, t = n × s.
//! Its vectors are orthogonal in space, but not on the screen. The paper: between 60° and 90° apart, 81.7° on average, for
//! a frustum with an aperture of 90°. And what follows for the filter; and that ours has no such gap.

use glam::{DVec2, DVec3};
use surfel::scene::{Filter, Settings};

use super::{
    GRAY,
    probe::{self, Asked},
};
use crate::common::{
    builder::{Builder, Random, camera, unfiltered},
    shared,
};

/// Seen over the screen of a frustum of 90°, evenly; with normals over all directions, evenly.
fn position_and_normal(random: &mut Random) -> (DVec3, DVec3) {
    (DVec3::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0), 1.0), random.direction())
}

/// Unit s and t.
fn papers_basis(p: DVec3, n: DVec3) -> [DVec3; 2] {
    let s = p.cross(n).normalize();
    [s, n.cross(s)]
}

/// The image-plane motion of a point at `p` that moves along `v`.
fn projected(p: DVec3, v: DVec3) -> DVec2 {
    (v.truncate() - p.truncate() / p.z * v.z) / p.z
}

/// The semi-minor axis of the ellipse with these conjugate radii.
fn semi_minor(a: DVec2, b: DVec2) -> f64 {
    let (aa, bb) = (a.length_squared(), b.length_squared());
    let semi_major = (0.5 * (aa + bb + (aa - bb).hypot(2.0 * a.dot(b)))).sqrt();
    a.perp_dot(b).abs() / semi_major
}

#[test]
fn the_papers_basis_is_60_to_90_degrees_apart_on_the_screen() {
    let mut random = Random(21);
    let (mut sum_deg, mut least_deg) = (0.0, f64::MAX);
    let count = 400_000;
    for _ in 0..count {
        let (p, n) = position_and_normal(&mut random);
        let [a, b] = papers_basis(p, n).map(|v| projected(p, v));
        let deg = a.perp_dot(b).abs().atan2(a.dot(b).abs()).to_degrees();
        sum_deg += deg;
        least_deg = f64::min(least_deg, deg);
    }
    let mean_deg = sum_deg / f64::from(count);
    println!("mean {mean_deg:.2}, least {least_deg:.2} degrees");
    // The standard deviation of an angle is 7.5° at most, that of the mean of 400 000 then 0.012°: four of them.
    assert!((mean_deg - 81.3).abs() < 0.05 + 0.05, "{mean_deg}: the paper has 81.7");
    assert!((60.0..60.5).contains(&least_deg), "{least_deg}");
}

/// The paper adjusts s and t each by itself. Where they are not orthogonal on the screen, the ellipse that they span is
/// thinner than the filter's radius h: down to √(1 − cos 60°) h = 0.71 h, where both are adjusted.
#[test]
fn most_splats_of_the_papers_adjustment_are_thinner_than_the_filter() {
    let mut random = Random(22);
    let (mut adjusted, mut thinner, mut least) = (0, 0, f64::MAX);
    while adjusted < 200_000 {
        let (p, n) = position_and_normal(&mut random);
        // From a tenth of h to ten of them, evenly in the logarithm.
        let radius = 10.0_f64.powf(random.between(-1.0, 1.0));
        let [a, b] = papers_basis(p, n).map(|v| radius * projected(p, v));
        if a.length() >= 1.0 && b.length() >= 1.0 {
            continue;
        }
        let [a, b] = [a, b].map(|v| if v.length() < 1.0 { v.normalize() } else { v });
        let width = semi_minor(a, b);
        adjusted += 1;
        thinner += usize::from(width < 0.99);
        least = f64::min(least, width);
    }
    let share = thinner as f64 / f64::from(adjusted);
    println!("{:.1}% are thinner than 0.99 h, the thinnest {least:.3} h", 100.0 * share);
    // Which share depends on the sizes; from 53% (h to 10 h) to 88% (0.01 h to h).
    assert!((0.75..0.82).contains(&share), "{share}");
    assert!((std::f64::consts::FRAC_1_SQRT_2 - 1e-5..0.72).contains(&least), "{least}");
}

/// On the device: no adjusted ellipse is thinner than h, whatever its aspect up to 50.
#[test]
fn no_splat_of_our_adjustment_is_thinner_than_the_filter() {
    let headless = shared();
    let mut random = Random(23);
    let camera = camera([0.0; 3], [0.0, 0.0, -1.0]);
    let settings = Settings { filter: Filter::Adjust, ..unfiltered() };
    let focal_px = camera.focal_px(settings.size_px[1]);
    let scenes: Vec<_> = (0..600)
        .map(|_| {
            let p = DVec3::new(random.between(-0.4, 0.4), random.between(-0.4, 0.4), -1.0);
            let s = random.direction();
            let t = s.cross(random.direction()).normalize() / random.between(1.0, 50.0);
            let radius = 2.0_f64.sqrt() / focal_px * 10.0_f64.powf(random.between(-2.0, 2.0));
            let mut builder = Builder::default();
            builder.ellipse(p, s * radius, t * radius, GRAY);
            (p, headless.prepare(&builder.scene(false), &|_, _| {}).unwrap())
        })
        .collect();
    let asked: Vec<_> = scenes
        .iter()
        .map(|(position, scene)| Asked {
            scene,
            position: *position,
            camera: &camera,
            settings: &settings,
            places_px: Vec::new(),
        })
        .collect();
    let h = 2.0_f64.sqrt() / focal_px;
    let (mut least, mut adjusted) = (f64::MAX, 0);
    for answer in probe::ask(&headless, &asked, None) {
        assert!(answer.is_seen());
        let [p, s, t] = answer.splat();
        let width = semi_minor(projected(p, s), projected(p, t)) / h;
        least = f64::min(least, width);
        adjusted += usize::from(width < 1.01);
    }
    println!("the thinnest is 1 {:+.1e} h, {adjusted} adjusted", least - 1.0);
    // The area a × b of an ellipse of aspect 50 cancels: some steps of f32 times 50, 1.2e-5.
    assert!(least > 1.0 - 1.2e-5, "{least}");
    assert!(adjusted > 300, "{adjusted}");
}
