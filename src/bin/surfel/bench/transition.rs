//! What the transition between splats and polygons costs (Guennebaud, Barthe, Paulin 2006, sections 5 and 7): one mesh, half of
//! it polygons, half of it splats, with each transition and none, in turn; beside it the whole as splats, and as polygons.

mod halves;

use surfel::{
    Result,
    instruments::Floor,
    renderer::Headless,
    report::{Drawn, TransitionReport},
    scene::{Ball, Camera, Scene, Settings, Transition},
};

use super::{
    Bench, Stage,
    contest::{self, Entry},
    model::Source,
};
use halves::Halves;

/// Splats of the whole, where nothing else is asked for; a half has as many as it has of the area.
const SPLATS: u64 = 40_000;

/// The transitions, the one that all are set beside first.
const TRANSITIONS: [Transition; 4] =
    [Transition::None, Transition::Color, Transition::Attributes, Transition::Paper];

/// Measures them.
///
/// # Errors
/// A model that is no mesh, or has no two halves; whatever goes wrong.
pub fn measure(headless: &mut Headless, stage: &mut Stage<'_>) -> Result<TransitionReport> {
    let source = Source::open(stage)?;
    let splats = stage.arguments.splats_of(Bench::Transition).unwrap_or(SPLATS);
    let Halves { model, hybrid, splats, polygons, inputs } = halves::make(&source, splats, stage)?;
    let ball = hybrid.ball().unwrap_or(Ball { center: glam::DVec3::ZERO, radius: 1.0 });
    let camera = Camera::fit(&ball, stage.settings.size_px, Camera::DEFAULT_FOV_Y_RAD);
    headless.renderer.check(&camera, &stage.settings)?;
    let of_both = contest::prepare(headless, stage, &hybrid)?;
    let of_splats = contest::prepare(headless, stage, &splats)?;
    let of_polygons = contest::prepare(headless, stage, &polygons)?;
    let floor = Floor::new(headless, &of_splats, &camera, &stage.settings, false)?;
    let mut entries: Vec<Entry<'_>> = TRANSITIONS
        .iter()
        .map(|transition| Entry {
            name: transition.name().to_owned(),
            scene: &of_both,
            settings: Settings { transition: *transition, ..stage.settings.clone() },
        })
        .collect();
    let mut drawn: Vec<Drawn> = TRANSITIONS
        .iter()
        .map(|transition| Drawn { transition: *transition != TRANSITIONS[0], ..drawn_of(&hybrid) })
        .collect();
    for (name, prepared, scene) in
        [("all splats", &of_splats, &splats), ("all polygons", &of_polygons, &polygons)]
    {
        let settings = stage.settings.clone();
        entries.push(Entry { name: name.to_owned(), scene: prepared, settings });
        drawn.push(drawn_of(scene));
    }
    let contest = contest::take(headless, stage, "transition", &camera, entries, floor)?;
    let drawn: Vec<(Drawn, u64)> = drawn.into_iter().zip(contest.transient_bytes.iter().copied()).collect();
    stage.inputs.extend(inputs);
    Ok(TransitionReport::of(model, &contest.entries(), &drawn, &contest.floor()))
}

/// Of a scene without a transition.
fn drawn_of(scene: &Scene) -> Drawn {
    let triangles = scene.meshes.iter().map(|object| object.mesh.triangles.len() as u64).sum();
    Drawn { splats: scene.splat_count() as u64, triangles, transition: false }
}
