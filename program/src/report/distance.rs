//! The filters on a checkerboard, from far to near.

use surfel::{
    Result,
    report::{PLOT_SIZE_PX, zoom::ZoomReport},
};

use super::{
    part::{Block, Part},
    session::Session,
};
use crate::{
    compare::{self, CompareArguments},
    json::to_value,
};

/// Gathers the part.
pub fn gather(session: &mut Session<'_>) -> Result<Part> {
    let line = session.arguments.zoom();
    let arguments: CompareArguments = line.arguments()?;
    let report = compare::gather_zoom(session.headless, &arguments, session.bars)?;
    session.bars.clear();
    let judged = report.claims.iter().filter_map(|claim| claim.holds());
    let (all, held) = judged.fold((0, 0), |(all, held), holds| (all + 1, held + usize::from(holds)));
    let finding =
        format!("Over {} distances {held} of {all} claims about `adjust` hold.", report.steps.len());
    let mut blocks = vec![
        Block::Text(format!("What was looked at: {}.", report.setting().replace('\n', "; "))),
        Block::Plot {
            svg: report.plot().svg(PLOT_SIZE_PX)?,
            alt: "Pixels a splat, across, against the error, upward; a line for each filter".to_owned(),
            caption: "Low is better. On the left splats are far below a pixel: without a filter they alias. On the right they \
                      are large and filters should do nothing: what stays high there is blur, or, of `ewa`, its affine map. In \
                      the gray band splats are larger than the filter along one axis only, where the maximum fails."
                .to_owned(),
        },
        Block::Claims(report.claims.iter().map(|claim| (claim.holds(), claim.to_string())).collect()),
    ];
    blocks.extend(report.grids().map(|grid| Block::Table(grid, Vec::new())));
    let mut notes = vec![ZoomReport::NOTE.to_owned()];
    if session.arguments.quick {
        notes.push(
            "In small pictures a row of pixels at the board's border is a hundredth of the error: claims that fail by so \
             little are to be judged by the full report."
                .to_owned(),
        );
    }
    blocks.push(Block::List(notes));
    Ok(Part { finding, blocks, commands: vec![line], data: to_value(&report)?, ..Part::default() })
}
