//! The times of several frames of the same passes, and where they contradict each other.

use std::fmt;

use serde::Serialize;

use super::{
    Grid, Spread,
    cells::{figure, number},
};

/// How far the sum of the passes may be from the frame's time, and that from the time of submission and wait, before it is flagged,
/// as a part of the latter.
const TOLERANCE: f64 = 0.05;

/// The times of one frame.
#[derive(Clone, Debug)]
pub struct FrameSample {
    /// Milliseconds of each pass, in the frame's order, in a frame of its own, since timing them may make it longer; `None`
    /// where not measured.
    pub passes_ms: Vec<Option<f64>>,
    /// Milliseconds of a frame whose passes are not timed, from its first timestamp to its last; `None` where not measured.
    pub frame_ms: Option<f64>,
    /// Milliseconds from that frame's submission to the end of the wait for it.
    pub wall_ms: f64,
    /// Milliseconds in which the host recorded that frame.
    pub record_ms: f64,
}

/// A figure of one frame; `None` where not measured.
type Figure = fn(&FrameSample) -> Option<f64>;

impl FrameSample {
    /// The passes together; `None` where one is missing.
    fn sum_ms(&self) -> Option<f64> {
        self.passes_ms.iter().copied().sum()
    }
}

/// The cost of one pass.
#[derive(Clone, Debug, Serialize)]
pub struct PassFigures {
    /// The pass.
    pub name: String,
    /// Its milliseconds; `None` where not measured.
    pub ms: Option<Spread>,
    /// Invocations of the vertex stage in one frame; `None` where not counted.
    pub vertices: Option<u64>,
    /// Invocations of the fragment stage in one frame; `None` where not counted.
    pub fragments: Option<u64>,
}

/// The cost of a frame, over several frames.
#[derive(Clone, Debug, Serialize)]
pub struct FrameTimes {
    /// Frames drawn before the timed ones, so that caches are warm.
    pub warm_up_frames: u32,
    /// Frames timed.
    pub timed_frames: u32,
    /// Each pass, in the frame's order.
    pub passes: Vec<PassFigures>,
    /// The passes of a frame together, with what timing them costs, in milliseconds; `None` where not measured.
    pub sum_of_passes_ms: Option<Spread>,
    /// A frame whose passes are not timed, from its first timestamp to its last, in milliseconds: what a frame takes; `None`
    /// where not measured.
    pub frame_ms: Option<Spread>,
    /// From such a frame's submission to the end of the wait for it, in milliseconds.
    pub submit_to_wait_ms: Option<Spread>,
    /// In which the host recorded the frame, in milliseconds.
    pub record_ms: Option<Spread>,
    /// Notes for a reader of these figures, a sentence each.
    pub flags: Vec<String>,
}

impl FrameTimes {
    /// The cost of frames with these passes. `counts` are vertices and fragments of each pass, where they were counted.
    pub fn of(
        names: &[String],
        warm_up_frames: u32,
        samples: &[FrameSample],
        counts: &[Option<[u64; 2]>],
    ) -> Self {
        let pass = |(i, name): (usize, &String)| {
            let measured: Option<Vec<f64>> =
                samples.iter().map(|sample| sample.passes_ms.get(i).copied().flatten()).collect();
            let counted = counts.get(i).copied().flatten();
            PassFigures {
                name: name.clone(),
                ms: measured.and_then(Spread::of),
                vertices: counted.map(|[vertices, _]| vertices),
                fragments: counted.map(|[_, fragments]| fragments),
            }
        };
        let passes: Vec<_> = names.iter().enumerate().map(pass).collect();
        let all = |figure: Figure| -> Option<Spread> {
            samples.iter().map(figure).collect::<Option<Vec<f64>>>().and_then(Spread::of)
        };
        Self {
            warm_up_frames,
            timed_frames: u32::try_from(samples.len()).unwrap_or(u32::MAX),
            sum_of_passes_ms: all(FrameSample::sum_ms),
            frame_ms: all(|sample| sample.frame_ms),
            submit_to_wait_ms: all(|sample| Some(sample.wall_ms)),
            record_ms: all(|sample| Some(sample.record_ms)),
            flags: flags(samples, &passes),
            passes,
        }
    }
}

/// A line of the table: what it is of, and whether that is a pass, which has counts.
type Line<'a> = (String, Option<Spread>, Option<&'a PassFigures>);

impl fmt::Display for FrameTimes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut lines: Vec<Line<'_>> = Vec::new();
        lines.extend(self.passes.iter().map(|pass| (format!("  {}", pass.name), pass.ms, Some(pass))));
        lines.extend([
            ("sum of the passes".to_owned(), self.sum_of_passes_ms, None),
            ("frame, passes not timed".to_owned(), self.frame_ms, None),
            ("submission to end of wait".to_owned(), self.submit_to_wait_ms, None),
            ("recorded by the host".to_owned(), self.record_ms, None),
        ]);
        let count = |pass: Option<&PassFigures>, of: fn(&PassFigures) -> Option<u64>| {
            pass.map_or_else(String::new, |pass| figure(of(pass)))
        };
        let title = format!("{} frames after {} to warm up", self.timed_frames, self.warm_up_frames);
        let table = Grid::of("", &lines)
            .column(title, |(name, ..)| name.clone())
            .column("median ms", |(_, ms, _)| number(ms.map(|ms| ms.median), 3))
            .column("min", |(_, ms, _)| number(ms.map(|ms| ms.min), 3))
            .column("max", |(_, ms, _)| number(ms.map(|ms| ms.max), 3))
            .column("vertices", |(.., pass)| count(*pass, |pass| pass.vertices))
            .column("fragments", |(.., pass)| count(*pass, |pass| pass.fragments));
        write!(f, "{}", table.with_notes(self.flags.iter().map(|flag| format!("note: {flag}"))))
    }
}

/// All that is odd about the measurements.
fn flags(samples: &[FrameSample], passes: &[PassFigures]) -> Vec<String> {
    let mut flags = Vec::new();
    if samples.is_empty() {
        flags.push("no frame was timed".to_owned());
    } else if passes.iter().any(|pass| pass.ms.is_none())
        || samples.iter().any(|sample| sample.frame_ms.is_none())
    {
        let reason = "frames or passes were not timed: the device's queue has no timestamps, or lost one";
        flags.push(reason.to_owned());
    }
    // Passes without draws, such as dispatches and copies, have nothing to count.
    if !passes.is_empty() && passes.iter().all(|pass| pass.fragments.is_none()) {
        flags.push(
            "vertices and fragments were not counted: the device can't (pipelineStatisticsQuery)".to_owned(),
        );
    }
    let sums = samples.iter().filter_map(|sample| sample.sum_ms().zip(sample.frame_ms));
    flags.extend(passes_flag(sums));
    let waits = samples.iter().filter_map(|sample| Some((sample.frame_ms?, sample.wall_ms)));
    flags.extend(apart_flag(
        "the time of a frame",
        "the time from its submission to the end of the wait",
        waits,
    ));
    flags
}

/// A note where timing the passes costs something: of each frame their sum, and the time of one whose passes are not timed.
pub fn passes_flag(sums_and_frames_ms: impl Iterator<Item = (f64, f64)>) -> Option<String> {
    let other = "the time of a frame whose passes are not timed";
    apart_flag("the sum of the passes", other, sums_and_frames_ms)
}

/// Says so where one figure of each frame is not near the other, which is to be the same.
fn apart_flag(what: &str, other: &str, both: impl Iterator<Item = (f64, f64)>) -> Option<String> {
    let differences: Vec<f64> =
        both.filter(|(_, whole)| *whole > 0.0).map(|(part, whole)| (part - whole) / whole).collect();
    let frames = differences.len();
    let median = Spread::of(differences)?.median;
    let (percent, side) = (100.0 * median.abs(), if median < 0.0 { "below" } else { "above" });
    (median.abs() > TOLERANCE).then(|| {
        format!("{what} is {percent:.1}% {side} {other} (median over {frames} frames; up to 5% is fine)")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(passes_ms: [f64; 2], frame_ms: f64, wall_ms: f64) -> FrameSample {
        FrameSample {
            passes_ms: passes_ms.map(Some).to_vec(),
            frame_ms: Some(frame_ms),
            wall_ms,
            record_ms: 0.1,
        }
    }

    fn times(samples: &[FrameSample]) -> FrameTimes {
        FrameTimes::of(&["a".to_owned(), "b".to_owned()], 2, samples, &[Some([3, 4]), Some([5, 6])])
    }

    #[test]
    fn figures_are_taken_per_pass_and_per_frame() {
        let samples = [sample([1.0, 10.0], 11.0, 11.2), sample([2.0, 8.0], 10.1, 10.2)];
        let times = times(&samples);
        assert_eq!(times.passes[1].ms, Spread::of([10.0, 8.0]));
        assert_eq!((times.passes[1].vertices, times.passes[1].fragments), (Some(5), Some(6)));
        assert_eq!(times.sum_of_passes_ms, Spread::of([11.0, 10.0]));
        assert_eq!(times.frame_ms, Spread::of([11.0, 10.1]));
        assert_eq!(times.timed_frames, 2);
        assert!(times.flags.is_empty(), "{:?}", times.flags);
    }

    #[test]
    fn contradictions_beyond_five_percent_are_flagged_one_by_one() {
        let timing = times(&[sample([5.0, 5.0], 9.4, 9.5)]).flags;
        assert_eq!(timing.len(), 1);
        assert!(
            timing[0].starts_with("the sum of the passes is 6.4% above the time of a frame"),
            "{timing:?}"
        );
        let wall = times(&[sample([5.0, 5.0], 10.0, 9.0)]).flags;
        assert_eq!(wall.len(), 1);
        assert!(wall[0].contains("11.1% above the time from its submission"), "{wall:?}");
        assert!(times(&[sample([5.0, 5.0], 10.5, 10.5)]).flags.is_empty());
        // One slow frame among many is no contradiction of the figures, which are medians.
        let outlier =
            [sample([5.0, 5.0], 10.0, 10.0), sample([5.0, 5.0], 30.0, 10.0), sample([5.0, 5.0], 10.0, 10.0)];
        assert!(times(&outlier).flags.is_empty());
    }

    #[test]
    fn what_was_not_measured_has_no_figure_and_a_reason() {
        let untimed =
            FrameSample { passes_ms: vec![None, None], frame_ms: None, wall_ms: 3.0, record_ms: 0.1 };
        let times = FrameTimes::of(&["a".to_owned(), "b".to_owned()], 0, &[untimed], &[None, None]);
        assert_eq!((times.sum_of_passes_ms, times.frame_ms), (None, None));
        assert!(times.submit_to_wait_ms.is_some() && times.passes[0].ms.is_none());
        assert_eq!(times.flags.len(), 2);
        assert!(times.flags[0].contains("timestamps") && times.flags[1].contains("pipelineStatisticsQuery"));
        assert_eq!(FrameTimes::of(&[], 0, &[], &[]).flags, ["no frame was timed"]);
    }
}
