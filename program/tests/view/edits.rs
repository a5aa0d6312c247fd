//! Cuts, outlines, paths, and what is written into the panel.

use std::{thread, time::Duration};

use super::{
    CAMERA,
    rest::cube,
    screen::{Screen, Shot},
    window::{Folder, View, render, surfel},
};

fn words<'w>(copied: &'w [String], others: &[&'w str]) -> Vec<&'w str> {
    others.iter().copied().chain(copied.iter().map(String::as_str)).collect()
}

#[test]
fn cuts_and_outlines_by_key_are_those_of_render_and_all_of_it_goes_back() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 400);
    let first = [&["a.ply", "--size", "320x240"], &CAMERA[..]].concat();
    let mut view = View::open(&screen, &folder, &first);
    let whole = render(&folder, &first);
    view.wait_for(&whole);
    screen.key("X");
    screen.key("equal");
    let cut = view.camera();
    assert!(cut.iter().any(|word| word == "--clip-plane"), "{cut:?}");
    let of = |cut: &[String]| render(&folder, &words(cut, &["a.ply", "--size", "320x240"]));
    assert!(of(&cut).differs_from(&whole) > 5000);
    view.wait_for(&of(&cut));
    screen.key("B");
    screen.key("minus");
    let in_box = view.camera();
    assert!(in_box.iter().any(|word| word == "--clip-box"), "{in_box:?}");
    view.wait_for(&of(&in_box));
    screen.key("B");
    screen.key("O");
    screen.key("Escape");
    let outlined = render(&folder, &[&first[..], &["--outlines", "splats"]].concat());
    assert!(outlined.differs_from(&whole) > 5000);
    view.wait_for(&outlined);
    for key in ["v", "k", "n", "X", "m", "bracketright", "x", "0", "Escape"] {
        screen.key(key);
    }
    view.wait_for(&whole);
    view.end();
}

/// Its sides would else lie in those of the cube, of which they would leave a part at random.
#[test]
fn a_box_around_all_of_a_cube_cuts_nothing() {
    let (screen, folder) = (Screen::new(), Folder::new());
    cube(&folder, "a.obj");
    let first = [&["a.obj", "--size", "320x240"], &CAMERA[..]].concat();
    let mut view = View::open(&screen, &folder, &first);
    let whole = render(&folder, &first);
    view.wait_for(&whole);
    screen.key("B");
    let cut = view.camera();
    assert!(cut.iter().any(|word| word == "--clip-box"), "{cut:?}");
    let boxed = render(&folder, &words(&cut, &["a.obj", "--size", "320x240"]));
    // Pixels of its edges may be rounded otherwise.
    assert!(boxed.differs_from(&whole) < 10, "{}", boxed.differs_from(&whole));
    view.wait_for(&boxed);
    view.end();
}

#[test]
fn a_path_from_a_file_is_played_to_its_end() {
    let (screen, folder) = (Screen::new(), Folder::new());
    let place = |time: f64, x: f64| {
        format!(
            r#"{{"time": {time}, "eye": [{x}, 0.5, 3], "target": [0, 0, 0], "up": [0, 1, 0], "fov_deg": 45}}"#
        )
    };
    let places = [place(10.0, 0.0), place(10.5, 1.5)].join(", ");
    folder.write("path.json", &format!(r#"{{"version": 1, "cameras": [{places}]}}"#));
    let first = [&["--size", "200x150", "--path", "path.json"], &CAMERA[..]].concat();
    let mut view = View::open(&screen, &folder, &first);
    view.wait_for(&render(&folder, &[&["--size", "200x150"], &CAMERA[..]].concat()));
    screen.key("slash");
    screen.key("Escape");
    let last = ["--size", "200x150", "--eye", "1.5,0.5,3", "--target", "0,0,0", "--fov", "45"];
    view.wait_for(&render(&folder, &last));
    view.end();
    // Before a window is asked for: there is no display.
    folder.write("wrong.json", "{}");
    for path in ["none.json", "wrong.json"] {
        let missing = surfel(&folder, &["view", "--path", path], &[("DISPLAY", ""), ("WAYLAND_DISPLAY", "")]);
        let rendered = surfel(&folder, &["render", "--path", path, "--frames", "2", "-o", "o%d.png"], &[]);
        assert_eq!((missing.code, missing.stderr.lines().count()), (1, 1), "{}", missing.stderr);
        assert!(rendered.code == 1 && rendered.stderr.ends_with(&missing.stderr), "{}", rendered.stderr);
    }
}

#[test]
fn a_number_that_is_written_into_the_panel_is_no_key_of_the_window() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 400);
    let mut view = View::open(&screen, &folder, &["a.ply", "--size", "640x700", "--shading", "normals"]);
    view.wait_until("something is shown", |shot| shot.colors() > 20);
    screen.key("o");
    view.wait_until("the panel is shown", |shot| shot.pixels[640 * 10 + 620] == [20, 20, 24]);
    thread::sleep(Duration::from_millis(500));
    // The number beside the slider of the things' alpha.
    screen.drive(&["mousemove", "506", "62"]);
    thread::sleep(Duration::from_millis(300));
    screen.drive(&["click", "1"]);
    thread::sleep(Duration::from_millis(300));
    // Above what is told while shaders are compiled.
    let beside = [300, 650];
    let before = screen.shot(beside);
    for key in ["0", "period", "3", "Return"] {
        screen.key(key);
        thread::sleep(Duration::from_millis(100));
    }
    view.wait_until("what is seen is transparent", |shot| shot.corner(beside).differs_from(&before) > 5000);
    // What is pressed within the frame that ends the number is the panel's still.
    thread::sleep(Duration::from_secs(1));
    // Neither was all reset, nor are splats larger, nor is there a place of a path.
    let copied = view.camera();
    assert!(!copied.is_empty());
    view.end();
}

#[test]
fn things_are_hidden_and_made_transparent_by_key() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 400);
    folder.splats("b.ply", 100);
    let scene = |alpha: &str| {
        format!(
            "[[object]]\nfile = \"a.ply\"\n[[object]]\nfile = \"b.ply\"\ntranslate = [0.8, 0.3, 0]\n{alpha}"
        )
    };
    let write = |name: &str, text: &str| folder.write(name, text);
    write("both.toml", &scene(""));
    write("clear.toml", &scene("alpha = 0.8\n"));
    write("alone.toml", scene("").split("[[object]]\nfile = \"b").next().unwrap());
    let words = |file| [&[file, "--size", "320x240"], &CAMERA[..]].concat();
    let [both, clear, alone] =
        ["both.toml", "clear.toml", "alone.toml"].map(|file| render(&folder, &words(file)));
    assert!(clear.differs_from(&both) > 500 && alone.differs_from(&both) > 1000);
    let mut view = View::open(&screen, &folder, &words("both.toml"));
    view.wait_for(&both);
    let press = |keys: &str| keys.split_whitespace().for_each(|key| screen.key(key));
    press("N H Escape");
    view.wait_for(&alone);
    press("H less less Escape");
    view.wait_for(&clear);
    // The next one is the first again.
    press("greater greater N H N H Escape");
    view.wait_until("nothing is left", |shot| shot.colors() < 5);
    press("0 Escape");
    view.wait_for(&both);
    view.end();
}

#[test]
fn a_window_that_is_put_away_comes_back_with_what_is_new() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 400);
    let words = [&["a.ply", "--size", "320x240"], &CAMERA[..]].concat();
    let mut view = View::open(&screen, &folder, &words);
    view.wait_for(&render(&folder, &words));
    let number = view.number().to_string();
    for count in [60, 200] {
        // As window managers do with one that is made an icon.
        screen.drive(&["windowunmap", "--sync", &number]);
        view.wait_until("it is gone", |shot| shot.colors() < 3);
        folder.splats("a.ply", count);
        thread::sleep(Duration::from_millis(1500));
        screen.drive(&["windowmap", "--sync", &number]);
        view.wait_for(&render(&folder, &words));
    }
    view.end();
}

/// What is beside the panel of a window of 640x300 pixels, and above what is told while shaders are compiled.
pub const BESIDE: [u32; 2] = [300, 250];

#[test]
fn the_panel_is_used_by_keys_alone() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 400);
    let first = [&["a.ply", "--size", "640x300"], &CAMERA[..]].concat();
    let mut view = View::open(&screen, &folder, &first);
    let whole = render(&folder, &first);
    view.wait_for(&whole);
    // As fast as they come: several are heard within one frame.
    let press = |keys: &str| keys.split_whitespace().for_each(|key| screen.key(key));
    press("o");
    view.wait_until("the panel is shown", |shot| shot.differs_from(&whole) > 10_000);
    // Its bar, which is first, takes a moment to come.
    thread::sleep(Duration::from_millis(500));
    press("Tab Tab space");
    view.wait_until("the thing is gone", |shot| shot.corner(BESIDE).colors() < 3);
    press("space");
    view.wait_for(&whole.corner(BESIDE));
    // Behind alpha and size of splats, each with its number, are lists; the second is that of filters.
    press("Tab Tab Tab Tab Tab Tab Right Escape Escape");
    let unfiltered = render(&folder, &[&first[..], &["--filter", "none"]].concat());
    assert!(unfiltered.differs_from(&whole) > 20);
    view.wait_for(&unfiltered);
    view.end();
}

/// The line between two pictures is seen over a white background, too, and what is beside it is theirs.
#[test]
fn a_line_that_any_color_shows_is_between_two_pictures() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 400);
    let words = [&["a.ply", "--size", "201x200"], &CAMERA[..]].concat();
    let mut view = View::open(&screen, &folder, &words);
    view.wait_for(&render(&folder, &words));
    screen.key("y");
    screen.key("x");
    // The first row is above the names.
    let row = |shot: &Shot| [98, 99, 100, 101, 102, 103].map(|x| shot.pixels[x][1]);
    view.wait_until("a line is shown", |shot| row(shot) == [255, 0, 255, 0, 255, 255]);
    view.end();
}
