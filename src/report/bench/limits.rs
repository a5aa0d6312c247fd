//! How far each pass is from what the device can do at most: the limits themselves are measured in the same rounds.
//!
//! A pass has so many points, fragments and bytes. Each, at the speed that the device reached when it did nothing else, takes
//! a time below which the pass can't get; the largest of these times is its *bound*, and that limit *binds*. Fragments are those that
//! are shaded: what a shader then discards may cost less than one that is written or blended.
//!
//! This file and `floor` name each other: the floor's report holds the limits', which are measured in the floor's rounds.

use std::collections::BTreeMap;

use serde::Serialize;

use super::FloorRound;
use crate::report::{Spread, ThroughputProbe};

/// The work by which a limit was measured.
#[derive(Clone, Copy, Debug)]
pub struct LimitWork {
    /// The limit.
    pub limit: ThroughputProbe,
    /// Units of work in one measurement.
    pub units: u64,
    /// Bytes that a unit moves, where that is a figure of interest.
    pub bytes_per_unit: Option<u64>,
}

/// The work of a pass of a frame.
#[derive(Clone, Debug)]
pub struct PassWork {
    /// The pass.
    pub name: String,
    /// How much of what the device has limits for; what is not known is not in it.
    pub units: BTreeMap<ThroughputProbe, u64>,
}

/// A limit of the device.
#[derive(Clone, Debug, Serialize)]
pub struct LimitRow {
    /// The limit.
    pub limit: ThroughputProbe,
    /// Units of work in one measurement.
    pub units: u64,
    /// Milliseconds of a measurement.
    pub ms: Option<Spread>,
    /// Units in a second, by the median.
    pub units_per_sec: Option<f64>,
    /// Bytes in a second, by the median, for limits that move memory.
    pub bytes_per_sec: Option<f64>,
}

/// A pass, or the whole frame, against its bound.
#[derive(Clone, Debug, Serialize)]
pub struct BoundRow {
    /// The pass; `frame` for all of them.
    pub name: String,
    /// Its milliseconds.
    pub ms: Option<Spread>,
    /// How much it does of what there are limits for.
    pub work: BTreeMap<ThroughputProbe, u64>,
    /// Milliseconds that each limit alone would take for that, by the medians.
    pub limit_ms: BTreeMap<ThroughputProbe, f64>,
    /// The largest of them in each round; of the frame, the sum of its passes'. `None` where no work of it is known.
    pub bound_ms: Option<Spread>,
    /// The limit that it comes from, by the medians.
    pub binds: Option<ThroughputProbe>,
    /// How many times the bound the pass takes, round by round.
    pub ratio: Option<Spread>,
}

/// The device's limits, and how far from them each pass is.
#[derive(Clone, Debug, Serialize)]
pub struct LimitsReport {
    /// The device's limits.
    pub limits: Vec<LimitRow>,
    /// Each pass, then the frame.
    pub bounds: Vec<BoundRow>,
    /// Limits that could not be measured, a sentence each.
    pub notes: Vec<String>,
}

impl FloorRound {
    /// Milliseconds that a limit alone takes for so many units.
    fn limit_ms(&self, works: &[LimitWork], limit: ThroughputProbe, units: u64) -> Option<f64> {
        let i = works.iter().position(|work| work.limit == limit)?;
        let ms = self.limits_ms.get(i).copied().flatten().filter(|ms| *ms > 0.0)?;
        (works[i].units > 0).then(|| ms * units as f64 / works[i].units as f64)
    }

    /// The largest of a pass's times.
    fn bound_ms(&self, works: &[LimitWork], pass: &PassWork) -> Option<f64> {
        let times = pass.units.iter().filter_map(|(limit, units)| self.limit_ms(works, *limit, *units));
        times.reduce(f64::max).filter(|ms| *ms > 0.0)
    }
}

impl LimitsReport {
    /// The report of rounds in which a frame and the limits were measured in turn.
    pub fn of(works: &[LimitWork], passes: &[PassWork], rounds: &[FloorRound], notes: Vec<String>) -> Self {
        let of_pass = |(i, pass)| BoundRow::of_pass(works, pass, i, rounds);
        let frame = BoundRow::of_frame(works, passes, rounds);
        let bounds = passes.iter().enumerate().map(of_pass).chain([frame]).collect();
        let limits = works.iter().enumerate().map(|(i, work)| limit_row(work, i, rounds)).collect();
        Self { limits, bounds, notes }
    }
}

fn limit_row(work: &LimitWork, i: usize, rounds: &[FloorRound]) -> LimitRow {
    let ms = rounds.iter().map(|round| round.limits_ms.get(i).copied().flatten());
    let ms = ms.collect::<Option<Vec<f64>>>().and_then(Spread::of);
    let per_sec = ms.filter(|ms| ms.median > 0.0).map(|ms| 1e3 * work.units as f64 / ms.median);
    LimitRow {
        limit: work.limit,
        units: work.units,
        ms,
        units_per_sec: per_sec,
        bytes_per_sec: per_sec.zip(work.bytes_per_unit).map(|(units, bytes)| units * bytes as f64),
    }
}

/// A figure of a round; `None` where it is not known.
type OfRound<'a> = &'a dyn Fn(&FloorRound) -> Option<f64>;

impl BoundRow {
    /// A row of its time and its bound in each round.
    fn of(name: &str, rounds: &[FloorRound], [ms, bound_ms]: [OfRound<'_>; 2]) -> Self {
        let spread = |figure: OfRound<'_>| Spread::of(rounds.iter().filter_map(figure));
        Self {
            name: name.to_owned(),
            ms: spread(ms),
            work: BTreeMap::new(),
            limit_ms: BTreeMap::new(),
            bound_ms: spread(bound_ms),
            binds: None,
            ratio: spread(&|round| Some(ms(round)? / bound_ms(round)?)),
        }
    }

    /// The row of the pass at a place in the frame.
    fn of_pass(works: &[LimitWork], pass: &PassWork, i: usize, rounds: &[FloorRound]) -> Self {
        let median_ms = |(limit, units): (&ThroughputProbe, &u64)| {
            let ms = rounds.iter().filter_map(|round| round.limit_ms(works, *limit, *units));
            Some((*limit, Spread::of(ms)?.median))
        };
        let limit_ms: BTreeMap<ThroughputProbe, f64> = pass.units.iter().filter_map(median_ms).collect();
        let binds = limit_ms.iter().filter(|(_, ms)| **ms > 0.0).max_by(|a, b| a.1.total_cmp(b.1));
        let (work, binds) = (pass.units.clone(), binds.map(|(limit, _)| *limit));
        let own_ms = |round: &FloorRound| round.passes_ms[0].get(i).copied();
        let row = Self::of(&pass.name, rounds, [&own_ms, &|round| round.bound_ms(works, pass)]);
        Self { work, limit_ms, binds, ..row }
    }

    /// The passes follow each other, so that their bounds add up; one without a bound adds nothing.
    fn of_frame(works: &[LimitWork], passes: &[PassWork], rounds: &[FloorRound]) -> Self {
        let bound_ms = |round: &FloorRound| {
            passes.iter().filter_map(|pass| round.bound_ms(works, pass)).reduce(|sum, ms| sum + ms)
        };
        let mut row = Self::of("frame", rounds, [&|round| Some(round.passes_ms[0].iter().sum()), &bound_ms]);
        for (limit, units) in passes.iter().flat_map(|pass| &pass.units) {
            *row.work.entry(*limit).or_insert(0) += units;
        }
        row
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A million units in 2 ms, but for bytes, which take 10 ms; and a frame of two passes that takes 5 and 8 ms, and one of
    /// compute of which nothing is known. The machine becomes twice as slow.
    pub(crate) fn report() -> LimitsReport {
        let work = |limit, bytes_per_unit| LimitWork { limit, units: 1_000_000, bytes_per_unit };
        let works = [
            work(ThroughputProbe::Points, None),
            work(ThroughputProbe::BlendedFragments, Some(32)),
            work(ThroughputProbe::Bytes, Some(1)),
            work(ThroughputProbe::Invocations, None),
        ];
        let pass = |name: &str, units: &[(ThroughputProbe, u64)]| PassWork {
            name: name.to_owned(),
            units: units.iter().copied().collect(),
        };
        let passes = [
            pass("visibility", &[(ThroughputProbe::Points, 500_000), (ThroughputProbe::Bytes, 50_000)]),
            pass(
                "accumulate",
                &[(ThroughputProbe::Points, 500_000), (ThroughputProbe::BlendedFragments, 2_000_000)],
            ),
            pass("tiles", &[]),
        ];
        let round = |slow: f64| FloorRound {
            passes_ms: [[5.0, 8.0, 1.0].map(|ms| slow * ms).to_vec(), Vec::new(), Vec::new()],
            limits_ms: [2.0, 2.0, 10.0, 2.0].map(|ms| Some(slow * ms)).to_vec(),
        };
        LimitsReport::of(&works, &passes, &[round(1.0), round(2.0)], vec!["a note".to_owned()])
    }

    #[test]
    fn the_largest_time_of_any_limit_is_the_bound() {
        let report = report();
        let same = |value| Spread::of([value; 2]);
        let [visibility, accumulate, tiles, frame] = report.bounds.as_slice() else { panic!("four rows") };
        // Points 1 ms, bytes 0.5; points 1 ms, blended fragments 4; twice that in the second round.
        assert_eq!(
            (visibility.binds, visibility.bound_ms),
            (Some(ThroughputProbe::Points), Spread::of([1.0, 2.0]))
        );
        assert_eq!(accumulate.binds, Some(ThroughputProbe::BlendedFragments));
        assert_eq!((visibility.ratio, accumulate.ratio), (same(5.0), same(2.0)));
        assert_eq!(accumulate.limit_ms[&ThroughputProbe::Points], 1.5);
        // What is not known has no bound, and takes none from the frame.
        assert_eq!((tiles.binds, tiles.bound_ms, tiles.ratio), (None, None, None));
        assert_eq!((frame.bound_ms, frame.ratio), (Spread::of([5.0, 10.0]), same(14.0 / 5.0)));
        assert_eq!(frame.work[&ThroughputProbe::Points], 1_000_000);
    }

    #[test]
    fn limits_are_units_and_bytes_a_second() {
        let report = report();
        // 3 ms in the middle.
        assert_eq!(report.limits[1].units_per_sec, Some(1e9 / 3.0));
        assert_eq!(report.limits[1].bytes_per_sec, Some(32.0 * 1e9 / 3.0));
        assert_eq!(report.limits[0].bytes_per_sec, None);
    }

    #[test]
    fn a_limit_without_times_bounds_nothing() {
        let works = [LimitWork { limit: ThroughputProbe::Points, units: 10, bytes_per_unit: None }];
        let pass = PassWork { name: "a".to_owned(), units: [(ThroughputProbe::Points, 5)].into() };
        for ms in [None, Some(0.0)] {
            let round = FloorRound { passes_ms: [vec![1.0], Vec::new(), Vec::new()], limits_ms: vec![ms] };
            let report = LimitsReport::of(&works, std::slice::from_ref(&pass), &[round], Vec::new());
            assert_eq!((report.bounds[0].bound_ms, report.bounds[0].binds), (None, None));
            assert_eq!(report.limits[0].units_per_sec, None);
            assert!(report.bounds[0].ms.is_some());
        }
    }
}
