//! Ways to draw, measured in turn with each other and with a floor: what the tables of times have in common.

use serde::{Serialize, Serializer};

use super::gate::{GateFigure, GateKind};
use crate::report::{FrameTimes, PassFigures, Spread, TimedFrames, cells, grid::Table};

/// The measurement of one way to draw.
#[derive(Clone, Debug, Serialize)]
pub struct Measurement<S> {
    /// Its name; unique in its table.
    pub name: String,
    /// Its frames, as they were taken.
    #[serde(skip)]
    pub timed: TimedFrames,
    /// Its frames, summed up.
    pub frames: FrameTimes,
    /// Frames a second, by the median of frames whose passes are not timed; `None` where not measured.
    pub fps: Option<f64>,
    /// How many times the first one's frame its own takes, round by round.
    pub beside_first: Option<Spread>,
    /// How many times the floor's frame its own takes, round by round; where passes have a floor, too, theirs before it.
    #[serde(serialize_with = "one_or_all", skip_serializing_if = "Vec::is_empty")]
    pub over_floor: Vec<Option<Spread>>,
    /// Bytes of device memory that a frame's own images and buffers share.
    pub transient_bytes: u64,
    /// The scene drawn, and the rest that its table tells of it.
    #[serde(flatten)]
    pub subject: S,
}

fn one_or_all<S: Serializer>(ratios: &[Option<Spread>], serializer: S) -> Result<S::Ok, S::Error> {
    match ratios {
        [one] => one.serialize(serializer),
        all => all.serialize(serializer),
    }
}

impl<S> Measurement<S> {
    /// The measurements of all contestants, taken in turn: the name of each, what was drawn, and its frames.
    pub fn all(contestants: Vec<(String, S, TimedFrames)>, floor: Option<&TimedFrames>) -> Vec<Self> {
        let first = contestants.first().map(|(.., timed)| timed.clone());
        let of = |(name, subject, timed): (String, S, TimedFrames)| {
            let frames = timed.times();
            let ms = frames.frame_ms.map(|spread| spread.median).filter(|ms| *ms > 0.0);
            Self {
                name,
                fps: ms.map(|ms| 1e3 / ms),
                beside_first: first.as_ref().and_then(|first| timed.frame_ratio(first)),
                over_floor: floor.iter().map(|floor| timed.frame_ratio(floor)).collect(),
                transient_bytes: timed.transient_bytes,
                frames,
                timed,
                subject,
            }
        };
        contestants.into_iter().map(of).collect()
    }

    /// How many times the floor's frame its own takes.
    pub fn frame_over_floor(&self) -> Option<Spread> {
        self.over_floor.last().copied().flatten()
    }

    /// Vertices of all passes; `None` where none were counted.
    pub fn vertices(&self) -> Option<u64> {
        self.sum(|pass| pass.vertices)
    }

    /// Fragments of all passes; `None` where none were counted.
    pub fn fragments(&self) -> Option<u64> {
        self.sum(|pass| pass.fragments)
    }

    /// Passes without draws have none.
    fn sum(&self, of: fn(&PassFigures) -> Option<u64>) -> Option<u64> {
        self.frames.passes.iter().filter_map(of).reduce(|sum, count| sum + count)
    }

    /// The figures by which it is judged. `place` begins their names.
    pub(super) fn gate(&self, place: &str) -> Vec<GateFigure> {
        let name = |what: &str| format!("{place}, {}, {what}", self.name);
        let work = |what: &str, count| GateFigure::count(name(what), GateKind::Work, count);
        [
            GateFigure::time(name("frame, x floor"), self.frame_over_floor().as_ref()),
            work("vertices", self.vertices()),
            work("fragments", self.fragments()),
            work("bytes", Some(self.transient_bytes)),
        ]
        .into_iter()
        .flatten()
        .collect()
    }
}

/// With what tables of transitions and of layers end with.
pub(super) fn with_costs<S>(table: Table<'_, Measurement<S>>) -> Table<'_, Measurement<S>> {
    table
        .column("x floor", |own| cells::median(own.frame_over_floor(), 2))
        .column("MB", |own| cells::megabytes(own.transient_bytes))
        .column("record ms", |own| cells::median(own.frames.record_ms, 3))
}

/// How uncertain a ratio may be that is called equal to 1: half its interval.
const CERTAIN_ENOUGH: f64 = 0.05;

/// Whether a ratio is 1 within noise; `None` where it is too uncertain to tell: noise alone proves nothing.
pub(super) fn is_equal(ratio: Option<&Spread>) -> Option<bool> {
    let ratio = ratio?;
    let certain = ratio.uncertainty().is_some_and(|part| part <= CERTAIN_ENOUGH);
    ratio.may_be(1.0).filter(|equal| certain || !equal)
}
