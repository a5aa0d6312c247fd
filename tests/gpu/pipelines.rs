//! How many pipelines frames make, and how hosts give them up.

use std::time::Duration;

use ash::vk;
use surfel::{
    hard_scenes::Hard,
    renderer::{Headless, Seen},
    scene::Rasterizer,
};

use crate::common::{PICTURE, headless, render_as, scenes, with};

fn count(headless: &Headless) -> usize {
    headless.renderer.shaders().pipeline_names().len()
}

/// From within the scene to where it is a few pixels large.
fn at(hard: &Hard, step: u32) -> Hard {
    let mut hard = hard.clone();
    hard.camera.eye *= 0.32 * 1.07_f64.powi(step as i32);
    hard
}

#[test]
fn a_camera_that_moves_makes_few_pipelines_and_those_that_are_given_up_are_made_again() {
    let mut headless = headless();
    let hard = with(&scenes::sphere_of_disks(), |settings| settings.rasterizer = Rasterizer::Compute);
    let mut counts = Vec::new();
    for step in 0..60 {
        render_as(&mut headless, &at(&hard, step), PICTURE);
        counts.push(count(&headless));
    }
    println!("{counts:?}");
    // One frame has about ten; what views differ in are a few numbers of tiles, and what is listed or left to the graphics pipeline.
    assert!(counts[59] <= 40 && counts[59] - counts[30] <= 10, "{counts:?}");
    let near = at(&hard, 2);
    let before = render_as(&mut headless, &near, PICTURE).linear;
    let keep = |headless: &Headless, most: usize| {
        // SAFETY: every frame was waited for.
        unsafe { headless.renderer.shaders().keep_newest(most) };
    };
    keep(&headless, 1000);
    assert_eq!(count(&headless), counts[59]);
    keep(&headless, 0);
    assert_eq!(count(&headless), 0);
    assert_eq!(render_as(&mut headless, &near, PICTURE).linear, before);
    let of_one = count(&headless);
    render_as(&mut headless, &at(&hard, 50), PICTURE);
    keep(&headless, of_one);
    assert_eq!(count(&headless), of_one);
}

#[test]
fn pipelines_are_made_one_a_turn_ahead_of_a_frame_that_makes_none_then() {
    let mut headless = headless();
    for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective] {
        let hard = with(&scenes::sphere_of_disks(), |settings| settings.rasterizer = rasterizer);
        let scene = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
        let (format, before) = (vk::Format::R32G32B32A32_SFLOAT, headless.renderer.pipelines_made());
        let turn = |headless: &Headless, time| {
            headless
                .renderer
                .make_pipelines(
                    Seen { scene: &scene, camera: &hard.camera, settings: &hard.settings },
                    format,
                    time,
                )
                .unwrap()
        };
        let mut turns = 1;
        while !turn(&headless, Duration::ZERO) {
            assert_eq!(headless.renderer.pipelines_made(), before + turns);
            turns += 1;
        }
        assert!(turns > 2 && headless.renderer.pipelines_made() == before + turns, "{turns}");
        headless.render(&scene, &hard.camera, &hard.settings, PICTURE).unwrap();
        assert!(turn(&headless, Duration::ZERO));
        assert_eq!(headless.renderer.pipelines_made(), before + turns);
        // SAFETY: every frame was waited for.
        unsafe { headless.renderer.shaders().keep_newest(0) };
        assert!(turn(&headless, Duration::from_secs(600)), "all in one turn");
    }
}

/// A device tells what it has drawn with, and another one knows these pipelines of its own frames, from elsewhere, too, but no others.
#[test]
fn what_ran_on_another_device_is_known_by_what_it_is_made_of() {
    let [mut other, own] = [(); 2].map(|()| headless());
    let hard = with(&scenes::sphere_of_disks(), |settings| settings.rasterizer = Rasterizer::Compute);
    let scene = own.prepare(&hard.scene, &|_, _| {}).unwrap();
    let shaders = own.renderer.shaders();
    let has_run = |hard: &Hard| {
        let (time, format) = (shaders.time(), vk::Format::R32G32B32A32_SFLOAT);
        let seen = Seen { scene: &scene, camera: &hard.camera, settings: &hard.settings };
        assert!(own.renderer.make_pipelines(seen, format, Duration::from_secs(600)).unwrap());
        shaders.have_run_since(time)
    };
    assert!(!has_run(&hard));
    render_as(&mut other, &hard, PICTURE);
    let numbers = other.renderer.shaders().numbers();
    assert_eq!(numbers.len(), count(&other));
    shaders.ran_elsewhere(&numbers);
    assert!(has_run(&hard));
    // Tiles of other heights.
    let far = at(&hard, 55);
    assert!(!has_run(&far));
    render_as(&mut other, &far, PICTURE);
    shaders.ran_elsewhere(&other.renderer.shaders().numbers());
    assert!(has_run(&far) && has_run(&hard));
    // SAFETY: every frame was waited for.
    unsafe { shaders.keep_newest(0) };
    assert!(shaders.numbers().is_empty() && has_run(&hard), "what was compiled stays known");
    assert!(!has_run(&with(&hard, |settings| settings.rasterizer = Rasterizer::Perspective)));
}
