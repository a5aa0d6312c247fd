//! The self-test tested: it sees what is wrong, says of which case, and knows what is known.

use std::collections::HashSet;

use crate::common::{
    cases::{result, results},
    headless,
    watched::fill,
};
use ash::vk;
use surfel::{
    scene::{Filter, Rasterizer},
    selftest::{Case, CaseResult, Known, Status, Suite, run},
    vk::{Buffer, BufferDesc, CommandPool, Device, MemoryUse},
};

const SPHERE: &str = "methods.perspective.adjust.sphere-of-disks";

/// Every method and every option once, the default ones on every hard scene: GPU against oracle, pixel by pixel.
#[test]
fn every_quick_case_passes() {
    assert_all_pass(&|case| case.quick);
}

#[test]
#[ignore = "every method with every option on every hard scene: minutes"]
fn every_case_passes() {
    assert_all_pass(&|_| true);
}

fn assert_all_pass(is_run: &dyn Fn(&Case) -> bool) {
    let headless = headless();
    let driver = headless.device().facts().driver.clone();
    let suite = Suite::new();
    let names = suite.cases.iter().map(|case| case.name.as_str());
    let known = Known::of_driver(Known::built_in().unwrap(), &driver, names).unwrap();
    let cases: Vec<_> = suite.cases.iter().filter(|case| is_run(case)).collect();
    let outcome = run(headless, &suite, &cases, &known, 0, &mut |_| {});
    let wrong = outcome.results.iter().filter(|result| result.status.fails_the_run());
    let wrong: Vec<String> = wrong.map(CaseResult::line).collect();
    assert!(
        wrong.is_empty() && outcome.results.len() == cases.len(),
        "{} of {}: {wrong:#?}",
        wrong.len(),
        cases.len()
    );
}

#[test]
fn a_list_knows_what_fails_and_what_passes_against_it_is_told() {
    let list = "fail methods.perspective.adjust # the kernel is wrong\n\
                flake methods.quad.adjust # now and then\n\
                skip methods.triangle # takes too long\n";
    let run = |wrong: bool| {
        let headless = headless();
        let device = headless.device().clone();
        results(headless, "methods.*.adjust.sphere-of-disks", list, &mut |case| {
            if wrong && case.starts_with("methods") {
                record_what_is_not_allowed(&device);
            }
        })
    };
    let (wrong, right) = (run(true), run(false));
    // What the layer says once makes the first try fail.
    for (name, when_wrong, when_right) in [
        ("perspective", (Status::KnownFail, 1), (Status::Fixed, 1)),
        ("quad", (Status::Flake, 2), (Status::Pass, 1)),
        ("triangle", (Status::Skip, 0), (Status::Skip, 0)),
        ("raycast", (Status::Fail, 2), (Status::Pass, 1)),
    ] {
        let name = format!("methods.{name}.adjust.sphere-of-disks");
        for (results, expected) in [(&wrong, when_wrong), (&right, when_right)] {
            let result = result(results, &name);
            assert_eq!((result.status, result.attempts), expected, "{}", result.line());
        }
    }
    let fixed = result(&right, SPHERE);
    assert_eq!(fixed.reason.as_deref(), Some("the kernel is wrong (k.txt:1)"));
    assert!(fixed.line().contains("passes, but is listed as a failure"), "{}", fixed.line());
}

#[test]
fn what_the_layer_says_fails_the_case_during_which_it_is_said() {
    let headless = headless();
    let device = headless.device().clone();
    let results = results(headless, "methods.quad.*.sphere-of-disks", "", &mut |case| {
        if case == "methods.quad.none.sphere-of-disks" || case == "device.close" {
            record_what_is_not_allowed(&device);
        }
    });
    for result in &results {
        let spoken = result.name == "methods.quad.none.sphere-of-disks" || result.name == "device.close";
        assert_eq!(result.status, if spoken { Status::Fail } else { Status::Pass }, "{}", result.line());
        assert_eq!(
            result.line().contains("VUID-vkCmdFillBuffer-dstBuffer-00029"),
            spoken,
            "{}",
            result.line()
        );
        // It was said once: the second try was silent, which does not undo the first.
        assert_eq!((result.attempts, result.failed_attempts), if spoken { (2, 1) } else { (1, 0) });
    }
    assert_eq!(results.len(), 7);
}

#[test]
fn what_the_layer_says_outside_of_cases_can_be_known_and_is_no_other_cases() {
    let headless = headless();
    let device = headless.device().clone();
    let list = "skip device # the loader's own layers talk\n";
    for result in results(headless, SPHERE, list, &mut |case| {
        if case.starts_with("device") {
            record_what_is_not_allowed(&device);
        }
    }) {
        let expected = if result.name == SPHERE { Status::Pass } else { Status::Skip };
        assert_eq!(result.status, expected, "{}", result.line());
    }
}

/// A fill of a buffer that was not made for that; never submitted.
fn record_what_is_not_allowed(device: &Device) {
    let desc = BufferDesc { name: "the buffer", size: 4096, usage: vk::BufferUsageFlags::TRANSFER_SRC };
    let buffer = Buffer::new(device, desc, MemoryUse::Device).unwrap();
    let pool = CommandPool::new(device, "program").unwrap();
    // SAFETY: the pool is new, and what is recorded is never submitted.
    fill(device.raw(), unsafe { pool.begin() }.unwrap(), &buffer);
}

#[test]
fn what_the_device_cannot_do_is_skipped_with_the_reason() {
    let mut headless = headless();
    let mut limits = headless.device().facts().limits;
    limits.max_image_side = 64;
    headless.renderer.lower_limits(&limits);
    for result in results(headless, "methods.quad", "", &mut |_| {}) {
        let drawn = result.name.starts_with("methods");
        assert_eq!(result.status, if drawn { Status::Skip } else { Status::Pass });
        assert_eq!(result.reason.is_some_and(|reason| reason.contains("draws at most 64x64")), drawn);
    }
}

#[test]
fn the_quick_form_has_every_method_every_option_and_every_scene() {
    let suite = Suite::new();
    let names: HashSet<&str> = suite.cases.iter().map(|case| case.name.as_str()).collect();
    assert_eq!(names.len(), suite.cases.len());
    assert!(names.contains("methods.perspective.adjust.edge-on-disks"));
    let quick: Vec<_> = suite.cases.iter().filter(|case| case.quick).collect();
    println!("{} cases, {} of them quick", suite.cases.len(), quick.len());
    assert!(10 * quick.len() < 2 * suite.cases.len());
    // The parts of names, each in its place.
    let parts = |quick_alone: bool, place: usize| -> HashSet<&str> {
        let cases = suite.cases.iter().filter(|case| case.quick || !quick_alone);
        cases.filter_map(|case| case.name.split('.').nth(place)).collect()
    };
    for place in 0..4 {
        assert_eq!(parts(true, place), parts(false, place));
    }
    let scenes = surfel::hard_scenes::all().len() + surfel::hard_scenes::transparent::all().len();
    assert_eq!(parts(true, 3).len(), scenes);
    for (name, _) in Rasterizer::METHODS {
        for (filter, _) in Filter::NAMES {
            let method = format!("methods.{name}.{filter}.");
            let has = |case: &Case| case.name.starts_with(&method);
            assert_eq!(quick.iter().any(|case| has(case)), suite.cases.iter().any(has), "{method}");
        }
        let peels = format!("layers.{name}.");
        assert!(quick.iter().any(|case| case.name.starts_with(&peels)), "{peels}");
    }
    for (filter, _) in Filter::NAMES {
        let peels = format!("layers.perspective.{filter}.");
        assert!(quick.iter().any(|case| case.name.starts_with(&peels)), "{peels}");
    }
}
