//! Figures of transparent scenes in few layers, and how far that is from all layers.

use glam::{DAffine3, DMat3, DVec3};
use surfel::{
    Result,
    load::builtin::{checkerboard, relief, sphere},
    math::srgb::linear_from_srgb,
    prepare::PreparedScene,
    scene::{Accumulate, Camera, Edges, Epsilon, LastLayer, Layers, Object, Scene, Settings},
};

use super::{
    context::FigureContext,
    raster::Raster,
    sheet::{Panel, Sheet},
};

/// The most layers of "all": twice as many as the figures' scenes have surfaces behind each other.
const ALL_LAYERS: u32 = 16;

/// The color of pixels in which nothing is seen.
const BACKGROUND: [u8; 3] = [255; 3];

/// The note on the differences in the captions.
const OFF_TEXT: &str = "RMS: the root of the mean squared difference to the picture in all layers, in sRGB values from 0 to \
    255, over the pixels in which something is seen.";

/// A scene from where it is seen, with the picture that others are judged by.
struct Glass {
    scene: PreparedScene,
    camera: Camera,
    epsilon: f64,
    all: Raster,
}

impl Glass {
    /// Uploads the scene and draws all of its layers.
    ///
    /// ε is a length in which no two surfaces are behind each other, far larger than splats. With a multiple of their
    /// radius, what is steeper than about 45° would be a surface in many layers: at rims splats that overlap in the
    /// image are further from each other in depth than that, and each layer would add to the opacity.
    fn new(context: &mut FigureContext<'_>, scene: &Scene, camera: Camera, epsilon: f64) -> Result<Self> {
        let scene = context.prepare(scene)?;
        let settings = settings(context.size_px, epsilon, Layers::Auto(ALL_LAYERS), LastLayer::Drop);
        let all = context.picture(&scene, &camera, &settings)?;
        Ok(Self { scene, camera, epsilon, all })
    }

    /// The panel of all layers.
    fn all(&self, name: &str, caption: &str) -> Panel {
        Panel::new(name, caption, self.all.clone())
    }

    /// The panel of so many layers; the caption goes on with how far that is from all.
    fn few(
        &self,
        context: &mut FigureContext<'_>,
        name: &str,
        caption: &str,
        layers: u32,
        last_layer: LastLayer,
    ) -> Result<Panel> {
        let settings = settings(context.size_px, self.epsilon, Layers::Fixed(layers), last_layer);
        let picture = context.picture(&self.scene, &self.camera, &settings)?;
        let caption = format!("{caption}; RMS {:.1}", off(&picture, &self.all));
        Ok(Panel::new(name, caption, picture))
    }
}

fn camera(eye: [f64; 3], target: [f64; 3], fov_y_deg: f64) -> Camera {
    let fov_y_rad = fov_y_deg.to_radians();
    Camera { eye: eye.into(), target: target.into(), up: DVec3::Y, fov_y_rad, ..Camera::default() }
}

fn settings(size_px: [u32; 2], epsilon: f64, layers: Layers, last_layer: LastLayer) -> Settings {
    Settings {
        size_px,
        epsilon: Epsilon::Length(epsilon),
        layers,
        last_layer,
        accumulate: Accumulate::F32,
        // The paper's: what is seen at a rim is one surface.
        edges: Edges::Hard,
        ..Settings::default()
    }
}

/// The root of the mean squared difference of two pictures' sRGB values where either shows something.
fn off(picture: &Raster, all: &Raster) -> f64 {
    let seen = |(a, b): &(&[u8; 3], &[u8; 3])| **a != BACKGROUND || **b != BACKGROUND;
    let (mut sum, mut count) = (0.0, 0.0);
    for (a, b) in picture.pixels.iter().zip(&all.pixels).filter(seen) {
        sum += a.iter().zip(b).map(|(a, b)| f64::from(a.abs_diff(*b)).powi(2)).sum::<f64>();
        count += 3.0;
    }
    (sum / f64::max(count, 1.0)).sqrt()
}

/// A glass ball of one color (linear).
fn ball(splats: usize, center: DVec3, radius: f64, color: [f32; 3], alpha: f32) -> Object {
    let Object { name, splats, closed } = sphere(splats);
    let place = DAffine3 { matrix3: DMat3::from_diagonal(DVec3::splat(radius)), translation: center };
    let mut splats = splats.transformed(&place);
    splats.colors.tint(Some(color), alpha);
    Object { name, splats, closed }
}

/// Splats of each ball.
const BALL_SPLATS: usize = 4000;
const BALL_RADIUS: f64 = 0.5;
/// The distance between the centers of neighbors. From less than 37° off the axis a ray that meets a ball passes its neighbors at the
/// side, so that it meets three at most: six surfaces.
const BALL_SPACING: f64 = 1.25;
/// Alphas from the back to the front. The blended layer takes the place of several surfaces with their mean opacity, so that it
/// is nearer to the truth than the third surface alone where what is behind is more opaque than that. With 0.4 for all
/// balls its RMS was 12.6, without blending 12.9.
const ALPHAS: [f32; 3] = [0.7, 0.5, 0.3];
/// The depth of a surface: less than from a ball to the next.
const BALL_EPSILON: f64 = 0.15;

/// Guennebaud et al. 2006, figure 6: 27 transparent balls in few layers.
pub fn g6(context: &mut FigureContext<'_>) -> Result<Sheet> {
    let scene = Scene { objects: balls(), ..Scene::default() };
    let camera = camera([2.3, 1.7, 9.0], [-0.08, -0.15, 0.0], 28.0);
    let glass = Glass::new(context, &scene, camera, BALL_EPSILON)?;
    let [back, middle, front] = ALPHAS;
    let panels = vec![
        glass.few(context, "a) 6 layers", "as many as surfaces", 6, LastLayer::Drop)?,
        glass.few(context, "b) 3 layers", "without blending: what is behind is lost", 3, LastLayer::Drop)?,
        glass.few(
            context,
            "c) 3 layers, the last blended",
            "what is behind is in the third",
            3,
            LastLayer::Blend,
        )?,
        glass.all("All layers, to judge by", "not in the paper's figure"),
    ];
    let text = format!(
        "Balls of {BALL_SPLATS} splats and radius {BALL_RADIUS}, three behind each other at most; alpha is {front} in the first \
         row, {middle} in the second, {back} in the last. Epsilon is {BALL_EPSILON}, so that what is seen at a rim is one \
         surface. Shaded with one light at the eye."
    );
    let title = "27 transparent balls (Guennebaud et al. 2006, figure 6)";
    Ok(Sheet::new(title, 2, panels, &[OFF_TEXT, &text]))
}

/// On a grid, in colors that follow the place.
fn balls() -> Vec<Object> {
    let mut balls = Vec::new();
    for (z, alpha) in (-1..=1).zip(ALPHAS) {
        for y in -1..=1 {
            for x in -1..=1 {
                let place = [x, y, z].map(f64::from);
                let color = place.map(|along| linear_from_srgb(0.6 + 0.35 * along as f32));
                balls.push(ball(BALL_SPLATS, BALL_SPACING * DVec3::from(place), BALL_RADIUS, color, alpha));
            }
        }
    }
    balls
}

/// Splats of the glass relief.
const RELIEF_SPLATS: usize = 60_000;
const RELIEF_ALPHA: f32 = 0.45;
/// The depth of a surface: less than from one to the next.
const RELIEF_EPSILON: f64 = 0.12;

/// The slides of Guennebaud et al. 2006, "Approximate depth-peeling": results with 2 and with 3 layers.
pub fn slides(context: &mut FigureContext<'_>) -> Result<Sheet> {
    let camera = camera([0.1, 0.1, 6.0], [0.1, 0.1, 0.0], 24.0);
    let glass = Glass::new(context, &relief_and_balls(), camera, RELIEF_EPSILON)?;
    let mut panels = Vec::new();
    for (layers, first, plus) in [
        (2, "Only the first layer", "Plus a 2nd, blended"),
        (3, "Only the first 2 layers", "Plus a 3rd, blended"),
    ] {
        panels.push(glass.all("Complete depth peeling", "all layers"));
        panels.push(glass.few(context, first, "what is behind is lost", layers - 1, LastLayer::Drop)?);
        panels.push(glass.few(context, plus, "it has all that is behind", layers, LastLayer::Blend)?);
    }
    let text = format!(
        "The built-in relief as glass, {RELIEF_SPLATS} splats of alpha {RELIEF_ALPHA}, with two glass balls in it and one in front, \
         before an opaque board; not the slides' model. Epsilon is {RELIEF_EPSILON} of the \
         relief's radius. Shaded with one light at the eye."
    );
    let headings = ["Results with 2 layers", "Results with 3 layers"].map(str::to_owned).to_vec();
    let title = "Approximate depth peeling (Guennebaud et al. 2006, slides)";
    Ok(Sheet { headings, ..Sheet::new(title, 3, panels, &[OFF_TEXT, &text]) })
}

fn relief_and_balls() -> Scene {
    let mut outer = relief(RELIEF_SPLATS);
    outer.splats.colors.tint(None, RELIEF_ALPHA);
    let color = |srgb: [f32; 3]| srgb.map(linear_from_srgb);
    let balls = [
        ball(8000, DVec3::new(-0.35, 0.1, 0.1), 0.4, color([0.9, 0.15, 0.1]), RELIEF_ALPHA),
        ball(8000, DVec3::new(0.4, -0.25, -0.1), 0.35, color([0.1, 0.25, 0.9]), RELIEF_ALPHA),
        ball(8000, DVec3::new(0.6, 0.6, 1.3), 0.38, color([0.95, 0.85, 0.2]), RELIEF_ALPHA),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_count_where_something_is_seen() {
        let raster = |pixels: [[u8; 3]; 3]| Raster { size_px: [3, 1], pixels: pixels.to_vec() };
        let all = raster([[255; 3], [10, 20, 30], [0; 3]]);
        assert_eq!(off(&all, &all), 0.0);
        // 12² over the 6 values of two pixels.
        assert!((off(&raster([[255; 3], [10, 32, 30], [0; 3]]), &all) - 24_f64.sqrt()).abs() < 1e-12);
        assert_eq!(off(&raster([[255; 3]; 3]), &raster([[255; 3]; 3])), 0.0);
    }
}
