//! What shaders are told of all that is drawn in one local space: camera, image, ε.

use glam::DVec3;

use crate::{
    passes::{
        pipeline::constants::{FrameConstants, in_one_word},
        plan::scene_view::SceneView,
    },
    prepare::ViewFromLocal,
    scene::Settings,
};

/// Where ε stops to grow, in radii and in view units, of which the eye is about 1 away: everything belongs to the nearest
/// surface long before, and f32 ends at 3e38.
const LARGEST_EPSILON: f64 = 1e30;

/// What is the same for all that is drawn in one local space; ε in radii and as a world length.
#[inline(always)] // Who writes it elsewhere would wait for it.
pub(crate) fn frame_constants(
    view: &ViewFromLocal,
    of_scene: &SceneView<'_>,
    settings: &Settings,
    (epsilon_radii, epsilon_length): (f64, f64),
) -> FrameConstants {
    let focal_px = of_scene.focal_px(view);
    let near = if of_scene.is_orthographic() {
        of_scene.range.end * view.view_from_world_scale
    } else {
        of_scene.near(view)
    };
    let epsilon_length = epsilon_length * view.view_from_world_scale;
    let [view_from_local_x, view_from_local_y, view_from_local_z] = view.rows();
    FrameConstants {
        view_from_local_x,
        view_from_local_y,
        view_from_local_z,
        middle_px: of_scene.frame.middle_px.map(|at| at as f32),
        focal_px: focal_px as f32,
        near: near as f32,
        filter_radius: of_scene.filter_radius(focal_px) as f32,
        epsilon_radii: epsilon_radii.min(LARGEST_EPSILON) as f32,
        epsilon_length: epsilon_length.min(LARGEST_EPSILON) as f32,
        size_less_1_px: in_one_word(settings.size_px.map(|side| side.saturating_sub(1).min(0xffff))),
        corner_px: in_one_word(of_scene.corner_px()),
        splat_count: 0,
        chunk_color: 0,
        view_from_local_scale: view.view_from_local_scale as f32,
        origin_from_eye: in_two_parts(view.origin_from_eye),
        first_record: 0,
        blocks_overlap: 0,
    }
}

/// A vector in f32, and what that leaves of it.
fn in_two_parts(v: DVec3) -> [f32; 6] {
    let high = v.as_vec3();
    let low = (v - high.as_dvec3()).as_vec3();
    [high.x, high.y, high.z, low.x, low.y, low.z]
}
