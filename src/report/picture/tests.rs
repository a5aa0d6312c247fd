//! Figures of pictures that are made by hand.

use super::*;
use crate::{reference::TruePixel, scene::DefectCounts};

/// A truth without a surface.
const NOTHING: TruePixel = TruePixel {
    coverage: 0.0,
    albedo: [0.0; 3],
    normal: [0.0; 3],
    depth: f64::INFINITY,
    color: [0.0; 3],
    alpha: 0.0,
    edge: Edge::None,
};

/// Gray that covers so much of a pixel.
fn gray(coverage: f64, value: f64) -> TruePixel {
    TruePixel { coverage, color: [value; 3], depth: 1.0, alpha: 1.0, ..NOTHING }
}

/// One row: eight pixels of a surface, an edge in the eighth, eight of nothing.
fn edge() -> GroundTruth {
    let mut pixels: Vec<TruePixel> = (0..16).map(|i| if i < 8 { gray(1.0, 0.5) } else { NOTHING }).collect();
    pixels[7] = TruePixel { coverage: 0.5, edge: Edge::Outline, ..gray(1.0, 0.5) };
    GroundTruth { size_px: [16, 1], pixels, defects: DefectCounts::default() }
}

/// The truth as a picture.
fn exact(truth: &GroundTruth) -> Vec<[f32; 4]> {
    let rgba = |pixel: &TruePixel| {
        let [red, green, blue] = pixel.color.map(|component| component as f32);
        [red, green, blue, pixel.coverage as f32]
    };
    truth.pixels.iter().map(rgba).collect()
}

fn close(got: f64, expected: f64) {
    assert!((got - expected).abs() <= 1e-6 * expected.abs().max(1.0), "{got}, expected {expected}");
}

#[test]
fn the_truth_has_no_error_against_itself() {
    let error = picture_error(&exact(&edge()), &edge());
    let none = Some(Figures { rms: 0.0, flip: 0.0 });
    for (region, px) in [(error.whole, 10), (error.inside, 5), (error.silhouette, 5)] {
        assert_eq!((region.px, region.over_white, region.over_black), (px, none, none));
    }
    assert_eq!((error.dark_fringe, error.bright_fringe, error.wider_px), (0.0, 0.0, Some(0.0)));
    assert_eq!(error.partial_px, 1);
}

#[test]
fn regions_are_the_truths_alone_and_reach_two_pixels_around() {
    use Region::{Inside, Outside, Silhouette};
    let [inside, band, outside] = [vec![Inside; 5], vec![Silhouette; 5], vec![Outside; 6]];
    assert_eq!(regions(&edge()), [inside, band, outside].concat());
    // Around one pixel: the disk of 13 pixels, at the border what is left of it.
    let single = |at: usize| {
        let mut truth =
            GroundTruth { size_px: [7, 7], pixels: vec![NOTHING; 49], defects: DefectCounts::default() };
        truth.pixels[at].edge = Edge::Jump;
        regions(&truth).iter().filter(|region| **region == Silhouette).count()
    };
    assert_eq!([single(24), single(0), single(6), single(48)], [13, 6, 6, 6]);
}

#[test]
fn a_hard_edge_is_wrong_at_the_silhouette_alone_by_figures_computed_by_hand() {
    let truth = edge();
    let mut picture = exact(&truth);
    // A whole pixel in place of a half: 0.5 in place of 0.75 over white, in place of 0.25 over black.
    picture[7][3] = 1.0;
    let error = picture_error(&picture, &truth);
    close(error.silhouette.rms().unwrap(), (0.25_f64.powi(2) / 5.0).sqrt());
    close(error.whole.rms().unwrap(), (0.25_f64.powi(2) / 10.0).sqrt());
    assert_eq!(error.inside.over_white.unwrap().rms, 0.0);
    // sRGB of 0.5, 0.75 and 0.25 in 255ths.
    let fringes = [error.dark_fringe - (224.610 - 187.516), error.bright_fringe - (187.516 - 136.960)];
    assert!(fringes.iter().all(|difference| difference.abs() < 0.01), "{error:?}");
    close(error.wider_px.unwrap(), 0.5);
    assert_eq!(error.partial_px, 0);
    // The next pixel, too: one and a half pixels too wide, and black.
    picture[8] = [0.0, 0.0, 0.0, 1.0];
    let error = picture_error(&picture, &truth);
    close(error.wider_px.unwrap(), 1.5);
    close(error.dark_fringe, 255.0);
}

#[test]
fn each_background_shows_what_the_other_hides() {
    let truth = edge();
    let mut picture = exact(&truth);
    // Nothing where white is: only black tells.
    let white = GroundTruth {
        pixels: truth.pixels.iter().map(|pixel| TruePixel { color: [1.0; 3], ..*pixel }).collect(),
        ..truth.clone()
    };
    picture.iter_mut().for_each(|pixel| *pixel = [0.0; 4]);
    let error = picture_error(&picture, &white);
    assert_eq!(error.inside.over_white.unwrap(), Figures { rms: 0.0, flip: 0.0 });
    let black = error.inside.over_black.unwrap();
    assert!(black.rms == 1.0 && black.flip > 0.9, "{black:?}");
    assert_eq!((error.inside.rms(), error.inside.flip()), (Some(1.0), Some(black.flip)));
}

#[test]
fn what_is_drawn_far_outside_counts_in_the_whole_and_what_is_no_number_is_the_worst() {
    let truth = edge();
    let mut picture = exact(&truth);
    picture[15] = [0.0, 0.0, 0.0, 1.0];
    let error = picture_error(&picture, &truth);
    assert_eq!((error.whole.px, error.inside.px, error.silhouette.px), (11, 5, 5));
    close(error.whole.rms().unwrap(), (1.0_f64 / 11.0).sqrt());
    assert_eq!(error.silhouette.rms(), Some(0.0));
    picture[8] = [f32::NAN, 0.0, 0.0, 1.0];
    let error = picture_error(&picture, &truth);
    assert_eq!((error.silhouette.rms(), error.dark_fringe), (Some(f64::INFINITY), f64::INFINITY));
    let empty = GroundTruth { size_px: [2, 1], pixels: vec![NOTHING; 2], defects: DefectCounts::default() };
    let error = picture_error(&[[0.0; 4]; 2], &empty);
    assert_eq!((error.whole.px, error.whole.rms(), error.wider_px), (0, None, None));
}
