//! What a host says of a frame.

use std::ffi::c_void;

use surfel::{
    Settings,
    ash::vk,
    embed::{HostCamera, MissingPipelines, Placed, Placement, Profile, ViewFrame},
    glam::DMat4,
};

use crate::{
    arrays::array,
    handle::get,
    images::{SurfelDepthImage, depth_image},
    renderer::SurfelPreparedScene,
    result::{Failure, Result},
    settings::SurfelSettings,
    structs::{Struct, SurfelStructureType, read},
};

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
    /// From world to the host's view space, whatever its axes and its unit: a motion, and one scale of all directions.
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
    /// A frame that needs a pipeline which is not there yet is refused, `SURFEL_RESULT_NOT_READY`, in place of a wait for it; as after any
    /// refusal the view has then no frame to draw. `surfel_compile_ahead` makes them.
    pub refuses_missing: vk::Bool32,
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
    /// All matrices are of a left-handed world, as of Direct3D, Unity or Unreal, in which what the scenes hold is seen mirrored by (1, 1, -1):
    /// what comes from there is mirrored once more before, by `surfel_scene_transform`.
    pub left_handed: vk::Bool32,
    /// 0; else it is refused.
    pub reserved: u32,
    /// Not 0: a pipeline that is missing is made as long as no more than so many were made in all (`surfel_pipelines_made`); beyond, the frame is
    /// refused, `SURFEL_RESULT_NOT_READY`. A host that asks again and again goes on between.
    pub most_pipelines: u64,
    /// What is measured, for `surfel_view_measured`: `SURFEL_MEASURE_*`; 0: the time of each pass where `timed` says so, else nothing.
    pub measures: u32,
    /// What the matrices show is a mirror's picture, as of a planar reflection: its view is turned over by the mirror's plane, or its projection along x. Refused
    /// where it is not said and is, or is said and is not.
    pub mirrored: vk::Bool32,
}

/// Nothing, or what `timed` says: in `measures` of `SurfelFrame`, as those that follow.
pub const SURFEL_MEASURE_NOTHING: u32 = 0;
/// The frame's own time, from before its first pass to behind its last.
pub const SURFEL_MEASURE_FRAME: u32 = 1;
/// The time of each pass, and from the first to the last with what it costs to time them.
pub const SURFEL_MEASURE_TIMES: u32 = 2;
/// Vertices and fragments, or invocations of compute, of each pass, where `pipelineStatisticsQuery` is enabled.
pub const SURFEL_MEASURE_COUNTS: u32 = 3;

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelFrame {
    const TYPE: SurfelStructureType = SurfelStructureType::Frame;

    fn reserved(&self) -> u32 {
        self.reserved
    }
}

/// Memory for the list of a frame's scenes, which is kept between frames, and nothing in it.
#[derive(Default)]
pub struct SceneList(Vec<Placed<'static>>);

impl SceneList {
    fn take<'a>(&mut self) -> Vec<Placed<'a>> {
        emptied(std::mem::take(&mut self.0))
    }

    fn give_back(&mut self, list: Vec<Placed<'_>>) {
        self.0 = emptied(list);
    }
}

/// The same memory for scenes that live for another time. The list that is collected takes the place of the one it is collected from.
fn emptied<'b>(mut list: Vec<Placed<'_>>) -> Vec<Placed<'b>> {
    list.clear();
    list.into_iter().map_while(|_| None).collect()
}

/// Calls `then` with the frame that C means.
///
/// # Safety
/// Pointers are NULL or lead to as much as the struct says.
pub unsafe fn with_frame(
    given: &SurfelFrame,
    kept: &mut SceneList,
    then: impl FnOnce(&ViewFrame<'_>) -> Result<()>,
) -> Result<()> {
    let mut scenes = kept.take();
    // SAFETY: this function's contract.
    let answer = unsafe { with_scenes(given, &mut scenes, then) };
    kept.give_back(scenes);
    answer
}

/// The same, with the list of scenes, which it fills.
///
/// # Safety
/// As [`with_frame`].
unsafe fn with_scenes<'a>(
    given: &SurfelFrame,
    scenes: &mut Vec<Placed<'a>>,
    then: impl FnOnce(&ViewFrame<'_>) -> Result<()>,
) -> Result<()> {
    let (count, left_handed) = (u64::from(given.scene_count), given.left_handed != vk::FALSE);
    // SAFETY: this function's contract, here and below; so many are given.
    let of_scenes: &[*const SurfelPreparedScene] = unsafe { array(given.scenes, count, "scenes") }?;
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
    for (i, scene) in of_scenes.iter().enumerate() {
        // SAFETY: as above.
        let scene: &'a SurfelPreparedScene = unsafe { get(*scene, "a scene") }?;
        let placement = |matrices: &[[f64; 16]], when: &str| {
            let of = if left_handed { Placement::of_left_handed } else { Placement::of_matrix };
            let placed = |matrix| of(&DMat4::from_cols_array(matrix));
            let at = matrices.get(i).map(placed).transpose();
            at.map_err(|error| Failure { text: format!("scene {i}{when}: {error}"), ..Failure::from(error) })
        };
        let plain = Placed::new(&scene.0, placement(matrices, "")?.unwrap_or_default());
        scenes.push(Placed {
            before: placement(before, ", before")?,
            id: ids.get(i).copied().unwrap_or_default(),
            tint: tints.get(i).copied().unwrap_or(plain.tint),
            ..plain
        });
    }
    let size_px = [given.width, given.height];
    let settings = match given.settings.is_null() {
        true => Settings { size_px, ..Settings::default() },
        // SAFETY: as above.
        false => Settings { size_px, ..unsafe { get(given.settings, "settings") }?.0.clone() },
    };
    let hides = match given.hides.is_null() {
        true => None,
        // SAFETY: as above.
        false => Some(depth_image(&unsafe { read(given.hides, "hides") }?)?),
    };
    let camera = |[view_from_world, clip_from_view]: [[f64; 16]; 2]| {
        let camera = HostCamera {
            view_from_world: DMat4::from_cols_array(&view_from_world),
            clip_from_view: DMat4::from_cols_array(&clip_from_view),
            flips_y: given.flips_y != vk::FALSE,
        };
        if left_handed { camera.of_left_handed() } else { camera }
    };
    let matrices_before = [given.view_from_world_before, given.clip_from_view_before];
    let was = camera(matrices_before);
    let camera = camera([given.view_from_world, given.clip_from_view]);
    let moved = matrices_before.as_flattened().iter().any(|number| *number != 0.0);
    let profile = measures_of(given.measures, (given.timed != vk::FALSE).then_some(Profile::Times))?;
    then(&ViewFrame {
        scenes,
        camera: &camera,
        camera_before: moved.then_some(&was),
        mirrored: given.mirrored != vk::FALSE,
        settings: &settings,
        corner_px: [given.x, given.y],
        hides,
        missing: match (given.refuses_missing != vk::FALSE, given.most_pipelines) {
            (true, _) => MissingPipelines::Refuse,
            (false, 0) => MissingPipelines::Make,
            (false, most) => MissingPipelines::UpTo(most),
        },
        profile,
    })
}

/// What is measured; `nothing`: where C says nothing.
pub fn measures_of(given: u32, nothing: Option<Profile>) -> Result<Option<Profile>> {
    match given {
        SURFEL_MEASURE_NOTHING => Ok(nothing),
        SURFEL_MEASURE_FRAME => Ok(Some(Profile::Frame)),
        SURFEL_MEASURE_TIMES => Ok(Some(Profile::Times)),
        SURFEL_MEASURE_COUNTS => Ok(Some(Profile::Counts)),
        other => Err(Failure::invalid(format!("measures is {other}: expected a SURFEL_MEASURE_*"))),
    }
}

/// What there is one of for each scene; nothing where it is not given.
///
/// # Safety
/// `from` is NULL or leads to `count` of them.
unsafe fn each<'a, T: Copy>(from: *const T, count: u64, name: &str) -> Result<&'a [T]> {
    match from.is_null() {
        true => Ok(&[]),
        // SAFETY: this function's contract.
        false => unsafe { array(from, count, name) },
    }
}
