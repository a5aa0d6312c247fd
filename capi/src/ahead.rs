//! Pipelines ahead of the frames that need them.

use crate::{
    frame::{SceneList, SurfelFrame, with_frame},
    handle::{Place, get},
    renderer::SurfelRenderer,
    result::{SurfelResult, guard},
    structs::read,
    view::{SurfelRendering, rendering_of},
};

/// Tells how many pipelines a renderer has made so far: a frame during which that stays the same has made none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_pipelines_made(
    renderer: *const SurfelRenderer,
    made: *mut u64,
) -> SurfelResult {
    guard("surfel_pipelines_made", || {
        // SAFETY: the contract of the header.
        let (renderer, made) = unsafe { (get(renderer, "renderer")?, Place::new(made, "made")?) };
        made.write(renderer.renderer.pipelines_made());
        Ok(())
    })
}

/// Makes all pipelines that frames like this need within such a rendering, wherever their cameras are: `surfel_view_prepare` makes none for
/// them then. Nothing is recorded. `made` gets how many were missing; it may be NULL. It may take long: while the host loads, or on a thread
/// of its own, while others draw with what is there. A frame is like this that shows scenes of the same kinds (opaque or transparent, disks
/// or ellipses, closed or not, packed or not, with clip curves, levels of detail, polygons or lights, all of this or none), no more objects and splats of
/// each, tinted or not as here; by the same settings, but for a budget, clip planes that are other ones, and a picture of this size or a
/// smaller one; with a camera of the same projection, perspective or parallel, anywhere: from far off, where a splat is less than a pixel, to
/// among splats that are larger than the picture; and with `hides` as here.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_compile_ahead(
    renderer: *const SurfelRenderer,
    rendering: *const SurfelRendering,
    frame: *const SurfelFrame,
    made: *mut u64,
) -> SurfelResult {
    guard("surfel_compile_ahead", || {
        // SAFETY: the contract of the header, here and below.
        let (renderer, frame) = unsafe { (get(renderer, "renderer")?, read(frame, "frame")?) };
        // SAFETY: as above.
        let rendering = unsafe { rendering_of(&read(rendering, "rendering")?) }?;
        let place = match made.is_null() {
            true => None,
            // SAFETY: as above.
            false => Some(unsafe { Place::new(made, "made") }?),
        };
        let mut count = 0;
        // SAFETY: as above.
        unsafe {
            with_frame(&frame, &mut SceneList::default(), |frame| {
                count = renderer.renderer.compile_ahead(&rendering, frame)?;
                Ok(())
            })
        }?;
        if let Some(place) = place {
            place.write(count);
        }
        Ok(())
    })
}
