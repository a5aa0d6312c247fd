//! The numbers of a PCD file's points, however they are kept.

use std::borrow::Cow;

use rayon::prelude::*;

use super::header::{Encoding, Field, Header, Kind};
use crate::{
    error::Result,
    load::{
        Input,
        lines::{Lines, shown},
        number,
    },
};

/// What is wanted of a point, each number where `wanted` has its field; the others are 0.
pub(super) type Point<const N: usize> = [f64; N];

/// How many lines are read at once.
const BATCH: usize = 1 << 16;

/// Gives the numbers of all points in turn. Fields that are `packed` come as the whole number that their bits are.
pub(super) fn each<const N: usize>(
    input: &Input<'_>,
    header: &Header,
    wanted: &[Option<&Field>; N],
    packed: usize,
    mut take: impl FnMut(&[Point<N>]),
) -> Result<()> {
    if header.encoding == Encoding::Ascii {
        return each_of_text(input, header, wanted, packed, take);
    }
    let (data, is_compressed) = match header.encoding {
        Encoding::Compressed => (Cow::Owned(unpack(input, header)?), true),
        _ => (Cow::Borrowed(input.bytes.get(header.end..).unwrap_or_default()), false),
    };
    let points = header.points;
    let size = points.checked_mul(header.record_bytes);
    if size.is_none_or(|size| size > data.len()) {
        let problem = format!(
            "{} bytes of points; expected {points} points of {} bytes",
            data.len(),
            header.record_bytes
        );
        return Err(input.fault("", problem));
    }
    let read = |i: usize| {
        let mut point = [0.0; N];
        for (slot, (value, field)) in point.iter_mut().zip(wanted).enumerate() {
            if let Some(field) = field {
                // Compressed points have all of one field, then all of the next.
                let at = match is_compressed {
                    true => field.offset * points + i * field.size * field.count,
                    false => i * header.record_bytes + field.offset,
                };
                let bytes = data.get(at..).and_then(|rest| rest.get(..field.size)).unwrap_or_default();
                *value = number(bytes, if slot == packed { Kind::Unsigned } else { field.kind });
            }
        }
        point
    };
    for start in (0..points).step_by(BATCH) {
        let batch: Vec<Point<N>> =
            (start..points.min(start.saturating_add(BATCH))).into_par_iter().map(read).collect();
        take(&batch);
        input.step(input.bytes.len() / points * start);
    }
    Ok(())
}

/// A number of one of the sizes that the header allows.
fn number(bytes: &[u8], kind: Kind) -> f64 {
    let mut wide = [0; 8];
    wide.iter_mut().zip(bytes).for_each(|(to, from)| *to = *from);
    let unsigned = u64::from_le_bytes(wide);
    let unused = 64 - 8 * bytes.len().clamp(1, 8) as u32;
    match (kind, bytes.len()) {
        (Kind::Float, 4) => f64::from(f32::from_bits(unsigned as u32)),
        (Kind::Float, _) => f64::from_bits(unsigned),
        (Kind::Unsigned, _) => unsigned as f64,
        (Kind::Signed, _) => ((unsigned << unused) as i64 >> unused) as f64,
    }
}

/// The points of `binary_compressed`.
fn unpack(input: &Input<'_>, header: &Header) -> Result<Vec<u8>> {
    let data = input.bytes.get(header.end..).unwrap_or_default();
    let sizes = data
        .split_first_chunk::<4>()
        .and_then(|(packed, rest)| Some((packed, rest.split_first_chunk::<4>()?)));
    let Some((packed, (size, data))) = sizes else {
        return Err(input.fault("", "the file ends before its compressed points"));
    };
    let [packed, size] = [packed, size].map(|bytes| u32::from_le_bytes(*bytes) as usize);
    let expected = header.points.checked_mul(header.record_bytes);
    let limits = &input.options.limits;
    let most = limits.expanded(data.len(), limits.expansion);
    let problem = match data.get(..packed) {
        _ if expected != Some(size) => {
            format!("{size} bytes of points; expected {} points of {}", header.points, header.record_bytes)
        }
        _ if size as u64 > most => {
            format!("{} compressed bytes are said to expand to {size}; expected at most {most}", data.len())
        }
        None => format!("{} compressed bytes; expected {packed}", data.len()),
        Some(_) if size == 0 => return Ok(Vec::new()),
        Some(packed) => match lzf::decompress(packed, size) {
            Ok(points) if points.len() == size => return Ok(points),
            Ok(points) => format!("compressed points of {} bytes; expected {size}", points.len()),
            Err(e) => format!("damaged compressed points: {e}"),
        },
    };
    Err(input.fault("", problem))
}

fn each_of_text<const N: usize>(
    input: &Input<'_>,
    header: &Header,
    wanted: &[Option<&Field>; N],
    packed: usize,
    mut take: impl FnMut(&[Point<N>]),
) -> Result<()> {
    let mut lines = Lines::new(input, Some(b'#'));
    lines.skip_to(header.end);
    // The shortest number is a digit and what ends it, which only the last may lack.
    let least = header.record_numbers.max(1).saturating_mul(2);
    if header.points > (lines.left() + 1) / least {
        let problem = format!("{} bytes of points; expected {} points", lines.left(), header.points);
        return Err(input.fault("", problem));
    }
    let mut left = header.points;
    while left > 0 {
        let batch: Vec<_> = (0..left.min(BATCH))
            .map(|i| lines.expect(&format!("point {} of {}", header.points - left + i, header.points)))
            .collect::<Result<_>>()?;
        let read: Vec<Result<Point<N>, String>> = batch
            .par_iter()
            .map(|line| {
                let words: Vec<&[u8]> = line.words().take(header.record_numbers + 1).collect();
                if words.len() != header.record_numbers {
                    let more = if words.len() > header.record_numbers { "more than " } else { "" };
                    let found = words.len().min(header.record_numbers);
                    return Err(format!("{more}{found} numbers; expected {}", header.record_numbers));
                }
                let mut point = [0.0; N];
                for (slot, (value, field)) in point.iter_mut().zip(wanted).enumerate() {
                    let Some(field) = field else { continue };
                    let word = words.get(field.index).copied().unwrap_or_default();
                    let number =
                        if slot == packed { packed_word(word, field.kind) } else { word_number(word) };
                    *value = number
                        .ok_or_else(|| format!("'{}' as {}; expected a number", shown(word), field.name))?;
                }
                Ok(point)
            })
            .collect();
        let points =
            read.into_iter().zip(&batch).map(|(point, line)| point.map_err(|e| lines.fault(*line, e)));
        take(&points.collect::<Result<Vec<_>>>()?);
        left -= batch.len();
    }
    match lines.next()? {
        Some(line) => {
            Err(lines.fault(line, format!("a line more than the {} points of the header", header.points)))
        }
        None => Ok(()),
    }
}

fn word_number(word: &[u8]) -> Option<f64> {
    number::read(str::from_utf8(word).ok()?)
}

/// The bits of a color: as a whole number, or as a float that has them.
fn packed_word(word: &[u8], kind: Kind) -> Option<f64> {
    let text = str::from_utf8(word).ok()?;
    match (text.parse::<i64>(), kind) {
        // A color with an alpha above 127 is negative as a signed number.
        (Ok(bits), _) => Some(f64::from(bits as u32)),
        (Err(_), Kind::Float) => text.parse::<f32>().ok().map(|value| f64::from(value.to_bits())),
        (Err(_), _) => None,
    }
}
