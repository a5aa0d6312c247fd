//! What transparent layers cost: the paper's figure 6 beside this device.

use surfel::{Result, report::LayersReport};

use super::{part::Part, session::Session};

/// Gathers the part.
///
/// # Errors
/// Whatever goes wrong.
pub fn gather(session: &mut Session<'_>) -> Result<Part> {
    Part::of_bench(session, "layers", |report| report.layers.as_ref().map_or_else(String::new, finding))
}

/// The paper's claim: half of the layers are drawn more than twice as fast, and with the rest blended faster still.
fn finding(report: &LayersReport) -> String {
    let said: Vec<String> = report
        .contestants
        .iter()
        .skip(1)
        .filter_map(|contestant| {
            let speed = 1.0 / contestant.contestant.beside_first?.median;
            let paper = report.paper_speed(contestant)?;
            Some(format!("{} {speed:.2} times as fast (the paper: {paper:.2})", contestant.contestant.name))
        })
        .collect();
    let Some(first) = report.contestants.first().filter(|_| !said.is_empty()) else {
        return "The device tells no times.".to_owned();
    };
    let layer = report.empty.as_ref().and_then(|empty| empty.passes.last()?.share);
    let empty = layer.map_or_else(String::new, |share| {
        format!(" A layer in which nothing is costs {:.2}% of a full one.", 100.0 * share.median)
    });
    format!("Layers beside {}: {}.{empty}", first.contestant.name, said.join(", "))
}
