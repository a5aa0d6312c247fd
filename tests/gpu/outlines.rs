//! Outlines of splats: rims that are black and heavy, on the surfaces that are seen, by every way to draw.

use glam::DVec3;
use surfel::{
    hard_scenes::{Hard, builder::Builder},
    renderer::Headless,
    scene::{Edges, Epsilon, Filter, Outlines, Rasterizer, Settings, Shading},
};

use crate::common::{PICTURE, passes, render_as, shared, with};

/// Disks that face the eye: center, radius, linear color.
const DISKS: [([f64; 3], f64, [f32; 3]); 3] = [
    ([-0.3, 0.0, 0.0], 0.6, [0.8, 0.2, 0.1]),
    ([0.25, 0.1, 0.01], 0.5, [0.1, 0.7, 0.3]),
    // Hidden by the others in part: farther away than epsilon.
    ([0.0, -0.3, -0.8], 0.7, [0.2, 0.2, 0.9]),
];

fn disks(rasterizer: Rasterizer, outlines: Outlines) -> Hard {
    let mut builder = Builder::default();
    for (center, radius, [red, green, blue]) in DISKS {
        builder.disk(center.into(), DVec3::Z, radius, [red, green, blue, 1.0]);
    }
    let hard = Hard::seen_from([0.0, 0.0, 3.0], "disks", builder.scene(false));
    with(&hard, |settings| {
        (settings.rasterizer, settings.filter) = (rasterizer, Filter::None);
        (settings.edges, settings.shading) = (Edges::Hard, Shading::Albedo);
        (settings.epsilon, settings.outlines) = (Epsilon::Length(0.1), outlines);
    })
}

/// What a pixel shows, from the definition: the mean of what is on the nearest surface by exp(-2 r²), of which a rim, r² > 0.8, has 32 times as much and is black.
/// `None` next to a border.
fn expected(settings: &Settings, [x, y]: [u32; 2]) -> Option<[f64; 3]> {
    let [width, height] = settings.size_px.map(f64::from);
    let focal = 0.5 * height / (0.5 * 45.0_f64.to_radians()).tan();
    let ray = [(f64::from(x) + 0.5 - 0.5 * width) / focal, -(f64::from(y) + 0.5 - 0.5 * height) / focal];
    let of = |(center, radius, color): ([f64; 3], f64, [f32; 3])| {
        let z = 3.0 - center[2];
        let [u, v] = [0, 1].map(|i| (ray[i] * z - center[i]) / radius);
        (z, u * u + v * v, color)
    };
    let all = DISKS.map(of);
    if all.iter().any(|(_, r2, _)| (r2 - 1.0).abs() < 0.01 || (r2 - 0.8).abs() < 0.01) {
        return None;
    }
    let covering = || all.iter().filter(|(_, r2, _)| *r2 < 1.0);
    let nearest = covering().map(|(z, ..)| *z).fold(f64::INFINITY, f64::min);
    let (mut sum, mut weights) = ([0.0; 3], 0.0);
    for (_, r2, color) in covering().filter(|(z, ..)| *z <= nearest + 0.1) {
        let is_rim = settings.outlines == Outlines::Splats && *r2 > 0.8;
        let weight = (-2.0 * r2).exp() * if is_rim { 32.0 } else { 1.0 };
        weights += weight;
        let lit = if is_rim { 0.0 } else { weight };
        sum = [0, 1, 2].map(|i| sum[i] + lit * f64::from(color[i]));
    }
    Some(if weights > 0.0 { sum.map(|sum| sum / weights) } else { [1.0; 3] })
}

fn worst(headless: &mut Headless, hard: &Hard) -> (f64, usize) {
    let frame = render_as(headless, hard, PICTURE);
    println!("{:?}: {:?}", hard.settings.rasterizer, passes(&frame));
    let [width, height] = hard.settings.size_px;
    let (mut worst, mut black) = (0.0_f64, 0);
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let Some(expected) = expected(&hard.settings, [x, y]) else { continue };
        let found = frame.linear[(y * width + x) as usize];
        black += usize::from(expected.iter().sum::<f64>() < 0.1);
        worst = (0..3).map(|i| (f64::from(found[i]) - expected[i]).abs()).fold(worst, f64::max);
    }
    (worst, black)
}

#[test]
fn rims_are_black_where_the_definition_says_so_by_every_rasterizer() {
    let mut headless = shared();
    for rasterizer in [
        Rasterizer::Perspective,
        Rasterizer::Raycast,
        Rasterizer::Quad,
        Rasterizer::Triangle,
        Rasterizer::AffineCenter,
        Rasterizer::Compute,
    ] {
        for outlines in [Outlines::None, Outlines::Splats] {
            let (worst, black) = worst(&mut headless, &disks(rasterizer, outlines));
            assert!(worst < 1e-3, "{rasterizer:?}, {outlines:?}: {worst}");
            assert_eq!(black > 1000, outlines == Outlines::Splats, "{rasterizer:?}: {black}");
        }
    }
}
