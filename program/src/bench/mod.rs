//! `surfel bench`: tables of what things cost.

pub mod arguments;
mod clips;
mod contest;
mod context;
mod counts;
mod floor;
mod gate;
mod growth;
mod hybrid;
mod i3;
mod layers;
mod limits;
mod model;
mod outputs;
mod p1;
mod p2;
mod slides;
mod table1;
mod transition;
mod unused;

use surfel::{
    Error, Result,
    renderer::Headless,
    report::bench::{BenchReport, TrustLimits},
};

use arguments::Bench;
pub use arguments::BenchArguments;
use context::BenchContext;

use crate::{
    console::{self, Bars},
    device,
    machine::Watch,
    reports::device_report,
};

/// Runs the subcommand.
///
/// # Errors
/// Whatever goes wrong; a regression, where there is a baseline; doubtful figures, where they are refused.
pub fn run(arguments: &BenchArguments) -> Result<()> {
    if arguments.counts.isa_rows {
        return counts::print_isa_rows(arguments);
    }
    arguments.settings().validate()?;
    let counts = &arguments.counts;
    if !arguments.table.has(Bench::Counts) && (counts.all || !counts.isa.is_empty()) {
        return Err(Error::option("--isa, --all", format!("{} counts nothing", arguments.table.name())));
    }
    if arguments.table == Bench::Layers && arguments.model.is_some() {
        return Err(Error::option("--model", "bench layers draws its own balls"));
    }
    arguments.check_lists()?;
    unused::tell(arguments);
    outputs::check(arguments)?;
    let baseline = gate::read(arguments)?;
    let mut headless = match arguments.table.needs_device() {
        true => Some(arguments.device.open()?),
        false => None,
    };
    let mut report = gather(headless.as_mut(), arguments)?;
    report.gate = gate::gate(arguments, &report);
    let judgement = baseline.map(|before| gate::judge(arguments, &report.gate, &before)).transpose();
    // What was measured is told whatever comes of it.
    report.judgement = judgement.as_ref().ok().cloned().flatten();
    console::print(&report.text())?;
    outputs::write(arguments, &report)?;
    judgement?;
    if let (true, Some(headless)) = (arguments.device.validate, headless) {
        device::conclude(&headless.device().instance().messages())?;
    }
    gate::conclude(arguments, &report)
}

/// Measures and counts what the command line names. Tables of a device's times are left out where none is given.
pub fn gather(headless: Option<&mut Headless>, arguments: &BenchArguments) -> Result<BenchReport> {
    let settings = arguments.settings();
    let limits = TrustLimits { uncertainty: 0.01 * arguments.max_spread, ..TrustLimits::default() };
    let mut report = BenchReport {
        surfel: env!("CARGO_PKG_VERSION").to_owned(),
        commit: option_env!("SURFEL_COMMIT").map(str::to_owned),
        settings: settings.as_options(),
        frames: arguments.frames,
        limits,
        ..BenchReport::default()
    };
    let mut context = BenchContext {
        arguments,
        settings,
        bars: Bars::new(),
        inputs: Vec::new(),
        flags: Vec::new(),
        clocks_mhz: Vec::new(),
        limits,
    };
    // First, since it takes no time to find that a chip is unknown.
    report.counts =
        arguments.table.has(Bench::Counts).then(|| counts::gather(arguments, &context.bars)).transpose()?;
    report.p1 = arguments.table.has(Bench::P1).then(|| p1::measure(&mut context)).transpose()?;
    report.i3 = arguments.table.has(Bench::I3).then(|| i3::measure(&mut context)).transpose()?;
    report.inputs = std::mem::take(&mut context.inputs);
    let measured = headless.map_or(Ok(()), |headless| measure(headless, &mut context, &mut report));
    context.bars.clear();
    measured?;
    if arguments.device.validate && arguments.table.needs_device() {
        report.flags.push("measured under validation: the times are worthless".to_owned());
    }
    Ok(report)
}

/// Measures the tables whose figures are times of the device.
fn measure(headless: &mut Headless, context: &mut BenchContext<'_>, report: &mut BenchReport) -> Result<()> {
    headless.renderer.check_settings(&context.settings)?;
    let facts = headless.device().facts().clone();
    report.device = Some(device_report(&facts));
    let watch = Watch::begin(&facts);
    let table = context.arguments.table;
    report.floor = table.has(Bench::Floor).then(|| floor::measure(headless, context)).transpose()?;
    if table.has(Bench::Table1) {
        report.table1 = table1::measure(headless, context)?;
    }
    report.slides = table.has(Bench::Slides).then(|| slides::measure(headless, context)).transpose()?;
    report.layers = table.has(Bench::Layers).then(|| layers::measure(headless, context)).transpose()?;
    report.transition =
        table.has(Bench::Transition).then(|| transition::measure(headless, context)).transpose()?;
    report.i1 = table.has(Bench::I1).then(|| clips::over_splats(headless, context)).transpose()?;
    report.i2 = table.has(Bench::I2).then(|| clips::over_occupancy(headless, context)).transpose()?;
    report.growth = table.has(Bench::Growth).then(|| growth::measure(headless, context)).transpose()?;
    report.p2 = table.has(Bench::P2).then(|| p2::measure(headless, context)).transpose()?;
    report.hybrid = table.has(Bench::Hybrid).then(|| hybrid::measure(headless, context)).transpose()?;
    let machine = watch.end(&context.clocks_mhz);
    report.flags = machine.flags(&context.limits);
    report.flags.append(&mut context.flags);
    report.inputs.append(&mut context.inputs);
    report.machine = Some(machine);
    Ok(())
}
