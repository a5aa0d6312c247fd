//! The weight of one splat over the image, at a resolution finer than its pixels.
//!
//! The filters are made for the pixels, so that a larger picture would show other footprints. In place of it the same small
//! picture is drawn many times, with the eye moved sideways by fractions of a pixel: each frame gives the weights at one
//! place within every pixel. By a pixel's move the splat is seen from another side, by `1 / FOCAL_PX` of a radian: a
//! footprint of 10 pixels changes by 0.03 of them.

use glam::{DVec2, DVec3};
use surfel::{
    Progress as _, Result,
    scene::{Accumulate, Camera, Colors, Filter, Object, Scene, Settings, Shapes, Splats},
};

use super::context::FigureContext;

/// Pixels to a unit of the image plane.
const FOCAL_PX: f64 = 300.0;

/// The splat's depth.
const DEPTH: f64 = 1.0;

/// The splat's place: 45° to the right of the view, where the projection shears most within a 90° view.
const CENTER: DVec3 = DVec3::new(DEPTH, 0.0, DEPTH);

/// A round splat at [`CENTER`], in view space.
#[derive(Clone, Copy, Debug)]
pub struct RoundSplat {
    /// Its radius in pixels at its depth.
    pub radius_px: f64,
    /// Its normal against the direction to the eye.
    pub tilt_deg: f64,
}

/// Weights over a square window with the projected center in its middle.
pub struct Footprint {
    /// Samples along a side.
    pub side: usize,
    /// Row by row from the top left.
    pub weights: Vec<f32>,
}

impl RoundSplat {
    fn radius(self) -> f64 {
        self.radius_px * DEPTH / FOCAL_PX
    }

    /// Turned about an axis that is neither across nor along the picture: there the paper's tangents project to directions
    /// that are not orthogonal.
    fn normal(self) -> DVec3 {
        let to_eye = -CENTER.normalize();
        let aside = (DVec3::Y + DVec3::new(1.0, 0.0, -1.0).normalize()).normalize();
        let (sin, cos) = self.tilt_deg.to_radians().sin_cos();
        cos * to_eye + sin * aside
    }

    /// The half axes of its projection (affine, at the center), the larger first.
    pub fn half_axes_px(self) -> [f64; 2] {
        let s = self.normal().any_orthonormal_vector() * self.radius();
        let t = self.normal().cross(s);
        let [a, b] = [s, t].map(projected_px);
        let sum = a.length_squared() + b.length_squared();
        let det = a.perp_dot(b).abs();
        // The singular values of [a b].
        let major = (0.5 * (sum + (sum * sum - 4.0 * det * det).max(0.0).sqrt())).sqrt();
        [major, det / major]
    }

    /// The angle in the picture between the tangents that the paper adjusts (equation 10), at most 90.
    pub fn paper_angle_deg(self) -> f64 {
        let s = CENTER.cross(self.normal());
        let t = self.normal().cross(s);
        let [a, b] = [s, t].map(projected_px);
        a.perp_dot(b).abs().atan2(a.dot(b).abs()).to_degrees()
    }

    /// Draws it: a window of `window_px` pixels with `samples` along each pixel.
    pub fn footprint(
        self,
        context: &mut FigureContext<'_>,
        filter: Filter,
        window_px: u16,
        samples: u16,
    ) -> Result<Footprint> {
        let world = |view: DVec3| DVec3::new(view.x, -view.y, -view.z);
        let splats = Splats::new(
            vec![world(CENTER)],
            Shapes::Disks {
                normals: vec![world(self.normal()).as_vec3()],
                radii: vec![self.radius() as f32],
            },
            Colors::Uniform([1.0; 4]),
        );
        let object = Object { name: "splat".to_owned(), splats, closed: false };
        let scene = context.prepare(&Scene::from(object))?;
        // The window with a pixel around it, and as much on the left, where nothing is.
        let half_height = u32::from(window_px) / 2 + 1;
        let center_px = (FOCAL_PX * CENTER.x / CENTER.z).round() as u32;
        let size_px = [2 * (center_px + half_height), 2 * half_height];
        let settings = Settings { size_px, filter, accumulate: Accumulate::F32, ..Settings::default() };
        let fov_y_rad = 2.0 * (f64::from(half_height) / FOCAL_PX).atan();

        let [window, samples] = [window_px, samples].map(usize::from);
        let side = window * samples;
        let mut weights = vec![0.0; side * side];
        let task = format!("footprint of {}", filter.name());
        for frame in 0..samples * samples {
            context.bars.step(&task, frame as u64, (samples * samples) as u64);
            let within = [frame % samples, frame / samples];
            // From the pixel's center, to the right and down.
            let offset_px = within.map(|i| (i as f64 + 0.5) / samples as f64 - 0.5);
            let eye = world(DVec3::new(offset_px[0], offset_px[1], 0.0) * (DEPTH / FOCAL_PX));
            let camera = Camera { eye, target: eye - DVec3::Z, up: DVec3::Y, fov_y_rad, ..Camera::default() };
            let drawn = context.weights(&scene, &camera, &settings)?;
            for row in 0..window {
                // The center is between pixels, in the middle of the window.
                let first = (row + 1) * size_px[0] as usize + size_px[0] as usize - 1 - window;
                let fine = (row * samples + within[1]) * side;
                for column in 0..window {
                    weights[fine + column * samples + within[0]] = drawn[first + column];
                }
            }
        }
        context.bars.clear();
        Ok(Footprint { side, weights })
    }
}

/// The move of the projection, in pixels, when [`CENTER`] moves along `v`.
fn projected_px(v: DVec3) -> DVec2 {
    FOCAL_PX * (v.truncate() - CENTER.truncate() / CENTER.z * v.z) / CENTER.z
}

impl Footprint {
    /// The largest weight.
    pub fn peak(&self) -> f32 {
        self.weights.iter().copied().fold(0.0, f32::max)
    }

    /// Each weight over the largest one; zeros where that is zero.
    pub fn shape(&self) -> Vec<f32> {
        let peak = self.peak();
        self.weights.iter().map(|weight| if peak > 0.0 { weight / peak } else { 0.0 }).collect()
    }

    /// The distance of this shape from another: the sum of the absolute differences over the other's sum.
    pub fn shape_difference(&self, other: &Self) -> f64 {
        let (own, other) = (self.shape(), other.shape());
        let sum = |values: &mut dyn Iterator<Item = f32>| values.map(f64::from).sum::<f64>();
        sum(&mut own.iter().zip(&other).map(|(a, b)| (a - b).abs())) / sum(&mut other.iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_axes_and_angles_are_those_worked_out_by_hand() {
        // Seen straight from the eye: a sideways move counts √2 times at 45° (1/cos² over the distance), one down once.
        let facing = RoundSplat { radius_px: 5.0, tilt_deg: 0.0 };
        let [major, minor] = facing.half_axes_px();
        assert!((major - 5.0 * 2.0_f64.sqrt()).abs() < 1e-9 && (minor - 5.0).abs() < 1e-9, "{major} {minor}");
        // Almost edge-on along the diagonal: cos = (2 − 1)/(2 + 1).
        let edge_on = RoundSplat { radius_px: 5.0, tilt_deg: 90.0 - 1e-6 };
        let angle_deg = edge_on.paper_angle_deg();
        assert!((angle_deg - (1.0_f64 / 3.0).acos().to_degrees()).abs() < 1e-3, "{angle_deg}");
        assert!(edge_on.half_axes_px()[1] < 1e-6);
    }

    #[test]
    fn shapes_are_compared_without_their_heights() {
        let print = |weights: [f32; 4]| Footprint { side: 2, weights: weights.to_vec() };
        let a = print([0.0, 0.5, 1.0, 0.5]);
        assert_eq!(a.shape_difference(&print([0.0, 0.25, 0.5, 0.25])), 0.0);
        assert_eq!(print([1.0, 0.5, 0.0, 0.5]).shape_difference(&a), 1.0);
        // What is not drawn at all differs by everything.
        assert_eq!(print([0.0; 4]).shape_difference(&a), 1.0);
    }
}
