//! What the passes of a view's frame cost.

use std::ffi::{c_char, c_void};

use surfel::embed::PassFigures;

use crate::{
    handle::{Place, get, null},
    result::{Result, SurfelResult, guard},
    view::SurfelView,
};

/// Is told of a pass: its name, valid during the call, and its seconds, below 0 where they were not measured. Must return.
pub type SurfelPassTime = Option<unsafe extern "C" fn(user: *mut c_void, name: *const c_char, secs: f64)>;

/// Tells how long each pass took of the frame that was prepared last, in their order, once it has finished; nothing if it was not `timed`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_view_times(
    view: *const SurfelView,
    each: SurfelPassTime,
    user: *mut c_void,
) -> SurfelResult {
    guard("surfel_view_times", || {
        // SAFETY: the contract of the header, here and below.
        let view = unsafe { get(view, "view") }?;
        let each = each.ok_or_else(|| null("each"))?;
        // SAFETY: as above: the frame has finished.
        let tell = |pass: PassFigures<'_>| unsafe {
            each(user, in_place(pass.name).as_ptr().cast(), pass.secs.unwrap_or(-1.0));
        };
        // SAFETY: as above.
        unsafe { view.view.each_pass(tell) }?;
        Ok(())
    })
}

/// What a pass cost.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelPassFigures {
    /// Its name, as UTF-8, valid during the call.
    pub name: *const c_char,
    /// Its seconds; below 0 where they were not measured.
    pub secs: f64,
    /// Invocations of its vertex stage; `UINT64_MAX` where they were not counted, or it doesn't draw.
    pub vertices: u64,
    /// Those of its fragment stage alike.
    pub fragments: u64,
    /// Those of its compute stage; `UINT64_MAX` where they were not counted, or it doesn't dispatch.
    pub invocations: u64,
}

/// Is told of a pass, by figures that are valid during the call. Must return.
pub type SurfelPassMeasured =
    Option<unsafe extern "C" fn(user: *mut c_void, figures: *const SurfelPassFigures)>;

/// Tells what each pass cost of the frame that was prepared last, in their order, once it has finished, as `measures` in `SurfelFrame` asked for; and the frame's own seconds in `spanSecs`, which may be NULL, below 0 where
/// they were not measured. Takes nothing from the heap.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_view_measured(
    view: *const SurfelView,
    each: SurfelPassMeasured,
    user: *mut c_void,
    span_secs: *mut f64,
) -> SurfelResult {
    guard("surfel_view_measured", || {
        // SAFETY: the contract of the header, here and below.
        let view = unsafe { get(view, "view") }?;
        let each = each.ok_or_else(|| null("each"))?;
        // SAFETY: as above.
        let tell = |pass: PassFigures<'_>| unsafe { tell(each, user, pass) };
        // SAFETY: as above: the frame has finished.
        let span = unsafe { view.view.each_pass(tell) }?;
        // SAFETY: as above.
        unsafe { tell_span(span_secs, span) }
    })
}

/// Tells one of C's functions of a pass.
///
/// # Safety
/// The contract of the header.
pub unsafe fn tell(
    each: unsafe extern "C" fn(*mut c_void, *const SurfelPassFigures),
    user: *mut c_void,
    pass: PassFigures<'_>,
) {
    let name = in_place(pass.name);
    let figures = SurfelPassFigures {
        name: name.as_ptr().cast(),
        secs: pass.secs.unwrap_or(-1.0),
        vertices: pass.counts.map_or(u64::MAX, |counts| counts.vertices),
        fragments: pass.counts.map_or(u64::MAX, |counts| counts.fragments),
        invocations: pass.invocations.unwrap_or(u64::MAX),
    };
    // SAFETY: this function's contract.
    unsafe { each(user, &raw const figures) };
}

/// # Safety
/// `span_secs` is NULL, not aligned, or may be written.
pub unsafe fn tell_span(span_secs: *mut f64, span: Option<f64>) -> Result<()> {
    if !span_secs.is_null() {
        // SAFETY: this function's contract.
        unsafe { Place::new(span_secs, "spanSecs") }?.write(span.unwrap_or(-1.0));
    }
    Ok(())
}

/// A name as C has it, without memory of the heap; none of ours is longer.
fn in_place(name: &str) -> [u8; 128] {
    let mut bytes = [0; 128];
    let most = name.len().min(bytes.len() - 1);
    let end = (0..=most).rev().find(|end| name.is_char_boundary(*end)).unwrap_or(0);
    bytes[..end].copy_from_slice(&name.as_bytes()[..end]);
    bytes
}
