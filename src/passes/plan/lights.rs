//! Lights as a camera sees them.

use crate::{
    arena::Arena,
    error::{Error, Result},
    prepare::Placed,
    scene::{Camera, Light, LightKind, MOST_LIGHTS},
};

/// A light as `glsl/inc/shading.glsl` has it: the unit direction to it in view space and 1 where it is at the eye; linear
/// color.
pub type ShaderLight = [[f32; 4]; 2];

const _: () = assert!((MOST_LIGHTS * size_of::<ShaderLight>()) as u64 <= crate::vk::STAND_IN_BYTES);

/// A scene that stands at several places shines once, from the first.
fn each_once<'s, 'a>(scenes: &'s [Placed<'a>]) -> impl Iterator<Item = &'s Placed<'a>> {
    let is_first = |i: usize| !scenes[..i].iter().any(|other| std::ptr::eq(other.scene, scenes[i].scene));
    (0..scenes.len()).filter(move |i| !scenes[*i].scene.lights.is_empty() && is_first(*i)).map(|i| &scenes[i])
}

/// Refuses lights that are none, and more of them in all than shaders take.
///
/// # Errors
/// [`crate::ErrorKind::Option`].
pub(crate) fn check(scenes: &[Placed<'_>]) -> Result<()> {
    each_once(scenes).flat_map(|placed| &placed.scene.lights).try_for_each(Light::validate)?;
    let count: usize = each_once(scenes).map(|placed| placed.scene.lights.len()).sum();
    match count <= MOST_LIGHTS {
        true => Ok(()),
        false => {
            Err(Error::option("lights", format!("{count} in all scenes: expected at most {MOST_LIGHTS}")))
        }
    }
}

/// The lights of all scenes, which shine on all of them, as a camera sees them.
pub(crate) fn shader_lights<'m>(
    arena: &'m Arena,
    scenes: &[Placed<'_>],
    camera: &Camera,
) -> &'m [ShaderLight] {
    let mut lights = arena.growing();
    lights.extend(
        each_once(scenes)
            .flat_map(|Placed { scene, at, .. }| of_scene(&scene.lights, &at.camera(camera)))
            .take(MOST_LIGHTS),
    );
    lights.into_bump_slice()
}

/// Those of one, from a camera in its own space.
fn of_scene<'l>(lights: &'l [Light], camera: &Camera) -> impl Iterator<Item = ShaderLight> + use<'l> {
    let view = camera.view_from_world();
    let of = move |light: &Light| {
        let [red, green, blue] = light.color;
        let (to_light, at_eye) = match light.kind {
            LightKind::Eye => (glam::Vec3::ZERO, 1.0),
            LightKind::Directional(direction) => {
                ((view.rotation * -direction.normalize_or_zero()).as_vec3(), 0.0)
            }
        };
        [to_light.extend(at_eye).into(), [red, green, blue, 0.0]]
    };
    lights.iter().map(of)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        prepare::{PreparedScene, prepare_without_device},
        scene::{Placement, Scene},
        vk::Limits,
    };

    fn lit(count: usize) -> PreparedScene {
        let light = Light { kind: LightKind::Eye, color: [1.0; 3] };
        let scene = Scene { lights: vec![light; count], ..Scene::default() };
        prepare_without_device(&Limits::plain(), &scene).unwrap()
    }

    #[test]
    fn a_scene_shines_once_wherever_it_stands_and_too_many_lights_are_refused() {
        let (one, two) = (lit(1), lit(2));
        let at = Placement { scale: 2.0, ..Placement::default() };
        let all =
            [Placed::at_home(&one), Placed::new(&one, at), Placed::at_home(&two), Placed::new(&two, at)];
        assert_eq!(shader_lights(&Arena::new(), &all, &Camera::default()).len(), 3);
        check(&all).unwrap();
        let many = lit(MOST_LIGHTS);
        check(&[Placed::at_home(&many), Placed::new(&many, at)]).unwrap();
        assert!(check(&[Placed::at_home(&many), Placed::at_home(&one)]).is_err());
    }
}
