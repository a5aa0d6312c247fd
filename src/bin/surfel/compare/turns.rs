//! Times the methods in turn.

use surfel::{
    Result,
    renderer::Headless,
    report::{
        FrameTimes,
        compare::{ErrorFigures, Method},
    },
    scene::Settings,
};

use super::Stage;
use crate::turns::{self, UNTIMED_A_TURN};

/// Times `frames` frames of each method and counts the fragments of one more.
pub fn take(
    headless: &mut Headless,
    stage: &Stage<'_>,
    base: &Settings,
    methods: &[(Method, [ErrorFigures; 2])],
    frames: u32,
) -> Vec<Result<FrameTimes>> {
    let contestants = methods
        .iter()
        .map(|(method, _)| turns::frames(stage.prepared, stage.camera, method.settings(base)))
        .collect();
    let timed = turns::take(headless, contestants, frames, "frames of all methods", stage.bars, &mut || {});
    let times = |timed: Result<turns::Timed>| {
        timed.map(|timed| FrameTimes::of(&timed.names, UNTIMED_A_TURN, &timed.samples(), &timed.counts))
    };
    timed.into_iter().map(times).collect()
}
