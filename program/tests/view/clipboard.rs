//! What is in the clipboard of an X server, as a program reads it that something is pasted into.

use x11rb::{
    COPY_DEPTH_FROM_PARENT, CURRENT_TIME,
    connection::Connection as _,
    protocol::{
        Event,
        xproto::{AtomEnum, ConnectionExt as _, CreateWindowAux, WindowClass},
    },
};

/// The text that was copied last, if there is one.
pub fn text(display: &str) -> Option<String> {
    let (connection, screen) = x11rb::connect(Some(display)).unwrap();
    let root = connection.setup().roots[screen].root;
    let window = connection.generate_id().unwrap();
    let (class, how) = (WindowClass::INPUT_OUTPUT, CreateWindowAux::new());
    connection.create_window(COPY_DEPTH_FROM_PARENT, window, root, 0, 0, 1, 1, 0, class, 0, &how).unwrap();
    let atom = |name: &str| connection.intern_atom(false, name.as_bytes()).unwrap().reply().unwrap().atom;
    let (clipboard, kind, property) = (atom("CLIPBOARD"), atom("UTF8_STRING"), atom("PASTED"));
    connection.convert_selection(window, clipboard, kind, property, CURRENT_TIME).unwrap();
    connection.flush().unwrap();
    loop {
        if let Event::SelectionNotify(told) = connection.wait_for_event().unwrap() {
            if told.property == x11rb::NONE {
                return None;
            }
            let held = connection.get_property(true, window, property, AtomEnum::ANY, 0, 1 << 16).unwrap();
            return String::from_utf8(held.reply().unwrap().value).ok();
        }
    }
}
