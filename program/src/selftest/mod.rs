//! `surfel selftest`: every method on every hard scene against the oracle, for the CI of drivers.

mod arguments;
mod junit;

use std::{collections::BTreeMap, time::Instant};

use surfel::{
    Error, ErrorKind, Progress as _, Result,
    renderer::{Headless, HeadlessOptions},
    save,
    selftest::{
        Case, Counts, Event, Known, KnownList, SIZE_PX, SelftestReport, Status, Suite, ValidationReport,
        run as run_cases,
    },
    small_file::read_small_text,
    vk::{LoaderFacts, Validation, loader_facts},
};

pub use arguments::SelftestArguments;

use crate::{
    console::{self, Bars},
    json::write_json,
    outputs,
    reports::{device_report, layer_version, version},
};

/// Runs the subcommand.
///
/// # Errors
/// [`ErrorKind::Selftest`] where cases fail or pass against the list; whatever else goes wrong.
pub fn run(arguments: &SelftestArguments) -> Result<()> {
    let suite = Suite::new();
    let cases = selected(&suite, arguments)?;
    if arguments.list {
        let names: Vec<&str> = cases.iter().map(|case| case.name.as_str()).collect();
        return console::print(&names.join("\n"));
    }
    let lists = lists(arguments)?;
    let files = [&arguments.junit, &arguments.json].into_iter().flatten();
    outputs::check_places(files, None, &[], &arguments.known)?;
    let loader = loader_facts()?;
    let validation = validation(arguments, &loader)?;
    let start = Instant::now();
    let headless = Headless::new(&HeadlessOptions {
        validation: if arguments.no_validate { Validation::Off } else { Validation::On },
        device: arguments.device.clone(),
        // Kept pipelines would leave the driver's compiler untested.
        cache_folder: None,
    })?;
    let facts = headless.device().facts().clone();
    let messages = headless.device().instance().messages();
    let known = Known::of_driver(lists, &facts.driver, suite.cases.iter().map(|case| case.name.as_str()))?;

    let bars = Bars::new();
    let outcome = run_cases(headless, &suite, &cases, &known, arguments.retries, &mut |event| match event {
        Event::Started(case) if arguments.verbose => bars.note(&format!("run        {}", case.name)),
        Event::Started(_) => {}
        Event::Finished { result, done, total } => {
            if !matches!(result.status, Status::Pass | Status::Skip) {
                bars.note(&result.line());
            }
            bars.step("selftest", done as u64, total as u64);
        }
    });
    bars.clear();
    let report = SelftestReport {
        surfel: env!("CARGO_PKG_VERSION").to_owned(),
        form: if arguments.quick { "quick" } else { "full" },
        selected: arguments.cases.iter().map(ToString::to_string).collect(),
        device: device_report(&facts),
        ids: facts.ids,
        vulkan_loader: version(loader.version),
        validation: validation.map(|layer| {
            let hits = messages.allowed_hits().into_iter();
            ValidationReport { layer, allowed: hits.map(|(vuid, times)| (vuid.to_owned(), times)).collect() }
        }),
        known_lists: known.lists().map(str::to_owned).collect(),
        retries: arguments.retries,
        size_px: SIZE_PX,
        secs: start.elapsed().as_secs_f64(),
        counts: Counts::of(&outcome.results),
        cases: outcome.results,
    };
    console::print(&format!("{report}{}", skips(&report)))?;
    write_json(arguments.json.as_deref(), &report)?;
    if let Some(path) = &arguments.junit {
        save::text(path, &junit::text(&report)?)?;
    }
    report.conclude(outcome.lost)
}

/// Some thousand entries: each is looked for among all cases.
const MOST_KNOWN_BYTES: u64 = 1 << 17;

/// The cases that were asked for, and those that are always run.
fn selected<'a>(suite: &'a Suite, arguments: &SelftestArguments) -> Result<Vec<&'a Case>> {
    let form: Vec<&Case> = suite.cases.iter().filter(|case| case.quick || !arguments.quick).collect();
    for pattern in &arguments.cases {
        if !form.iter().any(|case| pattern.matches(&case.name)) {
            let form = if arguments.quick { " --quick" } else { "" };
            let problem = format!("{pattern}: matches no case; surfel selftest{form} --list prints them all");
            return Err(Error::option("--case", problem));
        }
    }
    let asked_for = |case: &&Case| {
        arguments.cases.is_empty()
            || case.is_always_run()
            || arguments.cases.iter().any(|pattern| pattern.matches(&case.name))
    };
    Ok(form.into_iter().filter(asked_for).collect())
}

/// The lists of known results, of all drivers: those that come along first.
fn lists(arguments: &SelftestArguments) -> Result<Vec<KnownList>> {
    let mut lists = if arguments.no_known { Vec::new() } else { Known::built_in()? };
    for path in &arguments.known {
        let text = read_small_text(path, MOST_KNOWN_BYTES, "a list of what is known of drivers")?;
        lists.push(KnownList::parse(&path.display().to_string(), &text)?);
    }
    Ok(lists)
}

/// The validation layer's version; `None` where it is not to watch.
fn validation(arguments: &SelftestArguments, loader: &LoaderFacts) -> Result<Option<String>> {
    match (arguments.no_validate, layer_version(loader)) {
        (true, _) => Ok(None),
        (false, Some(version)) => Ok(Some(version)),
        (false, None) => {
            let reason = "VK_LAYER_KHRONOS_validation is not installed; --no-validate goes without";
            Err(ErrorKind::NoDevice { reasons: vec![reason.to_owned()] }.into())
        }
    }
}

/// The reasons why cases were not run, each once.
fn skips(report: &SelftestReport) -> String {
    let mut reasons: BTreeMap<&str, usize> = BTreeMap::new();
    for case in report.cases.iter().filter(|case| case.status == Status::Skip) {
        *reasons.entry(case.reason.as_deref().unwrap_or_default()).or_default() += 1;
    }
    let line = |(reason, cases): (&str, usize)| format!("skipped, {cases} case(s): {reason}\n");
    reasons.into_iter().map(line).collect()
}
