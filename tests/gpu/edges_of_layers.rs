//! Transparent layers that cover pixels in part: both sides of a closed thing end at one outline.

use glam::DVec3;
use surfel::{
    renderer::Headless,
    scene::{Camera, LastLayer, Layers, Scene},
    selftest::{light::compare_light, tolerance::LIGHT},
};

use crate::{
    common::{
        PICTURE, builder, oracle_of, passes, render_as,
        scenes::{self, Hard, transparent},
        shared, with,
    },
    edges::covering,
};

const ALPHA: f32 = 0.5;
const ALPHA_OF_SHEETS: f32 = 0.3;

/// A ball behind so many sheets that cover all of the image, none of which ends.
fn ball_behind(sheets: u32, count: usize, alpha: f32, camera: Camera) -> Hard {
    let mut objects = vec![transparent::tinted(scenes::sphere(count, DVec3::ZERO), [0.8, 0.3, 0.1, alpha])];
    for number in 1..=sheets {
        let mut sheet = builder::Builder::default();
        for (x, y) in (-12..=12).flat_map(|x| (-12..=12).map(move |y| (f64::from(x), f64::from(y)))) {
            let place = DVec3::new(0.2 * x, 0.2 * y, 0.8 + 0.9 * f64::from(number));
            sheet.disk(place, DVec3::Z, 0.3, [0.2, 0.3, 0.8, ALPHA_OF_SHEETS]);
        }
        objects.push(sheet.object(false));
    }
    let scene = Scene { objects, ..Scene::default() };
    // Of 40 layers each dispatch has four, so that both sides of a ball behind three sheets are of two.
    let hard = with(&Hard::seen_from([0.0; 3], "a ball behind sheets", scene), |settings| {
        (settings.layers, settings.last_layer) = (Layers::Fixed(40), LastLayer::Drop);
        settings.size_px = [128, 128];
    });
    covering(Hard { camera, ..hard })
}

/// How far opacities are off those of a ball of two sides, each of which covers what an opaque one does: the root of the mean square
/// over all pixels that it covers in part.
fn off_at_the_outline(headless: &mut Headless, [clear, opaque]: [&Hard; 2], sheets: i32) -> f32 {
    let [clear, opaque] = [clear, opaque].map(|hard| render_as(headless, hard, PICTURE).linear);
    let before = (1.0 - ALPHA_OF_SHEETS).powi(sheets);
    let of_both = 1.0 - (1.0 - ALPHA).powi(2);
    let squares: Vec<f32> = clear
        .iter()
        .zip(&opaque)
        .filter(|(_, ball)| ball[3] > 0.02 && ball[3] < 0.98)
        .map(|(seen, ball)| (seen[3] - (1.0 - before * (1.0 - of_both * ball[3]))).powi(2))
        .collect();
    assert!(squares.len() >= 40, "{}", squares.len());
    (squares.iter().sum::<f32>() / squares.len() as f32).sqrt()
}

/// Were they independent of each other, that would be 0.045: where each covers a half, 7/16 of the light in place of 3/8.
#[test]
fn the_far_side_of_a_ball_lies_behind_the_near_one_where_both_end() {
    let mut headless = shared();
    let near = builder::camera([0.0, 0.0, 6.0], [0.0; 3]);
    let far = builder::camera([0.0, 0.0, 900.0], [0.0; 3]);
    let far = Camera { fov_y_rad: 0.03, ..far };
    let mut off_by = Vec::new();
    for (count, sheets, camera) in [(2000, 0, near), (2000, 1, near), (2000, 3, near), (560_000, 0, far)] {
        let clear = ball_behind(sheets, count, ALPHA, camera);
        let opaque = ball_behind(0, count.min(4000), 1.0, camera);
        let off = off_at_the_outline(&mut headless, [&clear, &opaque], sheets as i32);
        println!("{count} disks behind {sheets} sheets: {off}");
        off_by.push(off);
        if count > 2000 {
            let frame = render_as(&mut headless, &clear, PICTURE);
            assert!(passes(&frame).contains(&"layers of overflow tiles"), "{:?}", passes(&frame));
        }
    }
    // Disks that are some pixels large have own parts, which add up otherwise in a layer of one side.
    assert!(off_by.iter().zip([0.014, 0.01, 0.006, 0.016]).all(|(off, most)| *off < most), "{off_by:?}");
}

#[test]
fn layers_of_several_dispatches_agree_with_the_oracle() {
    let mut headless = shared();
    let hard = ball_behind(3, 2000, ALPHA, builder::camera([0.3, 0.2, 6.0], [0.0; 3]));
    let errors = compare_light(&render_as(&mut headless, &hard, PICTURE), &oracle_of(&hard));
    println!("{}", errors.row(hard.name));
    assert!(errors.worst <= LIGHT && errors.not_finite == 0, "{errors:?}");
    assert!(errors.seen >= 1_000 && errors.compared >= 10_000, "{errors:?}");
}
