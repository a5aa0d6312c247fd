//! Whether there is a display, and what is missing where windows can't be opened.

use surfel::{ErrorKind, Result};

/// What to do instead.
const INSTEAD: &str = "surfel render draws to a file without one";

/// The libraries that a window under X11 takes from the system, with their packages on Debian.
const X_LIBRARIES: &[(&str, &str)] = &[
    ("libX11.so.6", "libx11-6"),
    ("libX11-xcb.so.1", "libx11-xcb1"),
    ("libXcursor.so.1", "libxcursor1"),
    ("libXi.so.6", "libxi6"),
    ("libxkbcommon.so.0", "libxkbcommon0"),
    ("libxkbcommon-x11.so.0", "libxkbcommon-x11-0"),
];

/// The same of a window under Wayland.
const WAYLAND_LIBRARIES: &[(&str, &str)] =
    &[("libwayland-client.so.0", "libwayland-client0"), ("libxkbcommon.so.0", "libxkbcommon0")];

/// Refuses where no window can be opened.
///
/// # Errors
/// [`ErrorKind::NoWindow`] without a display, or without a library, by its name.
pub fn check() -> Result<()> {
    if !cfg!(target_os = "linux") {
        return Ok(());
    }
    let is_set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let wayland = is_set("WAYLAND_DISPLAY") || is_set("WAYLAND_SOCKET");
    match missing(wayland, is_set("DISPLAY"), is_there) {
        Some(reason) => Err(ErrorKind::NoWindow { reason }.into()),
        None => Ok(()),
    }
}

/// The cause of an error that the window system told.
pub fn explain(told: &str) -> String {
    // Behind the place in winit's source that tells it.
    let cause = told.strip_prefix("os error at ").and_then(|told| told.split_once(": "));
    format!("{}; {INSTEAD}", cause.map_or(told, |(_, cause)| cause))
}

/// What is missing for a window.
fn missing(wayland: bool, x: bool, is_there: impl Fn(&str) -> bool) -> Option<String> {
    let (libraries, system) = match (wayland, x) {
        (true, _) => (WAYLAND_LIBRARIES, "Wayland"),
        (false, true) => (X_LIBRARIES, "X11"),
        (false, false) => {
            return Some(format!(
                "neither WAYLAND_DISPLAY nor DISPLAY is set, so there is no display; {INSTEAD}"
            ));
        }
    };
    let (missing, packages): (Vec<_>, Vec<_>) =
        libraries.iter().copied().filter(|(library, _)| !is_there(library)).unzip();
    if missing.is_empty() {
        return None;
    }
    let (missing, packages) = (missing.join(", "), packages.join(" "));
    Some(format!("{system} lacks {missing}; install {packages} (Debian's names), or {INSTEAD}"))
}

/// Whether the system's loader finds a library.
fn is_there(library: &str) -> bool {
    // SAFETY: loading a library of the window system runs its initializers, which the window does anyway.
    unsafe { libloading::Library::new(library) }.is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_is_named_with_what_to_install_or_to_do_instead() {
        let none = missing(false, false, |_| true).unwrap();
        assert!(none.contains("DISPLAY") && none.ends_with(INSTEAD), "{none}");
        assert_eq!(missing(false, true, |_| true), None);
        let library = missing(false, true, |name| name != "libxkbcommon-x11.so.0").unwrap();
        assert!(
            library.starts_with("X11 lacks libxkbcommon-x11.so.0; install libxkbcommon-x11-0 "),
            "{library}"
        );
        assert_eq!(
            explain("os error at /src/linux/mod.rs:788: No server: gone"),
            format!("No server: gone; {INSTEAD}")
        );
        assert_eq!(explain("no: reason"), format!("no: reason; {INSTEAD}"));
        let wayland = missing(true, true, |name| name != "libwayland-client.so.0").unwrap();
        assert!(wayland.starts_with("Wayland lacks libwayland-client.so.0;"), "{wayland}");
    }
}
