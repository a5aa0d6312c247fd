//! What the crate would believe of an E57 file, held against the file's size.

use e57::{PointCloud, RecordDataType};

use crate::{error::Result, load::Input};

/// Where the header has the length of its XML.
const XML_LENGTH_AT: usize = 32;

/// The longest XML: it is held in memory as a tree, of about 40 bytes for each 4 in the worst case.
const MOST_XML_BYTES: u64 = 16 << 20;

/// More fields than this no scanner makes, and each has a queue.
const MOST_FIELDS: usize = 1024;

/// Refuses an XML that is longer than the file, or too long.
pub(super) fn header(input: &Input<'_>) -> Result<()> {
    let length = input.bytes.get(XML_LENGTH_AT..).and_then(|rest| rest.first_chunk::<8>());
    let Some(length) = length.map(|length| u64::from_le_bytes(*length)) else {
        return Err(input.fault("header", "the file ends within it; expected 48 bytes"));
    };
    let most = MOST_XML_BYTES.min(input.bytes.len() as u64);
    match length <= most {
        true => Ok(()),
        false => Err(input.fault("header", format!("XML of {length} bytes; expected at most {most}"))),
    }
}

/// Refuses more points than the file has room for. Fields that have but one value take no bytes, so that any number
/// of points would fit if all were so.
pub(super) fn sizes(input: &Input<'_>, clouds: &[PointCloud]) -> Result<()> {
    let (mut points, mut bits) = (0_u64, 0_u64);
    for (i, cloud) in clouds.iter().enumerate() {
        let fields = cloud.prototype.len();
        if fields > MOST_FIELDS {
            return Err(
                input.fault(format!("scan {i}"), format!("{fields} fields; expected at most {MOST_FIELDS}"))
            );
        }
        let of_point: u64 = cloud.prototype.iter().map(|record| bit_size(&record.data_type)).sum();
        if of_point == 0 {
            return Err(input.fault(format!("scan {i}"), "points that take no bytes; expected coordinates"));
        }
        points = points.saturating_add(cloud.records);
        bits = bits.saturating_add(cloud.records.saturating_mul(of_point));
    }
    input.options.limits.check_points(input, points)?;
    let most = (input.bytes.len() as u64).saturating_mul(8);
    match bits <= most {
        true => Ok(()),
        false => {
            let (bytes, file) = (bits / 8, input.bytes.len());
            Err(input
                .fault("", format!("{points} points of {bytes} bytes together, but the file has {file}")))
        }
    }
}

/// Bits of a value in the file.
fn bit_size(kind: &RecordDataType) -> u64 {
    match *kind {
        RecordDataType::Single { .. } => 32,
        RecordDataType::Double { .. } => 64,
        RecordDataType::ScaledInteger { min, max, .. } | RecordDataType::Integer { min, max } => {
            let range = i128::from(max) - i128::from(min);
            range.checked_ilog2().map_or(0, |bits| u64::from(bits) + 1)
        }
    }
}
