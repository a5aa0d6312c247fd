//! The filters on a checkerboard, from far to near.

use surfel::{
    Result,
    report::{
        Grid, NONE,
        zoom::{ZoomReport, ZoomStep},
    },
};

use super::{
    cells::scientific,
    part::{Block, Part},
    session::Session,
};
use crate::{
    compare::{CompareArguments, zoom},
    json::to_value,
};

/// A figure of a filter at a distance.
type Figure = fn(&ZoomStep, usize) -> Option<String>;

/// Gathers the part.
///
/// # Errors
/// Whatever goes wrong.
pub fn gather(session: &mut Session<'_>) -> Result<Part> {
    let line = session.arguments.zoom();
    let arguments: CompareArguments = line.arguments()?;
    let report = zoom::gather(session.headless, &arguments, session.bars)?;
    session.bars.clear();
    let mut part =
        Part { finding: finding(&report), commands: vec![line], data: to_value(&report)?, ..Part::default() };
    part.blocks.push(Block::Text(text(&report)));
    part.blocks.push(Block::Plot {
        svg: report.plot_svg()?,
        alt: "Pixels a splat, across, against the error, upward; a line for each filter".to_owned(),
        caption: "Low is better. On the left splats are far below a pixel: without a filter they alias. On the right they \
                  are large and filters should do nothing: what stays high there is blur, or, of `ewa`, its affine map. In \
                  the gray band splats are larger than the filter along one axis only, where the maximum fails."
            .to_owned(),
    });
    let claims = report.claims.iter().map(|claim| (claim.holds(), claim.to_string())).collect();
    part.blocks.push(Block::Claims(claims));
    let errors: Figure = |step, i| Some(scientific(Some(step.figures.get(i)?.as_ref()?.error.color?.rms)));
    let coverage: Figure = |step, i| Some(step.figures.get(i)?.as_ref()?.error.coverage_px.to_string());
    let fragments: Figure = |step, i| Some(step.figures.get(i)?.as_ref()?.fragments?.to_string());
    part.table(grid(&report, "RMS of linear color, over pixels that both cover", errors));
    part.table(grid(&report, "Pixels covered in one and empty in the other", coverage));
    part.table(grid(&report, "Fragments of the accumulation", fragments));
    if session.arguments.quick {
        part.blocks.push(Block::List(vec![
            "In small pictures a row of pixels at the board's border is a hundredth of the error: claims that fail by so \
             little are to be judged by the full report."
                .to_owned(),
        ]));
    }
    Ok(part)
}

fn finding(report: &ZoomReport) -> String {
    let judged = report.claims.iter().filter_map(|claim| claim.holds());
    let (all, held) = judged.fold((0, 0), |(all, held), holds| (all + 1, held + usize::from(holds)));
    format!("Over {} distances {held} of {all} claims about `adjust` hold.", report.steps.len())
}

fn text(report: &ZoomReport) -> String {
    let ([width, height], board) = (report.size_px, &report.board);
    format!(
        "A checkerboard of {0}x{0} splats, fields of {1}x{1}, radius {2} of the spacing, tilted by {3} degrees, in \
         {width}x{height} pixels, against a ground truth of at least {4} samples a pixel.",
        board.splats_per_side,
        board.splats_per_field,
        board.radius,
        board.tilt_deg,
        u64::from(report.samples_per_side).pow(2)
    )
}

/// A table of one figure.
fn grid(report: &ZoomReport, title: &str, figure: Figure) -> Grid {
    let filters: Vec<String> = report.filters.iter().map(|filter| filter.line()).collect();
    let head: Vec<&str> = ["pixels a splat"].into_iter().chain(filters.iter().map(String::as_str)).collect();
    let mut grid = Grid::new(title, &head);
    for step in &report.steps {
        let mixed = if step.is_mixed(&report.board) { " ~" } else { "" };
        let first = format!("{:.3}{mixed}", step.pixels_per_splat);
        let cells = (0..filters.len()).map(|i| figure(step, i).unwrap_or_else(|| NONE.to_owned()));
        grid.row([first].into_iter().chain(cells));
    }
    grid.notes.push("~: larger than the filter along one axis, smaller along the other.".to_owned());
    grid
}
