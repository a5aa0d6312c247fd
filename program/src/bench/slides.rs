//! The slides' table of Guennebaud, Barthe, Paulin 2006: five implementations of splat rasterization side by side, each as
//! its paper has it: rasterizer and filter.

use surfel::{
    Result,
    renderer::Headless,
    report::bench::{PaperMethod, SLIDES, ThroughputRow},
    scene::{Filter, Rasterizer, Settings},
};

use super::{context::BenchContext, model::Source, table1};

/// The number of splats: the paper's second.
const SPLATS: u64 = 460_000;

/// The methods of [`SLIDES`], in their order. "EWA Splatting" [ZPvG01] has the affine map and filter of [Guennebaud03], in
/// software there.
const METHODS: [(Rasterizer, Filter, Option<PaperMethod>); 5] = [
    (Rasterizer::Perspective, Filter::Adjust, Some(PaperMethod::Perspective)),
    (Rasterizer::AffineCenter, Filter::Ewa, None),
    (Rasterizer::AffineCenter, Filter::Adjust, None),
    (Rasterizer::AffineContour, Filter::Ewa, None),
    (Rasterizer::Raycast, Filter::Max, Some(PaperMethod::Raycast)),
];

/// Measures them.
pub fn measure(headless: &mut Headless, context: &mut BenchContext<'_>) -> Result<ThroughputRow> {
    let source = Source::open(context)?;
    let methods = METHODS.into_iter().zip(SLIDES).map(|((rasterizer, filter, paper), slide)| {
        let settings = Settings { rasterizer, filter, ..context.settings.clone() };
        (format!("{}, {} ({})", rasterizer.name(), filter.name(), slide.paper), paper, settings)
    });
    let methods: Vec<table1::Method> = methods.collect();
    let splats = context.arguments.splats.first().copied().unwrap_or(SPLATS);
    table1::row(headless, context, &source, splats, &methods)
}
