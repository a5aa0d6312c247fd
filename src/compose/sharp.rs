//! A mesh as splats that are clipped at its ridges, in words.

use super::words::{counted, finish};
use crate::{
    error::Result,
    geometry::sharp::{SharpOptions, SharpReport, sharp_splats},
    progress::Progress,
    report::InputReport,
    scene::{Mesh, Object},
};

/// Makes clipped splats of a mesh, and tells what was done.
///
/// # Errors
/// As [`sharp_splats`].
pub fn sharpened(
    mesh: &Mesh,
    name: String,
    options: &SharpOptions,
    progress: &dyn Progress,
) -> Result<(Object, InputReport)> {
    let (splats, made) = sharp_splats(mesh, options, progress)?;
    let counts = [mesh.positions.len(), mesh.triangles.len()];
    let object = Object { name, splats, closed: made.closed };
    let (object, report) = finish(object, head(counts, &made), Some(counts));
    Ok((object, InputReport { notes: [made.repairs.notes(), report.notes].concat(), ..report }))
}

fn head([vertices, triangles]: [usize; 2], made: &SharpReport) -> String {
    let mut head = format!(
        "{}, {}: {}; {} in {}, {} clipped",
        counted(vertices, "vertex", "vertices"),
        counted(triangles, "triangle", "triangles"),
        if made.closed { "closed" } else { "open" },
        counted(made.ridges, "ridge", "ridges"),
        counted(made.pieces, "piece", "pieces"),
        counted(made.clipped, "splat", "splats"),
    );
    if made.error > 0.0 {
        head += &format!(", error up to {:.3e}", made.error);
    }
    if made.crowded > 0 {
        head += &format!(", {} with more ridges than can be cut", made.crowded);
    }
    head
}
