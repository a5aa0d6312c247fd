//! Views: passes outside of the host's rendering, draws within it.

use std::{ffi::c_void, sync::Arc};

use surfel::{
    ash::vk,
    embed::{Renderer, Rendering, View},
};

use crate::{
    arrays::array,
    frame::{SceneList, SurfelFrame, with_frame},
    handle::{Out, Place, destroy, get, get_mut, null},
    images::{SurfelHostImage, host_image},
    renderer::SurfelRenderer,
    result::{Failure, Result, SurfelResult, guard},
    structs::{Struct, SurfelStructureType, read},
};

/// One view, which keeps what passes leave for the draws of the frame that was prepared last: that is drawn before the next one is prepared. With several frames in flight a host has one for each. One thread at a time may use it.
pub struct SurfelView {
    pub view: View,
    renderer: Arc<Renderer>,
    scenes: SceneList,
}

/// What the host's rendering is, within which a view is drawn: as in `VkPipelineRenderingCreateInfo`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelRendering {
    /// `SURFEL_STRUCTURE_TYPE_RENDERING`.
    pub s_type: u32,
    /// `sizeof(SurfelRendering)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// The formats of its color attachments. The first is drawn to, then come those of `ids` and `motion`; the others are left as they are. For
    /// more than one the device needs `SURFEL_FEATURE_INDEPENDENT_BLEND`. None: depth alone is drawn, of what is opaque.
    pub color_formats: *const vk::Format,
    /// How many there are.
    pub color_format_count: u32,
    /// The format of its depth attachment; 0 (`VK_FORMAT_UNDEFINED`): there is none, and all of the view is drawn.
    pub depth_format: vk::Format,
    /// The format of its stencil attachment, which is left as it is; 0: there is none.
    pub stencil_format: vk::Format,
    /// Samples of a pixel; 0 is `VK_SAMPLE_COUNT_1_BIT`. All samples of one get the same.
    pub samples: u32,
    /// How depths are compared: `VK_COMPARE_OP_LESS` or, where depth is reversed, `VK_COMPARE_OP_GREATER`, which 0 is, too.
    pub compare: vk::CompareOp,
    /// Colors are encoded as sRGB before they are blended: for hosts that keep encoded colors in `UNORM` formats. sRGB formats encode by
    /// themselves, and float formats keep linear light.
    pub encodes: vk::Bool32,
    /// The second color attachment, `VK_FORMAT_R32_UINT` or `VK_FORMAT_R16_UINT`, gets the number (`SurfelFrame.ids`) of what is seen, wherever
    /// depth is written; `SURFEL_NO_ID` where a cut leaves it open. Transparent layers leave it as it is.
    pub ids: vk::Bool32,
    /// The second color attachment, or the third with `ids`, `VK_FORMAT_R16G16_SFLOAT` or `VK_FORMAT_R32G32_SFLOAT`, gets motion alike: where the
    /// point that is seen is in the picture less where it was in the frame before, in pixels, x to the right and y down; 0 of what was behind
    /// the eye. By the cameras as they are given: what they are jittered by is in it.
    pub motion: vk::Bool32,
}

/// The number of no object.
pub const SURFEL_NO_ID: u32 = 0xffff_ffff;

const _: () = assert!(SURFEL_NO_ID == surfel::embed::NO_ID);

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelRendering {
    const TYPE: SurfelStructureType = SurfelStructureType::Rendering;
}

/// The most color attachments that a rendering has.
const MOST_ATTACHMENTS: u32 = 64;

/// # Safety
/// Pointers are NULL or lead to as much as the struct says.
pub unsafe fn rendering_of(given: &SurfelRendering) -> Result<Rendering> {
    let count = given.color_format_count;
    if count > MOST_ATTACHMENTS {
        let text = format!("colorFormatCount is {count}: expected at most {MOST_ATTACHMENTS}");
        return Err(Failure::invalid(text));
    }
    // SAFETY: this function's contract.
    let color_formats = unsafe { array(given.color_formats, count.into(), "colorFormats") }?.to_vec();
    let samples = vk::SampleCountFlags::from_raw(given.samples.max(1));
    let reversed = given.compare == vk::CompareOp::NEVER;
    Ok(Rendering {
        color_formats,
        depth_format: given.depth_format,
        stencil_format: given.stencil_format,
        samples,
        compare: if reversed { vk::CompareOp::GREATER } else { given.compare },
        encodes: given.encodes != vk::FALSE,
        ids: given.ids != vk::FALSE,
        motion: given.motion != vk::FALSE,
    })
}

/// Makes a view to be drawn within such a rendering. Its pipelines are made here.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_view_create(
    renderer: *const SurfelRenderer,
    rendering: *const SurfelRendering,
    view: *mut *mut SurfelView,
) -> SurfelResult {
    guard("surfel_view_create", || {
        // SAFETY: the contract of the header, here and below.
        let (out, renderer) = unsafe { (Out::new(view, "view")?, get(renderer, "renderer")?) };
        // SAFETY: as above.
        let rendering = unsafe { rendering_of(&read(rendering, "rendering")?) }?;
        let renderer = Arc::clone(&renderer.renderer);
        out.give(SurfelView {
            view: View::new(&renderer, &rendering)?,
            renderer,
            scenes: SceneList::default(),
        })
    })
}

/// Records the passes of a frame: all but its draws. `commands` must be recording, outside of rendering, without an active query, and be
/// submitted to the device's queue, after those of the frame prepared before in this view, whose draws are recorded before: what the host writes for a frame is kept apart until
/// its epoch is done. View and scenes must not be destroyed before the submission, and the images of `hides` not before it has finished.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_view_prepare(
    view: *mut SurfelView,
    commands: vk::CommandBuffer,
    frame: *const SurfelFrame,
) -> SurfelResult {
    guard("surfel_view_prepare", || {
        // SAFETY: the contract of the header, here and below.
        let (SurfelView { view, renderer, scenes }, frame) =
            unsafe { (get_mut(view, "view")?, read(frame, "frame")?) };
        if commands == vk::CommandBuffer::null() {
            return Err(null("commands"));
        }
        // SAFETY: as above.
        unsafe { with_frame(&frame, scenes, |frame| Ok(view.prepare(renderer, commands, frame)?)) }
    })
}

/// Records the draws of the frame that was prepared: up to three triangles. `commands` are those of `surfel_view_prepare`, or others that
/// are submitted after them to the same queue; they are inside of a rendering as the view was made for, which covers the view's area.
/// Clobbers viewport and scissor, and of the graphics bind point the pipeline, all sets and push constants.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_view_draw(
    view: *const SurfelView,
    commands: vk::CommandBuffer,
) -> SurfelResult {
    guard("surfel_view_draw", || {
        // SAFETY: the contract of the header, here and below.
        let SurfelView { view, renderer, .. } = unsafe { get(view, "view") }?;
        if commands == vk::CommandBuffer::null() {
            return Err(null("commands"));
        }
        // SAFETY: as above.
        Ok(unsafe { view.draw(renderer, commands) }?)
    })
}

/// Records all of a frame: `surfel_view_prepare`, then a rendering onto these images with `surfel_view_draw` in it, and barriers around it.
/// `colors` leads to as many pointers as the rendering that the view was made for has formats, each to an image, NULL where a format is 0.
/// `depth`: NULL where the rendering has none. The images hold the view's area, and must not be destroyed before the commands have run.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_view_record(
    view: *mut SurfelView,
    commands: vk::CommandBuffer,
    frame: *const SurfelFrame,
    colors: *const *const SurfelHostImage,
    color_count: u32,
    depth: *const SurfelHostImage,
) -> SurfelResult {
    guard("surfel_view_record", || {
        // SAFETY: the contract of the header, here and below.
        let (SurfelView { view, renderer, scenes }, frame) =
            unsafe { (get_mut(view, "view")?, read(frame, "frame")?) };
        if commands == vk::CommandBuffer::null() {
            return Err(null("commands"));
        }
        if color_count > MOST_IMAGES as u32 {
            let text = format!("colorCount is {color_count}: expected at most {MOST_IMAGES}");
            return Err(Failure::invalid(text));
        }
        // SAFETY: as above.
        let given = unsafe { array(colors, color_count.into(), "colors") }?;
        let mut images = [None; MOST_IMAGES];
        for (image, color) in images.iter_mut().zip(given) {
            // SAFETY: as above.
            *image = unsafe { host_image(*color, "a color") }?;
        }
        // SAFETY: as above.
        let depth = unsafe { host_image(depth, "depth") }?;
        let colors = &images[..given.len()];
        // SAFETY: as above.
        unsafe {
            with_frame(&frame, scenes, |frame| Ok(view.record(renderer, commands, frame, colors, depth)?))
        }
    })
}

/// As many color attachments as a view's rendering has at most.
const MOST_IMAGES: usize = 8;

/// Tells how many bytes of device memory a view holds.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_view_bytes(view: *const SurfelView, bytes: *mut u64) -> SurfelResult {
    guard("surfel_view_bytes", || {
        // SAFETY: the contract of the header.
        let (view, bytes) = unsafe { (get(view, "view")?, Place::new(bytes, "bytes")?) };
        bytes.write(view.view.bytes());
        Ok(())
    })
}

/// Destroys a view; NULL is nothing. Its memory is freed when the epoch that is recorded now is done.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_view_destroy(view: *mut SurfelView) {
    // SAFETY: the contract of the header.
    unsafe { destroy("surfel_view_destroy", view) };
}
