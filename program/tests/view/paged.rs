//! Files of levels of detail, of which pages come while the window is open.

use super::{
    CAMERA,
    rest::cube,
    screen::Screen,
    window::{Folder, View, render, surfel},
};

#[test]
fn a_file_of_levels_of_detail_comes_in_pages_until_it_is_what_render_writes() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 150_000);
    let converted = surfel(&folder, &["convert", "a.ply", "a.surfel"], &[]);
    assert_eq!(converted.code, 0, "{}", converted.stderr);
    let words = [&["a.surfel", "--size", "320x240", "--edges", "hard"], &CAMERA[..]].concat();
    let whole = render(&folder, &words);
    let mut view = View::open(&screen, &folder, &words);
    // The same splats in other chunks: sums in another order, which turn a pixel at a rim, one in ten thousand.
    view.wait_until("all pages are there", |shot| shot.differs_from(&whole) <= 8);
    // Another view needs other pages, and comes back.
    screen.drag([160, 120], [260, 140], 1);
    screen.drive(&["mousemove", "160", "120"]);
    screen.drive(&["click", "--repeat", "8", "4"]);
    let copied = view.camera();
    let near: Vec<&str> = words[..5].iter().copied().chain(copied.iter().map(String::as_str)).collect();
    let near = render(&folder, &near);
    view.wait_until("the pages of another view are there", |shot| shot.differs_from(&near) <= 8);
    screen.key("j");
    screen.key("i");
    assert!(view.wait_for_file("surfel-001.png").differs_from(&near) <= 8);
    // A method that draws no levels of detail is refused.
    screen.key("h");
    screen.key("Escape");
    view.wait_until("the first view again", |shot| shot.differs_from(&whole) <= 8);
    let said = view.end();
    assert!(said.stdout.contains(" at "), "nothing was picked: {}", said.stdout);
    // In less memory it is coarser, and whole.
    let little = [&words[..], &["--budget-memory", "2MB"]].concat();
    let mut view = View::open(&screen, &folder, &little);
    view.wait_until("it is coarser", |shot| {
        let differ = shot.differs_from(&whole);
        shot.colors() > 200 && differ > 1000 && differ < 30_000
    });
    view.end();
}

/// A page that is damaged ends nothing: the window says so, goes on with what it has, and writes pictures.
#[test]
fn a_damaged_page_is_told_and_the_picture_stays_coarser() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 150_000);
    assert_eq!(surfel(&folder, &["convert", "a.ply", "a.surfel"], &[]).code, 0);
    let words = [&["a.surfel", "--size", "320x240", "--edges", "hard", "--lod", "0"], &CAMERA[..]].concat();
    let whole = render(&folder, &words);
    let mut bytes = std::fs::read(folder.path("a.surfel")).unwrap();
    // Behind the nodes are the finest pages.
    for part in 10..14 {
        let at = part * bytes.len() / 16;
        bytes[at] ^= 0x55;
    }
    std::fs::write(folder.path("a.surfel"), bytes).unwrap();
    let refused = surfel(&folder, &[&["render"], &words[..]].concat(), &[]);
    assert!(refused.code == 1 && refused.stderr.contains("a.surfel: page "), "{}", refused.stderr);
    let mut view = View::open(&screen, &folder, &words);
    view.wait_until("it is coarser", |shot| shot.colors() > 200 && shot.differs_from(&whole) > 500);
    screen.drag([160, 120], [200, 130], 1);
    screen.key("i");
    assert!(view.wait_for_file("surfel-001.png").colors() > 200);
    assert!(view.is_running());
    let said = view.end();
    assert_eq!(said.stderr.matches("a.surfel: page ").count(), 1, "{}", said.stderr);
}

/// All splats, or as many of the best as are asked for: as `surfel render` draws them, and coarser than the whole.
#[test]
fn a_budget_of_splats_is_kept_by_the_window() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 20_000);
    assert_eq!(surfel(&folder, &["convert", "a.ply", "a.surfel"], &[]).code, 0);
    for file in ["a.ply", "a.surfel"] {
        let words = [&[file, "--size", "320x240", "--edges", "hard"], &CAMERA[..]].concat();
        let little = [&words[..], &["--budget", "800"]].concat();
        let (whole, within) = (render(&folder, &words), render(&folder, &little));
        assert!(within.differs_from(&whole) > 5000);
        let mut view = View::open(&screen, &folder, &little);
        view.wait_until("what the budget allows is shown", |shot| shot.differs_from(&within) <= 8);
        view.end();
    }
}

/// Files of a command line and of a scene file, one of them turned and mirrored, beside splats and triangles: as `surfel render` draws them, and hidden, shown again and made
/// transparent as other things are.
#[test]
fn several_files_come_in_pages_beside_others() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 60_000);
    cube(&folder, "cube.obj");
    assert_eq!(surfel(&folder, &["convert", "a.ply", "a.surfel"], &[]).code, 0);
    let scene = |name: &str, keys: &str| {
        let placed = "translate = [1.1, 0.2, -0.4]\nrotate_deg = [20, 60, 0]\nscale = [-0.7, 0.7, 0.7]";
        let text = format!(
            "[[object]]\n{keys}\nname = \"there\"\n{placed}\ncolor = [0.2, 0.5, 0.9]\n\
             [[object]]\nbuiltin = \"sphere\"\nsplats = 3000\ntranslate = [-1, 0.6, 0.5]\nscale = 0.4\n\
             [[object]]\nfile = \"cube.obj\"\nrepresentation = \"mesh\"\ntranslate = [-0.6, -0.8, 0.9]\nscale = 0.2\n"
        );
        folder.write(name, &text);
    };
    scene("scene.toml", "file = \"a.surfel\"");
    scene("glass.toml", "file = \"a.ply\"\nalpha = 0.5");
    let rest = [&["--size", "320x240", "--edges", "hard"], &CAMERA[..]].concat();
    let words = |files: &[&'static str]| [files, &rest[..]].concat();
    let [all, placed, glass] =
        [&["a.surfel", "scene.toml"][..], &["scene.toml"], &["a.surfel", "glass.toml"]]
            .map(|files| render(&folder, &words(files)));
    assert!(placed.differs_from(&all) > 3000 && glass.differs_from(&all) > 1000);
    let mut view = View::open(&screen, &folder, &words(&["a.surfel", "scene.toml"]));
    view.wait_until("all pages of both are there", |shot| shot.differs_from(&all) <= 8);
    // Of four things the third is the file of the command line.
    screen.key("N");
    screen.key("N");
    screen.key("H");
    view.wait_until("one is hidden", |shot| shot.differs_from(&placed) <= 8);
    screen.key("H");
    view.wait_until("it is there again", |shot| shot.differs_from(&all) <= 8);
    screen.key("N");
    for _ in 0..5 {
        screen.key("less");
    }
    view.wait_until("the other one is transparent", |shot| shot.differs_from(&glass) <= 60);
    screen.key("0");
    screen.key("Escape");
    view.wait_until("all is as it was", |shot| shot.differs_from(&all) <= 8);
    view.end();
    // In less memory both are coarser, and what is there as a whole is not.
    let mut view = View::open(
        &screen,
        &folder,
        &[&words(&["a.surfel", "scene.toml"])[..], &["--budget-memory", "2MB"]].concat(),
    );
    view.wait_until("they are coarser", |shot| {
        let differ = shot.differs_from(&all);
        shot.colors() > 200 && differ > 1000 && differ < 40_000
    });
    view.end();
}

/// A damaged file, and one that is not there, beside another one: the window tells which.
#[test]
fn faults_of_one_file_of_several_are_told_by_its_name() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 60_000);
    for name in ["a.surfel", "b.surfel"] {
        assert_eq!(surfel(&folder, &["convert", "a.ply", name], &[]).code, 0);
    }
    let mut bytes = std::fs::read(folder.path("b.surfel")).unwrap();
    let at = 3 * bytes.len() / 4;
    bytes[at] ^= 0x55;
    std::fs::write(folder.path("b.surfel"), bytes).unwrap();
    let rest = [&["--size", "320x240", "--edges", "hard", "--lod", "0"], &CAMERA[..]].concat();
    let display = [("DISPLAY", screen.name())];
    let missing = surfel(&folder, &[&["view", "a.surfel", "none.surfel"], &rest[..]].concat(), &display);
    assert!(missing.code != 0 && missing.stderr.contains("none.surfel: cannot read"), "{}", missing.stderr);
    let whole = render(&folder, &[&["a.surfel"], &rest[..]].concat());
    let mut view = View::open(&screen, &folder, &[&["a.surfel", "b.surfel"], &rest[..]].concat());
    view.wait_until("both are coarser", |shot| shot.colors() > 200 && shot.differs_from(&whole) > 500);
    // Without the one at fault the other one is whole.
    screen.key("N");
    screen.key("H");
    screen.key("Escape");
    view.wait_until("the other one is whole", |shot| shot.differs_from(&whole) <= 8);
    let said = view.end();
    assert_eq!(said.stderr.matches("b.surfel: page ").count(), 1, "{}", said.stderr);
}
