//! The paper's tables on this device: throughput over numbers of splats, and the slides' methods side by side.

use surfel::{
    Result,
    report::{ThroughputRow, throughput_plot},
};

use super::{
    part::{Block, Part},
    session::Session,
};
use crate::{
    bench::{self, BenchArguments},
    json::to_value,
};

/// Gathers the part.
///
/// # Errors
/// Whatever goes wrong; a model that is no mesh, which can't be resampled.
pub fn gather(session: &mut Session<'_>) -> Result<Part> {
    let mut part = Part::default();
    let mut data = Vec::new();
    for table in ["table1", "slides"] {
        let line = session.arguments.bench(table);
        let arguments: BenchArguments = line.arguments()?;
        let report = bench::gather(Some(&mut *session.headless), &arguments)?;
        data.push(to_value(&report)?);
        if !report.table1.is_empty() {
            part.finding = finding(&report.table1);
            let device = report.device.as_ref().map_or("", |device| device.name.as_str());
            part.blocks.push(Block::Plot {
                svg: throughput_plot(&report.table1, device)?,
                alt: "milliseconds a frame over numbers of splats, both logarithmic".to_owned(),
                caption: "Milliseconds a frame over numbers of splats, beside the paper's on its own hardware of 2006. The \
                          distance from a line to the floor is what the method's own work costs."
                    .to_owned(),
            });
        }
        for grid in report.grids() {
            part.table(grid);
        }
        part.flags.extend(report.flags);
        part.machine = part.machine.or(report.machine);
        part.commands.push(line);
    }
    part.data = data.into();
    Ok(part)
}

/// The paper's claim: perspective splatting is 1.3 to 1.7 times as fast as ray casting.
fn finding(rows: &[ThroughputRow]) -> String {
    let ratios: Vec<f64> =
        rows.iter().filter_map(|row| row.beside_first.get(1)?.map(|spread| spread.median)).collect();
    let ends = ratios.iter().copied().reduce(f64::min).zip(ratios.iter().copied().reduce(f64::max));
    match ends {
        Some((least, most)) => format!(
            "Ray casting takes {least:.2} to {most:.2} times as long as perspective splatting; on the paper's hardware 1.3 to 1.7."
        ),
        None => "The device tells no times.".to_owned(),
    }
}
