//! The part on the methods' costs and errors.

use surfel::{
    Result,
    report::{
        PLOT_SIZE_PX,
        compare::{CompareReport, MethodRow},
    },
};

use super::{
    part::{Block, Part},
    session::Session,
};
use crate::json::to_value;

/// Gathers the part.
pub fn gather(session: &mut Session<'_>) -> Result<Part> {
    let comparison = session.comparison()?;
    let report = &comparison.report;
    let front: Vec<usize> = (0..report.methods.len()).filter(|i| report.methods[*i].pareto).collect();
    let mut blocks = vec![
        Block::Text(format!("What was measured: {}.", report.setting())),
        Block::Plot {
            svg: report.plot().svg(PLOT_SIZE_PX)?,
            alt: "Milliseconds a frame, across, against the error of the picture, upward; a dot for each method"
                .to_owned(),
            caption: "Speed against error: left is faster, low is more exact. Methods on the line, the Pareto front, are \
                      worth a choice; for every other one there is a method that is as fast and as exact, and better in \
                      one. Colors are filters, letters rasterizers; 32-bit sums are filled."
                .to_owned(),
        },
    ];
    blocks.extend(report.grids().map(|grid| Block::Table(grid, front.clone())));
    let reason = |(reason, count)| format!("{count} combinations do not exist or were left out: {reason}");
    let notes =
        report.why.iter().chain(&report.notes).cloned().chain(report.reasons().into_iter().map(reason));
    blocks.push(Block::List(notes.collect()));
    Ok(Part {
        finding: finding(report),
        blocks,
        commands: vec![comparison.line.clone()],
        flags: comparison.flags.clone(),
        machine: Some(comparison.machine.clone()),
        data: to_value(report)?,
        ..Part::default()
    })
}

/// The front in words.
fn finding(report: &CompareReport) -> String {
    let mut front: Vec<(&MethodRow, [f64; 2])> = report
        .methods
        .iter()
        .filter(|row| row.pareto)
        .filter_map(|row| Some((row, row.speed_and_error()?)))
        .collect();
    front.sort_by(|a, b| a.1[0].total_cmp(&b.1[0]));
    let count = report.methods.len();
    let (Some((fast, [ms, error])), Some((exact, [exact_ms, least]))) = (front.first(), front.last()) else {
        return format!(
            "{count} methods; the device tells no times, so that none can be called the fastest."
        );
    };
    let fast = format!("`{}` with {ms:.1} ms a frame (error {error:.2e})", fast.method);
    match front.len() {
        1 => format!("Of {count} methods one is the fastest and within 1% of the most exact: {fast}."),
        front => format!(
            "Of {count} methods {front} are on the Pareto front, from {fast} to `{}` with {exact_ms:.1} ms (error \
             {least:.2e}).",
            exact.method
        ),
    }
}
