//! A transparent scene in few layers, and how far that is from all layers.

use glam::{DAffine3, DMat3, DVec3};
use surfel::{
    Result,
    load::builtin::sphere,
    prepare::PreparedScene,
    scene::{Accumulate, Camera, Epsilon, LastLayer, Layers, Object, Scene, Settings},
};

use super::{easel::Easel, raster::Raster, sheet::Panel};

/// The most layers of "all": twice as many as the figures' scenes have surfaces behind each other.
const ALL_LAYERS: u32 = 16;

/// Of pixels in which nothing is seen.
const BACKGROUND: [u8; 3] = [255; 3];

/// What the figures say of the differences in the captions.
pub const OFF_TEXT: &str = "RMS: the root of the mean squared difference to the picture in all layers, in sRGB values from 0 to \
    255, over the pixels in which something is seen.";

/// A scene from where it is seen, with the picture that others are judged by.
pub struct Glass {
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
    ///
    /// # Errors
    /// As the easel's.
    pub fn new(easel: &mut Easel<'_>, scene: &Scene, camera: Camera, epsilon: f64) -> Result<Self> {
        let scene = easel.prepare(scene)?;
        let settings = settings(easel.size_px, epsilon, Layers::Auto(ALL_LAYERS), LastLayer::Drop);
        let all = easel.picture(&scene, &camera, &settings)?;
        Ok(Self { scene, camera, epsilon, all })
    }

    /// All layers.
    pub fn all(&self, name: &str, caption: &str) -> Panel {
        Panel { name: name.to_owned(), caption: caption.to_owned(), picture: self.all.clone() }
    }

    /// So many layers; the caption goes on with how far that is from all.
    ///
    /// # Errors
    /// As the easel's.
    pub fn few(
        &self,
        easel: &mut Easel<'_>,
        name: &str,
        caption: &str,
        layers: u32,
        last_layer: LastLayer,
    ) -> Result<Panel> {
        let settings = settings(easel.size_px, self.epsilon, Layers::Fixed(layers), last_layer);
        let picture = easel.picture(&self.scene, &self.camera, &settings)?;
        let caption = format!("{caption}; RMS {:.1}", off(&picture, &self.all));
        Ok(Panel { name: name.to_owned(), caption, picture })
    }
}

fn settings(size_px: [u32; 2], epsilon: f64, layers: Layers, last_layer: LastLayer) -> Settings {
    Settings {
        size_px,
        epsilon: Epsilon::Length(epsilon),
        layers,
        last_layer,
        accumulate: Accumulate::F32,
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
pub fn ball(splats: usize, center: DVec3, radius: f64, color: [f32; 3], alpha: f32) -> Object {
    let Object { name, splats, closed } = sphere(splats);
    let place = DAffine3 { matrix3: DMat3::from_diagonal(DVec3::splat(radius)), translation: center };
    let mut splats = splats.transformed(&place);
    splats.colors.tint(Some(color), alpha);
    Object { name, splats, closed }
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
