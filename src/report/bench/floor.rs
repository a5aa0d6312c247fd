//! A frame's passes against the floor under the three of points; see [`crate::passes::floor_frame`].

use serde::Serialize;

use super::{
    LimitsReport,
    gate::{GateFigure, GateKind},
};
use crate::report::{
    CameraReport, Grid, SceneReport, Spread,
    cells::{figure, median},
    timed::floor_pass,
};

/// How many times the floor a pass, or the frame, takes.
#[derive(Clone, Debug, Serialize)]
pub struct FloorReport {
    /// The camera.
    pub camera: CameraReport,
    /// The scene.
    pub scene: SceneReport,
    /// Points of the floor: all splats, those that are not drawn outside of the clip volume.
    pub floor_points: u64,
    /// Points of the strict floor: only the splats that are drawn.
    pub strict_points: u64,
    /// Rounds of a frame, its floor and its strict floor, in turn.
    pub rounds: u32,
    /// Each pass, then the frame.
    pub rows: Vec<FloorRow>,
    /// How far each pass is from what the device can do.
    pub limits: LimitsReport,
}

/// A pass or the whole frame against its floor.
#[derive(Clone, Debug, Serialize)]
pub struct FloorRow {
    /// The pass; `frame` for all of them.
    pub name: String,
    /// Its milliseconds.
    pub ms: Option<Spread>,
    /// The floor's.
    pub floor_ms: Option<Spread>,
    /// The strict floor's.
    pub strict_floor_ms: Option<Spread>,
    /// Times the floor, round by round.
    pub ratio: Option<Spread>,
    /// Times the strict floor, round by round.
    pub strict_ratio: Option<Spread>,
    /// Fragments in one frame; `None` where not counted.
    pub fragments: Option<u64>,
    /// The floor's fragments in one frame.
    pub floor_fragments: Option<u64>,
}

/// Milliseconds of one round.
#[derive(Clone, Debug, Default)]
pub struct FloorRound {
    /// The times of the passes, in order: the frame's, its floor's, its strict floor's.
    pub passes_ms: [Vec<f64>; 3],
    /// The time of each limit's measurement.
    pub limits_ms: Vec<Option<f64>>,
}

/// The floor's passes, in their order.
const FLOOR_PASSES: [&str; 3] = ["floor depth", "floor add", "floor fill"];

impl FloorRow {
    /// The rows of all passes and of the frame. `fragments` are those of frame and floor, pass by pass.
    pub fn rows(names: &[String], rounds: &[FloorRound], fragments: [&[Option<u64>]; 2]) -> Vec<Self> {
        let pass = |(i, name): (usize, &String)| {
            // Further passes, such as that of the kernel's texture, have no floor.
            let floor = FLOOR_PASSES.iter().position(|pass| Some(*pass) == floor_pass(name));
            let places = [Some(i), floor, floor];
            let ms = |kind: usize, round: &FloorRound| round.passes_ms[kind].get(places[kind]?).copied();
            let count = |kind: usize| fragments[kind].get(places[kind]?).copied().flatten();
            Self::of(name, rounds, &ms, [count(0), count(1)])
        };
        let sum = |kind: usize, round: &FloorRound| Some(round.passes_ms[kind].iter().sum());
        let counts = fragments.map(|passes| passes.iter().copied().sum());
        let frame = Self::of("frame", rounds, &sum, counts);
        names.iter().enumerate().map(pass).chain([frame]).collect()
    }

    /// A row of the figures of a frame and its two floors.
    fn of(
        name: &str,
        rounds: &[FloorRound],
        ms: &dyn Fn(usize, &FloorRound) -> Option<f64>,
        [fragments, floor_fragments]: [Option<u64>; 2],
    ) -> Self {
        let spread = |kind: usize| Spread::of(rounds.iter().filter_map(|round| ms(kind, round)));
        let over =
            |kind: usize, round: &FloorRound| Some(ms(0, round)? / ms(kind, round).filter(|ms| *ms > 0.0)?);
        let ratio = |kind: usize| Spread::of(rounds.iter().filter_map(|round| over(kind, round)));
        Self {
            name: name.to_owned(),
            ms: spread(0),
            floor_ms: spread(1),
            strict_floor_ms: spread(2),
            ratio: ratio(1),
            strict_ratio: ratio(2),
            fragments,
            floor_fragments,
        }
    }
}

impl FloorReport {
    /// The table.
    pub fn grid(&self) -> Grid {
        let title = format!(
            "floor: {} splats; the floor draws {} points, the strict floor the {} that are seen",
            self.scene.splats, self.floor_points, self.strict_points
        );
        Grid::of(title, &self.rows)
            .column("", |row| row.name.clone())
            .column("ms", |row| median(row.ms, 1))
            .column("floor", |row| median(row.floor_ms, 1))
            .column("strict", |row| median(row.strict_floor_ms, 1))
            .column("x floor", |row| median(row.ratio, 2))
            .column("x strict", |row| median(row.strict_ratio, 2))
            .column("fragments", |row| figure(row.fragments))
            .column("floor's", |row| figure(row.floor_fragments))
            .note("medians; a ratio is the median of the rounds' own ratios")
            .with_notes(self.notes())
    }

    /// How the fragments are to be read where a driver shades fewer than are drawn.
    fn notes(&self) -> Vec<String> {
        let is_unknown = |row: &FloorRow| row.floor_ms.is_some() && row.floor_fragments.is_none();
        let is_unknown = |row: &FloorRow| row.fragments.is_some() && is_unknown(row);
        let counts = |row: &FloorRow| row.fragments.zip(row.floor_fragments);
        let differ = |row: &FloorRow| counts(row).is_some_and(|(own, floor)| own != floor);
        let notes = [
            (
                self.rows.iter().any(is_unknown),
                "the driver counts no fragments of a shader that does nothing",
            ),
            (
                self.rows.iter().any(differ),
                "fragments that fail an early depth test are not shaded, nor counted",
            ),
        ];
        notes.into_iter().filter(|(holds, _)| *holds).map(|(_, note)| note.to_owned()).collect()
    }

    /// The figures by which it is judged.
    pub fn gate(&self) -> Vec<GateFigure> {
        let of = |row: &FloorRow| {
            let name = |what: &str| format!("floor, {}, {what}", row.name);
            let work = GateFigure::count(name("fragments"), GateKind::Work, row.fragments);
            [GateFigure::time(name("x floor"), row.ratio.as_ref()), work]
        };
        self.rows.iter().flat_map(of).flatten().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratios_are_taken_round_by_round() {
        // A machine that slows down threefold between the rounds changes no ratio.
        let round = |passes_ms| FloorRound { passes_ms, limits_ms: Vec::new() };
        let rounds = [
            round([vec![2.0, 4.0], vec![1.0, 4.0], vec![1.0, 2.0]]),
            round([vec![6.0, 12.0], vec![3.0, 12.0], vec![3.0, 6.0]]),
        ];
        let names = ["visibility".to_owned(), "accumulate".to_owned()];
        let rows = FloorRow::rows(&names, &rounds, [&[Some(5), Some(7)], &[Some(5), None]]);
        let same = |value| Spread::of([value; 2]);
        assert_eq!((rows[0].ratio, rows[1].ratio, rows[2].ratio), (same(2.0), same(1.0), same(6.0 / 5.0)));
        assert_eq!(rows[2].strict_ratio, same(2.0));
        assert_eq!((rows[2].fragments, rows[2].floor_fragments), (Some(12), None));
        assert_eq!(rows[2].name, "frame");

        // A pass without a floor takes none from the others.
        let rounds = [round([vec![9.0, 2.0, 4.0], vec![1.0, 4.0], vec![1.0, 2.0]])];
        let names = ["kernel texture", "visibility", "accumulate"].map(str::to_owned);
        let rows = FloorRow::rows(&names, &rounds, [&[Some(1), Some(5), Some(7)], &[Some(5), Some(7)]]);
        assert_eq!((rows[0].ratio, rows[0].floor_fragments), (None, None));
        assert_eq!((rows[1].ratio, rows[2].ratio), (Spread::of([2.0]), Spread::of([1.0])));
        assert_eq!(rows[2].floor_fragments, Some(7));
    }
}
