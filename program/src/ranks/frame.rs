//! A frame by all processes: what each sees, the nearest of all, what each sums of that, and the sums of all.

use std::{fmt::Write as _, time::Instant};

use surfel::{
    Result,
    renderer::{Headless, PartSums},
};

use super::world::Ranks;
use crate::measure::View;

/// The stages, in order.
pub const STAGES: [&str; 4] = ["see", "Allreduce of depth", "sum", "Reduce of sums"];

/// What is known of all parts: of sums in the first process alone.
pub struct OfAll {
    pub depth: Vec<f32>,
    pub sums: PartSums,
    /// Seconds of this process's stages.
    pub secs: [f64; STAGES.len()],
}

/// The bytes that a process gives and takes in the two reductions, of so many pixels.
pub fn moved_bytes(pixels: usize) -> [usize; 2] {
    [4 * pixels, 32 * pixels]
}

/// Draws all but the picture.
///
/// # Errors
/// As [`Headless::sum_part`], and where another process fails.
pub fn draw(headless: &mut Headless, view: View<'_>, with_depth: bool, ranks: &Ranks) -> Result<OfAll> {
    let View { scene, camera, settings } = view;
    let mut secs = [0.0; STAGES.len()];
    let mut begun = Instant::now();
    let mut end = |stage: usize| {
        secs[stage] = begun.elapsed().as_secs_f64();
        begun = Instant::now();
    };
    let mut depth = ranks.agree(headless.see_part(scene, camera, settings))?;
    end(0);
    ranks.largest_of(&mut depth);
    end(1);
    let mut sums = ranks.agree(headless.sum_part(scene, camera, settings, &depth, with_depth))?;
    end(2);
    ranks.sums_of(&mut sums.colors);
    ranks.sums_of(&mut sums.normals);
    end(3);
    Ok(OfAll { depth, sums, secs })
}

/// Draws so many frames after one that warms up; a table of the slowest process's medians, for the first process.
///
/// # Errors
/// As [`draw`].
pub fn measure(
    headless: &mut Headless,
    view: View<'_>,
    with_depth: bool,
    frames: u32,
    ranks: &Ranks,
) -> Result<String> {
    draw(headless, view, with_depth, ranks)?;
    let mut all: [Vec<f64>; STAGES.len()] = Default::default();
    for _ in 0..frames {
        let frame = draw(headless, view, with_depth, ranks)?;
        all.iter_mut().zip(frame.secs).for_each(|(of, secs)| of.push(secs));
    }
    let mut medians = all.map(|mut of| {
        of.sort_by(f64::total_cmp);
        of[of.len() / 2] as f32
    });
    ranks.largest_of(&mut medians);
    let [width, height] = view.settings.size_px.map(|side| side as usize);
    let [depth, sums] = moved_bytes(width * height);
    let mut table =
        format!("{} processes, medians of {frames} frames, each of the slowest process:\n", ranks.count());
    for ((stage, secs), bytes) in STAGES.iter().zip(medians).zip([0, depth, 0, sums]) {
        let moved = if bytes > 0 { format!(", {bytes} bytes from each process") } else { String::new() };
        let _ = writeln!(table, "  {stage}: {:.2} ms{moved}", 1e3 * secs);
    }
    Ok(table)
}
