//! The slides of Guennebaud et al. 2006, "Approximate depth-peeling", results with 2 and with 3 layers.

use glam::{DAffine3, DMat3, DVec3};
use surfel::{
    Result,
    load::builtin::{checkerboard, relief},
    math::srgb::linear_from_srgb,
    scene::{Camera, LastLayer, Object, Scene},
};

use super::{
    easel::Easel,
    glass::{Glass, OFF_TEXT, ball},
    sheet::Sheet,
};

/// Splats of the glass relief.
const SPLATS: usize = 60_000;
const ALPHA: f32 = 0.45;
/// Less than from a surface to the next.
const EPSILON: f64 = 0.12;

/// Draws the figure.
///
/// # Errors
/// As the easel's.
pub fn draw(easel: &mut Easel<'_>) -> Result<Sheet> {
    let camera = Camera {
        eye: DVec3::new(0.1, 0.1, 6.0),
        target: DVec3::new(0.1, 0.1, 0.0),
        up: DVec3::Y,
        fov_y_rad: 24_f64.to_radians(),
        near: None,
    };
    let glass = Glass::new(easel, &scene(), camera, EPSILON)?;
    let mut panels = Vec::new();
    for (layers, first, plus) in [
        (2, "Only the first layer", "Plus a 2nd, blended"),
        (3, "Only the first 2 layers", "Plus a 3rd, blended"),
    ] {
        panels.push(glass.all("Complete depth peeling", "all layers"));
        panels.push(glass.few(easel, first, "what is behind is lost", layers - 1, LastLayer::Drop)?);
        panels.push(glass.few(easel, plus, "it has all that is behind", layers, LastLayer::Blend)?);
    }
    Ok(Sheet {
        title: "Approximate depth peeling (Guennebaud et al. 2006, slides)".to_owned(),
        headings: vec!["Results with 2 layers".to_owned(), "Results with 3 layers".to_owned()],
        columns: 3,
        panels,
        notes: vec![
            OFF_TEXT.to_owned(),
            format!(
                "The built-in relief as glass, {SPLATS} splats of alpha {ALPHA}, with two glass balls in it and one in front, \
                 before an opaque board; not the slides' model. Epsilon is {EPSILON} of the \
                 relief's radius. Shaded with one light at the eye."
            ),
        ],
    })
}

fn scene() -> Scene {
    let mut outer = relief(SPLATS);
    outer.splats.colors.tint(None, ALPHA);
    let color = |srgb: [f32; 3]| srgb.map(linear_from_srgb);
    let balls = [
        ball(8000, DVec3::new(-0.35, 0.1, 0.1), 0.4, color([0.9, 0.15, 0.1]), ALPHA),
        ball(8000, DVec3::new(0.4, -0.25, -0.1), 0.35, color([0.1, 0.25, 0.9]), ALPHA),
        ball(8000, DVec3::new(0.6, 0.6, 1.3), 0.38, color([0.95, 0.85, 0.2]), ALPHA),
    ];
    let mut objects = vec![wall(), outer];
    objects.extend(balls);
    Scene { objects, ..Scene::default() }
}

/// A board behind all.
fn wall() -> Object {
    let Object { name, splats, closed } = checkerboard(120);
    let place = DAffine3 { matrix3: DMat3::from_diagonal(DVec3::splat(0.035)), translation: -1.6 * DVec3::Z };
    Object { name, splats: splats.transformed(&place), closed }
}
