//! What transparent layers cost, after figure 6 of Guennebaud, Barthe, Paulin 2006: the paper's three ways to draw its scene
//! beside as many layers as the view has, and the same splats opaque.

use serde::Serialize;

use super::{
    Contestant, EmptyLayers, FrameTimes, Measured, Spread,
    gate::{GateFigure, GateKind},
};

/// `bench layers`.
#[derive(Clone, Debug, Serialize)]
pub struct LayersReport {
    /// Balls in the scene.
    pub balls: u32,
    /// Splats of each.
    pub splats_per_ball: u64,
    /// The contestants, timed in turn, the one that all are set beside first.
    pub contestants: Vec<LayersContestant>,
    /// The floor's frames: the points of the opaque splats into the same formats with nothing computed.
    pub floor: FrameTimes,
    /// Of the contestant that has as many layers as the view; `None` where nothing was counted.
    pub empty: Option<EmptyLayers>,
    /// What layers cost where nothing is transparent.
    pub opaque: OpaqueClaim,
}

/// A way to draw the scene.
#[derive(Clone, Debug, Serialize)]
pub struct LayersContestant {
    /// What was measured.
    #[serde(flatten)]
    pub contestant: Contestant,
    /// Layers for which passes were recorded; `None` where nothing is transparent.
    pub layers: Option<u32>,
    /// The device leaves out those that the view does not have.
    pub auto: bool,
    /// Frames a second in the paper, on its own hardware of 2006, where it has them.
    pub paper_fps: Option<f64>,
}

/// The opaque scene with one layer allowed, and with many.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OpaqueClaim {
    /// Both frames have the same passes.
    pub same_passes: bool,
    /// How many times the frame with one the other takes, round by round.
    pub ratio: Option<Spread>,
}

/// Contestants of the table by their places: what the notes speak of.
#[derive(Clone, Copy, Debug)]
pub struct Places {
    /// As many layers as the view has.
    pub auto: usize,
    /// The opaque scene with one layer allowed, and with many.
    pub opaque: [usize; 2],
}

/// A contestant as the table has it beside its measurement.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    /// As [`LayersContestant::layers`].
    pub layers: Option<u32>,
    /// As [`LayersContestant::auto`].
    pub auto: bool,
    /// As [`LayersContestant::paper_fps`].
    pub paper_fps: Option<f64>,
    /// As [`Contestant::transient_bytes`].
    pub transient_bytes: u64,
}

impl LayersReport {
    /// Of contestants measured in turn with a floor, as many as there are ways. `balls`: how many, and splats of each.
    pub fn of(
        (balls, splats_per_ball): (u32, u64),
        measured: &[Measured<'_>],
        ways: &[Way],
        floor: &Measured<'_>,
        places: Places,
    ) -> Self {
        let bytes: Vec<u64> = ways.iter().map(|way| way.transient_bytes).collect();
        let contestants = Contestant::all(measured, &bytes, floor);
        let [one, many] = places.opaque.map(|place| measured.get(place));
        Self {
            balls,
            splats_per_ball,
            contestants: contestants
                .into_iter()
                .zip(ways)
                .map(|(contestant, way)| LayersContestant {
                    contestant,
                    layers: way.layers,
                    auto: way.auto,
                    paper_fps: way.paper_fps,
                })
                .collect(),
            floor: floor.times(),
            empty: measured.get(places.auto).and_then(EmptyLayers::of),
            opaque: OpaqueClaim {
                same_passes: one.zip(many).is_some_and(|(one, many)| one.passes == many.passes),
                ratio: one.zip(many).and_then(|(one, many)| many.frame_ratio(one)),
            },
        }
    }

    /// How many times the first contestant's frames a second the paper has for another.
    pub fn paper_speed(&self, contestant: &LayersContestant) -> Option<f64> {
        Some(contestant.paper_fps? / self.contestants.first()?.paper_fps?)
    }

    /// Bytes of a frame's own images and buffers with the fewest layers, and with the most; the numbers of layers first.
    /// `auto`: of those that the device may leave out, which have buffers of their own for that.
    pub fn memory(&self, auto: bool) -> Option<[(u32, u64); 2]> {
        let of = |contestant: &LayersContestant| {
            contestant.layers.map(|layers| (layers, contestant.contestant.transient_bytes))
        };
        let all = || self.contestants.iter().filter(|contestant| contestant.auto == auto).filter_map(of);
        Some([all().min_by_key(|(layers, _)| *layers)?, all().max_by_key(|(layers, _)| *layers)?])
    }

    /// The figures by which it is judged.
    pub fn gate(&self) -> Vec<GateFigure> {
        let table = "layers";
        let frames = self.contestants.iter().flat_map(|contestant| contestant.contestant.gate(table));
        let with_something = self.empty.as_ref().and_then(EmptyLayers::with_something);
        let work = |what: &str, count| GateFigure::count(format!("{table}, {what}"), GateKind::Work, count);
        let others = [
            work("layers with something in them", with_something.map(u64::from)),
            work("opaque scene's passes depend on layers", Some(u64::from(!self.opaque.same_passes))),
        ];
        frames.chain(others.into_iter().flatten()).collect()
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::{
        super::{
            contest::tests::{measured, rounds},
            gate::{Gate, GateLimits},
        },
        *,
    };

    fn names(layers: u32) -> Vec<String> {
        let of = |layer| ["accumulate", "compose"].map(|pass| format!("{pass} of layer {layer}"));
        (1..=layers).flat_map(of).chain(["finalize".to_owned()]).collect()
    }

    /// Six layers, three, as many as there are, which is one; opaque; `changed`: with another pass where more are allowed.
    pub(in crate::report) fn report(changed: bool) -> LayersReport {
        let passes = [names(6), names(3), names(4), names(0), names(u32::from(changed))];
        let costs = [2.0, 1.0, 0.5, 1.0, 1.0];
        let all: Vec<_> = passes.iter().zip(costs).map(|(p, cost)| rounds(&vec![cost; p.len()])).collect();
        let counts: Vec<Vec<Option<[u64; 2]>>> =
            passes.iter().map(|passes| vec![Some([3, 10]); passes.len()]).collect();
        let mut counts = counts;
        // Two of four are drawn.
        counts[2][4..8].fill(Some([0, 0]));
        let titles = ["6, drop", "3, drop", "auto:4, drop", "opaque", "opaque, auto:64"];
        let entries: Vec<_> = (0..5).map(|i| measured(titles[i], &passes[i], &all[i], &counts[i])).collect();
        let way = |layers, paper_fps, transient_bytes| Way {
            layers,
            auto: layers == Some(4),
            paper_fps,
            transient_bytes,
        };
        let ways = [
            way(Some(6), Some(21.0), 1_000_000),
            way(Some(3), Some(45.0), 1_000_000),
            way(Some(4), None, 1_000_008),
            way(None, None, 500_000),
            way(None, None, 500_000),
        ];
        let floor_rounds = rounds(&[0.5]);
        let floor_names = ["floor fill".to_owned()];
        let floor = measured("floor", &floor_names, &floor_rounds, &[None]);
        LayersReport::of((27, 2000), &entries, &ways, &floor, Places { auto: 2, opaque: [3, 4] })
    }

    #[test]
    fn the_papers_ratios_are_those_of_its_frames_a_second() {
        let report = report(false);
        let speeds: Vec<Option<f64>> =
            report.contestants.iter().map(|contestant| report.paper_speed(contestant)).collect();
        assert_eq!(speeds, [Some(1.0), Some(45.0 / 21.0), None, None, None]);
        // 13 passes of 2 ms, 7 of 1.
        assert_eq!(report.contestants[1].contestant.beside_first, Spread::of([7.0 / 26.0; 6]));
        assert_eq!(report.memory(false), Some([(3, 1_000_000), (6, 1_000_000)]));
        assert_eq!(report.memory(true), Some([(4, 1_000_008); 2]));
        assert_eq!(report.empty.as_ref().and_then(EmptyLayers::with_something), Some(1));
    }

    #[test]
    fn an_opaque_scene_whose_passes_change_with_the_layers_is_worse() {
        let (same, changed) = (report(false), report(true));
        assert_eq!((same.opaque.same_passes, same.opaque.ratio), (true, Spread::of([1.0; 6])));
        assert!(!changed.opaque.same_passes);
        let gate = |report: &LayersReport| Gate { figures: report.gate(), ..Gate::default() };
        let limits = GateLimits { tolerance: 10.0, uncertainty: 1.0 };
        assert!(gate(&same).judge(&gate(&same), limits).passes());
        let judged = gate(&changed).judge(&gate(&same), limits);
        let worse: Vec<&str> =
            judged.with(super::super::gate::Verdict::Worse).map(|judged| judged.name.as_str()).collect();
        assert!(worse.contains(&"layers, opaque scene's passes depend on layers"), "{worse:?}");
    }
}
