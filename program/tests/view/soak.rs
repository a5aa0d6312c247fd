//! Random input: without a message, without a stop, and without memory that grows. Ten minutes of it by hand: `cargo test --release --test view -- soak --ignored --nocapture`;
//! `SURFEL_SOAK_SECS` for another time.

use std::{
    fs, thread,
    time::{Duration, Instant},
};

use super::{
    CAMERA,
    random::{KEYS, KEYS_OF_VIEWS, Random},
    screen::Screen,
    window::{Folder, View},
};

/// What is in use of the program's own memory, and of the device's, may grow by so much in ten minutes. What a driver and a layer take for themselves is in neither, and is told as what is
/// resident. Counted call by call, with `malloc` and `operator new` replaced and each piece put down to the library that asks for it: from minute to minute the layer (1.3.239) has 4 to 34 MB
/// more, nearly all of it states of what accesses what, and the driver no more than its shaders of the pipelines that are kept. By resizes alone, of which each makes a swapchain, the layer
/// grew by 3.7, 9.7 and 15.9 MB in each hundred of them, and by less than 0.1 MB in as many drags, or settings once their pipelines are there, while program and driver had no more.
const MOST_GROWTH_BYTES: [u64; 2] = [1_000_000, 1_000_000];

/// In a minute, in which not each setting has been seen before.
const MOST_GROWTH_OF_A_MINUTE_BYTES: [u64; 2] = [2_000_000, 1_000_000];

/// A window that has rested for longer has given back all but the scene and what it shows.
const IDLE: Duration = Duration::from_secs(7);

/// The first size, all settings and the first camera again.
fn go_back(screen: &Screen, view: &mut View<'_>) {
    view.resize([320, 240]);
    for key in ["Escape", "0", "h", "Escape"] {
        thread::sleep(Duration::from_millis(300));
        screen.key(key);
    }
    thread::sleep(Duration::from_secs(2));
}

/// Every setting once, so that the pipelines that are kept are the same whatever was before.
fn see_all(screen: &Screen, view: &mut View<'_>) {
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
}

fn open<'a>(screen: &'a Screen, folder: &'a Folder, is_validated: bool) -> View<'a> {
    folder.splats("a.ply", 20_000);
    let size = ["--size", "320x240", "--picture-size", "2000x1500"];
    let words = [&["a.ply", "--print-frames"], &size[..], &CAMERA[..]].concat();
    let mut view = View::open_as(screen, folder, &words, is_validated);
    view.wait_until("something is shown", |shot| shot.colors() > 20);
    view
}

/// What was in use when it rested last, as it printed it: bytes of the program's own, bytes of the device's, and how many pieces these are.
type Used = [u64; 3];

/// Goes back, and waits until the window has rested for long: keys may still be on their way when it first does.
fn back_at_rest(screen: &Screen, view: &mut View<'_>) -> Used {
    let rests = |view: &View<'_>| -> Vec<String> {
        view.printed().lines().filter_map(|line| line.strip_prefix("at rest: ")).map(str::to_owned).collect()
    };
    let before = rests(view).len();
    go_back(screen, view);
    let begun = Instant::now();
    let (mut seen, mut since) = (before, Instant::now());
    while seen == before || since.elapsed() < IDLE {
        assert!(begun.elapsed() < Duration::from_secs(60), "the window does not rest");
        thread::sleep(Duration::from_millis(200));
        let count = rests(view).len();
        if count != seen {
            (seen, since) = (count, Instant::now());
        }
    }
    let last = rests(view).pop().unwrap();
    let mut numbers = last.split_whitespace().filter_map(|word| word.parse().ok());
    [(); 3].map(|()| numbers.next().unwrap())
}

/// Megabytes of memory that it has, as the system counts.
fn resident_mb(view: &View<'_>) -> f64 {
    let status = fs::read_to_string(format!("/proc/{}/status", view.process())).unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).unwrap();
    line.trim().trim_end_matches(" kB").parse::<f64>().unwrap() * 1024e-6
}

/// What is in use after each of some turns has not grown: the least of each half is compared, which a leak raises, and pieces are counted.
fn assert_constant(used: &[Used], most_growth_bytes: [u64; 2]) {
    println!("in use, bytes of its own, of the device's, and pieces: {used:?}");
    let (first, second) = used.split_at(used.len() / 2);
    let least = |half: &[Used], of: usize| half.iter().map(|used| used[of]).min().unwrap();
    let grown = [0, 1, 2].map(|of| least(second, of).saturating_sub(least(first, of)));
    let [own, device, pieces] = grown;
    let [most_own, most_device] = most_growth_bytes;
    assert!(own < most_own && device < most_device && pieces < 10, "{grown:?}");
}

#[test]
fn random_input_leaves_no_more_memory_in_use() {
    let (screen, folder) = (Screen::new(), Folder::new());
    let mut view = open(&screen, &folder, true);
    let mut random = Random(3);
    let mut turn = |secs| {
        view.play_at_random(&mut random, Duration::from_secs(secs), KEYS);
        back_at_rest(&screen, &mut view)
    };
    assert_constant(&[15, 10, 10, 10].map(&mut turn), MOST_GROWTH_OF_A_MINUTE_BYTES);
    view.end();
}

#[test]
fn a_picture_larger_than_the_window_leaves_no_memory_in_use() {
    let (screen, folder) = (Screen::new(), Folder::new());
    let mut view = open(&screen, &folder, true);
    let before = back_at_rest(&screen, &mut view);
    screen.key("i");
    assert_eq!(view.wait_for_file("surfel-001.png").size, [2000, 1500]);
    let after = back_at_rest(&screen, &mut view);
    // Of the device's, the picture alone has 12 MB to be read from.
    assert!(after[1] <= before[1] + 1_000_000 && after[2] <= before[2] + 2, "{before:?}, {after:?}");
    view.end();
}

fn secs() -> u64 {
    std::env::var("SURFEL_SOAK_SECS").ok().and_then(|secs| secs.parse().ok()).unwrap_or(600)
}

/// Plays, with every setting again after each minute; the most milliseconds that a frame took on the device. How long after its input it was done is told:
/// that has the frames before it and those in which pipelines were made, between which the window went on.
fn play(is_validated: bool, keys: &str) -> f64 {
    let (screen, folder) = (Screen::new(), Folder::new());
    let mut view = open(&screen, &folder, is_validated);
    let mut random = Random(11);
    let (mut in_use, mut resident) = (Vec::new(), Vec::new());
    for minute in 0..=(secs() / 60).max(1) {
        if minute > 0 {
            view.play_at_random(&mut random, Duration::from_secs(60), keys);
        }
        if keys == KEYS {
            go_back(&screen, &mut view);
            see_all(&screen, &mut view);
        }
        in_use.push(back_at_rest(&screen, &mut view));
        resident.push(resident_mb(&view));
    }
    println!("resident at first and after each minute, MB: {resident:.1?}");
    let said = view.end();
    let secs = |line: &str| line.split_once(" ms on the device")?.0.rsplit(' ').next()?.parse::<f64>().ok();
    let long = said.stdout.lines().filter(|line| secs(line).is_some_and(|ms| ms > 300.0));
    long.for_each(|line| println!("{line}"));
    let sorted = |from: &str, to: &str| {
        let of = |line: &str| line.split_once(from)?.1.split_once(to)?.0.parse::<f64>().ok();
        let mut all: Vec<f64> = said.stdout.lines().filter_map(of).collect();
        all.sort_by(f64::total_cmp);
        all
    };
    let mut longest = 0.0;
    for (what, from, to) in
        [("after their input", "seen ", " ms after"), ("on the device", ": ", " ms on the device")]
    {
        let all = sorted(from, to);
        let at = |part: usize| all[all.len() * part / 1000];
        longest = all[all.len() - 1];
        println!(
            "{} frames, ms {what}: median {:.0}, of a thousand all but one {:.0}, longest {longest:.0}",
            all.len(),
            at(500),
            at(999)
        );
    }
    assert_constant(&in_use, MOST_GROWTH_BYTES);
    longest
}

#[test]
#[ignore = "twelve minutes"]
fn ten_minutes_of_random_views_leave_no_more_memory() {
    play(false, KEYS_OF_VIEWS);
}

#[test]
#[ignore = "twenty minutes"]
fn ten_minutes_of_random_input_leave_no_more_memory() {
    play(false, KEYS);
}

#[test]
#[ignore = "twenty minutes"]
fn ten_minutes_of_random_input_need_a_second_a_frame_at_most_and_say_nothing() {
    let longest_ms = play(true, KEYS);
    assert!(longest_ms < 1000.0, "{longest_ms}");
}
