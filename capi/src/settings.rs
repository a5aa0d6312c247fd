//! How frames are drawn, by words.

use std::ffi::c_char;

use surfel::{
    Error, Settings,
    scene::{OptionTable, Setting},
};

use crate::{
    handle::{Out, destroy, get_mut, text},
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

/// Sets a field of a table by words; what is refused leaves it as it was.
pub fn set<T: OptionTable + Clone>(table: &mut T, name: &str, value: &str) -> Result<()> {
    let Some(setting) = T::OPTIONS.iter().find(|setting| setting.name == name) else {
        let names: Vec<_> = T::OPTIONS.iter().map(|setting| setting.name).collect();
        return Err(Error::option(name, format!("expected one of {}", names.join(", "))).into());
    };
    let Setting { set, check, .. } = setting;
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
