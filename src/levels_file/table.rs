//! The table of pages: where each is, and what bounds it.

use glam::DVec3;

use super::{
    MOST_PAGE_SPLATS,
    bytes::{In, Out},
    header::LARGEST,
};

/// Bytes of an entry.
pub(super) const ENTRY_BYTES: usize = 128;

/// Bounds of balls around the middle of a page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// The largest distance of a ball's farthest point.
    pub reach: f64,
    /// The largest distance of a ball's center, less its radius; may be below 0.
    pub far: f64,
    /// The least and the largest spread.
    pub spreads: [f64; 2],
}

/// A page as the table has it.
#[derive(Clone, Debug, PartialEq)]
pub struct PageEntry {
    /// Its first byte in the file.
    pub at: u64,
    /// How many bytes it has.
    pub bytes: u32,
    /// The checksum of these.
    pub(super) crc: u32,
    /// How many splats.
    pub count: u32,
    /// How many balls of parents.
    pub(super) balls: u32,
    /// It holds nodes, which stand for others; else the object's own splats.
    pub nodes: bool,
    /// Positions have 64 bits.
    pub(super) wide: bool,
    /// From where its positions are counted: about the middle of them, in world space.
    pub center: DVec3,
    /// No point of its splats is farther from the center.
    pub radius: f64,
    /// Of the nodes' own balls; all 0 where it holds the object's own splats.
    pub own: Reach,
    /// Of their parents'.
    pub parent: Reach,
}

const NODES: u32 = 1;
const WIDE: u32 = 2;

impl Reach {
    /// Of none.
    pub(super) const NONE: Self = Self { reach: 0.0, far: 0.0, spreads: [0.0; 2] };

    fn encode(&self, out: &mut Out) {
        out.f64s([self.reach, self.far]);
        out.f64s(self.spreads);
    }

    fn decode(input: &mut In<'_>) -> Self {
        let [reach, far, least, most] = [(); 4].map(|()| input.f64());
        Self { reach, far, spreads: [least, most] }
    }

    /// No bound of it is beyond what numbers are for; the largest spread may be infinite.
    fn is_usable(&self) -> bool {
        let [least, most] = self.spreads;
        let is_length = |value: f64| value.abs() <= 100.0 * LARGEST;
        is_length(self.reach) && self.reach >= 0.0 && is_length(self.far) && least >= 0.0 && least <= most
    }
}

/// Bytes of memory that a splat takes on its way to a device, and a node: twice what it has in a scene, as what is read and in the order of the
/// device, and what finds its place and its neighbors.
pub const HOST_BYTES: [u64; 2] = [220, 290];

/// Bytes of memory on a device that a splat takes at most, and a node: itself, its color, and the balls of its parent and its own, of which there may be one for each.
const DEVICE_BYTES: [u64; 2] = [84, 104];

impl PageEntry {
    /// Bytes of memory on a device that its splats take, at most.
    pub fn device_bytes(&self) -> u64 {
        u64::from(self.count) * DEVICE_BYTES[usize::from(self.nodes)]
    }

    /// Bytes of memory that its splats take on their way to a device, at most.
    pub fn host_bytes(&self) -> u64 {
        u64::from(self.count) * HOST_BYTES[usize::from(self.nodes)]
    }

    pub(super) fn encode(&self, out: &mut Out) {
        out.u64(self.at);
        let flags = if self.nodes { NODES } else { 0 } | if self.wide { WIDE } else { 0 };
        out.u32s([self.bytes, self.crc, self.count, flags, self.balls, 0]);
        out.dvec3(self.center);
        out.f64(self.radius);
        self.own.encode(out);
        self.parent.encode(out);
    }

    /// # Errors
    /// What is wrong, in words.
    pub(super) fn decode(bytes: &[u8]) -> Result<Self, String> {
        let mut input = In(bytes);
        let at = input.u64();
        let [bytes, crc, count, flags, balls, unused] = [(); 6].map(|()| input.u32());
        let entry = Self {
            at,
            bytes,
            crc,
            count,
            balls,
            nodes: flags & NODES != 0,
            wide: flags & WIDE != 0,
            center: input.dvec3(),
            radius: input.f64(),
            own: Reach::decode(&mut input),
            parent: Reach::decode(&mut input),
        };
        if flags > NODES | WIDE || unused != 0 {
            return Err("flags that version 2 does not have".to_owned());
        }
        if !(1..=MOST_PAGE_SPLATS as u32).contains(&count) || !(1..=count).contains(&balls) {
            return Err(format!(
                "{count} splats with {balls} parents; expected 1 to {MOST_PAGE_SPLATS}, and no more parents"
            ));
        }
        let is_near = entry.center.to_array().iter().all(|x| x.abs() <= 3.0 * LARGEST);
        let has_radius = (0.0..=100.0 * LARGEST).contains(&entry.radius);
        match is_near && has_radius && entry.own.is_usable() && entry.parent.is_usable() {
            true => Ok(entry),
            false => Err("bounds that are not finite, or below 0".to_owned()),
        }
    }
}
