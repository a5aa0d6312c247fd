//! Whether figures can be trusted: what the machine did while they were taken.
//!
//! Things that are timed in turn tell of the machine by themselves. What a round took, as a multiple of what its contestants
//! take at their medians, is the machine's slowness in that round: it has nothing to do with any one of them. Where it
//! drifts, clocks moved or others joined; ratios within rounds still hold, milliseconds don't.

use serde::{Deserialize, Serialize};

use crate::report::Spread;

/// The machine during the measurement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Machine {
    /// Threads that the processor runs at once.
    pub threads: usize,
    /// The part of the processor's time that other processes took; `None` where the system does not tell.
    pub taken_by_others: Option<f64>,
    /// The graphics card while we left it idle; `None` where the processor draws.
    pub card: Option<CardUse>,
    /// The slowest and the fastest clock seen while the device worked, in megahertz: of the graphics, or of the processor
    /// where that draws; `None` where unknown.
    pub clock_mhz: Option<[f64; 2]>,
    /// The most memory that this process has held so far, in bytes; `None` where the system does not tell.
    pub peak_host_bytes: Option<u64>,
}

/// The use that others make of a graphics card, seen while we do nothing with it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CardUse {
    /// The part of the time that the card was busy before our first frame; `None` where the system does not tell.
    pub busy_before: Option<f64>,
    /// That part after our last frame.
    pub busy_after: Option<f64>,
    /// Other processes that could compute on it, at the beginning; `None` where the system does not tell. They may be idle.
    pub other_processes: Option<usize>,
}

/// The limits beyond which figures are flagged.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrustLimits {
    /// Half the width of a median's 95% interval, as a part of the median.
    pub uncertainty: f64,
    /// How much the machine's speed may change from the first third of the rounds to the last.
    pub drift: f64,
    /// By how much the fastest clock may exceed the slowest.
    pub clock: f64,
    /// The part of the processor's time that other processes may take.
    pub others: f64,
    /// The part of the time that a graphics card may be busy while we leave it idle.
    pub busy: f64,
}

impl Default for TrustLimits {
    fn default() -> Self {
        Self { uncertainty: 0.05, drift: 0.05, clock: 0.05, others: 0.1, busy: 0.05 }
    }
}

/// How slow the machine was in each round, as a multiple of its middle: the geometric mean over the contestants of what
/// each took beside its own median. `rounds` are milliseconds by contestant and round.
pub fn slowness(contestants: &[Vec<f64>]) -> Vec<f64> {
    let medians: Vec<Option<f64>> =
        contestants.iter().map(|ms| Spread::of(ms.iter().copied()).map(|spread| spread.median)).collect();
    let rounds = contestants.iter().map(Vec::len).min().unwrap_or(0);
    (0..rounds)
        .map(|round| {
            let logs: Vec<f64> = contestants
                .iter()
                .zip(&medians)
                .filter_map(|(ms, median)| median.filter(|m| *m > 0.0).map(|m| (ms[round] / m).ln()))
                .collect();
            (logs.iter().sum::<f64>() / logs.len().max(1) as f64).exp()
        })
        .collect()
}

/// By which factor the machine became slower from the first third of the rounds to the last; `None` of fewer than 6.
pub fn drift(slowness: &[f64]) -> Option<f64> {
    let third = slowness.len() / 3;
    let of = |part: &[f64]| Spread::of(part.iter().copied()).map(|spread| spread.median);
    (third >= 2).then(|| Some(of(&slowness[slowness.len() - third..])? / of(&slowness[..third])?)).flatten()
}

impl Machine {
    /// The reasons to doubt all figures, a sentence each.
    pub fn flags(&self, limits: &TrustLimits) -> Vec<String> {
        let mut flags = Vec::new();
        if let Some(taken) = self.taken_by_others.filter(|taken| *taken > limits.others) {
            let (percent, most) = (100.0 * taken, 100.0 * limits.others);
            flags.push(format!(
                "the machine was shared: other processes took {percent:.0}% of the processor's time (up to {most:.0}% is \
                 fine)"
            ));
        }
        flags.extend(self.card.iter().flat_map(|card| card.flags(limits)));
        if let Some([slowest, fastest]) = self.clock_mhz
            && fastest / slowest - 1.0 > limits.clock
        {
            flags.push(format!(
                "the clock moved: from {slowest:.0} to {fastest:.0} MHz (up to {:.0}% is fine)",
                100.0 * limits.clock
            ));
        }
        flags
    }
}

impl CardUse {
    /// A sentence for each time at which others were at work.
    fn flags(&self, limits: &TrustLimits) -> Vec<String> {
        let others = match self.other_processes {
            None | Some(0) => String::new(),
            Some(1) => "; 1 other process could compute on it".to_owned(),
            Some(count) => format!("; {count} other processes could compute on it"),
        };
        [(self.busy_before, "before our first frame"), (self.busy_after, "after our last frame")]
            .into_iter()
            .filter_map(|(busy, when)| Some((busy.filter(|busy| *busy > limits.busy)?, when)))
            .map(|(busy, when)| {
                format!(
                    "the graphics card was shared: {:.0}% busy {when} (up to {:.0}% is fine){others}",
                    100.0 * busy,
                    100.0 * limits.busy
                )
            })
            .collect()
    }
}

/// A sentence where the machine's speed drifted over the rounds of `what`.
pub fn drift_flag(what: &str, contestants: &[Vec<f64>], limits: &TrustLimits) -> Option<String> {
    let change = drift(&slowness(contestants))? - 1.0;
    (change.abs() > limits.drift).then(|| {
        let side = if change > 0.0 { "slower" } else { "faster" };
        format!(
            "{what}: the machine became {:.0}% {side} during the rounds: ratios hold, milliseconds don't (up to {:.0}% is \
             fine)",
            100.0 * change.abs(),
            100.0 * limits.drift
        )
    })
}

/// A sentence where a figure's spread is too wide, or unknown.
pub fn spread_flag(what: &str, spread: Option<&Spread>, limits: &TrustLimits) -> Option<String> {
    let Some(spread) = spread else { return Some(format!("{what}: not measured")) };
    match spread.uncertainty() {
        None => Some(format!("{what}: too few frames to tell how certain the median is (6 at least)")),
        Some(part) if part > limits.uncertainty => Some(format!(
            "{what}: the median is certain to {:.1}% only (up to {:.1}% is fine): more --frames, or a quieter machine",
            100.0 * part,
            100.0 * limits.uncertainty
        )),
        Some(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_machine_that_slows_down_is_told_from_contestants_that_differ() {
        let steady = [vec![2.0; 9], vec![5.0; 9]];
        assert_eq!(drift(&slowness(&steady)), Some(1.0));
        assert_eq!(drift_flag("x", &steady, &TrustLimits::default()), None);
        let slower = |scale: f64| (0..9).map(|round| scale * (1.0 + 0.02 * f64::from(round))).collect();
        let moved: [Vec<f64>; 2] = [slower(2.0), slower(5.0)];
        let flag = drift_flag("1.4M", &moved, &TrustLimits::default()).unwrap();
        assert!(flag.starts_with("1.4M: the machine became 12% slower"), "{flag}");
        // One of two that slows down by 12% is half of that for the machine.
        let one = [slower(2.0), vec![5.0; 9]];
        assert!((drift(&slowness(&one)).unwrap() - 1.0577).abs() < 1e-3);
        assert_eq!(drift(&[1.0; 5]), None);
        assert_eq!(slowness(&[]), Vec::<f64>::new());
    }

    #[test]
    fn sharing_clocks_and_spread_are_flagged_beyond_their_limits() {
        let limits = TrustLimits::default();
        let quiet = Machine {
            threads: 2,
            taken_by_others: Some(0.05),
            card: None,
            clock_mhz: Some([2000.0, 2050.0]),
            peak_host_bytes: None,
        };
        assert!(quiet.flags(&limits).is_empty());
        let loud = Machine { taken_by_others: Some(0.4), clock_mhz: Some([1500.0, 2000.0]), ..quiet.clone() };
        let flags = loud.flags(&limits);
        assert!(flags[0].contains("took 40%") && flags[1].contains("from 1500 to 2000 MHz"), "{flags:?}");
        let unknown = Machine { taken_by_others: None, clock_mhz: None, ..quiet };
        assert!(unknown.flags(&limits).is_empty());

        let card = CardUse { busy_before: Some(0.05), busy_after: None, other_processes: Some(3) };
        let beside = |card: CardUse| Machine { card: Some(card), ..unknown.clone() }.flags(&limits);
        assert!(beside(CardUse::default()).is_empty() && beside(card.clone()).is_empty());
        let flags = beside(CardUse { busy_before: Some(0.4), busy_after: Some(0.3), ..card });
        assert!(
            flags[0].contains("40% busy before our first frame")
                && flags[0].ends_with("3 other processes could compute on it")
        );
        assert!(flags[1].contains("30% busy after our last frame"), "{flags:?}");

        assert_eq!(spread_flag("frame", Spread::of([1.0; 6]).as_ref(), &limits), None);
        let few = spread_flag("frame", Spread::of([1.0; 5]).as_ref(), &limits).unwrap();
        assert!(few.contains("too few frames"), "{few}");
        let wide = Spread::of([1.0, 1.0, 1.0, 1.3, 1.3, 1.3]);
        assert!(spread_flag("frame", wide.as_ref(), &limits).unwrap().contains("certain to 13.0% only"));
        assert!(spread_flag("frame", None, &limits).unwrap().contains("not measured"));
    }
}
