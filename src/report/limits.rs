//! How far each pass is from what the device can do at most: the limits themselves are measured in the same rounds.
//!
//! A pass has so many points, fragments and bytes. Each, at the speed that the device reached when it did nothing else, takes
//! a time below which the pass can't get; the largest of these times is its *bound*, and that limit *binds*. Fragments are those that
//! are shaded: what a shader then discards may cost less than one that is written or blended.

use std::collections::BTreeMap;

use serde::Serialize;

use super::Spread;

/// Something of which a device does only so much in a second.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Limit {
    /// Points whose vertex stage passes them through, outside of the clip volume.
    Points,
    /// Points of one pixel in the image, all of whose fragments fail the depth test.
    DrawnPoints,
    /// Fragments of one color into 8-bit RGBA.
    Fragments,
    /// Fragments that only test and write a 32-bit depth.
    DepthFragments,
    /// Fragments added into two images of sums.
    BlendedFragments,
    /// Bytes read and written by a copy from buffer to buffer.
    Bytes,
    /// Invocations of a compute shader that does nothing.
    Invocations,
    /// Atomic sums, one of each invocation of a compute shader, on as many words as there are in 4096 workgroups of 256.
    Atomics,
    /// Splats at pixels, each seen and then added in registers, as tiles do it, without what brings them there.
    Kernels,
}

impl Limit {
    /// What it is called: in tables, and as the pass that measures it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Points => "points",
            Self::DrawnPoints => "drawn points",
            Self::Fragments => "fragments",
            Self::DepthFragments => "depth fragments",
            Self::BlendedFragments => "blended fragments",
            Self::Bytes => "bytes",
            Self::Invocations => "invocations",
            Self::Atomics => "atomics",
            Self::Kernels => "kernels",
        }
    }
}

/// What a limit was measured by.
#[derive(Clone, Copy, Debug)]
pub struct LimitWork {
    /// The limit.
    pub limit: Limit,
    /// Units of work in one measurement.
    pub units: u64,
    /// Bytes that a unit moves, where that is a figure of interest.
    pub bytes_per_unit: Option<u64>,
}

/// What a pass of a frame has to do.
#[derive(Clone, Debug)]
pub struct PassWork {
    /// The pass.
    pub name: String,
    /// How much of what the device has limits for; what is not known is not in it.
    pub units: BTreeMap<Limit, u64>,
}

/// A limit of the device.
#[derive(Clone, Debug, Serialize)]
pub struct LimitRow {
    /// The limit.
    pub limit: Limit,
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
    pub work: BTreeMap<Limit, u64>,
    /// Milliseconds that each limit alone would take for that, by the medians.
    pub limit_ms: BTreeMap<Limit, f64>,
    /// The largest of them in each round; of the frame, the sum of its passes'. `None` where no work of it is known.
    pub bound_ms: Option<Spread>,
    /// The limit that it comes from, by the medians.
    pub binds: Option<Limit>,
    /// How many times the bound the pass takes, round by round.
    pub ratio: Option<Spread>,
}

/// The device's limits, and how far from them each pass is.
#[derive(Clone, Debug, Serialize)]
pub struct LimitsReport {
    /// What the device can do.
    pub limits: Vec<LimitRow>,
    /// Each pass, then the frame.
    pub bounds: Vec<BoundRow>,
    /// What could not be measured, a sentence each.
    pub notes: Vec<String>,
}

/// Milliseconds of one round: of the frame's passes, and of each limit's measurement.
#[derive(Clone, Debug)]
pub struct LimitRound {
    /// The passes, in the frame's order.
    pub passes_ms: Vec<f64>,
    /// The limits, in theirs.
    pub limits_ms: Vec<Option<f64>>,
}

impl LimitRound {
    /// Milliseconds that a limit alone takes for so many units.
    fn limit_ms(&self, works: &[LimitWork], limit: Limit, units: u64) -> Option<f64> {
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
    /// Of rounds in which a frame and the limits were measured in turn.
    pub fn of(works: &[LimitWork], passes: &[PassWork], rounds: &[LimitRound], notes: Vec<String>) -> Self {
        let mut bounds: Vec<BoundRow> =
            passes.iter().enumerate().map(|(i, pass)| bound_row(works, pass, i, rounds)).collect();
        bounds.push(frame_row(works, passes, rounds));
        let limits = works.iter().enumerate().map(|(i, work)| limit_row(work, i, rounds)).collect();
        Self { limits, bounds, notes }
    }
}

fn limit_row(work: &LimitWork, i: usize, rounds: &[LimitRound]) -> LimitRow {
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

fn bound_row(works: &[LimitWork], pass: &PassWork, i: usize, rounds: &[LimitRound]) -> BoundRow {
    let median_ms = |(limit, units): (&Limit, &u64)| {
        let ms = rounds.iter().filter_map(|round| round.limit_ms(works, *limit, *units));
        Some((*limit, Spread::of(ms)?.median))
    };
    let limit_ms: BTreeMap<Limit, f64> = pass.units.iter().filter_map(median_ms).collect();
    let bound_of = |round: &LimitRound| round.bound_ms(works, pass);
    let ratio = |round: &LimitRound| Some(round.passes_ms.get(i)? / bound_of(round)?);
    let binds = limit_ms.iter().filter(|(_, ms)| **ms > 0.0).max_by(|a, b| a.1.total_cmp(b.1));
    BoundRow {
        name: pass.name.clone(),
        ms: Spread::of(rounds.iter().filter_map(|round| round.passes_ms.get(i).copied())),
        work: pass.units.clone(),
        binds: binds.map(|(limit, _)| *limit),
        limit_ms,
        bound_ms: Spread::of(rounds.iter().filter_map(bound_of)),
        ratio: Spread::of(rounds.iter().filter_map(ratio)),
    }
}

/// The passes follow each other, so that their bounds add up; one without a bound adds nothing.
fn frame_row(works: &[LimitWork], passes: &[PassWork], rounds: &[LimitRound]) -> BoundRow {
    let bound_of = |round: &LimitRound| {
        let bounds = passes.iter().filter_map(|pass| round.bound_ms(works, pass));
        bounds.reduce(|sum, ms| sum + ms)
    };
    let ms_of = |round: &LimitRound| round.passes_ms.iter().sum::<f64>();
    let mut work = BTreeMap::new();
    for (limit, units) in passes.iter().flat_map(|pass| &pass.units) {
        *work.entry(*limit).or_insert(0) += units;
    }
    BoundRow {
        name: "frame".to_owned(),
        ms: Spread::of(rounds.iter().map(ms_of)),
        work,
        limit_ms: BTreeMap::new(),
        bound_ms: Spread::of(rounds.iter().filter_map(bound_of)),
        binds: None,
        ratio: Spread::of(rounds.iter().filter_map(|round| Some(ms_of(round) / bound_of(round)?))),
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A million units in 2 ms, but for bytes, which take 10 ms; and a frame of two passes that takes 5 and 8 ms, and one of
    /// compute of which nothing is known. The machine becomes twice as slow.
    pub(in crate::report) fn report() -> LimitsReport {
        let work = |limit, bytes_per_unit| LimitWork { limit, units: 1_000_000, bytes_per_unit };
        let works = [
            work(Limit::Points, None),
            work(Limit::BlendedFragments, Some(32)),
            work(Limit::Bytes, Some(1)),
            work(Limit::Invocations, None),
        ];
        let pass = |name: &str, units: &[(Limit, u64)]| PassWork {
            name: name.to_owned(),
            units: units.iter().copied().collect(),
        };
        let passes = [
            pass("visibility", &[(Limit::Points, 500_000), (Limit::Bytes, 50_000)]),
            pass("accumulate", &[(Limit::Points, 500_000), (Limit::BlendedFragments, 2_000_000)]),
            pass("tiles", &[]),
        ];
        let round = |slow: f64| LimitRound {
            passes_ms: [5.0, 8.0, 1.0].map(|ms| slow * ms).to_vec(),
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
        assert_eq!((visibility.binds, visibility.bound_ms), (Some(Limit::Points), Spread::of([1.0, 2.0])));
        assert_eq!(accumulate.binds, Some(Limit::BlendedFragments));
        assert_eq!((visibility.ratio, accumulate.ratio), (same(5.0), same(2.0)));
        assert_eq!(accumulate.limit_ms[&Limit::Points], 1.5);
        // What is not known has no bound, and takes none from the frame.
        assert_eq!((tiles.binds, tiles.bound_ms, tiles.ratio), (None, None, None));
        assert_eq!((frame.bound_ms, frame.ratio), (Spread::of([5.0, 10.0]), same(14.0 / 5.0)));
        assert_eq!(frame.work[&Limit::Points], 1_000_000);
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
        let works = [LimitWork { limit: Limit::Points, units: 10, bytes_per_unit: None }];
        let pass = PassWork { name: "a".to_owned(), units: [(Limit::Points, 5)].into() };
        for ms in [None, Some(0.0)] {
            let round = LimitRound { passes_ms: vec![1.0], limits_ms: vec![ms] };
            let report = LimitsReport::of(&works, std::slice::from_ref(&pass), &[round], Vec::new());
            assert_eq!((report.bounds[0].bound_ms, report.bounds[0].binds), (None, None));
            assert_eq!(report.limits[0].units_per_sec, None);
            assert!(report.bounds[0].ms.is_some());
        }
    }
}
