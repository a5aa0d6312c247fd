//! Comparisons of depths, and how near they are to turning out otherwise.

/// A comparison, or some together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Decision {
    pub holds: bool,
    /// How much one of the numbers would have to change for another outcome, as a part of the threshold.
    pub margin: f64,
}

impl Decision {
    /// `z <= threshold`. Nothing is near an infinite threshold.
    pub fn at_most(z: f64, threshold: f64) -> Self {
        let margin = if threshold.is_finite() { (z - threshold).abs() / threshold } else { f64::INFINITY };
        Self { holds: z <= threshold, margin }
    }

    /// Holds whatever the precision.
    pub const CERTAIN: Self = Self { holds: true, margin: f64::INFINITY };

    /// Both. Where one fails, the other one may turn as it likes.
    pub fn and(self, other: Self) -> Self {
        let margin = match (self.holds, other.holds) {
            (true, true) => self.margin.min(other.margin),
            (true, false) => other.margin,
            (false, true) => self.margin,
            (false, false) => self.margin.max(other.margin),
        };
        Self { holds: self.holds && other.holds, margin }
    }
}
