//! Supersampling: how many samples a pixel has, where they lie, and how much each is filtered itself.

use super::{Kernel, OptionValue};

/// The most samples of a pixel.
pub const MOST_SAMPLES: u32 = 256;

/// Samples of each pixel, 1 to [`MOST_SAMPLES`]: pictures seen through windows that are moved by parts of a pixel, whose mean is the
/// picture.
///
/// All filters aim at the surface low-passed by a Gaussian of standard deviation σ h, h = √2 pixels ([`crate::reference::ground_truth`]).
/// Variances of Gaussians add up: of N samples each is drawn with a filter of the radius h / √N, and they lie around the pixel's
/// center as a Gaussian of the variance σ² h² (1 − 1/N) does. So one sample is the filter alone, and many are the ground truth. With
/// that radius samples overlap as splats do: N disks of it have the area of one disk of h.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Samples(pub u32);

impl Default for Samples {
    fn default() -> Self {
        Self(1)
    }
}

/// Places in f32 are exact to this part of a pixel in every picture.
const STEPS_A_PX: f64 = 256.0;

/// Nobody needs a picture that is more blurred.
const FARTHEST_PX: f64 = 64.0;

impl Samples {
    /// How far each sample lies from its pixel's center, to the right and down, in pixels: what [`super::Window::shifted`] takes. For a host's
    /// own temporal filter, too: neighbors in the list lie far apart, and the mean is 0.
    ///
    /// A spiral of equal areas under the Gaussian (Vogel, "A better way to construct the sunflower head", Math. Biosciences 44, 1979): the
    /// radius is that inside of which lie (i + ½) / N of it, the angle i times the golden one; then moved and scaled, so that the mean is 0
    /// and the variance exact but for the rounding to 1/256 pixel.
    pub fn offsets_px(self, kernel: Kernel) -> Vec<[f64; 2]> {
        let count = self.0.max(1);
        let step = (1..=count).map(|i| (count * 618 / 1000 + i) % count).find(|step| gcd(*step, count) == 1);
        let golden_rad = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
        let on_spiral = |i: u32| {
            let i = f64::from((u64::from(i) * u64::from(step.unwrap_or(1)) % u64::from(count)) as u32);
            let radius = (-2.0 * (1.0 - (i + 0.5) / f64::from(count)).ln()).sqrt();
            [radius * (golden_rad * i).cos(), radius * (golden_rad * i).sin()]
        };
        let mut all: Vec<[f64; 2]> = (0..count).map(on_spiral).collect();
        let mean = [0, 1].map(|axis| all.iter().map(|at| at[axis]).sum::<f64>() / f64::from(count));
        all.iter_mut().for_each(|at| *at = [at[0] - mean[0], at[1] - mean[1]]);
        // Of few samples, the spiral is wider one way than the other.
        let square =
            [0, 1].map(|axis| all.iter().map(|at| at[axis] * at[axis]).sum::<f64>() / f64::from(count));
        let sigma = match kernel {
            Kernel::Gaussian { sigma } => f64::from(sigma),
            Kernel::PsiE { .. } => 0.5,
        };
        let variance_px2 = 2.0 * sigma * sigma * (1.0 - 1.0 / f64::from(count));
        let scale = square.map(|square| if square > 0.0 { (variance_px2 / square).sqrt() } else { 0.0 });
        let rounded = |at: f64| ((at * STEPS_A_PX).round() / STEPS_A_PX).clamp(-FARTHEST_PX, FARTHEST_PX);
        all.into_iter().map(|[x, y]| [rounded(x * scale[0]), rounded(y * scale[1])]).collect()
    }

    /// The radius of each sample's own filter, h / √N, in pixels.
    pub fn filter_radius_px(self) -> f64 {
        std::f64::consts::SQRT_2 / f64::from(self.0.max(1)).sqrt()
    }
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}

impl OptionValue for Samples {
    fn word(&self) -> String {
        self.0.to_string()
    }

    fn parse(word: &str) -> Result<Self, String> {
        word.parse().map(Self).map_err(|_| "expected a number of samples, such as 16".to_owned())
    }

    fn check(&self) -> Result<(), String> {
        match self.0 {
            1..=MOST_SAMPLES => Ok(()),
            samples => Err(format!("{samples}: expected 1 to {MOST_SAMPLES} samples")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_have_the_variance_that_filters_leave_and_are_exact_in_f32() {
        let kernel = Kernel::Gaussian { sigma: 0.5 };
        assert_eq!(Samples(1).offsets_px(kernel), [[0.0; 2]]);
        for count in [2, 3, 4, 7, 16, 64, 255, 256] {
            let all = Samples(count).offsets_px(kernel);
            let mean = |of: &dyn Fn(&[f64; 2]) -> f64| all.iter().map(of).sum::<f64>() / f64::from(count);
            assert_eq!(all.len(), count as usize);
            assert!(mean(&|at| at[0]).abs() < 2e-3 && mean(&|at| at[1]).abs() < 2e-3, "{count}");
            let expected = 0.5 * (1.0 - 1.0 / f64::from(count));
            let both = mean(&|[x, y]| 0.5 * (x * x + y * y));
            assert!((both - expected).abs() < 5e-3 * expected, "{count}: {both}, not {expected}");
            // With the filter's own, all of it.
            assert!((expected + 0.25 * Samples(count).filter_radius_px().powi(2) - 0.5).abs() < 1e-12);
            if count >= 16 {
                let (x, y) = (mean(&|at| at[0] * at[0]), mean(&|at| at[1] * at[1]));
                assert!(
                    (x / y - 1.0).abs() < 0.25 && mean(&|[x, y]| x * y).abs() < 0.05,
                    "{count}: {x}, {y}"
                );
            }
            assert!(all.iter().flatten().all(|at| (at * STEPS_A_PX).fract() == 0.0));
            let places: std::collections::HashSet<_> = all.iter().map(|at| at.map(f64::to_bits)).collect();
            assert_eq!(places.len(), all.len(), "no two at one place");
        }
    }
}
