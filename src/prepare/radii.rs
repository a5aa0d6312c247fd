//! How many splats have which radii, roughly: what bounds their images all together, where the largest radius bounds each alone.

/// Splats up to a radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadiusStep {
    /// No radius of the step is larger; at most a quarter above the smallest.
    pub radius: f64,
    /// How many.
    pub count: u32,
}

/// Counts by the exponent and the first two bits of the fraction of an `f64` that is not negative.
const STEPS: usize = 1 << 13;
const SHIFT: u32 = 50;

/// Counts while splats are looked through.
#[derive(Default)]
pub(super) struct RadiusCounts(Vec<u32>);

impl RadiusCounts {
    pub fn new() -> Self {
        let mut counts = Self::default();
        counts.clear();
        counts
    }

    /// None.
    pub fn clear(&mut self) {
        self.0.clear();
        self.0.resize(STEPS, 0);
    }

    /// One more, of a finite radius.
    pub fn add(&mut self, radius: f64) {
        self.add_several(radius, 1);
    }

    /// So many more of that.
    pub fn add_several(&mut self, radius: f64, count: u32) {
        self.0[(radius.abs().to_bits() >> SHIFT) as usize] += count;
    }

    /// The steps that there are, the smallest first.
    pub fn steps(&self) -> Vec<RadiusStep> {
        self.each_step().collect()
    }

    /// The same, one by one.
    pub fn each_step(&self) -> impl Iterator<Item = RadiusStep> {
        let step = |(i, count): (usize, &u32)| {
            let radius = f64::from_bits((i as u64 + 1) << SHIFT);
            (*count > 0).then_some(RadiusStep { radius, count: *count })
        };
        self.0.iter().enumerate().filter_map(step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_hold_every_radius_and_are_a_quarter_wide_at_most() {
        let radii = [0.0, 1e-300, 0.001, 0.99, 1.0, 1.1, 1.25, 1.5, 2.0, 1e30];
        let mut counts = RadiusCounts::new();
        radii.iter().for_each(|radius| counts.add(*radius));
        let steps = counts.steps();
        assert_eq!(steps.iter().map(|step| step.count as usize).sum::<usize>(), radii.len());
        for radius in radii {
            let step = steps.iter().find(|step| step.radius > radius).unwrap();
            assert!(radius == 0.0 || step.radius <= 1.2501 * radius, "{radius}: {step:?}");
        }
        // 1 and 1.1 are in one.
        assert_eq!(steps.iter().find(|step| step.radius == 1.25).unwrap().count, 2);
    }
}
