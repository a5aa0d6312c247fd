//! What the passes cost beside the least that the same pixels can cost.

use surfel::{Result, report::FloorReport};

use super::{
    part::{Block, Part},
    session::Session,
};

/// Gathers the part.
///
/// # Errors
/// Whatever goes wrong; a device without timestamps.
pub fn gather(session: &mut Session<'_>) -> Result<Part> {
    let mut part =
        Part::of_bench(session, "floor", |report| report.floor.as_ref().map_or_else(String::new, finding))?;
    let text = "The floor draws the same points through the same fixed-function stages into the same formats with nothing computed; \
         the strict floor leaves out what the passes cull. All three in turn, and in the same rounds what the device does at \
         most: of that, each pass's points, fragments and bytes take a time below which it can't get.";
    part.blocks.insert(0, Block::Text(text.to_owned()));
    Ok(part)
}

fn finding(report: &FloorReport) -> String {
    let ratio = report.rows.last().and_then(|frame| Some([frame.ratio?.median, frame.strict_ratio?.median]));
    match ratio {
        Some([floor, strict]) => format!(
            "A frame takes {floor:.2} times what the same points cost with nothing computed, {strict:.2} times the strict \
             floor: whatever is done to the shaders, no more than that can be gained."
        ),
        None => "The device tells no times.".to_owned(),
    }
}
