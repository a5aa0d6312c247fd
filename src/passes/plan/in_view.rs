//! Where a chunk lies in the view, as the host knows it: how near, and whether all of it is seen.

use glam::{DVec3, DVec4};

use crate::{
    math::size::SizeBound,
    prepare::{Chunk, ViewFromLocal},
    scene::ViewFromWorld,
};

/// Of the box of a chunk's centers, local space.
pub(super) fn center_and_half(chunk: &Chunk) -> [DVec3; 2] {
    let [lo, hi] = chunk.bounds;
    [0.5 * (lo + hi), 0.5 * (hi - lo)]
}

/// What a device finds in f32 of a depth may differ by so much from f64's, as a part of the distances of which it is the sum: some 6
/// roundings of 2⁻²⁴, with room.
const DEPTH_RESERVE: f64 = 1e-6;

/// A plane in view space.
pub(super) fn in_view(plane: DVec4, of_scene: &ViewFromWorld, view: &ViewFromLocal) -> DVec4 {
    let normal = plane.truncate();
    let eye = normal.dot(of_scene.eye) + plane.w;
    (of_scene.rotation * normal).extend(eye * view.view_from_world_scale)
}

/// How far a chunk's origin is from the eye, and from there the farthest of its centers at most, together, in the view's unit.
pub(super) fn by_origin(chunk: &Chunk, view: &ViewFromLocal) -> f64 {
    let [center, half] = center_and_half(chunk);
    (center.length() + half.length()) * view.view_from_local_scale + view.origin_from_eye.length()
}

/// The smallest depth of any point of the chunk's splats, in view space: of the box of centers, less the largest radius, as a device may
/// find it. The host proves by it that splats are regular, and those that a device finds otherwise would have no place.
pub(super) fn nearest_z(chunk: &Chunk, view: &ViewFromLocal, by_origin: f64) -> f64 {
    let row = view.rotation.row(2);
    let [center, half] = center_and_half(chunk);
    let local = row.dot(center) - row.abs().dot(half) - chunk.largest_radius;
    let reserve = DEPTH_RESERVE * (chunk.largest_radius * view.view_from_local_scale + by_origin);
    local * view.view_from_local_scale + view.translation.z - reserve
}

/// Whether the box of the chunk's centers lies between the near plane and the four sides of the view.
pub(super) fn wholly_in_view(chunk: &Chunk, view: &ViewFromLocal, bound: &SizeBound) -> bool {
    let [x, y, z] = [0, 1, 2].map(|i| view.rotation.row(i).extend(view.translation[i]));
    let [[left, right], [top, bottom]] = bound.sides;
    // Rays meet in the eye, or are parallel.
    let unit = if bound.is_orthographic { DVec4::W } else { z };
    let [center, half] = center_and_half(chunk);
    let least = |plane: DVec4| {
        let normal = plane.truncate();
        view.view_from_local_scale * (normal.dot(center) - normal.abs().dot(half)) + plane.w
    };
    least(z) >= bound.near
        && [right * unit - x, left * unit + x, bottom * unit - y, top * unit + y]
            .into_iter()
            .all(|side| least(side) >= 0.0)
}
