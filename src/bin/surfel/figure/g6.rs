//! Guennebaud et al. 2006, figure 6: 27 transparent balls in few layers.

use glam::DVec3;
use surfel::{
    Result,
    math::srgb::linear_from_srgb,
    scene::{Camera, LastLayer, Object, Scene},
};

use super::{
    easel::Easel,
    glass::{Glass, OFF_TEXT, ball},
    sheet::Sheet,
};

/// Splats of each ball.
const SPLATS: usize = 4000;
const RADIUS: f64 = 0.5;
/// Between the centers of neighbors. From less than 37° off the axis a ray that meets a ball passes its neighbors at the
/// side, so that it meets three at most: six surfaces.
const SPACING: f64 = 1.25;
/// From the back to the front. The blended layer takes the place of several surfaces with their mean opacity, so that it
/// is nearer to the truth than the third surface alone where what is behind is more opaque than that. With 0.4 for all
/// balls its RMS was 12.6, without blending 12.9.
const ALPHAS: [f32; 3] = [0.7, 0.5, 0.3];
/// Less than from a ball to the next.
const EPSILON: f64 = 0.15;

/// Draws the figure.
///
/// # Errors
/// As the easel's.
pub fn draw(easel: &mut Easel<'_>) -> Result<Sheet> {
    let scene = Scene { objects: balls(), ..Scene::default() };
    let camera = Camera {
        eye: DVec3::new(2.3, 1.7, 9.0),
        target: DVec3::new(-0.08, -0.15, 0.0),
        up: DVec3::Y,
        fov_y_rad: 28_f64.to_radians(),
        near: None,
    };
    let glass = Glass::new(easel, &scene, camera, EPSILON)?;
    let [back, middle, front] = ALPHAS;
    let panels = vec![
        glass.few(easel, "a) 6 layers", "as many as surfaces", 6, LastLayer::Drop)?,
        glass.few(easel, "b) 3 layers", "without blending: what is behind is lost", 3, LastLayer::Drop)?,
        glass.few(
            easel,
            "c) 3 layers, the last blended",
            "what is behind is in the third",
            3,
            LastLayer::Blend,
        )?,
        glass.all("All layers, to judge by", "not in the paper's figure"),
    ];
    Ok(Sheet {
        title: "27 transparent balls (Guennebaud et al. 2006, figure 6)".to_owned(),
        headings: Vec::new(),
        columns: 2,
        panels,
        notes: vec![
            OFF_TEXT.to_owned(),
            format!(
                "Balls of {SPLATS} splats and radius {RADIUS}, three behind each other at most; alpha is {front} in the first \
                 row, {middle} in the second, {back} in the last. Epsilon is {EPSILON}, so that what is seen at a rim is one \
                 surface. Shaded with one light at the eye."
            ),
        ],
    })
}

/// On a grid, in colors that follow the place.
fn balls() -> Vec<Object> {
    let mut balls = Vec::new();
    for (z, alpha) in (-1..=1).zip(ALPHAS) {
        for y in -1..=1 {
            for x in -1..=1 {
                let place = [x, y, z].map(f64::from);
                #[expect(clippy::cast_possible_truncation, reason = "a color")]
                let color = place.map(|along| linear_from_srgb(0.6 + 0.35 * along as f32));
                balls.push(ball(SPLATS, SPACING * DVec3::from(place), RADIUS, color, alpha));
            }
        }
    }
    balls
}
