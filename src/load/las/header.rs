//! The header of a LAS file, held against the file.

use std::io;

use las::{Transform, Vector, point::Format, raw};
use laz::{LazItemRecordBuilder, LazVlr};

use super::coordinates::Coordinates;
use crate::{error::Result, load::Input};

/// What is needed of a header.
pub(in crate::load) struct Header {
    /// The version and format in words.
    pub words: String,
    /// How many points it says there are.
    pub points: u64,
    /// Bytes of a record, which hold its format.
    pub record_bytes: usize,
    /// The first byte behind it.
    pub data: usize,
    pub format: Format,
    pub transforms: Vector<Transform>,
    /// How the records are compressed.
    pub laz: Option<LazVlr>,
    pub coordinates: Coordinates,
    /// The first byte behind the points that has another use, or of the end.
    pub end: usize,
}

/// What a header has at least.
const FEWEST_BYTES: &str = "expected at least 227, 375 of version 1.4";

/// The part of a variable length record before its data.
const VLR_HEADER_BYTES: usize = 54;

pub(in crate::load) fn read(input: &Input<'_>) -> Result<Header> {
    let raw = raw::Header::read_from(input.bytes).map_err(|e| match e {
        las::Error::Io(e) if e.kind() == io::ErrorKind::UnexpectedEof => {
            let problem =
                format!("the file ends within it, after {} bytes; {FEWEST_BYTES}", input.bytes.len());
            input.fault("header", problem)
        }
        e => input.fault("header", one_line(e)),
    })?;
    let number = raw.point_data_record_format & 0x3f;
    let mut format =
        Format::new(raw.point_data_record_format).map_err(|e| input.fault("header", one_line(e)))?;
    let record_bytes = raw.point_data_record_length;
    let Some(extra) = record_bytes.checked_sub(format.len()) else {
        let problem =
            format!("records of {record_bytes} bytes; expected {} for format {number}", format.len());
        return Err(input.fault("header", problem));
    };
    format.extra_bytes = extra;
    let legacy = u64::from(raw.number_of_point_records);
    let points = raw.large_file.map_or(legacy, |file| match legacy {
        // Readers of older versions, and so this field, come first where both are set.
        0 => file.number_of_point_records,
        legacy => legacy,
    });
    if points == 0 {
        return Err(input.fault("header", "0 points; expected at least one"));
    }
    let scales = [raw.x_scale_factor, raw.y_scale_factor, raw.z_scale_factor];
    let offsets = [raw.x_offset, raw.y_offset, raw.z_offset];
    if let Some(scale) = scales.iter().find(|scale| !scale.is_normal()) {
        return Err(input.fault("header", format!("a scale of {scale}; expected a number other than 0")));
    }
    if let Some(offset) = offsets.iter().find(|offset| !offset.is_finite()) {
        return Err(input.fault("header", format!("an offset of {offset}; expected a finite number")));
    }
    let data = raw.offset_to_point_data as usize;
    if data > input.bytes.len() || data < usize::from(raw.header_size) {
        let problem = format!(
            "points from byte {data} of {}, behind a header of {}",
            input.bytes.len(),
            raw.header_size
        );
        return Err(input.fault("header", problem));
    }
    let records = variable_records(input.bytes.get(usize::from(raw.header_size)..data).unwrap_or_default());
    let coordinates = records.iter().fold(Coordinates::Unknown, Coordinates::or);
    let is_copc = records.iter().any(|record| record.user_id.starts_with(b"copc\0") && record.record_id == 1);
    let laz = format.is_compressed.then(|| laz_record(input, &records, number, extra)).transpose()?;
    let name = match (&laz, is_copc) {
        (Some(_), true) => "COPC, LAZ",
        (Some(_), false) => "LAZ",
        (None, _) => "LAS",
    };
    let [x, y, z] = [0, 1, 2].map(|i: usize| Transform {
        scale: scales.get(i).copied().unwrap_or(1.0),
        offset: offsets.get(i).copied().unwrap_or(0.0),
    });
    Ok(Header {
        words: format!("{name} {}.{}, format {number}", raw.version.major, raw.version.minor),
        points,
        record_bytes: usize::from(record_bytes),
        data,
        format,
        transforms: Vector { x, y, z },
        laz,
        coordinates,
        end: end(&raw, input.bytes.len()),
    })
}

/// What the records say of the coordinates that are within the first bytes of a file.
#[cfg(feature = "octrees")]
pub(in crate::load) fn coordinates(head: &[u8]) -> Coordinates {
    let size = head.get(94..96).and_then(|size| size.try_into().ok()).map_or(0, u16::from_le_bytes);
    let data = head.get(96..100).and_then(|data| data.try_into().ok()).map_or(0, u32::from_le_bytes);
    let end = head.len().min(data as usize);
    let records = variable_records(head.get(usize::from(size)..end).unwrap_or_default());
    records.iter().fold(Coordinates::Unknown, Coordinates::or)
}

/// The first byte that waves or extended records have.
fn end(raw: &raw::Header, file_bytes: usize) -> usize {
    let extended = raw.evlr.filter(|evlr| evlr.number_of_evlrs > 0).map(|evlr| evlr.start_of_first_evlr);
    let waves = raw.start_of_waveform_data_packet_record.filter(|start| *start > 0);
    let first = extended.into_iter().chain(waves).min();
    first.and_then(|first| usize::try_from(first).ok()).unwrap_or(file_bytes).min(file_bytes)
}

/// The variable length records; one that is cut is the last.
fn variable_records(mut rest: &[u8]) -> Vec<raw::Vlr> {
    let mut records = Vec::new();
    while rest.len() >= VLR_HEADER_BYTES
        && let Ok(record) = raw::Vlr::read_from(&mut rest, false)
    {
        records.push(record);
    }
    records
}

/// How the points are compressed.
fn laz_record(input: &Input<'_>, records: &[raw::Vlr], number: u8, extra: u16) -> Result<LazVlr> {
    let refuse = |problem: String| Err(input.fault("header", problem));
    let is_of_laz = |record: &&raw::Vlr| {
        record.user_id.starts_with(LazVlr::USER_ID.as_bytes()) && record.record_id == LazVlr::RECORD_ID
    };
    let Some(record) = records.iter().find(is_of_laz) else {
        return refuse("compressed, but without the record that says how".to_owned());
    };
    let laz = LazVlr::from_buffer(&record.data).map_err(|e| input.fault("header", one_line(e)))?;
    // The decompressor believes the record; sizes that don't fit would make it write beyond a point.
    let expected = LazItemRecordBuilder::default_for_point_format_id(number, extra)
        .map_err(|e| input.fault("header", one_line(e)))?;
    let same = laz.items().len() == expected.len()
        && laz
            .items()
            .iter()
            .zip(&expected)
            .all(|(a, b)| a.item_type() == b.item_type() && a.size() == b.size());
    match same {
        true => Ok(laz),
        false => refuse(format!("compressed as another format than {number} with {extra} extra bytes")),
    }
}

/// What a crate says, which may have line ends in it.
pub(super) fn one_line(error: impl std::fmt::Display) -> String {
    error.to_string().split_whitespace().collect::<Vec<_>>().join(" ")
}
