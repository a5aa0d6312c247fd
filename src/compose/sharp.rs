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
    let size = mesh.bounds().map_or(0.0, |bounds| (bounds.max - bounds.min).length());
    let asked = options.splats.filter(|asked| (splats.len() as u64) > *asked);
    let object = Object { name, splats, closed: made.closed };
    let (object, report) = finish(object, head(counts, &made, size, asked), Some(counts));
    Ok((object, InputReport { notes: [made.repairs.notes(), report.notes].concat(), ..report }))
}

/// An error above so much of the size is seen.
const FEW: f64 = 1e-3;

/// `size`: the diagonal of the box around it. `asked`: the splats that were asked for, where there are more.
fn head([vertices, triangles]: [usize; 2], made: &SharpReport, size: f64, asked: Option<u64>) -> String {
    let repairs: String = made.repairs.notes().iter().map(|note| format!(", {note}")).collect();
    let mut head = format!(
        "{}, {}: {}{repairs}; {} in {}, {} clipped",
        counted(vertices, "vertex", "vertices"),
        counted(triangles, "triangle", "triangles"),
        if made.closed { "closed" } else { "open" },
        counted(made.ridges, "ridge", "ridges"),
        counted(made.pieces, "piece", "pieces"),
        counted(made.clipped, "splat", "splats"),
    );
    let seen = |length: f64| match length > FEW * size {
        true => format!(", {:.1}% of its size", 100.0 * length / size),
        false => String::new(),
    };
    if made.error > 0.0 {
        head += &format!(", error up to {:.3e}{}", made.error, seen(made.error));
    }
    if made.stands_off > made.error {
        head += &format!(", ellipses stand off it by up to {:.3e}{}", made.stands_off, seen(made.stands_off));
    }
    if made.colors_off > 0.0 {
        head += &format!(", colors off as a distance of up to {:.3e}", made.colors_off);
    }
    if let Some(asked) = asked {
        head += &format!(", more splats than the {asked} asked for, because no other edge can be left out");
    }
    if made.crowded > 0 {
        head += &format!(", {} with more ridges than can be cut", made.crowded);
    }
    head
}
