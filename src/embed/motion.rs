//! Where in the picture of the frame before the point was that is seen in a pixel now.
//!
//! A pixel's place x, y and its depth w, as (x, y, 1, w), are a point of view space times a number: of a perspective, whose w is near / z, the ray
//! ((x - middle) / f, (y - middle) / f, 1) over z with 1 / z behind, which is w / near; of parallel rays, whose w is linear in z, the point itself. So one matrix
//! takes them to the world, to where an object's placements take that, into the view space of the frame before and to its picture.

use glam::{DMat4, DVec3, DVec4};

use crate::{
    passes::{HostObject, plan::range::DepthRange},
    prepare::Placed,
    scene::{Camera, Placement},
};

/// Two cameras, one after the other.
pub(super) struct Motion {
    /// To the world from a pixel, 1 and w.
    world_from_pixel: DMat4,
    /// To a homogeneous place in the picture before, in pixels: x, y, nothing, what divides.
    pixel_from_world: DMat4,
}

impl Motion {
    pub fn new([now, before]: [&Camera; 2], range: DepthRange, size_px: [u32; 2]) -> Self {
        Self {
            world_from_pixel: world_from_view(now) * view_from_pixel(now, range, size_px),
            pixel_from_world: pixel_from_view(before, size_px) * view_from_world(before),
        }
    }

    /// What the shader is told of an object.
    pub fn of(&self, placed: &Placed<'_>) -> HostObject {
        let before = placed.before.unwrap_or(placed.at);
        let moved = match before == placed.at {
            true => DMat4::IDENTITY,
            false => before.world_from_scene() * back(&placed.at),
        };
        let whole = self.pixel_from_world * moved * self.world_from_pixel;
        let less = |row: usize, still: DVec4| (whole.row(row) - still).as_vec4().to_array();
        HostObject {
            x: less(0, DVec4::X),
            y: less(1, DVec4::Y),
            over: less(3, DVec4::Z),
            id: placed.id,
            unused: [0; 3],
        }
    }
}

/// From the world to a scene that stands so.
fn back(at: &Placement) -> DMat4 {
    let (turn, scale) = (at.rotation.normalize().conjugate(), at.scale.recip());
    DMat4::from_scale_rotation_translation(DVec3::splat(scale), turn, turn * -at.translation * scale)
}

fn view_from_world(camera: &Camera) -> DMat4 {
    let view = camera.view_from_world();
    let turn = DMat4::from_mat3(view.rotation);
    turn * DMat4::from_translation(-view.eye)
}

fn world_from_view(camera: &Camera) -> DMat4 {
    let view = camera.view_from_world();
    DMat4::from_translation(view.eye) * DMat4::from_mat3(view.rotation.transpose())
}

fn view_from_pixel(camera: &Camera, range: DepthRange, size_px: [u32; 2]) -> DMat4 {
    let unit = camera.focal_px(size_px[1]).recip();
    let [x, y] = camera.middle_px(size_px).map(|middle| -middle * unit);
    let (one, w) = match camera.is_orthographic() {
        true => (DVec4::new(x, y, range.from_eye + range.end, 1.0), DVec4::new(0.0, 0.0, -range.end, 0.0)),
        false => (DVec4::new(x, y, 1.0, 0.0), DVec4::new(0.0, 0.0, 0.0, camera.near().recip())),
    };
    DMat4::from_cols(DVec4::X * unit, DVec4::Y * unit, one, w)
}

fn pixel_from_view(camera: &Camera, size_px: [u32; 2]) -> DMat4 {
    let focal_px = camera.focal_px(size_px[1]);
    let [x, y] = camera.middle_px(size_px);
    // What divides stands beside the middle: z of a perspective, 1 of parallel rays.
    let beside = DVec4::new(x, y, 0.0, 1.0);
    let (z, one) = if camera.is_orthographic() { (DVec4::ZERO, beside) } else { (beside, DVec4::ZERO) };
    DMat4::from_cols(DVec4::X * focal_px, DVec4::Y * focal_px, z, one)
}

#[cfg(test)]
mod tests;
