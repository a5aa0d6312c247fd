//! How frames are drawn, by words.

use std::ffi::c_char;

use surfel::{
    Error, Settings,
    scene::{OptionTable, Setting},
};

use crate::{
    handle::{Out, destroy, get, get_mut, text, told},
    result::{Result, SurfelResult, guard},
};

/// How frames are drawn.
pub struct SurfelSettings(pub Settings);

/// Makes settings: each has its default.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_settings_create(settings: *mut *mut SurfelSettings) -> SurfelResult {
    guard("surfel_settings_create", || {
        // SAFETY: the contract of the header.
        unsafe { Out::new(settings, "settings") }?.give(SurfelSettings(Settings::default()))
    })
}

/// Sets one to a value, both by the words of `surfel render --help` without the dashes, such as `shading` and `lambert`. `size` and
/// `background` have no effect: the frame's size and the host's picture take their place.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_settings_set(
    settings: *mut SurfelSettings,
    name: *const c_char,
    value: *const c_char,
) -> SurfelResult {
    guard("surfel_settings_set", || {
        // SAFETY: the contract of the header.
        let (settings, name, value) =
            unsafe { (get_mut(settings, "settings")?, text(name, "name")?, text(value, "value")?) };
        set(&mut settings.0, name, value)
    })
}

/// Tells the value of one, by the words that would set it: how many bytes they have in `length`, and of these, and a closing zero, at most `capacity` in `value`, the last one a zero; `value` may be NULL where
/// `capacity` is 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_settings_get(
    settings: *const SurfelSettings,
    name: *const c_char,
    value: *mut c_char,
    capacity: u64,
    length: *mut u64,
) -> SurfelResult {
    guard("surfel_settings_get", || {
        // SAFETY: the contract of the header, here and below.
        let (settings, name) = unsafe { (get(settings, "settings")?, text(name, "name")?) };
        let words = (setting::<Settings>(name)?.get)(&settings.0);
        // SAFETY: as above.
        unsafe { told(&words, (value, capacity, "value"), length) }
    })
}

/// The field of a table that is called so.
fn setting<T: OptionTable>(name: &str) -> Result<&'static Setting<T>> {
    T::OPTIONS.iter().find(|setting| setting.name == name).ok_or_else(|| {
        let names: Vec<_> = T::OPTIONS.iter().map(|setting| setting.name).collect();
        Error::option(name, format!("expected one of {}", names.join(", "))).into()
    })
}

/// Sets a field of a table by words; what is refused leaves it as it was.
pub fn set<T: OptionTable + Clone>(table: &mut T, name: &str, value: &str) -> Result<()> {
    let Setting { set, check, .. } = setting::<T>(name)?;
    let mut changed = table.clone();
    let done = set(&mut changed, value).map_err(|problem| format!("{value}: {problem}"));
    done.and_then(|()| check(&changed)).map_err(|problem| Error::option(name, problem))?;
    *table = changed;
    Ok(())
}

/// Destroys settings; NULL is nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_settings_destroy(settings: *mut SurfelSettings) {
    // SAFETY: the contract of the header.
    unsafe { destroy("surfel_settings_destroy", settings) };
}
