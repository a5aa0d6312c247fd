//! A frame's passes against the floor under the three of points; see [`crate::passes::floor_frame`].

use serde::Serialize;

use super::{
    CameraReport, LimitsReport, SceneReport, Spread,
    grid::{Grid, cell, count_cell},
    throughput::floor_pass,
};

/// How many times the floor a pass, or the frame, takes.
#[derive(Clone, Debug, Serialize)]
pub struct FloorReport {
    /// The camera.
    pub camera: CameraReport,
    /// What was drawn.
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

/// Milliseconds of the passes of one round, in order: the frame's, its floor's, its strict floor's.
pub type Round = [Vec<f64>; 3];

impl FloorRow {
    /// The rows of all passes and of the frame. `fragments` are those of frame and floor, pass by pass.
    pub fn rows(names: &[String], rounds: &[Round], fragments: [&[Option<u64>]; 2]) -> Vec<Self> {
        type Figure<'f> = &'f dyn Fn(&[f64]) -> Option<f64>;
        // The frame's own figure, and that of both floors.
        let row = |name: &str, [own, floor]: [Figure<'_>; 2], counts: [Option<u64>; 2]| {
            let of = |kind: usize, figure: Figure<'_>| {
                let all: Vec<f64> = rounds.iter().filter_map(|round| figure(&round[kind])).collect();
                Spread::of(all)
            };
            let ratio = |kind: usize| {
                let ratios = rounds.iter().filter_map(|round| {
                    let floor_ms = floor(&round[kind]).filter(|ms| *ms > 0.0)?;
                    Some(own(&round[0])? / floor_ms)
                });
                Spread::of(ratios)
            };
            Self {
                name: name.to_owned(),
                ms: of(0, own),
                floor_ms: of(1, floor),
                strict_floor_ms: of(2, floor),
                ratio: ratio(1),
                strict_ratio: ratio(2),
                fragments: counts[0],
                floor_fragments: counts[1],
            }
        };
        let mut rows: Vec<_> = names
            .iter()
            .enumerate()
            .map(|(i, name)| {
                // Further passes, such as that of the kernel's texture, have no floor.
                let place = FLOOR_PASSES.iter().position(|pass| Some(*pass) == floor_pass(name));
                let counts = [
                    fragments[0].get(i).copied().flatten(),
                    place.and_then(|place| fragments[1].get(place).copied().flatten()),
                ];
                row(name, [&|ms| ms.get(i).copied(), &|ms| ms.get(place?).copied()], counts)
            })
            .collect();
        let total = |kind: usize| fragments[kind].iter().copied().sum();
        let sum = |ms: &[f64]| Some(ms.iter().sum());
        rows.push(row("frame", [&sum; 2], [total(0), total(1)]));
        rows
    }
}

/// The floor's passes, in their order.
const FLOOR_PASSES: [&str; 3] = ["floor depth", "floor add", "floor fill"];

impl FloorReport {
    /// The table.
    pub fn grid(&self) -> Grid {
        let title = format!(
            "floor: {} splats; the floor draws {} points, the strict floor the {} that are seen",
            self.scene.splats, self.floor_points, self.strict_points
        );
        let head = ["", "ms", "floor", "strict", "x floor", "x strict", "fragments", "floor's"];
        let mut grid = Grid::new(title, &head);
        for row in &self.rows {
            let median =
                |spread: &Option<Spread>, decimals| cell(spread.map(|spread| spread.median), decimals);
            grid.row([
                row.name.clone(),
                median(&row.ms, 1),
                median(&row.floor_ms, 1),
                median(&row.strict_floor_ms, 1),
                median(&row.ratio, 2),
                median(&row.strict_ratio, 2),
                count_cell(row.fragments),
                count_cell(row.floor_fragments),
            ]);
        }
        grid.notes.push("medians; a ratio is the median of the rounds' own ratios".to_owned());
        grid
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratios_are_taken_round_by_round() {
        // A machine that slows down threefold between the rounds changes no ratio.
        let rounds = [
            [vec![2.0, 4.0], vec![1.0, 4.0], vec![1.0, 2.0]],
            [vec![6.0, 12.0], vec![3.0, 12.0], vec![3.0, 6.0]],
        ];
        let names = ["visibility".to_owned(), "accumulate".to_owned()];
        let rows = FloorRow::rows(&names, &rounds, [&[Some(5), Some(7)], &[Some(5), None]]);
        let same = |value| Spread::of([value; 2]);
        assert_eq!((rows[0].ratio, rows[1].ratio, rows[2].ratio), (same(2.0), same(1.0), same(6.0 / 5.0)));
        assert_eq!(rows[2].strict_ratio, same(2.0));
        assert_eq!((rows[2].fragments, rows[2].floor_fragments), (Some(12), None));
        assert_eq!(rows[2].name, "frame");

        // A pass without a floor takes none from the others.
        let rounds = [[vec![9.0, 2.0, 4.0], vec![1.0, 4.0], vec![1.0, 2.0]]];
        let names = ["kernel texture", "visibility", "accumulate"].map(str::to_owned);
        let rows = FloorRow::rows(&names, &rounds, [&[Some(1), Some(5), Some(7)], &[Some(5), Some(7)]]);
        assert_eq!((rows[0].ratio, rows[0].floor_fragments), (None, None));
        assert_eq!((rows[1].ratio, rows[2].ratio), (Spread::of([2.0]), Spread::of([1.0])));
        assert_eq!(rows[2].floor_fragments, Some(7));
    }
}
