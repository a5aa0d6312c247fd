//! What the passes cost beside the least that the same pixels can cost.

use surfel::{
    Result,
    report::{FloorReport, FloorRow, Grid, Spread, TrustLimits, cell, count_cell, spread_flag},
};

use super::{
    cells::interval_cell,
    part::{Block, Part},
    session::{Session, shortened},
};
use crate::{arguments::Command, bench, json::to_value};

/// Gathers the part.
///
/// # Errors
/// Whatever goes wrong; a device without timestamps.
pub fn gather(session: &mut Session<'_>) -> Result<Part> {
    let line = session.arguments.bench("floor");
    let Command::Bench(arguments) = line.command()? else { return Err(line.unexpected()) };
    let measured = session.watched(|session| {
        let Session { headless, loaded, bars, .. } = session;
        bench::measure_floor(headless, &arguments, loaded, bars)
    });
    session.bars.clear();
    let (report, machine, mut flags) = measured?;
    let limits = TrustLimits::default();
    let doubt = |row: &FloorRow| spread_flag(&row.name, row.ms.as_ref(), &limits);
    flags.extend(shortened(report.rows.iter().filter_map(doubt).collect()));
    let mut part = Part {
        finding: finding(&report),
        commands: vec![line],
        flags,
        machine: Some(machine),
        data: to_value(&report)?,
        ..Part::default()
    };
    part.blocks.push(Block::Text(format!(
        "The floor draws the same points through the same fixed-function stages into the same formats with nothing computed; \
         the strict floor leaves out what the passes cull. {} splats; the floor draws {} points, the strict floor {}. {}, {} \
         rounds, all three in turn.",
        report.scene.splats,
        report.floor_points,
        report.strict_points,
        report.settings.get("size").map_or("", String::as_str),
        report.rounds
    )));
    part.table(grid(&report));
    Ok(part)
}

fn finding(report: &FloorReport) -> String {
    let ratio = report.rows.last().and_then(|frame| Some([frame.ratio?.median, frame.strict_ratio?.median]));
    match ratio {
        Some([floor, strict]) => format!(
            "A frame takes {floor:.2} times what the same points cost with nothing computed, {strict:.2} times the strict \
             floor: whatever is done to the shaders, no more than that can be gained."
        ),
        None => "The device tells no times.".to_owned(),
    }
}

fn grid(report: &FloorReport) -> Grid {
    let mut grid = Grid::new(
        "The passes and their floor",
        &[
            "pass",
            "ms",
            "95% of the median, ms",
            "floor, ms",
            "strict floor, ms",
            "times the floor",
            "times the strict floor",
            "fragments",
            "floor's fragments",
        ],
    );
    let median = |spread: Option<Spread>, decimals| cell(spread.map(|spread| spread.median), decimals);
    for row in &report.rows {
        grid.row([
            row.name.clone(),
            median(row.ms, 2),
            interval_cell(row.ms.as_ref()),
            median(row.floor_ms, 2),
            median(row.strict_floor_ms, 2),
            median(row.ratio, 2),
            median(row.strict_ratio, 2),
            count_cell(row.fragments),
            count_cell(row.floor_fragments),
        ]);
    }
    grid.notes.push(
        "Medians; a ratio is the median of the rounds' own ratios, which hold where milliseconds drift."
            .to_owned(),
    );
    grid
}
