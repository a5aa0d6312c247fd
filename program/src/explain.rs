//! `--explain` in words.

use std::fmt::Write as _;

use surfel::{
    embed::MemoryHeap,
    notes::counted,
    renderer::{ExplainedChunk, ExplainedMesh, Explanation},
};

/// The whole explanation. `listed`: how many splats are drawn of levels of detail, where that was counted.
pub fn text(explanation: &Explanation, listed: Option<u64>) -> String {
    let mut text = String::new();
    // Writing to a string can't fail.
    let _ = write(&mut text, explanation, listed);
    text
}

/// How much memory the device has, and how much of it this process may have.
pub fn heaps(heaps: &[MemoryHeap]) -> String {
    let of = |heap: &MemoryHeap| {
        let own = if heap.is_local { ", the device's own" } else { "" };
        match heap.usage {
            Some(usage) => format!("{} bytes{own}, budget {} bytes, {usage} in use", heap.size, heap.budget),
            None => format!("{} bytes{own}, budget not told", heap.size),
        }
    };
    let lines = heaps.iter().enumerate().map(|(i, heap)| format!("memory, heap {i}: {}\n", of(heap)));
    lines.collect()
}

fn write(text: &mut String, explanation: &Explanation, listed: Option<u64>) -> std::fmt::Result {
    let Explanation { chunks, meshes, passes, culled, pipelines, .. } = explanation;
    let splat_bytes: u64 = chunks.iter().map(|chunk| chunk.bytes).sum();
    writeln!(text, "splats: {} chunk(s), {splat_bytes} bytes", chunks.len())?;
    for (number, chunk) in chunks.iter().enumerate() {
        writeln!(text, "  chunk {number}: {}", words(chunk, explanation.point_cap_px))?;
    }
    if !meshes.is_empty() {
        let bytes = explanation.scene_bytes - splat_bytes;
        writeln!(text, "polygons: {} mesh(es), {bytes} bytes", meshes.len())?;
    }
    for (number, mesh) in meshes.iter().enumerate() {
        writeln!(text, "  mesh {number}: {}", mesh_words(mesh))?;
    }
    for (kind, drawn) in ["opaque", "transparent"].iter().zip(&explanation.drawn) {
        if let Some(drawn) = drawn {
            writeln!(text, "{kind} splats are drawn {drawn}")?;
        }
    }
    if let Some(levels) = &explanation.levels {
        let listed = listed.map_or_else(String::new, |listed| format!("; {listed} splats are set up"));
        writeln!(text, "levels of detail: {levels}{listed}")?;
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
    for note in explanation.beyond_f32.iter().chain(&explanation.floors) {
        writeln!(text, "note: {note}")?;
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
    let kind = match (chunk.ellipses, chunk.packed) {
        (true, _) => "ellipses",
        (false, true) => "packed disks",
        (false, false) => "disks",
    };
    let fine = if chunk.fine { " with coordinates of two parts" } else { "" };
    let color = if chunk.uniform_color { "one color for all" } else { "a color each" };
    let closed = if chunk.closed { "closed surface" } else { "open surface" };
    let nodes = if chunk.stands_for_others { " that stand for others, or for polygons (--lod)" } else { "" };
    let size = match (chunk.may_be_large, chunk.largest_box_px) {
        (_, px) if chunk.by_tiles && px.is_finite() => format!("none above {px:.0} px"),
        (_, _) if chunk.by_tiles => "some may reach the near plane".to_owned(),
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
    let layers = if chunk.transparent { ", transparent: drawn in layers" } else { "" };
    let splats = counted(chunk.splats.into(), kind);
    format!("{splats}{nodes}{fine}, {color}, {closed}{layers}, {} bytes; {size}", chunk.bytes)
}

fn mesh_words(mesh: &ExplainedMesh) -> String {
    let closed = if mesh.closed { "closed surface" } else { "open surface" };
    let layers = if mesh.transparent { ", transparent: drawn in layers" } else { "" };
    let culled = if mesh.culled { "what faces away is not drawn" } else { "drawn from both sides" };
    let ExplainedMesh { triangles, vertices, bytes, .. } = mesh;
    let (triangles, vertices) =
        (counted((*triangles).into(), "triangles"), counted((*vertices).into(), "vertices"));
    format!("{triangles}, {vertices}, {closed}{layers}, {bytes} bytes; {culled}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heaps_have_a_line_each_with_the_budget_where_the_driver_tells_it() {
        let told = MemoryHeap { size: 1000, is_local: true, budget: 800, usage: Some(30) };
        let used_by_none = MemoryHeap { size: 500, is_local: false, budget: 400, usage: Some(0) };
        let not_told = MemoryHeap { size: 2000, is_local: false, budget: 2000, usage: None };
        assert_eq!(
            heaps(&[told, used_by_none, not_told]),
            "memory, heap 0: 1000 bytes, the device's own, budget 800 bytes, 30 in use\n\
             memory, heap 1: 500 bytes, budget 400 bytes, 0 in use\n\
             memory, heap 2: 2000 bytes, budget not told\n"
        );
        assert_eq!(heaps(&[]), "");
    }
}
