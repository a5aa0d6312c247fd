//! `surfel bench`: tables of what things cost.

mod arguments;
mod floor;
mod gate;
mod model;
mod outputs;
mod slides;
mod table1;

use std::sync::Arc;

use surfel::{
    Result,
    renderer::{Headless, HeadlessOptions},
    report::{BenchReport, InputReport, TrustLimits, settings_as_options},
    scene::Settings,
    vk::{Messages, Validation},
};

pub use arguments::{Bench, BenchArguments};

use crate::{
    cache,
    console::{self, Bars},
    counts,
    machine::Watch,
    reports::device_report,
    validation,
};

/// What every table is given.
struct Stage<'a> {
    arguments: &'a BenchArguments,
    settings: Settings,
    bars: Bars,
    /// What was drawn so far.
    inputs: Vec<InputReport>,
    /// What makes figures doubtful so far.
    flags: Vec<String>,
    limits: TrustLimits,
}

/// Runs the subcommand.
///
/// # Errors
/// Whatever goes wrong; a regression, where there is a baseline; doubtful figures, where they are refused.
pub fn run(arguments: &BenchArguments) -> Result<()> {
    if arguments.counts.isa_rows {
        return counts::print_isa_rows(arguments);
    }
    let settings = arguments.settings();
    settings.validate()?;
    outputs::check(arguments)?;
    let baseline = gate::read(arguments)?;
    let limits = TrustLimits { uncertainty: 0.01 * arguments.max_spread, ..TrustLimits::default() };
    let mut report = BenchReport {
        surfel: env!("CARGO_PKG_VERSION").to_owned(),
        commit: option_env!("SURFEL_COMMIT").map(str::to_owned),
        settings: settings_as_options(&settings),
        frames: arguments.frames,
        limits,
        ..BenchReport::default()
    };
    let mut stage =
        Stage { arguments, settings, bars: Bars::new(), inputs: Vec::new(), flags: Vec::new(), limits };
    let tables = arguments.table.tables();
    // Instructions are counted without a device.
    let done = match tables.floor || tables.table1 || tables.slides {
        true => measure(&mut stage, &mut report).map(Some),
        false => Ok(None),
    };
    let counts = tables.counts.then(|| counts::gather(arguments, &stage.bars)).transpose();
    stage.bars.clear();
    let messages = done?;
    report.counts = counts?;
    report.gate = gate::gate(arguments, &report);
    report.judgement = baseline.map(|before| gate::judge(arguments, &report.gate, &before)).transpose()?;
    console::print(&report.text())?;
    outputs::write(arguments, &report)?;
    if let (true, Some(messages)) = (arguments.validate, messages) {
        validation::conclude(&messages)?;
    }
    gate::conclude(arguments, &report)
}

/// Measures the tables whose figures are times. Answers with what the validation layer said.
fn measure(stage: &mut Stage<'_>, report: &mut BenchReport) -> Result<Arc<Messages>> {
    let arguments = stage.arguments;
    let mut headless = Headless::new(&HeadlessOptions {
        validation: if arguments.validate { Validation::On } else { Validation::Off },
        device: arguments.device.clone(),
        cache_folder: cache::folder(),
    })?;
    headless.renderer.check_settings(&stage.settings)?;
    let facts = headless.device().facts().clone();
    report.device = Some(device_report(&facts));
    let watch = Watch::begin(&facts);
    let tables = arguments.table.tables();
    if tables.floor {
        report.floor = Some(floor::measure(&mut headless, stage)?);
    }
    if tables.table1 {
        report.table1 = table1::measure(&mut headless, stage)?;
    }
    if tables.slides {
        report.slides = Some(slides::measure(&mut headless, stage)?);
    }
    let machine = watch.end();
    report.flags = machine.flags(&stage.limits);
    report.flags.append(&mut stage.flags);
    report.inputs = std::mem::take(&mut stage.inputs);
    report.machine = Some(machine);
    Ok(headless.device().instance().messages())
}
