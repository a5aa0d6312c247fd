//! A run against an earlier one (`--baseline`), and against doubt (`--strict`).

use std::{collections::BTreeMap, path::Path};

use serde::Deserialize;
use surfel::{
    Error, ErrorKind, Result,
    report::{
        DeviceReport, InputReport,
        bench::{
            BenchReport, Judgement,
            gate::{Gate, GateLimits, Verdict, differences},
        },
    },
    small_file::read_small_text,
};

use super::arguments::{Bench, BenchArguments};

/// How many times --max-spread an interval may be wide, for the gate to see through it.
const WIDEST: f64 = 3.0;

/// Frames that give an interval: 6 rounds of pairs.
const FEWEST_FRAMES: u32 = 12;

/// More than any report has.
const MOST_BYTES: u64 = 1 << 24;

/// The part of a report that is read.
#[derive(Deserialize)]
struct Report {
    gate: Gate,
}

/// The earlier run's figures, read before the long work.
///
/// # Errors
/// A file that can't be read or is no report of `surfel bench`.
pub fn read(arguments: &BenchArguments) -> Result<Option<Gate>> {
    let Some(path) = &arguments.baseline else { return Ok(None) };
    let text = read_small_text(path, MOST_BYTES, "a file of `surfel bench ... --json`")?;
    let report: Report = serde_json::from_str(&text).map_err(|e| {
        let place = format!("line {}", e.line());
        Error::input(path, place, format!("{e}; expected a file of `surfel bench ... --json`"))
    })?;
    if report.gate.figures.is_empty() {
        return Err(Error::input(path, "", "has no figures to judge by"));
    }
    let mut names: Vec<&str> = report.gate.figures.iter().map(|figure| figure.name.as_str()).collect();
    names.sort_unstable();
    if let Some(twice) = names.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(Error::input(path, "", format!("has '{}' twice", twice[0])));
    }
    let table = arguments.table;
    if table.takes_turns() && arguments.frames < FEWEST_FRAMES
        || table.has(Bench::Floor) && arguments.frames < 6
    {
        return Err(Error::option(
            "--frames",
            format!("{}: a gate takes {FEWEST_FRAMES} at least", arguments.frames),
        ));
    }
    // All but what the run itself decides is known before it.
    check_subject(path, &subject(arguments, None), &report.gate)?;
    Ok(Some(report.gate))
}

/// The figures that a later run is judged by.
pub fn gate(arguments: &BenchArguments, report: &BenchReport) -> Gate {
    let device = |of: fn(&DeviceReport) -> &String| {
        report.device.as_ref().map_or_else(|| "none".to_owned(), |device| of(device).clone())
    };
    let circumstances = [
        ("device", device(|device| &device.name)),
        ("driver", device(|device| &device.driver)),
        ("surfel", report.surfel.clone()),
        ("commit", report.commit.clone().unwrap_or_else(|| "unknown".to_owned())),
    ];
    Gate {
        subject: subject(arguments, Some(report)),
        circumstances: circumstances.map(|(name, value)| (name.to_owned(), value)).into(),
        figures: report.figures(),
    }
}

/// Judges a run.
///
/// # Errors
/// A baseline of something else.
pub fn judge(arguments: &BenchArguments, now: &Gate, before: &Gate) -> Result<Judgement> {
    if let Some(path) = &arguments.baseline {
        check_subject(path, &now.subject, before)?;
    }
    let limits = GateLimits {
        tolerance: 0.01 * arguments.tolerance,
        uncertainty: WIDEST * 0.01 * arguments.max_spread,
    };
    Ok(now.judge(before, limits))
}

/// Ends with what was found.
///
/// # Errors
/// [`ErrorKind::Regression`] where something became worse or is gone; [`ErrorKind::Doubtful`] where figures could not be
/// judged, or are doubtful and that is refused.
pub fn conclude(arguments: &BenchArguments, report: &BenchReport) -> Result<()> {
    if let Some(judgement) = &report.judgement {
        let worse = judgement.with(Verdict::Worse).map(|judged| {
            format!("{}: {} before, {} now", judged.name, rounded(judged.before), rounded(judged.now))
        });
        let gone = judgement.gone.iter().map(|name| format!("{name}: gone"));
        let all: Vec<String> = worse.chain(gone).collect();
        if let Some(first) = all.first() {
            return Err(ErrorKind::Regression { count: all.len(), first: first.clone() }.into());
        }
        if !judgement.passes() {
            let first = judgement.with(Verdict::NotJudged).next().map(|judged| judged.name.clone());
            let first = first.unwrap_or_else(|| "the baseline has no figures".to_owned());
            let count = judgement.with(Verdict::NotJudged).count().max(1);
            return Err(ErrorKind::Doubtful { count, first: format!("{first}: can't be judged") }.into());
        }
    }
    match (arguments.strict, report.flags.first()) {
        (true, Some(first)) => {
            Err(ErrorKind::Doubtful { count: report.flags.len(), first: first.clone() }.into())
        }
        _ => Ok(()),
    }
}

/// The facts that must be equal for two runs to compare; without a report, those that the command line alone decides.
fn subject(arguments: &BenchArguments, report: Option<&BenchReport>) -> BTreeMap<String, String> {
    let table = arguments.table;
    let options = arguments.settings().as_options().into_iter();
    let mut subject: BTreeMap<String, String> =
        options.map(|(name, value)| (name.to_owned(), value)).collect();
    subject.insert("table".to_owned(), table.name());
    subject.insert("validation".to_owned(), arguments.device.validate.to_string());
    if table.takes_turns() {
        let splats: Vec<String> = arguments.splats.iter().map(u64::to_string).collect();
        let splats = if splats.is_empty() { "default".to_owned() } else { splats.join(",") };
        subject.insert("splats".to_owned(), splats);
    }
    if table.has(Bench::Growth) {
        let sizes: Vec<String> =
            arguments.growth_sizes().iter().map(|[width, height]| format!("{width}x{height}")).collect();
        let rasterizers = arguments.rasterizers();
        let rasterizers: Vec<&str> = rasterizers.iter().map(|rasterizer| rasterizer.name()).collect();
        subject.insert("sizes".to_owned(), sizes.join(","));
        subject.insert("rasterizers".to_owned(), rasterizers.join(","));
    }
    if table.has(Bench::Counts) {
        subject.insert("all pipelines".to_owned(), arguments.counts.all.to_string());
    }
    if let Some(report) = report {
        let input = |input: &InputReport| format!("{}, {} splats", input.name, input.splats);
        let inputs: Vec<String> = report.inputs.iter().map(input).collect();
        subject.insert("inputs".to_owned(), inputs.join("; "));
    }
    subject
}

fn check_subject(path: &Path, now: &BTreeMap<String, String>, before: &Gate) -> Result<()> {
    let known = before.subject.iter().filter(|(name, _)| now.contains_key(*name));
    let known = known.map(|(name, value)| (name.clone(), value.clone())).collect();
    match differences(&known, now).first() {
        Some(first) => Err(Error::input(path, "", format!("the baseline is of something else: {first}"))),
        None => Ok(()),
    }
}

/// Enough digits to see a difference.
fn rounded(value: f64) -> f64 {
    (value * 1e3).round() * 1e-3
}
