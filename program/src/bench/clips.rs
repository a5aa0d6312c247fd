//! What clip curves cost: tables 1 and 2 of Ivo et al. 2012, over numbers of splats and over how much of the image they cover. Splats that
//! nothing cuts, cut by lines and by curves, in turn.

use surfel::{
    Result,
    compose::finish,
    geometry::sharp::Clipping,
    renderer::Headless,
    report::bench::{Clipped, ClipsReport, ClipsRow, PAPER_OCCUPANCIES, PAPER_PARTS},
};

use super::{
    contest::{self, Entry},
    context::BenchContext,
};
use crate::part::{Part, camera_covering};

/// How splats are cut, the one that others are set beside first.
const WAYS: [(&str, Clipping); 3] =
    [("nothing cut", Clipping::None), ("lines", Clipping::Lines), ("curves", Clipping::Shared)];

/// How much of the image table 1 of the paper covers.
const OCCUPANCY: f64 = 0.4;

/// Splats of the paper's table 2.
const FEW: u64 = 2_500;

/// Over numbers of splats.
///
/// # Errors
/// A model that is no mesh, or has no edges to cut at; whatever goes wrong with the device.
pub fn over_splats(headless: &mut Headless, context: &mut BenchContext<'_>) -> Result<ClipsReport> {
    let part = Part::open(context.arguments.model.as_deref(), &context.bars)?;
    let counts = match context.arguments.splats.as_slice() {
        [] => vec![Some(FEW), Some(5_000), None],
        given => given.iter().copied().map(Some).collect(),
    };
    let rows = counts.into_iter().map(|count| row(headless, context, &part, count, OCCUPANCY));
    let mut rows = rows.collect::<Result<Vec<_>>>()?;
    for row in &mut rows {
        row.paper = PAPER_PARTS
            .into_iter()
            .find(|(splats, ..)| *splats == row.wanted)
            .map(|(_, fps, rate)| [fps, rate]);
    }
    Ok(ClipsReport { title: "i1".to_owned(), model: part.name, rows })
}

/// Over how much of the image is covered.
///
/// # Errors
/// As [`over_splats`].
pub fn over_occupancy(headless: &mut Headless, context: &mut BenchContext<'_>) -> Result<ClipsReport> {
    let part = Part::open(context.arguments.model.as_deref(), &context.bars)?;
    let splats = context.arguments.splats.first().copied().unwrap_or(FEW);
    let mut rows = Vec::new();
    for (percent, fps, rate) in PAPER_OCCUPANCIES {
        let mut row = row(headless, context, &part, Some(splats), 0.01 * percent)?;
        row.paper = (splats == FEW).then_some([fps, rate]);
        rows.push(row);
    }
    Ok(ClipsReport { title: "i2".to_owned(), model: part.name, rows })
}

/// One number of splats, every way.
fn row(
    headless: &mut Headless,
    context: &mut BenchContext<'_>,
    part: &Part,
    count: Option<u64>,
    share: f64,
) -> Result<ClipsRow> {
    let made = WAYS.map(|(name, clipping)| (name, part.splats(count, clipping, &context.bars)));
    let mut scenes = Vec::new();
    for (name, made) in made {
        let (scene, report) = made?;
        let prepared = context.prepare(headless, &scene)?;
        scenes.push((name, scene, report, prepared));
    }
    let (_, scene, _, prepared) = &scenes[0];
    let (camera, occupancy) = camera_covering(headless, (scene, prepared), &context.settings, share)?;
    headless.renderer.check(&camera, &context.settings)?;
    let splats = scene.splat_count() as u64;
    if context.inputs.is_empty() {
        context.inputs.push(finish(scene.objects[0].clone(), String::new(), None).1);
    }
    let entries = scenes.iter().map(|(name, _, report, prepared)| Entry {
        name: (*name).to_owned(),
        scene: prepared,
        settings: context.settings.clone(),
        subject: Clipped { clipped: report.clipped as u64 },
    });
    let what = format!("{splats} splats, {:.1}% of the image", 100.0 * occupancy);
    let entries = entries.collect();
    let (ways, _) = contest::measure(headless, context, &what, &camera, entries, None)?;
    Ok(ClipsRow { wanted: count.unwrap_or(u64::MAX), splats, occupancy, ways, paper: None })
}
