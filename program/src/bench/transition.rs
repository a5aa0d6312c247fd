//! The cost of the transition between splats and polygons (Guennebaud, Barthe, Paulin 2006, sections 5 and 7): one mesh, half of
//! it polygons, half of it splats, with each transition and none, in turn; beside it the whole as splats, and as polygons.

mod halves;

use surfel::{
    Result,
    instruments::Floor,
    renderer::Headless,
    report::bench::{HalfAndHalf, Primitives, TransitionReport},
    scene::{Ball, Camera, Scene, Settings, Transition},
};

use super::{
    arguments::Bench,
    contest::{self, Entry},
    context::BenchContext,
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
pub fn measure(headless: &mut Headless, context: &mut BenchContext<'_>) -> Result<TransitionReport> {
    let source = Source::open(context)?;
    let splats = context.arguments.splats_of(Bench::Transition).unwrap_or(SPLATS);
    let Halves { model, hybrid, splats, polygons, inputs } = halves::make(&source, splats, &context.bars)?;
    let ball = hybrid.ball().unwrap_or(Ball { center: glam::DVec3::ZERO, radius: 1.0 });
    let camera = Camera::fit(&ball, context.settings.size_px, Camera::DEFAULT_FOV_Y_RAD);
    headless.renderer.check(&camera, &context.settings)?;
    let of_both = context.prepare(headless, &hybrid)?;
    let of_splats = context.prepare(headless, &splats)?;
    let of_polygons = context.prepare(headless, &polygons)?;
    let floor = Floor::new(headless, &of_splats, &camera, &context.settings, false)?;
    let entry = |name: &str, prepared, scene, transition| Entry {
        name: name.to_owned(),
        scene: prepared,
        settings: Settings { transition, ..context.settings.clone() },
        subject: drawn(scene, transition),
    };
    let with = |transition: Transition| entry(transition.name(), &of_both, &hybrid, transition);
    let mut entries: Vec<Entry<'_, HalfAndHalf>> = TRANSITIONS.into_iter().map(with).collect();
    let none = context.settings.transition;
    entries.push(entry("all splats", &of_splats, &splats, none));
    entries.push(entry("all polygons", &of_polygons, &polygons, none));
    let (contestants, floor) =
        contest::measure(headless, context, "transition", &camera, entries, Some(floor))?;
    context.inputs.extend(inputs);
    Ok(TransitionReport { model, contestants, floor: floor.times() })
}

fn drawn(scene: &Scene, transition: Transition) -> HalfAndHalf {
    let triangles = scene.meshes.iter().map(|object| object.mesh.triangles.len() as u64).sum();
    let splats = scene.splat_count() as u64;
    let transition = splats > 0 && triangles > 0 && transition != Transition::None;
    HalfAndHalf { drawn: Primitives { splats, triangles, transition } }
}
