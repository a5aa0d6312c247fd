//! The device beside the window's, on which pictures are drawn before the window draws with other settings: the validation layer watches it, too, and nobody sees that a window that is closed waits for it.

use std::{
    thread,
    time::{Duration, Instant},
};

use x11rb::{
    connection::Connection as _,
    protocol::xproto::{ClientMessageEvent, ConnectionExt as _, EventMask, MapState},
};

use super::{
    CAMERA,
    faults::open_below,
    screen::Screen,
    window::{Folder, View, render},
};

const SIZE: [&str; 2] = ["--size", "320x240"];

/// A window on whose behalf the other device is at work, which does so in this way.
fn open<'a>(screen: &'a Screen, folder: &'a Folder, how: &str) -> View<'a> {
    let words = [&SIZE[..], &CAMERA].concat();
    let mut view = open_below(screen, folder, &words, ("SURFEL_ASIDE", how));
    view.wait_for(&render(folder, &words));
    // Planes take other pipelines.
    screen.key("X");
    view.wait("the other device is at work", |view| view.said().contains(&format!("aside: {how}")));
    view
}

#[test]
fn what_the_layer_says_of_the_device_beside_is_told() {
    let (screen, folder) = (Screen::new(), Folder::new());
    let view = open(&screen, &folder, "wrong");
    screen.key("ctrl+q");
    let said = view.wait_for_end();
    assert_eq!(said.code, 3, "{}", said.stderr);
    assert!(said.stderr.contains("vkResetFences"), "{}", said.stderr);
}

/// Asks a window to close, as a window manager does, and waits until it is on no screen any more.
fn close(display: &str, window: u32) {
    let (connection, _) = x11rb::connect(Some(display)).unwrap();
    let atom = |name: &str| connection.intern_atom(false, name.as_bytes()).unwrap().reply().unwrap().atom;
    let data = [atom("WM_DELETE_WINDOW"), 0, 0, 0, 0];
    let message = ClientMessageEvent::new(32, window, atom("WM_PROTOCOLS"), data);
    connection.send_event(false, window, EventMask::NO_EVENT, message).unwrap();
    connection.flush().unwrap();
    // A window that is destroyed has no attributes.
    let is_seen = || {
        let reply = connection.get_window_attributes(window).unwrap().reply();
        reply.is_ok_and(|attributes| attributes.map_state != MapState::UNMAPPED)
    };
    while is_seen() {
        thread::sleep(Duration::from_millis(5));
    }
}

/// The device beside is at work for four seconds more.
#[test]
fn a_window_that_is_closed_is_gone_before_the_device_beside_is_done() {
    let (screen, folder) = (Screen::new(), Folder::new());
    let view = open(&screen, &folder, "slow");
    let begun = Instant::now();
    close(screen.name(), view.number());
    let gone = begun.elapsed();
    let said = view.wait_for_end();
    let ended = begun.elapsed();
    println!("gone after {gone:?}, ended after {ended:?}");
    assert_eq!(said.code, 0, "{}", said.stderr);
    assert!(3 * gone < ended, "gone after {gone:?}, ended after {ended:?}");
}
