//! `surfel bench p2`: frames by levels of detail over tolerances (Pajarola, Sainz, Guidotti 2003, table 2).

use surfel::{
    Error, Result,
    renderer::{Headless, Wanted},
    report::bench::{LevelError, Tolerance, TolerancesReport},
    scene::{Camera, Lod, OptionValue as _, Rasterizer, Settings},
};

use super::{
    contest::{self, Entry},
    context::BenchContext,
    model::Source,
};
use crate::{scene::Loaded, settings::once};

/// The number of splats where none is given.
const SPLATS: u64 = 1_000_000;

/// The splats themselves, and the paper's two beside those of the default.
const TOLERANCES: [Lod; 6] =
    [Lod::Px(0.0), Lod::Px(1.0), Lod::Px(2.0), Lod::Percent(0.001), Lod::Percent(0.01), Lod::Percent(0.12)];

/// Measures them, all on one model with levels of detail.
///
/// # Errors
/// A model that is no mesh; more splats than there is memory for.
pub fn measure(headless: &mut Headless, context: &mut BenchContext<'_>) -> Result<TolerancesReport> {
    let source = Source::open(context)?;
    let splats = context.arguments.splats.first().copied().unwrap_or(SPLATS);
    let Loaded { mut scene, ball, inputs, .. } = source.scene(splats, context)?;
    let object = scene.objects.first().ok_or_else(|| Error::input("model", "", "has no splat"))?;
    let (model, splats) = (object.name.clone(), scene.splat_count() as u64);
    scene.levels = true;
    let prepared = context.prepare(headless, &scene)?;
    drop(scene);
    context.inputs.extend(inputs);
    let settings = |lod| Settings { lod, rasterizer: Rasterizer::default(), ..context.settings.clone() };
    let camera = Camera::fit(&ball, context.settings.size_px, Camera::DEFAULT_FOV_Y_RAD);
    let picture = |headless: &mut Headless, settings: Settings| {
        let wanted = Wanted { picture: true, linear: true, ..Wanted::default() };
        let settings = Settings { background: None, ..settings };
        headless.render(&prepared, &camera, &settings, wanted).map(|frame| frame.linear)
    };
    let whole = picture(headless, settings(Lod::Px(0.0)))?;
    let mut entries = Vec::new();
    for settings in once(&context.arguments.tolerances, &TOLERANCES).into_iter().map(settings) {
        headless.renderer.check(&camera, &settings)?;
        let drawn = match headless.count_listed(&prepared, &camera, &settings)? {
            0 => splats,
            listed => listed,
        };
        let own = picture(headless, settings.clone())?;
        let error = LevelError::of(&own, &whole, settings.size_px[0] as usize);
        let subject = Tolerance { tau_px: settings.tau_px(), drawn, error };
        entries.push(Entry { name: settings.lod.word(), scene: &prepared, settings, subject });
    }
    let (rows, _) = contest::measure(headless, context, "p2", &camera, entries, None)?;
    Ok(TolerancesReport { model, splats, rows })
}
