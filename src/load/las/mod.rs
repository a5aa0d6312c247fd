//! LAS files, and LAZ and COPC, which are compressed LAS.
//!
//! The crate `las` reads the header and takes records apart; `laz` decompresses chunks. What both would believe of a
//! file, such as the number of its chunks, is compared with the file's size before.

mod chunks;
mod columns;
mod coordinates;
mod header;
mod palette;
#[cfg(test)]
mod tests;

use glam::DVec3;
use rayon::prelude::*;

use super::{Input, Loaded, Model, geographic::Place};
use crate::{error::Result, notes::Deed, scene::Points};

pub(in crate::load) use chunks::Chunk;
pub(in crate::load) use columns::Columns;
#[cfg(feature = "octrees")]
pub(in crate::load) use columns::NOISE;
pub(in crate::load) use coordinates::Coordinates;
pub(in crate::load) use header::Header;
#[cfg(feature = "octrees")]
pub(in crate::load) use header::{coordinates, read as read_header};
pub(in crate::load) use palette::Palette;

/// How many points of an uncompressed file one thread reads at once.
const CHUNK_POINTS: usize = 1 << 16;

/// How many chunks are read between two steps of progress.
const BATCH: usize = 64;

pub(super) fn parse(input: &Input<'_>) -> Result<Loaded> {
    let header = header::read(input)?;
    input.options.limits.check_points(input, header.points)?;
    let chunks = match &header.laz {
        Some(laz) => chunks::compressed(input, &header, laz)?,
        None => uncompressed(input, &header)?,
    };
    let mut columns = Columns::default();
    for batch in chunks.chunks(BATCH) {
        let read: Vec<Result<Columns, String>> =
            batch.par_iter().map(|chunk| Columns::read(&header, &chunk.records(&header)?)).collect();
        for (chunk, read) in batch.iter().zip(read) {
            let place = || format!("points {} to {}", chunk.first, chunk.first + chunk.points as u64 - 1);
            columns.append(read.map_err(|problem| input.fault(place(), problem))?);
        }
        if let Some(last) = batch.last() {
            input.step(last.end.min(input.bytes.len()));
        }
    }
    let mut loaded = loaded(columns, None, &header.words);
    loaded.note(Deed::Ignored, behind(&header), "bytes behind the last point");
    match header.coordinates {
        Coordinates::Lengths(metres) => loaded.metres_per_unit = Some(metres),
        Coordinates::Degrees => flatten(&mut loaded),
        Coordinates::Unknown => {}
    }
    Ok(loaded)
}

/// How many bytes of records the header doesn't count.
fn behind(header: &Header) -> u64 {
    let points = usize::try_from(header.points).unwrap_or(usize::MAX).saturating_mul(header.record_bytes);
    if header.laz.is_some() {
        0
    } else {
        header.end.saturating_sub(header.data.saturating_add(points)) as u64
    }
}

/// Makes lengths of degrees.
fn flatten(loaded: &mut Loaded) {
    if let Model::Points(points) = &mut loaded.model
        && let Some(place) = Place::of(points)
    {
        place.flatten(points);
        let count = points.positions.len() as u64;
        place.tell(loaded, count);
    }
}

/// The records of a file that is not compressed.
fn uncompressed<'a>(input: &Input<'a>, header: &Header) -> Result<Vec<Chunk<'a>>> {
    let data = input.bytes.get(header.data..).unwrap_or_default();
    let records = usize::try_from(header.points)
        .ok()
        .and_then(|points| points.checked_mul(header.record_bytes))
        .and_then(|size| data.get(..size));
    let Some(records) = records else {
        let (points, size) = (header.points, header.record_bytes);
        let problem =
            format!("{} bytes follow the header; expected {points} points of {size} bytes", data.len());
        return Err(input.fault("", problem));
    };
    let pieces = records.chunks(CHUNK_POINTS * header.record_bytes).zip((0..).step_by(CHUNK_POINTS));
    let chunk = |(bytes, first): (&'a [u8], usize)| Chunk {
        bytes,
        first: first as u64,
        points: bytes.len() / header.record_bytes,
        end: header.data + first * header.record_bytes + bytes.len(),
    };
    Ok(pieces.map(chunk).collect())
}

/// What was read of a file whose format is called so; without a palette, it is that of all points.
pub(in crate::load) fn loaded(columns: Columns, palette: Option<Palette>, words: &str) -> Loaded {
    let palette = palette.unwrap_or_else(|| Palette::of(&columns));
    let (colors, of_colors, beyond) = palette.colors(&columns);
    let points = Points {
        positions: columns.positions,
        normals: None,
        radii: None,
        radii_in_doubt: false,
        colors,
        viewpoints: Vec::new(),
    };
    let mut loaded = Loaded::new(Model::Points(points), format!("{words}{of_colors}"));
    loaded.up = Some(DVec3::Z);
    loaded.note(Deed::Clamped, beyond, "points with an intensity beyond what is white");
    loaded.note(Deed::Dropped, columns.noise, "points of the classes for noise (7 and 18)");
    loaded.note(Deed::Dropped, columns.withheld, "points that are marked as withheld");
    loaded
}
