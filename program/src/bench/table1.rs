//! Table 1 of Guennebaud, Barthe, Paulin 2006: perspective splatting and ray casting at several numbers of splats, in turn
//! with the floor under them.

use surfel::{
    Result,
    instruments::{Floor, counts_of},
    renderer::Headless,
    report::bench::{PaperMethod, Throughput, ThroughputRow},
    scene::{Camera, Rasterizer, Settings},
};

use super::{
    contest::{self, Entry},
    context::BenchContext,
    model::Source,
};
use crate::scene::Loaded;

/// A method: what it is called, which of the paper's it is, and how it is drawn.
pub type Method = (String, Option<PaperMethod>, Settings);

/// Measures all numbers of splats, one after the other.
pub fn measure(headless: &mut Headless, context: &mut BenchContext<'_>) -> Result<Vec<ThroughputRow>> {
    let source = Source::open(context)?;
    let method = |(rasterizer, paper): (Rasterizer, PaperMethod)| {
        let settings = Settings { rasterizer, ..context.settings.clone() };
        (format!("{}, {}", rasterizer.name(), settings.filter.name()), Some(paper), settings)
    };
    let methods =
        [(Rasterizer::Perspective, PaperMethod::Perspective), (Rasterizer::Raycast, PaperMethod::Raycast)]
            .map(method);
    let mut rows = Vec::new();
    for splats in context.arguments.splat_counts() {
        match row(headless, context, &source, splats, &methods) {
            Ok(row) => rows.push(row),
            // What was measured before is not lost: the rest is left out, and said so.
            Err(error) if !rows.is_empty() => {
                context.bars.clear();
                context.flags.push(format!("{splats} splats and further are left out: {error}"));
                break;
            }
            Err(error) => return Err(error),
        }
    }
    Ok(rows)
}

/// Measures methods in turn with the floor of the first.
pub fn row(
    headless: &mut Headless,
    context: &mut BenchContext<'_>,
    source: &Source,
    splats: u64,
    methods: &[Method],
) -> Result<ThroughputRow> {
    let Loaded { scene, ball, inputs, .. } = source.scene(splats, context)?;
    let camera = Camera::fit(&ball, context.settings.size_px, Camera::DEFAULT_FOV_Y_RAD);
    for (.., settings) in methods {
        headless.renderer.check(&camera, settings)?;
        settings.check_scene(&scene)?;
    }
    let prepared = context.prepare(headless, &scene)?;
    let closed = scene.objects.iter().all(|object| object.closed);
    drop(scene);
    let of_first = methods.first().map_or(&context.settings, |(.., settings)| settings);
    let floor = Floor::new(headless, &prepared, &camera, of_first, false)?;
    let entry = |(name, paper, settings): &Method| {
        let instructions = counts_of(settings, closed)?;
        let (name, settings) = (name.clone(), settings.clone());
        let subject = Throughput::new(*paper, splats, instructions);
        Ok(Entry { name, scene: &prepared, settings, subject })
    };
    let entries = methods.iter().map(entry).collect::<Result<_>>()?;
    let what = format!("{splats} splats");
    let (methods, floor) = contest::measure(headless, context, &what, &camera, entries, Some(floor))?;
    context.inputs.extend(inputs);
    Ok(ThroughputRow::of(splats, methods, &floor, prepared.bytes()))
}
