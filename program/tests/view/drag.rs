//! Files that are dragged from another program: the protocol XDND, version 5, as a file manager speaks it.

use std::{io::Write as _, path::Path, process::Stdio};

use x11rb::{
    COPY_DEPTH_FROM_PARENT, CURRENT_TIME,
    connection::Connection as _,
    protocol::{
        Event,
        xproto::{
            AtomEnum, ClientMessageEvent, ConnectionExt as _, CreateWindowAux, EventMask, PropMode,
            SELECTION_NOTIFY_EVENT, SelectionNotifyEvent, WindowClass,
        },
    },
    wrapper::ConnectionExt as _,
};

use super::{
    CAMERA,
    screen::Screen,
    window::{Folder, View, render},
};

/// Drags files from a window of its own and drops them on another window, by its number.
pub fn drop_on(display: &str, target: u32, files: &[&Path]) {
    let (connection, screen) = x11rb::connect(Some(display)).unwrap();
    let root = connection.setup().roots[screen].root;
    let source = connection.generate_id().unwrap();
    connection
        .create_window(
            COPY_DEPTH_FROM_PARENT,
            source,
            root,
            0,
            0,
            1,
            1,
            0,
            WindowClass::INPUT_OUTPUT,
            0,
            &CreateWindowAux::new(),
        )
        .unwrap();
    let atom = |name: &str| connection.intern_atom(false, name.as_bytes()).unwrap().reply().unwrap().atom;
    let (selection, list) = (atom("XdndSelection"), atom("text/uri-list"));
    connection.set_selection_owner(source, selection, CURRENT_TIME).unwrap();
    let send = |kind: &str, [a, b, c, d]: [u32; 4]| {
        let message = ClientMessageEvent::new(32, target, atom(kind), [source, a, b, c, d]);
        connection.send_event(false, target, EventMask::NO_EVENT, message).unwrap();
        connection.flush().unwrap();
    };
    send("XdndEnter", [5 << 24, list, 0, 0]);
    send("XdndPosition", [0, 40 << 16 | 40, CURRENT_TIME, atom("XdndActionCopy")]);
    let text: String = files.iter().map(|file| format!("file://{}\r\n", file.display())).collect();
    let (status, finished) = (atom("XdndStatus"), atom("XdndFinished"));
    let (mut is_given, mut is_accepted, mut is_dropped) = (false, false, false);
    loop {
        match connection.wait_for_event().unwrap() {
            Event::SelectionRequest(asked) => {
                connection
                    .change_property8(
                        PropMode::REPLACE,
                        asked.requestor,
                        asked.property,
                        list,
                        text.as_bytes(),
                    )
                    .unwrap();
                let told = SelectionNotifyEvent {
                    response_type: SELECTION_NOTIFY_EVENT,
                    sequence: 0,
                    time: asked.time,
                    requestor: asked.requestor,
                    selection: asked.selection,
                    target: asked.target,
                    property: asked.property,
                };
                connection.send_event(false, asked.requestor, EventMask::NO_EVENT, told).unwrap();
                connection.flush().unwrap();
                is_given = true;
            }
            Event::ClientMessage(message) if message.type_ == status => {
                is_accepted = message.data.as_data32()[1] & 1 == 1;
            }
            Event::ClientMessage(message) if message.type_ == finished => return,
            _ => {}
        }
        if is_given && is_accepted && !is_dropped {
            send("XdndDrop", [0, CURRENT_TIME, 0, 0]);
            is_dropped = true;
        }
    }
}

/// The window accepts them: it says that it knows the protocol.
pub fn is_aware(display: &str, target: u32) -> bool {
    let (connection, _) = x11rb::connect(Some(display)).unwrap();
    let aware = connection.intern_atom(false, b"XdndAware").unwrap().reply().unwrap().atom;
    let property =
        connection.get_property(false, target, aware, AtomEnum::ANY, 0, 1).unwrap().reply().unwrap();
    property.value_len > 0
}

/// The first is standard input, which ends when the test wants it.
#[test]
fn a_file_that_is_dropped_while_the_first_is_read_comes_behind_it() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 400);
    let words = |file| [&[file, "--size", "200x200"], &CAMERA[..]].concat();
    let mut view = View::open_fed(&screen, &folder, &words("-"), (true, &[]), Stdio::piped());
    let mut input = view.take_input();
    drop_on(screen.name(), view.number(), &[&folder.path("a.ply")]);
    input.write_all(b"ply\nno more").unwrap();
    drop(input);
    // What can't be read does not end the window: it has something else to show.
    view.wait("it is told", |view| view.said().contains("standard input"));
    screen.key("Escape");
    view.wait_for(&render(&folder, &words("a.ply")));
    view.end();
}
