//! The result of a self-test, as plain data: serialized it is the JSON of `surfel selftest --json`, printed it is its
//! table.

use std::{collections::BTreeMap, fmt};

use serde::Serialize;

use super::case::group_of;
use crate::{
    error::{Error, ErrorKind, Result},
    report::{DeviceReport, Grid},
};

/// Everything that a self-test found out.
#[derive(Clone, Debug, Serialize)]
pub struct SelftestReport {
    /// The version of surfel.
    pub surfel: String,
    /// `quick` or `full`.
    pub form: &'static str,
    /// The patterns of `--case`; empty for all.
    pub selected: Vec<String>,
    /// The device.
    pub device: DeviceReport,
    /// The PCI vendor and device, and the driver's version number.
    pub ids: [u32; 3],
    /// The version of the Vulkan loader.
    pub vulkan_loader: String,
    /// The validation layer; `None` where it did not watch.
    pub validation: Option<ValidationReport>,
    /// The lists of what is known of the driver that were used, the later ones above the earlier.
    pub known_lists: Vec<String>,
    /// How often a failing case is tried again.
    pub retries: u32,
    /// Width and height of every picture in pixels.
    pub size_px: [u32; 2],
    /// Seconds of the wall clock.
    pub secs: f64,
    /// How many cases ended how.
    pub counts: Counts,
    /// The cases, in the order of `--list`.
    pub cases: Vec<CaseResult>,
}

/// The validation layer.
#[derive(Clone, Debug, Serialize)]
pub struct ValidationReport {
    /// The Vulkan version that it was written for, and its own number.
    pub layer: String,
    /// Messages that are known to be harmless: how often each came.
    pub allowed: BTreeMap<String, u64>,
}

/// How a case ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// Nothing is wrong.
    Pass,
    /// Something is wrong, and nobody has said that it may be.
    Fail,
    /// It is listed as a failure, and fails.
    KnownFail,
    /// It is listed as a failure, but passes: the list is out of date.
    Fixed,
    /// It is listed as a flake, and has failed at least once.
    Flake,
    /// It was not run.
    Skip,
}

impl Status {
    /// Whether a single case of this status makes the whole run fail.
    pub fn fails_the_run(self) -> bool {
        matches!(self, Self::Fail | Self::Fixed)
    }

    /// The status in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Fail => "fail",
            Self::KnownFail => "known fail",
            Self::Fixed => "fixed",
            Self::Flake => "flake",
            Self::Skip => "skip",
        }
    }
}

/// The result of one case.
#[derive(Clone, Debug, Serialize)]
pub struct CaseResult {
    /// The case.
    pub name: String,
    /// How it ended.
    pub status: Status,
    /// Why it was skipped, or what is known of it and where that is written.
    pub reason: Option<String>,
    /// The problems of the last try that failed, in words.
    pub problems: Vec<String>,
    /// How often it was tried.
    pub attempts: u32,
    /// How many of these tries failed.
    pub failed_attempts: u32,
    /// Seconds of the wall clock; the first case that needs a scene or an oracle pays for it.
    pub secs: f64,
    /// The largest errors at the last try. Against the oracle with 32-bit sums: `weight` (relative), `albedo`, `depth`
    /// (relative), `normal_deg`, `normal_sum_deg` (times the length of the mean of the normals), `color` (linear). With 16-bit sums: `weight_of_bound`, `albedo_of_bound`,
    /// `depth_of_bound`, shares of what rounding may do, and `bounded_px`, the pixels of which that says something. Both:
    /// `compared_px`, `coverage_px` (covered in one picture only), `not_finite_values`. Of cases that draw twice:
    /// `different_values`, `covered_px`.
    pub figures: BTreeMap<&'static str, f64>,
    /// The settings by the names of their options; empty where nothing is drawn.
    pub settings: BTreeMap<&'static str, String>,
}

impl CaseResult {
    pub(super) fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            status: Status::Pass,
            reason: None,
            problems: Vec::new(),
            attempts: 0,
            failed_attempts: 0,
            secs: 0.0,
            figures: BTreeMap::new(),
            settings: BTreeMap::new(),
        }
    }

    /// The group that the case is in.
    pub fn group(&self) -> &str {
        group_of(&self.name)
    }

    /// The result in a line: the problems, how many tries failed, and what is known.
    pub fn line(&self) -> String {
        let mut parts = Vec::new();
        if !self.problems.is_empty() {
            let problems = self.problems.join("; ");
            parts.push(problems.split_whitespace().collect::<Vec<_>>().join(" "));
        }
        if self.status == Status::Fixed {
            parts.push("passes, but is listed as a failure".to_owned());
        }
        if self.attempts > 1 {
            parts.push(format!("{} of {} tries failed", self.failed_attempts, self.attempts));
        }
        parts.extend(self.reason.clone());
        format!("{:10} {}: {}", self.status.name(), self.name, parts.join(" | "))
    }
}

/// How many cases ended how.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// All.
    pub cases: usize,
    /// Passed.
    pub pass: usize,
    /// Failed.
    pub fail: usize,
    /// Failed as listed.
    pub known_fail: usize,
    /// Passed, though listed as failures.
    pub fixed: usize,
    /// Failed at times, as listed.
    pub flake: usize,
    /// Not run.
    pub skip: usize,
}

impl Counts {
    /// The counts of these cases.
    pub fn of<'a>(cases: impl IntoIterator<Item = &'a CaseResult>) -> Self {
        let mut counts = Self::default();
        for case in cases {
            counts.cases += 1;
            *match case.status {
                Status::Pass => &mut counts.pass,
                Status::Fail => &mut counts.fail,
                Status::KnownFail => &mut counts.known_fail,
                Status::Fixed => &mut counts.fixed,
                Status::Flake => &mut counts.flake,
                Status::Skip => &mut counts.skip,
            } += 1;
        }
        counts
    }
}

impl SelftestReport {
    /// The groups in the order of their first case, each with its cases.
    pub fn groups(&self) -> Vec<(&str, Vec<&CaseResult>)> {
        let mut groups: Vec<(&str, Vec<&CaseResult>)> = Vec::new();
        for case in &self.cases {
            match groups.iter_mut().find(|(name, _)| *name == case.group()) {
                Some((_, cases)) => cases.push(case),
                None => groups.push((case.group(), vec![case])),
            }
        }
        groups
    }

    /// Whether all is well.
    ///
    /// # Errors
    /// The loss of the device, else [`ErrorKind::Selftest`] where cases failed, or passed that are listed as failures.
    pub fn conclude(&self, lost: Option<Error>) -> Result<()> {
        if let Some(lost) = lost {
            return Err(lost);
        }
        match self.cases.iter().find(|case| case.status.fails_the_run()) {
            None => Ok(()),
            Some(first) => Err(ErrorKind::Selftest {
                cases: self.counts.cases,
                failed: self.counts.fail,
                fixed: self.counts.fixed,
                first: first.name.clone(),
            }
            .into()),
        }
    }
}

impl fmt::Display for SelftestReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let DeviceReport { name, driver, api_version, .. } = &self.device;
        writeln!(f, "{name}, {driver}, Vulkan {api_version}")?;
        match &self.validation {
            Some(validation) => write!(f, "validation layer {}", validation.layer)?,
            None => write!(f, "not validated")?,
        }
        match self.known_lists.as_slice() {
            [] => writeln!(f, "; no known list")?,
            lists => writeln!(f, "; known lists: {}", lists.join(", "))?,
        }
        let groups = self.groups();
        let mut rows: Vec<(&str, Counts, f64)> = Vec::new();
        for (name, cases) in &groups {
            let secs = cases.iter().map(|case| case.secs).sum();
            rows.push((*name, Counts::of(cases.iter().copied()), secs));
        }
        rows.push(("all", self.counts, self.secs));
        let table = Grid::of("", &rows)
            .column("", |(name, ..)| *name)
            .column("cases", |(_, counts, _)| counts.cases)
            .column("pass", |(_, counts, _)| counts.pass)
            .column("fail", |(_, counts, _)| counts.fail)
            .column("known", |(_, counts, _)| counts.known_fail)
            .column("fixed", |(_, counts, _)| counts.fixed)
            .column("flake", |(_, counts, _)| counts.flake)
            .column("skip", |(_, counts, _)| counts.skip)
            .column("seconds", |(.., secs)| format!("{secs:.1}"));
        write!(f, "{}", table.grid())
    }
}
