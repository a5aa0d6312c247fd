//! The elliptical weighted average against covariances, integrals and planes.

use glam::{DMat2, DVec2, DVec3, Vec3};

use super::*;
use crate::reference::affine::ImageEllipse;
use crate::reference::filter::projected;
use crate::reference::intersect::Map;

const CENTER: Rasterizer = Rasterizer::Perspective;
const CONTOUR: Rasterizer = Rasterizer::AffineContour;

fn ewa(rasterizer: Rasterizer) -> Settings {
    // With the floors of 16-bit sums.
    Settings { filter: Filter::Ewa, rasterizer, accumulate: crate::scene::Accumulate::F16, ..settings(64) }
}

/// `a aᵀ + b bᵀ`.
fn shape(a: DVec2, b: DVec2) -> DMat2 {
    DMat2::from_cols(a * a.x + b * b.x, a * a.y + b * b.y)
}

/// Center and `a aᵀ + b bᵀ` of the ellipse before the filter.
fn unfiltered((center, s, t, _): Ellipse, rasterizer: Rasterizer) -> (DVec2, DMat2) {
    let (s, t) = (s.as_dvec3(), t.as_dvec3());
    if rasterizer == CONTOUR {
        let e = ImageEllipse::exact_contour(center, s, t);
        (e.center, shape(e.directions[0] * e.lengths[0], e.directions[1] * e.lengths[1]))
    } else {
        (center.truncate() / center.z, shape(projected(center, s), projected(center, t)))
    }
}

#[test]
fn the_weight_is_that_of_the_sum_of_covariances() {
    let mut random = Random(21);
    let sigma = 0.4_f32;
    let mut covering = 0;
    for case in 0..400 {
        let ratio = 10.0_f64.powf(random.within(-2.5, -0.3));
        let ellipse = random_ellipse(&mut random, ratio, 3.0);
        for rasterizer in [CENTER, Rasterizer::AffineCenter, CONTOUR] {
            let settings = Settings { kernel: Kernel::Gaussian { sigma }, ..ewa(rasterizer) };
            let (splat, view) = drawn(ellipse, &settings);
            let (center, own) = unfiltered(ellipse, rasterizer);
            let h = 2.0_f64.sqrt() / 32.0;
            let sigma = f64::from(sigma);
            let variance = sigma * sigma * (own + DMat2::from_diagonal(DVec2::splat(h * h)));
            let factor = ((sigma * sigma * own).determinant() / variance.determinant()).sqrt();
            for _ in 0..20 {
                let delta =
                    DVec2::new(random.within(-1.0, 1.0), random.within(-1.0, 1.0)) * (2.0 * h + ratio);
                let ray = (center + delta).extend(1.0);
                let exponent = delta.dot(variance.inverse() * delta);
                let inside = exponent <= 1.0 / (sigma * sigma);
                let expected = factor.max(settings.floors().share) * (-0.5 * exponent).exp();
                let got = splat.fragment(ray, &view, settings.kernel);
                assert_eq!(got.is_some(), inside, "case {case}");
                if let Some(fragment) = got {
                    covering += 1;
                    assert!((fragment.weight / expected - 1.0).abs() < 1e-9, "case {case}");
                }
            }
        }
    }
    assert!(covering > 2000, "{covering}");
}

#[test]
fn the_weight_is_the_convolution_of_splat_and_filter() {
    // Half axes of 0.9 and 2.4 pixels, σ = 0.5: both Gaussians by quadrature, untruncated.
    let pixel = 1.0 / 32.0;
    let angle_rad = 0.6;
    let directions = [DVec2::from_angle(angle_rad), DVec2::from_angle(angle_rad).perp()];
    let lengths = [2.4 * pixel, 0.9 * pixel];
    let [s, t] = [0, 1].map(|i| (directions[i] * lengths[i]).extend(0.0).as_vec3());
    let (splat, view) = drawn((DVec3::Z, s, t, GRAY), &ewa(CENTER));
    let h = 2.0_f64.sqrt() * pixel;
    // σ² = ¼: exp(−r²/2σ²) = exp(−2 r²).
    let kernel =
        |x: DVec2| (-2.0 * (0..2).map(|i| (x.dot(directions[i]) / lengths[i]).powi(2)).sum::<f64>()).exp();
    let low_pass =
        |x: DVec2| (-2.0 * x.length_squared() / (h * h)).exp() * 2.0 / (std::f64::consts::PI * h * h);
    for x in [DVec2::ZERO, DVec2::new(0.7, 0.3) * pixel, DVec2::new(-0.4, 1.1) * pixel] {
        // The trapezoidal rule over smooth functions that end in nothing: exact to rounding.
        let step = 0.1 * pixel;
        let mut sum = 0.0;
        for i in -120..=120 {
            for j in -120..=120 {
                let y = DVec2::new(f64::from(i), f64::from(j)) * step;
                sum += kernel(y) * low_pass(x - y) * step * step;
            }
        }
        let got = splat.fragment(x.extend(1.0), &view, Kernel::default()).unwrap().weight;
        // The tangents are 32 bits: 2⁻²⁴ of each axis.
        assert!((got / sum - 1.0).abs() < 1e-6, "{got} {sum}");
    }
}

#[test]
fn the_depth_is_that_of_the_plane_at_the_point_before_the_stretch() {
    let mut random = Random(22);
    let mut stretched_far = 0;
    for case in 0..500 {
        let ratio = 10.0_f64.powf(random.within(-2.0, -0.3));
        let ellipse = random_ellipse(&mut random, ratio, 3.0);
        let (center, s, t) = (ellipse.0, ellipse.1.as_dvec3(), ellipse.2.as_dvec3());
        let normal = s.cross(t);
        // Nearer to the edge the plane's own depth is rounding noise.
        if normal.normalize().dot(center.normalize()).abs() < 1e-3 {
            continue;
        }
        let depth_radius = s.z.hypot(t.z);
        for rasterizer in [CENTER, CONTOUR] {
            let (splat, view) = drawn(ellipse, &ewa(rasterizer));
            let Map::Stretched(stretched) = splat.map else { panic!("case {case}: regular") };
            let ImageEllipse { center: c, directions, lengths } = stretched.ellipse;
            let h = view.filter_radius();
            let own = lengths.map(|length| (length * length - h * h).max(0.0).sqrt());
            for _ in 0..10 {
                let (u, v) = {
                    let (sin, cos) = random.within(0.0, 6.3).sin_cos();
                    let r = random.within(0.0, 1.0).sqrt();
                    (r * cos, r * sin)
                };
                let at = |lengths: [f64; 2]| {
                    c + directions[0] * (lengths[0] * u) + directions[1] * (lengths[1] * v)
                };
                let hit = splat.hit(at(lengths).extend(1.0), view.near).unwrap();
                let expected = normal.dot(center) / normal.dot(at(own).extend(1.0));
                // `own` has lost the digits of h²/l².
                assert!((hit.z / expected - 1.0).abs() < 1e-7, "case {case}: {} {expected}", hit.z);
                // A share of a depth radius over the depth from the eye may be added: 1/z is linear, not z.
                let (nearest, slack) = (center.z - depth_radius, 1.0 / (1.0 - depth_radius / center.z));
                assert!(hit.z >= nearest && hit.z <= center.z * slack + 1e-9, "case {case}");
                stretched_far += usize::from(lengths[1] > 2.0 * own[1]);
            }
        }
    }
    assert!(stretched_far > 1000, "{stretched_far}");
}

#[test]
fn an_edge_on_splat_is_drawn_as_wide_as_the_filter() {
    for rasterizer in [CENTER, CONTOUR] {
        // At depth 1 half axes of 16 and √2 pixels, the long one level. The share of its weight is the least.
        let edge_on = (DVec3::Z, Vec3::X * 0.5, Vec3::Z * 0.5, GRAY);
        let (splat, view) = drawn(edge_on, &ewa(rasterizer));
        let pixel = 1.0 / 32.0;
        let at = |x: f64, y: f64| splat.fragment(DVec3::new(x, y, 1.0), &view, Kernel::default());
        let middle = at(0.0, 0.0).unwrap();
        assert_eq!((middle.weight, middle.z), (ewa(rasterizer).floors().share, 1.0));
        assert!(at(0.0, 1.41 * pixel).is_some() && at(0.0, 1.42 * pixel).is_none());
        // √(16² + 2) = 16.0624.
        assert!(at(16.06 * pixel, 0.0).is_some() && at(16.07 * pixel, 0.0).is_none());
        assert_eq!(at(0.3, 0.0).unwrap().z, 1.0);
        // Tilted along its long axis instead: the depth at half of it is 1/(1 − ½ · 0.25).
        let splat = drawn((DVec3::Z, Vec3::new(0.5, 0.0, 0.25), Vec3::Z * 0.5, GRAY), &ewa(rasterizer)).0;
        let half = 0.5 * (0.5_f64.powi(2) + 2.0 * pixel * pixel).sqrt();
        let hit = splat.hit(DVec3::new(half, 0.0, 1.0), view.near).unwrap();
        assert!((hit.r2() - 0.25).abs() < 1e-12);
        // Rows at half a pixel to each side: r² = ⅛ + (x/16.06)² in 15.0 of 16 pixels.
        assert_eq!(covered(&picture(&ellipses(&[edge_on]), &ewa(rasterizer))), 60);
    }
}

#[test]
fn a_large_splat_keeps_weight_and_shape_and_a_small_one_the_least_share() {
    // Half axes of 640 pixels: the filter adds 2/640² to each square.
    let large = facing_disk(DVec3::Z, 20.0, GRAY);
    let (splat, view) = drawn(large, &ewa(CENTER));
    let (plain, _) = drawn(large, &settings(64));
    assert!((splat.share - 1.0 / (1.0 + 2.0 / 640.0_f64.powi(2))).abs() < 1e-12);
    for column in [0, 20, 50] {
        let ray = view.ray(column, 9);
        let (a, b) = (splat.hit(ray, view.near).unwrap(), plain.hit(ray, view.near).unwrap());
        assert!((a.r2() / b.r2() - 1.0).abs() < 6e-6 && (a.z - b.z).abs() < 1e-15);
    }
    let (small, _) = drawn(facing_disk(DVec3::Z, 1e-6, GRAY), &ewa(CENTER));
    let least = ewa(CENTER).floors().share;
    assert_eq!((small.share, least), (least, 1.0 / 16.0));
    // 32-bit sums keep all of it: (1e-6 / h)² at depth 1, h = √2/32.
    let exact = Settings { accumulate: crate::scene::Accumulate::F32, ..ewa(CENTER) };
    let (small, _) = drawn(facing_disk(DVec3::Z, 1e-6, GRAY), &exact);
    assert!((small.share / (1e-12 * 512.0) - 1.0).abs() < 1e-6);
    let middle = picture(&ellipses(&[facing_disk(DVec3::Z, 1e-6, GRAY)]), &ewa(CENTER));
    let weights: Vec<f64> = middle.pixels.iter().map(|p| p.weight).filter(|w| *w > 0.0).collect();
    // √2 pixels around a pixel corner: 4 pixels with r² = ½/2 = ¼, none farther.
    assert_eq!(weights.len(), 4);
    assert!(weights.iter().all(|w| (w - least * (-0.5_f64).exp()).abs() < 1e-9));
}
