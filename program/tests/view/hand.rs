//! How soon the window answers to a hand that turns a large scene: `cargo test --release --test view -- a_hand --ignored --nocapture --test-threads 1`, of 1.4 million disks, on a machine that does
//! nothing else; by `chrt -f 1` on one that does. The program keeps what Mesa has compiled in a new folder.

use std::{
    env, fs,
    path::Path,
    thread,
    time::{Duration, Instant},
};

use x11rb::{
    connection::Connection as _,
    protocol::{
        xproto::{BUTTON_PRESS_EVENT, BUTTON_RELEASE_EVENT, MOTION_NOTIFY_EVENT},
        xtest::ConnectionExt as _,
    },
};

use super::{
    rest::cube,
    screen::Screen,
    window::{Folder, View, surfel},
};

/// Frames a second while it moves.
const LEAST_RATE: f64 = 20.0;

/// From the release of the button to the last change that is seen.
const MOST: Duration = Duration::from_millis(200);

/// How long a drag takes, what is looked at after it, and how long the hand rests then.
const DRAG: Duration = Duration::from_secs(3);
const AFTER: Duration = Duration::from_secs(2);
const PAUSE: Duration = Duration::from_secs(4);
const DRAGS: u32 = 6;

/// A hand moves, and the middle of the screen is looked at, so often.
const STEP: Duration = Duration::from_millis(3);

/// Another device compiles meanwhile, what moves becomes coarser and finer, and memory that a window at rest has given back is taken again: in each drag the picture follows.
#[test]
#[ignore = "takes two minutes, and times: by hand, on a quiet machine"]
fn a_hand_that_turns_a_large_scene_is_followed_and_then_all_of_it_comes() {
    let (screen, folder) = (Screen::new(), Folder::new());
    let model = env::var_os("SURFEL_DATA").map(|data| Path::new(&data).join("igea.ply"));
    let model = model.filter(|file| file.exists()).unwrap_or_else(|| {
        cube(&folder, "cube.obj");
        folder.path("cube.obj")
    });
    let words = ["convert", model.to_str().unwrap(), "large.ply", "--resample", "1.4M"];
    assert_eq!(surfel(&folder, &words, &[]).code, 0);
    fs::create_dir(folder.path("cache")).unwrap();
    let cache = folder.path("cache");
    let environment = [("MESA_SHADER_CACHE_DIR", cache.to_str().unwrap())];
    let words = ["large.ply", "--size", "1024x1024", "--print-frames"];
    let mut view = View::open_in(&screen, &folder, &words, false, &environment);
    view.wait("something is shown", |view| view.printed().contains("whole"));
    view.wait_for_hidden(8);
    let (connection, screen_number) = x11rb::connect(Some(screen.name())).unwrap();
    let root = connection.setup().roots[screen_number].root;
    let send = |kind, detail, [x, y]: [f64; 2]| {
        connection.xtest_fake_input(kind, detail, 0, root, x as i16, y as i16, 0).unwrap();
        connection.flush().unwrap();
    };
    let look = || screen.square([464, 464], 96);
    let mut seen = Vec::new();
    for number in 0..DRAGS {
        let from = [400.0 + 20.0 * f64::from(number), 500.0];
        send(MOTION_NOTIFY_EVENT, 0, from);
        send(BUTTON_PRESS_EVENT, 1, from);
        let (begun, mut before, mut changes) = (Instant::now(), look(), 0);
        while begun.elapsed() < DRAG {
            let secs = begun.elapsed().as_secs_f64();
            let to = [from[0] + 150.0 * (2.0 * secs).sin(), from[1] + 60.0 * (3.0 * secs).sin()];
            send(MOTION_NOTIFY_EVENT, 0, to);
            thread::sleep(STEP);
            let now = look();
            changes += u32::from(now != before);
            before = now;
        }
        send(BUTTON_RELEASE_EVENT, 1, [0.0; 2]);
        let (released, mut last) = (Instant::now(), Duration::ZERO);
        while released.elapsed() < AFTER {
            thread::sleep(STEP);
            let now = look();
            if now != before {
                (before, last) = (now, released.elapsed());
            }
        }
        let rate = f64::from(changes) / DRAG.as_secs_f64();
        println!("{rate:.1} changes a second, the last one {} ms after the release", last.as_millis());
        seen.push((rate, last));
        thread::sleep(PAUSE);
    }
    view.end();
    assert!(seen.iter().all(|(rate, last)| *rate >= LEAST_RATE && *last <= MOST), "{seen:?}");
}
