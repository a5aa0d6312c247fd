//! The lights of a scene that has its own: a small buffer that each frame fills, for whoever shades. A scene without has
//! one at the eye, which is in the shaders and takes nothing.

use crate::passes::pass::{Pass, Source, transfer};
use crate::{
    graph::{Access, Buffer, BufferDesc, Graph, Handle, Start, execute::Body},
    scene::{Camera, Light, LightKind, MOST_LIGHTS},
};

/// A light as `glsl/inc/shading.glsl` has it: the unit direction to it in view space and 1 where it is at the eye; linear
/// color.
pub type ShaderLight = [[f32; 4]; 2];

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

/// Declares the pass that fills the buffer; none where there are no lights.
pub(crate) fn lights<'a>(
    graph: &mut Graph<Body<'a>>,
    source: Source<'a>,
    lights: &'a [ShaderLight],
) -> Option<Handle<Buffer>> {
    if lights.is_empty() {
        return None;
    }
    // Shaders declare room for the most.
    let room = BufferDesc::of_bytes((MOST_LIGHTS * size_of::<ShaderLight>()) as u64);
    let mut buffer = graph.create_buffer("lights", room);
    Pass::new(graph, source, "lights", "the scene has lights of its own")
        .write(transfer(0), &mut buffer, Access::TransferWrite, Start::Discard)
        .finish(move |pass| pass.update_buffer(transfer(0), bytemuck::cast_slice(lights)));
    Some(buffer)
}
