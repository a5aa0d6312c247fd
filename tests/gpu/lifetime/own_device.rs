//! Whichever call fails of a device of our own, that are to make it, to draw with it, to submit, to wait and to read what was measured, is named; nothing stays behind, and
//! the next renderer works, or the same one once more.

use std::collections::HashSet;

use ash::vk;
use surfel::{
    Error,
    graph::execute::Profile,
    renderer::{Headless, Wanted},
    scene::{Rasterizer, Scene, Settings},
    vk::{Device, Features, Instance},
};

use super::everything::settings;
use crate::common::{builder, faults, host::Host, scenes};

const ANSWERS: [vk::Result; 3] = [
    vk::Result::ERROR_DEVICE_LOST,
    vk::Result::ERROR_OUT_OF_DEVICE_MEMORY,
    vk::Result::ERROR_OUT_OF_HOST_MEMORY,
];

/// A scene goes to the device, and a frame of it comes back, with its times: two submissions.
fn picture(headless: &mut Headless) -> Result<Vec<[u8; 4]>, Error> {
    let scene = Scene { objects: vec![scenes::sphere(500, glam::DVec3::ZERO)], ..Scene::default() };
    let prepared = headless.prepare(&scene, &|_, _| {})?;
    let camera = builder::camera([0.0, 0.0, 3.2], [0.0; 3]);
    let settings = Settings { rasterizer: Rasterizer::Perspective, ..settings() };
    let wanted = Wanted { picture: true, profile: Some(Profile::Times), ..Wanted::default() };
    let frame = headless.render(&prepared, &camera, &settings, wanted)?;
    assert!(frame.profile.is_some());
    // All that was submitted before it is done, too.
    assert!(headless.queue().is_done(0)?);
    Ok(frame.srgb)
}

#[test]
fn whichever_call_of_our_own_device_fails_is_named_and_the_next_frame_is_as_it_was() {
    let host = Host::new(Features::NEEDED);
    // SAFETY: the host goes last.
    let instance = unsafe { Instance::borrow(faults::instance(&host.instance), true) };
    let asked = std::env::var("SURFEL_TEST_DEVICE").ok();
    let open = || Headless::on(Device::new(&instance, asked.as_deref())?, None);
    let check = |function: &str, answer: vk::Result, error: &Error| {
        faults::is_told(function, answer, error);
        assert_eq!(host.said(), [] as [String; 0], "{function}");
    };
    faults::take_called();
    let mut kept = open().unwrap();
    let of_device = faults::take_called();
    let expected = picture(&mut kept).unwrap();
    faults::take_called();
    assert!(picture(&mut kept).unwrap() == expected);
    let of_frame = faults::take_called();

    // A renderer that is kept draws again after each call of a frame that failed.
    let mut failed = HashSet::new();
    for answer in ANSWERS {
        for succeed in 0.. {
            faults::fail_so(succeed, answer);
            let result = picture(&mut kept);
            let Some(function) = faults::stop() else { break };
            check(function, answer, &result.expect_err(function));
            failed.insert(function);
            assert!(picture(&mut kept).unwrap() == expected, "after {succeed}: {function}");
            assert_eq!(host.said(), [] as [String; 0], "{succeed}: {function}");
        }
    }
    println!("{} calls of a frame: {failed:?}", of_frame.len());
    for function in [
        "queue_submit2",
        "wait_semaphores",
        "get_semaphore_counter_value",
        "get_query_pool_results",
        "reset_command_pool",
    ] {
        assert!(failed.contains(function) && of_frame.contains(&function), "{function}: {of_frame:?}");
    }
    drop(kept);
    assert_eq!(host.said(), [] as [String; 0]);

    // Of a renderer that is made, the first and the last call of each function.
    let is_end = |i: &usize| {
        let is = |call: &&str| *call == of_device[*i];
        !of_device[..*i].iter().any(is) || !of_device[i + 1..].iter().any(is)
    };
    for (number, succeed) in (0..of_device.len()).filter(is_end).enumerate() {
        let answer = ANSWERS[number % ANSWERS.len()];
        faults::fail_so(succeed as u32, answer);
        let result = open();
        let function = faults::stop().unwrap();
        check(function, answer, &result.err().expect(function));
        failed.insert(function);
    }
    for function in ["enumerate_physical_devices", "create_device", "create_semaphore", "create_command_pool"]
    {
        assert!(failed.contains(function), "{function}: {of_device:?}");
    }
    let mut next = open().unwrap();
    assert!(picture(&mut next).unwrap() == expected);
    drop(next);
    drop(instance);
    assert_eq!(host.destroy(), [] as [String; 0]);
}
