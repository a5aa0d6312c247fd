//! `surfel selftest`: a handful of its cases.

use std::fs;

use quick_junit::{Report, TestCaseStatus};

use super::program::{Folder, Run, surfel, surfel_with};

/// Ten cases, eight scenes of disks and two of ellipses.
const FEW: [&str; 3] = ["selftest", "--case", "methods.perspective.adjust"];

fn few(folder: &Folder, words: &[&str]) -> Run {
    surfel(folder, &[&FEW, words].concat())
}

/// Every rasterizer with every option, on one scene.
#[test]
fn cases_pass_and_both_files_tell_of_each() {
    let folder = Folder::new();
    let sphere = ["selftest", "--quick", "--case", "*.adjust.sphere-of-disks"];
    let run = surfel(&folder, &[&sphere[..], &["--junit", "a.xml", "--json", "a.json"]].concat());
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{}", run.stdout);
    let names = surfel(&folder, &[&sphere[..], &["--list"]].concat()).stdout;
    let names: Vec<&str> = names.lines().collect();
    assert!(
        names.len() > 100 && names[0] == "device.open" && names.ends_with(&["device.close"]),
        "{names:?}"
    );
    for text in ["Vulkan 1.", "validation layer", "methods", "repeat", "seconds"] {
        assert!(run.stdout.contains(text), "{}", run.stdout);
    }

    let report = folder.json("a.json");
    let cases = report["cases"].as_array().unwrap();
    assert_eq!(cases.iter().map(|case| case["name"].as_str().unwrap()).collect::<Vec<_>>(), names);
    let counts = &report["counts"];
    assert_eq!((&counts["cases"], &counts["pass"]), (&names.len().into(), &names.len().into()));
    assert_eq!((&report["form"], &report["retries"]), (&"quick".into(), &2.into()));
    assert!(report["device"]["driver"].is_string() && report["validation"]["layer"].is_string());
    let sphere =
        cases.iter().find(|case| case["name"] == "methods.perspective.adjust.sphere-of-disks").unwrap();
    assert_eq!((&sphere["status"], &sphere["settings"]["accumulate"]), (&"pass".into(), &"f32".into()));
    let weight = sphere["figures"]["weight"].as_f64().unwrap();
    assert!(weight > 0.0 && weight < 1e-3, "{weight}");

    let report = Report::deserialize_from_str(&fs::read_to_string(folder.path("a.xml")).unwrap()).unwrap();
    assert_eq!((report.tests, report.failures, report.errors), (names.len(), 0, 0));
    let cases = report.test_suites.iter().flat_map(|suite| &suite.test_cases);
    let mut of_xml: Vec<&str> = cases.map(|case| case.name.as_str()).collect();
    let mut sorted = names.clone();
    of_xml.sort_unstable();
    sorted.sort_unstable();
    assert_eq!(of_xml, sorted);
    let property =
        |name: &str| report.test_suites[0].properties.iter().find(|p| p.name.as_str() == name).unwrap();
    assert!(!property("driver").value.is_empty() && !property("validation_layer").value.is_empty());
}

#[test]
fn a_list_that_is_out_of_date_fails_the_run_and_the_files_say_so() {
    let folder = Folder::new();
    let name = "methods.perspective.adjust.sphere-of-disks";
    let skipped = "methods.perspective.adjust.edge-on-disks";
    folder.write("k.txt", format!("\nfail {name} # once it did\nskip {skipped} # too hard"));
    let run = few(&folder, &["--known", "k.txt", "--verbose", "--junit", "a.xml", "--json", "a.json"]);
    assert_eq!(run.code, 3, "{}", run.stderr);
    let fixed = format!("fixed      {name}: passes, but is listed as a failure | once it did (k.txt:2)\n");
    assert!(
        run.stderr.contains(&fixed) && run.stderr.contains(&format!("run        {name}\n")),
        "{}",
        run.stderr
    );
    let end = format!("surfel: 0 of 15 case(s) failed and 1 passed against the list, the first: {name}\n");
    assert!(run.stderr.ends_with(&end), "{}", run.stderr);
    assert!(run.stdout.contains("skipped, 1 case(s): too hard (k.txt:3)\n"), "{}", run.stdout);

    let report = folder.json("a.json");
    assert_eq!((&report["counts"]["fixed"], &report["counts"]["skip"]), (&1.into(), &1.into()));
    assert!(report["known_lists"].as_array().unwrap().contains(&"k.txt".into()));
    let report = Report::deserialize_from_str(&fs::read_to_string(folder.path("a.xml")).unwrap()).unwrap();
    assert_eq!((report.tests, report.failures), (15, 1));
    for case in report.test_suites.iter().flat_map(|suite| &suite.test_cases) {
        let as_expected = match case.name.as_str() {
            case_name if case_name == name => matches!(case.status, TestCaseStatus::NonSuccess { .. }),
            case_name if case_name == skipped => matches!(case.status, TestCaseStatus::Skipped { .. }),
            _ => matches!(case.status, TestCaseStatus::Success { .. }),
        };
        assert!(as_expected, "{case:?}");
    }
}

#[test]
fn the_quick_list_is_a_part_of_the_full_one_and_needs_no_device() {
    let folder = Folder::new();
    let nowhere = [("VK_DRIVER_FILES", "/nonexistent"), ("VK_ICD_FILENAMES", "/nonexistent")];
    let list = |words: &[&str]| {
        let run = surfel_with(&folder, &[&["selftest", "--list"], words].concat(), &nowhere);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""));
        run.stdout.lines().map(str::to_owned).collect::<Vec<_>>()
    };
    let (full, quick) = (list(&[]), list(&["--quick"]));
    assert!(quick.len() > 50 && quick.len() * 5 < full.len(), "{} of {}", quick.len(), full.len());
    assert!(quick.iter().all(|case| full.contains(case)));
    let refused = surfel_with(&folder, &FEW, &nowhere);
    assert_eq!((refused.code, refused.stderr.lines().count()), (2, 1), "{}", refused.stderr);
}

#[test]
fn faults_are_found_before_the_cases_are_run() {
    let folder = Folder::new();
    folder.write("typo.txt", "fail methods.perspective.adjust # why\n\nskip methods.perspectiv # why\n");
    folder.write("word.txt", "xfail methods # why\n");
    folder.write("bytes.txt", [0xFF, 0xFE, 0x00]);
    let before = folder.names();
    let cases: [(&[&str], &str); 10] = [
        (&["--known", "typo.txt"], "typo.txt: line 3: methods.perspectiv: matches no case"),
        (&["--known", "word.txt"], "word.txt: line 1: 'xfail': expected driver, fail, flake or skip"),
        (
            &["--known", "bytes.txt"],
            "bytes.txt: line 1: not UTF-8; expected a list of what is known of drivers",
        ),
        (&["--known", "none.txt"], "none.txt: cannot read: No such file"),
        (
            &["--case", "methods.cube"],
            "--case: methods.cube: matches no case; surfel selftest --list prints them all",
        ),
        (&["--case", "Methods"], "'M' is in no case's name"),
        (&["--junit", "no/such/a.xml"], "no/such/a.xml: cannot write"),
        (&["--junit", "a", "--json", "a"], "a: is an input, or written twice"),
        (&["--list", "--json", "a.json"], "cannot be used with"),
        (&["--device", "no such device"], "--device: 'no such device' is none of"),
    ];
    for (words, expected) in cases {
        let run = few(&folder, words);
        assert_eq!((run.code, run.stdout.as_str()), (1, ""), "{words:?}: {}", run.stderr);
        assert!(
            run.stderr.contains(expected) && run.stderr.lines().count() == 1,
            "{words:?}: {}",
            run.stderr
        );
    }
    assert_eq!(folder.names(), before);
}

#[test]
fn without_the_layer_it_says_what_to_do_and_goes_without() {
    let folder = Folder::new();
    let empty = folder.path("layers");
    fs::create_dir(&empty).unwrap();
    let layers = [("VK_LAYER_PATH", empty.to_str().unwrap())];
    let run = surfel_with(&folder, &FEW, &layers);
    assert!(run.code == 2 && run.stderr.contains("--no-validate goes without"), "{}", run.stderr);
    let words = ["selftest", "--no-validate", "--case", "methods.perspective.adjust.sphere-of-disks"];
    let run = surfel_with(&folder, &words, &layers);
    assert!(run.code == 0 && run.stdout.contains("\nnot validated; "), "{} {}", run.stdout, run.stderr);
}
