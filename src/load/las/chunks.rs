//! The chunks of which a LAZ file is made, each decompressed by itself.

use std::{borrow::Cow, io::Cursor};

use laz::{
    DecompressionSelection, LazItemType, LazVlr,
    laszip::{ChunkTable, ChunkTableEntry},
};

use super::header::{Header, one_line};
use crate::{
    error::Result,
    load::{Input, foreign},
};

/// Records that are read at once.
pub(in crate::load) struct Chunk<'a> {
    /// As they are in the file.
    pub bytes: &'a [u8],
    /// How many points there are before it.
    pub first: u64,
    /// How many it has.
    pub points: usize,
    /// The first byte of the file behind it.
    pub end: usize,
}

/// Bytes before the chunks, which say where their table is.
const TABLE_OFFSET_BYTES: usize = ChunkTable::OFFSET_SIZE;

/// The chunks of a compressed file, which together have its points.
pub(super) fn compressed<'a>(input: &Input<'a>, header: &Header, laz: &LazVlr) -> Result<Vec<Chunk<'a>>> {
    let fault = |problem: String| input.fault("chunks", problem);
    let data = input.bytes.get(header.data..).unwrap_or_default();
    let size = header.record_bytes as u64;
    let limits = &input.options.limits;
    let (all, most) = (header.points.saturating_mul(size), limits.expanded(data.len(), limits.laz_expansion));
    if all > most {
        let problem = format!(
            "{} bytes are said to hold {} points; expected at most {}",
            data.len(),
            header.points,
            most / size
        );
        return Err(fault(problem));
    }
    check_count(data, input.bytes, header).map_err(fault)?;
    let mut cursor = Cursor::new(input.bytes);
    cursor.set_position(header.data as u64);
    let table = ChunkTable::read_from(&mut cursor, laz).map_err(|e| fault(one_line(e)))?;
    let mut at = header.data + TABLE_OFFSET_BYTES;
    let mut first = 0_u64;
    let mut chunks = Vec::new();
    for entry in table.as_ref() as &[ChunkTableEntry] {
        let left = header.points - first;
        // The table has the same number for all chunks of one size, also for the last, which may have fewer.
        let points = entry.point_count.min(left);
        let end = usize::try_from(entry.byte_count).ok().and_then(|bytes| at.checked_add(bytes));
        let bytes = end.and_then(|end| input.bytes.get(at..end));
        let Some((bytes, end)) = bytes.zip(end) else {
            return Err(fault(format!(
                "chunk {} has {} bytes, beyond the file's end",
                chunks.len(),
                entry.byte_count
            )));
        };
        if points > 0 {
            chunks.push(Chunk { bytes, first, points: points as usize, end });
        }
        (at, first) = (end, first + points);
    }
    match first == header.points {
        true => Ok(chunks),
        false => Err(fault(format!("{first} points in {} chunks; expected {}", chunks.len(), header.points))),
    }
}

/// Refuses a table of more chunks than the file has room for: each starts with a whole record.
fn check_count(data: &[u8], file: &[u8], header: &Header) -> Result<(), String> {
    let place = |bytes: &[u8]| bytes.first_chunk::<8>().map(|bytes| i64::from_le_bytes(*bytes));
    let start = header.data as i64;
    // Writers that can't go back leave the place at the end of the file.
    let at_end = || file.last_chunk::<8>().map(|bytes| i64::from_le_bytes(*bytes));
    let table = place(data).filter(|at| *at > start).or_else(at_end).filter(|at| *at > start);
    let table = table.and_then(|at| usize::try_from(at).ok()).and_then(|at| file.get(at..));
    let Some(count) = table.and_then(|table| table.get(4..)).and_then(|rest| rest.first_chunk::<4>()) else {
        return Err("no table of them within the file".to_owned());
    };
    let count = u64::from(u32::from_le_bytes(*count));
    let room = (data.len() / header.record_bytes) as u64;
    match count <= room {
        true => Ok(()),
        false => Err(format!("{count} of them in {} bytes; expected at most {room}", data.len())),
    }
}

impl Chunk<'_> {
    /// The records, decompressed if they have to be.
    pub fn records(&self, header: &Header) -> Result<Cow<'_, [u8]>, String> {
        let Some(laz) = &header.laz else { return Ok(Cow::Borrowed(self.bytes)) };
        check_layers(self.bytes, header.record_bytes, laz)?;
        let mut records = vec![0; self.points * header.record_bytes];
        let entry = ChunkTableEntry { point_count: self.points as u64, byte_count: self.bytes.len() as u64 };
        // Of one chunk: it stays on this thread. Its arithmetic decoder (laz 0.13) indexes tables by what damaged bytes tell.
        let decompress = || laz::par_decompress_selective(self.bytes, &mut records, laz, &[entry], wanted());
        match foreign::guarded(decompress) {
            Some(decompressed) => decompressed.map_err(one_line)?,
            None => return Err("its compressed bytes are damaged".to_owned()),
        }
        Ok(Cow::Owned(records))
    }
}

/// What is read of points; formats from 6 on have it in layers of their own, so that the others can be skipped.
fn wanted() -> DecompressionSelection {
    DecompressionSelection::xy_returns_channel()
        .decompress_z()
        .decompress_classification()
        .decompress_flags()
        .decompress_intensity()
        .decompress_rgb()
}

/// Refuses layers that are longer than their chunk: their sizes follow its first record and a number of points, and
/// the decompressor would take that much memory.
fn check_layers(chunk: &[u8], record_bytes: usize, laz: &LazVlr) -> Result<(), String> {
    let layers: usize = laz
        .items()
        .iter()
        .map(|item| match item.item_type() {
            LazItemType::Point14 => 9,
            LazItemType::RGB14 | LazItemType::WavePacket14 => 1,
            LazItemType::RGBNIR14 => 2,
            LazItemType::Byte14(bytes) => usize::from(bytes),
            _ => 0,
        })
        .sum();
    // Without the sizes, the decompressor meets the chunk's end.
    let rest = chunk.get(record_bytes + 4..).and_then(|rest| rest.split_at_checked(4 * layers));
    let Some((sizes, rest)) = rest else { return Ok(()) };
    let sizes = sizes.chunks_exact(4).map(|size| u32::from_le_bytes(size.try_into().unwrap_or_default()));
    let size: u64 = sizes.map(u64::from).sum();
    match size <= rest.len() as u64 {
        true => Ok(()),
        false => Err(format!("layers of {size} bytes; expected at most {}", rest.len())),
    }
}
