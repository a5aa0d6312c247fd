//! What a host says of a frame.

use std::ffi::c_void;

use surfel::{
    Settings,
    ash::vk,
    embed::{DepthImage, HostCamera, ImageState, Placed, Placement, ViewFrame},
    glam::DMat4,
    graph::execute::Profile,
};

use crate::{
    handle::{get, null},
    renderer::SurfelPreparedScene,
    result::{Failure, Result},
    settings::SurfelSettings,
    splats::copy,
    structs::{Struct, SurfelStructureType, read},
};

/// The depth of what a host has drawn so far.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelDepthImage {
    /// `SURFEL_STRUCTURE_TYPE_DEPTH_IMAGE`.
    pub s_type: u32,
    /// `sizeof(SurfelDepthImage)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// One sample a pixel, one layer, one mip level; usage `VK_IMAGE_USAGE_SAMPLED_BIT`.
    pub image: vk::Image,
    /// A view of its depth alone.
    pub view: vk::ImageView,
    /// What was done with it just before; its writes are waited for.
    pub before_stages: vk::PipelineStageFlags2,
    /// As `beforeStages`.
    pub before_access: vk::AccessFlags2,
    /// What will be done with it just after.
    pub after_stages: vk::PipelineStageFlags2,
    /// As `afterStages`.
    pub after_access: vk::AccessFlags2,
    /// The layout in which it is.
    pub before_layout: vk::ImageLayout,
    /// The layout in which it is left.
    pub after_layout: vk::ImageLayout,
    /// Its format.
    pub format: vk::Format,
    /// Its width in pixels.
    pub width: u32,
    /// Its height in pixels.
    pub height: u32,
    /// 0.
    pub reserved: u32,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelDepthImage {
    const TYPE: SurfelStructureType = SurfelStructureType::DepthImage;
}

/// What a view shows in a frame, and from where. Matrices are columns of four numbers, 16 in all.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelFrame {
    /// `SURFEL_STRUCTURE_TYPE_FRAME`.
    pub s_type: u32,
    /// `sizeof(SurfelFrame)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// What is shown; it may differ from frame to frame, nothing is uploaded by that. One scene may be in it several times.
    pub scenes: *const *const SurfelPreparedScene,
    /// A matrix for each scene, one behind the other, from its own space to the world: rotation, scale alike in all directions,
    /// translation. NULL: all stand where their own coordinates say.
    pub world_from_scene: *const f64,
    /// How; NULL: by the defaults.
    pub settings: *const SurfelSettings,
    /// What the host has drawn hides transparent things pixel by pixel between each other: its depth. Needed where anything is transparent
    /// and the rendering has a depth. What is opaque is tested by the host's own test when it is drawn.
    pub hides: *const SurfelDepthImage,
    /// From world to the host's view space, whatever its axes: a motion, without scale.
    pub view_from_world: [f64; 16],
    /// From view to clip space as Vulkan has it; perspective or orthographic, off-center, jittered, depth reversed or not, finite or
    /// infinite. Pixels are square.
    pub clip_from_view: [f64; 16],
    /// How many scenes there are.
    pub scene_count: u32,
    /// The viewport has a negative height, so that clip space's y points up in the picture.
    pub flips_y: vk::Bool32,
    /// The view's size in pixels.
    pub width: u32,
    /// The view's size in pixels.
    pub height: u32,
    /// Where its left side lies in the host's images, in pixels.
    pub x: i32,
    /// Where its top lies.
    pub y: i32,
    /// Each pass is timed, for `surfel_view_times`.
    pub timed: vk::Bool32,
    /// 0.
    pub reserved: u32,
    /// A matrix for each scene, as in `worldFromScene`, of where it stood in the frame before, for motion. NULL: all stood where they stand.
    pub world_from_scene_before: *const f64,
    /// A number for each scene, for whoever wants to know what is seen in a pixel. NULL: 0.
    pub ids: *const u32,
    /// Four numbers for each scene, 0 to 1, which its linear red, green and blue and its alpha are multiplied by. An alpha below 1 is for scenes
    /// of which all is transparent already. NULL: 1.
    pub tints: *const f32,
    /// `viewFromWorld` of the frame before, for motion; all 0: both matrices are what they are now, as `flipsY` and the size are in any case.
    pub view_from_world_before: [f64; 16],
    /// `clipFromView` of the frame before.
    pub clip_from_view_before: [f64; 16],
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelFrame {
    const TYPE: SurfelStructureType = SurfelStructureType::Frame;
}

/// Calls `then` with the frame that C means.
///
/// # Safety
/// Pointers are NULL or lead to as much as the struct says.
pub unsafe fn with_frame(given: &SurfelFrame, then: impl FnOnce(&ViewFrame<'_>) -> Result<()>) -> Result<()> {
    let count = u64::from(given.scene_count);
    // SAFETY: this function's contract, here and below; so many are given.
    let of_scenes = unsafe { copy(given.scenes, count, "scenes", |scene| scene) }?;
    // SAFETY: as above.
    let [matrices, before] = unsafe {
        [
            each(given.world_from_scene.cast::<[f64; 16]>(), count, "worldFromScene")?,
            each(given.world_from_scene_before.cast(), count, "worldFromSceneBefore")?,
        ]
    };
    // SAFETY: as above.
    let (ids, tints) =
        unsafe { (each(given.ids, count, "ids")?, each(given.tints.cast::<[f32; 4]>(), count, "tints")?) };
    let mut scenes = Vec::new();
    for (i, scene) in of_scenes.into_iter().enumerate() {
        // SAFETY: as above.
        let scene = unsafe { get(scene, "a scene") }?;
        let placement = |matrices: &[[f64; 16]], when: &str| {
            let placed = |matrix| Placement::of_matrix(&DMat4::from_cols_array(matrix));
            let at = matrices.get(i).map(placed).transpose();
            at.map_err(|error| Failure { text: format!("scene {i}{when}: {error}"), ..Failure::from(error) })
        };
        let plain = Placed::new(&scene.0, placement(&matrices, "")?.unwrap_or_default());
        scenes.push(Placed {
            before: placement(&before, ", before")?,
            id: ids.get(i).copied().unwrap_or_default(),
            tint: tints.get(i).copied().unwrap_or(plain.tint),
            ..plain
        });
    }
    let size_px = [given.width, given.height];
    // SAFETY: as above.
    let settings = match unsafe { given.settings.as_ref() } {
        Some(SurfelSettings(settings)) => Settings { size_px, ..settings.clone() },
        None => Settings { size_px, ..Settings::default() },
    };
    let hides = match given.hides.is_null() {
        true => None,
        // SAFETY: as above.
        false => Some(depth_image(&unsafe { read(given.hides, "hides") }?)?),
    };
    let camera = HostCamera {
        view_from_world: DMat4::from_cols_array(&given.view_from_world),
        clip_from_view: DMat4::from_cols_array(&given.clip_from_view),
        flips_y: given.flips_y != vk::FALSE,
    };
    let matrices_before = [given.view_from_world_before, given.clip_from_view_before];
    let [view_from_world, clip_from_view] = matrices_before.map(|matrix| DMat4::from_cols_array(&matrix));
    let was = HostCamera { view_from_world, clip_from_view, ..camera };
    let moved = matrices_before.as_flattened().iter().any(|number| *number != 0.0);
    then(&ViewFrame {
        scenes: &scenes,
        camera: &camera,
        camera_before: moved.then_some(&was),
        settings: &settings,
        corner_px: [given.x, given.y],
        hides,
        missing: surfel::embed::MissingPipelines::Make,
        profile: (given.timed != vk::FALSE).then_some(Profile::Times),
    })
}

/// What there is one of for each scene; nothing where it is not given.
///
/// # Safety
/// `from` is NULL or leads to `count` of them.
unsafe fn each<T: Copy>(from: *const T, count: u64, name: &str) -> Result<Vec<T>> {
    match from.is_null() {
        true => Ok(Vec::new()),
        // SAFETY: this function's contract.
        false => unsafe { copy(from, count, name, |it| it) },
    }
}

fn depth_image(given: &SurfelDepthImage) -> Result<DepthImage> {
    if given.image == vk::Image::null() || given.view == vk::ImageView::null() {
        return Err(null("hides: image or view"));
    }
    let state = |stages, access, layout| ImageState { stages, access, layout };
    Ok(DepthImage {
        image: given.image,
        view: given.view,
        format: given.format,
        extent: vk::Extent2D { width: given.width, height: given.height },
        before: state(given.before_stages, given.before_access, given.before_layout),
        after: state(given.after_stages, given.after_access, given.after_layout),
    })
}
