//! STL files: triangles, binary or text. Corners at exactly the same place become one vertex.
//!
//! The normals of facets are not read: they follow from the corners. Binary files that start with `solid`, as some
//! writers make them, are told from text by their size, and by the zeros in their numbers.

#[cfg(test)]
mod tests;
mod text;
mod weld;

use glam::DVec3;

use super::{Input, Loaded, Model};
use crate::{
    error::Result,
    math::srgb::linear_from_srgb,
    notes::Deed,
    scene::{Colors, Mesh},
};

/// Bytes before the number of triangles, which some writers fill with text.
const HEADER_BYTES: usize = 80;

/// A normal, three corners and two bytes that have no one meaning.
const RECORD_BYTES: usize = 50;

pub(super) fn parse(input: &Input<'_>) -> Result<Loaded> {
    let is_text = is_text(input.bytes);
    match records(input).filter(|records| !is_text || records.behind == 0) {
        Some(records) => binary(input, &records),
        None if !is_text => {
            let count = input.bytes.get(HEADER_BYTES..).and_then(|rest| rest.first_chunk::<4>());
            let found = match count.map(|count| u32::from_le_bytes(*count)) {
                Some(count) => {
                    format!("{count} triangles are said to be here, but the file ends before them")
                }
                None => "the file ends within its header".to_owned(),
            };
            Err(input.fault(
                "",
                format!("{found}; expected 84 bytes and 50 a triangle, or text that starts with solid"),
            ))
        }
        None => {
            let corners = text::corners(input)?;
            Ok(loaded(corners, "STL, text"))
        }
    }
}

/// How many bytes are looked at.
const PROBE_BYTES: usize = 4096;

/// Whether this is text that starts with `solid`.
pub(in crate::load) fn is_text(bytes: &[u8]) -> bool {
    let probe = bytes.get(..PROBE_BYTES).unwrap_or(bytes);
    let start = probe.trim_ascii_start().first_chunk::<5>();
    start.is_some_and(|word| word.eq_ignore_ascii_case(b"solid")) && !probe.contains(&0)
}

/// The triangles of a binary file.
struct Records<'a> {
    bytes: &'a [u8],
    /// How many bytes stand behind them.
    behind: usize,
}

/// `None` where the file has fewer than it says.
fn records<'a>(input: &Input<'a>) -> Option<Records<'a>> {
    let (count, rest) = input.bytes.get(HEADER_BYTES..)?.split_first_chunk::<4>()?;
    let size = usize::try_from(u32::from_le_bytes(*count)).ok()?.checked_mul(RECORD_BYTES)?;
    let (bytes, behind) = rest.split_at_checked(size)?;
    Some(Records { bytes, behind: behind.len() })
}

fn binary(input: &Input<'_>, records: &Records<'_>) -> Result<Loaded> {
    let count = (records.bytes.len() / RECORD_BYTES) as u64;
    input.options.limits.check_points(input, 3 * count)?;
    let mut corners = Vec::with_capacity(records.bytes.len() / RECORD_BYTES * 3);
    let mut attributes = 0;
    for record in records.bytes.chunks_exact(RECORD_BYTES) {
        let numbers = record.chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap_or_default()));
        let mut numbers = numbers.skip(3);
        let mut next = || numbers.next().unwrap_or_default();
        for _ in 0..3 {
            corners.push([next(), next(), next()]);
        }
        attributes += u64::from(!record.ends_with(&[0, 0]));
    }
    input.step(input.bytes.len());
    let mut loaded = loaded(corners, "STL, binary");
    if let (Some(color), Model::Mesh(mesh)) = (color_of_all(input.bytes), &mut loaded.model) {
        mesh.colors = Colors::Uniform(color);
        loaded.format += ", its header's color";
    }
    loaded.note(Deed::Ignored, attributes, "attributes of triangles, which may be colors,");
    loaded.note(Deed::Ignored, records.behind as u64, "bytes behind the last triangle");
    Ok(loaded)
}

/// The linear color that some programs (Materialise Magics) write for all triangles: red, green, blue and alpha behind a word of the header. An alpha of 0
/// is that of those that write none.
fn color_of_all(bytes: &[u8]) -> Option<[f32; 4]> {
    let header = bytes.get(..HEADER_BYTES)?;
    let at = header.windows(COLOR_WORD.len()).position(|word| word == COLOR_WORD)?;
    let [rgb @ .., alpha] = header.get(at + COLOR_WORD.len()..)?.first_chunk::<4>()?;
    let [r, g, b] = rgb.map(|byte| linear_from_srgb(f32::from(byte) / 255.0));
    Some([r, g, b, if *alpha == 0 { 1.0 } else { f32::from(*alpha) / 255.0 }])
}

const COLOR_WORD: &[u8] = b"COLOR=";

fn loaded(corners: Vec<[f32; 3]>, format: &str) -> Loaded {
    let welded = weld::weld(&corners);
    let mesh = Mesh {
        positions: welded.positions,
        normals: None,
        colors: Colors::unknown(),
        triangles: welded.triangles,
    };
    let mut loaded = Loaded::new(Model::Mesh(mesh), format);
    // As nearly all programs that write them have it.
    loaded.up = Some(DVec3::Z);
    loaded.note(Deed::Dropped, welded.degenerate, "triangles with two corners at one place");
    loaded
}
