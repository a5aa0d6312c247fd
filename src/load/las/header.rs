//! The header of a LAS file, held against the file.

use std::io;

use las::{Transform, Vector, point::Format, raw};
use laz::{LazItemRecordBuilder, LazVlr};

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
    let records = input.bytes.get(usize::from(raw.header_size)..data).unwrap_or_default();
    let (laz, is_copc) = match format.is_compressed {
        true => laz_record(input, records, number, extra).map(|(laz, is_copc)| (Some(laz), is_copc))?,
        false => (None, false),
    };
    let name = match (&laz, is_copc) {
        (_, true) => "COPC, LAZ",
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
    })
}

/// How the points are compressed, and whether they form an octree, which is not needed here.
fn laz_record(input: &Input<'_>, records: &[u8], number: u8, extra: u16) -> Result<(LazVlr, bool)> {
    let refuse = |problem: String| Err(input.fault("header", problem));
    let (mut found, mut is_copc) = (None, false);
    let mut rest = records;
    while rest.len() >= VLR_HEADER_BYTES {
        // One that is cut ends what can be looked for.
        let Ok(record) = raw::Vlr::read_from(&mut rest, false) else { break };
        is_copc |= record.user_id.starts_with(b"copc\0") && record.record_id == 1;
        if record.user_id.starts_with(LazVlr::USER_ID.as_bytes()) && record.record_id == LazVlr::RECORD_ID {
            found = found.or(Some(record));
        }
    }
    let Some(record) = found else {
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
        true => Ok((laz, is_copc)),
        false => refuse(format!("compressed as another format than {number} with {extra} extra bytes")),
    }
}

/// What a crate says, which may have line ends in it.
pub(super) fn one_line(error: impl std::fmt::Display) -> String {
    error.to_string().split_whitespace().collect::<Vec<_>>().join(" ")
}
