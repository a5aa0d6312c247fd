//! The filters of ꟻLIP: the eye's blur of each channel, and its detectors of edges and points. All are separable.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::flip::PIXELS_PER_DEGREE;

/// One channel, row by row, and the number of its columns.
pub struct Plane(pub Vec<f64>, pub usize);

/// The eye's sensitivity to contrast as sums of Gaussians `a √(π/b) exp(−π² d²/b)`, with d in degrees: pairs of a and b for
/// luminance, red to green, and blue to yellow.
const SENSITIVITIES: [&[[f64; 2]]; 3] = [&[[1.0, 0.0047]], &[[1.0, 0.0053]], &[[34.1, 0.04], [13.5, 0.025]]];

/// The widest of them.
const WIDEST: f64 = 0.04;

/// The width of the eye's detector of edges, in degrees: twice a standard deviation.
const FEATURE_DEG: f64 = 0.082;

/// The channels as blurred as they are seen.
pub fn see(channels: [Plane; 3]) -> [Plane; 3] {
    let reach = (3.0 * (WIDEST / (2.0 * PI * PI)).sqrt() * PIXELS_PER_DEGREE).ceil() as i32;
    let mut sensitivities = SENSITIVITIES.iter();
    channels.map(|channel| {
        let gaussians = sensitivities.next().copied().unwrap_or_default().iter().map(|&[a, b]| {
            let value = |x: i32| (-(PI * f64::from(x) / PIXELS_PER_DEGREE).powi(2) / b).exp();
            (a * (PI / b).sqrt(), (-reach..=reach).map(value).collect::<Vec<f64>>())
        });
        let gaussians: Vec<_> = gaussians.collect();
        let total: f64 = gaussians.iter().map(|(a, taps)| a * taps.iter().sum::<f64>().powi(2)).sum();
        let mut seen = Plane(vec![0.0; channel.0.len()], channel.1);
        for (a, taps) in &gaussians {
            let blurred = down(&along(&channel, taps), taps);
            seen.0.iter_mut().zip(&blurred.0).for_each(|(sum, value)| *sum += a / total * value);
        }
        seen
    })
}

/// How much of an edge, and how much of a point each pixel is: the lengths of the first and of the second derivatives of a
/// luminance of 0–1.
pub fn features(luminance: &Plane) -> [Plane; 2] {
    let deviation = 0.5 * FEATURE_DEG * PIXELS_PER_DEGREE;
    let reach = (3.0 * deviation).ceil() as i32;
    let gaussian = |x: i32| (-0.5 * (f64::from(x) / deviation).powi(2)).exp();
    let taps =
        |factor: &dyn Fn(f64) -> f64| (-reach..=reach).map(|x| factor(f64::from(x)) * gaussian(x)).collect();
    let smooth: Vec<f64> = taps(&|_| 1.0);
    let total: f64 = smooth.iter().sum();
    let smooth: Vec<f64> = smooth.iter().map(|tap| tap / total).collect();
    let first = balanced(taps(&|x| -x));
    let second = balanced(taps(&|x| (x / deviation).powi(2) - 1.0));
    [first, second].map(|derivative| {
        let across = down(&along(luminance, &derivative), &smooth);
        let upright = down(&along(luminance, &smooth), &derivative);
        let length = across.0.iter().zip(&upright.0).map(|(x, y)| x.hypot(*y));
        Plane(length.collect(), luminance.1)
    })
}

/// Scaled so that what is above 0 sums to 1, and what is below to −1.
fn balanced(taps: Vec<f64>) -> Vec<f64> {
    let above: f64 = taps.iter().filter(|tap| **tap > 0.0).sum();
    let below: f64 = -taps.iter().filter(|tap| **tap < 0.0).sum::<f64>();
    taps.iter().map(|tap| tap / if *tap > 0.0 { above } else { below }).collect()
}

/// Correlates rows; a picture goes on as it ends.
fn along(plane: &Plane, taps: &[f64]) -> Plane {
    let (width, reach) = (plane.1, taps.len() / 2);
    let row = |row: &[f64]| {
        let at = |x: usize, tap: usize| row[(x + tap).saturating_sub(reach).min(width - 1)];
        let sum = |x| taps.iter().enumerate().map(|(tap, weight)| weight * at(x, tap)).sum::<f64>();
        (0..width).map(sum).collect::<Vec<f64>>()
    };
    Plane(plane.0.par_chunks(width.max(1)).flat_map_iter(row).collect(), width)
}

/// Correlates columns alike.
fn down(plane: &Plane, taps: &[f64]) -> Plane {
    let (width, reach) = (plane.1.max(1), taps.len() / 2);
    let height = plane.0.len() / width;
    let mut sums = Plane(vec![0.0; plane.0.len()], plane.1);
    sums.0.par_chunks_mut(width).enumerate().for_each(|(y, sums)| {
        for (tap, weight) in taps.iter().enumerate() {
            let from = (y + tap).saturating_sub(reach).min(height - 1) * width;
            sums.iter_mut().zip(&plane.0[from..]).for_each(|(sum, value)| *sum += weight * value);
        }
    });
    sums
}
