//! LAS files, and LAZ and COPC, which are compressed LAS.
//!
//! The crate `las` reads the header and takes records apart; `laz` decompresses chunks. What both would believe of a
//! file, such as the number of its chunks, is compared with the file's size before.

mod chunks;
mod columns;
mod header;
#[cfg(test)]
mod tests;

use glam::DVec3;
use rayon::prelude::*;

use super::{Input, Loaded, Model, shade};
use crate::{
    error::Result,
    math::srgb::linear_from_srgb,
    notes::Deed,
    scene::{Colors, Points},
};
use chunks::Chunk;
use columns::Columns;
use header::Header;

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
    Ok(loaded(columns, &header))
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

fn loaded(columns: Columns, header: &Header) -> Loaded {
    let (colors, words) = colors(&columns);
    let points =
        Points { positions: columns.positions, normals: None, radii: None, colors, viewpoints: Vec::new() };
    let mut loaded = Loaded::new(Model::Points(points), format!("{}{words}", header.words));
    loaded.up = Some(DVec3::Z);
    loaded.note(Deed::Dropped, columns.noise, "points of the classes for noise (7 and 18)");
    loaded.note(Deed::Dropped, columns.withheld, "points that are marked as withheld");
    loaded
}

/// Colors where there are any, or else intensities as grays.
fn colors(columns: &Columns) -> (Colors, &'static str) {
    // Writers that have no colors leave them 0, or the intensities.
    let largest = columns.colors.par_iter().map(|color| color.iter().copied().max().unwrap_or(0)).max();
    let intensities = || columns.intensities.par_iter().copied().max().unwrap_or(0);
    match (largest.unwrap_or(0), intensities) {
        (0, intensities) if intensities() == 0 => (Colors::unknown(), ""),
        (0, _) => {
            let intensities: Vec<f32> =
                columns.intensities.par_iter().map(|value| f32::from(*value)).collect();
            (Colors::Each(shade::gray(&intensities)), ", intensity as gray")
        }
        // The format wants 16 bits; many writers copy 8 into them.
        (1..=255, _) => {
            let table = shade::Table::new();
            let linear = |value: u16| table.of(value as u8);
            (each(&columns.colors, linear), ", 8-bit colors")
        }
        _ => {
            let table: Vec<f32> = (0..=u16::MAX).map(|v| linear_from_srgb(f32::from(v) / 65535.0)).collect();
            let linear = |value: u16| table.get(usize::from(value)).copied().unwrap_or(1.0);
            (each(&columns.colors, linear), ", 16-bit colors")
        }
    }
}

fn each(colors: &[[u16; 3]], linear: impl Fn(u16) -> f32 + Sync) -> Colors {
    Colors::Each(colors.par_iter().map(|&[r, g, b]| [linear(r), linear(g), linear(b), 1.0]).collect())
}
