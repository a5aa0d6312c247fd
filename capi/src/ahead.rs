//! Pipelines ahead of the frames that need them.

use crate::{
    frame::{SceneList, SurfelFrame, with_frame},
    handle::{Place, get},
    renderer::SurfelRenderer,
    result::{SurfelResult, guard},
    structs::read,
    view::{SurfelRendering, rendering_of},
};

/// Makes the pipelines that a frame like this needs within such a rendering: `surfel_view_prepare` makes none for it then. Nothing is
/// recorded. `made` gets how many were missing; it may be NULL. It may take long: while the host loads, or on a thread of its own, while
/// others draw with what is there. A frame is like this with the same settings, showing what is of the same kind (opaque or transparent,
/// disks or ellipses, closed or not, packed or not, polygons, lights), of about as many splats, and as near where they are large.
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
                count = renderer.0.compile_ahead(&rendering, frame)?;
                Ok(())
            })
        }?;
        if let Some(place) = place {
            place.write(count);
        }
        Ok(())
    })
}
