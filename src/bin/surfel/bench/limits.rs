//! The device's limits beside the frame's passes, and how much each pass does of what they limit.

use std::collections::BTreeMap;

use surfel::{
    Result,
    graph::{
        Plan, PlannedPass,
        execute::{FrameProfile, PassCounts, PassProfile},
    },
    prepare::{Chunk, PreparedScene},
    renderer::{Headless, LimitProbes, Probe},
    report::{Limit, LimitRound, LimitWork, LimitsReport, PassWork},
    scene::Settings,
};

/// The limits, measured round by round.
pub struct Limits {
    probes: LimitProbes,
    rounds: Vec<LimitRound>,
}

impl Limits {
    /// Sets them up for frames with these settings.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn new(headless: &Headless, settings: &Settings) -> Result<Self> {
        Ok(Self { probes: LimitProbes::new(headless, settings)?, rounds: Vec::new() })
    }

    /// Measures all limits once; in rounds that count, beside the frame's passes.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn round(&mut self, headless: &Headless, passes_ms: Option<&[f64]>) -> Result<()> {
        let secs = self.probes.measure(headless)?;
        if let Some(passes_ms) = passes_ms {
            let limits_ms = secs.into_iter().map(|secs| secs.map(|secs| 1e3 * secs)).collect();
            self.rounds.push(LimitRound { passes_ms: passes_ms.to_vec(), limits_ms });
        }
        Ok(())
    }

    /// What came of it. `counted` are the counts of a frame that was recorded as `plan`, `drawn_points` the splats of it
    /// that are seen.
    pub fn report(
        self,
        plan: &Plan,
        counted: &FrameProfile,
        prepared: &PreparedScene,
        drawn_points: u64,
    ) -> LimitsReport {
        let bytes_per_blended = self.probes.bytes_per_blended_fragment();
        let work = |probe: &Probe| LimitWork {
            limit: probe.limit(),
            units: probe.units(),
            bytes_per_unit: match probe.limit() {
                Limit::BlendedFragments => Some(bytes_per_blended),
                Limit::Bytes => Some(1),
                _ => None,
            },
        };
        let works: Vec<LimitWork> = self.probes.probes.iter().map(work).collect();
        let passes: Vec<PassWork> = plan
            .passes
            .iter()
            .zip(&counted.passes)
            .map(|(pass, counted)| pass_work(plan, pass, counted, (prepared, drawn_points)))
            .collect();
        LimitsReport::of(&works, &passes, &self.rounds, self.probes.notes)
    }
}

/// How much a pass does. Of a pass of compute that are its invocations and the bytes that its plan tells.
fn pass_work(
    plan: &Plan,
    pass: &PlannedPass,
    counted: &PassProfile,
    (prepared, drawn_points): (&PreparedScene, u64),
) -> PassWork {
    let mut units = BTreeMap::new();
    let mut bytes = plan.least_bytes(pass, counted.counts.map(|counts| counts.fragments));
    units.extend(counted.invocations.map(|invocations| (Limit::Invocations, invocations)));
    if let Some(PassCounts { vertices, fragments }) = counted.counts {
        units.insert(Limit::Points, vertices);
        units.insert(fragments_of(pass), fragments);
        // Splats are bound by the passes' bodies, not by the graph: whatever draws them all reads them all.
        if vertices >= prepared.splat_count() {
            units.insert(Limit::DrawnPoints, drawn_points);
            bytes = bytes.map(|bytes| bytes + shape_bytes(prepared));
        }
    }
    units.extend(bytes.map(|bytes| (Limit::Bytes, bytes)));
    PassWork { name: pass.name.clone(), units }
}

/// Bytes of a color in the buffers of a chunk.
const COLOR_BYTES: u64 = 8;

/// Bytes of the splats without their colors, which only those need that are seen, and not in every pass.
fn shape_bytes(prepared: &PreparedScene) -> u64 {
    let of = |chunk: &Chunk| {
        let colors = if chunk.uniform_color { 1 } else { u64::from(chunk.count) };
        chunk.bytes().saturating_sub(COLOR_BYTES * colors)
    };
    prepared.chunks.iter().map(of).sum()
}

/// What a pass's fragments are: the plan has the attachments, but only the pass's name tells whether it blends.
fn fragments_of(pass: &PlannedPass) -> Limit {
    let has_colors = pass.rendering.as_ref().is_some_and(|rendering| !rendering.colors.is_empty());
    match () {
        () if !has_colors => Limit::DepthFragments,
        () if pass.name.starts_with("accumulate") || pass.name.starts_with("compose") => {
            Limit::BlendedFragments
        }
        () => Limit::Fragments,
    }
}
