//! Splats whose picture an f32 can't decide are no part of a scene: nobody could say who is wrong.

use glam::{DVec2, DVec3};
use surfel::scene::{Camera, Filter, Object, Shapes};

use super::looking::SIZE_PX;

/// The sine between a splat's plane and the ray to its center, below which f32 loses it: turning a normal rounds it by 2⁻²⁴, of which
/// depth and r² have as much as one divided by this, a ten-thousandth; and nearer still it may face either way.
const FACING: f64 = 1e-3;

/// How near a splat may be to where another map is taken for it, relative.
const REGULAR: f64 = 1e-4;

/// The depth radius over the depth from which a splat has no affine map (`src/reference/splat.rs`).
const REGULAR_DEPTH_RATIO: f64 = 0.9;

/// The semi-minor axis that a splat must have without a filter. Places are good to 16 steps of f32 of the image's half, 4e-5 px, which
/// is less than 1e-3 of it.
const THINNEST_PX: f64 = 0.05;

/// Leaves out what is undecided.
pub fn keep_posed(object: &mut Object, camera: &Camera, filter: Filter, exact_planes: bool) {
    let splats = &object.splats;
    let keep: Vec<bool> = (0..splats.len())
        .map(|i| {
            let (s, t) = tangents(&splats.shapes, i);
            let is_defective = splats.defect(i).is_some();
            is_defective || is_posed(splats.positions[i], (s, t), camera, filter, exact_planes)
        })
        .collect();
    object.splats.keep(&keep);
}

fn is_posed(at: DVec3, (s, t): (DVec3, DVec3), camera: &Camera, filter: Filter, exact_planes: bool) -> bool {
    let view = camera.view_from_world();
    let p = view.point(at);
    let (s, t) = (view.rotation * s, view.rotation * t);
    let normal = s.cross(t).normalize();
    if !exact_planes && normal.dot(p).abs() <= FACING * p.length() {
        return false;
    }
    let (near, depth_radius) = (camera.near(), s.z.hypot(t.z));
    let is_tie = |a: f64, b: f64| (a - b).abs() <= REGULAR * a.abs().max(b.abs());
    if is_tie(depth_radius, REGULAR_DEPTH_RATIO * p.z)
        || is_tie(p.z - depth_radius, near)
        || is_tie(p.z, near)
    {
        return false;
    }
    let reaches_near = p.z - depth_radius < near;
    let widened = matches!(filter, Filter::Adjust | Filter::AdjustPaper | Filter::Ewa);
    reaches_near || widened || minor_px(p, s, t, camera) >= THINNEST_PX
}

/// Some scaled tangent vectors of a splat.
fn tangents(shapes: &Shapes, i: usize) -> (DVec3, DVec3) {
    match shapes {
        Shapes::Disks { normals, radii } => {
            let normal = normals[i].as_dvec3().normalize();
            let s = normal.any_orthonormal_vector();
            (s * f64::from(radii[i]), normal.cross(s) * f64::from(radii[i]))
        }
        Shapes::Ellipses { s, t } => (s[i].as_dvec3(), t[i].as_dvec3()),
    }
}

/// The shorter semi-axis of the image of a splat under the affine map at its center.
fn minor_px(p: DVec3, s: DVec3, t: DVec3, camera: &Camera) -> f64 {
    let image = |v: DVec3| -> DVec2 { (v.truncate() - p.truncate() / p.z * v.z) / p.z };
    let (a, b) = (image(s), image(t));
    let (aa, bb) = (a.length_squared(), b.length_squared());
    let major = (0.5 * (aa + bb + (aa - bb).hypot(2.0 * a.dot(b)))).sqrt();
    camera.focal_px(SIZE_PX[1]) * a.perp_dot(b).abs() / major
}

/// Whether the near plane cuts some splat, or may.
pub fn is_cut_by_near(object: &Object, camera: &Camera) -> bool {
    let view = camera.view_from_world();
    (0..object.splats.len()).any(|i| {
        let (s, t) = tangents(&object.splats.shapes, i);
        let z = view.point(object.splats.positions[i]).z;
        let depth_radius = (view.rotation * s).z.hypot((view.rotation * t).z);
        z - depth_radius < 1.001 * camera.near() && z + depth_radius > 0.999 * camera.near()
    })
}
