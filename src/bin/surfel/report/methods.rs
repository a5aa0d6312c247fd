//! What the methods cost, and how wrong they are.

use surfel::{
    Result,
    report::{
        Grid, cell,
        compare::{CompareReport, Deviation, MethodRow},
        count_cell,
    },
};

use super::{
    cells::{interval_cell, scientific},
    part::{Block, Part},
    session::Session,
};
use crate::json::to_value;

/// The passes that every frame has.
const PASSES: [&str; 3] = ["visibility", "accumulate", "finalize"];

/// Gathers the part.
///
/// # Errors
/// Whatever goes wrong.
pub fn gather(session: &mut Session<'_>) -> Result<Part> {
    let comparison = session.comparison()?;
    let report = &comparison.report;
    let front: Vec<usize> = (0..report.methods.len()).filter(|i| report.methods[*i].pareto).collect();
    let mut part = Part {
        finding: finding(report),
        commands: vec![comparison.line.clone()],
        flags: comparison.flags.clone(),
        machine: Some(comparison.machine.clone()),
        data: to_value(report)?,
        ..Part::default()
    };
    part.blocks.push(Block::Text(comparison.text()));
    part.blocks.push(Block::Plot {
        svg: report.plot_svg()?,
        alt: "Milliseconds a frame, across, against the error of the picture, upward; a dot for each method"
            .to_owned(),
        caption: "Speed against error: left is faster, low is more exact. Methods on the line, the Pareto front, are \
                  worth a choice; for every other one there is a method that is as fast and as exact, and better in \
                  one. Colors are filters, letters rasterizers; 32-bit sums are filled."
            .to_owned(),
    });
    part.blocks.push(Block::Table(costs(report), front.clone()));
    part.blocks.push(Block::Table(errors(report), front));
    let mut notes = report.notes.clone();
    for (reason, count) in skipped(report) {
        notes.push(format!("{count} combinations do not exist or were left out: {reason}"));
    }
    part.blocks.push(Block::List(notes));
    Ok(part)
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
    let fast = format!("`{}` with {ms:.1} ms a frame (error {error:.2e})", fast.method.line());
    match front.len() {
        1 => format!("Of {count} methods one is the fastest and within 1% of the most exact: {fast}."),
        front => format!(
            "Of {count} methods {front} are on the Pareto front, from {fast} to `{}` with {exact_ms:.1} ms (error \
             {least:.2e}).",
            exact.method.line()
        ),
    }
}

fn name(row: &MethodRow) -> String {
    let star = if row.pareto { "★ " } else { "" };
    format!("{star}{}", row.method.line())
}

fn costs(report: &CompareReport) -> Grid {
    let mut grid = Grid::new(
        "What the methods cost",
        &[
            "method",
            "frame, ms",
            "95% of the median, ms",
            "visibility, ms",
            "accumulate, ms",
            "finalize, ms",
            "other passes, ms",
            "fragments, visibility",
            "fragments, accumulate",
        ],
    );
    for row in &report.methods {
        let pass = |name: &str| row.passes.iter().find(|pass| pass.name == name);
        let ms = |name: &str| cell(pass(name).and_then(|pass| pass.ms).map(|ms| ms.median), 2);
        let fragments = |name: &str| count_cell(pass(name).and_then(|pass| pass.fragments));
        let others = row.passes.iter().filter(|pass| !PASSES.contains(&pass.name.as_str()));
        let others: Option<Vec<f64>> = others.map(|pass| pass.ms.map(|ms| ms.median)).collect();
        let others = others.filter(|ms| !ms.is_empty()).map(|ms| ms.iter().sum());
        grid.row([
            name(row),
            cell(row.frame_ms.map(|ms| ms.median), 2),
            interval_cell(row.frame_ms.as_ref()),
            ms(PASSES[0]),
            ms(PASSES[1]),
            ms(PASSES[2]),
            cell(others, 2),
            fragments(PASSES[0]),
            fragments(PASSES[1]),
        ]);
    }
    grid.notes
        .push("Medians. ★: on the Pareto front of milliseconds a frame and error of the image.".to_owned());
    grid
}

fn errors(report: &CompareReport) -> Grid {
    let mut grid = Grid::new(
        "How far their pictures are from the exact ones",
        &[
            "method",
            "image error, RMS",
            "color, RMS",
            "color, largest",
            "PSNR, dB",
            "SSIM",
            "coverage, px",
            "normals, degrees",
            "depth, relative",
            "own oracle: color, RMS",
            "largest",
            "left out",
        ],
    );
    let rms = |deviation: Option<Deviation>| scientific(deviation.map(|deviation| deviation.rms));
    let max = |deviation: Option<Deviation>| scientific(deviation.map(|deviation| deviation.max));
    for row in &report.methods {
        let (truth, own) = (&row.method_error, &row.implementation_error);
        grid.row([
            name(row),
            scientific(truth.image.map(|image| image.rms)),
            rms(truth.color),
            max(truth.color),
            cell(truth.psnr_db, 2),
            cell(truth.ssim, 4),
            truth.coverage_px.to_string(),
            rms(truth.normal_deg),
            rms(truth.depth),
            rms(own.color),
            max(own.color),
            format!("{:.2}%", 100.0 * own.left_out_share),
        ]);
    }
    grid.notes = vec![
        "Against the ground truth: linear color, white is 1; image: over all that either picture touches, over white; all \
         else over pixels that both cover; coverage: pixels that only one covers."
            .to_owned(),
        "Against the own oracle, the same method in 64 bits: what precision costs. Left out: pixels that rounding alone may \
         turn."
            .to_owned(),
    ];
    grid
}

/// Why methods were left out, and how many.
fn skipped(report: &CompareReport) -> Vec<(&str, usize)> {
    let mut reasons: Vec<(&str, usize)> = Vec::new();
    for skipped in &report.skipped {
        match reasons.iter_mut().find(|(reason, _)| *reason == skipped.reason) {
            Some((_, count)) => *count += 1,
            None => reasons.push((&skipped.reason, 1)),
        }
    }
    reasons
}
