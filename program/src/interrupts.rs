//! Signals that end the program: nothing half-written stays behind.

use std::{
    fs,
    sync::{Arc, atomic::AtomicBool},
    thread,
};

use signal_hook::{
    consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ},
    flag,
    iterator::Signals,
    low_level::emulate_default_handler,
};
use surfel::save;

/// From now on a signal that ends the program first removes the files that it is writing; pictures that are whole stay. A file
/// that becomes larger than the system allows (SIGXFSZ) is an error of writing it, as a full disk is. Signals that the program
/// was started with as ignored, as `nohup` does, stay so.
pub fn watch() {
    // Where a signal can't be watched, it ends the program as it always did.
    let _ = flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false)));
    let ignored = ignored();
    let watched = [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0);
    let Ok(mut signals) = Signals::new(watched) else { return };
    thread::spawn(move || {
        if let Some(signal) = signals.forever().next() {
            save::remove_unfinished();
            // Whoever waits for the program sees which signal it was.
            let _ = emulate_default_handler(signal);
        }
    });
}

/// The signals that are ignored: bit `n - 1` for signal `n`. None where the system does not tell.
fn ignored() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}
