//! A frame by all processes: what each sees, the nearest of all, what each sums of that, and the sums of all; of opaque splats, then of transparent ones
//! layer by layer.

use std::{fmt::Write as _, time::Instant};

use surfel::{
    Result,
    renderer::{Headless, LayerSums, PartSums, PartsAround},
    scene::LastLayer,
};

use super::world::Ranks;
use crate::measure::View;

/// The stages, in order; of all layers together.
pub const STAGES: [&str; 5] = ["see", "Allreduce of depth", "sum", "Reduce of sums", "compose layers"];

/// What is drawn of a frame beside its opaque picture.
#[derive(Clone, Copy)]
pub struct Also {
    /// The depth of opaque splats.
    pub depth: bool,
    /// Transparent layers.
    pub layers: bool,
}

/// What is known of all parts: of sums and layers in the first process alone.
pub struct OfAll {
    pub depth: Vec<f32>,
    pub sums: PartSums,
    /// Where there are any.
    pub layers: Option<Vec<f32>>,
    /// Seconds of this process's stages, and the bytes that it has given to each.
    pub stages: [(f64, usize); STAGES.len()],
}

/// What the stages of a process take.
struct Stages<'r> {
    ranks: &'r Ranks,
    begun: Instant,
    of: [(f64, usize); STAGES.len()],
}

impl Stages<'_> {
    /// A stage has ended.
    fn end(&mut self, stage: usize, bytes: usize) {
        self.of[stage].0 += self.begun.elapsed().as_secs_f64();
        self.of[stage].1 += bytes;
        self.begun = Instant::now();
    }

    /// The depth of all processes, of which this one has seen so much.
    fn nearest(&mut self, seen: Result<Vec<f32>>) -> Result<Vec<f32>> {
        let mut depth = self.ranks.agree(seen)?;
        self.end(0, 0);
        self.ranks.largest_of(&mut depth);
        self.end(1, size_of_val(&depth[..]));
        Ok(depth)
    }

    /// The sums of all processes, for the first one, of which this one has summed so much.
    fn added(&mut self, summed: Result<PartSums>) -> Result<PartSums> {
        let mut sums = self.ranks.agree(summed)?;
        self.end(2, 0);
        self.ranks.sums_of(&mut sums.colors);
        self.ranks.sums_of(&mut sums.normals);
        self.end(3, size_of_val(&sums.colors[..]) + size_of_val(&sums.normals[..]));
        Ok(sums)
    }
}

/// Draws all but the picture.
///
/// # Errors
/// As [`Headless::sum_part`], and where another process fails.
pub fn draw(headless: &mut Headless, view: View<'_>, also: Also, ranks: &Ranks) -> Result<OfAll> {
    let View { scene, camera, settings } = view;
    let mut stages = Stages { ranks, begun: Instant::now(), of: Default::default() };
    let depth = stages.nearest(headless.see_part(scene, camera, settings))?;
    let sums = stages.added(headless.sum_part(scene, camera, settings, &depth, also.depth))?;
    let layers = match also.layers {
        true => Some(layers(headless, view, &depth, &mut stages)?),
        false => None,
    };
    Ok(OfAll { depth, sums, layers, stages: stages.of })
}

/// What transparent layers before opaque splats of this depth add up to, in the first process.
fn layers(
    headless: &mut Headless,
    view: View<'_>,
    opaque: &[f32],
    stages: &mut Stages<'_>,
) -> Result<Vec<f32>> {
    let View { scene, camera, settings } = view;
    let ranks = stages.ranks;
    let mut composed = None;
    let mut before: Option<(Vec<f32>, PartSums)> = None;
    let count = settings.layers.most();
    for number in 1..=count {
        let around =
            PartsAround { opaque: Some(opaque), before: before.as_ref().map(|(depth, _)| &depth[..]) };
        let of_rest = number == count && settings.last_layer != LastLayer::Drop;
        let (depth, sums) = if of_rest {
            (Vec::new(), stages.added(headless.sum_rest_part(scene, camera, settings, around))?)
        } else {
            let depth = stages.nearest(headless.see_layer_part(scene, camera, settings, around))?;
            let sums = stages.added(headless.sum_layer_part(scene, camera, settings, around, &depth))?;
            (depth, sums)
        };
        if !ranks.first_says(sums.colors.chunks_exact(4).any(|of| of[3] > 0.0)) {
            break;
        }
        let done = match ranks.is_first() {
            true => {
                let counts = before.as_ref().filter(|_| settings.last_layer == LastLayer::Stack);
                let of_layer = match of_rest {
                    true => LayerSums::Rest(&sums, counts.map(|(_, sums)| sums)),
                    false => LayerSums::Surface(&sums),
                };
                headless.compose_parts(scene, camera, settings, of_layer, composed.as_deref()).map(Some)
            }
            false => Ok(None),
        };
        composed = ranks.agree(done)?;
        stages.end(4, 0);
        before = Some((depth, sums));
    }
    // No layer at all adds up to nothing.
    Ok(composed.unwrap_or_else(|| vec![0.0; 4 * opaque.len()]))
}

/// Draws so many frames after one that warms up; a table of the slowest process's medians, for the first process.
///
/// # Errors
/// As [`draw`].
pub fn measure(
    headless: &mut Headless,
    view: View<'_>,
    also: Also,
    frames: u32,
    ranks: &Ranks,
) -> Result<String> {
    let moved = draw(headless, view, also, ranks)?.stages.map(|(_, bytes)| bytes);
    let mut all: [Vec<f64>; STAGES.len()] = Default::default();
    for _ in 0..frames {
        let frame = draw(headless, view, also, ranks)?;
        all.iter_mut().zip(frame.stages).for_each(|(of, (secs, _))| of.push(secs));
    }
    let mut medians = all.map(|mut of| {
        of.sort_by(f64::total_cmp);
        of[of.len() / 2] as f32
    });
    ranks.largest_of(&mut medians);
    let mut table =
        format!("{} processes, medians of {frames} frames, each of the slowest process:\n", ranks.count());
    let stages = STAGES.iter().zip(medians).zip(moved).take(STAGES.len() - usize::from(!also.layers));
    for ((stage, secs), bytes) in stages {
        let moved = if bytes > 0 { format!(", {bytes} bytes from each process") } else { String::new() };
        let _ = writeln!(table, "  {stage}: {:.2} ms{moved}", 1e3 * secs);
    }
    Ok(table)
}
