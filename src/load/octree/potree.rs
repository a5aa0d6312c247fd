//! Potree 2: its metadata, and the records of its nodes.

use std::{fs::File, path::Path};

use glam::DVec3;
use serde::Deserialize;

use super::{Source, Span, Tree, packed_node};
use crate::{
    error::{Error, Result},
    load::{
        Limits, LoadOptions,
        beside::{self, Refusal},
        json,
        las::{Columns, NOISE},
        sniff::{is_potree, without_mark},
    },
    scene::Bounds,
};

/// Bytes of the metadata at most.
pub(super) const MOST_METADATA_BYTES: u64 = 16 << 20;

/// Bytes of a record at most.
const MOST_RECORD_BYTES: u64 = 1 << 16;

/// Whether a file that begins so is the metadata of Potree 2.
pub(super) fn is_metadata(head: &[u8]) -> bool {
    without_mark(head).trim_ascii_start().starts_with(b"{") && is_potree(head)
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Metadata {
    version: String,
    points: u64,
    hierarchy: Hierarchy,
    offset: [f64; 3],
    scale: [f64; 3],
    spacing: f64,
    bounding_box: Box3,
    encoding: String,
    attributes: Vec<Attribute>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Hierarchy {
    first_chunk_size: u64,
}

#[derive(Deserialize)]
struct Box3 {
    min: [f64; 3],
    max: [f64; 3],
}

#[derive(Deserialize)]
struct Attribute {
    name: String,
    size: u64,
    #[serde(rename = "type")]
    kind: String,
    #[serde(default)]
    min: Vec<f64>,
    #[serde(default)]
    max: Vec<f64>,
}

/// How its nodes are written.
pub(super) struct Form {
    /// Bytes of a point, once it is unpacked.
    pub record_bytes: usize,
    /// Nodes are compressed, one column an attribute.
    pub is_packed: bool,
    scale: DVec3,
    offset: DVec3,
    position_at: usize,
    color_at: Option<usize>,
    intensity_at: Option<usize>,
    class_at: Option<usize>,
}

/// What its metadata says.
pub(super) struct Opened {
    pub form: Form,
    pub words: String,
    pub points: u64,
    pub bounds: Bounds,
    pub tree: Tree,
}

/// Reads the metadata, and opens the files of the hierarchy and of the points in its folder.
pub(super) fn open(
    path: &Path,
    metadata: &[u8],
    folder: &Path,
    options: &LoadOptions,
) -> Result<(Opened, [Source<File>; 2])> {
    let beside = |name: &str| {
        let found = beside::find(folder, name, options.allow_outside).map_err(|refusal| match refusal {
            Refusal::Missing(path, e) => Error::file(path, "read", e),
            _ => Error::input(
                path,
                "",
                format!("{name} lies outside of its folder; --allow-outside allows it"),
            ),
        })?;
        Source::open(&found)
    };
    let files = [beside("hierarchy.bin")?, beside("octree.bin")?];
    let opened = read(path, metadata, files[0].bytes)?;
    Ok((opened, files))
}

/// Reads the metadata; the hierarchy has so many bytes.
pub(super) fn read(path: &Path, metadata: &[u8], hierarchy_bytes: u64) -> Result<Opened> {
    let refuse = |place: &str, problem: String| Error::input(path, place, problem);
    let metadata: Metadata =
        serde_json::from_slice(without_mark(metadata)).map_err(|e| refuse("JSON", json::problem(&e)))?;
    let short = |word: &str| word.chars().take(40).collect::<String>().escape_debug().to_string();
    let version = short(&metadata.version);
    if !version.starts_with("2.") {
        return Err(refuse("version", format!("'{version}'; expected 2.0")));
    }
    if !["DEFAULT", "UNCOMPRESSED", "BROTLI"].contains(&metadata.encoding.as_str()) {
        let problem = format!("'{}'; expected DEFAULT, UNCOMPRESSED or BROTLI", short(&metadata.encoding));
        return Err(refuse("encoding", problem));
    }
    let [scale, offset] = [metadata.scale, metadata.offset].map(DVec3::from);
    let Box3 { min, max } = metadata.bounding_box;
    let cube = [min, max].map(DVec3::from);
    let is_length = |length: &f64| length.is_normal() && *length > 0.0;
    let lengths = scale.to_array().into_iter().chain([metadata.spacing]);
    let extent = (cube[1] - cube[0]).to_array();
    if !lengths.chain(extent).all(|length| is_length(&length)) || !offset.is_finite() || !cube[0].is_finite()
    {
        let problem = format!(
            "scale {scale}, offset {offset}, spacing {} and the box from {} to {}; expected finite numbers, sizes above 0",
            metadata.spacing, cube[0], cube[1]
        );
        return Err(refuse("metadata", problem));
    }
    let form = Form::new(&metadata, scale, offset).map_err(|problem| refuse("attributes", problem))?;
    let bytes = metadata.hierarchy.first_chunk_size;
    if bytes == 0 || bytes > hierarchy_bytes {
        let problem = format!("a first chunk of {bytes} bytes; expected some within {hierarchy_bytes}");
        return Err(refuse("hierarchy", problem));
    }
    let tight = metadata.attributes.iter().find(|own| is_position(&own.name)).and_then(tight);
    Ok(Opened {
        form,
        words: format!("Potree {version}"),
        points: metadata.points,
        bounds: tight.unwrap_or(Bounds { min: cube[0], max: cube[1] }),
        tree: Tree::new(cube, metadata.spacing, Span { at: 0, bytes }, metadata.points),
    })
}

fn is_position(name: &str) -> bool {
    matches!(name, "position" | "POSITION_CARTESIAN")
}

/// The box of the points themselves; that of the octree is a cube.
fn tight(position: &Attribute) -> Option<Bounds> {
    let [min, max] = [&position.min, &position.max].map(|corner| {
        let corner: Option<[f64; 3]> = corner.as_slice().try_into().ok();
        corner.map(DVec3::from).filter(|corner| corner.is_finite())
    });
    min.zip(max).filter(|(min, max)| min.cmple(*max).all()).map(|(min, max)| Bounds { min, max })
}

impl Form {
    fn new(metadata: &Metadata, scale: DVec3, offset: DVec3) -> Result<Self, String> {
        let is_packed = metadata.encoding == "BROTLI";
        let mut at = 0_u64;
        let [mut position, mut color, mut intensity, mut class] = [None; 4];
        for Attribute { name, size, kind, .. } in &metadata.attributes {
            let place = Some(at as usize);
            match (name.as_str(), kind.as_str(), size) {
                (name, "int32", 12) if is_position(name) => position = place,
                ("rgb" | "RGB", "uint16", 6) => color = place,
                ("intensity", "uint16", 2) => intensity = place,
                ("classification", "uint8", 1) => class = place,
                _ => {}
            }
            let size = match is_packed {
                true if position == place => packed_node::POSITION_BYTES,
                true if color == place => packed_node::COLOR_BYTES,
                _ => *size,
            };
            at = at.saturating_add(size);
            if at > MOST_RECORD_BYTES {
                return Err(format!("records of {at} bytes; expected at most {MOST_RECORD_BYTES}"));
            }
        }
        let Some(position_at) = position else {
            return Err("no position of three int32".to_owned());
        };
        Ok(Self {
            record_bytes: at as usize,
            is_packed,
            scale,
            offset,
            position_at,
            color_at: color,
            intensity_at: intensity,
            class_at: class,
        })
    }

    pub fn has_colors(&self) -> bool {
        self.color_at.is_some()
    }

    /// Bytes of a point in its node; none where they differ.
    pub fn bytes_of_record(&self) -> Option<u64> {
        (!self.is_packed).then_some(self.record_bytes as u64)
    }

    /// The points of a node: one record after the other, or, compressed, one column.
    pub fn decode(&self, bytes: &[u8], points: usize, limits: &Limits) -> Result<Columns, String> {
        let unpacked;
        let bytes = match self.is_packed {
            true => {
                unpacked = packed_node::unpack(bytes, (points * self.record_bytes) as u64, limits)?;
                &unpacked
            }
            false => bytes,
        };
        // An attribute's bytes of a point.
        let own = |point: usize, at: usize, width: usize| {
            let begin = match self.is_packed {
                true => at * points + width * point,
                false => at + self.record_bytes * point,
            };
            bytes.get(begin..begin + width).unwrap_or_default()
        };
        let short = |bytes: &[u8]| u16::from_le_bytes(bytes.first_chunk().copied().unwrap_or_default());
        let position = |point: usize| match self.is_packed {
            true => packed_node::position(own(point, self.position_at, 16)),
            false => [0, 4, 8].map(|at| {
                let bytes = own(point, self.position_at + at, 4);
                i32::from_le_bytes(bytes.first_chunk().copied().unwrap_or_default())
            }),
        };
        let color = |point: usize, at: usize| match self.is_packed {
            true => packed_node::three(own(point, at, 8)),
            false => [0, 2, 4].map(|channel| short(own(point, at + channel, 2))),
        };
        let mut columns = Columns::default();
        for point in 0..points {
            let class = self.class_at.and_then(|at| own(point, at, 1).first());
            if class.is_some_and(|class| NOISE.contains(class)) {
                columns.noise += 1;
                continue;
            }
            let steps = DVec3::from(position(point).map(f64::from));
            columns.positions.push(steps * self.scale + self.offset);
            columns.colors.extend(self.color_at.map(|at| color(point, at)));
            columns.intensities.push(self.intensity_at.map_or(0, |at| short(own(point, at, 2))));
        }
        Ok(columns)
    }
}
