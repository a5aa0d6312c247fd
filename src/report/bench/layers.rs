//! The cost of transparent layers (Guennebaud, Barthe, Paulin 2006, figure 6): the paper's three ways to draw its scene
//! beside as many layers as the view has, and the same splats opaque.

use serde::Serialize;

use super::{
    EmptyLayers, Measurement,
    gate::{GateFigure, GateKind},
    measurement::{is_equal, with_costs},
};
use crate::report::{
    FrameTimes, Grid, Spread, TimedFrames,
    cells::{bracketed, figure, interval, median, number},
};

/// `bench layers`.
#[derive(Clone, Debug, Serialize)]
pub struct LayersReport {
    /// Balls in the scene.
    pub balls: u32,
    /// Splats of each.
    pub splats_per_ball: u64,
    /// The contestants, timed in turn, the one that all are set beside first.
    pub contestants: Vec<Measurement<LayersDrawn>>,
    /// The floor's frames: the points of the opaque splats into the same formats with nothing computed.
    pub floor: FrameTimes,
    /// Empty layers of the contestant that has as many as the view; `None` where nothing was counted.
    pub empty: Option<EmptyLayers>,
    /// The cost of layers where nothing is transparent.
    pub opaque: OpaqueClaim,
}

/// How a contestant draws the scene.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct LayersDrawn {
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

impl LayersReport {
    /// The report of contestants measured in turn with a floor. `balls`: how many, and splats of each.
    pub fn of(
        (balls, splats_per_ball): (u32, u64),
        contestants: Vec<Measurement<LayersDrawn>>,
        floor: &TimedFrames,
        places: Places,
    ) -> Self {
        let timed = |place: usize| contestants.get(place).map(|own| &own.timed);
        let opaque = timed(places.opaque[0]).zip(timed(places.opaque[1]));
        Self {
            balls,
            splats_per_ball,
            floor: floor.times(),
            empty: timed(places.auto).and_then(EmptyLayers::of),
            opaque: OpaqueClaim {
                same_passes: opaque.is_some_and(|(one, many)| one.passes == many.passes),
                ratio: opaque.and_then(|(one, many)| many.frame_ratio(one)),
            },
            contestants,
        }
    }

    /// How many times the first contestant's frames a second the paper has for another.
    pub fn paper_speed(&self, own: &Measurement<LayersDrawn>) -> Option<f64> {
        Some(own.subject.paper_fps? / self.contestants.first()?.subject.paper_fps?)
    }

    /// Bytes of a frame's own images and buffers with the fewest layers, and with the most; the numbers of layers first.
    /// `auto`: of those that the device may leave out, which have buffers of their own for that.
    pub fn memory(&self, auto: bool) -> Option<[(u32, u64); 2]> {
        let of = |own: &Measurement<LayersDrawn>| Some((own.subject.layers?, own.transient_bytes));
        let all = || self.contestants.iter().filter(|own| own.subject.auto == auto).filter_map(of);
        Some([all().min_by_key(|(layers, _)| *layers)?, all().max_by_key(|(layers, _)| *layers)?])
    }

    /// The figures by which it is judged.
    pub fn gate(&self) -> Vec<GateFigure> {
        let frames = self.contestants.iter().flat_map(|own| own.gate("layers"));
        let with_something = self.empty.as_ref().and_then(EmptyLayers::with_something);
        let work = |what: &str, count| GateFigure::count(format!("layers, {what}"), GateKind::Work, count);
        let others = [
            work("layers with something in them", with_something.map(u64::from)),
            work("opaque scene's passes depend on layers", Some(u64::from(!self.opaque.same_passes))),
        ];
        frames.chain(others.into_iter().flatten()).collect()
    }

    /// The table: the cost of each number of layers.
    pub(super) fn grid(&self) -> Grid {
        let speed = |own: &Measurement<LayersDrawn>| own.beside_first.and_then(|ratio| ratio.inverse());
        let title = format!("layers, {} balls of {} splats", self.balls, self.splats_per_ball);
        let table = Grid::of(title, &self.contestants)
            .column("method", |own| own.name.clone())
            .column("layers", |own| figure(own.subject.layers))
            .column("frame ms", |own| median(own.frames.frame_ms, 2))
            .column("95% of the median", |own| interval(own.frames.frame_ms, 2))
            .column("fps", |own| number(own.fps, 2))
            .column("(paper)", |own| bracketed(own.subject.paper_fps, 0))
            .column("fps x first", |own| median(speed(own), 2))
            .column("95% of the median", |own| interval(speed(own), 2))
            .column("(paper)", |own| bracketed(self.paper_speed(own), 2));
        with_costs(table).with_notes(self.notes())
    }

    fn notes(&self) -> Vec<String> {
        let mut notes = vec![
            "medians; in brackets the paper's (figure 6, on its own hardware and scene); fps x first: how many times as fast, of \
             each round; MB: a frame's own images and buffers"
                .to_owned(),
        ];
        notes.extend(self.empty.as_ref().map(EmptyLayers::sentence));
        notes.extend(self.memory(false).map(|[(few, least), (many, most)]| {
            let grows = match most == least {
                true => "memory does not grow with their number".to_owned(),
                false => format!("{:+.1}%", 100.0 * (most as f64 / least.max(1) as f64 - 1.0)),
            };
            format!(
                "a frame of {few} layers has {least} bytes of images and buffers, one of {many} {most}: {grows}"
            )
        }));
        notes.extend(self.memory(true).map(|[_, (most, bytes)]| {
            format!(
                "one of auto:{most} has {bytes}: the arguments of its draws and a count a layer come on top"
            )
        }));
        let OpaqueClaim { same_passes, ratio } = &self.opaque;
        let passes = if *same_passes { "the same passes" } else { "OTHER PASSES" };
        let verdict = match is_equal(ratio.as_ref()) {
            Some(true) => "equal within noise",
            Some(false) => "not equal within noise",
            None => "too uncertain to tell",
        };
        notes.push(format!(
            "layers that an opaque scene could have: {passes} as with one, {} times its frame (95% of the median: {}): \
             {verdict}",
            median(*ratio, 3),
            interval(*ratio, 3)
        ));
        notes
    }
}

#[cfg(test)]
mod tests {
    use super::{
        super::gate::{Gate, GateLimits, Verdict},
        *,
    };
    use crate::report::timed::tests::timed;

    /// Six layers, three, as many as there are, which is one; opaque; `changed`: with another pass where more are allowed.
    fn report(changed: bool) -> LayersReport {
        let contestant = |name: &str, passes: u32, cost: f64, (layers, paper_fps), bytes, drawn: usize| {
            let of = |layer| ["accumulate", "compose"].map(|pass| format!("{pass} of layer {layer}"));
            let passes: Vec<String> = (1..=passes).flat_map(of).chain(["finalize".to_owned()]).collect();
            let passes: Vec<&str> = passes.iter().map(String::as_str).collect();
            let count = |i: usize| Some(if i < drawn || i + 1 == passes.len() { [3, 10] } else { [0, 0] });
            let counts: Vec<_> = (0..passes.len()).map(count).collect();
            let subject = LayersDrawn { layers, auto: layers == Some(4), paper_fps };
            (name.to_owned(), subject, timed(&passes, &vec![cost; passes.len()], &counts, bytes))
        };
        let contestants = vec![
            contestant("6, drop", 6, 2.0, (Some(6), Some(21.0)), 1_000_000, 99),
            contestant("3, drop", 3, 1.0, (Some(3), Some(45.0)), 1_000_000, 99),
            // Two of four are drawn.
            contestant("auto:4, drop", 4, 0.5, (Some(4), None), 1_000_008, 4),
            contestant("opaque", 0, 1.0, (None, None), 500_000, 0),
            contestant("opaque, auto:64", u32::from(changed), 1.0, (None, None), 500_000, 99),
        ];
        let floor = timed(&["floor fill"], &[0.5], &[None], 0);
        let measured = Measurement::all(contestants, Some(&floor));
        LayersReport::of((27, 2000), measured, &floor, Places { auto: 2, opaque: [3, 4] })
    }

    #[test]
    fn the_papers_ratios_are_those_of_its_frames_a_second() {
        let report = report(false);
        let speeds: Vec<Option<f64>> = report.contestants.iter().map(|own| report.paper_speed(own)).collect();
        assert_eq!(speeds, [Some(1.0), Some(45.0 / 21.0), None, None, None]);
        // 13 passes of 2 ms, 7 of 1.
        assert_eq!(report.contestants[1].beside_first, Spread::of([7.0 / 26.0; 6]));
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
        let worse: Vec<&str> = judged.with(Verdict::Worse).map(|judged| judged.name.as_str()).collect();
        assert!(worse.contains(&"layers, opaque scene's passes depend on layers"), "{worse:?}");
    }

    #[test]
    fn every_contestant_has_a_row_and_what_follows_is_said() {
        let table = report(false).grid();
        assert_eq!(table.rows[1][..2], ["3, drop", "3"]);
        assert_eq!(table.rows[1][5..9], ["(45)", "3.71", "3.71 to 3.71", "(2.14)"]);
        assert_eq!((table.rows[3][1].as_str(), table.rows[3][8].as_str()), ("-", ""));
        let empty = report(false).empty.unwrap().grid();
        let passes: Vec<&str> = empty.rows.iter().map(|row| row[0].as_str()).collect();
        assert_eq!(passes, ["accumulate", "compose", "layer"]);
        let notes = table.notes.join("\n");
        for text in [
            "the view has 1 layer(s): of 4 allowed the device draws 2",
            "of 3 layers has 1000000 bytes of images and buffers, one of 6 1000000: memory does not grow",
            "one of auto:4 has 1000008",
            "the same passes as with one, 1.000 times its frame (95% of the median: 1.000 to 1.000): equal within noise",
        ] {
            assert!(notes.contains(text), "'{text}' is not in\n{notes}");
        }
        let changed = report(true).grid().notes.join("\n");
        assert!(changed.contains("OTHER PASSES") && changed.contains("not equal within noise"), "{changed}");
    }
}
