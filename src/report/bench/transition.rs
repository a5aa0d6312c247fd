//! The cost of the transition between splats and polygons (Guennebaud, Barthe, Paulin 2006, sections 5 and 7): the same half and
//! half with each, beside the whole as splats and as polygons.

use serde::Serialize;

use super::{
    Measurement,
    gate::GateFigure,
    measurement::{is_equal, with_costs},
};
use crate::report::{
    FrameTimes, Grid, Spread,
    cells::{NONE, interval, median, number},
};

/// `bench transition`.
#[derive(Clone, Debug, Serialize)]
pub struct TransitionReport {
    /// The model.
    pub model: String,
    /// The contestants, timed in turn, the one without a transition first.
    pub contestants: Vec<Measurement<HalfAndHalf>>,
    /// The floor's frames: the points of the whole as splats into the same formats with nothing computed.
    pub floor: FrameTimes,
}

/// The primitives that a contestant draws.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct HalfAndHalf {
    /// How many of both.
    pub drawn: Primitives,
}

/// How many splats and triangles are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Primitives {
    /// Splats, before those are culled that face away.
    pub splats: u64,
    /// Triangles, before the same.
    pub triangles: u64,
    /// Both, with a transition: it is equal to none or not. The pure representations are other scenes.
    pub transition: bool,
}

impl TransitionReport {
    /// How many times the frame without a transition those with one take.
    pub fn ratios(&self) -> impl Iterator<Item = Option<Spread>> {
        let with = self.contestants.iter().filter(|own| own.subject.drawn.transition);
        with.map(|own| own.beside_first)
    }

    /// The figures by which it is judged.
    pub fn gate(&self) -> Vec<GateFigure> {
        self.contestants.iter().flat_map(|own| own.gate("transition")).collect()
    }

    /// The table.
    pub fn grid(&self) -> Grid {
        let equal = |own: &Measurement<HalfAndHalf>| match is_equal(own.beside_first.as_ref()) {
            _ if !own.subject.drawn.transition => NONE,
            Some(true) => "yes",
            Some(false) => "no",
            None => "uncertain",
        };
        let table = Grid::of(format!("transition, {}", self.model), &self.contestants)
            .column("method", |own| own.name.clone())
            .column("splats", |own| own.subject.drawn.splats)
            .column("triangles", |own| own.subject.drawn.triangles)
            .column("frame ms", |own| median(own.frames.frame_ms, 2))
            .column("95% of the median", |own| interval(own.frames.frame_ms, 2))
            .column("fps", |own| number(own.fps, 2))
            .column("x none", |own| median(own.beside_first, 3))
            .column("95% of the median", |own| interval(own.beside_first, 3))
            .column("equal to none", equal);
        with_costs(table)
            .note(
                "medians; x none: of each round; equal to none: the interval of x none holds 1 and is narrow, as the paper has it \
                 (section 7); x floor: beside the points of the whole as splats",
            )
            .grid()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::timed::tests::timed;

    #[test]
    fn transitions_are_equal_to_none_or_not_and_other_scenes_are_neither() {
        let of = |costs: [f64; 2]| timed(&["accumulate", "finalize"], &costs, &[], 1_500_000);
        let contestant = |name: &str, costs, [splats, triangles]: [u64; 2], transition| {
            let drawn = Primitives { splats, triangles, transition };
            (name.to_owned(), HalfAndHalf { drawn }, of(costs))
        };
        let contestants = vec![
            contestant("none", [3.0, 1.0], [10, 20], false),
            contestant("color", [3.0, 1.0], [10, 20], true),
            contestant("paper", [5.0, 1.0], [10, 20], true),
            contestant("all splats", [2.0, 1.0], [20, 0], false),
        ];
        let floor = of([1.0, 1.0]);
        let report = TransitionReport {
            model: "ball".to_owned(),
            contestants: Measurement::all(contestants, Some(&floor)),
            floor: floor.times(),
        };
        assert_eq!(report.ratios().collect::<Vec<_>>(), [Spread::of([1.0; 6]), Spread::of([1.5; 6])]);
        let grid = report.grid();
        let column = |i: usize| grid.rows.iter().map(|row| row[i].as_str()).collect::<Vec<_>>();
        assert_eq!(column(6), ["1.000", "1.000", "1.500", "0.750"]);
        assert_eq!(column(8), ["-", "yes", "no", "-"]);
        assert_eq!(column(9), ["2.00", "2.00", "3.00", "1.50"]);
        assert_eq!(grid.rows[0][1..3], ["10", "20"]);
        // A time and the bytes of each: nothing was counted.
        assert_eq!(report.gate().len(), 8);
    }
}
