//! Potree 2 files; compressed nodes as PotreeConverter lays them out, in blocks of Brotli that are stored (RFC 7932, section 9.2).

use std::collections::BTreeMap;

use super::{CloudPoint, Key, OFFSET, Octree, SCALE};

/// What points of a node are written as.
type NodeBytes = fn(&[CloudPoint]) -> Vec<u8>;

impl Octree {
    /// `metadata.json`, `hierarchy.bin` and `octree.bin` of Potree 2.
    pub fn potree(&self, page_levels: i32) -> [Vec<u8>; 3] {
        self.potree_files(page_levels, ("DEFAULT", plain_node))
    }

    /// The same with compressed nodes.
    pub fn packed_potree(&self, page_levels: i32) -> [Vec<u8>; 3] {
        self.potree_files(page_levels, ("BROTLI", packed_node))
    }

    fn potree_files(&self, page_levels: i32, (encoding, node): (&str, NodeBytes)) -> [Vec<u8>; 3] {
        let mut octree = Vec::new();
        let mut places = BTreeMap::new();
        for (key, points) in &self.nodes {
            let begin = octree.len() as u64;
            octree.extend(node(points));
            places.insert(*key, (begin, octree.len() as u64 - begin));
        }
        let roots = self.roots(page_levels);
        let mut begin = 0;
        let mut pages = BTreeMap::new();
        for root in &roots {
            let bytes = 22 * self.page(*root, page_levels).len() as u64;
            pages.insert(*root, (begin, bytes));
            begin += bytes;
        }
        let mut hierarchy = Vec::new();
        for (key, is_page) in roots.iter().flat_map(|root| self.page(*root, page_levels)) {
            let children: Vec<Key> = self.children(key).collect();
            let number = |child: &Key| (child[1] & 1) << 2 | (child[2] & 1) << 1 | child[3] & 1;
            let mask = children.iter().fold(0_u8, |mask, child| mask | 1 << number(child));
            let kind = if is_page { 2 } else { u8::from(children.is_empty()) };
            let (at, bytes) = if is_page { pages[&key] } else { places[&key] };
            hierarchy.extend([kind, mask]);
            hierarchy.extend((self.nodes[&key].len() as u32).to_le_bytes());
            hierarchy.extend(at.to_le_bytes());
            hierarchy.extend(bytes.to_le_bytes());
        }
        let min = [0, 1, 2].map(|axis| OFFSET[axis] + f64::from(self.min[axis]) * SCALE);
        let max = min.map(|at| at + f64::from(self.side) * SCALE);
        let metadata = format!(
            r#"{{"version": "2.0", "name": "a", "description": "", "points": {}, "projection": "",
"hierarchy": {{"firstChunkSize": {}, "stepSize": 4, "depth": 9}},
"offset": {OFFSET:?}, "scale": [{SCALE}, {SCALE}, {SCALE}], "spacing": {}, "boundingBox": {{"min": {min:?}, "max": {max:?}}}, "encoding": "{encoding}",
"attributes": [
{{"name": "position", "description": "", "size": 12, "numElements": 3, "elementSize": 4, "type": "int32", "min": {min:?}, "max": {max:?}}},
{{"name": "intensity", "description": "", "size": 2, "numElements": 1, "elementSize": 2, "type": "uint16", "min": [7], "max": [7]}},
{{"name": "classification", "description": "", "size": 1, "numElements": 1, "elementSize": 1, "type": "uint8", "min": [2], "max": [2]}},
{{"name": "rgb", "description": "", "size": 6, "numElements": 3, "elementSize": 2, "type": "uint16", "min": [0, 0, 0], "max": [65535, 65535, 65535]}}]}}"#,
            self.count(),
            pages[&[0; 4]].1,
            self.spacing()
        );
        [metadata.into_bytes(), hierarchy, octree]
    }
}

/// Position, intensity, class and color of one point after the other.
fn plain_node(points: &[CloudPoint]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for (at, color) in points {
        at.iter().for_each(|step| bytes.extend(step.to_le_bytes()));
        bytes.extend(7_u16.to_le_bytes());
        bytes.push(2);
        color.iter().for_each(|value| bytes.extend(value.to_le_bytes()));
    }
    bytes
}

/// One column an attribute; none of no points.
fn packed_node(points: &[CloudPoint]) -> Vec<u8> {
    let mut columns = Vec::new();
    for (at, _) in points {
        columns.extend(in_turn(at.map(|step| step as u32 >> 16)));
        columns.extend(in_turn(at.map(|step| step as u32 & 0xffff)));
    }
    points.iter().for_each(|_| columns.extend(7_u16.to_le_bytes()));
    points.iter().for_each(|_| columns.push(2));
    points.iter().for_each(|(_, color)| columns.extend(in_turn(color.map(u32::from))));
    if points.is_empty() { Vec::new() } else { stored(&columns) }
}

/// The bits of three numbers, from the lowest up.
fn in_turn(numbers: [u32; 3]) -> [u8; 8] {
    let bits = (0..16).flat_map(|bit| numbers.map(|number| u64::from(number >> bit & 1)));
    bits.zip(0..).fold(0, |code, (bit, place)| code | bit << place).to_le_bytes()
}

/// Blocks of up to 65 536 bytes, which their first bits tell: of the first one, that the window has 16 bits; that it is not the last; 4 digits of its length less
/// 1; and that it is stored. An empty one is the last.
fn stored(bytes: &[u8]) -> Vec<u8> {
    let mut stream = Vec::new();
    for (number, block) in bytes.chunks(1 << 16).enumerate() {
        let head = (block.len() as u32 - 1) << 3 | 1 << 19;
        stream.extend(&(head << u32::from(number == 0)).to_le_bytes()[..3]);
        stream.extend(block);
    }
    stream.push(3);
    stream
}
