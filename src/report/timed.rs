//! Frames of one way to draw, as they were taken in turn with others.

use super::{FrameSample, FrameTimes, Spread};

/// Frames that are drawn before those of a round and not timed: what drew before needed other images, whose memory is touched
/// for the first time after each change.
pub const UNTIMED_A_TURN: u32 = 1;

/// The frames of one contestant.
#[derive(Clone, Debug, Default)]
pub struct TimedFrames {
    /// Its passes, in the frame's order.
    pub passes: Vec<String>,
    /// Frames of each round.
    pub rounds: Vec<Vec<FrameSample>>,
    /// Vertices and fragments of each pass, where they were counted.
    pub counts: Vec<Option<[u64; 2]>>,
    /// Bytes of device memory that a frame's own images and buffers share.
    pub transient_bytes: u64,
}

/// A figure of each round; `None` where it was not measured.
type Rounds = Vec<Option<f64>>;

impl TimedFrames {
    /// All frames, summed up.
    pub fn times(&self) -> FrameTimes {
        FrameTimes::of(&self.passes, UNTIMED_A_TURN, &self.rounds.concat(), &self.counts)
    }

    /// A figure of each round: the least of its frames', since what disturbs a frame only makes it longer.
    fn least(&self, figure: impl Fn(&FrameSample) -> Option<f64>) -> Rounds {
        let of = |round: &Vec<FrameSample>| {
            let all: Option<Vec<f64>> = round.iter().map(&figure).collect();
            all?.into_iter().reduce(f64::min)
        };
        self.rounds.iter().map(of).collect()
    }

    fn least_frame_ms(&self) -> Rounds {
        self.least(|frame| frame.frame_ms)
    }

    fn least_pass_ms(&self, pass: usize) -> Rounds {
        self.least(|frame| frame.passes_ms.get(pass).copied().flatten())
    }

    /// Milliseconds of the frame in each round; empty where not measured.
    pub fn frame_ms(&self) -> Vec<f64> {
        self.least_frame_ms().into_iter().collect::<Option<_>>().unwrap_or_default()
    }

    /// How many times the frame of another its own takes, round by round.
    pub fn frame_ratio(&self, other: &Self) -> Option<Spread> {
        ratio(self.least_frame_ms(), other.least_frame_ms())
    }

    /// How many times its floor each pass takes, then the frame, round by round.
    pub fn ratios_to_floor(&self, floor: &Self) -> Vec<Option<Spread>> {
        let of_pass = |(i, pass): (usize, &String)| {
            let below = floor_pass(pass)?;
            let place = floor.passes.iter().position(|own| own == below)?;
            ratio(self.least_pass_ms(i), floor.least_pass_ms(place))
        };
        self.passes.iter().enumerate().map(of_pass).chain([self.frame_ratio(floor)]).collect()
    }
}

/// The floor's pass that draws what a pass draws.
pub(super) fn floor_pass(pass: &str) -> Option<&'static str> {
    match pass {
        "visibility" => Some("floor depth"),
        "accumulate" => Some("floor add"),
        "finalize" => Some("floor fill"),
        _ => None,
    }
}

fn ratio(own: Rounds, other: Rounds) -> Option<Spread> {
    // A round in which a timestamp was lost, or did not move, tells nothing of either.
    let known = |ms: Option<f64>| ms.filter(|ms| *ms > 0.0);
    Spread::of(own.into_iter().zip(other).filter_map(|(own, other)| Some(known(own)? / known(other)?)))
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Six rounds of two frames with these passes, on a machine that becomes slower.
    pub(crate) fn timed(
        passes: &[&str],
        passes_ms: &[f64],
        counts: &[Option<[u64; 2]>],
        transient_bytes: u64,
    ) -> TimedFrames {
        let frame = |slow: f64| FrameSample {
            passes_ms: passes_ms.iter().map(|ms| Some(slow * ms)).collect(),
            frame_ms: Some(slow * passes_ms.iter().sum::<f64>()),
            wall_ms: slow * passes_ms.iter().sum::<f64>(),
            record_ms: 0.1,
        };
        TimedFrames {
            passes: passes.iter().map(|pass| (*pass).to_owned()).collect(),
            rounds: (1..=6).map(|round| vec![frame(f64::from(round)); 2]).collect(),
            counts: counts.to_vec(),
            transient_bytes,
        }
    }

    #[test]
    fn the_least_of_a_round_counts_and_lost_timestamps_do_not() {
        let floor = timed(&["floor add"], &[2.0], &[], 0);
        let mut own = timed(&["list", "accumulate"], &[1.0, 3.0], &[], 0);
        for round in &mut own.rounds {
            round[0].passes_ms[1] = Some(100.0);
        }
        own.rounds[0][0].frame_ms = None;
        let ratios = own.ratios_to_floor(&floor);
        assert_eq!(ratios, [None, Spread::of([1.5; 6]), Spread::of([2.0; 5])]);
        assert_eq!((own.frame_ms().len(), floor.frame_ms()[5]), (0, 12.0));
    }
}
