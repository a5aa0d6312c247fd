//! `surfel bench`: tables of what things cost.

mod arguments;
mod floor;
mod gate;
mod model;
mod outputs;
mod slides;
mod table1;

use surfel::{
    Result,
    renderer::{Headless, HeadlessOptions},
    report::{BenchReport, InputReport, TrustLimits, settings_as_options},
    scene::Settings,
    vk::Validation,
};

pub use arguments::BenchArguments;

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
    let mut headless = Headless::new(&HeadlessOptions {
        validation: if arguments.validate { Validation::On } else { Validation::Off },
        device: arguments.device.clone(),
        cache_folder: cache::folder(),
    })?;
    headless.renderer.check_settings(&settings)?;
    let facts = headless.device().facts().clone();
    let limits = TrustLimits { uncertainty: 0.01 * arguments.max_spread, ..TrustLimits::default() };
    let mut stage =
        Stage { arguments, settings, bars: Bars::new(), inputs: Vec::new(), flags: Vec::new(), limits };

    let watch = Watch::begin(&facts);
    let tables = arguments.table.tables();
    let floor = tables.floor.then(|| floor::measure(&mut headless, &mut stage)).transpose();
    let table1 = floor.and_then(|floor| {
        let rows = if tables.table1 { table1::measure(&mut headless, &mut stage)? } else { Vec::new() };
        Ok((floor, rows))
    });
    let all = table1.and_then(|(floor, rows)| {
        let slides = tables.slides.then(|| slides::measure(&mut headless, &mut stage)).transpose()?;
        Ok((floor, rows, slides))
    });
    let counts = tables.counts.then(|| counts::gather(arguments, &stage.bars)).transpose();
    stage.bars.clear();
    let (floor, table1, slides) = all?;
    let counts = counts?;

    let machine = watch.end();
    let mut flags = machine.flags(&limits);
    flags.append(&mut stage.flags);
    let mut report = BenchReport {
        surfel: env!("CARGO_PKG_VERSION").to_owned(),
        commit: option_env!("SURFEL_COMMIT").map(str::to_owned),
        device: device_report(&facts),
        settings: settings_as_options(&stage.settings),
        inputs: stage.inputs,
        frames: arguments.frames,
        machine,
        limits,
        floor,
        table1,
        slides,
        counts,
        flags,
        gate: surfel::report::gate::Gate::default(),
        judgement: None,
    };
    report.gate = gate::gate(arguments, &report);
    report.judgement = baseline.map(|before| gate::judge(arguments, &report.gate, &before)).transpose()?;
    console::print(&report.text())?;
    outputs::write(arguments, &report)?;
    if arguments.validate {
        validation::conclude(&headless.device().instance().messages())?;
    }
    gate::conclude(arguments, &report)
}
