//! Contestants timed in turn with a floor: what the tables of layers and transitions have in common.

use serde::Serialize;

use super::{
    FrameTimes, Measured, Spread,
    gate::{GateFigure, GateKind},
    grid::{NONE, cell},
};

/// What was measured of one contestant.
#[derive(Clone, Debug, Serialize)]
pub struct Contestant {
    /// What it is in words; unique in its table.
    pub name: String,
    /// Its frames.
    pub frames: FrameTimes,
    /// Frames a second, by the median of frames whose passes are not timed; `None` where not measured.
    pub fps: Option<f64>,
    /// How many times the first contestant's frame its own takes, round by round.
    pub beside_first: Option<Spread>,
    /// How many times the floor's frame its own takes, round by round.
    pub over_floor: Option<Spread>,
    /// Bytes of device memory that a frame's own images and buffers share.
    pub transient_bytes: u64,
}

impl Contestant {
    /// Of all contestants, measured in turn; each with the bytes of its frame's own images and buffers.
    pub fn all(measured: &[Measured<'_>], transient_bytes: &[u64], floor: &Measured<'_>) -> Vec<Self> {
        let of = |(own, bytes): (&Measured<'_>, &u64)| {
            let frames = own.times();
            let ms = frames.frame_ms.map(|spread| spread.median).filter(|ms| *ms > 0.0);
            Self {
                name: own.name.to_owned(),
                fps: ms.map(|ms| 1e3 / ms),
                beside_first: measured.first().and_then(|first| own.frame_ratio(first)),
                over_floor: own.frame_ratio(floor),
                transient_bytes: *bytes,
                frames,
            }
        };
        measured.iter().zip(transient_bytes).map(of).collect()
    }

    /// The figures by which it is judged. `table` begins their names.
    pub(super) fn gate(&self, table: &str) -> Vec<GateFigure> {
        let name = |what: &str| format!("{table}, {}, {what}", self.name);
        let work = |what: &str, count| GateFigure::count(name(what), GateKind::Work, count);
        // Passes without draws have none.
        let sum = |of: fn(&super::PassFigures) -> Option<u64>| {
            self.frames.passes.iter().filter_map(of).reduce(|sum, count| sum + count)
        };
        [
            GateFigure::time(name("frame, x floor"), self.over_floor.as_ref()),
            work("vertices", sum(|pass| pass.vertices)),
            work("fragments", sum(|pass| pass.fragments)),
            work("bytes", Some(self.transient_bytes)),
        ]
        .into_iter()
        .flatten()
        .collect()
    }

    /// Milliseconds, and the interval that holds their median.
    pub(super) fn ms_cells(&self) -> [String; 2] {
        let ms = self.frames.frame_ms;
        [cell(ms.map(|ms| ms.median), 2), interval_cell(ms.as_ref(), 2)]
    }

    /// Times the floor, megabytes, milliseconds in which the host recorded a frame.
    pub(super) fn last_cells(&self) -> [String; 3] {
        [
            cell(self.over_floor.map(|over| over.median), 2),
            format!("{:.1}", 1e-6 * self.transient_bytes as f64),
            cell(self.frames.record_ms.map(|ms| ms.median), 3),
        ]
    }
}

/// How uncertain a ratio may be that is called equal to 1: half its interval.
const CERTAIN_ENOUGH: f64 = 0.05;

/// Whether a ratio is 1 within noise; `None` where it is too uncertain to tell: noise alone proves nothing.
pub(super) fn is_equal(ratio: Option<&Spread>) -> Option<bool> {
    let ratio = ratio?;
    let certain = ratio.uncertainty().is_some_and(|part| part <= CERTAIN_ENOUGH);
    ratio.may_be(1.0).filter(|equal| certain || !equal)
}

/// The interval that holds the true median.
pub(super) fn interval_cell(spread: Option<&Spread>, decimals: usize) -> String {
    match spread.and_then(|spread| spread.interval) {
        Some([low, high]) => format!("{low:.decimals$} to {high:.decimals$}"),
        None => NONE.to_owned(),
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::{super::FrameSample, *};

    /// Six rounds of a frame with these passes, on a machine that becomes slower.
    pub(in crate::report) fn rounds(passes_ms: &[f64]) -> Vec<Vec<FrameSample>> {
        let frame = |slow: f64| FrameSample {
            passes_ms: passes_ms.iter().map(|ms| Some(slow * ms)).collect(),
            frame_ms: Some(slow * passes_ms.iter().sum::<f64>()),
            wall_ms: slow * passes_ms.iter().sum::<f64>(),
            record_ms: 0.1,
        };
        (1..=6).map(|round| vec![frame(f64::from(round)); 2]).collect()
    }

    /// What was measured, without instructions.
    pub(in crate::report) fn measured<'a>(
        name: &'a str,
        passes: &'a [String],
        rounds: &'a [Vec<FrameSample>],
        counts: &'a [Option<[u64; 2]>],
    ) -> Measured<'a> {
        Measured {
            name,
            paper: None,
            passes,
            rounds,
            counts,
            #[cfg(feature = "counts")]
            instructions: &[],
        }
    }

    #[test]
    fn what_is_uncertain_is_not_called_equal() {
        let of = |ratios: [f64; 6]| is_equal(Spread::of(ratios).as_ref());
        assert_eq!(of([0.98, 0.99, 1.0, 1.0, 1.01, 1.02]), Some(true));
        assert_eq!(of([0.5, 0.9, 1.0, 1.0, 1.1, 1.5]), None);
        assert_eq!(of([1.01, 1.02, 1.02, 1.02, 1.02, 1.5]), Some(false));
        assert_eq!((is_equal(Spread::of([1.0; 5]).as_ref()), is_equal(None)), (None, None));
    }

    #[test]
    fn contestants_are_set_beside_the_first_and_the_floor() {
        let passes = ["copy", "draw"].map(str::to_owned);
        let counts = [None, Some([3, 40])];
        let all = [rounds(&[1.0, 3.0]), rounds(&[2.0, 4.0]), rounds(&[0.5, 0.5])];
        let of = |name, i: usize| measured(name, &passes, &all[i], &counts);
        let contestants = Contestant::all(&[of("a", 0), of("b", 1)], &[7, 9], &of("floor", 2));
        assert_eq!(contestants[1].beside_first, Spread::of([1.5; 6]));
        assert_eq!(contestants[1].over_floor, Spread::of([6.0; 6]));
        // 4 ms in the first round, 24 in the last.
        assert_eq!(contestants[0].fps, Some(1e3 / 14.0));
        let gate = contestants[1].gate("t");
        let figures: Vec<(&str, f64)> =
            gate.iter().map(|figure| (figure.name.as_str(), figure.value)).collect();
        let expected = [("t, b, frame, x floor", 6.0), ("t, b, vertices", 3.0), ("t, b, fragments", 40.0)];
        assert_eq!(figures[..3], expected);
        assert_eq!(figures[3], ("t, b, bytes", 9.0));
    }
}
