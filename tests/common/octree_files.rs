//! COPC and Potree 2 (`potree_files.rs`) files of a cloud, written for tests by the formats' own descriptions and not by what reads them.

use std::{
    collections::{BTreeMap, HashSet},
    io::{Cursor, Seek as _},
};

#[path = "potree_files.rs"]
mod potree_files;

use laz::{LasZipCompressor, LazItemRecordBuilder, LazVlr, LazVlrBuilder};

/// A point: where, in steps of [`SCALE`], and its color.
pub type CloudPoint = ([i32; 3], [u16; 3]);

/// Of a step.
pub const SCALE: f64 = 0.001;

/// Where steps are counted from.
pub const OFFSET: [f64; 3] = [500_000.0, 4_600_000.0, 100.0];

/// Level, x, y, z.
pub type Key = [i32; 4];

/// An octree of points.
pub struct Octree {
    /// The corner of its cube, in steps.
    pub min: [i32; 3],
    /// Its side, in steps.
    pub side: i32,
    /// Cells of the root along its side: each node has a point a cell at most.
    pub cells: i32,
    pub nodes: BTreeMap<Key, Vec<CloudPoint>>,
    /// What COPC says of its coordinates, as well-known text.
    pub text: &'static str,
}

impl Octree {
    /// Each point in the highest node in which its cell is empty. `side` is a power of 2, above the extent of the points.
    pub fn of(points: &[CloudPoint], min: [i32; 3], side: i32, cells: i32) -> Self {
        let mut nodes: BTreeMap<Key, Vec<CloudPoint>> = BTreeMap::new();
        let mut taken = HashSet::new();
        for point in points {
            let from_min = [0, 1, 2].map(|axis| point.0[axis] - min[axis]);
            assert!(from_min.iter().all(|at| (0..side).contains(at)), "{from_min:?}");
            let place = |level: i32| {
                let cell = (side >> level) / cells;
                let [x, y, z] = from_min.map(|at| at / (side >> level));
                let last = cell <= 1 || taken.insert((level, from_min.map(|at| at / cell.max(1))));
                last.then_some([level, x, y, z])
            };
            let key = (0..).find_map(place).unwrap();
            nodes.entry(key).or_default().push(*point);
        }
        // The nodes above each are there, too.
        for key in nodes.keys().copied().collect::<Vec<_>>() {
            let mut key = key;
            while key[0] > 0 {
                key = [key[0] - 1, key[1] / 2, key[2] / 2, key[3] / 2];
                nodes.entry(key).or_default();
            }
        }
        Self { min, side, cells, nodes, text: "" }
    }

    fn count(&self) -> u64 {
        self.nodes.values().map(|points| points.len() as u64).sum()
    }

    fn spacing(&self) -> f64 {
        f64::from(self.side / self.cells) * SCALE
    }

    /// The nodes below `root`, and it, from the top; those at `page_levels` below it that have others below are the roots of further pages.
    fn page(&self, root: Key, page_levels: i32) -> Vec<(Key, bool)> {
        let mut page = vec![(root, false)];
        let mut at = 0;
        while let Some((key, is_page)) = page.get(at).copied() {
            at += 1;
            if is_page {
                continue;
            }
            for child in self.children(key) {
                let is_page = child[0] - root[0] == page_levels && self.children(child).next().is_some();
                page.push((child, is_page));
            }
        }
        page
    }

    /// Of all pages, each behind the one that names it.
    fn roots(&self, page_levels: i32) -> Vec<Key> {
        let mut roots = vec![[0; 4]];
        let mut number = 0;
        while let Some(root) = roots.get(number).copied() {
            number += 1;
            roots.extend(
                self.page(root, page_levels).iter().filter(|(_, is_page)| *is_page).map(|(key, _)| *key),
            );
        }
        roots
    }

    /// By the bits of their numbers: 4 for x, 2 for y, 1 for z.
    fn children(&self, [level, x, y, z]: Key) -> impl Iterator<Item = Key> {
        (0..8)
            .map(move |child| {
                [level + 1, 2 * x + (child >> 2 & 1), 2 * y + (child >> 1 & 1), 2 * z + (child & 1)]
            })
            .filter(|child| self.nodes.contains_key(child))
    }

    /// A COPC file of points of format 7, and where its root page begins.
    pub fn copc(&self, page_levels: i32) -> (Vec<u8>, usize) {
        let vlr = LazVlrBuilder::new(LazItemRecordBuilder::default_for_point_format_id(7, 0).unwrap())
            .with_variable_chunk_size()
            .build();
        let mut laz_record = Vec::new();
        vlr.write_to(&mut laz_record).unwrap();
        let text_bytes = if self.text.is_empty() { 0 } else { 54 + self.text.len() };
        let data_at = 375 + 54 + 160 + 54 + laz_record.len() + text_bytes;
        let (chunks, body) = self.chunks(vlr, data_at);
        let pages_at = data_at + body.len() + 60;
        let pages = self.copc_pages(&chunks, pages_at, page_levels);
        let root_bytes = 32 * self.page([0; 4], page_levels).len();
        let mut file = self.las_header(data_at, pages_at - 60);
        record_header(&mut file, b"copc", 1, 160);
        let half = 0.5 * f64::from(self.side) * SCALE;
        let center = [0, 1, 2].map(|axis| OFFSET[axis] + f64::from(self.min[axis]) * SCALE + half);
        for number in center.into_iter().chain([half, self.spacing()]) {
            file.extend(number.to_le_bytes());
        }
        for number in [pages_at as u64, root_bytes as u64] {
            file.extend(number.to_le_bytes());
        }
        file.extend([0; 160 - 56]);
        record_header(&mut file, b"laszip encoded", 22204, laz_record.len() as u16);
        file.extend(laz_record);
        if text_bytes > 0 {
            record_header(&mut file, b"LASF_Projection", 2112, self.text.len() as u16);
            file.extend(self.text.as_bytes());
        }
        assert_eq!(file.len(), data_at);
        file.extend(body);
        // An extended record: its length has 64 bits.
        file.extend([0; 2].into_iter().chain(padded(b"copc", 16)));
        file.extend(1000_u16.to_le_bytes());
        file.extend((pages.len() as u64).to_le_bytes());
        file.extend([0; 32]);
        assert_eq!(file.len(), pages_at);
        file.extend(pages);
        (file, pages_at)
    }

    /// Where each node's chunk is, and all chunks with their table.
    fn chunks(&self, vlr: LazVlr, data_at: usize) -> (BTreeMap<Key, (u64, i32)>, Vec<u8>) {
        let mut file = Cursor::new(vec![0; data_at]);
        file.set_position(data_at as u64);
        let mut compressor = LasZipCompressor::new(file, vlr).unwrap();
        compressor.reserve_offset_to_chunk_table().unwrap();
        let mut chunks = BTreeMap::new();
        for (key, points) in &self.nodes {
            if points.is_empty() {
                continue;
            }
            let begin = compressor.get_mut().stream_position().unwrap();
            let records: Vec<u8> = points.iter().flat_map(record).collect();
            compressor.compress_many(&records).unwrap();
            compressor.finish_current_chunk().unwrap();
            let end = compressor.get_mut().stream_position().unwrap();
            chunks.insert(*key, (begin, (end - begin) as i32));
        }
        compressor.done().unwrap();
        let mut file = compressor.into_inner().into_inner();
        (chunks, file.split_off(data_at))
    }

    fn copc_pages(&self, chunks: &BTreeMap<Key, (u64, i32)>, at: usize, page_levels: i32) -> Vec<u8> {
        let roots = self.roots(page_levels);
        let mut begin = at;
        let mut places = BTreeMap::new();
        for root in &roots {
            let bytes = 32 * self.page(*root, page_levels).len();
            places.insert(*root, (begin as u64, bytes as i32));
            begin += bytes;
        }
        let entry = |(key, is_page): &(Key, bool)| {
            let points = &self.nodes[key];
            let (place, points) = match (is_page, points.is_empty()) {
                (true, _) => (places[key], -1),
                (false, true) => ((0, 0), 0),
                (false, false) => (chunks[key], points.len() as i32),
            };
            let key = key.iter().flat_map(|number| number.to_le_bytes());
            let place = place.0.to_le_bytes().into_iter().chain(place.1.to_le_bytes());
            key.chain(place).chain(points.to_le_bytes()).collect::<Vec<u8>>()
        };
        roots.iter().flat_map(|root| self.page(*root, page_levels)).flat_map(|own| entry(&own)).collect()
    }

    fn las_header(&self, data_at: usize, extended_at: usize) -> Vec<u8> {
        let mut header = b"LASF".to_vec();
        header.extend([0; 20]);
        header.extend([1, 4]);
        header.extend([0; 68]);
        header.extend(375_u16.to_le_bytes());
        header.extend((data_at as u32).to_le_bytes());
        header.extend(if self.text.is_empty() { 2_u32 } else { 3 }.to_le_bytes());
        header.push(0x80 | 7);
        header.extend(36_u16.to_le_bytes());
        header.extend([0; 24]);
        [SCALE; 3].iter().chain(&OFFSET).for_each(|number| header.extend(number.to_le_bytes()));
        for (axis, offset) in OFFSET.iter().enumerate() {
            let places = || self.nodes.values().flatten().map(|point| point.0[axis]);
            for step in [places().max(), places().min()] {
                header.extend((offset + f64::from(step.unwrap_or(0)) * SCALE).to_le_bytes());
            }
        }
        header.extend([0; 8].into_iter().chain((extended_at as u64).to_le_bytes()));
        header.extend(1_u32.to_le_bytes());
        header.extend(self.count().to_le_bytes());
        header.extend([0; 120]);
        assert_eq!(header.len(), 375);
        header
    }
}

fn padded(text: &[u8], size: usize) -> Vec<u8> {
    let mut padded = text.to_vec();
    padded.resize(size, 0);
    padded
}

fn record_header(file: &mut Vec<u8>, user: &[u8], number: u16, bytes: u16) {
    file.extend([0; 2].into_iter().chain(padded(user, 16)));
    file.extend(number.to_le_bytes());
    file.extend(bytes.to_le_bytes());
    file.extend([0; 32]);
}

/// A record of format 7.
fn record((at, color): &CloudPoint) -> Vec<u8> {
    let mut record = Vec::with_capacity(36);
    at.iter().for_each(|step| record.extend(step.to_le_bytes()));
    record.extend(7_u16.to_le_bytes());
    record.extend([0x11, 0, 2, 0, 0, 0, 0, 0]);
    record.extend(0_f64.to_le_bytes());
    color.iter().for_each(|value| record.extend(value.to_le_bytes()));
    record
}
