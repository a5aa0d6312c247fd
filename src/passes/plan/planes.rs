//! The planes that cut what is seen, as a camera sees them. Their number is a specialization constant; the host writes them into a buffer of the frame's slot, and
//! pipelines that know them find it in every set (`passes/recording.rs`). What is wholly cut off is not listed. By tiles with `--edges coverage` the cut is the edge
//! of a surface, low-passed (`glsl/tile/clip.glsl`). Where no plane meets a scene the frame is as it would be without.

use std::borrow::Cow;

use glam::DVec4;

use crate::{
    inline_vec::InlineVec,
    passes::plan::range::DepthRange,
    prepare::Placed,
    scene::{Bounds, Camera, MOST_PLANES, Settings},
};

/// A plane as `glsl/inc/planes.glsl` has it.
pub type ShaderPlane = [f32; 4];

const _: () = assert!(MOST_PLANES == crate::shaders::config::MOST_PLANES as usize);

/// The settings without planes, where none cuts anything of what is shown: all of it is then drawn as it is, and what is closed is not open. A box around all tells, so that it
/// does not depend on the camera.
pub(crate) fn if_they_cut<'s>(scenes: &[Placed<'_>], settings: &'s Settings) -> Cow<'s, Settings> {
    let planes = settings.clip();
    let is_left = |placed: &Placed<'_>| {
        let bounds = placed.scene.bounds;
        bounds.is_some_and(|bounds| planes.iter().all(|plane| is_inside(&bounds, placed.at.plane(*plane))))
    };
    match !planes.is_empty() && scenes.iter().all(is_left) {
        true => Cow::Owned(settings.uncut()),
        false => Cow::Borrowed(settings),
    }
}

/// Whether a plane leaves all of a box.
fn is_inside(bounds: &Bounds, plane: DVec4) -> bool {
    let half = 0.5 * (bounds.max - bounds.min);
    let normal = plane.truncate();
    normal.dot(bounds.center()) + plane.w >= normal.abs().dot(half)
}

/// Planes as a camera sees them, whose depth begins where it is ([`DepthRange::begin`]).
pub(crate) fn shader_planes(
    (camera, range): (&Camera, DepthRange),
    settings: &Settings,
) -> InlineVec<ShaderPlane, MOST_PLANES> {
    let view = camera.view_from_world();
    let focal_px = camera.focal_px(settings.size_px[1]);
    let of = |plane: DVec4| {
        let normal = view.rotation * plane.truncate();
        // By how much the eye is inside.
        let eye = plane.truncate().dot(view.eye) + plane.w;
        let [at_axis, of_depth] = match camera.is_orthographic() {
            true => [eye + normal.z * range.end, -normal.z * range.end],
            false => [normal.z, eye / camera.near()],
        };
        [normal.x, normal.y, focal_px * at_axis, focal_px * of_depth].map(|part| part as f32)
    };
    settings.clip().into_iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{ClipBox, ClipPlanes};
    use glam::DVec3;

    /// What the shader finds, in f64, is by how many pixels a place is inside.
    #[test]
    fn places_are_inside_by_as_many_pixels_as_they_are_seen() {
        let far = DVec3::new(5e5, 4.6e6, 300.0);
        let perspective = Camera { eye: far + DVec3::new(1.0, 2.0, 3.0), target: far, ..Camera::default() };
        let parallel = Camera { orthographic_height: Some(4.0), ..perspective };
        let settings = Settings {
            size_px: [100, 80],
            clip_box: ClipBox(Some([(far - 1.0).to_array(), (far + 0.5).to_array()])),
            ..Settings::default()
        };
        for camera in [perspective, parallel] {
            let range = DepthRange { from_eye: 0.0, end: 20.0 };
            let planes = shader_planes((&camera, range), &settings);
            assert_eq!(planes.len(), 6);
            let place = far + DVec3::new(0.25, -0.5, 0.1);
            let at = camera.view_from_world().point(place);
            let focal_px = camera.focal_px(80);
            let (px, w, scale) = match camera.is_orthographic() {
                true => (at.truncate() * focal_px, 1.0 - at.z / range.end, focal_px),
                false => (at.truncate() / at.z * focal_px, camera.near() / at.z, focal_px / at.z),
            };
            let inside = [1.25, 0.25, 0.5, 1.0, 1.1, 0.4];
            for (plane, expected) in planes.iter().zip(inside) {
                let [x, y, z, of_depth] = plane.map(f64::from);
                let found = x * px.x + y * px.y + z + of_depth * w;
                assert!((found / scale - expected).abs() < 1e-5, "{found} {scale} {expected}");
            }
        }
        let other =
            Settings { clip_planes: ClipPlanes([[0.0, 0.0, 1.0, 0.0]].into()), ..Settings::default() };
        assert_eq!(shader_planes((&perspective, DepthRange::default()), &other).len(), 1);
    }
}
