//! `surfel bench i3`: clipped splats in the making (Ivo et al. 2012, section 5), without a device.

use std::time::Instant;

use surfel::{
    Result,
    geometry::sharp::Clipping,
    hard_scenes::parts::bored_block,
    report::{
        Spread,
        bench::{ConversionReport, ConversionRow},
    },
};

use super::context::BenchContext;
use crate::part::Part;

/// Triangles of the built-in part, about.
const TRIANGLES: [f64; 5] = [1e4, 3e4, 1e5, 3e5, 1e6];

/// What each mesh becomes.
const SPLATS: u64 = 2_500;

/// So many give an interval.
const ROUNDS: usize = 6;

/// Measures it of a file's mesh, or of the built-in part in ever more triangles.
///
/// # Errors
/// A model that is no mesh, or none of which such splats can be made.
pub fn measure(context: &mut BenchContext<'_>) -> Result<ConversionReport> {
    let mut report =
        ConversionReport { threads: rayon::current_num_threads(), ..ConversionReport::default() };
    let parts: Vec<Part> = match context.arguments.model.as_deref() {
        Some(path) => vec![Part::open(Some(path), &context.bars)?],
        None => TRIANGLES.map(built_in).into(),
    };
    for part in parts {
        report.rows.push(row(&part, context)?);
        report.model = part.name;
    }
    Ok(report)
}

/// Its triangles are near to squares.
fn built_in(triangles: f64) -> Part {
    let steps = (triangles / 225.0).sqrt().round() as u32;
    Part { mesh: bored_block(16 * steps, steps), name: "the built-in part".to_owned() }
}

fn row(part: &Part, context: &BenchContext<'_>) -> Result<ConversionRow> {
    let wanted = context.arguments.splats.first().copied().unwrap_or(SPLATS);
    let mut secs = Vec::new();
    let mut counts = [0; 2];
    for _ in 0..ROUNDS {
        let begin = Instant::now();
        let (scene, report) = part.splats(Some(wanted), Clipping::Shared, &context.bars)?;
        secs.push(begin.elapsed().as_secs_f64());
        counts = [scene.splat_count() as u64, report.clipped as u64];
    }
    let [splats, clipped] = counts;
    Ok(ConversionRow { triangles: part.mesh.triangles.len() as u64, splats, clipped, secs: Spread::of(secs) })
}
