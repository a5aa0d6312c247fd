//! What the transition between splats and polygons costs (Guennebaud, Barthe, Paulin 2006, sections 5 and 7): the same half and
//! half with each, beside the whole as splats and as polygons.

use serde::Serialize;

use super::{
    Contestant, FrameTimes, Measured, Spread,
    contest::{interval_cell, is_equal},
    gate::GateFigure,
    grid::{Grid, NONE, cell},
};

/// `bench transition`.
#[derive(Clone, Debug, Serialize)]
pub struct TransitionReport {
    /// The model.
    pub model: String,
    /// The contestants, timed in turn, the one without a transition first.
    pub contestants: Vec<TransitionContestant>,
    /// The floor's frames: the points of the whole as splats into the same formats with nothing computed.
    pub floor: FrameTimes,
}

/// A way to draw the model.
#[derive(Clone, Debug, Serialize)]
pub struct TransitionContestant {
    /// What was measured; beside the first is beside no transition.
    #[serde(flatten)]
    pub contestant: Contestant,
    /// What is drawn.
    pub drawn: Drawn,
}

/// How many splats and triangles a contestant draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Drawn {
    /// Splats, before those are culled that face away.
    pub splats: u64,
    /// Triangles, before the same.
    pub triangles: u64,
    /// Both, with a transition: it is equal to none or not. The pure representations are other scenes.
    pub transition: bool,
}

impl TransitionReport {
    /// Of contestants measured in turn with a floor; with each what it draws, and the bytes of its frame's own images and
    /// buffers.
    pub fn of(
        model: String,
        measured: &[Measured<'_>],
        drawn: &[(Drawn, u64)],
        floor: &Measured<'_>,
    ) -> Self {
        let bytes: Vec<u64> = drawn.iter().map(|(_, bytes)| *bytes).collect();
        let contestants = Contestant::all(measured, &bytes, floor);
        let with = |(contestant, (drawn, _)): (Contestant, &(Drawn, u64))| TransitionContestant {
            contestant,
            drawn: *drawn,
        };
        let contestants = contestants.into_iter().zip(drawn).map(with).collect();
        Self { model, contestants, floor: floor.times() }
    }

    /// How many times the frame without a transition those with one take.
    pub fn ratios(&self) -> impl Iterator<Item = Option<Spread>> {
        let with = self.contestants.iter().filter(|contestant| contestant.drawn.transition);
        with.map(|contestant| contestant.contestant.beside_first)
    }

    /// The figures by which it is judged.
    pub fn gate(&self) -> Vec<GateFigure> {
        self.contestants.iter().flat_map(|contestant| contestant.contestant.gate("transition")).collect()
    }

    /// The table.
    pub fn grid(&self) -> Grid {
        let head = [
            "method",
            "splats",
            "triangles",
            "frame ms",
            "95% of the median",
            "fps",
            "x none",
            "95% of the median",
            "equal to none",
            "x floor",
            "MB",
            "record ms",
        ];
        let mut grid = Grid::new(format!("transition, {}", self.model), &head);
        for TransitionContestant { contestant: own, drawn } in &self.contestants {
            let [ms, interval] = own.ms_cells();
            let [floor, mega, record] = own.last_cells();
            let equal = match is_equal(own.beside_first.as_ref()) {
                _ if !drawn.transition => NONE,
                Some(true) => "yes",
                Some(false) => "no",
                None => "uncertain",
            };
            grid.row([
                own.name.clone(),
                drawn.splats.to_string(),
                drawn.triangles.to_string(),
                ms,
                interval,
                cell(own.fps, 2),
                cell(own.beside_first.map(|ratio| ratio.median), 3),
                interval_cell(own.beside_first.as_ref(), 3),
                equal.to_owned(),
                floor,
                mega,
                record,
            ]);
        }
        grid.notes.push(
            "medians; x none: of each round; equal to none: the interval of x none holds 1 and is narrow, as the paper has it \
             (section 7); x floor: beside the points of the whole as splats"
                .to_owned(),
        );
        grid
    }
}

#[cfg(test)]
mod tests {
    use super::{
        super::contest::tests::{measured, rounds},
        *,
    };

    #[test]
    fn transitions_are_equal_to_none_or_not_and_other_scenes_are_neither() {
        let passes = ["accumulate", "finalize"].map(str::to_owned);
        let costs = [[3.0, 1.0], [3.0, 1.0], [5.0, 1.0], [2.0, 1.0], [1.0, 1.0]];
        let all = costs.map(|ms| rounds(&ms));
        let names = ["none", "color", "paper", "all splats", "floor"];
        let entries: Vec<_> = (0..5).map(|i| measured(names[i], &passes, &all[i], &[])).collect();
        let (floor, entries) = entries.split_last().unwrap();
        let drawn = |splats, triangles, transition| (Drawn { splats, triangles, transition }, 1_500_000);
        let half = |transition| drawn(10, 20, transition);
        let all = [half(false), half(true), half(true), drawn(20, 0, false)];
        let report = TransitionReport::of("ball".to_owned(), entries, &all, floor);
        assert_eq!(report.ratios().collect::<Vec<_>>(), [Spread::of([1.0; 6]), Spread::of([1.5; 6])]);
        let grid = report.grid();
        assert!(grid.rows.iter().all(|row| row.len() == grid.head.len()));
        let column = |i: usize| grid.rows.iter().map(|row| row[i].as_str()).collect::<Vec<_>>();
        assert_eq!(column(6), ["1.000", "1.000", "1.500", "0.750"]);
        assert_eq!(column(8), ["-", "yes", "no", "-"]);
        assert_eq!(column(9), ["2.00", "2.00", "3.00", "1.50"]);
        assert_eq!(grid.rows[0][1..3], ["10", "20"]);
        // A time and the bytes of each: nothing was counted.
        assert_eq!(report.gate().len(), 8);
    }
}
