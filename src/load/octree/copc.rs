//! COPC: its header, and the chunks of its nodes.

use std::{
    io::{Read, Seek},
    path::Path,
};

use glam::DVec3;

use super::{Source, Span, Tree};
use crate::{
    error::{Error, Result},
    load::{
        Input, Limits, LoadOptions,
        las::{Chunk, Columns, Coordinates, Header, coordinates, read_header},
    },
    scene::Bounds,
};

/// Where the first variable length record begins, which is that of COPC.
const INFO_AT: usize = 375;

/// Where its content begins, and how long that is.
const INFO: std::ops::Range<usize> = INFO_AT + 54..INFO_AT + 54 + 160;

/// Bytes before the points at most: coordinate systems and extra fields are described there.
const MOST_HEADER_BYTES: u64 = 16 << 20;

/// How its nodes are written.
pub(super) struct Form {
    header: Header,
}

/// What its header says.
pub(super) struct Opened {
    pub form: Form,
    pub words: String,
    pub points: u64,
    pub bounds: Bounds,
    pub tree: Tree,
}

/// Whether a file that begins so is COPC.
pub(super) fn is_copc(head: &[u8]) -> bool {
    let record = head.get(INFO_AT + 2..INFO_AT + 20);
    let is_info = |record: &[u8]| record.starts_with(b"copc\0") && record.ends_with(&1_u16.to_le_bytes());
    head.starts_with(b"LASF") && record.is_some_and(is_info)
}

/// Whether the coordinates of a file that begins so are degrees: no cube of them is one.
pub(super) fn has_degrees(head: &[u8]) -> bool {
    coordinates(head) == Coordinates::Degrees
}

fn number(bytes: &[u8], at: usize) -> f64 {
    f64::from_bits(whole(bytes, at))
}

fn whole(bytes: &[u8], at: usize) -> u64 {
    let bytes = bytes.get(at..).and_then(|rest| rest.first_chunk());
    bytes.map_or(0, |bytes| u64::from_le_bytes(*bytes))
}

/// Reads what stands before the points.
pub(super) fn open<R: Read + Seek>(source: &mut Source<R>, options: &LoadOptions) -> Result<Opened> {
    let path = source.path.clone();
    let refuse = |problem: String| Error::input(&path, "header", problem);
    let start = source.read(Span { at: 0, bytes: source.bytes.min(INFO.end as u64) })?;
    let data = u64::from(whole(&start, 96) as u32);
    if start.len() < INFO.end || data > source.bytes.min(MOST_HEADER_BYTES) || data < INFO.end as u64 {
        return Err(refuse(format!("points from byte {data} of {}, behind a header", source.bytes)));
    }
    let head = source.read(Span { at: 0, bytes: data })?;
    let input = Input { path: Path::new(&path), folder: None, bytes: &head, options, progress: &() };
    let header = read_header(&input)?;
    if header.coordinates == Coordinates::Degrees {
        let problem = "longitude and latitude in degrees; expected lengths, or to be read as a whole";
        return Err(input.fault("header", problem));
    }
    options.limits.check_points(&input, header.points)?;
    if header.laz.is_none() {
        return Err(refuse("not compressed; expected COPC to be".to_owned()));
    }
    let size = header.record_bytes as u64;
    let file_bytes = usize::try_from(source.bytes).unwrap_or(usize::MAX);
    let most = options.limits.expanded(file_bytes, options.limits.laz_expansion);
    if header.points.saturating_mul(size) > most {
        let problem = format!(
            "{} bytes are said to hold {} points; expected at most {}",
            source.bytes,
            header.points,
            most / size
        );
        return Err(refuse(problem));
    }
    let info = head.get(INFO).unwrap_or_default();
    let center = DVec3::new(number(info, 0), number(info, 8), number(info, 16));
    let [half, spacing] = [number(info, 24), number(info, 32)];
    let is_length = |length: f64| length.is_normal() && length > 0.0;
    if !center.is_finite() || !is_length(half) || !is_length(spacing) {
        let problem = format!(
            "an octree around {center} of half size {half} and spacing {spacing}; expected finite numbers, sizes above 0"
        );
        return Err(refuse(problem));
    }
    let root = Span { at: whole(info, 40), bytes: whole(info, 48) };
    if root.bytes == 0 || root.at.checked_add(root.bytes).is_none_or(|end| end > source.bytes) {
        let problem = format!(
            "a hierarchy of {} bytes at byte {}; expected some within {}",
            root.bytes, root.at, source.bytes
        );
        return Err(refuse(problem));
    }
    let cube = [center - half, center + half];
    Ok(Opened {
        words: header.words.clone(),
        points: header.points,
        bounds: bounds(&head).unwrap_or(Bounds { min: cube[0], max: cube[1] }),
        tree: Tree::new(cube, spacing, root, header.points),
        form: Form { header },
    })
}

/// Those of the LAS header, if it has any.
fn bounds(head: &[u8]) -> Option<Bounds> {
    let [max, min] = [0, 8].map(|second| {
        let at = |axis: usize| number(head, 179 + 16 * axis + second);
        DVec3::new(at(0), at(1), at(2))
    });
    (min.is_finite() && max.is_finite() && min.cmple(max).all()).then_some(Bounds { min, max })
}

impl Form {
    pub fn has_colors(&self) -> bool {
        self.header.format.has_color
    }

    /// The unit in metres, where the file tells it.
    pub fn metres_per_unit(&self) -> Option<f64> {
        match self.header.coordinates {
            Coordinates::Lengths(metres) => Some(metres),
            _ => None,
        }
    }

    /// The points of a node, which are a chunk of LAZ.
    pub fn decode(&self, bytes: &[u8], points: usize, limits: &Limits) -> Result<Columns, String> {
        let size = self.header.record_bytes;
        let most = limits.expanded(bytes.len(), limits.laz_expansion);
        if bytes.len() < size || points as u64 * size as u64 > most {
            return Err(format!("{} bytes are said to hold {points} points", bytes.len()));
        }
        let chunk = Chunk { bytes, first: 0, points, end: bytes.len() };
        Columns::read(&self.header, &chunk.records(&self.header)?)
    }
}
