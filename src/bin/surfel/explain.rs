//! `--explain` in words.

use std::fmt::Write as _;

use surfel::renderer::{ExplainedChunk, Explanation};

/// The whole explanation.
pub fn text(explanation: &Explanation) -> String {
    let mut text = String::new();
    // Writing to a string can't fail.
    let _ = write(&mut text, explanation);
    text
}

fn write(text: &mut String, explanation: &Explanation) -> std::fmt::Result {
    let Explanation { chunks, passes, culled, pipelines, splat_bytes, .. } = explanation;
    writeln!(text, "splats: {} chunk(s), {splat_bytes} bytes", chunks.len())?;
    for (number, chunk) in chunks.iter().enumerate() {
        writeln!(text, "  chunk {number}: {}", words(chunk, explanation.point_cap_px))?;
    }
    writeln!(text, "passes: {}", passes.len())?;
    for pass in passes {
        let kind = format!("{:?}", pass.kind).to_lowercase();
        writeln!(text, "  {} ({kind}): {}", pass.name, pass.why)?;
        for usage in &pass.uses {
            writeln!(text, "    {}, {}: {:?}", usage.name, usage.what, usage.access)?;
        }
    }
    if !culled.is_empty() {
        writeln!(text, "passes left out, because nobody reads their results: {}", culled.join(", "))?;
    }
    writeln!(text, "pipelines: {}", pipelines.len())?;
    for pipeline in pipelines {
        writeln!(text, "  {pipeline}")?;
    }
    let (shared, apart) = (explanation.transient_bytes, explanation.unshared_bytes);
    let saved = apart.saturating_sub(shared);
    writeln!(text, "images and buffers of a frame: {shared} bytes; {saved} saved by sharing memory")
}

fn words(chunk: &ExplainedChunk, cap_px: f32) -> String {
    let kind = if chunk.ellipses { "ellipses" } else { "disks" };
    let color = if chunk.uniform_color { "one color for all" } else { "a color each" };
    let closed = if chunk.closed { "closed surface" } else { "open surface" };
    let size = match (chunk.may_be_large, chunk.largest_box_px) {
        (false, px) => {
            format!(
                "none above {px:.0} px, the device's points reach {cap_px} px: all drawn as points, no list"
            )
        }
        (true, px) if px.is_finite() => {
            format!(
                "some may reach {px:.0} px, the device's points {cap_px} px: large ones listed, drawn as quads"
            )
        }
        (true, _) => "some may reach the near plane: large ones listed, drawn as quads".to_owned(),
    };
    format!("{} {kind}, {color}, {closed}, {} bytes; {size}", chunk.splats, chunk.bytes)
}
