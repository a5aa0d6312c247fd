//! The Gaussian low-pass filter of the ground truth, over samples on a regular grid.

use crate::error::{Error, Result};
use crate::scene::Kernel;

/// Where the Gaussian is cut off: beyond 4 standard deviations lie 6e-5 of it, along each axis.
const REACH_DEVIATIONS: f64 = 4.0;

/// The widest filter in pixels to each side.
const MAX_REACH_PX: u32 = 64;

/// The filter along one axis. It is separable, and the same for every pixel.
pub(super) struct Taps {
    /// How many whole pixels it reaches to each side of its own.
    pub reach_px: u32,
    /// The weights of the samples from `reach_px` pixels before a pixel's first one to `reach_px` pixels behind its
    /// last one; their sum is 1.
    pub weights: Vec<f64>,
}

impl Taps {
    /// The standard deviation is that of every filter: `σ h`, with h = √2 pixels and σ that of a Gaussian kernel.
    /// For ψ_E, which has none, σ is that of the default kernel, ½.
    pub fn new(kernel: Kernel, samples_per_side: u32) -> Result<Self> {
        let sigma = match kernel {
            Kernel::Gaussian { sigma } => f64::from(sigma),
            Kernel::PsiE { .. } => 0.5,
        };
        let deviation_px = sigma * std::f64::consts::SQRT_2;
        let reach = REACH_DEVIATIONS * deviation_px;
        if reach > f64::from(MAX_REACH_PX) {
            let problem = format!(
                "gaussian: σ is {sigma}: the ground truth's filter would reach {reach:.0} pixels, expected at most \
                 {MAX_REACH_PX}"
            );
            return Err(Error::option("--kernel", problem));
        }
        let reach_px = reach.ceil() as u32;
        let count = (2 * reach_px + 1) * samples_per_side;
        let gaussian = |i: u32| {
            let sample = (f64::from(i) + 0.5) / f64::from(samples_per_side);
            let distance_px = sample - f64::from(reach_px) - 0.5;
            if distance_px.abs() > reach { 0.0 } else { (-0.5 * (distance_px / deviation_px).powi(2)).exp() }
        };
        let mut weights: Vec<f64> = (0..count).map(gaussian).collect();
        let sum: f64 = weights.iter().sum();
        // A filter narrower than the distance of two samples may reach none: the pixel's middle is then all it sees.
        if sum > 0.0 {
            weights.iter_mut().for_each(|weight| *weight /= sum);
        } else {
            let middle = f64::from(count) / 2.0;
            let (below, above) = ((middle - 0.5).floor() as usize, (middle - 0.5).ceil() as usize);
            weights[below] += 0.5;
            weights[above] += 0.5;
        }
        Ok(Self { reach_px, weights })
    }
}
