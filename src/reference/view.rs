//! The camera of one picture: pixels to rays, and the sizes that follow from the field of view.
//!
//! An orthographic picture is what pictures of a pinhole camera come to as it moves away and its field of view narrows: here it is that
//! of an eye that is a hundred million times as far away as the scene is large. Then rays differ by 1e-8 from parallel ones, 1e-5 pixels
//! in a picture of a thousand, and f64 leaves as much of a place. So no equation of this folder has another form for it.

use glam::DVec3;

use super::planes::Planes;
use crate::scene::{Ball, Camera, Scene, ViewFromWorld};

/// Camera and image size, ready for use.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    /// World to view space.
    pub from_world: ViewFromWorld,
    /// Width and height.
    pub size_px: [u32; 2],
    /// Where the view's axis meets the image, in pixels from its top left corner.
    pub middle_px: [f64; 2],
    /// Pixels per unit of the image plane.
    pub focal_px: f64,
    /// Depth of the near plane in world units.
    pub near: f64,
    /// The radius of the low-pass filter: √2 pixels, or what samples leave of it.
    pub filter_px: f64,
    /// How much farther from the scene the eye is here than the camera's own.
    pub moved_back: f64,
    /// The planes that cut what is seen.
    pub planes: Planes,
    /// The part of depths that belongs to the scene: what digits and margins of depth are relative to; 1 of a pinhole camera.
    pub depth_share: f64,
}

/// Of an orthographic camera, over the scene's size.
const FAR_AWAY: f64 = 1e8;

impl View {
    /// That of a camera before a scene.
    pub fn of(scene: &Scene, camera: &Camera, size_px: [u32; 2]) -> Self {
        let pinhole = Self::pinhole(camera, size_px);
        let Some(height) = camera.orthographic_height else { return pinhole };
        let ball = scene.ball().unwrap_or(Ball { center: camera.target, radius: 1.0 });
        let [width_px, height_px] = camera.window.whole_px.unwrap_or(size_px).map(f64::from);
        let size = (2.0 * ball.radius).max(height * (width_px / height_px).max(1.0));
        let middle_z = pinhole.from_world.point(ball.center).z;
        let distance = FAR_AWAY * size;
        let moved_back = distance - middle_z;
        let eye = camera.eye - moved_back * camera.forward();
        // What is drawn begins at the near plane, or where the scene does; depth ends at twice as much as there is of it.
        let begins = (middle_z - ball.radius).max(camera.near());
        let depth_range = 2.0 * (middle_z + ball.radius - begins).max(0.0);
        Self {
            from_world: ViewFromWorld { eye, ..pinhole.from_world },
            focal_px: height_px / height * distance,
            near: camera.near() + moved_back,
            moved_back,
            depth_share: if depth_range > 0.0 { depth_range / distance } else { FAR_AWAY.recip() },
            ..pinhole
        }
    }

    pub(super) fn pinhole(camera: &Camera, size_px: [u32; 2]) -> Self {
        Self {
            from_world: camera.view_from_world(),
            size_px,
            middle_px: axis_px(camera, size_px),
            focal_px: camera.focal_px(size_px[1]),
            near: camera.near(),
            filter_px: std::f64::consts::SQRT_2,
            moved_back: 0.0,
            planes: Planes::default(),
            depth_share: 1.0,
        }
    }

    /// From the view's axis to the center of a pixel, in pixels.
    pub fn offset_px(&self, column: u32, row: u32) -> [f64; 2] {
        let [x_px, y_px] = self.middle_px;
        [f64::from(column) + 0.5 - x_px, f64::from(row) + 0.5 - y_px]
    }

    /// The same view of an image that is wider by so many pixels on every side, and has so many samples along a pixel's side.
    pub fn sampled(&self, more_px: u32, samples_per_side: u32) -> Self {
        let samples = f64::from(samples_per_side);
        Self {
            size_px: self.size_px.map(|side| (side + 2 * more_px) * samples_per_side),
            middle_px: self.middle_px.map(|at| (at + f64::from(more_px)) * samples),
            focal_px: self.focal_px * samples,
            ..*self
        }
    }

    /// The view-space direction `(x, y, 1)` through the center of a pixel.
    pub fn ray(&self, column: u32, row: u32) -> DVec3 {
        let [x_px, y_px] = self.offset_px(column, row);
        DVec3::new(x_px / self.focal_px, y_px / self.focal_px, 1.0)
    }

    /// The same through a place of it, so far from its center in pixels.
    pub fn ray_beside(&self, column: u32, row: u32, [right_px, down_px]: [f64; 2]) -> DVec3 {
        let [x_px, y_px] = self.offset_px(column, row);
        DVec3::new((x_px + right_px) / self.focal_px, (y_px + down_px) / self.focal_px, 1.0)
    }

    /// The radius of the low-pass filter in units of the image plane.
    pub fn filter_radius(&self) -> f64 {
        self.filter_px / self.focal_px
    }
}

/// The target is in the middle of the whole picture; the image is a part of that, or moved.
fn axis_px(camera: &Camera, size_px: [u32; 2]) -> [f64; 2] {
    let [width, height] = camera.window.whole_px.unwrap_or(size_px).map(f64::from);
    let [left, top] = camera.window.corner_px;
    [width / 2.0 - left, height / 2.0 - top]
}
