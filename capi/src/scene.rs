//! A scene in the host's memory.

use std::ffi::{c_char, c_void};

use surfel::{
    Error, Scene,
    ash::vk,
    glam::{DAffine3, DMat4, DVec4},
    scene::{Epsilon, MOST_LIGHTS, Object, Splats, is_invertible},
};

use crate::{
    arrays::array,
    handle::{Out, destroy, get_mut, text},
    lights::light as light_of,
    result::{Result, SurfelResult, guard},
    rooms::room,
    settings::set,
    splats::{SurfelSplats, object},
    structs::{Struct, SurfelStructureType, read},
};

/// Splats and lights in the host's memory, of which `surfel_upload` makes a scene on a device. Needs none itself, so that another thread can
/// make it.
pub struct SurfelScene(pub Scene);

/// What a scene is made for.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelSceneInfo {
    /// `SURFEL_STRUCTURE_TYPE_SCENE_INFO`.
    pub s_type: u32,
    /// `sizeof(SurfelSceneInfo)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// It gets levels of detail at the upload, for the setting `lod`.
    pub levels: vk::Bool32,
    /// Its levels of detail may have a `budget`, for which the host keeps 40 bytes for each node of them.
    pub budget: vk::Bool32,
    /// `surfel_update` may change its splats on the device, for which the host keeps what the device has of each; not with `levels`, nor with
    /// `splat-format` `packed`.
    pub updatable: vk::Bool32,
    /// 0; else it is refused.
    pub reserved: u32,
    /// `surfel_pick_read` is to tell numbers of splats and triangles, for which the host keeps 4 bytes of each.
    pub numbered: vk::Bool32,
    /// No frame asks for an `epsilon` of `auto` of objects that have none of their own: nothing is looked for near their splats at the upload.
    pub without_auto_epsilon: vk::Bool32,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelSceneInfo {
    const TYPE: SurfelStructureType = SurfelStructureType::SceneInfo;

    fn reserved(&self) -> u32 {
        self.reserved
    }
}

/// Makes a scene of nothing. `info` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_create(
    info: *const SurfelSceneInfo,
    scene: *mut *mut SurfelScene,
) -> SurfelResult {
    guard("surfel_scene_create", || {
        // SAFETY: the contract of the header, here and below.
        let out = unsafe { Out::new(scene, "scene") }?;
        let mut scene = Scene::default();
        if !info.is_null() {
            // SAFETY: as above.
            let info = unsafe { read(info, "info") }?;
            let SurfelSceneInfo { levels, budget, updatable, numbered, without_auto_epsilon, .. } = info;
            scene.without_auto_epsilon = without_auto_epsilon != vk::FALSE;
            scene.numbered = numbered != vk::FALSE;
            (scene.levels, scene.budget) = (levels != vk::FALSE, budget != vk::FALSE);
            scene.updatable = updatable != vk::FALSE;
        }
        out.give(SurfelScene(scene))
    })
}

/// Says how splats are kept on a device, by words: `order` is `morton` or `input`, `splat-format` is `exact` or `packed`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_set(
    scene: *mut SurfelScene,
    name: *const c_char,
    value: *const c_char,
) -> SurfelResult {
    guard("surfel_scene_set", || {
        // SAFETY: the contract of the header.
        let (scene, name, value) =
            unsafe { (get_mut(scene, "scene")?, text(name, "name")?, text(value, "value")?) };
        set(&mut scene.0.storage, name, value)
    })
}

/// Adds a light, by words: `eye`, or `direction=x,y,z` in which it travels; and `color=r,g,b` (sRGB, 0 to 1) and `intensity=i` where they
/// are not 1; with commas between; at most 16. A scene without lights has a white one at the eye.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_add_light(
    scene: *mut SurfelScene,
    light: *const c_char,
) -> SurfelResult {
    guard("surfel_scene_add_light", || {
        // SAFETY: the contract of the header.
        let (scene, light) = unsafe { (get_mut(scene, "scene")?, light_of(light, "light")?) };
        if scene.0.lights.len() >= MOST_LIGHTS {
            let problem = format!("the scene has {MOST_LIGHTS} already, which is the most");
            return Err(Error::option("light", problem).into());
        }
        scene.0.lights.push(light);
        Ok(())
    })
}

/// Adds an object of splats; its arrays are copied.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_add_splats(
    scene: *mut SurfelScene,
    splats: *const SurfelSplats,
) -> SurfelResult {
    guard("surfel_scene_add_splats", || {
        // SAFETY: the contract of the header.
        let (scene, splats) = unsafe { (get_mut(scene, "scene")?, read(splats, "splats")?) };
        // SAFETY: the contract of the header.
        let (object, room) = unsafe { (object(&splats)?, room(splats.room)?) };
        add(
            &mut scene.0,
            object,
            (splats.auto_epsilon != vk::FALSE, [splats.epsilon, splats.epsilon_in_radii]),
        )?;
        if room.is_some() {
            scene.0.rooms.resize(scene.0.objects.len() - 1, None);
            scene.0.rooms.push(room);
        }
        Ok(())
    })
}

/// `epsilons`: as a length, and in radii.
pub fn add(scene: &mut Scene, object: Object, epsilons: (bool, [f64; 2])) -> Result<()> {
    let epsilon = epsilon_of(epsilons)?;
    scene.epsilons.resize(scene.objects.len(), None);
    scene.epsilons.push(epsilon);
    scene.objects.push(object);
    Ok(())
}

/// The ε that an object has of its own; `epsilons`: as a length, and in radii.
pub fn epsilon_of((auto, epsilons): (bool, [f64; 2])) -> Result<Option<Epsilon>> {
    if let Some(wrong) = epsilons.iter().find(|epsilon| !(**epsilon >= 0.0 && epsilon.is_finite())) {
        let problem = format!("{wrong}: expected a finite number above 0, or 0 for that of the settings");
        return Err(Error::option("epsilon", problem).into());
    }
    Ok(match epsilons {
        [0.0, 0.0] => auto.then_some(Epsilon::Auto),
        _ if auto => {
            let problem = "autoEpsilon, and a number: expected one of both";
            return Err(Error::option("epsilon", problem).into());
        }
        [length, 0.0] => Some(Epsilon::Length(length)),
        [0.0, radii] => Some(Epsilon::Radii(radii)),
        [length, radii] => {
            let problem = format!("{length}, and {radii} radii: expected one of both");
            return Err(Error::option("epsilon", problem).into());
        }
    })
}

/// A map of C's, of four columns.
///
/// # Safety
/// `world_from_object` is NULL or leads to 16 numbers.
pub unsafe fn affine(world_from_object: *const f64) -> Result<DAffine3> {
    // SAFETY: this function's contract.
    let matrix = unsafe { array(world_from_object.cast::<[f64; 16]>(), 1, "worldFromObject") }?[0];
    let matrix = DMat4::from_cols_array(&matrix);
    let map = DAffine3::from_mat4(matrix);
    if matrix.row(3) != DVec4::W || !is_invertible(&map) {
        let problem = "expected an affine map that can be undone";
        return Err(Error::option("worldFromObject", problem).into());
    }
    Ok(map)
}

/// Moves all that is in a scene so far, but its lights and lengths of ε, by a matrix of four columns: turns, scales, mirrors or shears it, each splat and
/// triangle for itself. So what comes from a left-handed world, and is to be seen there, is mirrored once (`leftHanded` in `SurfelFrame`). Not
/// for what a file has levels of detail of.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_transform(
    scene: *mut SurfelScene,
    world_from_object: *const f64,
) -> SurfelResult {
    guard("surfel_scene_transform", || {
        // SAFETY: the contract of the header, here and below.
        let scene = &mut unsafe { get_mut(scene, "scene") }?.0;
        // SAFETY: as above.
        let map = unsafe { affine(world_from_object) }?;
        if scene.has_levels() {
            let problem = "the scene has levels of detail, which are where their file says";
            return Err(Error::option("worldFromObject", problem).into());
        }
        for object in &mut scene.objects {
            object.splats = std::mem::replace(&mut object.splats, Splats::none()).transformed(&map);
        }
        for object in &mut scene.meshes {
            object.mesh = object.mesh.clone().transformed(&map);
        }
        Ok(())
    })
}

/// Destroys a scene in the host's memory; NULL is nothing. What was made of it on a device stays.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_destroy(scene: *mut SurfelScene) {
    // SAFETY: the contract of the header.
    unsafe { destroy("surfel_scene_destroy", scene) };
}
