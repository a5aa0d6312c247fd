//! The GPU path against the f64 oracle, on every hard scene.

mod common;

use common::{assert_validation_is_silent, compare, headless, scenes};
use surfel::{reference, renderer::Wanted};

const SURFACE: Wanted = Wanted { picture: false, linear: false, surface: true, profile: None };

#[test]
fn every_hard_scene_agrees_with_the_oracle_in_32_bits() {
    let mut headless = headless();
    let mut failures = Vec::new();
    for hard in scenes::all() {
        let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
        let frame = headless.render(&prepared, &hard.camera, &hard.settings, SURFACE).unwrap();
        let oracle = reference::render(&hard.scene, &hard.camera, &hard.settings, &|_, _| {}).unwrap();
        let errors = compare::compare(&frame, &oracle);
        println!("{}", errors.row(hard.name));
        assert_eq!(prepared.defects, oracle.defects, "{}", hard.name);
        for beyond in errors.beyond(&compare::F32) {
            failures.push(format!("{}: {beyond}", hard.name));
        }
    }
    assert_validation_is_silent(&headless);
    assert!(failures.is_empty(), "{failures:#?}");
}
