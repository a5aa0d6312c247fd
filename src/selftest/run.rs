//! Runs cases, judges them and attributes what the validation layer says.

use std::{sync::Arc, time::Instant};

use super::{
    case::{CLOSE, Case, OPEN, Suite},
    check::{Found, Stage},
    known::{Entry, Expectation, Known},
    report::{CaseResult, Status},
};
use crate::{
    error::{Error, ErrorKind},
    renderer::Headless,
    vk::Messages,
};

/// An event that a caller is told while cases run.
pub enum Event<'a> {
    /// A case begins: should the driver crash, it is this one.
    Started(&'a Case),
    /// A case is done.
    Finished {
        /// Its result.
        result: &'a CaseResult,
        /// How many are done.
        done: usize,
        /// How many there are.
        total: usize,
    },
}

/// The result of a run.
pub struct Outcome {
    /// The cases in the suite's order.
    pub results: Vec<CaseResult>,
    /// The device was lost, so that the cases after it were not run.
    pub lost: Option<Error>,
}

/// Runs `cases` of the suite on a device that was opened for this, and closes it.
///
/// Cases that fail are tried again up to `retries` times, unless they are known to fail.
pub fn run(
    headless: Headless,
    suite: &Suite,
    cases: &[&Case],
    known: &Known,
    retries: u32,
    listener: &mut dyn FnMut(Event<'_>),
) -> Outcome {
    let messages = headless.device().instance().messages();
    // One scene after the other, so that it is uploaded once and its oracles are kept no longer than needed.
    let mut order: Vec<usize> = (0..cases.len()).collect();
    order.sort_by_key(|&i| match (&cases[i].drawing, cases[i].name.as_str()) {
        (Some(drawing), _) => 1 + drawing.scene,
        (None, OPEN) => 0,
        (None, _) => usize::MAX,
    });
    let mut run = Run { stage: Some(Stage::new(headless, suite)), messages, known, retries, lost: None };
    let mut results = Vec::new();
    for i in order {
        let case = cases[i];
        listener(Event::Started(case));
        let result = run.case(case);
        listener(Event::Finished { result: &result, done: results.len() + 1, total: cases.len() });
        results.push((i, result));
    }
    results.sort_by_key(|(i, _)| *i);
    Outcome {
        results: results.into_iter().map(|(_, result)| result).collect(),
        lost: run.lost.map(|lost| lost.1),
    }
}

struct Run<'a> {
    /// `None` once the device is closed.
    stage: Option<Stage<'a>>,
    messages: Arc<Messages>,
    known: &'a Known,
    retries: u32,
    /// The case in which the device was lost, and what the driver said.
    lost: Option<(String, Error)>,
}

impl Run<'_> {
    fn case(&mut self, case: &Case) -> CaseResult {
        let start = Instant::now();
        let entry = self.known.entry(&case.name);
        let mut result = CaseResult::new(&case.name);
        if let Some(drawing) = &case.drawing {
            result.settings = drawing.settings.as_options();
        }
        if let Some(why) = self.why_not(case, entry) {
            if case.is_always_run() {
                // Done, but not judged: what the layer says of it is no other case's.
                self.attempt(case);
            }
            (result.status, result.reason) = (Status::Skip, Some(why));
            return result;
        }
        let expectation = entry.map(|entry| entry.expectation);
        let most = if expectation == Some(Expectation::Fail) { 1 } else { 1 + self.retries };
        while result.attempts < most {
            let found = self.attempt(case);
            result.attempts += 1;
            result.figures = found.figures;
            if found.problems.is_empty() {
                break;
            }
            result.failed_attempts += 1;
            result.problems = found.problems;
            if self.lost.is_some() {
                break;
            }
        }
        result.status = judge(expectation, result.failed_attempts);
        result.reason = entry.map(|entry| format!("{} ({}:{})", entry.reason, entry.list, entry.line));
        result.secs = start.elapsed().as_secs_f64();
        result
    }

    /// Why a case is not run.
    fn why_not(&self, case: &Case, entry: Option<&Entry>) -> Option<String> {
        if let Some((lost_in, _)) = &self.lost {
            return (case.name != CLOSE).then(|| format!("the device was lost in {lost_in}"));
        }
        if let Some(entry) = entry.filter(|entry| entry.expectation == Expectation::Skip) {
            return Some(format!("{} ({}:{})", entry.reason, entry.list, entry.line));
        }
        let (drawing, stage) = (case.drawing.as_ref()?, self.stage.as_ref()?);
        stage.headless.renderer.check_settings(&drawing.settings).err().map(|error| error.to_string())
    }

    /// Tries a case once. What the layer says meanwhile is wrong with it.
    fn attempt(&mut self, case: &Case) -> Found {
        let found = match (&case.drawing, &mut self.stage) {
            (Some(drawing), Some(stage)) => stage.check(drawing),
            _ if case.name == CLOSE => {
                self.stage = None;
                Ok(Found::default())
            }
            _ => Ok(Found::default()),
        };
        let mut found = found.unwrap_or_else(|error| {
            let problems = vec![error.to_string()];
            if matches!(error.kind(), ErrorKind::Vulkan { result: ash::vk::Result::ERROR_DEVICE_LOST, .. }) {
                self.lost = Some((case.name.clone(), error));
            }
            Found { problems, ..Found::default() }
        });
        for message in self.messages.take() {
            found.problems.push(format!("validation: {}: {}", message.vuid, message.text.trim()));
        }
        found
    }
}

/// The status that a case's tries amount to. One that fails first and passes later has failed, unless it is listed as a flake: nobody
/// has looked at it yet.
fn judge(expectation: Option<Expectation>, failed_attempts: u32) -> Status {
    match (expectation, failed_attempts) {
        (Some(Expectation::Fail), 0) => Status::Fixed,
        (Some(Expectation::Fail), _) => Status::KnownFail,
        (_, 0) => Status::Pass,
        (Some(Expectation::Flake), _) => Status::Flake,
        _ => Status::Fail,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_listed_decides_what_a_failure_is_and_a_listed_failure_that_passes_is_told() {
        use Expectation::{Fail, Flake};
        for (expectation, failed, expected) in [
            (None, 0, Status::Pass),
            (None, 1, Status::Fail),
            (Some(Fail), 1, Status::KnownFail),
            (Some(Fail), 0, Status::Fixed),
            (Some(Flake), 0, Status::Pass),
            (Some(Flake), 1, Status::Flake),
            (Some(Flake), 3, Status::Flake),
        ] {
            let status = judge(expectation, failed);
            assert_eq!(status, expected, "{expectation:?} {failed}");
            assert_eq!(status.fails_the_run(), matches!(status, Status::Fail | Status::Fixed));
        }
    }
}
