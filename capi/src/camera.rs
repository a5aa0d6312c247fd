//! A camera by where it is and what it looks at.

use std::ffi::c_void;

use surfel::{
    glam::DVec3,
    scene::{Ball, Camera, Window},
};

use crate::{
    arrays::array,
    result::{Result, SurfelResult, guard},
    structs::{Struct, SurfelStructureType, write},
};

/// A camera by its eye and what it looks at, for `surfel_headless_render`: a host with a frame of its own has matrices (`SurfelFrame`).
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelCamera {
    /// `SURFEL_STRUCTURE_TYPE_CAMERA`.
    pub s_type: u32,
    /// `sizeof(SurfelCamera)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// The eye, x, y, z.
    pub eye: [f64; 3],
    /// The point in the middle of the picture, another one than the eye.
    pub target: [f64; 3],
    /// The direction that is up in the picture; all 0: +y.
    pub up: [f64; 3],
    /// The vertical field of view in radians; 0: 45 degrees.
    pub fov_y_rad: f64,
    /// The height of the whole picture in the world's unit: rays are parallel, and the field of view means nothing. 0: they meet in the eye.
    pub orthographic_height: f64,
    /// The depth of the near plane, in front of which nothing is drawn; 0: a millionth of the distance from eye to target, or the eye where rays are parallel.
    pub near: f64,
    /// Of a picture in pieces, the size of the whole in pixels, of which this is the camera; 0: what is drawn is the whole.
    pub whole_width: u32,
    /// Its height.
    pub whole_height: u32,
    /// Where the corner of the piece lies in the whole, in pixels.
    pub corner_px: [f64; 2],
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelCamera {
    const TYPE: SurfelStructureType = SurfelStructureType::Camera;
}

/// The camera that C means.
pub fn camera_of(given: &SurfelCamera) -> Camera {
    let or = |given: f64, usual: f64| if given == 0.0 { usual } else { given };
    let some = |given: f64| (given != 0.0).then_some(given);
    let whole = [given.whole_width, given.whole_height];
    Camera {
        eye: given.eye.into(),
        target: given.target.into(),
        up: if given.up == [0.0; 3] { DVec3::Y } else { given.up.into() },
        fov_y_rad: or(given.fov_y_rad, Camera::DEFAULT_FOV_Y_RAD),
        orthographic_height: some(given.orthographic_height),
        near: some(given.near),
        window: Window { whole_px: (whole != [0; 2]).then_some(whole), corner_px: given.corner_px },
    }
}

/// Fills a camera that shows all of a ball (`surfel_scene_ball`) in a picture of this size, looking along -z with +y up. `fovYRad` is its vertical field of view; 0: 45 degrees.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_camera_fit(
    center: *const f64,
    radius: f64,
    width: u32,
    height: u32,
    fov_y_rad: f64,
    camera: *mut SurfelCamera,
) -> SurfelResult {
    guard("surfel_camera_fit", || {
        // SAFETY: the contract of the header, here and below.
        let center = unsafe { array(center.cast::<[f64; 3]>(), 1, "center") }?[0];
        let fov_y_rad = if fov_y_rad == 0.0 { Camera::DEFAULT_FOV_Y_RAD } else { fov_y_rad };
        let made = Camera::fit(&Ball { center: center.into(), radius }, [width, height], fov_y_rad);
        made.validate()?;
        // SAFETY: as above.
        unsafe { fill(camera, &made) }
    })
}

/// # Safety
/// As [`write`].
pub unsafe fn fill(camera: *mut SurfelCamera, made: &Camera) -> Result<()> {
    let [whole_width, whole_height] = made.window.whole_px.unwrap_or_default();
    let filled = SurfelCamera {
        s_type: 0,
        size: 0,
        p_next: std::ptr::null(),
        eye: made.eye.to_array(),
        target: made.target.to_array(),
        up: made.up.to_array(),
        fov_y_rad: made.fov_y_rad,
        orthographic_height: made.orthographic_height.unwrap_or(0.0),
        near: made.near.unwrap_or(0.0),
        whole_width,
        whole_height,
        corner_px: made.window.corner_px,
    };
    // SAFETY: this function's contract.
    unsafe { write(camera, "camera", &filled) }
}
