//! Several ways to draw, measured in turn with a floor.

use surfel::{
    Result,
    graph::execute::Profile,
    instruments::Floor,
    prepare::PreparedScene,
    renderer::Headless,
    report::{
        TimedFrames,
        bench::{Measurement, drift_flag, spread_flag},
    },
    scene::{Camera, Settings},
};

use super::context::BenchContext;
use crate::{
    machine::clock_mhz,
    turns::{self, Draw, MeasuredFrame},
};

/// A way to draw.
pub struct Entry<'a, S> {
    /// Its name; unique in its table.
    pub name: String,
    pub scene: &'a PreparedScene,
    pub settings: Settings,
    /// The rest that its table tells of it.
    pub subject: S,
}

/// Measures all entries of a table in turn with a floor, where there is one, and notes what makes the figures doubtful. `what`
/// names them in progress and notes.
pub fn measure<S>(
    headless: &mut Headless,
    context: &mut BenchContext<'_>,
    what: &str,
    camera: &Camera,
    entries: Vec<Entry<'_, S>>,
    floor: Option<Floor<'_>>,
) -> Result<(Vec<Measurement<S>>, TimedFrames)> {
    let mut draws: Vec<Draw<'_>> = Vec::new();
    for entry in &entries {
        draws.push(turns::frames(entry.scene, camera, entry.settings.clone()));
    }
    draws.extend(floor.map(floor_frames));
    let facts = headless.device().facts().clone();
    let (count, clocks) = (context.arguments.frames, &mut context.clocks_mhz);
    let task = format!("{what}: frames");
    let timed = turns::measure_interleaved(headless, draws, count, &task, &context.bars, &mut || {
        clocks.extend(clock_mhz(&facts));
    });
    let mut timed: Vec<TimedFrames> = timed.into_iter().collect::<Result<_>>()?;
    let rounds: Vec<Vec<f64>> = timed.iter().map(TimedFrames::frame_ms).collect();
    context.flags.extend(drift_flag(what, &rounds, &context.limits));
    let floor = (timed.len() > entries.len()).then(|| timed.pop()).flatten();
    let contestants = entries.into_iter().zip(timed).map(|(entry, timed)| (entry.name, entry.subject, timed));
    let measured = Measurement::all(contestants.collect(), floor.as_ref());
    for own in &measured {
        let what = format!("{what}, {}", own.name);
        context.flags.extend(spread_flag(&what, own.frames.frame_ms.as_ref(), &context.limits));
        context.flags.extend(own.frames.flags.iter().map(|flag| format!("{what}: {flag}")));
    }
    Ok((measured, floor.unwrap_or_default()))
}

fn floor_frames(mut floor: Floor<'_>) -> Draw<'_> {
    Box::new(move |headless: &mut Headless, profile: Profile| {
        let begun = std::time::Instant::now();
        let profile = floor.frame(headless, profile)?;
        // What the host does for it is not told apart from the wait.
        let (wall_secs, record_secs) = (begun.elapsed().as_secs_f64(), f64::NAN);
        Ok(MeasuredFrame { profile, wall_secs, record_secs, transient_bytes: 0 })
    })
}
