//! A scene in the host's memory.

use std::ffi::{c_char, c_void};

use surfel::{
    Error, Scene,
    ash::vk,
    glam::{DAffine3, DMat4, DVec4},
    scene::{Epsilon, MOST_LIGHTS, Object, Splats, is_invertible},
};

use crate::{
    handle::{Out, Place, destroy, get, get_mut, text},
    lights::light as light_of,
    result::{Failure, Result, SurfelResult, guard},
    rooms::room,
    settings::set,
    splats::{SurfelSplats, array, object},
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
fn add(scene: &mut Scene, object: Object, (auto, epsilons): (bool, [f64; 2])) -> Result<()> {
    if let Some(wrong) = epsilons.iter().find(|epsilon| !(**epsilon >= 0.0 && epsilon.is_finite())) {
        let problem = format!("{wrong}: expected a finite number above 0, or 0 for that of the settings");
        return Err(Error::option("epsilon", problem).into());
    }
    let epsilon = match epsilons {
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
    };
    scene.epsilons.resize(scene.objects.len(), None);
    scene.epsilons.push(epsilon);
    scene.objects.push(object);
    Ok(())
}

/// Adds what a file holds, as `surfel render` shows it: splats, a mesh or points of any format that the library was built with, or all
/// objects and lights of a scene file (`.toml`). `path` is UTF-8; on Unix any bytes that are a path. Files that a file names are opened in
/// its folder or below.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_add_file(scene: *mut SurfelScene, path: *const c_char) -> SurfelResult {
    guard("surfel_scene_add_file", || {
        // SAFETY: the contract of the header, here and below.
        let scene = unsafe { get_mut(scene, "scene") }?;
        if path.is_null() {
            return Err(crate::handle::null("path"));
        }
        // SAFETY: as above.
        add_file(&mut scene.0, unsafe { std::ffi::CStr::from_ptr(path) })
    })
}

#[cfg(feature = "files")]
fn add_file(scene: &mut Scene, path: &std::ffi::CStr) -> Result<()> {
    use surfel::{
        compose::{build, compose},
        load::{LoadOptions, ObjectDescription, is_scene_file},
    };

    #[cfg(unix)]
    let path =
        std::path::Path::new(<std::ffi::OsStr as std::os::unix::ffi::OsStrExt>::from_bytes(path.to_bytes()));
    #[cfg(not(unix))]
    let path = std::path::Path::new(path.to_str().map_err(|_| Failure::invalid("path is not UTF-8"))?);
    let options = LoadOptions::default();
    let file = match is_scene_file(path) {
        true => compose(path, &options, &())?.scene,
        false => build(&[ObjectDescription::of_file(path)], Vec::new(), &options, &(), &mut |_| {})?.0,
    };
    scene.epsilons.resize(scene.objects.len(), None);
    scene.epsilons.extend(file.epsilons);
    scene.objects.extend(file.objects);
    scene.leveled.extend(file.leveled);
    let before = scene.meshes.len();
    scene.hybrids.extend(file.hybrids.into_iter().map(|mut hybrid| {
        hybrid.mesh += before;
        hybrid
    }));
    scene.meshes.extend(file.meshes);
    scene.lights.extend(file.lights);
    Ok(())
}

#[cfg(not(feature = "files"))]
fn add_file(_scene: &mut Scene, _path: &std::ffi::CStr) -> Result<()> {
    let text = "the library was built without the feature 'files'".to_owned();
    Err(Failure { code: SurfelResult::Unsupported, text })
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
        let matrix = unsafe { array(world_from_object.cast::<[f64; 16]>(), 1, "worldFromObject") }?[0];
        let matrix = DMat4::from_cols_array(&matrix);
        let map = DAffine3::from_mat4(matrix);
        let refused = |problem: &str| Err(Error::option("worldFromObject", problem).into());
        if matrix.row(3) != DVec4::W || !is_invertible(&map) {
            return refused("expected an affine map that can be undone");
        }
        if scene.has_levels() {
            return refused("the scene has levels of detail, which are where their file says");
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

/// Tells a ball around all that is in a scene, for a camera: `center` gets three coordinates.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_ball(
    scene: *const SurfelScene,
    center: *mut f64,
    radius: *mut f64,
) -> SurfelResult {
    guard("surfel_scene_ball", || {
        // SAFETY: the contract of the header.
        let (scene, center, radius) = unsafe {
            let center = Place::new(center.cast::<[f64; 3]>(), "center")?;
            (get(scene, "scene")?, center, Place::new(radius, "radius")?)
        };
        let ball = scene.0.ball().ok_or_else(|| Failure::invalid("there is nothing in the scene"))?;
        center.write(ball.center.to_array());
        radius.write(ball.radius);
        Ok(())
    })
}

/// Destroys a scene in the host's memory; NULL is nothing. What was made of it on a device stays.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_destroy(scene: *mut SurfelScene) {
    // SAFETY: the contract of the header.
    unsafe { destroy("surfel_scene_destroy", scene) };
}
