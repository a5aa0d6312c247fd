//! The camera of one picture: pixels to rays, and the sizes that follow from the field of view.

use glam::DVec3;

use crate::scene::{Camera, ViewFromWorld};

/// Camera and image size, ready for use.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    /// World to view space.
    pub from_world: ViewFromWorld,
    /// Width and height.
    pub size_px: [u32; 2],
    /// Pixels per unit of the image plane.
    pub focal_px: f64,
    /// Depth of the near plane in world units.
    pub near: f64,
}

impl View {
    pub fn new(camera: &Camera, size_px: [u32; 2]) -> Self {
        Self {
            from_world: camera.view_from_world(),
            size_px,
            focal_px: camera.focal_px(size_px[1]),
            near: camera.near(),
        }
    }

    /// The middle of the image in pixels from the top left corner.
    pub fn middle_px(&self) -> [f64; 2] {
        self.size_px.map(|n| 0.5 * f64::from(n))
    }

    /// From the middle of the image to the center of a pixel, in pixels.
    pub fn offset_px(&self, column: u32, row: u32) -> [f64; 2] {
        let middle_px = self.middle_px();
        [f64::from(column) + 0.5 - middle_px[0], f64::from(row) + 0.5 - middle_px[1]]
    }

    /// The view-space direction `(x, y, 1)` through the center of a pixel.
    pub fn ray(&self, column: u32, row: u32) -> DVec3 {
        let [x_px, y_px] = self.offset_px(column, row);
        DVec3::new(x_px / self.focal_px, y_px / self.focal_px, 1.0)
    }

    /// The radius of the low-pass filter, √2 pixels, in units of the image plane.
    pub fn filter_radius(&self) -> f64 {
        std::f64::consts::SQRT_2 / self.focal_px
    }
}
