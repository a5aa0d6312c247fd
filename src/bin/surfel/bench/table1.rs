//! Table 1 of Guennebaud, Barthe, Paulin 2006: perspective splatting and ray casting at several numbers of splats, in turn
//! with the floor under them.

use surfel::{
    Result,
    graph::execute::Profile,
    instruments::{Floor, counts_of},
    renderer::Headless,
    report::{Measured, PaperMethod, ThroughputRow, drift_flag, spread_flag},
    scene::{Camera, Rasterizer, Settings},
};

use super::{Stage, model::Source};
use crate::{
    machine::clock_mhz,
    scene::Loaded,
    turns::{self, Draw, Drawn},
};

/// A method.
pub struct Contestant {
    /// What it is called; unique in its table.
    pub name: String,
    /// Which of the paper's it is.
    pub paper: Option<PaperMethod>,
    /// How it is drawn.
    pub settings: Settings,
}

/// Measures all numbers of splats, one after the other.
///
/// # Errors
/// Whatever goes wrong.
pub fn measure(headless: &mut Headless, stage: &mut Stage<'_>) -> Result<Vec<ThroughputRow>> {
    let source = Source::open(stage)?;
    let method = |(rasterizer, paper): (Rasterizer, PaperMethod)| {
        let settings = Settings { rasterizer, ..stage.settings.clone() };
        let name = format!("{}, {}", rasterizer.name(), settings.filter.name());
        Contestant { name, paper: Some(paper), settings }
    };
    let methods =
        [(Rasterizer::Perspective, PaperMethod::Perspective), (Rasterizer::Raycast, PaperMethod::Raycast)]
            .map(method);
    let mut rows = Vec::new();
    for splats in stage.arguments.splat_counts() {
        match row(headless, stage, &source, splats, &methods) {
            Ok(row) => rows.push(row),
            // What was measured before is not lost: the rest is left out, and said so.
            Err(error) if !rows.is_empty() => {
                stage.bars.clear();
                stage.flags.push(format!("{splats} splats and further are left out: {error}"));
                break;
            }
            Err(error) => return Err(error),
        }
    }
    Ok(rows)
}

/// Measures methods in turn with the floor of the first.
///
/// # Errors
/// Whatever goes wrong.
pub fn row(
    headless: &mut Headless,
    stage: &mut Stage<'_>,
    source: &Source,
    splats: u64,
    methods: &[Contestant],
) -> Result<ThroughputRow> {
    let Loaded { scene, ball, inputs, .. } = source.scene(splats, stage)?;
    let camera = Camera::fit(&ball, stage.settings.size_px, Camera::DEFAULT_FOV_Y_RAD);
    for method in methods {
        headless.renderer.check(&camera, &method.settings)?;
        method.settings.check_scene(&scene)?;
    }
    let prepared = headless
        .prepare(&scene, &|done, total| surfel::Progress::step(&stage.bars, "upload", done, total))?;
    let closed = scene.objects.iter().all(|object| object.closed);
    drop(scene);
    let floor_settings = methods.first().map_or(&stage.settings, |method| &method.settings);
    let floor = Floor::new(headless, &prepared, &camera, floor_settings, false)?;
    let mut contestants: Vec<Draw<'_>> =
        methods.iter().map(|method| turns::frames(&prepared, &camera, method.settings.clone())).collect();
    contestants.push(floor_frames(floor));
    let task = format!("{splats} splats: frames");
    let facts = headless.device().facts().clone();
    let (frames, clocks) = (stage.arguments.frames, &mut stage.clocks_mhz);
    let timed = turns::take(headless, contestants, frames, &task, &stage.bars, &mut || {
        clocks.extend(clock_mhz(&facts));
    });
    let timed: Vec<turns::Timed> = timed.into_iter().collect::<Result<_>>()?;

    let instructions: Vec<_> =
        methods.iter().map(|method| counts_of(&method.settings, closed)).collect::<Result<_>>()?;
    let names = methods.iter().map(|method| (method.name.as_str(), method.paper)).chain([("floor", None)]);
    let instructions = instructions.iter().map(Vec::as_slice).chain([&[][..]]);
    let measured: Vec<Measured<'_>> = names
        .zip(&timed)
        .zip(instructions)
        .map(|(((name, paper), timed), instructions)| Measured {
            name,
            paper,
            passes: &timed.names,
            rounds: &timed.rounds,
            counts: &timed.counts,
            instructions,
        })
        .collect();
    let Some((floor, methods)) = measured.split_last() else {
        return Err(surfel::Error::option("bench", "nothing was measured"));
    };
    let row = ThroughputRow::of(splats, methods, floor, [prepared.bytes(), headless.transient_bytes()]);
    let frames: Vec<Vec<f64>> = measured.iter().map(Measured::frame_ms).collect();
    stage.flags.extend(drift_flag(&format!("{splats} splats"), &frames, &stage.limits));
    for method in &row.methods {
        let what = format!("{splats} splats, {}", method.name);
        stage.flags.extend(spread_flag(&what, method.frames.frame_ms.as_ref(), &stage.limits));
        stage.flags.extend(method.frames.flags.iter().map(|flag| format!("{what}: {flag}")));
    }
    stage.inputs.extend(inputs);
    Ok(row)
}

/// The floor's frames.
pub fn floor_frames(mut floor: Floor<'_>) -> Draw<'_> {
    Box::new(move |headless: &mut Headless, profile: Profile| {
        let begun = std::time::Instant::now();
        let profile = floor.frame(headless, profile)?;
        // What the host does for it is not told apart from the wait.
        Ok(Drawn { profile, wall_secs: begun.elapsed().as_secs_f64(), record_secs: f64::NAN })
    })
}
