//! A picture of our own device, and what is said of it.

use std::ffi::c_void;

use surfel::{Frame, ash::vk};

use crate::{
    camera::SurfelCamera,
    renderer::SurfelPreparedScene,
    settings::SurfelSettings,
    structs::{Struct, SurfelStructureType},
};

/// A frame of such a device.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelHeadlessFrame {
    /// `SURFEL_STRUCTURE_TYPE_HEADLESS_FRAME`.
    pub s_type: u32,
    /// `sizeof(SurfelHeadlessFrame)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// What is shown, of `surfel_headless_prepare`.
    pub scene: *const SurfelPreparedScene,
    /// From where.
    pub camera: *const SurfelCamera,
    /// How; NULL: by the defaults. `background` is that of the picture; several `samples` of a pixel are taken one after the other.
    pub settings: *const SurfelSettings,
    /// The picture's size in pixels.
    pub width: u32,
    /// Its height.
    pub height: u32,
    /// Its pixels are linear 32-bit floats in place of 8-bit sRGB.
    pub linear: vk::Bool32,
    /// There is no picture: what is wanted is only drawn, or its surface.
    pub without_picture: vk::Bool32,
    /// The surface is wanted, too: weights, albedo, normals and depth.
    pub surface: vk::Bool32,
    /// What is measured, for `surfel_headless_measured`: `SURFEL_MEASURE_*`.
    pub measures: u32,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelHeadlessFrame {
    const TYPE: SurfelStructureType = SurfelStructureType::HeadlessFrame;
}

/// A picture that was drawn: row by row, the top one first. `surfel_headless_render` fills it; the arrays stay as they are until the next call of it with the same object, or that is destroyed. NULL is what was not wanted.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelPicture {
    /// `SURFEL_STRUCTURE_TYPE_PICTURE`.
    pub s_type: u32,
    /// `sizeof(SurfelPicture)`.
    pub size: u32,
    /// NULL.
    pub p_next: *mut c_void,
    /// Its size in pixels.
    pub width: u32,
    /// Its height.
    pub height: u32,
    /// Red, green, blue (sRGB) and alpha (linear, straight) of each pixel, for `surfel_save_png`.
    pub srgb: *const u8,
    /// The same as linear floats, for `surfel_save_exr`.
    pub linear: *const f32,
    /// The sum of weights of each pixel.
    pub weight: *const f32,
    /// Linear red, green and blue of each pixel before shading; the fourth is 1 where it is covered.
    pub albedo: *const f32,
    /// The unit normal in view space (x right, y down, z forward); the fourth is 1 where it is covered.
    pub normal: *const f32,
    /// The depth along the view's axis, infinite where there is nothing.
    pub depth: *const f32,
    /// Seconds from the submission to the end of the wait for it.
    pub wall_secs: f64,
    /// Seconds in which it was recorded.
    pub record_secs: f64,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelPicture {
    const TYPE: SurfelStructureType = SurfelStructureType::Picture;
}

/// As C is told of a picture.
pub fn picture_of(frame: &Frame) -> SurfelPicture {
    fn first<T, U>(all: &[T]) -> *const U {
        if all.is_empty() { std::ptr::null() } else { all.as_ptr().cast() }
    }
    let [width, height] = frame.size_px;
    SurfelPicture {
        s_type: 0,
        size: 0,
        p_next: std::ptr::null_mut(),
        width,
        height,
        srgb: first(&frame.srgb),
        linear: first(&frame.linear),
        weight: first(&frame.weight),
        albedo: first(&frame.albedo),
        normal: first(&frame.normal),
        depth: first(&frame.depth),
        wall_secs: frame.wall_secs,
        record_secs: frame.record_secs,
    }
}
