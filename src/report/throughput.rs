//! Table 1 of Guennebaud, Barthe, Paulin 2006 (section 7), on any device: the throughput of perspective splatting and of ray
//! casting at several numbers of splats, over the floor of the same points, beside the paper's own figures.

use serde::{Deserialize, Serialize};

use super::{FrameSample, FrameTimes, Spread};

/// One number of splats.
#[derive(Clone, Debug, Serialize)]
pub struct ThroughputRow {
    /// Splats drawn.
    pub splats: u64,
    /// Each method, timed in turn with the others and with the floor.
    pub methods: Vec<MethodThroughput>,
    /// The floor's frames: the same points into the same formats with nothing computed.
    pub floor: FrameTimes,
    /// How many times the first method's frame the others' take, round by round.
    pub beside_first: Vec<Option<Spread>>,
    /// Bytes of device memory in splat buffers.
    pub splat_bytes: u64,
    /// Bytes of device memory that a frame's own images and buffers share.
    pub transient_bytes: u64,
}

/// One method at one number of splats.
#[derive(Clone, Debug, Serialize)]
pub struct MethodThroughput {
    /// The method in words.
    pub name: String,
    /// Its frames.
    pub frames: FrameTimes,
    /// How many times the floor's pass each of its passes takes, then the frame, round by round.
    pub over_floor: Vec<Option<Spread>>,
    /// Frames a second, by the median of frames whose passes are not timed; `None` where not measured.
    pub fps: Option<f64>,
    /// Million splats a second, drawn or culled.
    pub million_splats_per_sec: Option<f64>,
    /// The instructions of its passes.
    #[cfg(feature = "counts")]
    pub instructions: Vec<crate::count::PassCounts>,
    /// Which of the paper's methods it is.
    pub paper_method: Option<PaperMethod>,
    /// What the paper has for it at this number of splats.
    pub paper: Option<PaperThroughput>,
}

/// Figures of the paper, on its own hardware (GeForce 7800, 2006).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PaperThroughput {
    /// Frames a second.
    pub fps: f64,
    /// Million splats a second.
    pub million_splats_per_sec: f64,
}

/// The paper's table: splats, then frames a second of perspective splatting and of ray casting.
const PAPER: [(u64, [f64; 2]); 5] = [
    (154_000, [50.0, 33.0]),
    (460_000, [40.0, 26.0]),
    (1_400_000, [22.0, 13.0]),
    (2_500_000, [15.0, 9.2]),
    (5_000_000, [6.5, 5.0]),
];

/// The methods of the paper's table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PaperMethod {
    /// Perspective splatting.
    Perspective,
    /// Ray casting.
    Raycast,
}

/// The paper's numbers of splats.
pub const PAPER_SPLATS: [u64; 5] = [154_000, 460_000, 1_400_000, 2_500_000, 5_000_000];

/// The paper's figures of a method at a number of splats, where it has them.
pub fn paper_throughput(method: PaperMethod, splats: u64) -> Option<PaperThroughput> {
    let (count, fps) = PAPER.iter().find(|(count, _)| *count == splats)?;
    let fps = fps[method as usize];
    Some(PaperThroughput { fps, million_splats_per_sec: fps * *count as f64 * 1e-6 })
}

/// What was measured of one contestant: its passes' names, its frames round by round, its counts.
pub struct Measured<'a> {
    /// The method in words.
    pub name: &'a str,
    /// Which of the paper's methods it is.
    pub paper: Option<PaperMethod>,
    /// Its passes.
    pub passes: &'a [String],
    /// Frames of each round.
    pub rounds: &'a [Vec<FrameSample>],
    /// Vertices and fragments of each pass.
    pub counts: &'a [Option<[u64; 2]>],
    /// Instructions of its passes, where they were counted.
    #[cfg(feature = "counts")]
    pub instructions: &'a [crate::count::PassCounts],
}

impl Measured<'_> {
    /// Its frames.
    pub fn times(&self) -> FrameTimes {
        FrameTimes::of(self.passes, 1, &self.rounds.concat(), self.counts)
    }

    /// The passes' milliseconds in each round, then the frame's: the least of the round's frames, since what disturbs a
    /// frame only makes it longer.
    fn rounds_ms(&self) -> Vec<Vec<Option<f64>>> {
        let pass = |round: &[FrameSample], i: usize| least(round.iter().map(|frame| frame.passes_ms[i]));
        let frame = |round: &[FrameSample]| least(round.iter().map(|frame| frame.frame_ms));
        let round = |round: &Vec<FrameSample>| {
            (0..self.passes.len()).map(|i| pass(round, i)).chain([frame(round)]).collect()
        };
        self.rounds.iter().map(round).collect()
    }

    fn place_of(&self, pass: &str) -> Option<usize> {
        self.passes.iter().position(|own| own == pass)
    }

    /// Milliseconds of the frame in each round; empty where not measured.
    pub fn frame_ms(&self) -> Vec<f64> {
        let all: Option<Vec<f64>> =
            self.rounds_ms().iter().map(|round| round.last().copied().flatten()).collect();
        all.unwrap_or_default()
    }

    /// How many times the frame of another its own takes, round by round.
    pub fn frame_ratio(&self, other: &Self) -> Option<Spread> {
        ratio(&self.rounds_ms(), &other.rounds_ms(), self.passes.len(), other.passes.len())
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

fn least(values: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    values.collect::<Option<Vec<f64>>>()?.into_iter().reduce(f64::min)
}

/// Figure `i` of one contestant over that of another, round by round.
fn ratio(own: &[Vec<Option<f64>>], other: &[Vec<Option<f64>>], i: usize, j: usize) -> Option<Spread> {
    // A round in which a timestamp was lost, or did not move, tells nothing of either.
    let figure = |round: &[Option<f64>], i: usize| round.get(i).copied().flatten().filter(|ms| *ms > 0.0);
    Spread::of(own.iter().zip(other).filter_map(|(own, other)| Some(figure(own, i)? / figure(other, j)?)))
}

impl ThroughputRow {
    /// Of methods and their floor, measured in turn.
    pub fn of(splats: u64, methods: &[Measured<'_>], floor: &Measured<'_>, bytes: [u64; 2]) -> Self {
        let floor_ms = floor.rounds_ms();
        let method = |measured: &Measured<'_>| {
            let own_ms = measured.rounds_ms();
            let frames = measured.times();
            let secs = frames.frame_ms.map(|spread| 1e-3 * spread.median).filter(|secs| *secs > 0.0);
            MethodThroughput {
                name: measured.name.to_owned(),
                over_floor: measured
                    .passes
                    .iter()
                    .enumerate()
                    .map(|(i, pass)| ratio(&own_ms, &floor_ms, i, floor.place_of(floor_pass(pass)?)?))
                    .chain([ratio(&own_ms, &floor_ms, measured.passes.len(), floor.passes.len())])
                    .collect(),
                #[cfg(feature = "counts")]
                instructions: measured.instructions.to_vec(),
                fps: secs.map(|secs| 1.0 / secs),
                million_splats_per_sec: secs.map(|secs| 1e-6 * splats as f64 / secs),
                paper_method: measured.paper,
                paper: measured.paper.and_then(|method| paper_throughput(method, splats)),
                frames,
            }
        };
        let first = methods.first().map(Measured::rounds_ms).unwrap_or_default();
        let frame = |measured: &Measured<'_>| measured.passes.len();
        let beside = |measured: &Measured<'_>| {
            ratio(&measured.rounds_ms(), &first, frame(measured), methods.first().map_or(0, frame))
        };
        Self {
            splats,
            methods: methods.iter().map(method).collect(),
            floor: floor.times(),
            beside_first: methods.iter().map(beside).collect(),
            splat_bytes: bytes[0],
            transient_bytes: bytes[1],
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    fn rounds(scale: f64) -> Vec<Vec<FrameSample>> {
        // The machine becomes slower from round to round.
        let frame = |slow: f64| FrameSample {
            passes_ms: [1.0, 2.0, 0.5].map(|ms| Some(scale * slow * ms)).to_vec(),
            frame_ms: Some(scale * slow * 3.5),
            wall_ms: 4.0,
            record_ms: 0.1,
        };
        (1..=6).map(|round| vec![frame(1.5 * f64::from(round)), frame(f64::from(round))]).collect()
    }

    pub(in crate::report) fn row() -> ThroughputRow {
        let names = ["visibility", "accumulate", "finalize"].map(str::to_owned);
        let floor_names = ["floor depth", "floor add", "floor fill"].map(str::to_owned);
        let counts = [Some([7, 70]); 3];
        let all = [rounds(2.0), rounds(3.0), rounds(1.0)];
        let measured = |name, paper, i: usize| Measured {
            name,
            paper,
            passes: if i == 2 { &floor_names } else { &names },
            rounds: &all[i],
            counts: &counts,
            #[cfg(feature = "counts")]
            instructions: &[],
        };
        let methods = [
            measured("perspective", Some(PaperMethod::Perspective), 0),
            measured("other", None, 1),
            measured("raycast", Some(PaperMethod::Raycast), 1),
        ];
        ThroughputRow::of(154_000, &methods, &measured("floor", None, 2), [1_000_000, 500_000])
    }

    #[test]
    fn ratios_are_those_of_each_round() {
        let row = row();
        assert_eq!(row.beside_first, [1.0, 1.5, 1.5].map(|ratio| Spread::of([ratio; 6])));
        assert_eq!(row.methods[0].over_floor, vec![Spread::of([2.0; 6]); 4]);
        // 12 frames from 7 to 63 ms.
        let median = row.methods[0].frames.frame_ms.unwrap().median;
        assert!((row.methods[0].fps.unwrap() - 1e3 / median).abs() < 1e-9);
        assert_eq!(row.methods[1].paper, None);
        assert_eq!(
            row.methods[2].paper,
            Some(PaperThroughput { fps: 33.0, million_splats_per_sec: 33.0 * 0.154 })
        );
    }

    #[test]
    fn the_papers_splats_a_second_follow_from_its_frames() {
        // As printed: 50 (7.7), 40 (18.4), 22 (31), 15 (37.5), 6.5 (32.5); 33 (5), 26 (12), 13 (18.2), 9.2 (23), 5 (25).
        let printed = [[7.7, 5.0], [18.4, 12.0], [31.0, 18.2], [37.5, 23.0], [32.5, 25.0]];
        for (splats, printed) in PAPER_SPLATS.into_iter().zip(printed) {
            for (method, printed) in [PaperMethod::Perspective, PaperMethod::Raycast].into_iter().zip(printed)
            {
                let figure = paper_throughput(method, splats).unwrap();
                let near = (figure.million_splats_per_sec / printed - 1.0).abs() < 0.02;
                assert!(near, "{splats}: {figure:?} {printed}");
            }
        }
        assert_eq!(paper_throughput(PaperMethod::Raycast, 150_000), None);
    }
}
