//! The first bytes of the file: what it holds, and where its table is.

use glam::DVec3;

use super::{
    VERSION,
    bytes::{In, Out},
    table::ENTRY_BYTES,
};
use crate::scene::Opacity;

/// What splats leave in the mean over a surface that lie apart: a splat alone has (1 − e⁻²) / 2.
const LEAST_OVERLAP: f64 = 0.1;

/// Bytes of the header.
pub(super) const HEADER_BYTES: usize = 256;

/// Of which the last four are the checksum of those before.
const CHECKED_BYTES: usize = HEADER_BYTES - 4;

/// The first bytes of any version. The first is no letter and the last a line end, so that what treats the file as text spoils it at once.
pub(super) const MAGIC: [u8; 8] = *b"\x89SURFEL\n";

/// The largest coordinate: that of what hierarchies are made of, see `geometry::hierarchy`.
pub(super) const LARGEST: f64 = crate::geometry::hierarchy::LARGEST_COORDINATE;

/// What a file holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Header {
    /// The object's own splats.
    pub splats: u64,
    /// Splats that stand for others.
    pub nodes: u64,
    /// Pages.
    pub pages: u32,
    /// As [`crate::scene::Object::closed`].
    pub closed: bool,
    /// The object's own splats are ellipses; else disks.
    pub ellipses: bool,
    /// Some splat is transparent.
    pub transparent: bool,
    /// The one color of all splats, linear with straight alpha; `None`: each has its own.
    pub color: Option<[f32; 4]>,
    /// From where balls are counted, in world space.
    pub origin: DVec3,
    /// The box around all of the object's own splats: its corners.
    pub bounds: [DVec3; 2],
    /// No point of a splat is farther from the middle of the box.
    pub radius: f64,
    /// The radius of the root's ball; 0 where there is no node.
    pub root_radius: f64,
    /// As [`crate::scene::LeveledObject::overlap`].
    pub overlap: f64,
    /// The direction that is up, where something tells it: unit.
    pub up: Option<DVec3>,
    /// The first byte of the table, behind all pages.
    pub(super) table_at: u64,
    /// The checksum of the table.
    pub(super) table_crc: u32,
}

/// Bits of the flags.
const CLOSED: u32 = 1;
const ELLIPSES: u32 = 2;
const TRANSPARENT: u32 = 4;
const ONE_COLOR: u32 = 8;
const HAS_UP: u32 = 16;

impl Header {
    /// How much the object hides.
    pub fn opacity(&self) -> Opacity {
        match (self.color, self.transparent) {
            (Some([.., 0.0]), true) => Opacity::Invisible,
            (_, true) => Opacity::Transparent,
            (_, false) => Opacity::Opaque,
        }
    }

    /// Bytes of the whole file.
    pub fn file_bytes(&self) -> u64 {
        self.table_at.saturating_add(u64::from(self.pages) * ENTRY_BYTES as u64)
    }

    pub(super) fn encode(&self) -> Vec<u8> {
        let flag = |bit: u32, set: bool| if set { bit } else { 0 };
        let flags = flag(CLOSED, self.closed)
            | flag(ELLIPSES, self.ellipses)
            | flag(TRANSPARENT, self.transparent)
            | flag(ONE_COLOR, self.color.is_some())
            | flag(HAS_UP, self.up.is_some());
        let mut out = Out::default();
        out.0.extend(MAGIC);
        out.u32(VERSION);
        out.u32(flags);
        out.u64(self.splats);
        out.u64(self.nodes);
        out.u64(self.table_at);
        out.u32(self.pages);
        out.u32(self.table_crc);
        out.dvec3(self.origin);
        out.dvec3(self.bounds[0]);
        out.dvec3(self.bounds[1]);
        out.f64s([self.radius, self.root_radius, self.overlap]);
        out.f32s(self.color.unwrap_or_default());
        out.dvec3(self.up.unwrap_or_default());
        out.0.resize(CHECKED_BYTES, 0);
        out.u32(crc32fast::hash(&out.0));
        out.0
    }

    /// The header in these bytes, of a file that is so long.
    ///
    /// # Errors
    /// What is wrong, in words.
    pub(super) fn decode(bytes: &[u8; HEADER_BYTES], file_bytes: u64) -> Result<Self, String> {
        let mut input = In(bytes);
        if bytes[..MAGIC.len()] != MAGIC {
            return Err("the file does not begin as a hierarchy does".to_owned());
        }
        input.0 = &bytes[MAGIC.len()..];
        let version = input.u32();
        if version != VERSION {
            return Err(format!("version {version}; expected {VERSION}"));
        }
        let stored = In(&bytes[CHECKED_BYTES..]).u32();
        if crc32fast::hash(&bytes[..CHECKED_BYTES]) != stored {
            return Err(
                "its checksum is wrong: the file is damaged, or was not written to its end".to_owned()
            );
        }
        let flags = input.u32();
        let has = |bit: u32| flags & bit != 0;
        let [splats, nodes, table_at] = [(); 3].map(|()| input.u64());
        let [pages, table_crc] = [(); 2].map(|()| input.u32());
        let [origin, least, most] = [(); 3].map(|()| input.dvec3());
        let [radius, root_radius, overlap] = [(); 3].map(|()| input.f64());
        let color = [(); 4].map(|()| input.f32());
        let up = input.dvec3();
        let header = Self {
            splats,
            nodes,
            pages,
            closed: has(CLOSED),
            ellipses: has(ELLIPSES),
            transparent: has(TRANSPARENT),
            color: has(ONE_COLOR).then_some(color),
            origin,
            bounds: [least, most],
            radius,
            root_radius,
            overlap,
            up: has(HAS_UP).then_some(up),
            table_at,
            table_crc,
        };
        if flags >= 2 * HAS_UP || input.0[..input.0.len() - 4].iter().any(|byte| *byte != 0) {
            return Err("flags or bytes that version 2 does not have".to_owned());
        }
        header.check(file_bytes).map(|()| header)
    }

    fn check(&self, file_bytes: u64) -> Result<(), String> {
        let found = self.file_bytes();
        if self.table_at < HEADER_BYTES as u64 || found != file_bytes {
            return Err(format!(
                "{} pages with a table at byte {} in {file_bytes} bytes; expected one that ends with \
                 the file",
                self.pages, self.table_at
            ));
        }
        if self.splats == 0 || self.nodes >= self.splats {
            return Err(format!("{} splats below {} nodes; expected more splats", self.splats, self.nodes));
        }
        self.check_places()?;
        let is_color = |color: &[f32; 4]| color.iter().all(|value| value.is_finite());
        if self.color.is_some_and(|color| !is_color(&color)) {
            return Err("a color that is not finite".to_owned());
        }
        match self.up {
            Some(up) if !(1.0 - 1e-6..1.0 + 1e-6).contains(&up.length()) => {
                Err(format!("{up} as up; expected a unit vector"))
            }
            _ => Ok(()),
        }
    }

    /// # Errors
    /// What is beyond what numbers are for, in words.
    pub(super) fn check_places(&self) -> Result<(), String> {
        let places = [self.origin, self.bounds[0], self.bounds[1]];
        // NaN is in no range.
        let is_near =
            |place: &DVec3| place.to_array().iter().all(|x| (-3.0 * LARGEST..=3.0 * LARGEST).contains(x));
        let [least, most] = self.bounds;
        if !places.iter().all(is_near) || !least.cmple(most).all() {
            return Err(format!("within {least} to {most} around {}; expected finite bounds", self.origin));
        }
        let lengths = [(self.radius, 0.0), (self.root_radius, 0.0), (self.overlap, LEAST_OVERLAP)];
        match lengths.into_iter().find(|(length, least)| !(*least..=100.0 * LARGEST).contains(length)) {
            Some((length, least)) => {
                Err(format!("a length or a sum of weights of {length}; expected {least} at least"))
            }
            None => Ok(()),
        }
    }
}
