//! The slides' table of Guennebaud, Barthe, Paulin 2006: five implementations of splat rasterization side by side, each as
//! its paper has it: rasterizer and filter.

use surfel::{
    Result,
    renderer::Headless,
    report::{PaperMethod, ThroughputRow},
    scene::{Filter, Rasterizer, Settings},
};

use super::{Stage, model::Source, table1};

/// The number of splats: the paper's second.
const SPLATS: u64 = 460_000;

/// The slides' methods: rasterizer, filter, the paper they are of. "EWA Splatting" [ZPvG01] has the affine map and filter of
/// [Guennebaud03], in software there.
pub const METHODS: [(Rasterizer, Filter, &str); 5] = [
    (Rasterizer::Perspective, Filter::Adjust, "PBG06"),
    (Rasterizer::AffineCenter, Filter::Ewa, "ZPvG01"),
    (Rasterizer::AffineCenter, Filter::Adjust, "Guennebaud03"),
    (Rasterizer::AffineContour, Filter::Ewa, "ZRB04"),
    (Rasterizer::Raycast, Filter::Max, "BHZK05"),
];

/// Measures them.
///
/// # Errors
/// Whatever goes wrong.
pub fn measure(headless: &mut Headless, stage: &mut Stage<'_>) -> Result<ThroughputRow> {
    let source = Source::open(stage)?;
    let method = |(rasterizer, filter, paper): (Rasterizer, Filter, &str)| {
        let settings = Settings { rasterizer, filter, ..stage.settings.clone() };
        let name = format!("{}, {} ({paper})", rasterizer.name(), filter.name());
        let paper = match paper {
            "PBG06" => Some(PaperMethod::Perspective),
            "BHZK05" => Some(PaperMethod::Raycast),
            _ => None,
        };
        table1::Contestant { name, paper, settings }
    };
    let splats = stage.arguments.splats.first().copied().unwrap_or(SPLATS);
    table1::row(headless, stage, &source, splats, &METHODS.map(method))
}
