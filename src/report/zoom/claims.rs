//! Claims about `adjust`, and whether the figures bear them out.

use std::fmt;

use serde::Serialize;

use super::{ZoomReport, ZoomStep};
use crate::{
    report::compare::WeightedFilter,
    scene::{Filter, FilterWeight},
};

/// One claim, judged at every step where both filters have figures.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Claim {
    /// In words.
    pub claim: String,
    /// The largest ratio of `adjust`'s figure to the other's; above `limit` the claim is wrong. `None` where a figure
    /// is missing at every step.
    pub worst_ratio: Option<f64>,
    /// Where that is, in pixels a splat.
    pub worst_at_pixels_per_splat: Option<f64>,
    /// The largest ratio that the claim allows.
    pub limit: f64,
    /// Steps that were judged.
    pub steps: usize,
    /// Steps above the limit.
    pub steps_above: usize,
}

/// A figure of one filter at one step.
type Figure = fn(&ZoomStep, usize) -> Option<f64>;

impl ZoomReport {
    /// All claims about `adjust`, with each weight that was drawn.
    pub fn judge(&self) -> Vec<Claim> {
        let mut claims = Vec::new();
        let index = |filter, filter_weight| {
            self.filters.iter().position(|own| *own == WeightedFilter { filter, filter_weight })
        };
        let default = FilterWeight::default();
        for (_, weight) in FilterWeight::NAMES {
            let Some(adjust) = index(Filter::Adjust, *weight) else { continue };
            let everywhere: &dyn Fn(&ZoomStep) -> bool = &|_| true;
            let mixed: &dyn Fn(&ZoomStep) -> bool = &|step| step.is_mixed(&self.board);
            let error: Figure = ZoomStep::rms;
            let cases: [(_, _, _, Figure, _, _); 4] = [
                (Filter::AdjustPaper, *weight, "at least as good as adjust-paper", error, 1.0, everywhere),
                (Filter::Max, default, "better than max where splats are mixed", error, 1.0, mixed),
                (Filter::Ewa, default, "not more than 10% worse than ewa", error, 1.1, everywhere),
                (Filter::Ewa, default, "no more fragments than ewa", ZoomStep::fragments, 1.0, everywhere),
            ];
            for (other, other_weight, text, figure, limit, at) in cases {
                if let Some(other) = index(other, other_weight) {
                    let claim = format!("{}: {text}", self.filters[adjust]);
                    claims.push(self.claim(claim, [adjust, other], figure, limit, at));
                }
            }
        }
        claims
    }

    fn claim(
        &self,
        claim: String,
        [own, other]: [usize; 2],
        figure: Figure,
        limit: f64,
        at: &dyn Fn(&ZoomStep) -> bool,
    ) -> Claim {
        let ratio = |step: &ZoomStep| {
            let (own, other) = figure(step, own).zip(figure(step, other))?;
            // Two of nothing are equal.
            let ratio = if own == other { 1.0 } else { own / other };
            Some((ratio, step.pixels_per_splat))
        };
        let ratios: Vec<(f64, f64)> = self.steps.iter().filter(|step| at(step)).filter_map(ratio).collect();
        let worst = ratios.iter().copied().max_by(|a, b| a.0.total_cmp(&b.0));
        Claim {
            claim,
            worst_ratio: worst.map(|(ratio, _)| ratio),
            worst_at_pixels_per_splat: worst.map(|(_, at)| at),
            limit,
            steps: ratios.len(),
            // A ratio that is no number is above every limit.
            steps_above: ratios.iter().filter(|(ratio, _)| ratio.is_nan() || *ratio > limit).count(),
        }
    }
}

impl Claim {
    /// Whether it holds at every step that was judged; `None` where none was.
    pub fn holds(&self) -> Option<bool> {
        (self.steps > 0).then_some(self.steps_above == 0)
    }
}

impl fmt::Display for Claim {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { claim, limit, steps, steps_above, .. } = self;
        let Some((ratio, at)) = self.worst_ratio.zip(self.worst_at_pixels_per_splat) else {
            return write!(f, "{claim}: no figures");
        };
        match self.holds() {
            Some(true) => write!(f, "{claim}: yes, at {steps} of {steps} steps")?,
            _ => write!(f, "{claim}: NO, not at {steps_above} of {steps} steps")?,
        }
        write!(f, "; worst ratio {ratio:.6} at {at:.3} px a splat, allowed {limit}")
    }
}
