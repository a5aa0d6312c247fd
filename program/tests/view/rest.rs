//! A picture at rest: it becomes the one that `surfel render` writes, and then nothing is drawn until something changes.

use std::{
    thread,
    time::{Duration, Instant},
};

use super::{
    CAMERA,
    faults::open_below,
    screen::Screen,
    window::{Folder, View, hidden as hidden_in, render, surfel},
};

/// A cube of triangles.
pub fn cube(folder: &Folder, name: &str) {
    let corner = |i: u32| [0, 1, 2].map(|axis| 2 * (i >> axis & 1)).map(|at| f64::from(at) - 1.0);
    let corners = (0..8).map(corner).map(|[x, y, z]| format!("v {x} {y} {z}\n"));
    let faces = ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"];
    folder.write(name, &corners.chain(faces.map(|face| format!("f {face}\n"))).collect::<String>());
}

/// Polygons have stairs for outlines in one sample, and so have points; `surfel render` takes 8.
#[test]
fn polygons_and_points_at_rest_have_the_samples_that_render_takes() {
    let (screen, folder) = (Screen::new(), Folder::new());
    cube(&folder, "a.obj");
    folder.splats("a.ply", 400);
    for (file, others) in [
        ("a.obj", &[][..]),
        ("a.obj", &["--tonemap", "agx", "--cull", "list"]),
        ("a.ply", &["--samples", "4", "--budget-memory", "9MB", "--lod-steps", "blend"]),
        ("a.ply", &["--rasterizer", "affine-center"]),
    ] {
        let words = [&[file, "--size", "320x240"], &CAMERA[..], others].concat();
        let (whole, one) =
            (render(&folder, &words), render(&folder, &[&words[..9], &["--samples", "1"]].concat()));
        assert!(one.differs_from(&whole) > 200, "{file}");
        let mut view = View::open(&screen, &folder, &words);
        view.wait_for(&whole);
        screen.drag([160, 120], [210, 100], 1);
        let camera = view.camera();
        let words: Vec<&str> =
            words[..3].iter().chain(others).copied().chain(camera.iter().map(String::as_str)).collect();
        view.wait_for(&render(&folder, &words));
        screen.key("h");
        view.wait_for(&whole);
        // What does nothing for them is told.
        let told = view.end().stderr;
        for (option, because) in [
            ("--cull", "this scene is drawn as triangles"),
            ("--budget-memory", "it is for opaque .surfel files"),
            ("--lod-steps", "the window makes levels of detail of more than 300000 splats"),
        ] {
            let line = format!("{option} has no effect: {because}");
            assert_eq!(told.contains(&line), others.contains(&option), "{told}");
        }
    }
}

/// How many frames were shown.
fn shown(view: &View<'_>) -> usize {
    view.said().matches("called: vkQueuePresentKHR").count()
}

const SECOND: Duration = Duration::from_secs(1);

/// Pictures that nobody sees, drawn once so that their pipelines have run: from three distances, as they move and with all splats. None of pages.
const HIDDEN: usize = 6;

/// Waits until no frame is shown any more for so long, and until pictures that nobody sees are drawn, between which another device may compile for seconds; how many frames were by then.
fn settled(view: &View<'_>, quiet: Duration, hidden: usize) -> usize {
    let begun = Instant::now();
    let (mut ahead, mut since) = (0, begun);
    loop {
        let before = shown(view);
        thread::sleep(quiet);
        let now = hidden_in(&view.printed());
        // The last ones, for which another device compiles after all others.
        let last = view.printed().matches("\nahead, from elsewhere ").count();
        if now != ahead {
            (ahead, since) = (now, Instant::now());
        }
        if shown(view) == before && last >= hidden && (hidden == 0 || since.elapsed() > 3 * SECOND) {
            return before;
        }
        assert!(begun.elapsed() < Duration::from_secs(60), "it never rests");
    }
}

#[test]
fn nothing_is_drawn_where_nothing_has_changed() {
    // Most of it is waiting: each on a screen of its own, at the same time.
    thread::scope(|scope| {
        for file in ["a.obj", "a.ply", "a.surfel"] {
            scope.spawn(move || draws_what_has_changed_alone(file));
        }
    });
}

fn draws_what_has_changed_alone(file: &str) {
    let (screen, folder) = (Screen::new(), Folder::new());
    cube(&folder, "a.obj");
    folder.splats("a.ply", 150_000);
    assert_eq!(surfel(&folder, &["convert", "a.ply", "a.surfel"], &[]).code, 0);
    let words = [&[file, "--size", "320x240"], &CAMERA[..]].concat();
    let printed = [&words[..], &["--print-frames"]].concat();
    let mut view = open_below(&screen, &folder, &printed, ("SURFEL_COUNTED", "vkQueuePresentKHR"));
    let hidden = if file == "a.surfel" { 0 } else { HIDDEN };
    // Pages are drawn in another order, which turns some pixels.
    let whole = render(&folder, &words);
    view.wait_until("all is shown", |shot| shot.differs_from(&whole) < 100);
    let frames = settled(&view, SECOND, hidden);
    // The mouse alone changes nothing.
    for x in 0..20 {
        screen.drive(&["mousemove", &(100 + x).to_string(), "100"]);
    }
    thread::sleep(Duration::from_secs(3));
    assert_eq!(shown(&view), frames, "{file}");
    assert!(frames > 0);
    // What has changed is drawn, and then it rests again; with times, too.
    screen.drag([100, 100], [140, 110], 1);
    let turned = settled(&view, SECOND, hidden);
    assert!(turned > frames, "{file}");
    screen.key("o");
    // Half a second after the last one splats are counted for the panel, which shows their number in one more.
    let with_panel = settled(&view, 3 * SECOND, hidden);
    assert!(with_panel > turned, "{file}");
    thread::sleep(Duration::from_secs(2));
    assert_eq!(shown(&view), with_panel, "{file}");
    view.end();
}
