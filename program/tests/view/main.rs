//! The window, in a real X server: what it shows is what `surfel render` writes, whatever happens to it, without a word of the validation
//! layer. Needs Xvfb and xdotool (`third_party/with-deps` installs them) and a Vulkan device that presents to X11, such as lavapipe.

mod aside;
mod clipboard;
mod copies;
mod drag;
mod edits;
mod faults;
mod hand;
mod paged;
mod random;
mod rest;
mod screen;
mod soak;
mod steps;
mod wheel;
mod window;

use std::time::Duration;

use edits::BESIDE;
use random::{KEYS, Random};
use screen::Screen;
use window::{Folder, View, render, surfel};

/// A camera that is the same in windows of any size.
const CAMERA: [&str; 6] = ["--eye", "0.7,0.9,3", "--target", "0.05,0,0", "--fov", "45"];

#[test]
fn the_window_shows_what_render_writes_before_and_after_it_is_turned() {
    let (screen, folder) = (Screen::new(), Folder::new());
    let mut view = View::open(&screen, &folder, &[&["--size", "320x240"], &CAMERA[..]].concat());
    view.wait_for(&render(&folder, &[&["--size", "320x240"], &CAMERA[..]].concat()));
    let before = screen.shot([320, 240]);
    screen.drag([160, 120], [210, 100], 1);
    screen.drag([100, 100], [90, 120], 3);
    screen.drive(&["click", "--repeat", "3", "4"]);
    let words = view.camera();
    let turned = render(
        &folder,
        &[&["--size", "320x240"], &words.iter().map(String::as_str).collect::<Vec<_>>()[..]].concat(),
    );
    view.wait_for(&turned);
    assert!(screen.shot([320, 240]).differs_from(&before) > 10_000);
    // A method by key, and back.
    screen.key("v");
    view.wait_until("another shading is shown", |shot| shot.differs_from(&turned) > 10_000);
    screen.key("V");
    view.wait_for(&turned);
    view.end();
}

#[test]
fn a_window_that_is_resized_200_times_shows_the_picture_of_its_last_size() {
    let (screen, folder) = (Screen::new(), Folder::new());
    let mut view = View::open(&screen, &folder, &[&["--size", "200x150"], &CAMERA[..]].concat());
    view.wait_for(&render(&folder, &[&["--size", "200x150"], &CAMERA[..]].concat()));
    let mut random = Random(7);
    for _ in 0..200 {
        let [width, height] = [1 + random.below(500), 1 + random.below(400)];
        view.resize([width, height]);
        std::thread::sleep(Duration::from_millis(u64::from(random.below(25))));
    }
    view.resize([257, 131]);
    view.wait_for(&render(&folder, &[&["--size", "257x131"], &CAMERA[..]].concat()));
    view.end();
}

#[test]
fn every_key_does_its_work_without_a_message() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 400);
    let mut view = View::open(&screen, &folder, &["a.ply", "--size", "400x300", "--samples", "4"]);
    view.wait_until("something is shown", |shot| shot.colors() > 20);
    screen.drive(&["mousemove", "200", "150"]);
    let keys = "1 2 3 4 5 6 7 f h u u t t p p r r r R g g G k n b b v V l L bracketleft bracketright m m m period comma \
                y r x z space space c C i o o question question N H less greater H F1 Escape F5 w s a d q e j j Return 1 Return K slash BackSpace";
    for key in keys.split_whitespace() {
        screen.key(key);
        std::thread::sleep(Duration::from_millis(40));
    }
    screen.drive(&["click", "--repeat", "2", "--delay", "40", "1"]);
    view.wait_until("the surface is still shown", |shot| shot.colors() > 20);
    screen.key("i");
    let picture = view.wait_for_file("surfel-002.png");
    assert_eq!(picture.size, [400, 300]);
    // The path that was recorded makes pictures.
    let words = ["a.ply", "--size", "32x32", "--path", "surfel-path-001.json", "--frames", "3"];
    let film = surfel(&folder, &[&["render", "-o", "film%02d.png"], &words[..]].concat(), &[]);
    assert_eq!(film.code, 0, "{}", film.stderr);
    let said = view.end();
    assert!(said.stdout.contains("--eye ") && said.stdout.contains("\"fov_deg\":45"), "{}", said.stdout);
}

#[test]
fn a_file_that_changes_is_read_again_and_one_that_breaks_changes_nothing() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 400);
    let words = [&["a.ply", "--size", "200x200"], &CAMERA[..]].concat();
    let mut view = View::open(&screen, &folder, &words);
    let first = render(&folder, &words);
    view.wait_for(&first);
    folder.splats("a.ply", 60);
    let second = render(&folder, &words);
    assert!(second.differs_from(&first) > 1000);
    view.wait_for(&second);
    folder.write("a.ply", "ply\nformat ascii 1.0\nelement vertex 9\n");
    view.wait_until("what is wrong is told", |shot| shot.differs_from(&second) > 500);
    screen.key("Escape");
    view.wait_for(&second);
    view.end();
}

#[test]
fn files_that_are_dropped_take_the_place_of_the_scene_and_a_path_that_is_dropped_is_played() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 400);
    folder.splats("with a space.ply", 60);
    let cameras = r#"{"time": 0, "eye": [1, 1, 3], "target": [0, 0, 0], "up": [0, 1, 0], "fov_deg": 45}"#;
    folder.write("path.json", &format!(r#"{{"version": 1, "cameras": [{cameras}]}}"#));
    let words = |file| [&[file, "--size", "200x200"], &CAMERA[..]].concat();
    let mut view = View::open(&screen, &folder, &words("a.ply"));
    view.wait_for(&render(&folder, &words("a.ply")));
    assert!(drag::is_aware(screen.name(), view.number()));
    drag::drop_on(screen.name(), view.number(), &[&folder.path("with%20a%20space.ply")]);
    let second = render(&folder, &words("with a space.ply"));
    view.wait_for(&second);
    drag::drop_on(screen.name(), view.number(), &[&folder.path("path.json")]);
    view.wait("the path is told", |view| view.said().contains("path.json: a path of 1 place;"));
    view.wait_until("it is seen", |shot| shot.differs_from(&second) > 100);
    screen.key("slash");
    screen.key("Escape");
    let at = ["with a space.ply", "--size", "200x200", "--eye", "1,1,3", "--target", "0,0,0", "--fov", "45"];
    view.wait_for(&render(&folder, &at));
    view.end();
}

#[test]
fn the_panel_hides_a_thing_and_shows_it_again() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 400);
    let words = [&["a.ply", "--size", "640x300"], &CAMERA[..]].concat();
    let mut view = View::open(&screen, &folder, &words);
    let shown = render(&folder, &words);
    view.wait_for(&shown);
    screen.key("o");
    view.wait_until("the panel is shown", |shot| shot.differs_from(&shown) > 10_000);
    // The box before the first thing.
    screen.drive(&["mousemove", "358", "36"]);
    std::thread::sleep(Duration::from_millis(200));
    screen.drive(&["click", "1"]);
    view.wait_until("the thing is gone", |shot| shot.corner(BESIDE).colors() < 3);
    // The panel is hidden at once, and has heard of the click nevertheless.
    screen.drive(&["click", "1", "key", "o"]);
    screen.drive(&["mousemove", "20", "20"]);
    view.wait_for(&shown);
    view.end();
}

#[test]
fn random_input_ends_in_a_window_that_goes_home() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 2000);
    let words = [&["a.ply", "--size", "300x200"], &CAMERA[..]].concat();
    let mut view = View::open(&screen, &folder, &words);
    let home = render(&folder, &words);
    view.wait_for(&home);
    view.play_at_random(&mut Random(3), Duration::from_secs(5), KEYS);
    assert!(view.is_running());
    view.end();
}

#[test]
fn without_a_display_the_program_says_what_to_do() {
    let folder = Folder::new();
    let none =
        surfel(&folder, &["view"], &[("DISPLAY", ""), ("WAYLAND_DISPLAY", ""), ("WAYLAND_SOCKET", "")]);
    assert_eq!(none.code, 2, "{}", none.stderr);
    let line = "surfel: no window can be opened: neither WAYLAND_DISPLAY nor DISPLAY is set, so there is no display; surfel render draws to a \
                file without one\n";
    assert_eq!(none.stderr, line);
    let dead = surfel(&folder, &["view"], &[("DISPLAY", ":4999"), ("WAYLAND_DISPLAY", "")]);
    assert_eq!(dead.code, 2, "{}", dead.stderr);
    let lines: Vec<_> = dead.stderr.lines().collect();
    assert!(lines.len() == 1 && lines[0].starts_with("surfel: no window can be opened: "), "{}", dead.stderr);
    assert!(lines[0].contains("surfel render") && !lines[0].contains(".rs"), "{}", dead.stderr);
}

/// The system's loader stops at a file of that name that is none of its own.
#[test]
fn a_library_that_is_missing_is_named() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.write("libXcursor.so.1", "");
    let libraries = folder.path("").display().to_string();
    let environment = [
        ("DISPLAY", screen.name()),
        ("WAYLAND_DISPLAY", ""),
        ("WAYLAND_SOCKET", ""),
        ("LD_LIBRARY_PATH", &libraries),
    ];
    let run = surfel(&folder, &["view"], &environment);
    let line = "surfel: no window can be opened: X11 lacks libXcursor.so.1; install libxcursor1 (Debian's names), or surfel render draws to a \
                file without one\n";
    assert_eq!((run.code, &*run.stderr), (2, line));
}

#[test]
fn files_that_cannot_be_read_end_it_as_they_end_render() {
    let (screen, folder) = (Screen::new(), Folder::new());
    let environment = [("DISPLAY", screen.name()), ("WAYLAND_DISPLAY", "")];
    let run = surfel(&folder, &["view", "none.ply"], &environment);
    let rendered = surfel(&folder, &["render", "none.ply"], &[]);
    assert_eq!((run.code, run.stderr), (1, rendered.stderr));
}
