//! What a scene in the host's memory holds.

use std::ffi::{c_char, c_void};

use surfel::{
    Scene,
    ash::vk,
    glam::{DVec3, Vec3},
    scene::{Clip, Colors, Shapes},
};

use crate::{
    handle::{Place, get, text, told},
    result::{Failure, Result, SurfelResult, guard},
    scene::SurfelScene,
    splats::{SurfelClip, SurfelSplats},
    structs::{Struct, SurfelStructureType, write},
};

/// What a scene holds. `surfel_scene_contents` fills it.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelSceneContents {
    /// `SURFEL_STRUCTURE_TYPE_SCENE_CONTENTS`.
    pub s_type: u32,
    /// `sizeof(SurfelSceneContents)`.
    pub size: u32,
    /// NULL.
    pub p_next: *mut c_void,
    /// How many objects of splats there are, without those that came with their levels of detail.
    pub objects: u64,
    /// How many of those.
    pub leveled: u64,
    /// How many objects of triangles.
    pub meshes: u64,
    /// How many of these have splats and nodes that take their place.
    pub hybrids: u64,
    /// How many lights.
    pub lights: u64,
    /// How many splats, also those that can't be drawn.
    pub splats: u64,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelSceneContents {
    const TYPE: SurfelStructureType = SurfelStructureType::SceneContents;
}

/// Tells what a scene holds.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_contents(
    scene: *const SurfelScene,
    contents: *mut SurfelSceneContents,
) -> SurfelResult {
    guard("surfel_scene_contents", || {
        // SAFETY: the contract of the header, here and below.
        let Scene { objects, meshes, leveled, hybrids, lights, .. } = &unsafe { get(scene, "scene") }?.0;
        let splats = objects.iter().map(|object| object.splats.len());
        let filled = SurfelSceneContents {
            s_type: 0,
            size: 0,
            p_next: std::ptr::null_mut(),
            objects: objects.len() as u64,
            leveled: leveled.len() as u64,
            meshes: meshes.len() as u64,
            hybrids: hybrids.len() as u64,
            lights: lights.len() as u64,
            splats: splats.sum::<usize>() as u64,
        };
        // SAFETY: as above.
        unsafe { write(contents, "contents", &filled) }
    })
}

/// Tells the box around all splats and triangles that can be drawn: `least` and `most` get three coordinates each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_bounds(
    scene: *const SurfelScene,
    least: *mut f64,
    most: *mut f64,
) -> SurfelResult {
    guard("surfel_scene_bounds", || {
        // SAFETY: the contract of the header.
        let (scene, least, most) = unsafe {
            (
                get(scene, "scene")?,
                Place::new(least.cast::<[f64; 3]>(), "least")?,
                Place::new(most.cast::<[f64; 3]>(), "most")?,
            )
        };
        let bounds = scene.0.bounds().ok_or_else(nothing)?;
        least.write(bounds.min.to_array());
        most.write(bounds.max.to_array());
        Ok(())
    })
}

/// Tells a ball around all that is in a scene, for a camera: `center` gets three coordinates.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_ball(
    scene: *const SurfelScene,
    center: *mut f64,
    radius: *mut f64,
) -> SurfelResult {
    guard("surfel_scene_ball", || {
        // SAFETY: the contract of the header.
        unsafe { ball(scene, None, center, radius) }
    })
}

/// The same around the objects of this name, of splats and of triangles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_ball_named(
    scene: *const SurfelScene,
    name: *const c_char,
    center: *mut f64,
    radius: *mut f64,
) -> SurfelResult {
    guard("surfel_scene_ball_named", || {
        // SAFETY: the contract of the header.
        unsafe { ball(scene, Some(text(name, "name")?), center, radius) }
    })
}

/// # Safety
/// The contract of the header.
unsafe fn ball(
    scene: *const SurfelScene,
    name: Option<&str>,
    center: *mut f64,
    radius: *mut f64,
) -> Result<()> {
    // SAFETY: this function's contract.
    let (scene, center, radius) = unsafe {
        let center = Place::new(center.cast::<[f64; 3]>(), "center")?;
        (&get(scene, "scene")?.0, center, Place::new(radius, "radius")?)
    };
    let ball = match name {
        None => scene.ball().ok_or_else(nothing)?,
        Some(name) => scene
            .ball_named(name)
            .ok_or_else(|| Failure::invalid(format!("nothing that can be drawn is called '{name}'")))?,
    };
    center.write(ball.center.to_array());
    radius.write(ball.radius);
    Ok(())
}

fn nothing() -> Failure {
    Failure::invalid("there is nothing in the scene")
}

/// Tells the name of an object of splats, as `surfel_prepared_scene_object_name` does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_object_name(
    scene: *const SurfelScene,
    object: u64,
    name: *mut c_char,
    capacity: u64,
    length: *mut u64,
) -> SurfelResult {
    guard("surfel_scene_object_name", || {
        // SAFETY: the contract of the header.
        unsafe {
            let scene = get(scene, "scene")?;
            told(&numbered(&scene.0, object)?.name, (name, capacity, "name"), length)
        }
    })
}

/// The object with this number.
pub fn numbered(scene: &Scene, object: u64) -> Result<&surfel::scene::Object> {
    let own = usize::try_from(object).ok().and_then(|number| scene.objects.get(number));
    own.ok_or_else(|| {
        Failure::invalid(format!("object {object}: the scene has {} of splats", scene.objects.len()))
    })
}

/// Tells the splats of an object: `splats` gets their count, their arrays, and whether they are `closed`; as they would be given to `surfel_scene_add_splats`, but for
/// name, ε, room and clip curves. The arrays are the scene's, and stay as they are until it is changed or destroyed; colors that are all the same are one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_object_splats(
    scene: *const SurfelScene,
    object: u64,
    splats: *mut SurfelSplats,
) -> SurfelResult {
    guard("surfel_scene_object_splats", || {
        // SAFETY: the contract of the header, here and below.
        let own = numbered(&unsafe { get(scene, "scene") }?.0, object)?;
        let (own, closed) = (&own.splats, own.closed);
        let of = |vectors: &[Vec3]| vectors.as_ptr().cast::<f32>();
        let none = std::ptr::null();
        let [normals, tangents_s, tangents_t, radii] = match &own.shapes {
            Shapes::Disks { normals, radii } => [of(normals), none, none, radii.as_ptr()],
            Shapes::Ellipses { s, t } => [none, of(s), of(t), none],
        };
        let (colors, color_count) = match &own.colors {
            Colors::Uniform(color) => (color.as_ptr(), 1),
            Colors::Each(colors) => (colors.as_ptr().cast(), colors.len() as u64),
        };
        let filled = SurfelSplats {
            s_type: 0,
            size: 0,
            p_next: std::ptr::null(),
            name: std::ptr::null(),
            count: own.len() as u64,
            centers: own.positions.as_ptr().cast(),
            normals,
            radii,
            tangents_s,
            tangents_t,
            colors,
            color_count,
            epsilon: 0.0,
            closed: closed.into(),
            reserved: 0,
            clips: std::ptr::null(),
            epsilon_in_radii: 0.0,
            room: std::ptr::null(),
            auto_epsilon: vk::FALSE,
            reserved_too: 0,
        };
        // SAFETY: as above.
        unsafe { write(splats, "splats", &filled) }
    })
}

// Vectors lie in memory as C has them.
const _: () =
    assert!(size_of::<DVec3>() == size_of::<[f64; 3]>() && size_of::<Vec3>() == size_of::<[f32; 3]>());

/// Copies what is cut off the splats of an object, from number `first` on, to `count` places.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_object_clips(
    scene: *const SurfelScene,
    object: u64,
    first: u64,
    count: u64,
    clips: *mut SurfelClip,
) -> SurfelResult {
    guard("surfel_scene_object_clips", || {
        // SAFETY: the contract of the header, here and below.
        let own = &numbered(&unsafe { get(scene, "scene") }?.0, object)?.splats;
        let (length, end) = (own.len() as u64, first.saturating_add(count));
        if end > length {
            return Err(Failure::invalid(format!("{count} splats from {first} on: the object has {length}")));
        }
        if count == 0 {
            return Ok(());
        }
        crate::handle::check(clips, "clips")?;
        for number in first..end {
            let clip: Clip = own.clips.get(number as usize);
            // SAFETY: as above: there is room for `count`.
            unsafe { clips.add((number - first) as usize).write(SurfelClip::of(&clip)) };
        }
        Ok(())
    })
}
