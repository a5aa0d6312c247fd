//! Pipelines that run for the first time: a driver that compiles them then, as lavapipe does where it finds nothing on disk, holds up a step of a picture, not the window.

use std::{fs, io::Write as _, process::Stdio, thread, time::Duration};

use super::{
    CAMERA,
    drag::drop_on,
    faults::open_below,
    rest::cube,
    screen::Screen,
    window::{Folder, View, render, surfel},
};

/// The lines of frames that were printed since, by their first word.
fn frames(printed: &str, since: usize) -> Vec<&str> {
    let words = printed[since..].lines().filter_map(|line| line.split_whitespace().next());
    words.filter(|word| matches!(*word, "step" | "whole" | "moving" | "other")).collect()
}

/// The camera as the program prints it where it is copied, between lines of frames.
fn camera(screen: &Screen, view: &mut View<'_>) -> Vec<String> {
    let since = view.printed().len();
    let line = |view: &View<'_>| {
        let printed = view.printed();
        let line = printed[since..].split_inclusive('\n').find(|line| line.starts_with("--eye"));
        line.filter(|line| line.ends_with('\n')).map(str::to_owned)
    };
    screen.key("c");
    view.wait("the camera is printed", |view| line(view).is_some());
    // The message over the picture goes.
    screen.key("Escape");
    line(view).unwrap().split_whitespace().map(str::to_owned).collect()
}

#[test]
fn pipelines_that_never_ran_are_compiled_step_by_step_and_what_changes_meanwhile_is_drawn() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 400);
    let words = [&["a.ply", "--size", "320x240", "--samples", "1"], &CAMERA[..]].concat();
    let mut view = View::open_in(
        &screen,
        &folder,
        &[&words[..], &["--print-frames"]].concat(),
        true,
        &[("MESA_SHADER_CACHE_DISABLE", "true")],
    );
    view.wait_for(&render(&folder, &words));
    view.wait("the first picture is told", |view| frames(&view.printed(), 0).contains(&"whole"));
    // Planes take other pipelines. What is asked for before they have run comes after them.
    screen.key("X");
    let printed = view.printed().len();
    view.wait("a step is done", |view| frames(&view.printed(), printed).contains(&"step"));
    screen.drag([160, 120], [210, 100], 1);
    screen.key("equal");
    let cut = camera(&screen, &mut view);
    assert!(cut.iter().any(|word| word == "--clip-plane"), "{cut:?}");
    let of_cut = ["a.ply", "--size", "320x240", "--samples", "1"];
    let of_cut = of_cut.into_iter().chain(cut.iter().map(String::as_str)).collect::<Vec<_>>();
    view.wait_for(&render(&folder, &of_cut));
    // Two pictures at once, the second by another method, and back.
    for keys in ["r x", "0 x", "0"] {
        keys.split_whitespace().for_each(|key| screen.key(key));
    }
    screen.key("Escape");
    let words = words.iter().filter(|word| !CAMERA.contains(word)).copied();
    let camera = camera(&screen, &mut view);
    let turned = words.chain(camera.iter().map(String::as_str)).collect::<Vec<_>>();
    view.wait_for(&render(&folder, &turned));
    // Nothing is left that never ran.
    view.wait_for_hidden(1);
    let printed = view.printed().len();
    screen.drag([160, 120], [200, 110], 1);
    view.wait("a picture comes", |view| frames(&view.printed(), printed).contains(&"whole"));
    assert!(!frames(&view.printed(), printed).contains(&"step"));
    view.end();
}

/// The frames that draw a plane for the first time, where Mesa keeps what it has compiled in a new folder, or nowhere. The hand does something `meanwhile`.
fn since_a_plane(has_cache: bool, meanwhile: impl Fn(&Screen)) -> String {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 20_000);
    let words = [&["a.ply", "--size", "320x240", "--samples", "1"], &CAMERA[..]].concat();
    let cache = folder.path("cache");
    fs::create_dir(&cache).unwrap();
    let environment =
        [("MESA_SHADER_CACHE_DIR", cache.to_str().unwrap()), ("MESA_SHADER_CACHE_DISABLE", "true")];
    let environment = if has_cache { &environment[..1] } else { &environment[1..] };
    let mut view =
        View::open_in(&screen, &folder, &[&words[..], &["--print-frames"]].concat(), true, environment);
    view.wait_for(&render(&folder, &words));
    view.wait("the first picture is told", |view| frames(&view.printed(), 0).contains(&"whole"));
    let printed_before = view.printed().len();
    screen.key("X");
    meanwhile(&screen);
    view.wait("the plane is drawn", |view| {
        let printed = view.printed();
        let frames = frames(&printed, printed_before);
        let step = frames.iter().position(|what| *what == "step");
        step.is_some_and(|step| frames[step..].contains(&"whole"))
    });
    view.end().stdout[printed_before..].to_owned()
}

/// The longest of them, in milliseconds on the device, and the first.
fn longest_of_a_plane(has_cache: bool) -> (f64, String) {
    let since = since_a_plane(has_cache, |screen| screen.drag([160, 120], [210, 100], 1));
    let ms = |line: &str| line.split_once(" ms on the device")?.0.rsplit(' ').next()?.parse::<f64>().ok();
    let longest = since.lines().filter_map(ms).fold(0.0, f64::max);
    (longest, frames(&since, 0)[0].to_owned())
}

/// Another device has compiled the pipelines by then, and the window has gone on with the picture as it was.
#[test]
fn what_a_driver_compiles_holds_up_no_frame_where_it_keeps_it_on_disk() {
    let [(with, first), (without, _)] = [true, false].map(longest_of_a_plane);
    assert!(first != "step", "the camera has moved first, and the plane is still to come");
    assert!(3.0 * with < without, "{with} and {without} ms");
}

/// What the other device was asked for was seen from afar, and takes other pipelines.
#[test]
fn a_hand_that_comes_nearer_meanwhile_waits_for_its_own_pipelines() {
    let since = since_a_plane(true, |screen| {
        screen.drive(&["mousemove", "160", "120"]);
        screen.drive(&["click", "--repeat", "14", "--delay", "60", "4"]);
    });
    let steps: Vec<&str> = since.lines().filter(|line| line.starts_with("step ")).collect();
    assert!(!steps.is_empty() && !since.contains("for the first time"), "{since}");
}

/// The file is standard input, of which nothing comes before the window has drawn what it draws for its pipelines.
#[test]
fn pipelines_have_run_before_the_first_file_is_read() {
    let (screen, folder) = (Screen::new(), Folder::new());
    cube(&folder, "a.obj");
    assert_eq!(surfel(&folder, &["convert", "a.obj", "a.ply", "--resample", "150k"], &[]).code, 0);
    let words = |file| [&[file, "--size", "640x480", "--samples", "1"], &CAMERA[..]].concat();
    let fed = [&words("-")[..], &["--print-frames"]].concat();
    let environment = [("MESA_SHADER_CACHE_DISABLE", "true")];
    let mut view = View::open_fed(&screen, &folder, &fed, (true, &environment), Stdio::piped());
    view.wait("it has drawn", |view| frames(&view.printed(), 0).contains(&"other"));
    let mut input = view.take_input();
    let printed = view.printed().len();
    input.write_all(&fs::read(folder.path("a.ply")).unwrap()).unwrap();
    drop(input);
    view.wait_for(&render(&folder, &words("a.ply")));
    view.wait("the picture is told", |view| frames(&view.printed(), printed).contains(&"whole"));
    assert_eq!(frames(&view.printed(), printed)[0], "whole");
    view.end();
}

/// Nobody sees them, but their pipelines have run by then: those of pictures that move, and from nearer.
#[test]
fn what_a_hand_comes_to_has_run_before() {
    let (screen, folder) = (Screen::new(), Folder::new());
    let words = ["--size", "640x480", "--samples", "1"];
    let environment = [("MESA_SHADER_CACHE_DISABLE", "true")];
    let printing = [&words[..], &["--print-frames"]].concat();
    let mut view = View::open_in(&screen, &folder, &printing, true, &environment);
    view.wait_for(&render(&folder, &words));
    // As many as it moves by, and from elsewhere, for which another device compiles after those.
    let from_elsewhere =
        |view: &mut View<'_>| view.printed().matches("\nahead, from elsewhere ").count() >= 6;
    view.wait("pictures from elsewhere are drawn", from_elsewhere);
    view.wait_for_hidden(6);
    // How coarse these are follows from what all of it costs: not from a frame that had others compiled.
    let all = view.printed();
    // Where each step had a picture of its own, there are those from elsewhere alone.
    let of_moves = all.split_once("\nahead ");
    let (before, _) = of_moves.or_else(|| all.split_once("\nahead, from elsewhere ")).unwrap();
    let last =
        before.lines().rev().find(|line| ["whole ", "again "].iter().any(|what| line.starts_with(what)));
    assert!(last.is_some_and(|line| !line.contains("for the first time")), "{before}");
    let printed = view.printed().len();
    screen.drive(&["mousemove", "320", "240"]);
    for _ in 0..16 {
        screen.drive(&["click", "4"]);
        thread::sleep(Duration::from_millis(100));
    }
    screen.drag([320, 240], [360, 230], 1);
    let camera = camera(&screen, &mut view);
    view.wait_for(&render(
        &folder,
        &words.into_iter().chain(camera.iter().map(String::as_str)).collect::<Vec<_>>(),
    ));
    let since = frames(&view.printed()[printed..], 0).join(" ");
    view.end();
    assert!(!since.contains("step"), "{since}");
}

/// Another device takes seconds for the pipelines of the scene that comes.
#[test]
fn a_scene_is_shown_until_there_are_pipelines_for_the_next() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 400);
    cube(&folder, "b.obj");
    let words = |file| [&[file, "--size", "320x240", "--samples", "1"], &CAMERA[..]].concat();
    let fed = [&words("a.ply")[..], &["--print-frames"]].concat();
    let mut view = open_below(&screen, &folder, &fed, ("SURFEL_ASIDE", "slow"));
    view.wait_for(&render(&folder, &words("a.ply")));
    drop_on(screen.name(), view.number(), &[&folder.path("b.obj")]);
    view.wait("it is read", |_| !screen.drive(&["search", "--name", "b.obj"]).is_empty());
    // It is small.
    thread::sleep(Duration::from_secs(1));
    let printed = view.printed().len();
    screen.drag([160, 120], [210, 100], 1);
    view.wait("a frame is drawn", |view| !frames(&view.printed(), printed).is_empty());
    let printed = view.printed()[printed..].to_owned();
    screen.key("h");
    view.wait_for(&render(&folder, &words("b.obj")));
    view.end();
    // The other device has not even uploaded anything by then.
    let seen =
        printed.split_once("its end seen ").and_then(|(_, since)| since.split_once(" ms after its input"));
    let ms: f64 = seen.expect("it answers to the hand").0.parse().unwrap();
    assert!(ms < 4000.0, "{printed}");
}

/// A picture of many samples that is larger than the window takes seconds. What is asked for meanwhile is drawn before it is written, and it is the picture that was asked for.
#[test]
fn the_window_goes_on_while_a_picture_is_written() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 20_000);
    let words = [&["a.ply", "--samples", "16"], &CAMERA[..]].concat();
    let of_window = ["--size", "320x240", "--picture-size", "1600x1200", "--print-frames"];
    let mut view = View::open_as(&screen, &folder, &[&words[..], &of_window].concat(), true);
    view.wait_for(&render(&folder, &[&words[..], &["--size", "320x240"]].concat()));
    let since = view.printed().len();
    screen.key("i");
    screen.key("1");
    view.wait("another view is drawn", |view| frames(&view.printed(), since).contains(&"whole"));
    assert!(!folder.path("surfel-001.png").exists(), "the window has waited for the picture");
    // Once more is refused until it is there.
    screen.key("i");
    let written = view.wait_for_file("surfel-001.png");
    let expected = render(&folder, &[&words[..], &["--size", "1600x1200"]].concat());
    assert_eq!(written.differs_from(&expected), 0);
    assert!(!folder.path("surfel-002.png").exists());
    // What is under way when the window is closed is written, too.
    screen.key("i");
    view.end();
    assert!(folder.path("surfel-002.png").exists());
}
