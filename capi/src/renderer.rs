//! The renderer, and uploads.

use std::{
    ffi::{c_char, c_void},
    path::Path,
    sync::{Arc, Mutex, PoisonError},
};

use surfel::{
    Error,
    ash::vk,
    embed::{PreparedScene, Renderer},
    scene::{Defect, Splats},
};

use crate::{
    device::SurfelDevice,
    handle::{Out, destroy, get, get_mut, text},
    result::{Result, SurfelResult, guard},
    scene::SurfelScene,
    splats::{Arrays, SurfelSplats},
    structs::{Struct, SurfelStructureType, read, write},
};

/// Pipelines, for all views and scenes of a device. May be used by several threads at once.
pub struct SurfelRenderer {
    pub renderer: Arc<Renderer>,
    /// For copies of C's arrays, while no update has them: as many as were under way at once.
    arrays: Mutex<Vec<Arrays>>,
}

/// A scene on the device: uploaded, or written there by the host. Frames of several threads may show it at once.
pub struct SurfelPreparedScene(pub PreparedScene);

/// How a renderer is made.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelRendererInfo {
    /// `SURFEL_STRUCTURE_TYPE_RENDERER_INFO`.
    pub s_type: u32,
    /// `sizeof(SurfelRendererInfo)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// The folder in which pipelines are kept from run to run, as UTF-8; NULL: they are not.
    pub cache_folder: *const c_char,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelRendererInfo {
    const TYPE: SurfelStructureType = SurfelStructureType::RendererInfo;
}

/// Makes a renderer. `info` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_renderer_create(
    device: *const SurfelDevice,
    info: *const SurfelRendererInfo,
    renderer: *mut *mut SurfelRenderer,
) -> SurfelResult {
    guard("surfel_renderer_create", || {
        // SAFETY: the contract of the header, here and below.
        let (out, device) = unsafe { (Out::new(renderer, "renderer")?, get(device, "device")?) };
        let mut folder = None;
        if !info.is_null() {
            // SAFETY: as above.
            let SurfelRendererInfo { cache_folder, .. } = unsafe { read(info, "info") }?;
            if !cache_folder.is_null() {
                // SAFETY: as above.
                folder = Some(Path::new(unsafe { text(cache_folder, "cacheFolder") }?));
            }
        }
        let renderer = Arc::new(Renderer::new(&device.0, folder)?);
        out.give(SurfelRenderer { renderer, arrays: Mutex::default() })
    })
}

/// Destroys a renderer; NULL is nothing. Its views go on.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_renderer_destroy(renderer: *mut SurfelRenderer) {
    // SAFETY: the contract of the header.
    unsafe { destroy("surfel_renderer_destroy", renderer) };
}

/// Records the upload of a scene, which frames recorded later may show; `scene` may be destroyed at once. `commands` must be recording,
/// outside of rendering, and be submitted to the device's queue before frames that show the scene, in any epoch; the scene on the device is destroyed after they have run, or if they never run. Where this fails, they hold
/// copies to what is gone, and must not be submitted. Splats that can't be drawn are left out and counted.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_upload(
    renderer: *const SurfelRenderer,
    commands: vk::CommandBuffer,
    scene: *const SurfelScene,
    prepared: *mut *mut SurfelPreparedScene,
) -> SurfelResult {
    guard("surfel_upload", || {
        // SAFETY: the contract of the header, here and below.
        let (out, renderer, scene) =
            unsafe { (Out::new(prepared, "prepared")?, get(renderer, "renderer")?, get(scene, "scene")?) };
        if commands == vk::CommandBuffer::null() {
            return Err(crate::handle::null("commands"));
        }
        // SAFETY: as above.
        out.give(SurfelPreparedScene(unsafe { renderer.renderer.upload(commands, &scene.0) }?))
    })
}

/// Records a change of splats of a scene that was made `updatable`: of its object with this number, those from number `first` on become `splats`, of
/// which name, `closed` and `epsilon` mean nothing: of the object's own kind (disks or ellipses; opaque where the object is). How much the
/// surface overlaps itself, and how near another one is, is not measured again. Frames recorded from now on show it. `commands` must be recording,
/// outside of rendering, and be submitted before `surfel_device_end_epoch` is called; arrays are copied at once, into memory that the renderer keeps, and nothing waits. Where this fails, nothing is recorded. No other thread may use the scene
/// meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_update(
    renderer: *const SurfelRenderer,
    commands: vk::CommandBuffer,
    scene: *mut SurfelPreparedScene,
    object: u64,
    first: u32,
    splats: *const SurfelSplats,
) -> SurfelResult {
    guard("surfel_update", || {
        // SAFETY: the contract of the header, here and below.
        let (renderer, scene, given) =
            unsafe { (get(renderer, "renderer")?, get_mut(scene, "scene")?, read(splats, "splats")?) };
        if commands == vk::CommandBuffer::null() {
            return Err(crate::handle::null("commands"));
        }
        let number = usize::try_from(object).unwrap_or(usize::MAX);
        // SAFETY: as above.
        unsafe {
            renderer.with_splats(&given, |renderer, splats| {
                renderer.update(commands, &mut scene.0, number, first, splats)
            })
        }
    })
}

impl SurfelRenderer {
    /// Does something with splats that C means, in memory that is kept.
    ///
    /// # Safety
    /// As [`Arrays::splats`].
    pub unsafe fn with_splats<T>(
        &self,
        given: &SurfelSplats,
        then: impl FnOnce(&Renderer, &Splats) -> std::result::Result<T, Error>,
    ) -> Result<T> {
        let kept = || self.arrays.lock().unwrap_or_else(PoisonError::into_inner);
        let mut arrays = kept().pop().unwrap_or_default();
        // SAFETY: this function's contract.
        let done = unsafe { arrays.splats(given) }.and_then(|splats| {
            let done = then(&self.renderer, &splats);
            arrays.take_back(splats);
            Ok(done?)
        });
        kept().push(arrays);
        done
    }
}

/// What a scene on the device is. `surfel_prepared_scene_info` fills it.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelPreparedSceneInfo {
    /// `SURFEL_STRUCTURE_TYPE_PREPARED_SCENE_INFO`.
    pub s_type: u32,
    /// `sizeof(SurfelPreparedSceneInfo)`.
    pub size: u32,
    /// NULL.
    pub p_next: *mut c_void,
    /// How many splats it has.
    pub splats: u64,
    /// How many triangles it has.
    pub triangles: u64,
    /// Bytes of device memory.
    pub bytes: u64,
    /// Splats that could not be drawn and are not in it.
    pub left_out: u64,
    /// How many objects it has, for `surfel_update`: of splats, of those that came with their levels of detail, then of triangles.
    pub objects: u64,
    /// Something of it is transparent: frames that show it need `hides` where the rendering has a depth.
    pub transparent: vk::Bool32,
    /// 0.
    pub reserved: u32,
    /// Of those left out, each counted once, by the first of these that it has: a coordinate of the center is NaN or infinite.
    pub left_out_centers: u64,
    /// The normal is zero, NaN or infinite.
    pub left_out_normals: u64,
    /// The radius is zero, negative, NaN or infinite.
    pub left_out_radii: u64,
    /// The tangent vectors are zero, collinear, NaN or infinite.
    pub left_out_tangents: u64,
    /// A component of the color is NaN or infinite.
    pub left_out_colors: u64,
    /// A value of a clip curve is NaN or infinite, its weight is negative, or the splat is a disk.
    pub left_out_clips: u64,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelPreparedSceneInfo {
    const TYPE: SurfelStructureType = SurfelStructureType::PreparedSceneInfo;
}

/// Tells what a scene on the device is.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_prepared_scene_info(
    scene: *const SurfelPreparedScene,
    info: *mut SurfelPreparedSceneInfo,
) -> SurfelResult {
    guard("surfel_prepared_scene_info", || {
        // SAFETY: the contract of the header, here and below.
        let SurfelPreparedScene(scene) = unsafe { get(scene, "scene") }?;
        let left_out = |defect| scene.defects.of(defect) as u64;
        let filled = SurfelPreparedSceneInfo {
            s_type: 0,
            size: 0,
            p_next: std::ptr::null_mut(),
            splats: scene.splat_count(),
            triangles: scene.triangle_count(),
            bytes: scene.bytes(),
            left_out: scene.defects.total() as u64,
            objects: scene.objects.len() as u64,
            transparent: scene.is_transparent().into(),
            reserved: 0,
            left_out_centers: left_out(Defect::Position),
            left_out_normals: left_out(Defect::Normal),
            left_out_radii: left_out(Defect::Radius),
            left_out_tangents: left_out(Defect::Tangents),
            left_out_colors: left_out(Defect::Color),
            left_out_clips: left_out(Defect::Clip),
        };
        // SAFETY: as above.
        unsafe { write(info, "info", &filled) }
    })
}

/// Destroys a scene on the device; NULL is nothing. Its memory is freed when the epoch that is recorded now is done.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_prepared_scene_destroy(scene: *mut SurfelPreparedScene) {
    // SAFETY: the contract of the header.
    unsafe { destroy("surfel_prepared_scene_destroy", scene) };
}

#[cfg(test)]
mod tests {
    /// As the header says. Fails to compile where that is not so.
    #[test]
    fn what_threads_share_may_be_shared() {
        fn shared<T: Send + Sync>() {}
        shared::<crate::device::SurfelDevice>();
        shared::<super::SurfelRenderer>();
        shared::<super::SurfelPreparedScene>();
        fn sent<T: Send>() {}
        sent::<crate::view::SurfelView>();
        sent::<crate::scene::SurfelScene>();
    }
}
