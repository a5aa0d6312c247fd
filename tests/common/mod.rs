//! What the tests of the GPU path share: a validated device, scenes with known difficulties, and the comparison with
//! the oracle.

#![allow(dead_code, unused_imports, reason = "each test binary uses its own part")]

pub mod bent;
pub mod cases;
pub mod faults;
pub mod host;
mod oracles;
pub mod sheets;
pub mod watched;

use std::{
    ffi::OsStr,
    ops::{Deref, DerefMut},
    process::Command,
    rc::Rc,
    sync::{Condvar, Mutex, Once, PoisonError},
};

pub use oracles::oracle_of;
pub use surfel::{
    hard_scenes::{self as scenes, builder},
    selftest::agreement as compare,
};

use compare::Errors;
use scenes::Hard;
use surfel::{
    reference::Picture,
    renderer::{Frame, Headless, HeadlessOptions, Wanted},
    scene::Settings,
    vk::{Limits, Validation, arm_validation_across_submits},
};

/// The surface as data and the shaded picture in linear light.
pub const ALL: Wanted = Wanted { picture: true, linear: true, surface: true, profile: None };

/// Makes every instance of this process validate across submits.
pub fn arm() {
    static ARM: Once = Once::new();
    // SAFETY: before this process's first Vulkan instance; tests read the environment only through Rust's own lock.
    ARM.call_once(|| unsafe { arm_validation_across_submits() });
}

/// A renderer with validation. Fails, and does not skip, where there is no device: CI must have one.
pub fn headless() -> Headless {
    arm();
    let options = HeadlessOptions {
        validation: Validation::On,
        device: std::env::var("SURFEL_TEST_DEVICE").ok(),
        cache_folder: None,
    };
    let headless = Headless::new(&options).expect("tests need a Vulkan device and the validation layer");
    let facts = headless.device().facts();
    println!("device: {} ({})", facts.name, facts.driver);
    headless
}

/// A renderer that tests share, whose pipelines are made once, for one test at a time. What the validation layer says meanwhile fails
/// that test.
pub struct Shared(Option<Headless>);

/// Renderers of a program: of what a test does, only drawing takes more than one core.
const MOST_RENDERERS: usize = 2;

/// Pipelines of a renderer that stay from test to test: of thousands a driver of the processor takes megabytes for each.
const MOST_PIPELINES: usize = 100;

/// Those that no test has, and how many there are in all.
struct Renderers {
    free: Vec<Headless>,
    made: usize,
}

static RENDERERS: Mutex<Renderers> = Mutex::new(Renderers { free: Vec::new(), made: 0 });
static GIVEN_BACK: Condvar = Condvar::new();

/// Waits until there is a renderer that no other test has.
pub fn shared() -> Shared {
    let all = RENDERERS.lock().unwrap_or_else(PoisonError::into_inner);
    let none = |all: &mut Renderers| all.free.is_empty() && all.made == MOST_RENDERERS;
    let mut all = GIVEN_BACK.wait_while(all, none).unwrap_or_else(PoisonError::into_inner);
    let mut headless = all.free.pop().unwrap_or_else(|| {
        let new = headless();
        all.made += 1;
        new
    });
    drop(all);
    // A test that failed leaves the renderer between two frames: it can go on, with the limits of the device.
    let own = headless.device().facts().limits;
    headless.renderer.lower_limits(&own);
    // SAFETY: each frame was submitted before its test ended, but for one that a panic left, which never will be.
    unsafe { headless.renderer.shaders().keep_newest(MOST_PIPELINES) };
    #[cfg(feature = "test-formulas")]
    headless.renderer.perturb(None);
    Shared(Some(headless))
}

impl Deref for Shared {
    type Target = Headless;

    fn deref(&self) -> &Headless {
        self.0.as_ref().expect("it is there until it is dropped")
    }
}

impl DerefMut for Shared {
    fn deref_mut(&mut self) -> &mut Headless {
        self.0.as_mut().expect("it is there until it is dropped")
    }
}

impl Drop for Shared {
    fn drop(&mut self) {
        let said = self.device().instance().messages().take();
        RENDERERS.lock().unwrap_or_else(PoisonError::into_inner).free.extend(self.0.take());
        GIVEN_BACK.notify_one();
        if !std::thread::panicking() {
            assert!(said.is_empty(), "{} validation messages, the first: {:#?}", said.len(), said[0]);
        }
    }
}

/// The picture without the surface as data: tiles shade it themselves.
pub const PICTURE: Wanted = Wanted { surface: false, ..ALL };

/// The same scene, drawn in another way.
pub fn with(hard: &Hard, change: impl FnOnce(&mut Settings)) -> Hard {
    let mut hard = hard.clone();
    change(&mut hard.settings);
    hard
}

/// Uploads and renders one frame, with all that can be read back.
pub fn render(headless: &mut Headless, hard: &Hard) -> Frame {
    render_as(headless, hard, ALL)
}

/// Uploads and renders one frame.
pub fn render_as(headless: &mut Headless, hard: &Hard, wanted: Wanted) -> Frame {
    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    headless.render(&prepared, &hard.camera, &hard.settings, wanted).unwrap()
}

/// The names of a frame's passes.
pub fn passes(frame: &Frame) -> Vec<&str> {
    frame.plan.passes.iter().map(|pass| pass.name.as_ref()).collect()
}

/// Renders on both sides, prints the row of errors.
pub fn against_oracle(headless: &mut Headless, hard: &Hard) -> (Frame, Rc<Picture>, Errors) {
    let (frame, oracle) = (render(headless, hard), oracle_of(hard));
    let errors = compare::compare(&frame, &oracle);
    println!("{}", errors.row(hard.name));
    (frame, oracle, errors)
}

/// Fails where a frame differs from the oracle by more than the tolerances of 32 bits.
pub fn assert_agrees(headless: &mut Headless, hard: &Hard, at_least_px: usize) -> (Frame, Rc<Picture>) {
    let (frame, oracle, errors) = against_oracle(headless, hard);
    let beyond = errors.beyond(&compare::F32.of_at_least(at_least_px));
    assert!(beyond.is_empty(), "{}: {beyond:#?}", hard.name);
    (frame, oracle)
}

/// Runs `f` with limits lower than the device's.
pub fn with_limits<T>(
    headless: &mut Headless,
    lower: impl FnOnce(&mut Limits),
    f: impl FnOnce(&mut Headless) -> T,
) -> T {
    let own = headless.device().facts().limits;
    let mut limits = own;
    lower(&mut limits);
    headless.renderer.lower_limits(&limits);
    let result = f(headless);
    headless.renderer.lower_limits(&own);
    result
}

/// Runs `f` on a device whose points are so large at most: larger ones are drawn as quads.
pub fn with_points_up_to<T>(headless: &mut Headless, cap_px: f32, f: impl FnOnce(&mut Headless) -> T) -> T {
    with_limits(headless, |limits| limits.point_size_range[1] = cap_px.min(limits.point_size_range[1]), f)
}

/// Whether the device interpolates `triangle`'s (u, v) between corners that were moved to its grid of subpixels, of which the oracle does not
/// know: what the self-test knows of its driver tells so. A picture of it is held to its mean there, and no single pixel to a bound.
pub fn moves_corners(device: &surfel::vk::Device) -> bool {
    let driver = &device.facts().driver;
    let lists = surfel::selftest::Known::built_in().unwrap();
    let mut known = lists.iter().filter(|list| list.is_about(driver)).flat_map(|list| &list.entries);
    known.any(|entry| entry.pattern.matches("methods.triangle.adjust.sphere-of-disks"))
}

/// Whether two frames are the same bit by bit.
pub fn assert_same_bits(a: &Frame, b: &Frame, what: &str) {
    let different = compare::different_values(a, b);
    let pairs = a.linear.iter().flatten().zip(b.linear.iter().flatten());
    let most = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert_eq!(different, 0, "{what}: {different} values differ, of the picture by {most:e} at most");
}

/// Runs a test of this program once more, in a process of its own with these variables, and fails as it does; `false` in that
/// process, where the work is to be done.
pub fn ran_alone(test: &str, environment: &[(&str, &OsStr)]) -> bool {
    const ALONE: &str = "SURFEL_TEST_ALONE";
    if std::env::var_os(ALONE).is_some() {
        return false;
    }
    let mut program = Command::new(std::env::current_exe().unwrap());
    let output = program
        .args(["--exact", test, "--nocapture", "--include-ignored"])
        .env(ALONE, "1")
        .envs(environment.iter().copied())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    println!("{said}{}", String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success() && said.contains("1 passed"), "{test} failed in a process of its own");
    true
}
