//! A measurement against an earlier one: what became worse, beyond what chance explains.
//!
//! Milliseconds of two runs don't compare: machines differ, and one machine differs from hour to hour. What is judged is
//! each pass's time as a multiple of the floor that was measured in turn with it, and what is counted, which is exact.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use crate::report::Spread;

/// The kind of a figure: how it is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum GateKind {
    /// A time as a multiple of the floor's in the same round: worse if both intervals are apart by more than the tolerance.
    TimeOverFloor,
    /// A count of instructions: worse by 1 is worse.
    Instructions,
    /// Fragments, vertices, bytes: worse beyond a thousandth, since drivers round sizes in their own way.
    Work,
}

/// A figure that is judged. Less is better.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GateFigure {
    /// Its name; unique in a report.
    pub name: String,
    /// How it is judged.
    pub kind: GateKind,
    /// The figure; a time's median.
    pub value: f64,
    /// An interval that holds the true median with 95% confidence; only times have one.
    pub interval: Option<[f64; 2]>,
}

/// The figures that a report is judged by: the part of its JSON that `--baseline` reads.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Gate {
    /// The facts that must be equal for figures to compare: table, model, settings, size, by name.
    pub subject: BTreeMap<String, String>,
    /// The facts that may differ and are told then: device, driver, version.
    pub circumstances: BTreeMap<String, String>,
    /// The figures.
    pub figures: Vec<GateFigure>,
}

/// By how much counts of work may grow.
const WORK_TOLERANCE: f64 = 1e-3;

/// How a figure did.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// As before, within what chance and tolerance explain.
    Same,
    /// Better.
    Better,
    /// Worse: a regression.
    Worse,
    /// One of the two runs has no interval, or one too wide to see a regression: it can't be judged.
    NotJudged,
}

/// The differences that a gate allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GateLimits {
    /// By which part times may grow, beside their intervals.
    pub tolerance: f64,
    /// Half the width of an interval, as a part of its time, beyond which nothing can be seen.
    pub uncertainty: f64,
}

impl GateFigure {
    /// Whether its interval is narrow enough.
    fn is_certain(&self, limits: GateLimits) -> bool {
        self.uncertainty().is_some_and(|part| part <= limits.uncertainty)
    }

    /// A time over the floor; `None` where not measured.
    pub fn time(name: String, spread: Option<&Spread>) -> Option<Self> {
        let spread = spread?;
        let kind = GateKind::TimeOverFloor;
        Some(Self { name, kind, value: spread.median, interval: spread.interval })
    }

    /// A count; `None` where not counted.
    pub fn count(name: String, kind: GateKind, count: Option<u64>) -> Option<Self> {
        Some(Self { name, kind, value: count? as f64, interval: None })
    }

    /// Half the interval's width as a part of the value.
    fn uncertainty(&self) -> Option<f64> {
        self.interval.map(|[low, high]| 0.5 * (high - low) / self.value)
    }

    /// How it does beside what it was.
    pub(super) fn verdict(&self, before: &Self, limits: GateLimits) -> Verdict {
        let outside = |now: [f64; 2], before: [f64; 2], allowed: f64| {
            if now[0] > before[1] * (1.0 + allowed) {
                Verdict::Worse
            } else if now[1] * (1.0 + allowed) < before[0] {
                Verdict::Better
            } else {
                Verdict::Same
            }
        };
        let exact = |allowed| outside([self.value; 2], [before.value; 2], allowed);
        match self.kind {
            GateKind::Instructions => exact(0.0),
            GateKind::Work => exact(WORK_TOLERANCE),
            GateKind::TimeOverFloor => match self.interval.zip(before.interval) {
                // What is certainly worse is so, however uncertain it is by how much.
                Some((now, then)) => match outside(now, then, limits.tolerance) {
                    Verdict::Same if !self.is_certain(limits) || !before.is_certain(limits) => {
                        Verdict::NotJudged
                    }
                    verdict => verdict,
                },
                None => Verdict::NotJudged,
            },
        }
    }
}

/// Names whose values differ, as `name: before, now`.
pub fn differences(before: &BTreeMap<String, String>, now: &BTreeMap<String, String>) -> Vec<String> {
    let value = |map: &BTreeMap<String, String>, name: &String| {
        map.get(name).cloned().unwrap_or_else(|| "nothing".to_owned())
    };
    let names: BTreeSet<&String> = before.keys().chain(now.keys()).collect();
    let differing = names.into_iter().filter(|name| before.get(*name) != now.get(*name));
    differing.map(|name| format!("{name}: {}, now {}", value(before, name), value(now, name))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn time(name: &str, low: f64, high: f64) -> GateFigure {
        let (value, interval) = (0.5 * (low + high), Some([low, high]));
        GateFigure { name: name.to_owned(), kind: GateKind::TimeOverFloor, value, interval }
    }

    fn count(name: &str, kind: GateKind, value: u64) -> GateFigure {
        GateFigure::count(name.to_owned(), kind, Some(value)).unwrap()
    }

    fn gate(figures: Vec<GateFigure>) -> Gate {
        Gate { figures, ..Gate::default() }
    }

    const LIMITS: GateLimits = GateLimits { tolerance: 0.03, uncertainty: 0.15 };

    fn verdict(before: GateFigure, now: GateFigure) -> Verdict {
        gate(vec![now]).judge(&gate(vec![before]), LIMITS).judged[0].verdict
    }

    #[test]
    fn times_are_judged_by_their_intervals_and_the_tolerance() {
        assert_eq!(verdict(time("a", 1.8, 2.0), time("a", 1.9, 2.1)), Verdict::Same);
        assert_eq!(verdict(time("a", 1.8, 2.0), time("a", 2.05, 2.2)), Verdict::Same);
        assert_eq!(verdict(time("a", 1.8, 2.0), time("a", 2.07, 2.2)), Verdict::Worse);
        assert_eq!(verdict(time("a", 1.8, 2.0), time("a", 1.5, 1.7)), Verdict::Better);
        // Neither may an outlier blind the gate, nor hide what is worse all the same.
        assert_eq!(verdict(time("a", 1.8, 2.8), time("a", 2.2, 2.4)), Verdict::NotJudged);
        assert_eq!(verdict(time("a", 1.8, 2.0), time("a", 1.5, 2.5)), Verdict::NotJudged);
        assert_eq!(verdict(time("a", 1.8, 2.0), time("a", 2.2, 3.9)), Verdict::Worse);
        let unknown = GateFigure { interval: None, ..time("a", 1.0, 1.0) };
        assert_eq!(verdict(time("a", 1.8, 2.0), unknown), Verdict::NotJudged);
    }

    #[test]
    fn one_instruction_more_is_worse_and_a_thousandth_of_the_fragments_is_not() {
        let of = |kind, before, now| verdict(count("a", kind, before), count("a", kind, now));
        assert_eq!(of(GateKind::Instructions, 20, 21), Verdict::Worse);
        assert_eq!(of(GateKind::Instructions, 20, 20), Verdict::Same);
        assert_eq!(of(GateKind::Instructions, 20, 19), Verdict::Better);
        assert_eq!(of(GateKind::Work, 100_000, 100_099), Verdict::Same);
        assert_eq!(of(GateKind::Work, 100_000, 100_200), Verdict::Worse);
    }

    #[test]
    fn what_is_gone_or_not_judged_or_worse_does_not_pass() {
        let before = gate(vec![time("a", 1.0, 1.1), time("b", 1.0, 1.1)]);
        assert!(before.judge(&before, LIMITS).passes());
        assert!(!gate(vec![time("a", 1.0, 1.1)]).judge(&before, LIMITS).passes());
        let worse = gate(vec![time("a", 1.0, 1.1), time("b", 2.0, 2.1)]).judge(&before, LIMITS);
        assert!(!worse.passes());
        assert!(worse.grid().to_string().contains("WORSE") && worse.summary().contains("1 worse"));
        // An empty baseline proves nothing.
        assert!(!gate(Vec::new()).judge(&gate(Vec::new()), LIMITS).passes());
        let more = gate(vec![time("a", 1.0, 1.1), time("b", 1.0, 1.1), time("c", 9.0, 9.1)]);
        assert!(more.judge(&before, LIMITS).passes());
    }

    #[test]
    fn subjects_must_be_equal_and_circumstances_are_told() {
        let with = |size: &str, driver: &str| Gate {
            subject: [("size".to_owned(), size.to_owned())].into(),
            circumstances: [("driver".to_owned(), driver.to_owned())].into(),
            figures: vec![time("a", 1.0, 1.1)],
        };
        assert_eq!(differences(&with("1x1", "x").subject, &with("2x2", "x").subject), ["size: 1x1, now 2x2"]);
        assert!(differences(&with("1x1", "x").subject, &with("1x1", "y").subject).is_empty());
        let judged = with("1x1", "new").judge(&with("1x1", "old"), LIMITS);
        assert_eq!(judged.differs, ["driver: old, now new"]);
        assert!(judged.passes());
    }
}
