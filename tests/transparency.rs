//! Transparency, polygons and hybrid scenes: GPU against the oracle's exact A-buffer, and what must hold of layers whatever
//! the scene.

mod common;

use common::{
    ALL, assert_validation_is_silent, render,
    scenes::{self, Hard, transparent},
    shared,
};
use surfel::{
    reference::{self, Picture},
    renderer::{Frame, Headless},
    selftest::light::{LightErrors, compare_light},
};

fn against_oracle(headless: &mut Headless, hard: &Hard) -> (Frame, Picture, LightErrors) {
    let frame = render(headless, hard);
    let oracle = reference::render(&hard.scene, &hard.camera, &hard.settings, &|_, _| {}).unwrap();
    let errors = compare_light(&frame, &oracle);
    println!("{}", errors.row(hard.name));
    (frame, oracle, errors)
}

#[test]
fn every_scene_agrees_with_the_oracle_in_32_bits() {
    let mut headless = shared();
    let mut failures = Vec::new();
    for hard in transparent::all() {
        let (_, _, errors) = against_oracle(&mut headless, &hard);
        if errors.worst > 2.0 / 1024.0 || errors.not_finite > 0 || errors.seen < 3000 {
            failures.push(format!("{}: {errors:?}", hard.name));
        }
    }
    assert_validation_is_silent(&headless);
    assert!(failures.is_empty(), "{failures:#?}");
}
