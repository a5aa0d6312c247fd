//! What drivers tell of windows and devices that go: the window goes on, or says why it does not. A layer (`faults.c`, compiled by the system's compiler) has the
//! calls fail.

use std::{
    env, fs,
    path::{Path, PathBuf},
    process::Command,
};

use ash::vk::Result as Vk;

use super::{
    CAMERA,
    screen::{Screen, Shot},
    window::{Folder, View, render},
};

const SIZE: [&str; 2] = ["--size", "320x240"];

/// The calls of a function, counted from 1, of which one fails, and how.
type Fault = (&'static str, u32, Vk);

/// The layer, where the loader finds it.
fn layer(folder: &Folder) -> PathBuf {
    let (library, source) =
        (folder.path("libfaults.so"), Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/view/faults.c"));
    let mut cc = Command::new(env::var_os("CC").unwrap_or_else(|| "cc".into()));
    cc.args(["-std=c11", "-O1", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-shared", "-fPIC", "-o"]);
    let output =
        cc.arg(&library).arg(source).output().expect("needs a C compiler: third_party/with-deps installs it");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let layer = format!(
        r#"{{"name": "VK_LAYER_SURFEL_faults", "type": "GLOBAL", "library_path": "{}", "api_version": "1.3.0",
            "implementation_version": "1", "description": "calls that fail", "enable_environment": {{"SURFEL_FAULTY": "1"}},
            "disable_environment": {{"SURFEL_FAULTLESS": "1"}}}}"#,
        library.display()
    );
    let manifests = folder.path("vulkan/implicit_layer.d");
    fs::create_dir_all(&manifests).unwrap();
    folder.write(
        "vulkan/implicit_layer.d/faults.json",
        &format!(r#"{{"file_format_version": "1.1.2", "layer": {layer}}}"#),
    );
    folder.path("")
}

/// A window that shows a picture, and in which calls fail from then on.
fn open<'a>(screen: &'a Screen, folder: &'a Folder, faults: &[Fault]) -> View<'a> {
    let line = |(function, call, answer): &Fault| format!("{function} {call} {}\n", answer.as_raw());
    let path = folder.path("faults");
    let words = [&SIZE[..], &CAMERA].concat();
    let mut view = open_below(screen, folder, &words, ("SURFEL_FAULTS", &path.display().to_string()));
    view.wait_for(&home(folder));
    folder.write("new", &faults.iter().map(line).collect::<String>());
    fs::rename(folder.path("new"), path).unwrap();
    view
}

/// A window whose calls go through the layer, which is told so much.
pub fn open_below<'a>(
    screen: &'a Screen,
    folder: &'a Folder,
    words: &[&str],
    told: (&str, &str),
) -> View<'a> {
    let path = layer(folder).display().to_string();
    let environment = [("XDG_DATA_HOME", &*path), ("SURFEL_FAULTY", "1"), told];
    View::open_in(screen, folder, words, true, &environment)
}

/// Turns the picture until so many calls have failed, and no longer.
fn play(screen: &Screen, view: &mut View<'_>, faults: usize) {
    for turn in 0..200 {
        if view.said().matches("fault: vk").count() >= faults || !view.is_running() {
            return;
        }
        let y = 100 + turn % 40;
        screen.drag([100, y], [140, y], 1);
    }
    panic!("these calls never come: {}", view.said());
}

fn home(folder: &Folder) -> Shot {
    render(folder, &[&SIZE[..], &CAMERA].concat())
}

/// The window's own troubles cost it nothing but a frame.
#[test]
fn a_window_goes_on_where_its_surface_is_lost_or_its_images_do_not_fit() {
    let (screen, folder) = (Screen::new(), Folder::new());
    let faults = [
        ("vkAcquireNextImageKHR", 3, Vk::ERROR_OUT_OF_DATE_KHR),
        ("vkAcquireNextImageKHR", 6, Vk::SUBOPTIMAL_KHR),
        ("vkAcquireNextImageKHR", 9, Vk::ERROR_SURFACE_LOST_KHR),
        ("vkAcquireNextImageKHR", 12, Vk::TIMEOUT),
        ("vkQueuePresentKHR", 14, Vk::ERROR_OUT_OF_DATE_KHR),
        ("vkQueuePresentKHR", 17, Vk::SUBOPTIMAL_KHR),
        ("vkQueuePresentKHR", 20, Vk::ERROR_SURFACE_LOST_KHR),
        // Those of the frames that follow such an answer.
        ("vkCreateSwapchainKHR", 2, Vk::ERROR_SURFACE_LOST_KHR),
        ("vkGetPhysicalDeviceSurfaceCapabilitiesKHR", 5, Vk::ERROR_SURFACE_LOST_KHR),
    ];
    let mut view = open(&screen, &folder, &faults);
    play(&screen, &mut view, faults.len());
    let home = home(&folder);
    view.wait_until("it has turned", |shot| shot.differs_from(&home) > 1000);
    screen.key("h");
    view.wait_for(&home);
    let said = view.end();
    assert!(!said.stderr.contains("another swapchain"), "{}", said.stderr);
}

/// Whatever the call that tells it, a device that is lost is opened again, for the same window and the same view.
#[test]
fn a_device_that_is_lost_is_opened_again_and_shows_the_same() {
    let calls = [
        "vkQueueSubmit2",
        "vkWaitSemaphores",
        "vkGetSemaphoreCounterValue",
        "vkAcquireNextImageKHR",
        "vkQueuePresentKHR",
    ];
    for function in calls {
        let (screen, folder) = (Screen::new(), Folder::new());
        let mut view = open(&screen, &folder, &[(function, 12, Vk::ERROR_DEVICE_LOST)]);
        play(&screen, &mut view, 1);
        let camera = view.camera();
        let words: Vec<&str> = SIZE.into_iter().chain(camera.iter().map(String::as_str)).collect();
        view.wait_for(&render(&folder, &words));
        screen.key("h");
        view.wait_for(&home(&folder));
        let said = view.end().stderr;
        let told = "the device was lost and is opened again";
        assert!(said.matches(told).count() == 1 && !said.contains("another swapchain"), "{function}: {said}");
    }
}

/// One that is lost again at once would be lost for ever.
#[test]
fn a_device_that_is_lost_again_ends_the_window_with_the_call_that_told_it() {
    let (screen, folder) = (Screen::new(), Folder::new());
    let lost = Vk::ERROR_DEVICE_LOST;
    let mut view = open(&screen, &folder, &[("vkQueueSubmit2", 10, lost), ("vkQueueSubmit2", 20, lost)]);
    play(&screen, &mut view, 2);
    let said = view.wait_for_end();
    let last: Vec<&str> = said.stderr.lines().filter(|line| line.starts_with("surfel: ")).collect();
    assert_eq!(said.code, 2, "{}", said.stderr);
    assert!(last.len() == 1 && last[0].contains("vkQueueSubmit2"), "{}", said.stderr);
}
