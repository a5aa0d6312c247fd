//! The self-test sees what is wrong with a device, and says of which case.

use surfel::{
    passes::Formula,
    renderer::Headless,
    selftest::{CaseResult, Status},
};

use crate::common::{
    cases::{result, results},
    headless,
};

fn perturbed(formula: Formula) -> Headless {
    let mut headless = headless();
    headless.renderer.perturb(Some(formula));
    headless
}

#[test]
fn a_formula_that_is_wrong_fails_every_case_that_it_is_in_and_no_other() {
    for group in ["methods", "kernel-texture", "sums-16"] {
        let pattern = format!("{group}.perspective.adjust.sphere-of-disks");
        for result in results(perturbed(Formula::NormalizedColor), &pattern, "", &mut |_| {}) {
            let wrong = result.name == pattern;
            assert_eq!(result.status, if wrong { Status::Fail } else { Status::Pass }, "{}", result.line());
            assert_eq!(result.problems.iter().any(|problem| problem.contains("albedo")), wrong);
            assert_eq!(result.attempts, if wrong { 3 } else { 1 });
        }
    }
    // What is wrong alike in both pictures is no fault of cases that compare two, and the other way round.
    let every_group = "*.perspective.adjust.sphere-of-disks";
    let wrong_in_both = results(perturbed(Formula::Kernel), every_group, "", &mut |_| {});
    for (group, in_both) in [("methods", Status::Fail), ("sums-16", Status::Fail), ("repeat", Status::Pass)] {
        let name = format!("{group}.perspective.adjust.sphere-of-disks");
        assert_eq!(result(&wrong_in_both, &name).status, in_both, "{name}");
    }
}

#[test]
fn each_formula_of_layers_that_is_wrong_fails_a_case_of_them_but_none_that_compares_two_pictures_with_it() {
    for formula in Formula::OF_LAYERS {
        let scenes = match formula {
            Formula::Alpha | Formula::Peeled | Formula::Over => "interpenetrating-shells",
            Formula::LitDiffuse => "polygons-only-lit",
            Formula::LitSpecular | Formula::Stacked => "last-layer-*",
            _ => "*splats*",
        };
        let pattern = format!("layers*.perspective.adjust.{scenes}");
        let wrong = results(perturbed(formula), &pattern, "", &mut |_| {});
        let failed: Vec<&CaseResult> = wrong.iter().filter(|case| case.status == Status::Fail).collect();
        let of = |group: &str| failed.iter().filter(|case| case.group() == group).count();
        // One percent is within what 16-bit sums may be off.
        assert!(of("layers") > 0 && of("layers-auto") == 0, "{formula:?}");
        assert!(failed.iter().all(|case| case.problems[0].contains("color")), "{formula:?}");
    }
}
