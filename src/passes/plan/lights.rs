//! Lights as a camera sees them.

use crate::scene::{Camera, Light, LightKind, MOST_LIGHTS};

/// A light as `glsl/inc/shading.glsl` has it: the unit direction to it in view space and 1 where it is at the eye; linear
/// color.
pub type ShaderLight = [[f32; 4]; 2];

const _: () = assert!((MOST_LIGHTS * size_of::<ShaderLight>()) as u64 <= crate::vk::STAND_IN_BYTES);

/// Lights as a camera sees them.
pub(crate) fn shader_lights(lights: &[Light], camera: &Camera) -> Vec<ShaderLight> {
    let view = camera.view_from_world();
    let of = |light: &Light| {
        let [red, green, blue] = light.color;
        let (to_light, at_eye) = match light.kind {
            LightKind::Eye => (glam::Vec3::ZERO, 1.0),
            LightKind::Directional(direction) => {
                ((view.rotation * -direction.normalize_or_zero()).as_vec3(), 0.0)
            }
        };
        [to_light.extend(at_eye).into(), [red, green, blue, 0.0]]
    };
    lights.iter().take(MOST_LIGHTS).map(of).collect()
}
