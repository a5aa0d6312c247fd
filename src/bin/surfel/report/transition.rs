//! What it costs that splats and polygons of one surface meet smoothly.

use surfel::{Result, report::TransitionReport};

use super::{part::Part, session::Session};

/// Gathers the part.
///
/// # Errors
/// Whatever goes wrong; a model that is no mesh.
pub fn gather(session: &mut Session<'_>) -> Result<Part> {
    Part::of_bench(session, "transition", |report| {
        report.transition.as_ref().map_or_else(String::new, finding)
    })
}

/// The paper's claim: none of them costs anything.
fn finding(report: &TransitionReport) -> String {
    let ratios: Vec<f64> = report.ratios().filter_map(|ratio| Some(ratio?.median)).collect();
    let ends = ratios.iter().copied().reduce(f64::min).zip(ratios.iter().copied().reduce(f64::max));
    match ends {
        Some((least, most)) => format!(
            "Frames with a smooth transition take {least:.3} to {most:.3} times as long as those without; the paper has them \
             equal."
        ),
        None => "The device tells no times.".to_owned(),
    }
}
