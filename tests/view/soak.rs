//! Ten minutes of random input: without a message, without a stop, and without memory that grows. By hand: `cargo test --release --test view -- soak --ignored --nocapture`;
//! `SURFEL_SOAK_SECS` for another time.

use std::{thread, time::Duration};

use super::{
    CAMERA,
    random::{KEYS, KEYS_OF_VIEWS, Random},
    screen::Screen,
    window::{Folder, View},
};

/// The first size, all settings and the first camera again.
fn go_back(screen: &Screen, view: &mut View<'_>) {
    view.resize([320, 240]);
    for key in ["Escape", "0", "h", "Escape"] {
        thread::sleep(Duration::from_millis(300));
        screen.key(key);
    }
    thread::sleep(Duration::from_secs(2));
}

/// Every setting once, so that the pipelines that are kept are the same whatever was before; then back. Megabytes that are resident.
fn settled_mb(screen: &Screen, view: &mut View<'_>) -> f64 {
    go_back(screen, view);
    let steps =
        [("r", 10), ("g", 5), ("k", 4), ("n", 5), ("b", 3), ("v", 5), ("m", 3), ("l", 3), ("L", 3), ("O", 2)];
    let others = "1 7 x y z space space o o question question X X B B p p period comma";
    let settings = steps.into_iter().flat_map(|(key, times)| vec![key; times]);
    for key in settings.chain(others.split_whitespace()) {
        screen.key(key);
        screen.drag([100, 100], [110, 105], 1);
        thread::sleep(Duration::from_millis(300));
    }
    go_back(screen, view);
    view.resident_mb()
}

/// Beside what comes and goes: blocks of device memory, and which of the pages that were freed the system has back by then.
const MOST_GROWTH_MB: f64 = 20.0;

fn secs() -> u64 {
    std::env::var("SURFEL_SOAK_SECS").ok().and_then(|secs| secs.parse().ok()).unwrap_or(600)
}

/// Plays; by how many megabytes the process grew meanwhile, and the most milliseconds from an input until the frame was done that answers to it.
fn played(is_validated: bool) -> (f64, f64) {
    let secs = secs();
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 20_000);
    let words = [&["a.ply", "--size", "320x240", "--print-frames"], &CAMERA[..]].concat();
    let mut view = View::open_as(&screen, &folder, &words, is_validated);
    view.wait_until("something is shown", |shot| shot.colors() > 20);
    let mut random = Random(11);
    let mut warm = vec![settled_mb(&screen, &mut view)];
    // Each setting in windows of each size, whose blocks of device memory the system counts as they are touched.
    view.play_at_random(&mut random, Duration::from_secs(secs / 3), KEYS);
    warm.extend((0..2).map(|_| settled_mb(&screen, &mut view)));
    println!(
        "resident after each setting was seen once; and after {} s of random input, MB: {warm:.1?}",
        secs / 3
    );
    view.play_at_random(&mut random, Duration::from_secs(secs), KEYS);
    let end: Vec<f64> = (0..2).map(|_| settled_mb(&screen, &mut view)).collect();
    println!("after {secs} s more of random input: {end:.1?}");
    let said = view.end();
    let after_input = |line: &str| {
        let (_, told) = line.split_once("its end seen ")?;
        told.split_whitespace().next()?.parse::<f64>().ok()
    };
    let mut late: Vec<f64> = said.stdout.lines().filter_map(after_input).collect();
    late.sort_by(f64::total_cmp);
    let at = |part: usize| late[late.len() * part / 1000];
    let longest = late[late.len() - 1];
    println!(
        "of {} frames, ms after their input: median {:.0}, of a thousand all but one {:.0}, longest {longest:.0}",
        late.len(),
        at(500),
        at(999)
    );
    println!("growth: {:.1} MB", end[1] - warm[2]);
    (end[1] - warm[2], longest)
}

/// Where no pipelines are made any more, what else might grow is seen.
#[test]
#[ignore = "fourteen minutes"]
fn ten_minutes_of_random_views_leave_no_more_memory() {
    let (screen, folder) = (Screen::new(), Folder::new());
    folder.splats("a.ply", 20_000);
    let words = [&["a.ply", "--size", "320x240"], &CAMERA[..]].concat();
    let mut view = View::open_as(&screen, &folder, &words, false);
    view.wait_until("something is shown", |shot| shot.colors() > 20);
    let mut random = Random(5);
    let mut minute = |view: &mut View<'_>| {
        view.play_at_random(&mut random, Duration::from_secs(60), KEYS_OF_VIEWS);
        go_back(&screen, view);
        view.resident_mb()
    };
    let all: Vec<f64> = (0..4 + secs() / 60).map(|_| minute(&mut view)).collect();
    println!("resident after each minute, MB: {all:.1?}");
    view.end();
    // The most of some minutes: what comes and goes is there in some of them.
    let most = |minutes: &[f64]| minutes.iter().copied().fold(0.0, f64::max);
    let growth_mb = most(&all[all.len() - 3..]) - most(&all[..4]);
    println!("growth: {growth_mb:.1} MB");
    assert!(growth_mb < MOST_GROWTH_MB, "{growth_mb}");
}

/// Layers of 1.3.239 take memory for each presentation and each query that is reset, which they keep: so without them.
#[test]
#[ignore = "ten minutes"]
fn ten_minutes_of_random_input_leave_no_more_memory() {
    let (growth_mb, _) = played(false);
    assert!(growth_mb < MOST_GROWTH_MB, "{growth_mb}");
}

#[test]
#[ignore = "ten minutes"]
fn ten_minutes_of_random_input_are_answered_within_a_second_without_a_message() {
    let (_, longest_ms) = played(true);
    assert!(longest_ms < 1000.0, "{longest_ms}");
}
