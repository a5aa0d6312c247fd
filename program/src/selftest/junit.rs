//! The report as JUnit XML, which CI systems show: a group of cases is a test suite.

use std::{io, time::Duration};

use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestRerun, TestSuite};
use surfel::{
    Error, Result,
    selftest::{CaseResult, SelftestReport, Status},
};

/// The XML.
///
/// # Errors
/// None: there is nothing in a report that XML can't hold.
pub fn text(report: &SelftestReport) -> Result<String> {
    let mut xml = Report::new("surfel selftest");
    xml.set_time(duration(report.secs));
    for (name, cases) in report.groups() {
        let mut suite = TestSuite::new(name);
        for (name, value) in &properties(report) {
            suite.add_property((*name, value.as_str()));
        }
        suite.set_time(duration(cases.iter().map(|case| case.secs).sum()));
        suite.add_test_cases(cases.into_iter().map(case));
        xml.add_test_suite(suite);
    }
    xml.to_string().map_err(|error| Error::file("JUnit XML", "write", io::Error::other(error)))
}

/// The device and the form of the run.
fn properties(report: &SelftestReport) -> Vec<(&'static str, String)> {
    let [vendor, device, driver] = report.ids;
    let validation = report.validation.as_ref().map_or("off", |validation| &validation.layer);
    vec![
        ("surfel", report.surfel.clone()),
        ("form", report.form.to_owned()),
        ("device", report.device.name.clone()),
        ("driver", report.device.driver.clone()),
        ("vulkan", report.device.api_version.clone()),
        ("vendor_id", format!("{vendor:#x}")),
        ("device_id", format!("{device:#x}")),
        ("driver_version", format!("{driver:#x}")),
        ("vulkan_loader", report.vulkan_loader.clone()),
        ("validation_layer", validation.to_owned()),
        ("known_lists", report.known_lists.join(", ")),
        ("retries", report.retries.to_string()),
    ]
}

/// The element of a case. Known fails keep a run green: they count as skipped, as flakes do that never passed.
fn case(result: &CaseResult) -> TestCase {
    let reason = result.reason.as_deref().unwrap_or_default();
    let problems = result.problems.join("\n");
    let about = |mut status: TestCaseStatus, message: String| {
        status.set_message(message).set_type(result.status.name());
        if !problems.is_empty() {
            status.set_description(problems.as_str());
        }
        status
    };
    let first = || result.problems.first().cloned().unwrap_or_default();
    let status = match result.status {
        Status::Pass => TestCaseStatus::success(),
        Status::Fail => about(TestCaseStatus::non_success(NonSuccessKind::Failure), first()),
        Status::Fixed => {
            let message = format!("passes, but is listed as a failure: {reason}");
            about(TestCaseStatus::non_success(NonSuccessKind::Failure), message)
        }
        Status::Flake if result.failed_attempts < result.attempts => {
            let mut status = TestCaseStatus::success();
            let mut rerun = TestRerun::new(NonSuccessKind::Failure);
            rerun.set_type(result.status.name()).set_message(first()).set_description(problems.as_str());
            status.add_rerun(rerun);
            status
        }
        Status::Flake | Status::KnownFail | Status::Skip => {
            about(TestCaseStatus::skipped(), format!("{}: {reason}", result.status.name()))
        }
    };
    let mut case = TestCase::new(result.name.as_str(), status);
    let class = result.name.rsplit_once('.').map_or("", |(class, _)| class);
    case.set_classname(class).set_time(duration(result.secs));
    if !result.figures.is_empty() {
        let rows: Vec<String> =
            result.figures.iter().map(|(name, value)| format!("{name} {value:.3e}")).collect();
        case.set_system_out(rows.join("\n"));
    }
    case
}

fn duration(secs: f64) -> Duration {
    Duration::try_from_secs_f64(secs).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    fn result(status: Status, attempts: u32, failed_attempts: u32) -> CaseResult {
        let problems = if failed_attempts > 0 {
            vec!["weight 2 > 1".to_owned(), "<odd> & \u{7}".to_owned()]
        } else {
            Vec::new()
        };
        CaseResult {
            name: "methods.quad.none.ground".to_owned(),
            status,
            reason: Some("known (k.txt:1)".to_owned()),
            problems,
            attempts,
            failed_attempts,
            secs: 0.5,
            figures: BTreeMap::from([("weight", 2.0)]),
            settings: BTreeMap::new(),
        }
    }

    /// What a CI system makes of a case: its element, the message.
    fn seen(result: &CaseResult) -> (&'static str, String) {
        let case = case(result);
        assert_eq!(case.classname.as_deref(), Some("methods.quad.none"));
        assert_eq!(case.system_out.as_deref(), Some("weight 2.000e0"));
        let text =
            |message: &Option<quick_junit::XmlString>| message.as_deref().unwrap_or_default().to_owned();
        match &case.status {
            TestCaseStatus::Success { flaky_runs } => match flaky_runs.as_slice() {
                [] => ("success", String::new()),
                [run, ..] => ("flaky", text(&run.message)),
            },
            TestCaseStatus::NonSuccess { message, description, .. } => {
                assert_eq!(description.is_some(), result.failed_attempts > 0);
                ("failure", text(message))
            }
            TestCaseStatus::Skipped { message, .. } => ("skipped", text(message)),
        }
    }

    #[test]
    fn only_what_fails_the_run_is_a_failure() {
        for (status, attempts, failed, expected) in [
            (Status::Pass, 1, 0, ("success", "")),
            (Status::Fail, 3, 3, ("failure", "weight 2 > 1")),
            (Status::Fail, 2, 1, ("failure", "weight 2 > 1")),
            (Status::Fixed, 1, 0, ("failure", "passes, but is listed as a failure: known (k.txt:1)")),
            (Status::KnownFail, 1, 1, ("skipped", "known fail: known (k.txt:1)")),
            (Status::Flake, 2, 1, ("flaky", "weight 2 > 1")),
            (Status::Flake, 3, 3, ("skipped", "flake: known (k.txt:1)")),
            (Status::Skip, 0, 0, ("skipped", "skip: known (k.txt:1)")),
        ] {
            let (element, message) = seen(&result(status, attempts, failed));
            assert_eq!((element, message.as_str()), expected, "{status:?}");
            assert_eq!(element == "failure", status.fails_the_run());
        }
    }
}
