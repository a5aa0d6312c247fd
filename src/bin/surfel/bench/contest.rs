//! Several ways to draw, timed in turn with a floor.

use std::cell::Cell;

use surfel::{
    Error, Result,
    instruments::Floor,
    prepare::PreparedScene,
    renderer::Headless,
    report::{Measured, drift_flag, spread_flag},
    scene::{Camera, Scene, Settings},
};

use super::{Stage, table1::floor_frames};
use crate::{
    machine::clock_mhz,
    turns::{self, Draw, Timed},
};

/// A way to draw.
pub struct Entry<'a> {
    /// What it is called; unique in its table.
    pub name: String,
    /// What is drawn.
    pub scene: &'a PreparedScene,
    /// How.
    pub settings: Settings,
}

/// What was measured of all entries and of the floor.
pub struct Contest {
    names: Vec<String>,
    entries: Vec<Timed>,
    floor: Timed,
    /// Bytes of device memory in each entry's transients.
    pub transient_bytes: Vec<u64>,
}

impl Contest {
    /// Of the entries, in their order.
    pub fn entries(&self) -> Vec<Measured<'_>> {
        self.names.iter().zip(&self.entries).map(|(name, timed)| measured(name, timed)).collect()
    }

    /// Of the floor.
    pub fn floor(&self) -> Measured<'_> {
        measured("floor", &self.floor)
    }
}

/// What was measured of one way to draw.
pub fn measured<'a>(name: &'a str, timed: &'a Timed) -> Measured<'a> {
    Measured {
        name,
        paper: None,
        passes: &timed.names,
        rounds: &timed.rounds,
        counts: &timed.counts,
        instructions: &[],
    }
}

/// Brings a scene to the device.
///
/// # Errors
/// Settings that the scene rules out; whatever the allocator or the driver answers.
pub fn prepare(headless: &Headless, stage: &Stage<'_>, scene: &Scene) -> Result<PreparedScene> {
    stage.settings.check_scene(scene)?;
    headless.prepare(scene, &|done, total| surfel::Progress::step(&stage.bars, "upload", done, total))
}

/// Times all entries of a table in turn with a floor, and notes what makes the figures doubtful.
///
/// # Errors
/// Whatever the driver answers.
pub fn take(
    headless: &mut Headless,
    stage: &mut Stage<'_>,
    table: &str,
    camera: &Camera,
    entries: Vec<Entry<'_>>,
    floor: Floor<'_>,
) -> Result<Contest> {
    let names: Vec<String> = entries.iter().map(|entry| entry.name.clone()).collect();
    let bytes: Vec<Cell<u64>> = entries.iter().map(|_| Cell::new(0)).collect();
    let mut contestants: Vec<Draw<'_>> =
        entries.into_iter().zip(&bytes).map(|(entry, bytes)| noting(bytes, entry, camera)).collect();
    contestants.push(floor_frames(floor));
    let task = format!("{table}: frames");
    let facts = headless.device().facts().clone();
    let (frames, clocks) = (stage.arguments.frames, &mut stage.clocks_mhz);
    let timed = turns::take(headless, contestants, frames, &task, &stage.bars, &mut || {
        clocks.extend(clock_mhz(&facts));
    });
    let mut entries: Vec<Timed> = timed.into_iter().collect::<Result<_>>()?;
    let Some(floor) = entries.pop() else { return Err(Error::option("bench", "nothing was measured")) };
    let transient_bytes = bytes.iter().map(Cell::get).collect();
    let contest = Contest { names, entries, floor, transient_bytes };
    flag(stage, table, &contest);
    Ok(contest)
}

/// The frames of an entry, each of which notes the bytes of its transients.
pub fn noting<'a>(bytes: &'a Cell<u64>, entry: Entry<'a>, camera: &'a Camera) -> Draw<'a> {
    let mut draw = turns::frames(entry.scene, camera, entry.settings);
    Box::new(move |headless, profile| {
        let drawn = draw(headless, profile)?;
        bytes.set(headless.transient_bytes());
        Ok(drawn)
    })
}

fn flag(stage: &mut Stage<'_>, table: &str, contest: &Contest) {
    let entries = contest.entries();
    let frames: Vec<Vec<f64>> = entries.iter().chain([&contest.floor()]).map(Measured::frame_ms).collect();
    stage.flags.extend(drift_flag(table, &frames, &stage.limits));
    for entry in &entries {
        let what = format!("{table}, {}", entry.name);
        let times = entry.times();
        stage.flags.extend(spread_flag(&what, times.frame_ms.as_ref(), &stage.limits));
        stage.flags.extend(times.flags.iter().map(|flag| format!("{what}: {flag}")));
    }
}
