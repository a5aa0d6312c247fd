//! What the tests of the GPU path share: a validated device, scenes with known difficulties, and the comparison with
//! the oracle.

#![allow(dead_code, reason = "each test binary uses its own part")]

pub mod compare;
pub mod faults;
pub mod host;
pub mod scenes;
pub mod watched;

use std::sync::Once;

use surfel::{
    renderer::{Headless, HeadlessOptions},
    vk::{Validation, arm_validation_across_submits},
};

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

/// Fails if the validation layer said anything so far; prints how often the allow-list was hit.
pub fn assert_validation_is_silent(headless: &Headless) {
    let messages = headless.device().instance().messages();
    for (vuid, hits) in messages.allowed_hits() {
        println!("allowed: {vuid} {hits} times");
    }
    let said = messages.all();
    assert!(said.is_empty(), "{} validation messages, the first: {:#?}", said.len(), said[0]);
}
