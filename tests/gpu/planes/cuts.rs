//! Boxes and planes that cut scenes, and what each must agree on with the oracle.

use surfel::{
    renderer::{Frame, Headless},
    scene::{ClipBox, ClipPlanes, Rasterizer},
    selftest::{agreement, tolerance},
};

use crate::common::{moves_corners, oracle_of, render, scenes::Hard, with};

/// A box that cuts a ball around the origin at all of its sides, and planes that cut it aslant.
pub(super) fn cuts() -> [(&'static str, ClipBox, ClipPlanes); 3] {
    let none = ClipPlanes::default();
    [
        ("box", ClipBox(Some([[-0.7, -0.6, -0.8], [0.65, 0.55, 0.75]])), none),
        ("plane", ClipBox(None), ClipPlanes([[1.0, 0.5, 0.3, 0.1]].into())),
        (
            "six planes",
            ClipBox(None),
            ClipPlanes(
                [
                    [1.0, 0.1, 0.2, -0.7],
                    [-1.0, 0.1, 0.3, -0.8],
                    [0.1, 1.0, 0.2, -0.75],
                    [0.1, -2.0, 0.3, -1.3],
                    [0.0, 0.2, 1.0, -0.6],
                    [0.2, 0.1, -1.0, -0.9],
                ]
                .into(),
            ),
        ),
    ]
}

pub(super) fn cut(hard: &Hard, (_, clip_box, clip_planes): &(&str, ClipBox, ClipPlanes)) -> Hard {
    with(hard, |settings| {
        (settings.clip_box, settings.clip_planes) = (*clip_box, clip_planes.clone());
    })
}

fn covered_px(frame: &Frame) -> f64 {
    frame.weight.iter().filter(|weight| **weight > 0.0).count() as f64
}

/// The pixels that are covered where nothing is cut off.
pub(super) fn uncut_px(headless: &mut Headless, hard: &Hard) -> f64 {
    let uncut = with(hard, |settings| {
        (settings.clip_box, settings.clip_planes) = Default::default();
        settings.rasterizer = Rasterizer::Perspective;
    });
    covered_px(&render(headless, &uncut))
}

/// Fails where the surface differs from the oracle's, or more pixels are left than these.
pub(super) fn agrees(headless: &mut Headless, hard: &Hard, cut: &str, most_left_px: f64) {
    let (frame, oracle) = (render(headless, hard), oracle_of(hard));
    let errors = agreement::compare(&frame, &oracle);
    let name = format!("{}, {cut}", hard.name);
    println!("{}", errors.row(&name));
    let beyond = errors.beyond(&tolerance::of(hard).of_at_least(50));
    let is_known = hard.settings.rasterizer == Rasterizer::Triangle && moves_corners(headless.device());
    assert!(beyond.is_empty() || is_known, "{name}, {:?}: {beyond:#?}", hard.settings.rasterizer);
    let left_px = covered_px(&frame);
    assert!(left_px < most_left_px, "{name}: {left_px} of {most_left_px}");
}
