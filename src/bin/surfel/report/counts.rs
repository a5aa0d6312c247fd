//! The instructions of every pipeline, beside the papers'.

use surfel::{
    Result,
    report::{Grid, InstructionReport},
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
/// None that an input could lead to.
pub fn gather(session: &mut Session<'_>) -> Result<Part> {
    let line = session.arguments.bench("counts");
    let arguments: BenchArguments = line.arguments()?;
    let report = bench::gather(None, &arguments)?;
    let mut part = Part {
        finding: "The papers' own programs come out as published, but for 1 or 2 instructions; ours have more, which is what \
                  keeps hard splats right."
            .to_owned(),
        commands: vec![line],
        data: to_value(&report)?,
        ..Part::default()
    };
    if let Some(counts) = &report.counts {
        part.blocks.push(Block::List(counts.notes.clone()));
        part.table(grid(counts));
    }
    Ok(part)
}

fn grid(counts: &InstructionReport) -> Grid {
    let head = ["pass", "rasterizer", "filter", "kernel", "VP/FP", "published", "scalar", "longest path"];
    let mut grid = Grid::new("Instructions", &head);
    for row in &counts.rows {
        let names = &row.names;
        let published =
            row.published.map_or_else(String::new, |[vertex, fragment]| format!("{vertex}/{fragment}"));
        grid.row([
            names.pass.clone(),
            names.rasterizer.clone(),
            names.filter.clone(),
            names.kernel_eval.clone(),
            row.counts.vertex_and_fragment(),
            published,
            row.counts.of_stages(|counts| Some(counts.scalar)),
            row.counts.of_stages(|counts| counts.arb_longest_path),
        ]);
    }
    grid
}
